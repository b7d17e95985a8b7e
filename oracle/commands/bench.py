"""`raycert bench`: time per ray of several ways to answer the same rays, as ratios from one run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from oracle.benchmark import Timing


@click.command()
@click.option(
    "--rays",
    type=click.IntRange(min=1),
    default=100,
    show_default=True,
    help="Rays that every method answers.",
)
@click.option("--commands", is_flag=True, help="Time whole commands too; takes about a minute.")
def bench(rays: int, commands: bool) -> None:
    """Time the oracle beside other ways to answer the same rays against a capped cylinder.

    Only the ratios mean much: machines differ, and are noisy. SymPy's cache is cleared before each
    pass; `exact` counts the rays whose both endpoints come out correctly rounded.
    """
    from oracle.benchmark import COMMANDS, command, methods, race, scenes
    from oracle.commands.progress import counting

    with counting("timing") as advance:
        timings = race(list(methods()), scenes(rays))
        advance()
    _rays(timings, rays)
    if commands:
        with counting("timing", len(COMMANDS)) as advance:
            rows = []
            for line, repeats in COMMANDS:
                rows.append(command(line, repeats))
                advance()
        _commands(rows)


def _rays(timings: list[Timing], rays: int) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    table.add_column("method", no_wrap=True)
    for name in ("us/ray", "median", "ratio", "exact"):
        table.add_column(name, justify="right")
    first = timings[0].best
    for t in timings:
        figures = f"{t.best * 1e6:.1f}", f"{t.median * 1e6:.1f}", f"{t.best / first:.3g}"
        table.add_row(t.name, *figures, f"{t.exact}/{rays}")
    Console().print(table)


def _commands(timings: list[Timing]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    table.add_column("\ncommand")
    table.add_column("\nseconds", justify="right")
    for timing in timings:
        table.add_row(timing.name, f"{timing.best:.2f}")
    Console().print(table)
