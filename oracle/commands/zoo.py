"""`raycert zoo`: every planted fault against every family, the kill matrix."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from raycert.cases.corpus import Corpus
from raycert.cases.protocol import ANSWERS, Hello
from raycert.oracle.certify.naming import TROUBLES, score
from raycert.oracle.commands.options import (
    FOLDER,
    PRECISIONS,
    counting,
    golden_option,
    json_option,
    read,
    repeatable,
    statuses,
    unknown,
    write_out,
)
from raycert.oracle.reports.foreign import say
from raycert.oracle.reports.screen import screen
from raycert.oracle.zoo import matrix
from raycert.oracle.zoo.inhabitants import BY_NAME, FAULTS

HELP = """Try planted wrong tracers on the golden rows: which family refuses which fault, and why.

Each fault has a family that was made for it, its home, which has to refuse it in the way that is
expected. A fault that no row refuses is a missing golden row.
"""
EPILOG = f"""\b
Examples:
  raycert zoo
  raycert zoo --fault no-clip --fault diameter    who refuses these
  raycert zoo --json matrix.json
  raycert zoo --write-smoke oracle/zoo/smoke      choose the smoke rows anew
  raycert zoo --diagnose 50                       how well certify names faults

{statuses({0: "every fault is refused by its home", 1: "one is not"})}
"""
SMOKE = "Choose the rows of certify --smoke, and write their ids there."
DIAGNOSE = """Take each fault, and N mixtures of two and three, for unknown subjects, and N tracers
with answers spoilt at random; tell what is named. Each takes a second or two."""
ROWS = 3
"""Every so many rows are asked of each subject."""
OTHERS = 78
"""What the columns before the last take, at most."""
WIDE = 100
"""From this width on there is room for the judge's words."""


@click.command(help=HELP, epilog=EPILOG)
@repeatable("--fault", "names", "Only this", metavar="NAME")
@golden_option
@json_option("The matrix")
@click.option("--write-smoke", "folder", type=FOLDER, help=SMOKE)
@click.option("--diagnose", "count", type=click.IntRange(min=1), metavar="N", help=DIAGNOSE)
def zoo(
    names: tuple[str, ...],
    golden: Path | None,
    out: str | None,
    folder: Path | None,
    count: int | None,
) -> None:
    """Try planted wrong tracers on the golden rows."""
    for name in names:
        if name not in BY_NAME:
            unknown("fault", name, BY_NAME)
    if folder:
        _write_smoke(golden, folder)
        return
    if count:
        _diagnose(read("binary64", golden), count)
        return
    corpus = read("binary64", golden)
    trials, lines = matrix.Trials(corpus.rows, corpus.format), []
    with counting("trying", len(names or BY_NAME)) as advance:
        for name in names or BY_NAME:
            lines.append(matrix.line(trials, BY_NAME[name]))
            advance()
    console = screen()
    console.print(_table(lines, console.width))
    if names:
        _families(lines, console)
    status = _summary(corpus, lines, console)
    if out:
        write_out(out, json.dumps(matrix.form(corpus, lines), indent=1) + "\n")
    raise SystemExit(status)


def _write_smoke(golden: Path | None, folder: Path) -> None:
    for precision in PRECISIONS:
        with counting(f"trying in {precision}", len(FAULTS)) as advance:
            ids = matrix.chosen(read(precision, golden), advance)
        say(f"{precision}: {len(ids)} rows")
        write_out(folder / f"{precision}.txt", "".join(f"{id}\n" for id in ids))


def _diagnose(corpus: Corpus, count: int) -> None:
    """Print how well the faults of subjects are named, by their trouble and mode of answer."""
    table = Table(box=None, pad_edge=False, padding=(0, 1))
    heads = ("trouble", "answers", "subjects", "shown", "named", "all shown", "all named", "others")
    for head in heads:
        table.add_column(head, justify="left" if head in heads[:2] else "right")
    kinds = [(trouble, mode) for mode in ANSWERS[:2] for trouble in TROUBLES]
    with counting("diagnosing", len(kinds)) as advance:
        for trouble, mode in kinds:
            found = score(trouble, count, corpus.rows[::ROWS], Hello("a subject", answers=mode))
            numbers = (found.subjects, found.showing, found.named, found.all_show, found.all_named)
            table.add_row(trouble, mode, *map(str, (*numbers, found.other)))
            advance()
    screen().print(table)


def _table(lines: Sequence[matrix.MatrixLine], width: int) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 1))
    for name in ("fault", "made for it", "refuses", "how", "all"):
        table.add_column(name, no_wrap=True, justify="right" if name == "all" else "left")
    if width >= WIDE:
        table.add_column("in the judge's words", no_wrap=True)
    for line in lines:
        home, first = line.at_home, line.first
        cells: list[Text | str] = [
            Text(line.fault.name, "red" if line.trouble else ""),
            line.fault.home,
            f"{len(home)} {home[0].level}" if home else "none",
            line.kind or "-",
            str(len(line.families)),
        ]
        if width >= WIDE:
            words = Text(first.reason if first else "", "dim")
            words.truncate(width - OTHERS, overflow="ellipsis")
            cells.append(words)
        table.add_row(*cells)
    return table


def _families(lines: Sequence[matrix.MatrixLine], console: Console) -> None:
    """Print, for each fault, who refuses it."""
    for line in lines:
        named = (line.fault.name, "bold"), f": a tracer that {line.fault.does}"
        console.print(Text.assemble("\n", *named))
        console.print(f"from: {line.fault.origin}")
        found = sorted(line.families.items(), key=lambda item: -item[1].total())
        for family, levels in found:
            counts = ", ".join(f"{n} {level}" for level, n in levels.items())
            console.print(f"  {family}: {counts}")


def _summary(corpus: Corpus, lines: Sequence[matrix.MatrixLine], console: Console) -> int:
    trouble = [line for line in lines if line.trouble]
    rows = f"{len(corpus.rows)} rows of corpus {corpus.version}"
    console.print(f"\n{len(lines)} faults, {rows}: ", end="")
    if not trouble:
        console.print("each refused by the family made for it", style="bold green")
        return 0
    console.print(f"{len(trouble)} NOT AS THEY SHOULD BE", style="bold red")
    for line in trouble:
        words = f"  {line.fault.name}, that {line.fault.does}: {line.trouble}"
        console.print(words, style="red")
    return 1
