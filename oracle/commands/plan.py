"""`raycert plan`: what a scene lets the tracer leave out, why, and what each is worth."""

from __future__ import annotations

import json
from typing import Any

import click

from raycert.oracle.commands.options import BadInput
from raycert.oracle.commands.scenes import ask, needs, read, scene_argument

SHOWS = ("depth", "normal", "thickness", "count")
EPILOG = """\b
The table:
  with      milliseconds of the whole picture, with everything left out that can be
  without   the same with this one item put back
  ratio     without / with: what the item is worth
An item that the scene does not allow has no times, and the reason in place of a reason.
All times are of one run, in turn, the least of the repeats; a few percent are noise. The
pictures are the same to the bit with and without each item.

\b
Examples:
  raycert plan die
  raycert plan forest --show thickness --size 320x240
  raycert plan pipe --json
  raycert plan --solids 1000               what a scene costs as it grows
  raycert render die --off bounds          the same picture, slower
"""


@click.command(epilog=EPILOG)
@scene_argument
@click.option("--show", type=click.Choice(SHOWS), default="depth", show_default=True)
@click.option("--size", metavar="WxH", help="Pixels.  [320x240; 640x480 with --solids]")
@click.option("--repeats", type=click.IntRange(1, 100), default=5, show_default=True)
@click.option(
    "--solids", type=click.IntRange(1, 10_000), help="Time crowds of 1 to so many solids instead."
)
@click.option("--json", "as_json", is_flag=True, help="As data.")
def plan(scene: str | None, **options: Any) -> None:
    """Print what the plan of SCENE leaves out and why, and time each item with and without.

    SCENE is a file or the name of a scene that comes with raycert. A plan is compiled from solids
    and camera before the first ray.
    """
    needs("numpy")
    if options["solids"]:
        if scene:
            raise click.UsageError("--solids makes its own scenes; leave SCENE out")
        _costs(options)
        return
    read_scene, name = read(scene, options["size"] or "320x240")
    from raycert.cases.scene import write_scene
    from raycert.oracle.commands.options import counting

    task = {"task": "plan", "show": options["show"], "repeats": options["repeats"]}
    with counting("timing") as advance:
        found = json.loads(ask(task | {"scene": write_scene(read_scene)}).output())
        advance()
    found = {"scene": name, "size": list(read_scene.size), "show": options["show"]} | found
    if options["as_json"]:
        click.echo(json.dumps(found, indent=1))
    else:
        _show(found)


def _show(found: dict[str, Any]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for title in ("item", "leaves out", "because, or why not"):
        table.add_column(title, no_wrap=title == "item")
    for title in ("with ms", "without", "ratio"):
        table.add_column(title, justify="right", no_wrap=True)
    for row in found["items"]:
        words = row["name"], row["leaves_out"]
        if not row["applies"]:
            table.add_row(*words, f"not here: {row['why']}", "", "", "", style="dim")
            continue
        times = row["with"], row["without"]
        numbers = (f"{1e3 * t:.1f}" for t in times)
        table.add_row(*words, row["why"], *numbers, f"{times[1] / times[0]:.2f}")
    Console().print(table)
    width, height = found["size"]
    planned, plain = found["planned"], found["plain"]
    click.echo(
        f"{found['scene']}, {found['show']}, {width}x{height}: {1e3 * planned:.1f} ms planned, "
        f"{1e3 * plain:.1f} ms with nothing left out: {plain / planned:.1f} times"
    )


def _costs(options: dict[str, Any]) -> None:
    """Print what crowds of more and more solids cost."""
    from raycert.cases.model import Refused
    from raycert.cases.scene import read_size
    from raycert.oracle.commands.options import counting

    words = (options["size"] or "640x480").lower().split("x")
    try:
        size = read_size([int(word) if word.isdecimal() else word for word in words], "--size")
    except Refused as refusal:
        raise BadInput(str(refusal)) from None
    task = {"task": "costs", "size": size, "repeats": options["repeats"], "most": options["solids"]}
    with counting("timing") as advance:
        found = json.loads(ask(task).output())
        advance()
    if options["as_json"]:
        click.echo(json.dumps({"size": list(size), "costs": found}, indent=1))
        return
    _show_costs(found)


def _show_costs(found: list[dict[str, Any]]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for title in ("solids", "us/ray planned", "with nothing left out", "ratio"):
        table.add_column(title, justify="right")
    for row in found:
        planned, plain = row["planned"], row["plain"]
        times = f"{1e6 * planned:.2f}", f"{1e6 * plain:.2f}"
        table.add_row(str(row["solids"]), *times, f"{plain / planned:.1f}")
    Console().print(table)
