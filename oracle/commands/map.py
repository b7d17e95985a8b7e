"""`raycert map`: the picture around a case, two of its inputs on the axes."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from json import dumps
from pathlib import Path
from typing import Any

import click

from raycert.cases.formats import FORMATS
from raycert.cases.interrupts import held
from raycert.cases.model import Refused
from raycert.oracle.client.dialogue import Unusable
from raycert.oracle.commands.asking import ONE_CASE, SHAPES, case_options, chosen, count_given
from raycert.oracle.commands.options import (
    FILE,
    TARGETS,
    BadInput,
    OneOf,
    aim,
    counting,
    limits,
    limits_options,
    needs,
    out_option,
    statuses,
    stop,
    target_option,
    write_out,
)
from raycert.oracle.map.legend import summary, to_csv, to_json
from raycert.oracle.map.raster import UNITS, Inputs, Raster
from raycert.oracle.map.sampling import SHOWS, Map, sample
from raycert.oracle.reports.foreign import say

PICTURES, DATA = (".png", ".svg"), (".json", ".csv")
CELLS = 96

EPILOG = f"""{TARGETS}
\b
Inputs are named by their paths: ray.origin[1], solid.radius, solid.q[2],
solid.of[1].center[2]. A direction is a list path=weight,... and moves all of
them at once: ray.origin[0]=1,ray.origin[1]=-1.

\b
In ulps an input moves along the grid of its format, number by number (from 0 in
steps of 2^-53, 2^-24 in binary32); in units and relatively to the nearest
number. Every cell is a real case, answered by the exact oracle.

\b
What is shown:
  exact         the form of the exact answer: pairs, rows of the case table, faces
  answer        the form of what TARGET answers
  k             its backward error: right if every face moves by k roundings
  ulps          its forward error
  disagreement  how it differs: rounded right, faithful, pairs lost, ...
Over all of them curves show where the exact answer changes its form: a double
root, a rim, faces that coincide, a start on a face, a direction parallel to one.

\b
Examples:
  raycert map --cylinder 0,0,0 0,0,2 1 --ray=-3,1,1 1,0,0 \\
      --x ray.origin[1] --y solid.radius --out tangent.png
  raycert map far-grazing/cylinder-tangent-1e8 --x ray.origin[1] --y solid.radius \\
      --unit units --span 1e-7 --show disagreement \\
      --target raycert.oracle.zoo.textbook:textbook --out lost.svg --out lost.csv
  raycert map --case case.json --x ray.origin[0]=1,ray.origin[2]=1 \\
      --y solid.of[1].q[2] --unit units --span 0.5 --out film.png

{statuses({1: "interrupted", 3: "the target could not be run"})}
"""


@click.command(name="map", epilog=EPILOG)
@case_options
@click.option("--x", "x", required=True, metavar="PATHS", help="What moves to the right.")
@click.option("--y", "y", required=True, metavar="PATHS", help="What moves upward.")
@click.option("--span", help="How far on each side.  [half of --cells in ulps, else 1]")
@click.option("--unit", type=OneOf(UNITS), default="ulps", show_default=True)
@click.option(
    "--cells",
    type=click.IntRange(2, 1000),
    default=CELLS,
    show_default=True,
    help="At most about so many on an axis.",
)
@click.option("--show", type=OneOf(SHOWS), help="[exact, or k with --target]")
@target_option("Whose answers are shown, but for --show exact.  [default: reference]")
@out_option(FILE, "A .png, .svg, .json or .csv (repeatable).", "outs", multiple=True, required=True)
@limits_options
@held()
def draw_map(**options: Any) -> None:
    """Draw what surrounds a case: for each cell the exact answer, or how far a target's is right.

    The case is a golden row by its ID, or a solid and a ray by options, or --case, as for explain.
    Ctrl-C keeps the cells that are done: those around the case come first.
    """
    if count_given(options) != 1:
        raise click.UsageError(ONE_CASE)
    writers = [_writer(path) for path in options["outs"]]
    show = options["show"] or ("k" if options["target"] else "exact")
    if show == "exact" and options["target"]:
        raise click.UsageError("--show exact asks no --target")
    found = _sampled(_raster(options), show, options)
    if not found.cells:
        raise click.ClickException("interrupted before a cell was done; nothing was written")
    say("\n".join(summary(found)))
    title, written = _title(options), []
    for path, drawn in zip(options["outs"], writers, strict=True):
        written += [str(path)] if write_out(path, drawn(found, title)) else []
    say(f"wrote {', '.join(written) or 'nothing'}")
    raise SystemExit(0 if found.whole else 1)


def _writer(path: Path) -> Callable[[Map, str], str | bytes]:
    """Return what makes the file of a map under a title; refuse now what cannot be made."""
    suffix = path.suffix.lower()
    if suffix not in (*PICTURES, *DATA):
        known = ", ".join((*PICTURES, *DATA))
        raise click.BadParameter(f"{path}: not one of {known}", param_hint="--out")
    if suffix in PICTURES:
        needs("a picture", "plots", "matplotlib")
        from raycert.oracle.plots.mapping import save

        return lambda found, title: save(found, title, suffix[1:])
    if suffix == ".csv":
        return lambda found, _: to_csv(found)
    return lambda found, _: dumps(to_json(found), indent=1) + "\n"


def _raster(options: dict[str, Any]) -> Raster:
    fmt, cells = FORMATS[options["precision"]], options["cells"]
    usual = str(cells // 2) if options["unit"] == "ulps" else "1"
    case = chosen(options, [])
    inputs = Inputs(case.solid, case.ray, fmt)
    try:
        span = Fraction(options["span"] or usual)
    except (ValueError, ZeroDivisionError):
        raise click.BadParameter("is not a number", param_hint="--span") from None
    try:
        axes = inputs.direction(options["x"]), inputs.direction(options["y"])
        return Raster.of(inputs, axes, options["unit"], span, cells)
    except Refused as refusal:
        raise BadInput(str(refusal)) from None


def _sampled(raster: Raster, show: Any, options: dict[str, Any]) -> Map:
    target = None
    if show != "exact":
        target = aim(options["target"] or ("reference",))
    try:
        return sample(raster, show, target, limits(options), counting)
    except Unusable as error:
        stop(str(error))


def _title(options: dict[str, Any]) -> str:
    if options["id"]:
        return f"Around {options['id']}"
    shape = next((name for name in SHAPES if options[name]), None)
    solid = "solid" if shape is None else shape.replace("_", " ")
    return f"Around a ray and {'an' if solid[0] in 'aeiou' else 'a'} {solid}"
