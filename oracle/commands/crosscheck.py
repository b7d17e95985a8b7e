"""`raycert crosscheck`: the oracle against its independent witnesses."""

from __future__ import annotations

import re
import shlex
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from raycert.oracle.commands.options import family_option, golden_option, stop

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console

    from raycert.oracle.witness.crosscheck import Checked, Question, Summary, Tally

NAMES = ("definition", "enclosure", "symbols", "meshes")
SHOWN = 10
HELP = """Check the oracle's answers by witnesses that share no formula with it.

\b
definition  which points and gaps are in the solid, from its definition alone
enclosure   the seed's published formulas, in interval arithmetic
symbols     SymPy: polynomials it derives, their real roots isolated
meshes      trimesh: prisms inside and around the solid; prints how they close in

Each case is agreed, undecided or disagreed; undecided is never agreement. The cases are the
golden rows, some families of them, a fresh sample, or one given as a line of the protocol.

\b
Examples:
  raycert crosscheck --fresh 2000
  raycert crosscheck --witness definition --witness enclosure
  raycert crosscheck --json '{"solid": {"type": "sphere", "center": [0,0,0],
      "radius": 1}, "ray": {"origin": [-3,0,0], "direction": [1,0,0]}}'

Exit status: 0 no witness disagreed, 1 one did, 2 bad usage, 3 a witness's libraries are not
installed or nothing was checked.
"""


@click.command(help=HELP)
@click.option(
    "--witness", "names", multiple=True, type=click.Choice(NAMES), help="Only this (repeatable)."
)
@family_option
@click.option("--fresh", type=click.IntRange(min=1), metavar="N", help="N cases drawn anew.")
@click.option("--seed", default=1, show_default=True, help="What --fresh draws from.")
@click.option("--json", "lines", multiple=True, metavar="CASE", help="This case (repeatable).")
@golden_option
@click.option("--workers", type=click.IntRange(min=1), default=2, show_default=True)
def crosscheck(names: tuple[str, ...], **options: Any) -> None:
    """Check the oracle's answers by witnesses that share no formula with it."""
    if sum(bool(options[name]) for name in ("families", "fresh", "lines")) > 1:
        raise click.UsageError("--family, --fresh and --json exclude one another")
    if options["golden"] and (options["fresh"] or options["lines"]):
        raise click.UsageError("--golden goes with golden rows, not with --fresh or --json")
    chosen = tuple(name for name in NAMES if name in names) or NAMES
    _require(chosen)
    questions = _questions(options)
    if not questions:
        stop("nothing to check: the golden files hold no rows")
    workers = min(options["workers"], -(-len(questions) // 16))
    status = _crosscheck(questions, chosen, workers)
    if "meshes" in chosen and not options["lines"]:
        _print_curve()
    raise SystemExit(status)


def _require(names: Sequence[str]) -> None:
    """Stop, naming what to install, if a witness cannot be loaded."""
    from raycert.oracle.witness.verdict import Missing, load

    for name in names:
        try:
            load(name)
        except Missing as missing:
            others = " ".join(f"--witness {other}" for other in NAMES[:2])
            stop(f"{missing}; or leave it out: raycert crosscheck {others}")


def _questions(options: dict[str, Any]) -> list[Question]:
    from raycert.oracle.witness.crosscheck import Question

    if options["lines"]:
        return [_read(line, f"json-{i}") for i, line in enumerate(options["lines"], 1)]
    if options["fresh"]:
        from raycert.cases.draw import fresh

        cases = fresh(options["fresh"], options["seed"])
        return [Question(f"fresh/{case.slug}", case.solid, case.ray) for case in cases]
    return _rows(options["golden"], options["families"])


def _read(line: str, id: str) -> Question:
    """Return the case on a line of the protocol, as it is sent to an implementation."""
    from raycert.cases.forms import read_ray, read_solid
    from raycert.cases.model import Refused
    from raycert.cases.protocol import BadLine, decode
    from raycert.oracle.witness.crosscheck import Question

    try:
        form = decode(line.encode())
        solid, ray = read_solid(form.get("solid")), read_ray(form.get("ray"))
    except (BadLine, Refused) as error:
        raise click.BadParameter(str(error), param_hint="--json") from None
    return Question(str(form.get("id", id)), solid, ray)


def _rows(folder: Path | None, families: tuple[str, ...]) -> list[Question]:
    from raycert.cases.corpus import GOLDEN, BadCorpus, read_corpus
    from raycert.cases.formats import FORMATS
    from raycert.oracle.witness.crosscheck import Question

    try:
        corpora = [read_corpus(precision, folder or GOLDEN) for precision in FORMATS]
    except BadCorpus as error:
        raise click.UsageError(str(error)) from None
    rows = [(f"{c.precision}:{row.id}", row) for c in corpora for row in c.rows]
    known = {row.family for _, row in rows}
    if absent := [family for family in families if family not in known]:
        raise click.UsageError(f"not in the corpus: {', '.join(absent)}; see: raycert list")
    return [
        Question(id, row.solid, row.ray)
        for id, row in rows
        if not families or row.family in families
    ]


def _crosscheck(questions: list[Question], names: Sequence[str], workers: int) -> int:
    from rich.console import Console

    from raycert.oracle.commands.options import counting
    from raycert.oracle.witness.crosscheck import Summary
    from raycert.oracle.witness.crosscheck import crosscheck as run

    summary = Summary.over(names)
    with counting("cross-checking", len(questions)) as advance:
        for checked in run(questions, names, workers):
            summary.add(checked)
            advance()
    for checked in summary.differing[:SHOWN]:
        _print_difference(checked, names)
    if len(summary.differing) > SHOWN:
        click.echo(f"and {len(summary.differing) - SHOWN} more cases\n")
    _print_table(summary, Console(highlight=False))
    return 1 if summary.differing else 0


def _print_difference(checked: Checked, names: Sequence[str]) -> None:
    """Print the case, all answers, and the command that repeats it."""
    from raycert.cases.formats import BINARY64
    from raycert.cases.protocol import ask

    question = checked.question
    line = ask(question.id, question.solid, question.ray, "decimal", BINARY64).decode().strip()
    click.echo(f"{question.id}: the oracle and a witness differ")
    click.echo(f"  case        {line}")
    click.echo(f"  {'oracle':<11} {checked.answer}")
    for name, verdict, _ in checked.verdicts:
        click.echo(f"  {name:<11} {verdict.found or 'no list'}")
        click.echo(f"  {'':<11} {verdict.outcome}: {verdict.why}")
    only = "".join(f"--witness {name} " for name in names) if tuple(names) != NAMES else ""
    click.echo(f"  again       raycert crosscheck {only}--json {shlex.quote(line)}\n")


def _print_table(summary: Summary, console: Console) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD)
    table.add_column("witness")
    for heading in ("agreed", "undecided", "disagreed", "ms a case", "slowest, ms"):
        table.add_column(heading, justify="right")
    for tally in summary.tallies.values():
        table.add_row(tally.witness, *_cells(tally))
    console.print(table)
    for tally in summary.tallies.values():
        for why, count in _reasons(tally).most_common(5):
            click.echo(f"{tally.witness} undecided on {count}: {why}")


def _print_curve() -> None:
    """Print how the meshes close in on the cylinder as they get finer, and what a ray costs."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    from raycert.oracle.witness.convergence import convergence

    title = "Prisms of n sides: the gap between inner and outer list shrinks as 1/n^2"
    table = Table(box=SIMPLE_HEAD, title=title, title_justify="left")
    for heading in ("n", "gap / radius", "gap n^2", "ms a ray"):
        table.add_column(heading, justify="right")
    for row in convergence():
        cells = f"{row.gap:.3g}", f"{row.scaled:.3f}", f"{row.seconds * 1e3:.2f}"
        table.add_row(str(row.n), *cells)
    Console(highlight=False).print(table)


def _reasons(tally: Tally) -> Counter[str]:
    """Return how often each reason was given, whatever the intervals in it."""
    reasons: Counter[str] = Counter()
    for why, count in tally.undecided.items():
        reasons[re.sub(r"\[[^]]*\]", "[...]", why)] += count
    return reasons


def _cells(tally: Tally) -> tuple[str, ...]:
    outcomes, count = tally.outcomes, tally.count
    undecided = outcomes["undecided"]
    share = f" ({undecided / count:.1%})" if undecided else ""
    return (
        str(outcomes["agreed"]),
        f"{undecided}{share}",
        str(outcomes["disagreed"]),
        f"{tally.seconds / count * 1e3:.2f}",
        f"{tally.slowest * 1e3:.0f}",
    )
