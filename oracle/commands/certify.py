"""`raycert certify`: grade an implementation on the golden cases."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click

from oracle.commands.output import check_writable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from cases.corpus import Corpus
    from cases.protocol import Hello
    from cases.row import GoldenRow
    from oracle.certificate import Ran
    from oracle.client.harness import Limits, Run
    from oracle.grade import Grade

BUILT_IN = {
    "oracle": ("-m", "oracle.commands.main", "serve", "oracle"),
    "reference": ("-m", "reference"),
}
LEVEL_NAMES = ("sound", "stable", "faithful", "exact")
TIER_NAMES = ("lattice", "generic", "stiff", "range")


SECONDS = click.FloatRange(min=0.01, max=86400)

EPILOG = """\b
The protocol, -> to the command and <- from it:
  -> {"hello": 1}
  <- {"hello": 1, "name": "my tracer", "solids": ["cylinder"]}
  -> {"id": "7", "solid": {"type": "cylinder", "p": [0, 0, 0], "q": [0, 0, 2],
      "radius": 1}, "ray": {"origin": [-3, 0, 1], "direction": [1, 0, 0]}}
  <- {"id": "7", "intervals": [[2.0, 4.0]]}

\b
Levels, each including the ones before:
  sound     right for nearly the same solid: no answer grossly wrong
  stable    right for the solid moved by 64 roundings of the sizes that meet
  faithful  every endpoint one of the two numbers around the exact one
  exact     every endpoint correctly rounded

\b
Examples:
  raycert certify reference --level stable
  raycert certify -- python3 my_tracer.py
  raycert certify --family far-deep -- ./my_tracer     a part, not a certificate

\b
Exit status: 0 granted, 1 not granted, 2 bad usage or input, 3 the target could
not be run or nothing was tested.
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
@click.option(
    "--golden",
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    help="Golden files to use instead of the installed ones.",
)
@click.option(
    "--out",
    type=click.Path(dir_okay=False),
    default="certificate.json",
    show_default=True,
    help="Where the certificate goes.",
)
@click.option(
    "--hello-timeout", type=SECONDS, default=10.0, show_default=True, help="Seconds to the hello."
)
@click.option(
    "--case-timeout", type=SECONDS, default=5.0, show_default=True, help="Seconds to an answer."
)
@click.option(
    "--line-limit",
    type=click.IntRange(min=256),
    default=1 << 20,
    show_default=True,
    help="Bytes in a line.",
)
def certify(target: tuple[str, ...], **options: Any) -> None:
    """Grade TARGET on the golden cases, print the verdict, write the certificate.

    TARGET is oracle, reference, or -- and a command that speaks the line protocol: it reads one
    JSON object a line on standard input and answers each with one on standard output, flushed.
    """
    from cases.protocol import BadLine, convention
    from oracle.client.harness import Limits
    from oracle.selection import Selection

    try:
        convention(options["convention"])
    except BadLine as error:
        raise click.BadParameter(str(error), param_hint="--convention") from None
    check_writable(Path(options["out"]).parent, "--out")
    selection = Selection(*(options[name] for name in ("solids", "tiers", "families", "ids")))
    limits = Limits(options["hello_timeout"], options["case_timeout"], options["line_limit"])
    raise SystemExit(_certify(target, options, selection, limits))


def _certify(
    target: tuple[str, ...], options: dict[str, Any], selection: Any, limits: Limits
) -> int:
    from oracle.certificate import Asked, certificate
    from oracle.certify import NOTHING, verdict
    from oracle.environment import environment
    from oracle.selection import select

    command = _command(target)
    hello = _greet(command, limits)
    corpus = _corpus(options["golden"], hello)
    if absent := selection.missing(corpus):
        raise click.UsageError(f"not in the corpus: {', '.join(absent)}; see: raycert list")
    rows, left = select(corpus, hello, selection)
    if not rows:
        _stop(f"nothing to test: the target declares {', '.join(hello.solids)}")
    notes = _smoke(command, hello, limits)
    run, seconds, interrupted = _ask(command, rows, limits)
    grades, cut = _grade(rows, run, hello)
    interrupted = interrupted or cut
    given = ("--", *target) if command[1:] not in BUILT_IN.values() else target
    asked = Asked(options["level"], options["convention"], given, selection.options())
    ran = _ran(run, notes, seconds, interrupted, grades, hello)
    judged = verdict(grades, asked.level, asked.convention)  # type: ignore[arg-type]
    form = certificate(asked, hello, corpus, grades, left, ran, judged, environment())
    _publish(form, options["out"])
    if judged.reasons == NOTHING.reasons:
        return 3
    return 0 if form["passed"] else 1


def _command(target: tuple[str, ...]) -> tuple[str, ...]:
    if len(target) == 1 and target[0] in BUILT_IN:
        return (sys.executable, *BUILT_IN[target[0]])
    return target


def _stop(message: str) -> NoReturn:
    click.echo(f"raycert: {message}", err=True)
    raise SystemExit(3)


def _greet(command: Sequence[str], limits: Limits) -> Hello:
    from oracle.client.harness import Unusable, greet

    try:
        hello = greet(command, limits)
    except Unusable as error:
        _stop(str(error))
    if hello.answers != "intervals":
        _stop(f"the target answers {hello.answers!r}; only interval lists are graded")
    return hello


def _corpus(folder: Path | None, hello: Hello) -> Corpus:
    from cases.corpus import GOLDEN, BadCorpus, read_corpus

    try:
        return read_corpus(hello.precision, folder or GOLDEN)
    except BadCorpus as error:
        raise click.UsageError(str(error)) from None


def _smoke(command: Sequence[str], hello: Hello, limits: Limits) -> list[str]:
    """Ask the easy cases first; stop if the adapter answers none of them."""
    from oracle.client.easy import easy
    from oracle.client.harness import Failure, Unusable, run
    from oracle.client.smoke import diagnose
    from oracle.client.smoke import limits as soon

    cases = easy(hello)
    try:
        outcomes = run(command, [case.question for case in cases], soon(limits)).outcomes
    except Unusable as error:
        _stop(str(error))
    said = diagnose(cases, outcomes)
    for line in said:
        click.echo(f"the adapter, rather than the tracer: {line}", err=True)
    if cases and all(isinstance(outcome, Failure) for outcome in outcomes.values()):
        _stop("none of the easy cases was answered, so nothing was tested")
    return said


def _ask(
    command: Sequence[str], rows: Sequence[GoldenRow], limits: Limits
) -> tuple[Run, float, bool]:
    """Ask every row; what is known is kept when the person interrupts."""
    import time

    from oracle.client.harness import Interrupted, Question, Unusable, run
    from oracle.commands.progress import counting

    questions = [Question(row.id, row.solid, row.ray) for row in rows]
    began = time.monotonic()
    done = 0
    with counting("asking", len(rows)) as advance:

        def on_progress(known: int) -> None:
            nonlocal done
            advance(known - done)
            done = known

        try:
            ran, interrupted = run(command, questions, limits, on_progress), False
        except Interrupted as stop:
            ran, interrupted = stop.run, True
        except Unusable as error:
            _stop(str(error))
    return ran, time.monotonic() - began, interrupted


def _grade(rows: Sequence[GoldenRow], run: Run, hello: Hello) -> tuple[list[Grade], bool]:
    """Return the grades, and whether the person stopped the judging; what is judged is kept."""
    from oracle.certify import severity
    from oracle.commands.progress import counting
    from oracle.grade import grade

    grades: list[Grade] = []
    with counting("judging", len(rows)) as advance:
        try:
            for row in rows:
                if row.id in run.outcomes:
                    graded = grade(row, run.outcomes[row.id], hello)
                    severity(graded)  # measures the errors now, where the progress shows
                    grades.append(graded)
                advance()
        except KeyboardInterrupt:
            return grades, True
    return grades, False


def _ran(
    run: Run, notes: list[str], seconds: float, interrupted: bool, grades: list[Grade], hello: Hello
) -> Ran:
    from oracle.certificate import Ran, contradictions

    said = (*notes, *run.notes, *contradictions(hello, grades))
    return Ran(run.restarts, (*said, *_diagnose(grades)), round(seconds, 3), interrupted)


def _diagnose(grades: list[Grade]) -> list[str]:
    """Return which planted fault the failing answers look like, if they look like just one."""
    from oracle.diagnosis import diagnose

    return diagnose(grades) if any(grade.faults for grade in grades) else []


def _publish(form: dict[str, Any], out: str) -> None:
    import json

    from rich.console import Console

    from cases.corpus import write_whole
    from oracle.report import report

    write_whole(Path(out), (json.dumps(form, indent=1, allow_nan=False) + "\n").encode())
    report(form, Console(width=None if sys.stdout.isatty() else 120), out)
