"""`raycert plan`: what a scene lets the tracer leave out, why, and what each is worth."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import click

from raycert.oracle.commands.options import (
    OneOf,
    counting,
    json_option,
    needs,
    statuses,
    write_out,
)
from raycert.oracle.commands.scenes import read, scene_argument
from raycert.oracle.reports.foreign import say

SHOWS = ("depth", "normal", "thickness", "count")
EPILOG = f"""\b
The table:
  with      milliseconds of the whole picture, with everything left out that can be
  without   the same with this one item put back
  ratio     without / with: what the item is worth
An item that the scene does not allow has no times, and the reason in place of a reason.
All times are of one run, in turn, the least processor time of the repeats; a few percent
are noise. The pictures are the same to the bit with and without each item.

\b
Examples:
  raycert plan die
  raycert plan forest --show thickness --size 320x240
  raycert plan pipe --json -
  raycert bench --section scenes           what a scene costs as it grows
  raycert render die --off bounds          the same picture, slower

{statuses({3: "a package is missing"})}
"""


@click.command(epilog=EPILOG)
@scene_argument
@click.option("--show", type=OneOf(SHOWS), default="depth", show_default=True)
@click.option("--size", metavar="WxH", default="320x240", show_default=True, help="Pixels.")
@click.option("--repeats", type=click.IntRange(1, 100), default=5, show_default=True)
@json_option("Instead: the table")
def plan(scene: str | None, **options: Any) -> None:
    """Print what the plan of SCENE leaves out and why, and time each item with and without.

    SCENE is a file or the name of a scene that comes with raycert. A plan is compiled from solids
    and camera before the first ray.
    """
    needs("plan", "speed", "numpy")
    read_scene, name = read(scene, options["size"])
    from raycert.oracle.measure.pictures import worth

    with counting("timing") as advance:
        rows, (planned, plain) = worth(read_scene, options["show"], options["repeats"])
        advance()
    items = [asdict(row.item) | {"with": row.with_it, "without": row.without} for row in rows]
    result = {"scene": name, "size": list(read_scene.size), "show": options["show"]}
    result |= {"items": items, "planned": planned, "plain": plain}
    if options["out"]:
        write_out(options["out"], json.dumps(result, indent=1) + "\n")
    else:
        _print(**result)


def _print(
    scene: str,
    size: list[int],
    show: str,
    items: list[dict[str, Any]],
    planned: float,
    plain: float,
) -> None:
    from rich.table import Table

    from raycert.oracle.reports.screen import screen

    table = Table(box=None, pad_edge=False)
    for title in ("item", "leaves out", "because, or why not"):
        table.add_column(title, no_wrap=title == "item")
    for title in ("with ms", "without", "ratio"):
        table.add_column(title, justify="right", no_wrap=True)
    for row in items:
        words, times = (row["name"], row["leaves_out"]), (row["with"], row["without"])
        if row["applies"]:
            numbers = (f"{1e3 * t:.1f}" for t in times)
            table.add_row(*words, row["why"], *numbers, f"{times[1] / times[0]:.2f}")
        else:
            table.add_row(*words, f"not here: {row['why']}", "", "", "", style="dim")
    screen().print(table)
    say(
        f"{scene}, {show}, {size[0]}x{size[1]}: {1e3 * planned:.1f} ms planned, "
        f"{1e3 * plain:.1f} ms with nothing left out: {plain / planned:.1f} times"
    )
