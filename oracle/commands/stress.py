"""`raycert stress`: error against stiffness, one parameter swept at a time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from raycert.cases.interrupts import held, interruptible
from raycert.oracle.commands.measuring import (
    chosen,
    drawing,
    end,
    known,
    ways_options,
    write_files,
    write_rows,
)
from raycert.oracle.commands.options import (
    TARGETS,
    counting,
    repeatable,
    statuses,
    workers_option,
)
from raycert.oracle.reports.foreign import say

if TYPE_CHECKING:
    from rich.console import Console

    from raycert.oracle.measure.curves import Stress
    from raycert.oracle.measure.facets import Sides
    from raycert.oracle.measure.sweeps import Sweep

EPILOG = f"""{TARGETS}
\b
What it says, for example:
    start far from the solid: distance of the start / radius
    method     stable   sound   worst k   wrong
    textbook   to 1e1   all     1.1e+08   4.2%
      cancellation in the discriminant: textbook (1e2)
From 10 radii away the textbook is `stable`; from 100 on it is not, though `sound`
everywhere; at worst k is 1.1e8, and one answer in 24 has a wrong number of pairs.
Started 3 radii before the axis, on the same line, it is right again: so its
discriminant cancels.

\b
Sweeps:
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

One parameter is swept by decades, all else is fixed or drawn; every method answers the same rays. A
method is `stable` to the last step, out from the mild one, where every answer has a strict backward
error k <= 64, `sound` where the squared one has. It breaks for a cause where one change of the
problem that takes one source of error away restores it.

\b
Examples:
  raycert stress --quick
  raycert stress --sweep far --method textbook --method reference
  raycert stress --target './my_tracer -q' --out figures

A step has 24 rays (8 with --quick, which takes each third step), 48 in tilt-* and 192 in start,
where failures are rare. --out writes stress.json, stress.csv and the plots (needs
"raycert[plots]"). Ctrl-C ends the run and keeps what is measured.

{statuses({1: "interrupted", 3: "a target could not be run"})}
"""


@click.command(epilog=EPILOG)
@repeatable("--sweep", "sweeps", "Only this sweep")
@ways_options
@click.option("--quick", is_flag=True, help="Within a minute: each third step, 8 rays.")
@workers_option(2)
@held()
def stress(**options: Any) -> None:
    """Set the error of many ways to answer rays against how stiff the problem is."""
    from raycert.oracle.measure import curves
    from raycert.oracle.measure.catalog import BESIDE, WAYS
    from raycert.oracle.measure.sweeps import SWEEPS

    known("sweep", options["sweeps"], SWEEPS)
    every = BESIDE if options["targets"] else [way.name for way in WAYS if way.stress]
    ways, notes = chosen(options["names"] or every, options["targets"])
    sweeps = tuple(SWEEPS[name] for name in dict.fromkeys(options["sweeps"]) or SWEEPS)
    quick, seed = options["quick"], options["seed"]
    plan = curves.Itinerary(tuple(ways), sweeps, seed, quick, options["workers"])
    with counting("stressing", plan.total) as advance:
        found = curves.measure(plan, advance)
    with counting("finding causes", len(found.broken())) as advance:
        curves.find_causes(found, advance)
    sides = _meshes(found) if not options["sweeps"] and not found.interrupted else []
    _show(found, sides)
    for note in notes:
        say(note)
    written = _write(found, sides, options["out"]) if options["out"] is not None else []
    end(found.interrupted, written)


def _meshes(found: Stress) -> list[Sides]:
    """Return the errors of meshes, as far as the libraries are installed."""
    from raycert.oracle.measure.catalog import WAYS, here
    from raycert.oracle.measure.facets import CASTERS, SIDES, curves

    ways = {way.name: way for way in here(WAYS)[0]}
    try:
        with interruptible(), counting("casting at meshes", len(CASTERS) * len(SIDES)) as advance:
            return curves(ways, found.plan.seed, advance, 512 if found.plan.quick else SIDES[-1])
    except KeyboardInterrupt:
        found.interrupted = True
        return []


def _show(found: Stress, sides: Sequence[Sides]) -> None:
    from raycert.oracle.measure.facets import CASTERS, slope
    from raycert.oracle.reports.screen import screen

    console = screen()
    for sweep in found.plan.sweeps:
        _show_sweep(found, sweep, console)
    for caster in CASTERS:
        if any(one.caster == caster for one in sides):
            say(f"meshes by {caster}: error ~ n^{slope(sides, caster):.2f}")


def _show_sweep(found: Stress, sweep: Sweep, console: Console) -> None:
    """Print who breaks where, and who does not. A method with steps to come is left out."""
    from rich.text import Text

    from raycert.oracle.commands.bench import grid
    from raycert.oracle.measure.ranges import spelled

    lines, whole, exact = [], [], []
    for way in found.plan.ways:
        ranges = found.ranges(sweep, way.name)
        if ranges is None:
            continue
        curve = found.curve(sweep.name, way.name).values()
        worst = f"{max(point.strict for point in curve):.2g}"
        if ranges["exact"].whole:
            exact.append(way.name)
        elif ranges["stable"].whole:
            whole.append(f"{way.name} {worst}")
        else:
            share = sum(p.wrong * p.count for p in curve) / sum(p.count for p in curve)
            levels = (spelled(one, sweep) for one in (ranges["stable"], ranges["sound"]))
            lines.append([way.name, *levels, worst, f"{share:.1%}"])
    if not (lines or whole or exact):
        return
    console.print(Text.assemble((sweep.title, "bold"), f": {sweep.axis}"))
    if lines:
        console.print(grid(("method", "stable", "sound", "worst k", "wrong"), (), lines))
    for line in _causes(found, sweep):
        console.print(f"  {line}")
    for text, names in (
        ("a gross answer could hide in k = 64 on all rays at", _blind(found, sweep)),
        ("stable throughout, worst k:", whole),
        ("exact throughout:", exact),
    ):
        if names:
            console.print(f"{text} {', '.join(names)}")
    console.print()


def _blind(found: Stress, sweep: Sweep) -> list[str]:
    """Return the steps at which no ray is decisive."""
    grounds = found.grounds.get(sweep.name, {})
    return [sweep.text(x) for x in sweep.steps if x in grounds and not grounds[x].decisive]


def _causes(found: Stress, sweep: Sweep) -> list[str]:
    """Return the causes, each with the methods and the steps from which they break."""
    by_text: dict[str, list[str]] = {}
    for way in found.plan.ways:
        steps: dict[str, list[str]] = {}
        for cause in found.causes.get((sweep.name, way.name), []):
            steps.setdefault(cause.text, []).append(sweep.text(cause.step))
        for text, places in steps.items():
            by_text.setdefault(text, []).append(f"{way.name} ({', '.join(places)})")
    return [f"{text}: {', '.join(methods)}" for text, methods in by_text.items()]


def _write(found: Stress, sides: Sequence[Sides], folder: Path) -> list[Path]:
    from raycert.oracle.measure.curves import form, table

    written = write_rows(folder, "stress", form(found, sides), table(found))
    with drawing():
        written += _draw(found, sides, folder)
    return written


def _draw(found: Stress, sides: Sequence[Sides], folder: Path) -> list[Path]:
    """Write the pictures: a few methods each, and the forward errors of the first ones."""
    from raycert.oracle.measure.curves import notes
    from raycert.oracle.plots.stiffness import draw, pages
    from raycert.oracle.plots.style import pictures, styled

    if not found.grounds:
        return []
    written = []
    groups = pages([way.name for way in found.plan.ways])
    for number, names in enumerate(groups, 1):
        with styled():
            drawn = draw(found, names, sides, notes=notes(found, names))
            name = "stress" if number == 1 else f"stress-{number}"
            written += write_files(folder, pictures(drawn, name))
    with styled():
        ulps = draw(found, groups[0], field="ulps")
        written += write_files(folder, pictures(ulps, "stress-ulps"))
    return written
