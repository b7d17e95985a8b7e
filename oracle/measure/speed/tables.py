"""The sections on a terminal: one table each, with the aims and what the columns mean."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from raycert.oracle.measure.speed.run import Report, surroundings

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

LEGENDS = {
    "certified": "naive: nanoseconds a ray of the float64 formula in NumPy; numpy, numba: the "
    "batch oracle's time over that. Then the percentage of the lanes by the highest rung that they "
    "need. Aims: on random rays numba <= 1, numpy <= 8; integer below 0.01, axis-aligned below 1. "
    "A missed aim is marked !",
    "scalar": "capped cylinders, one ray at a time; ratio: time over the oracle's. rounded: rays "
    "whose list has both ends correctly rounded; undecided: no answer; wrong: another list. The "
    "oracle decides all in integers. arb (python-flint) and mpmath-intervals take more bits until "
    "they are sure, mpmath-50 has 50 digits, sympy is exact and then takes 40.",
    "libraries": "a capped cylinder; pipe: with a hole along its axis. ratio: time over that of "
    "the reference tracer; a number after a library: facets around its mesh. wrong: rays with "
    "another number of hits than there are; error: largest relative error of a t on the other "
    "rays. MuJoCo has first hits and no Booleans, embreex alone has first hits.",
    "solids": "the whole picture (depth) of a crowd of spheres and cylinders, plan included; same: "
    "whether the two pictures have the same bits.",
}


def show(report: Report, console: Console) -> None:
    """Print the tables, then the machine, the versions and the seed."""
    for name, rows in report.sections.items():
        console.print(f"\n[bold]{name}[/]{_heading(name, rows)}")
        console.print(_TABLES[name](rows))
        console.print(LEGENDS[name], markup=False)
    console.print()
    for note in report.notes:
        console.print(note, markup=False)
    place = surroundings()
    packages = ", ".join(f"{name} {number}" for name, number in place["packages"].items())
    console.print(
        f"seed {report.seed}; {place['processor']}, {place['system']}, Python {place['python']}, "
        f"{packages}. Processor time, the least of passes in turn; only ratios travel.",
        markup=False,
        highlight=False,
    )


def _heading(name: str, rows: Sequence[Any]) -> str:
    """Return how many rays a call has where ratios depend on it: small arrays stay in a cache."""
    return f", {rows[0].rays} rays in a call" if name == "certified" and rows else ""


def plain(x: float) -> str:
    """Return a figure of two or three digits: 0.021, 1.52, 312."""
    return f"{x:.3g}" if abs(x) < 1000 else f"{x:.0f}"


def percent(x: float) -> str:
    """Return a share: 0, 0.002, 12.5."""
    return "0" if x == 0 else f"{100 * x:.3g}"


def _table(words: Sequence[str], figures: Sequence[str], lines: Iterable[Sequence[str]]) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for title in words:
        table.add_column(title, no_wrap=True)
    for title in figures:
        table.add_column(title, justify="right", no_wrap=True)
    for line in lines:
        table.add_row(*line)
    return table


def _certified(rows: Sequence[Any]) -> Table:
    engines = list(dict.fromkeys(name for row in rows for name in row.ratios))
    rungs = list(dict.fromkeys(name for row in rows for name in row.shares))
    titles = ["naive", *engines, *rungs]

    def marked(figure: str, row: Any, aim: str) -> str:
        return figure if row.met.get(aim, True) else f"! {figure}"

    return _table(
        ["solid", "scenario"],
        titles,
        (
            [
                row.solid,
                row.scenario,
                plain(row.naive_ns),
                *(marked(plain(row.ratios[name]), row, name) for name in engines),
                *(marked(percent(row.shares[name]), row, name) for name in rungs),
            ]
            for row in rows
        ),
    )


def _scalar(rows: Sequence[Any]) -> Table:
    return _table(
        ["rays", "method"],
        ["us/ray", "ratio", "rounded", "undecided", "wrong"],
        (
            [
                f"{row.scenario}, {row.rays}",
                row.method,
                plain(row.us),
                plain(row.ratio),
                *map(str, (row.rounded, row.undecided, row.wrong)),
            ]
            for row in rows
        ),
    )


def _libraries(rows: Sequence[Any]) -> Table:
    return _table(
        ["rays", "hits", "library", "by"],
        ["ns/ray", "ratio", "wrong %", "error"],
        (
            [
                f"{row.cast}, {row.rays}",
                row.question,
                row.library if row.facets is None else f"{row.library}, {row.facets}",
                row.interface,
                plain(row.ns),
                plain(row.ratio),
                percent(row.wrong),
                "-" if row.error is None else f"{row.error:.1e}",
            ]
            for row in rows
        ),
    )


def _solids(rows: Sequence[Any]) -> Table:
    return _table(
        ["size"],
        ["solids", "us/ray planned", "with nothing left out", "ratio", "same"],
        (
            [
                "x".join(map(str, row.size)),
                str(row.solids),
                plain(row.planned_us),
                plain(row.plain_us),
                plain(row.ratio),
                "yes" if row.same else "NO",
            ]
            for row in rows
        ),
    )


_TABLES: dict[str, Callable[[Sequence[Any]], Table]] = {
    "certified": _certified,
    "scalar": _scalar,
    "libraries": _libraries,
    "solids": _solids,
}
