"""`raycert certify` grades an implementation; `raycert report` writes its reports again."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from raycert.cases.interrupts import held
from raycert.oracle.commands.keeping import Keep, check_distinct, check_written, place
from raycert.oracle.commands.options import (
    FILE,
    FILE_OR_DASH,
    KNOWN_FILE,
    TARGETS,
    Function,
    aim,
    check_convention,
    counting,
    family_option,
    golden_option,
    id_option,
    level_option,
    limits,
    limits_options,
    out_option,
    seed_option,
    solid_option,
    spelled,
    statuses,
    stop,
    target_argument,
    tier_option,
    write_out,
    writing,
)
from raycert.oracle.reports.foreign import say

if TYPE_CHECKING:
    from raycert.oracle.certify.known import Expectations
    from raycert.oracle.certify.run import Plan, Result
    from raycert.oracle.client.dialogue import Target

PART = "no certificate, as this was a part of the rows: --out FILE writes what it found"
NARROWED = ("solids", "tiers", "families", "ids", "smoke")
REPORTS = {
    "html": "One page with pictures that needs no network.",
    "markdown": "A summary for a CI job, added to what FILE holds.",
    "junit": "JUnit XML: one test for a family.",
}

NOT_RUN = "the target could not be run, or nothing was tested"
EPILOG = f"""{TARGETS}
\b
The line protocol, -> to the command and <- from it:
  -> {{"hello": 1}}
  <- {{"hello": 1, "name": "my tracer", "solids": ["cylinder"]}}
  -> {{"id": "7", "solid": {{"type": "cylinder", "p": [0, 0, 0], "q": [0, 0, 2],
      "radius": 1}}, "ray": {{"origin": [-3, 0, 1], "direction": [1, 0, 0]}}}}
  <- {{"id": "7", "intervals": [[2.0, 4.0]]}}

\b
Levels, each including the ones before:
  sound     right for nearly the same solid: no answer grossly wrong
  stable    right for the solid moved by 64 roundings of the sizes that meet
  faithful  every endpoint one of the two numbers around the exact one
  exact     every endpoint correctly rounded

\b
Examples:
  raycert certify reference --level stable --html reference.html
  raycert certify -- python3 my_tracer.py
  raycert certify --smoke -- ./my_tracer             a look, in a second
  raycert certify my_tracer:intersect --seed 7       500 cases nobody has seen
  raycert certify --family far-deep -- ./my_tracer   a part, not a certificate
  raycert certify --write-domain hello.json -- ./my_tracer
  raycert certify --hello hello.json -- ./my_tracer  for what it says it is for

{statuses({0: "granted, or accepted with --expect", 1: "not granted", 3: NOT_RUN})}
"""


def report_options(function: Function) -> Function:
    for form, text in reversed(REPORTS.items()):
        option = click.option(f"--{form}", type=FILE_OR_DASH, metavar="FILE", help=text)
        function = option(function)
    return verbose_option(function)


verbose_option = click.option(
    "--verbose", is_flag=True, help="Print the worst answer of each family, and all notes, too."
)


@click.command(epilog=EPILOG)
@target_argument
@level_option("sound")
@click.option(
    "--convention",
    default="closed",
    show_default=True,
    help="closed, regularized, any, or with exceptions: 'closed but rim any tangent'.",
)
@click.option(
    "--hello", type=KNOWN_FILE, help="Fields of the hello that hold instead (JSON, TOML)."
)
@click.option("--write-domain", type=FILE, help="Write the measured domain, as such a hello.")
@solid_option
@tier_option
@family_option
@id_option
@click.option("--smoke", is_flag=True, help="Only some 150 rows that refuse every planted fault.")
@click.option("--shard", help="Only one of several parts, such as 2/5.")
@seed_option(None, "Ask cases drawn from this seed too.")
@click.option("--fresh", type=click.IntRange(1, 100_000), metavar="N", help="How many (500).")
@click.option("--fail-fast", is_flag=True, help="End soon after the first row that fails.")
@click.option("--expect", type=KNOWN_FILE, help="Known failures: a TOML file, with reasons.")
@click.option("--write-expectations", "record", type=FILE, help="Write such a file.")
@golden_option
@out_option(FILE, "The certificate.  [certificate.json; of a part of the rows none]")
@click.option("--force", is_flag=True, help="Overwrite what is of another run, or no certificate.")
@report_options
@click.option("--stress", is_flag=True, help="Set its error against stiffness too (a minute).")
@click.option("--bench", is_flag=True, help="Set its error against run time too.")
@limits_options
@held()
def certify(target: tuple[str, ...], **options: Any) -> None:
    """Grade TARGET on the golden cases, print the verdict, write the certificate.

    One run grades all levels; --level is the one that the exit status is for. A level is granted to
    a type of solid if every row that decides it passes, of those within the declared domain. What
    TARGET does not declare is not sent, and listed as not tested. Nothing else is left out.
    """
    from raycert.oracle.certify.known import write
    from raycert.oracle.reports.reading import verdict

    plan, words = _plan(target, options), spelled(target)
    kept = _place(plan, words, options)
    expected = _expectations(options["expect"])
    for line in expected.warnings if expected else ():
        say(f"raycert: {options['expect']}: {line}", err=True)
    result = _run(plan)
    known = result.matched(expected).as_json(str(options["expect"])) if expected else None
    form = result.form(words, known)
    asked = {} if result.ran.interrupted else options
    form["standing"] = _standing(result.prepared.hello.name, aim(target), asked)
    _print(form, options["verbose"])
    written = [str(kept.out)] if kept and kept.write(form) else []
    if options["record"]:
        write_out(options["record"], write(result.recorded(expected)))
    if options["write_domain"]:
        _write_domain(options["write_domain"], form)
    written += write_reports(form, _wanted(options))
    with writing("standard output"):
        say(f"certificate: {' '.join(written)}" if kept or written else PART)
    if result.changed:
        stop(result.changed)
    if not form["tested"] or form["reasons"] == ["nothing was tested"]:
        raise SystemExit(3)
    raise SystemExit(0 if verdict(form).good else 1)


def _place(plan: Plan, words: tuple[str, ...], options: dict[str, Any]) -> Keep | None:
    """Return where the certificate goes; refuse what would be lost by an output."""
    found = place(plan, words, options)
    named = {f"--{form}": options[form] for form in REPORTS}
    named |= {"--out": found and found.out, "--write-expectations": options["record"]}
    named |= {"--write-domain": options["write_domain"]}
    check_distinct(named)
    check_written(options)
    return found


def _plan(target: tuple[str, ...], options: dict[str, Any]) -> Plan:
    from raycert.cases.corpus import GOLDEN
    from raycert.oracle.certify.run import Plan
    from raycert.oracle.certify.selection import BadShard, Selection, Shard
    from raycert.oracle.corpus.fresh import COUNT, Fresh

    check_convention(options["convention"])
    try:
        shard = Shard.parse(options["shard"]) if options["shard"] else None
    except BadShard as error:
        raise click.BadParameter(str(error), param_hint="--shard") from None
    if options["fresh"] and options["seed"] is None:
        raise click.UsageError(
            "--fresh is the size of the block that --seed draws: give --seed too"
        )
    seed = options["seed"]
    return Plan(
        _declared(aim(target), options["hello"]),
        options["level"],
        options["convention"],
        Selection(**{name: options[name] for name in NARROWED}, shard=shard),
        limits(options),
        options["golden"] or GOLDEN,
        None if seed is None else Fresh(seed, options["fresh"] or COUNT),
        options["fail_fast"],
    )


def _declared(target: Target, hello: Path | None) -> Target:
    """Return the target, with what a file declares of it."""
    from raycert.oracle.client.declared import Declared, read_declared

    return Declared(target, read_declared(hello), str(hello)) if hello else target


def _write_domain(out: Path, certificate: dict[str, Any]) -> None:
    """Write the widest domain in which all is granted that can be; say what cannot."""
    import json

    from raycert.oracle.certify.widest import writable

    fields, without = writable(certificate)
    for line in without:
        say(f"raycert: --write-domain: {line}", err=True)
    write_out(out, json.dumps(fields, indent=1) + "\n")


def _expectations(path: Path | None) -> Expectations | None:
    from raycert.cases.files import read_text
    from raycert.oracle.certify.known import read

    return read(read_text(path), str(path)) if path else None


def _run(plan: Plan) -> Result:
    """Certify; what keeps the target from being tested ends the program."""
    from raycert.oracle.certify.run import NotInCorpus, Unsuitable, Watch, certify
    from raycert.oracle.client.dialogue import Unusable

    def note(line: str) -> None:
        say(f"the adapter, rather than the tracer: {line}", err=True)

    try:
        return certify(plan, Watch(counting, note))
    except (Unusable, Unsuitable) as error:
        stop(str(error))
    except NotInCorpus as error:
        raise click.UsageError(f"{error}; see: raycert list") from None


def _standing(name: str, target: Target, options: dict[str, Any]) -> dict[str, Any]:
    """Measure where the target sits, as far as that is asked."""
    standing: dict[str, Any] = {"stress": None, "bench": None}
    if not any(options.get(option) for option in standing):
        return standing
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.plots.standing import in_time, under_stress

    for option, measure in (("stress", under_stress), ("bench", in_time)):
        if options.get(option):
            try:
                standing[option] = measure(name, target, counting)
            except Unusable as error:
                say(f"raycert: --{option}: {error}", err=True)
    return standing


def _wanted(options: dict[str, Any]) -> dict[str, str]:
    """Return the reports asked for, form and file."""
    return {form: options[form] for form in REPORTS if options[form] is not None}


def write_reports(certificate: dict[str, Any], reports: dict[str, str]) -> list[str]:
    """Write a certificate in each form (a key of WRITERS) to its file; return those written.

    Markdown is added to what its file has: a summary of a job that others write to as well.
    """
    from raycert.oracle.reports.page import WRITERS

    return [
        out
        for form, out in reports.items()
        if write_out(out, WRITERS[form](certificate), append=form == "markdown")
    ]


def _print(certificate: dict[str, Any], verbose: bool) -> None:
    from raycert.oracle.reports.screen import screen
    from raycert.oracle.reports.terminal import report as show

    with writing("standard output"):
        show(certificate, screen(width=None if sys.stdout.isatty() else 100), verbose)


REPORT_EPILOG = f"""\b
Examples:
  raycert report certificate.json
  raycert report certificate.json --html out.html --junit out.xml
  raycert report certificate.json --markdown "$GITHUB_STEP_SUMMARY"

{statuses()}
"""


@click.command(epilog=REPORT_EPILOG)
@click.argument("certificate", type=KNOWN_FILE)
@report_options
def report(certificate: Path, verbose: bool, **options: str | None) -> None:
    """Write the reports of a certificate: the same as certify's own options do.

    CERTIFICATE is the JSON file that certify wrote. Without an option the report for a terminal is
    printed. A FILE of - is standard output.
    """
    from raycert.cases.files import read_as, read_file
    from raycert.oracle.reports.reading import check

    reports = _wanted(options)
    form = read_as(certificate, read_file(certificate), check)
    check_distinct({"CERTIFICATE": certificate} | {f"--{x}": file for x, file in reports.items()})
    if reports:
        write_reports(form, reports)
    else:
        _print(form, verbose)
