"""`raycert bench`: what answers cost, and how wrong they are, on the same rays in one run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import isinf
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from raycert.cases.interrupts import held
from raycert.oracle.commands.measuring import (
    chosen,
    drawing,
    end,
    known,
    ways_options,
    write_files,
    write_rows,
)
from raycert.oracle.commands.options import TARGETS, OneOf, counting, needs, repeatable, statuses

if TYPE_CHECKING:
    from rich.table import Table

    from raycert.oracle.measure.errors import Spread
    from raycert.oracle.measure.files import Report
    from raycert.oracle.measure.race import Figures

SECTIONS = {
    "methods": "error against run time, of all ways to answer rays",
    "scalar": "one ray at a time: the oracle beside SymPy, mpmath, python-flint's arb",
    "batch": "the batch oracle through numba and NumPy, beside the naive float64 formula",
    "libraries": "the batched reference tracer beside raysect, MuJoCo, trimesh with Embree",
    "scenes": "the cost of a ray against the number of solids, 1 to 1,000",
    "pipe": "clients asked through the harness, beside the same clients alone",
    "commands": "whole commands of raycert, start-up included",
}
QUICKLY = ("random", "far", "tilted", "ties")
"""The scenarios of `--quick`, if none are named."""
WIDTH = 108
"""What a table takes: in a narrower terminal its lines wrap, and no figure is cut."""
QUICK_SIDES = ("8", "64", "512")
LEGEND = """
* on the front of time and p99 of ulps, of single rays or of batches. ratio: time over the oracle's.
ulps: median and p99 of the rays whose pairs are right in number. k, squared: p99 of a sample.
rounded: lists that are exact. lost: pairs missed + phantom pairs + rays without an answer.
"""
EPILOG = """{targets}
\b
What a row says, for example of
    method      us/ray  ...  ratio  ulps  p99     k p99   squared  rounded  lost
    textbook     4.1         0.08   95    1.2e7   2.1e6   6        12       3 + 0 + 0
A ray takes 4.1 microseconds, a twelfth of the oracle's time. In 99 of 100 rays
the worst end is within 1.2e7 roundings of the exact one, and the answer is right
for a solid whose faces are moved by 2.1e6 roundings (k; `stable` allows 64). By
the looser squared measure 6 are enough: `sound`. Three pairs are missed.

\b
Sections (--section; the first alone if none is named):
{sections}

\b
Scenarios of the section methods:
  random  far  thin  tilted  tangent  rim  tiny  huge  boolean  axis-aligned  touching
  ties    t within 2^-60 to 2^-1000 of the middle of two doubles

All ways of a section answer the same rays, pass by pass in turn; the least processor time of each
counts (of programs, that on the wall), and only ratios travel to another machine. A batch is priced
at thousands of rays a call, and by its arrays alone. A client's time is what it takes over the
pipe. What is not installed is named and left out. Ctrl-C ends the run and keeps what is measured.

\b
Examples:
  raycert bench --quick
  raycert bench --scenario far --out figures
  raycert bench --method reference --target './my_tracer -q' --target my_module:intersect
  raycert bench --section batch --section libraries --out figures

--out writes bench.json, bench.csv and a plot of each scenario (needs "raycert[plots]").

{statuses}
""".format(
    targets=TARGETS,
    sections="\n".join(f"  {name:10}  {text}" for name, text in SECTIONS.items()),
    statuses=statuses({1: "interrupted", 3: "a target could not be run, or a package is missing"}),
)


@click.command(epilog=EPILOG)
@repeatable("--section", "sections", "Only this section", type=OneOf(SECTIONS))
@repeatable("--scenario", "scenarios", "Only this scenario")
@ways_options
@click.option("--quick", is_flag=True, help="Within a minute: few rays, four scenarios.")
@click.option("--rays", type=click.IntRange(min=4), help="Rays of a scenario.")
@click.option("--list", "listing", is_flag=True, help="List sections and methods, and end.")
@held()
def bench(**options: Any) -> None:
    """Set the error of many ways to answer rays against their time per ray."""
    if options["listing"]:
        _list()
        return
    sections = dict.fromkeys(options["sections"] or ("methods",))
    report = run([name for name in SECTIONS if name in sections], options)
    _show(report)
    written = _write(report, options["out"]) if options["out"] is not None else []
    end(report.interrupted, written)


def run(sections: Sequence[str], options: dict[str, Any]) -> Report:
    """Return what the sections measure. Bad usage is refused before any work."""
    from raycert.oracle.measure.clock import one_thread

    one_thread()
    from raycert.oracle.measure import race
    from raycert.oracle.measure import sections as tables
    from raycert.oracle.measure.files import FULL, QUICK, Report
    from raycert.oracle.measure.rays import SETS

    known("scenario", options["scenarios"], SETS)
    for name in sections:
        _check_needs(name)
    effort = QUICK if options["quick"] else FULL
    rays = options["rays"] or effort.rays
    report = Report(options["seed"], replace(effort, rays=rays))
    for name in sections:
        if report.interrupted:
            break
        if name == "methods":
            sets = options["scenarios"] or (QUICKLY if options["quick"] else tuple(SETS))
            ways, notes = chosen(options["names"], options["targets"])
            if options["quick"] and not options["names"]:
                ways = [way for way in ways if way.precision != "mesh" or _is_quick(way.name)]
            report.notes += notes
            with counting("measuring", race.steps(sets, ways, report.effort)) as advance:
                race.run(sets, ways, report, advance)
            continue
        with counting(name, tables.steps(name, report.effort)) as advance:
            tables.run(name, report, advance)
    return report


def _is_quick(mesh: str) -> bool:
    return mesh.rpartition("-")[2] in QUICK_SIDES


def _check_needs(name: str) -> None:
    from raycert.oracle.measure.sections import SECTIONS

    if name in SECTIONS:
        needs(f"--section {name}", "speed", *SECTIONS[name].needs)


def _list() -> None:
    from raycert.oracle.measure.catalog import WAYS
    from raycert.oracle.reports.screen import screen

    ways = [(way.name, way.precision, way.does) for way in WAYS]
    screen().print(grid(("section", "shows"), (), list(SECTIONS.items())))
    screen().print(grid(("\nmethod", "\nfamily", "\na method that"), (), ways, wrap=True))


def grid(
    words: Sequence[str], figures: Sequence[str], rows: Sequence[Sequence[str]], wrap: bool = False
) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for title in words:
        table.add_column(title, no_wrap=not wrap)
    for title in figures:
        table.add_column(title, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    return table


def _show(report: Report) -> None:
    from rich.text import Text

    from raycert.oracle.measure import sections as tables
    from raycert.oracle.measure.files import place
    from raycert.oracle.reports.screen import screen

    console = screen(width=max(screen().width, WIDTH))
    for name, rows in report.sections.items():
        if name not in tables.SECTIONS:
            _show_race(name, rows, report.seed, console)
            continue
        section = tables.SECTIONS[name]
        console.print(Text.assemble("\n", (name, "bold"), f": {SECTIONS[name]}"))
        columns = (*section.words, *section.figures)
        lines = [[spell(row) for _, spell in columns] for row in rows]
        words, figures = ([title for title, _ in x] for x in (section.words, section.figures))
        console.print(grid(words, figures, lines))
        console.print(section.legend)
    console.print()
    for note in report.notes:
        console.print(note)
    console.print(place(report.seed))


def _show_race(name: str, rows: Sequence[Figures], seed: int, console: Any) -> None:
    from rich.text import Text

    for scenario in dict.fromkeys(row.scenario for row in rows):
        some = [row for row in rows if row.scenario == scenario]
        lead = "" if name == "methods" else f"{name}, "
        rays = f": {some[0].rays} rays, seed {seed}"
        console.print(Text.assemble("\n", (f"{lead}{scenario}", "bold"), rays))
        times = ("us/ray", "median", "iqr", "ratio")
        errors = ("ulps", "p99", "k p99", "squared", "rounded", "lost")
        console.print(grid(("method",), times + errors, [_line(row) for row in some]))
    console.print(LEGEND)


def _line(row: Figures) -> list[str]:
    return [
        ("*" if row.front else " ") + row.way.name,
        *(short(x * 1e6) for x in (row.time.best, row.time.median, row.time.iqr)),
        "" if row.ratio is None else short(row.ratio),
        _figure(row.ulps_counted, "median"),
        _figure(row.ulps_counted, "p99"),
        _figure(row.strict, "p99"),
        _figure(row.squared, "p99"),
        str(row.exact),
        f"{row.missed} + {row.phantom} + {row.failures}" if row.lost else "",
    ]


def _figure(spread: Spread | None, name: str) -> str:
    return "-" if spread is None else short(getattr(spread, name))


def short(x: float) -> str:
    """Return a figure in at most six characters: 0.021, 1.5, 312, 1.1e8."""
    if x == 0 or 0.001 <= x < 9999.5 or isinf(x):
        return f"{x:.2g}" if x < 10 else f"{x:.0f}"
    mantissa, _, power = f"{x:.1e}".partition("e")
    return f"{mantissa}e{int(power)}"


def _write(report: Report, folder: Path) -> list[Path]:
    """Write the rows, and a plot of each scenario; return the paths."""
    from raycert.oracle.measure.files import as_csv, place

    table = as_csv(report.sections.get("methods", ()))
    written = write_rows(folder, "bench", report.as_json(), table)
    with drawing():
        from raycert.oracle.plots.pareto import draw
        from raycert.oracle.plots.style import pictures, styled

        for name in report.sets():
            rows = report.rows(name)
            with styled():
                drawn = draw(rows, f"{rows[0].rays} rays, {place(report.seed)}")
                written += write_files(folder, pictures(drawn, f"bench-{name}"))
    return written
