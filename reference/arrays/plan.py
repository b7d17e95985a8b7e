"""A plan: a scene made ready before the first ray, with what it lets the tracer leave out.

None of the items changes a bit of an answer; each can be switched off. An item leaves out what
cannot matter: by construction (`origin`, `direction`, `shared`, `axis`, `caps`, `lists`), by
scaling that is exact (`scaling`), or by a bound that holds with rounding to spare (`bounds`,
`slab`, `misses`, `first`). The bounds rest on what the reference tracer promises, so the textbook's
formula goes without the items of `OWN`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Sphere,
    Tree,
    Union,
    axis,
    leaves,
    lengths,
)
from raycert.cases.scene import Frame, Scene, frame
from raycert.reference.arrays.quadratic import chord, textbook_chord
from raycert.reference.arrays.tiles import SIDE, Tile, cones, rays, tables, tiles, widened
from raycert.reference.arrays.tracer import Bundle, Memory, Part, Switches, number, walk
from raycert.reference.arrays.vectors import Array, Mask, Vectors, present
from raycert.reference.vectors import displacement

Show = Literal["depth", "normal", "thickness", "count", "lists"]
Tracer = Literal["reference", "textbook"]
Span = tuple[float, float]
"""The least and the largest magnitude but 0 of some numbers."""
Verdict = tuple[bool, str]
"""Whether a scene allows an item, and why or why not."""
FIRST = ("depth", "normal")
"""What is shown of the first hit alone."""
OWN = ("bounds", "slab", "misses", "first")
SMALL, LARGE, FINE = 2.0**-30, 2.0**30, 2.0**-60
"""Lengths in [SMALL, LARGE] and directions in [FINE, LARGE], zeros aside, make no product that
leaves the range of the format: the smallest is above 2^-1020, scaled or not."""
ITEMS = {
    "bounds": "parts whose bounds the rays of a tile miss",
    "origin": "what depends on the origin alone, but once",
    "direction": "what depends on the direction alone, but once",
    "shared": "what parts with one axis have in common, but once a tile",
    "axis": "products with the zeros of an axis or normal",
    "scaling": "the powers of two that keep products in range",
    "caps": "the slab test of infinite cylinders",
    "slab": "the slab test where no ray can meet the caps",
    "misses": "norms to the last bit, for rays that miss by much",
    "lists": "the comparator and the lists where there is no Boolean",
    "first": "the second root and the lists, for the first hit alone",
}
"""What each leaves out, in the order of the table."""


@dataclass(frozen=True, slots=True)
class Item:
    """One optimisation: what it leaves out, whether the scene allows it, and why or why not."""

    name: str
    leaves_out: str
    applies: bool
    why: str


def _either(allowed: bool, why: str, why_not: str) -> Verdict:
    return allowed, why if allowed else why_not


def _by_camera(scene: Scene, show: Show, speeds: Span, sizes: Span) -> dict[str, Verdict]:
    """Judge the items that depend on the camera, on what is shown, and on sizes."""
    eye = scene.camera.kind == "perspective"
    fits = speeds[0] >= FINE and not 0 < sizes[0] < SMALL and max(speeds[1], sizes[1]) <= LARGE
    ranges = "lengths from {:.2g} to {:.2g}, directions from {:.2g} to {:.2g}"
    tree = isinstance(scene.solid, Tree)
    whole = (
        f"{show} asks for whole lists"
        if show not in FIRST
        else "a number is so large or small that a sign could underflow"
        if not fits
        else "the root is a Boolean that needs whole lists"
        if tree and not isinstance(scene.solid, Union)
        else ""
    )
    in_trees = "in a tile with one part left, and where the other parts are not met"
    return {
        "origin": _either(
            eye, "every ray starts at the eye", "orthographic: each ray has its own start"
        ),
        "direction": _either(
            not eye, "all rays are parallel", "perspective: each ray has its own direction"
        ),
        "scaling": _either(
            fits,
            "no number is so large or small that a product could leave the range",
            ranges.format(*sizes, *speeds),
        ),
        "lists": (True, in_trees if tree else "one solid, no Boolean"),
        "first": _either(not whole, f"{show} asks for the first hit", whole),
    }


def _by_solid(scene: Scene, seen: Mask, between: Mask) -> dict[str, Verdict]:
    """Judge the items that depend on the leaves, and on the tables of tiles and parts."""
    parts = [leaf for _, leaf in leaves(scene.solid)]

    def count(*kinds: type) -> int:
        return sum(isinstance(leaf, kinds) for leaf in parts)

    def share(some: int, every: int) -> str:
        return f"{100 * some / max(every, 1):.3g} %"

    apart, met, pairs = int((~seen).sum()), int(between.sum()), count(Cylinder) * len(between)
    axes = {displacement(x.p, x.q)[0] for x in parts if not isinstance(x, HalfSpace | Sphere)}
    kinds = len(axes) + (count(Sphere) > 0) + (count(HalfSpace) > 0)
    zeros = sum(c == 0 for leaf in parts for c in axis(leaf) or ())
    endless, curved = count(InfiniteCylinder), count(Sphere, Cylinder, InfiniteCylinder)
    between_caps = f"in {share(met, pairs)} of the pairs of tile and cylinder no ray meets a cap"
    return {
        "bounds": (apart > 0, f"{share(apart, seen.size)} of the pairs of tile and part are apart"),
        "shared": _either(
            kinds < len(parts),
            f"{len(parts)} parts have {kinds} axes, counting spheres as one",
            "no two parts have an axis in common",
        ),
        "axis": _either(
            zeros > 0,
            f"the axes and normals have {zeros} components that are 0",
            "no axis or normal lies along a coordinate axis or plane",
        ),
        "caps": _either(
            endless > 0, f"{endless} infinite cylinders have none", "no infinite cylinder"
        ),
        "slab": (met > 0, between_caps if pairs else "no cylinder has caps"),
        "misses": _either(
            curved > 0, f"{curved} curved faces, which rays may miss", "no curved face"
        ),
    }


def span(columns: Iterable[Array]) -> Span:
    """Return the least and the largest magnitude but 0; 0 and 0 if there is none."""
    sizes = [abs(column) for column in columns]
    most = max(float(size.max()) for size in sizes)
    least = min(float(size.min(where=size > 0, initial=np.inf)) for size in sizes)
    return least if most else 0.0, most


@dataclass(frozen=True)
class Plan:
    """A scene made ready: `bundle(i)` gives the rays of tile i."""

    frame: Frame
    size: tuple[int, int]
    root: Part
    tiles: list[Tile]
    items: tuple[Item, ...]
    on: frozenset[str]
    switches: Switches
    seen: Mask | None
    between: Mask | None
    memory: Memory = field(default_factory=dict)

    def bundle(self, i: int) -> Bundle:
        tile = self.tiles[i]
        origin, direction = rays(self.frame, self.size, tile)
        return Bundle(
            self._shared(origin, "origin", tile),
            self._shared(direction, "direction", tile),
            tile.lanes,
            self.switches,
            self.memory,
            one_origin="origin" in self.on,
            one_direction="direction" in self.on,
            seen=None if self.seen is None else self.seen[i],
            between=None if self.between is None else self.between[i],
        )

    def _shared(self, a: Vectors, name: str, tile: Tile) -> Vectors:
        """Return a vector that all rays share as one, if that is asked, else lane by lane."""
        if name not in self.on:
            return widened(a, tile.lanes)
        drop = self.switches.axis
        return tuple(None if drop and c is not None and not c.any() else c for c in a)


@np.errstate(all="ignore")
def plan(
    scene: Scene,
    show: Show = "depth",
    off: frozenset[str] = frozenset(),
    tracer: Tracer = "reference",
    side: int = SIDE,
) -> Plan:
    """Return the plan of a scene, without the items that are switched off, in tiles of a side."""
    own, view, root = tracer == "reference", frame(scene.camera), number(scene.solid)
    cut = tiles(scene.size, side)
    seen, between = tables(cones(view, scene.size, cut), [part.solid for part in walk(root)])
    spans = [[span(present(a)) for a in rays(view, scene.size, tile)] for tile in cut]
    starts, speeds = np.moveaxis(np.array(spans), 1, 0)
    numbers = [x for _, leaf in leaves(scene.solid) for x in lengths(leaf)]
    sizes = span([np.array([*numbers, *scene.camera.eye]), starts])
    verdicts = _by_camera(scene, show, span([speeds]), sizes) | _by_solid(scene, seen, between)
    if not own:
        verdicts |= dict.fromkeys(OWN, (False, "rests on the reference tracer's promise"))
    items = tuple(Item(name, text, *verdicts[name]) for name, text in ITEMS.items())
    on = frozenset(item.name for item in items if item.applies) - off
    switches = Switches(
        scaling="scaling" not in on,
        caps="caps" not in on,
        lists="lists" not in on,
        chord=chord if own else textbook_chord,
        **{name: name in on for name in ("axis", "shared", "misses", "first")},
    )
    tables_on = seen if "bounds" in on else None, between if "slab" in on else None
    return Plan(view, scene.size, root, cut, items, on, switches, *tables_on)
