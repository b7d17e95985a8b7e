"""`raycert bench`: error against run time, all methods on the same rays in one run."""

from __future__ import annotations

import shlex
from math import isinf
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from raycert.oracle.measure.bench.commands import Whole
    from raycert.oracle.measure.bench.errors import Spread
    from raycert.oracle.measure.bench.rows import Row
    from raycert.oracle.measure.bench.run import Report
    from raycert.oracle.measure.methods.method import Method

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
HELP = """Set the error of many ways to answer rays against their time per ray.

All methods answer the same rays in one run, pass by pass in turn; only ratios of times travel to
another machine. Errors are against the exact answer: forward in ulps of the worst end, backward as
the k of `certify` (a sample of the rays), and the rays that are lost: with another number of pairs
than there is, or no answer. `rounded` counts the rays whose list is the correctly rounded one.

\b
SCENARIOS
  random  far  thin  tilted  tangent  rim  tiny  huge  boolean
  ties    t within 2^-60 to 2^-1000 of the middle of two doubles

\b
Examples:
  raycert bench --quick
  raycert bench --scenario far --out figures
  raycert bench --method reference --client './my_tracer --json' --client my.module:intersect

A batch (reference-batch, numpy-*, double-double, oracle-batch, meshes) is priced at thousands of
rays a call, and by its arrays alone. A client's time is what it takes over the pipe. --out writes
bench.json, bench.csv and a plot of each scenario (needs ".[plots]"). Ctrl-C ends the run and keeps
what is measured.

Exit status: 0 done, 1 interrupted, 2 bad usage, 3 a client could not be run.
"""


@click.command(help=HELP)
@click.option("--scenario", "scenarios", multiple=True, help="Only this (repeatable).")
@click.option("--method", "names", multiple=True, help="Only this method (repeatable).")
@click.option(
    "--client", "clients", multiple=True, metavar="CMD", help="This program too (repeatable)."
)
@click.option("--quick", is_flag=True, help="Within a minute: few rays, four scenarios.")
@click.option("--rays", type=click.IntRange(min=4), help="Rays of a scenario.")
@click.option("--seed", default=1, show_default=True, help="What the rays are drawn from.")
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write the rows and the plots there.",
)
@click.option("--commands", is_flag=True, help="Time whole commands of raycert as well.")
@click.option("--list", "listing", is_flag=True, help="List the methods and end.")
def bench(**options: Any) -> None:
    """Set the error of many ways to answer rays against their time per ray."""
    if options["listing"]:
        _list()
        return
    from raycert.oracle.commands.options import check_writable, counting
    from raycert.oracle.measure.bench.run import run, steps

    scenarios = _scenarios(options)
    if options["out"] is not None:
        check_writable(options["out"], "--out")
    methods, notes = _methods(options)
    effort = _effort(options)
    with counting("measuring", steps(scenarios, methods, effort)) as advance:
        report = run(scenarios, methods, effort, options["seed"], advance)
    report.notes[:0] = notes
    _show(report)
    if options["out"] is not None:
        _write(report, options["out"])
    if report.interrupted:
        click.echo("raycert: interrupted; this is what was measured by then", err=True)
        raise SystemExit(1)
    if options["commands"]:
        _time_commands()


def _scenarios(options: dict[str, Any]) -> list[str]:
    from raycert.oracle.measure.bench.scenarios import SCENARIOS

    for name in options["scenarios"]:
        if name not in SCENARIOS:
            raise click.BadParameter(
                f"{name!r} is none of {', '.join(SCENARIOS)}", param_hint="--scenario"
            )
    return list(options["scenarios"] or (QUICKLY if options["quick"] else SCENARIOS))


def _effort(options: dict[str, Any]) -> Any:
    from dataclasses import replace

    from raycert.oracle.measure.bench.run import FULL, QUICK

    effort = QUICK if options["quick"] else FULL
    return effort if options["rays"] is None else replace(effort, rays=options["rays"])


def _methods(options: dict[str, Any]) -> tuple[list[Method], list[str]]:
    """Return the methods to run, and notes on those that cannot."""
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.commands.options import stop
    from raycert.oracle.measure.methods.catalog import BY_NAME, chosen, here

    for name in options["names"]:
        if name not in BY_NAME:
            hint = "raycert bench --list shows all"
            raise click.BadParameter(f"there is no {name!r}; {hint}", param_hint="--method")
    try:
        found = chosen(options["names"], [_words(client) for client in options["clients"]])
    except Unusable as error:
        stop(str(error))
    if options["quick"] and not options["names"]:
        found = [m for m in found if m.family != "mesh" or _sides(m) in QUICK_SIDES]
    return here(found)


def _words(client: str) -> list[str]:
    try:
        words = shlex.split(client)
    except ValueError as error:
        raise click.BadParameter(f"{client!r}: {error}", param_hint="--client") from None
    if not words:
        raise click.BadParameter("names no program", param_hint="--client")
    return words


def _sides(method: Method) -> str:
    return method.name.rpartition("-")[2]


def _list() -> None:
    from rich.console import Console
    from rich.table import Table

    from raycert.oracle.measure.methods.catalog import METHODS

    table = Table("method", "family", "a method that", box=None, pad_edge=False)
    for method in METHODS:
        table.add_row(method.name, method.family, method.does)
    Console().print(table)


def _show(report: Report) -> None:
    from rich.console import Console

    console = Console(width=max(Console().width, WIDTH))
    for name in report.scenarios:
        rows = report.of(name)
        console.print(f"\n[bold]{name}[/]: {rows[0].rays} rays, seed {report.seed}")
        console.print(_table(rows))
    console.print(LEGEND, markup=False)
    for note in report.notes:
        console.print(note, markup=False)


def _table(rows: list[Row]) -> Any:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    table.add_column("method", no_wrap=True)
    for title in ("us/ray", "median", "iqr", "ratio", "ulps", "p99", "k p99", "squared", "rounded"):
        table.add_column(title, justify="right", no_wrap=True)
    table.add_column("lost", justify="right", no_wrap=True)
    for r in rows:
        times = (r.time.best, r.time.median, r.time.iqr)
        table.add_row(
            ("*" if r.front else " ") + r.method.name,
            *(plain(x * 1e6) for x in times),
            "" if r.ratio is None else plain(r.ratio),
            _figure(r.ulps_counted, "median"),
            _figure(r.ulps_counted, "p99"),
            _figure(r.strict, "p99"),
            _figure(r.squared, "p99"),
            str(r.exact),
            _lost(r),
        )
    return table


def _figure(spread: Spread | None, name: str) -> str:
    return "-" if spread is None else plain(getattr(spread, name))


def plain(x: float) -> str:
    """Return a figure in at most six characters: 0.021, 1.5, 312, 1.1e8."""
    if x == 0 or 0.001 <= x < 9999.5 or isinf(x):
        return f"{x:.2g}" if x < 10 else f"{x:.0f}"
    mantissa, _, power = f"{x:.1e}".partition("e")
    return f"{mantissa}e{int(power)}"


def _lost(r: Row) -> str:
    """Return what is lost: pairs missed, pairs that are not there, rays without an answer."""
    return f"{r.missed} + {r.phantom} + {r.failures}" if r.lost else ""


def _write(report: Report, folder: Path) -> None:
    from raycert.oracle.measure.bench.files import write

    paths, troubles = write(report, folder)
    for path in paths:
        click.echo(f"wrote {path}")
    for trouble in troubles:
        click.echo(f"raycert: {trouble}", err=True)


def _time_commands() -> None:
    from raycert.oracle.commands.options import counting
    from raycert.oracle.measure.bench.commands import COMMANDS, command

    rows: list[Whole] = []
    with counting("timing", len(COMMANDS)) as advance:
        for line, repeats in COMMANDS:
            rows.append(command(line, repeats))
            advance()
    for whole in rows:
        click.echo(f"{whole.best:8.2f} s  {whole.name}")
