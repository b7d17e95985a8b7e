"""`raycert stress`: error against stiffness, one parameter swept at a time."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console

    from raycert.oracle.measure.methods.method import Method
    from raycert.oracle.measure.stress.run import Report
    from raycert.oracle.measure.stress.sagitta import Sides
    from raycert.oracle.measure.stress.sweeps import Sweep

BESIDE = ("reference", "textbook", "oracle")
"""What a client is set beside if no method is named."""
HELP = """Set the error of many ways to answer rays against how stiff the problem is.

One parameter is swept by decades, all else is fixed or drawn; every method answers the same rays.
Told for each method and sweep: the range of steps in which every answer is `stable` (strict
backward error k <= 64) and `sound` (squared), and why it breaks there, where one change of the
problem that takes one source of error away restores it.

\b
SWEEPS
  far          distance of the start / radius, 1 to 1e16
  displaced    distance of the scene from the coordinate origin / radius, 1 to 1e15
  thin         radius / height, 1e-15 (needle) to 1e15 (disk)
  tilt-wall    angle to the axis, 1 to 1e-17 rad, from near the wall
  tilt-axis    the same from far up the axis
  gap-inside   gap to tangency / radius, 1 to 2^-53; gap-outside: the same beyond it
  start        distance of the start from the wall / radius, 1 to 2^-53 and 0
  faces        distance between faces of a Boolean, 1 to 2^-53 and 0
  speed        length of the direction, 2^-1000 to 2^1000
  scale        size of the scene, 2^-1000 to 2^1000
  hard         distance of an end from a tie of two doubles, 2^-20 to 2^-1000

\b
Examples:
  raycert stress --quick
  raycert stress --sweep far --method textbook --method reference
  raycert stress --client './my_tracer --json' --out figures

A step has 24 rays (8 with --quick, which takes each third step), 48 in tilt-* and 192 in start,
where failures are rare. --out writes stress.json, stress.csv and the plots (needs ".[plots]").
Ctrl-C ends the run and keeps what is measured.

Exit status: 0 done, 1 interrupted, 2 bad usage, 3 a client could not be run.
"""


@click.command(help=HELP)
@click.option("--sweep", "sweeps", multiple=True, help="Only this (repeatable).")
@click.option("--method", "names", multiple=True, help="Only this method (repeatable).")
@click.option(
    "--client", "clients", multiple=True, metavar="CMD", help="This program too (repeatable)."
)
@click.option("--quick", is_flag=True, help="Within a minute: each third step, 8 rays.")
@click.option("--seed", default=1, show_default=True, help="What the rays are drawn from.")
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write the rows and the plots there.",
)
@click.option("--workers", type=click.IntRange(min=1), default=2, show_default=True)
def stress(**options: Any) -> None:
    """Set the error of many ways to answer rays against how stiff the problem is."""
    from raycert.oracle.commands.options import check_writable, counting
    from raycert.oracle.measure.stress.run import Plan, causes_to_tell, measure, tell_causes

    sweeps = _sweeps(options["sweeps"])
    if options["out"] is not None:
        check_writable(options["out"], "--out")
    methods, notes = _methods(options["names"], options["clients"])
    plan = Plan(tuple(methods), sweeps, options["seed"], options["quick"], options["workers"])
    with counting("stressing", plan.total) as advance:
        report = measure(plan, advance)
    with counting("telling causes", causes_to_tell(report)) as advance:
        tell_causes(report, advance)
    sides = _meshes(report) if not options["sweeps"] and not report.interrupted else []
    _show(report, sides)
    for note in notes:
        click.echo(note)
    if options["out"] is not None:
        _write(report, sides, options["out"])
    if report.interrupted:
        click.echo("raycert: interrupted; this is what was measured by then", err=True)
        raise SystemExit(1)


def _sweeps(names: Sequence[str]) -> tuple[Sweep, ...]:
    from raycert.oracle.measure.stress.sweeps import SWEEPS

    for name in names:
        if name not in SWEEPS:
            raise click.BadParameter(
                f"{name!r} is none of {', '.join(SWEEPS)}", param_hint="--sweep"
            )
    return tuple(SWEEPS[name] for name in dict.fromkeys(names) or SWEEPS)


def _methods(names: Sequence[str], clients: Sequence[str]) -> tuple[list[Method], list[str]]:
    """Return the methods to run, and notes on those that cannot."""
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.commands.options import stop
    from raycert.oracle.measure.methods.catalog import BY_NAME, METHODS, chosen, here

    for name in names:
        if name not in BY_NAME:
            hint = "raycert bench --list shows all"
            raise click.BadParameter(f"there is no {name!r}; {hint}", param_hint="--method")
    if not names:
        names = BESIDE if clients else [method.name for method in METHODS if method.stress]
    try:
        return here(chosen(tuple(names), [shlex.split(words) for words in clients]))
    except Unusable as error:
        stop(str(error))


def _meshes(report: Report) -> list[Sides]:
    """Return the errors of meshes, as far as the libraries are installed."""
    from raycert.oracle.commands.options import counting
    from raycert.oracle.measure.methods.catalog import SIDES
    from raycert.oracle.measure.stress.sagitta import CASTERS, curves

    most = 512 if report.plan.quick else SIDES[-1]
    try:
        with counting("casting at meshes", len(CASTERS) * len(SIDES)) as advance:
            return curves(report.plan.seed, advance, most)
    except KeyboardInterrupt:
        report.interrupted = True
        return []


def _show(report: Report, sides: Sequence[Sides]) -> None:
    from rich.console import Console

    from raycert.oracle.measure.stress.sagitta import CASTERS, slope

    console = Console(highlight=False)
    for sweep in report.plan.sweeps:
        _show_sweep(report, sweep, console)
    for caster in CASTERS:
        if any(one.caster == caster for one in sides):
            click.echo(f"meshes by {caster}: error ~ n^{slope(sides, caster):.2f}")


def _show_sweep(report: Report, sweep: Sweep, console: Console) -> None:
    """Print who breaks where, and who does not. A method with steps to come is left out."""
    from rich.table import Table

    from raycert.oracle.measure.stress.ranges import spelled

    grid = Table(box=None, pad_edge=False)
    for heading in ("method", "stable", "sound", "worst k", "wrong"):
        grid.add_column(heading, no_wrap=True)
    whole: list[str] = []
    exact: list[str] = []
    for method in report.plan.methods:
        ranges = report.ranges(sweep, method.name)
        if ranges is None:
            continue
        curve = report.curve(sweep.name, method.name).values()
        worst = max(point.strict for point in curve)
        if ranges.exact.whole:
            exact.append(method.name)
        elif ranges.stable.whole:
            whole.append(f"{method.name} {worst:.2g}")
        else:
            share = sum(p.wrong * p.count for p in curve) / sum(p.count for p in curve)
            levels = (spelled(found, sweep) for found in (ranges.stable, ranges.sound))
            grid.add_row(method.name, *levels, f"{worst:.2g}", f"{share:.1%}")
    if not (grid.row_count or whole or exact):
        return
    console.print(f"[bold]{sweep.title}[/bold]: {sweep.axis}")
    if grid.row_count:
        console.print(grid)
    for line in _causes(report, sweep):
        console.print(f"  {line}")
    if blind := _blind(report, sweep):
        console.print(f"a gross answer could hide in k = 64 on all rays at {', '.join(blind)}")
    if whole:
        console.print(f"stable throughout, worst k: {', '.join(whole)}")
    if exact:
        console.print(f"exact throughout: {', '.join(exact)}")
    console.print()


def _blind(report: Report, sweep: Sweep) -> list[str]:
    """Return the steps at which no ray is decisive."""
    grounds = report.grounds.get(sweep.name, {})
    return [sweep.text(x) for x in sweep.steps if x in grounds and not grounds[x].decisive]


def _causes(report: Report, sweep: Sweep) -> list[str]:
    """Return the causes, each with the methods and the steps from which they break."""
    told: dict[str, list[str]] = {}
    for method in report.plan.methods:
        steps: dict[str, list[str]] = {}
        for cause in report.causes.get((sweep.name, method.name), []):
            steps.setdefault(cause.text, []).append(sweep.text(cause.step))
        for text, places in steps.items():
            told.setdefault(text, []).append(f"{method.name} ({', '.join(places)})")
    return [f"{text}: {', '.join(methods)}" for text, methods in told.items()]


def _write(report: Report, sides: Sequence[Sides], folder: Path) -> None:
    import json

    from raycert.oracle.measure.stress.report import form, table

    written = [folder / "stress.json", folder / "stress.csv"]
    written[0].write_text(json.dumps(form(report, sides), indent=1, allow_nan=False) + "\n")
    written[1].write_text(table(report))
    try:
        written += _draw(report, sides, folder)
    except ModuleNotFoundError as absent:
        if absent.name != "matplotlib":
            raise
        click.echo('no plots without matplotlib: pip install "raycert[plots]"', err=True)
    for path in written:
        click.echo(f"wrote {path}")


def _draw(report: Report, sides: Sequence[Sides], folder: Path) -> list[Path]:
    """Write the pictures: a few methods each, and the forward errors of the first ones."""
    from raycert.oracle.measure.stress.report import notes
    from raycert.oracle.plots.style import save, styled
    from raycert.oracle.plots.sweeps import draw, pages

    if not report.grounds:
        return []
    written = []
    groups = pages([method.name for method in report.plan.methods])
    for number, names in enumerate(groups, 1):
        with styled():
            drawn = draw(report, names, sides, notes=notes(report, names))
            written += save(drawn, folder, "stress" if number == 1 else f"stress-{number}")
    with styled():
        written += save(draw(report, groups[0], field="ulps"), folder, "stress-ulps")
    return written
