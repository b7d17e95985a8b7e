"""`raycert render`: a scene through the reference tracer, to a PNG."""

from __future__ import annotations

import time
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from raycert.oracle.commands.options import (
    FILE,
    BadInput,
    OneOf,
    counting,
    needs,
    out_option,
    repeatable,
    statuses,
    write_out,
)
from raycert.oracle.commands.scenes import answer, read, scene_argument, start
from raycert.oracle.reports.foreign import say

if TYPE_CHECKING:
    from raycert.cases.scene import Scene

SHOWS = ("depth", "normal", "thickness", "count", "error")
BOUND = 64
"""The k that the level `stable` allows."""

STATUSES = {
    1: "an error is above 64, the bound of the level stable",
    3: "a package is missing, or the tracer failed",
}
EPILOG = """\b
What is shown:
  depth      the distance along the ray to the first hit
  normal     the outward normal there, x y z as red green blue
  thickness  the total length inside the solid, which only interval lists give
  count      how many intervals the ray has
  error      k, the backward error of each pixel's list, judged by the exact oracle:
             the list is right for the solid with its faces moved by k roundings

\b
Examples:
  raycert render --list
  raycert render die
  raycert render pipe --show thickness -o pipe.png
  raycert render cylinder --show error --size 160x120
  raycert render far --show error --size 160x120 --method textbook
  raycert render far --pixel 48,75 | raycert explain --case -

\b
A scene of your own:
  {"solids": {"ball": {"type": "sphere", "center": [0, 0, 0], "radius": 1}},
   "camera": {"type": "perspective", "eye": [3, -4, 2], "look_at": [0, 0, 0],
              "up": [0, 0, 1], "fov": 40},
   "size": [640, 480]}
An orthographic camera has "height", what it sees from bottom to top, in place of
the vertical angle "fov" in degrees.

""" + statuses(STATUSES)


@click.command(epilog=EPILOG)
@scene_argument
@out_option(FILE, "The PNG.  [SCENE-SHOW.png]")
@click.option("--show", type=OneOf(SHOWS), default="depth", show_default=True)
@click.option("--size", metavar="WxH", help="Pixels, in place of the scene's size.")
@click.option(
    "--method",
    type=OneOf(("reference", "textbook")),
    default="reference",
    show_default=True,
    help="textbook: b^2 - a c in plain doubles, to see what it loses.",
)
@repeatable("--off", "off", "Leave this item of the plan off")
@click.option("--pixel", metavar="X,Y", help="Print this pixel's solid and ray, as JSON.")
@click.option("--list", "listed", is_flag=True, help="List the scenes that come with raycert.")
def render(scene: str | None, out: Path | None, **options: Any) -> None:
    """Render SCENE, a file or the name of a scene that comes with raycert, to a PNG.

    The rays go through the reference tracer, in batches, with the bits of the scalar one. Below
    the picture a strip says what its colours mean; one line tells the hits, the extremes, the
    time, and what the plan left out (see: raycert plan).

    --show error judges every pixel's list exactly and says which pixel is worst; start with
    --size 160x120.
    """
    if options["listed"]:
        _list()
        return
    read_scene, name = read(scene, options["size"])
    if options["pixel"]:
        say(_pixel(read_scene, options["pixel"]))
        return
    needs("render", "plots", "numpy", "PIL")
    out = out or FILE.convert(f"{name}-{options['show']}.png", None, None)
    raise SystemExit(_render(read_scene, scene or "", out, options))


def _list() -> None:
    from rich.table import Table

    from raycert.cases.scene import load, shipped
    from raycert.oracle.reports.screen import screen

    grid = Table(box=None, pad_edge=False, show_header=False)
    grid.add_column(no_wrap=True)
    for name in shipped():
        grid.add_row(name, load(name).about)
    screen().print(grid)


def _render(scene: Scene, source: str, out: Path, options: dict[str, Any]) -> int:
    show, tracer, size = options["show"], options["method"], options["size"]
    began = time.perf_counter()
    at_work = start(scene, "lists" if show == "error" else show, tracer, options["off"])
    # The tracer runs in a process of its own while the picture's packages are loaded here.
    import numpy as np

    from raycert.oracle.plots.heatmap import extremes, of_scene, png, shown

    arrays, about = answer(at_work)
    rows = _errors(scene, arrays) if show == "error" else []
    values = np.array(rows) if rows else arrays["values"]
    width, height = scene.size
    words = [f"{width}x{height}", f"{about['hits']} of {width * height} rays hit"]
    if show != "normal" and (ends := extremes(values)):
        words.append(f"{show} {shown(ends[0], *ends)} to {shown(ends[1], *ends)}")
    say(f"{out}: {', '.join(words)}, {time.perf_counter() - began:.2f} s")
    say(f"left out: {', '.join(about['left_out']) or 'nothing'}")
    status = _print_errors(rows, f"{source} --size {size}" if size else source) if rows else 0
    write_out(out, png(of_scene(values, show, ", textbook" if tracer == "textbook" else "")))
    return status


def _errors(scene: Scene, arrays: dict[str, Any]) -> list[list[float]]:
    """Return k of every pixel, row by row, judged in two processes."""
    from raycert.oracle.judge.pixels import every_row

    columns = (arrays[name].tolist() for name in ("enter", "leave", "count"))
    answers = [list(zip(a[:n], b[:n], strict=True)) for a, b, n in zip(*columns, strict=True)]
    rows = []
    with counting("judging", scene.size[1]) as advance:
        for row in every_row(scene, answers):
            rows.append(row)
            advance()
    return rows


def _print_errors(rows: list[list[float]], source: str) -> int:
    """Print the largest k and its pixel; return 1 if it is beyond the bound of `stable`."""
    every = [(k, x, y) for y, row in enumerate(rows) for x, k in enumerate(row)]
    worst, x, y = max(every, key=itemgetter(0))
    above = [sum(k > bound for k, _, _ in every) for bound in (1, BOUND)]
    say(f"k at most {worst:.4g}; pixels above 1: {above[0]}, above {BOUND}: {above[1]}")
    say(f"worst: raycert render {source} --pixel {x},{y} | raycert explain --case -")
    return 1 if worst > BOUND else 0


def _pixel(scene: Scene, words: str) -> str:
    """Return the case of a pixel as the line protocol has it, numbers as hex floats."""
    import json

    from raycert.cases.forms import write_ray, write_solid
    from raycert.cases.scene import frame, pixel_ray

    column, _, row = words.partition(",")
    width, height = scene.size
    if not all(word.isdecimal() and len(word) < 9 for word in (column, row)):
        raise BadInput(f"--pixel: is not X,Y, two whole numbers: {words!r:.40}")
    if not (int(column) < width and int(row) < height):
        raise BadInput(f"--pixel: {words} is not in a picture of {width}x{height}")
    ray = pixel_ray(frame(scene.camera), scene.size, int(column), int(row))
    return json.dumps({"solid": write_solid(scene.solid, "hex"), "ray": write_ray(ray, "hex")})
