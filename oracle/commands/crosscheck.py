"""`raycert crosscheck`: the oracle against its independent witnesses."""

from __future__ import annotations

import re
import shlex
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import click
from rich.box import SIMPLE_HEAD
from rich.table import Table

from raycert.cases.draw import fresh
from raycert.cases.files import read_all
from raycert.cases.formats import BINARY64
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import ask
from raycert.oracle.commands.asking import case_option, from_json
from raycert.oracle.commands.options import (
    PRECISIONS,
    OneOf,
    counting,
    family_option,
    golden_option,
    read,
    repeatable,
    seed_option,
    statuses,
    stop,
    unknown,
    workers_option,
)
from raycert.oracle.reports.foreign import say
from raycert.oracle.reports.screen import screen
from raycert.oracle.witness.crosscheck import Hearing, Query, Score, Summary
from raycert.oracle.witness.crosscheck import crosscheck as run
from raycert.oracle.witness.testimony import Missing, load

NAMES = ("definition", "enclosure", "symbols", "meshes")
SHOWN = 10
STATUSES = {
    0: "no witness disagreed",
    1: "one did",
    3: "a witness's libraries are not installed, or nothing was checked",
}
HELP = """Check the oracle's answers by witnesses that share no formula with it.

\b
definition  which points and gaps are in the solid, from its definition alone
enclosure   the derivation's formulas, in interval arithmetic
symbols     SymPy: polynomials it derives, their real roots isolated
meshes      trimesh: prisms inside and around the solid; prints how they close in

Each case is agreed, undecided or disagreed; undecided is never agreement. The cases are the
golden rows, some families of them, a fresh sample, or one of the line protocol.
"""
EPILOG = f"""\b
Examples:
  raycert crosscheck --fresh 2000
  raycert crosscheck --witness definition --witness enclosure
  raycert crosscheck --case - <<< '{{"solid": {{"type": "sphere", "center": [0,0,0],
      "radius": 1}}, "ray": {{"origin": [-3,0,0], "direction": [1,0,0]}}}}'

{statuses(STATUSES)}
"""


@click.command(help=HELP, epilog=EPILOG)
@repeatable("--witness", "names", "Only this", type=OneOf(NAMES))
@family_option
@click.option("--fresh", type=click.IntRange(min=1), metavar="N", help="N cases drawn anew.")
@seed_option(1, "What --fresh draws from.")
@case_option(" (repeatable)", multiple=True)
@golden_option
@workers_option(2)
def crosscheck(names: tuple[str, ...], **options: Any) -> None:
    """Check the oracle's answers by witnesses that share no formula with it."""
    if sum(bool(options[name]) for name in ("families", "fresh", "file")) > 1:
        raise click.UsageError("--family, --fresh and --case exclude one another")
    if options["golden"] and (options["fresh"] or options["file"]):
        raise click.UsageError("--golden goes with golden rows, not with --fresh or --case")

    chosen = tuple(name for name in NAMES if name in names) or NAMES
    _require(chosen)
    questions = [Query(*question) for question in _questions(options)]
    if not questions:
        stop("nothing to check: the golden files hold no rows")
    workers = min(options["workers"], -(-len(questions) // 16))
    status = _crosscheck(questions, chosen, workers)
    if "meshes" in chosen and not options["file"]:
        _print_curve()
    raise SystemExit(status)


def _require(names: Sequence[str]) -> None:
    """Stop, naming what to install, if a witness cannot be loaded."""
    for name in names:
        try:
            load(name)
        except Missing as missing:
            others = " ".join(f"--witness {other}" for other in NAMES[:2])
            stop(f"{missing}; or leave it out: raycert crosscheck {others}")


def _questions(options: dict[str, Any]) -> Iterable[tuple[str, Solid, Ray]]:
    if options["file"]:
        forms = [read_all("--case", file) for file in options["file"]]
        given = [from_json(form, BINARY64, "--case") for form in forms]
        return [(f"case-{i}", *probe) for i, probe in enumerate(given, 1)]
    if options["fresh"]:
        cases = fresh(options["fresh"], options["seed"])
        return [(f"fresh/{case.slug}", case.solid, case.ray) for case in cases]
    return _rows(options["golden"], options["families"])


def _rows(folder: Path | None, families: tuple[str, ...]) -> list[tuple[str, Solid, Ray]]:
    corpora = [read(precision, folder) for precision in PRECISIONS]
    rows = [(f"{corpus.precision}:{row.id}", row) for corpus in corpora for row in corpus.rows]
    known = {row.family for _, row in rows}
    for family in families:
        if family not in known:
            unknown("family", family, known)
    wanted = families or known
    return [(id, row.solid, row.ray) for id, row in rows if row.family in wanted]


def _crosscheck(questions: list[Query], names: Sequence[str], workers: int) -> int:
    summary = Summary()
    with counting("cross-checking", len(questions)) as advance:
        for checked in run(questions, names, workers):
            summary.add(checked)
            advance()
    for checked in summary.differing[:SHOWN]:
        _print_difference(checked, names)
    if len(summary.differing) > SHOWN:
        say(f"and {len(summary.differing) - SHOWN} more cases\n")
    _print_scores(names, summary)
    return 1 if summary.differing else 0


def _print_difference(checked: Hearing, names: Sequence[str]) -> None:
    """Print the case, all answers, and the command that repeats it."""
    question = checked.query
    line = ask(question.id, question.solid, question.ray, "decimal", BINARY64).decode().strip()
    say(f"{question.id}: the oracle and a witness differ")
    say(f"  case        {line}")
    say(f"  {'oracle':<11} {checked.answer}")
    for name, verdict, _ in checked.testimonies:
        say(f"  {name:<11} {verdict.found or 'no list'}")
        say(f"  {'':<11} {verdict.outcome}: {verdict.why}")
    only = "".join(f"--witness {name} " for name in names) if tuple(names) != NAMES else ""
    say(f"  again       raycert crosscheck {only}--case - <<< {shlex.quote(line)}\n")


def _table(title: str | None, headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print a table, the numbers in it to the right."""
    table = Table(box=SIMPLE_HEAD, title=title, title_justify="left")
    for heading in headings:
        table.add_column(heading, justify="left" if heading == "witness" else "right")
    for row in rows:
        table.add_row(*row)
    screen().print(table)


def _print_scores(names: Sequence[str], summary: Summary) -> None:
    headings = ("witness", "agreed", "undecided", "disagreed", "ms a case", "slowest, ms")
    _table(None, headings, [_cells(name, summary.scores[name]) for name in names])
    for name in names:
        reasons: Counter[str] = Counter()  # how often each was given, whatever the intervals in it
        for why, count in summary.scores[name].undecided.items():
            reasons[re.sub(r"\[[^]]*\]", "[...]", why)] += count
        for why, count in reasons.most_common(5):
            say(f"{name} undecided on {count}: {why}")


def _cells(name: str, score: Score) -> tuple[str, ...]:
    outcomes, count = score.outcomes, score.outcomes.total()
    undecided = outcomes["undecided"]
    share = f" ({undecided / count:.1%})" if undecided else ""
    times = f"{score.seconds / count * 1e3:.2f}", f"{score.slowest * 1e3:.0f}"
    agreed, disagreed = str(outcomes["agreed"]), str(outcomes["disagreed"])
    return (name, agreed, f"{undecided}{share}", disagreed, *times)


def _print_curve() -> None:
    """Print how the meshes close in on the cylinder as they get finer, and what a ray costs."""
    from raycert.oracle.witness.meshes import convergence

    _table(
        "Prisms of n sides: the gap between inner and outer list shrinks as 1/n^2",
        ("n", "gap / radius", "gap n^2", "ms a ray"),
        [
            (str(row.n), f"{row.gap:.3g}", f"{row.scaled:.3f}", f"{row.seconds * 1e3:.2f}")
            for row in convergence()
        ],
    )
