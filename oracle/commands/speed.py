"""`raycert speed`: what answers cost, beside what others ask for theirs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

SECTIONS = ("certified", "scalar", "libraries", "solids")
EPILOG = """\b
Sections:
  certified   the batch oracle through numba and NumPy, beside the naive float64 formula
  scalar      the oracle a ray at a time, beside SymPy, mpmath and python-flint's arb
  libraries   the batched reference tracer beside raysect, MuJoCo, trimesh with Embree
  solids      the cost of a ray against the number of solids, 1 to 1,000

All ways of a section answer the same rays in one run, in turn, on one thread; the least processor
time of each counts, so that other work on the machine hurts little. Every answer is held against
the exact one. What is not installed is named and left out.

\b
Examples:
  raycert speed --quick
  raycert speed --only certified --only scalar --json speed.json

Exit status: 0 done, 1 interrupted, 2 bad usage, 3 NumPy is missing.
"""


@click.command(epilog=EPILOG)
@click.option(
    "--only", multiple=True, type=click.Choice(SECTIONS), help="Only this section (repeatable)."
)
@click.option("--quick", is_flag=True, help="Within a minute: fewer rays, at most 100 solids.")
@click.option(
    "--seed",
    default=1,
    show_default=True,
    type=click.IntRange(min=0),
    help="What the rays are drawn from.",
)
@click.option(
    "--json",
    "file",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Write the rows there.",
)
def speed(only: tuple[str, ...], quick: bool, seed: int, file: Path | None) -> None:
    """Measure what certainty costs, as ratios of one run."""
    measure(only, quick, seed, file)


def measure(only: Sequence[str], quick: bool, seed: int, file: Path | None) -> None:
    """Run the sections named, all without one; print the tables, and write the rows to a file."""
    from raycert.oracle.commands.options import check_writable, counting
    from raycert.oracle.measure.speed.clock import one_thread

    one_thread()
    _needs_numpy()
    if file is not None:
        check_writable(file.parent, "--json")
    from raycert.oracle.measure.speed.run import FULL, QUICK, run, steps

    effort = QUICK if quick else FULL
    sections = [name for name in SECTIONS if name in (only or SECTIONS)]
    with counting("measuring", steps(sections, effort)) as advance:
        report = run(sections, effort, seed, advance)
    from rich.console import Console

    from raycert.oracle.measure.speed.tables import show

    show(report, Console())
    if file is not None:
        import json

        file.write_text(json.dumps(report.as_json(), indent=1) + "\n", encoding="ascii")
        click.echo(f"wrote {file}")
    if report.interrupted:
        click.echo("raycert: interrupted; this is what was measured by then", err=True)
        raise SystemExit(1)


def _needs_numpy() -> None:
    from importlib.util import find_spec

    if find_spec("numpy") is None:
        click.echo('raycert: numpy missing: pip install "raycert[speed]"', err=True)
        raise SystemExit(3)
