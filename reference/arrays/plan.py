"""A plan: a scene made ready before the first ray, with what it lets the tracer leave out.

The items are those of `reference.arrays.items`; each can be switched off, and the answers stay the
same, bit by bit.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from raycert.cases.scene import Frame, Scene, frame
from raycert.reference.arrays.bounds import between_table, cones, seen_table
from raycert.reference.arrays.bundle import Bundle, Memory, Part, Switches, number, walk
from raycert.reference.arrays.items import Findings, Item, Show, Tracer, items, lengths
from raycert.reference.arrays.quadratic import chord
from raycert.reference.arrays.rays import SIDE, Tile, rays, tiles, widened
from raycert.reference.arrays.textbook import textbook_chord
from raycert.reference.arrays.vectors import Mask, Vectors, present


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
    kept: Memory = field(default_factory=dict)

    def bundle(self, i: int) -> Bundle:
        """Return the rays of a tile, and what is known of them."""
        tile = self.tiles[i]
        origin, direction = rays(self.frame, self.size, tile)
        return Bundle(
            self._shared(origin, "origin", tile),
            self._shared(direction, "direction", tile),
            tile.lanes,
            self.switches,
            self.kept,
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
        x, y, z = (None if drop and c is not None and not c.any() else c for c in a)
        return x, y, z


def plan(
    scene: Scene,
    show: Show = "depth",
    off: frozenset[str] = frozenset(),
    tracer: Tracer = "reference",
    side: int = SIDE,
) -> Plan:
    """Return the plan of a scene, without the items that are switched off, in tiles of a side."""
    with np.errstate(all="ignore"):
        return _plan(scene, show, off, tracer, tiles(scene.size, side))


def _plan(scene: Scene, show: Show, off: frozenset[str], tracer: Tracer, cut: list[Tile]) -> Plan:
    seen_from = frame(scene.camera)
    root = number(scene.solid)
    nodes = [part.solid for part in walk(root)]
    cone = cones(seen_from, scene.size, cut)
    seen, between = seen_table(cone, nodes), between_table(cone, nodes)
    speeds, starts = _spans(seen_from, scene.size, cut)
    least, most = lengths(scene)
    sizes = min(least, starts[0]), max(most, starts[1])
    stated = items(Findings(scene, show, speeds, sizes, seen, between), tracer)
    on = frozenset(item.name for item in stated if item.applies) - off
    return Plan(
        seen_from,
        scene.size,
        root,
        cut,
        stated,
        on,
        _switches(on, tracer),
        seen if "bounds" in on else None,
        between if "slab" in on else None,
    )


def _switches(on: frozenset[str], tracer: Tracer) -> Switches:
    return Switches(
        scaling="scaling" not in on,
        axis="axis" in on,
        shared="shared" in on,
        caps="caps" not in on,
        lists="lists" not in on,
        misses="misses" in on,
        first="first" in on,
        chord=chord if tracer == "reference" else textbook_chord,
    )


def _spans(
    seen_from: Frame, size: tuple[int, int], cut: list[Tile]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the least and the largest magnitude but 0 in directions, and in origins."""
    least, most = [np.inf, np.inf], [0.0, 0.0]
    for tile in cut:
        origin, direction = rays(seen_from, size, tile)
        for i, vector in enumerate((direction, origin)):
            for c in present(vector):
                sizes = abs(c)
                most[i] = max(most[i], float(sizes.max()))
                least[i] = min(least[i], float(sizes.min(where=sizes > 0, initial=np.inf)))
    return (least[0], most[0]), (least[1], most[1])
