"""`raycert certify`: grade an implementation on the golden cases."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from raycert.oracle.commands.output import check_writable
from raycert.oracle.commands.reporting import write_reports
from raycert.oracle.commands.targeting import TARGETS, aim, limits, limits_options, spelled, stop

if TYPE_CHECKING:
    from raycert.oracle.certify.expectations import Expectations
    from raycert.oracle.certify.run import Plan, Result
    from raycert.oracle.client.dialogue import Target

LEVEL_NAMES = ("sound", "stable", "faithful", "exact")
TIER_NAMES = ("lattice", "generic", "stiff", "range")
FILE = click.Path(dir_okay=False, path_type=Path)
KNOWN = click.Path(exists=True, dir_okay=False, path_type=Path)
NARROWED = ("solids", "tiers", "families", "ids", "smoke")
REPORTS = ("junit", "markdown", "html")

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

\b
Exit status: 0 granted, or accepted with --expect; 1 not granted; 2 bad usage or
input; 3 the target could not be run or nothing was tested.
"""


@click.command(epilog=EPILOG)
@click.argument("target", nargs=-1, required=True, type=click.UNPROCESSED)
@click.option("--level", type=click.Choice(LEVEL_NAMES), default="sound", show_default=True)
@click.option(
    "--convention",
    default="closed",
    show_default=True,
    help="closed, regularized, or either with exceptions: 'closed but rim start'.",
)
@click.option("--solid", "solids", multiple=True, help="Only this solid type (repeatable).")
@click.option("--tier", "tiers", multiple=True, type=click.Choice(TIER_NAMES), help="Only this.")
@click.option("--family", "families", multiple=True, help="Only this family (repeatable).")
@click.option("--id", "ids", multiple=True, help="Only this row (repeatable).")
@click.option("--smoke", is_flag=True, help="Only some 150 rows that refuse every planted fault.")
@click.option("--shard", help="Only one of several parts, such as 2/5.")
@click.option("--seed", type=click.IntRange(min=0), help="Ask cases drawn from this seed too.")
@click.option("--fresh", type=click.IntRange(1, 100_000), help="Cases in that block (500).")
@click.option("--fail-fast", is_flag=True, help="End soon after the first row that fails.")
@click.option("--expect", type=KNOWN, help="Known failures: a TOML file, with reasons.")
@click.option("--write-expectations", "record", type=FILE, help="Write such a file.")
@click.option(
    "--golden",
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    help="Golden files to use instead of the installed ones.",
)
@click.option("--out", type=FILE, default="certificate.json", show_default=True)
@click.option("--html", type=FILE, help="Write the certificate as a page with pictures.")
@click.option("--markdown", type=FILE, help="Write a summary for a CI job.")
@click.option("--junit", type=FILE, help="Write JUnit XML.")
@click.option("--stress", is_flag=True, help="Set its error against stiffness too (a minute).")
@click.option("--bench", is_flag=True, help="Set its error against run time too.")
@limits_options
def certify(target: tuple[str, ...], **options: Any) -> None:
    """Grade TARGET on the golden cases, print the verdict, write the certificate.

    A level is granted to a type of solid if every row that decides it passes. What TARGET does not
    declare is not sent, and listed as not tested. Nothing else is left out.
    """
    from raycert.oracle.certify.expectations import Expectations
    from raycert.oracle.reports.reading import verdict

    for name in ("out", *REPORTS, "record"):
        if options[name]:
            option = "--write-expectations" if name == "record" else f"--{name}"
            check_writable(options[name].parent, option)
    expected = _expectations(options["expect"])
    for line in expected.warnings if expected else ():
        click.echo(f"raycert: {options['expect']}: {line}", err=True)
    result = _run(_plan(target, options))
    known = result.matched(expected).as_json(str(options["expect"])) if expected else None
    form = result.form(spelled(target), known)
    form["standing"] = _standing(result.prepared.hello.name, aim(target), options)
    if options["record"]:
        _write(options["record"], _recorded(result, expected or Expectations()))
    _publish(form, options)
    if not form["tested"] or form["reasons"] == ["nothing was tested"]:
        raise SystemExit(3)
    raise SystemExit(0 if verdict(form).good else 1)


def _plan(target: tuple[str, ...], options: dict[str, Any]) -> Plan:
    from raycert.cases.corpus import GOLDEN
    from raycert.cases.protocol import BadLine, convention
    from raycert.oracle.certify.run import Plan
    from raycert.oracle.certify.selection import BadShard, Selection, Shard
    from raycert.oracle.corpus.fresh import COUNT, Fresh

    try:
        convention(options["convention"])
        shard = Shard.parse(options["shard"]) if options["shard"] else None
    except (BadLine, BadShard) as error:
        hint = "--shard" if isinstance(error, BadShard) else "--convention"
        raise click.BadParameter(str(error), param_hint=hint) from None
    if options["fresh"] and options["seed"] is None:
        raise click.UsageError(
            "--fresh is the size of the block that --seed draws: give --seed too"
        )
    seed = options["seed"]
    return Plan(
        aim(target),
        options["level"],
        options["convention"],
        Selection(**{name: options[name] for name in NARROWED}, shard=shard),
        limits(options),
        options["golden"] or GOLDEN,
        None if seed is None else Fresh(seed, options["fresh"] or COUNT),
        options["fail_fast"],
    )


def _expectations(path: Path | None) -> Expectations | None:
    from raycert.oracle.certify.expectations import BadExpectations, read

    try:
        return read(path.read_text("utf-8"), str(path)) if path else None
    except (BadExpectations, UnicodeDecodeError) as error:
        raise click.BadParameter(str(error), param_hint="--expect") from None


def _recorded(result: Result, old: Expectations) -> str:
    from raycert.oracle.certify.expectations import write

    return write(result.recorded(old))


def _run(plan: Plan) -> Result:
    """Certify; what keeps the target from being tested ends the program."""
    from raycert.cases.corpus import BadCorpus
    from raycert.oracle.certify.run import NotInCorpus, Unsuitable, Watch, certify
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.commands.progress import counting

    def note(line: str) -> None:
        click.echo(f"the adapter, rather than the tracer: {line}", err=True)

    try:
        return certify(plan, Watch(counting, note))
    except (Unusable, Unsuitable) as error:
        stop(str(error))
    except NotInCorpus as error:
        raise click.UsageError(f"{error}; see: raycert list") from None
    except BadCorpus as error:
        raise click.UsageError(str(error)) from None


def _standing(name: str, target: Target, options: dict[str, Any]) -> dict[str, Any]:
    """Measure where the target sits, as far as that is asked."""
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.commands.progress import counting
    from raycert.oracle.measure.standing import in_time, under_stress

    standing: dict[str, Any] = {"stress": None, "bench": None}
    for option, measure in (("stress", under_stress), ("bench", in_time)):
        if options[option]:
            try:
                standing[option] = measure(name, target, counting)
            except Unusable as error:
                click.echo(f"raycert: --{option}: {error}", err=True)
    return standing


def _publish(form: dict[str, Any], options: dict[str, Any]) -> None:
    """Write the certificate and the reports asked for, and print it."""
    import json

    from rich.console import Console

    from raycert.oracle.reports.terminal import report

    _write(options["out"], json.dumps(form, indent=1, allow_nan=False) + "\n")
    asked = {name: str(options[name]) for name in REPORTS if options[name]}
    write_reports(form, asked)
    written = " ".join((str(options["out"]), *asked.values()))
    report(form, Console(width=None if sys.stdout.isatty() else 120), written)


def _write(path: Path, text: str) -> None:
    from raycert.cases.corpus import write_whole

    write_whole(path, text.encode("utf-8", "replace"))
