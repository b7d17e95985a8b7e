"""A gradebook for people: on a terminal, as Markdown, and as a page that links each certificate."""

from __future__ import annotations

from collections.abc import Iterator

from rich.console import Console
from rich.table import Table
from rich.text import Text

from raycert.oracle.reports.foreign import clean, code, legible, plain
from raycert.oracle.reports.gradebook import GOOD, left, spoken, standing, summary, title, why
from raycert.oracle.reports.page import render
from raycert.oracle.reports.reading import Json, count

SHORT = {
    "half_space": "half", "sphere": "sph.", "infinite_cylinder": "i.cyl", "slab": "slab",
    "cylinder": "cyl.", "box": "box", "capsule": "caps.", "union": "union",
    "intersection": "int.", "difference": "diff.", "stable": "stab.", "faithful": "faith",
}  # fmt: skip
"""Names for a narrow terminal, of five characters at most."""
ROOM = 44
"""From this width on the reasons have a column."""
NAME, GAP = 24, 1
STYLES = {"granted": "green", "part": "green", "refused": "red", "interrupted": "red"}
KEY = "A level is granted; a number is of rows that fail; r: all refused; *: another convention."


def report(book: Json, console: Console) -> None:
    """Print a gradebook: the reasons beside each target where they have room, else below.

    A terminal too narrow for the names of solids and levels has shorter ones, then shorter names of
    targets.
    """
    book = legible(book)
    short = _rest(book, False) + NAME + ROOM > console.width
    names = max(console.width - _rest(book, short), 8)
    names = min(names, max((len(title(row)) for row in book["targets"]), default=0), NAME)
    room = console.width - _rest(book, short) - names - GAP
    console.print(_table(book, short, names, room))
    reasons = [(row, said) for row in book["targets"] if (said := why(row))]
    for n, (row, said) in enumerate(reasons if room < ROOM else ()):
        name = Text(clean(title(row), NAME), "bold")
        gap = "" if n else "\n"
        console.print(Text.assemble(gap, name, f"  {clean('; '.join(said), 300)}"))
    console.print(Text(f"\n{KEY}" if book["solids"] else "", "dim"))
    good = all(row["state"] in GOOD for row in book["targets"])
    console.print(Text(summary(book), "bold green" if good else "bold red"))


def _head(name: str, short: bool) -> str:
    return SHORT.get(name, name) if short else spoken(name)


def _stands(row: Json) -> str:
    return standing(row).removesuffix(" left")


def _rest(book: Json, short: bool) -> int:
    """Return how wide the columns are between the target and the reasons, with their gaps."""
    columns = [[_stands(row) for row in book["targets"]]]
    for name in book["solids"]:
        cells = [_cell(row["solids"].get(name), short).plain for row in book["targets"]]
        columns.append([_head(name, short), *cells])
    return sum(GAP + max(map(len, column), default=0) for column in columns)


def _table(book: Json, short: bool, names: int, room: int) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, GAP, 0, 0))
    for name in ("target", "left", *(_head(name, short) for name in book["solids"])):
        table.add_column(name, no_wrap=True)
    if room >= ROOM:
        table.add_column("what is left")
    for row in book["targets"]:
        cells = [_cell(row["solids"].get(name), short) for name in book["solids"]]
        stands = Text(_stands(row), STYLES.get(row["state"], "yellow"))
        more = [Text(clean("; ".join(why(row)), 3 * room), "dim")] if room >= ROOM else []
        table.add_row(Text(clean(title(row), names)), stands, *cells, *more)
    return table


def _cell(solid: Json | None, short: bool) -> Text:
    if solid is None:
        return Text("-", "dim")
    if solid["holds"]:
        other = "" if solid["follows"] else "*"
        level = str(solid["granted"])
        return Text((SHORT.get(level, level) if short else level) + other, "green")
    if not solid["rows"]:
        return Text("none", "yellow")
    refused = solid["refused"] == solid["failed"]
    return Text(f"{solid['failed']}{'r' if refused else ''}", "yellow" if refused else "red")


MARKS = {"granted": "\u2705", "part": "\u2705", "not run": "\u26a0\ufe0f", "not asked": "\u2796"}


def markdown(book: Json) -> str:
    """Return a gradebook for the summary of a CI job."""
    book = legible(book)
    heads = ["target", "", *map(spoken, book["solids"]), "domain, refusals, likely fault"]
    lines = [
        f"### {plain(summary(book))}",
        "",
        f"| {' | '.join(heads)} |",
        "|---" * len(heads) + "|",
    ]
    for row in book["targets"]:
        mark = MARKS.get(row["state"], "\u274c")
        cells = [_words(row["solids"].get(name)) for name in book["solids"]]
        said = "<br>".join(map(code, why(row)))
        line = [code(title(row)), f"{mark} {standing(row)}", *cells, said]
        lines.append(f"| {' | '.join(line)} |")
    return "\n".join([*lines, "", f"{book['tool']['name']} {book['tool']['version']}", ""])


def _words(solid: Json | None) -> str:
    """Return a cell in words."""
    if solid is None:
        return ""
    if solid["holds"]:
        return plain(solid["granted"] + ("" if solid["follows"] else f", {solid['convention']}"))
    if not solid["rows"]:
        return "no row"
    level = f", {solid['granted']}" if solid["granted"] else ""
    return f"{solid['failed']:,} of {solid['rows']:,} fail {solid['level']}{level}"


def page(book: Json) -> str:
    """Return a gradebook as a page in the folder of the certificates."""
    book = legible(book)
    targets = book["targets"]
    return render(
        "gradebook.html",
        ("page.css", "gradebook.css"),
        {"clean": clean, "count": count, "spoken": spoken},
        book=book,
        summary=summary(book),
        good=all(row["state"] in GOOD for row in book["targets"]),
        rows=list(_lines(book)),
        asked=sorted({f"{r['asked']['level']} and {r['asked']['convention']}" for r in targets}),
    )


def _lines(book: Json) -> Iterator[Json]:
    for row in book["targets"]:
        yield {
            **row,
            "title": clean(title(row), 60),
            "stands": standing(row),
            "left": left(row),
            "why": [clean(line, 240) for line in why(row)],
            "cells": [row["solids"].get(name) for name in book["solids"]],
        }
