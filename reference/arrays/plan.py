"""A plan: a scene made ready before the first ray, with what it lets the tracer leave out.

None of the items changes a bit of an answer; each can be switched off. An item leaves out what
cannot matter: by construction (`origin`, `direction`, `shared`, `axis`, `caps`, `lists`), by
scaling that is exact (`scaling`), or by a bound that holds with rounding to spare (`bounds`,
`slab`, `misses`, `first`). The bounds rest on what the reference tracer promises, so the textbook's
formula goes without the items of `OWN`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from typing import Literal

import numpy as np

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Slab,
    Sphere,
    Tree,
    Union,
    leaves,
)
from raycert.cases.scene import Frame, Scene, frame
from raycert.reference.arrays.quadratic import chord, textbook_chord
from raycert.reference.arrays.tiles import (
    SIDE,
    Tile,
    between_table,
    cones,
    rays,
    seen_table,
    tiles,
    widened,
)
from raycert.reference.arrays.tracer import Bundle, Memory, Part, Switches, number, walk
from raycert.reference.arrays.vectors import Mask, Vectors, present
from raycert.reference.vectors import displacement

Show = Literal["depth", "normal", "thickness", "count", "lists"]
Tracer = Literal["reference", "textbook"]
FIRST = ("depth", "normal")
"""What is shown of the first hit alone."""
OWN = ("bounds", "slab", "misses", "first")
SMALL, LARGE, FINE = 2.0**-30, 2.0**30, 2.0**-60
"""Lengths in [SMALL, LARGE] and directions in [FINE, LARGE], zeros aside, make no product that
leaves the range of the format: the smallest is above 2^-1020, scaled or not."""


@dataclass(frozen=True, slots=True)
class Item:
    """One optimisation: what it leaves out, whether the scene allows it, and why or why not."""

    name: str
    leaves_out: str
    applies: bool
    why: str


@dataclass(frozen=True)
class Findings:
    """What was found out about a scene: sizes of the directions, tables of tiles and parts."""

    scene: Scene
    show: Show
    speeds: tuple[float, float]
    lengths: tuple[float, float]
    seen: Mask
    between: Mask

    @cached_property
    def parts(self) -> list[Leaf]:
        """Return the leaves."""
        return [leaf for _, leaf in leaves(self.scene.solid)]

    @property
    def in_range(self) -> bool:
        """Tell whether no product can leave the range of the format."""
        (slow, fast), (short, long) = self.speeds, self.lengths
        return slow >= FINE and short >= SMALL and max(fast, long) <= LARGE

    def count(self, *kinds: type) -> int:
        """Return how many leaves are of these types."""
        return sum(isinstance(leaf, kinds) for leaf in self.parts)


Verdict = tuple[bool, str]
Judged = Callable[[Findings], Verdict]


def items(found: Findings, tracer: Tracer) -> tuple[Item, ...]:
    """Return every item, as the scene stands to it."""
    return tuple(_item(name, found, tracer) for name in ITEMS)


def _item(name: str, found: Findings, tracer: Tracer) -> Item:
    leaves_out, judge = ITEMS[name]
    if tracer != "reference" and name in OWN:
        return Item(name, leaves_out, False, "rests on the reference tracer's promise")
    return Item(name, leaves_out, *judge(found))


def _bounds(found: Findings) -> Verdict:
    apart = int((~found.seen).sum())
    return apart > 0, f"{_share(apart, found.seen.size)} of the pairs of tile and part are apart"


def _origin(found: Findings) -> Verdict:
    if found.scene.camera.kind == "perspective":
        return True, "every ray starts at the eye"
    return False, "orthographic: each ray has its own start"


def _direction(found: Findings) -> Verdict:
    if found.scene.camera.kind == "orthographic":
        return True, "all rays are parallel"
    return False, "perspective: each ray has its own direction"


def _shared(found: Findings) -> Verdict:
    axes = {displacement(x.p, x.q)[0] for x in found.parts if not isinstance(x, HalfSpace | Sphere)}
    kinds = len(axes) + (found.count(Sphere) > 0) + (found.count(HalfSpace) > 0)
    if kinds == len(found.parts):
        return False, "no two parts have an axis in common"
    return True, f"{len(found.parts)} parts have {kinds} axes, counting spheres as one"


def _axis(found: Findings) -> Verdict:
    vectors = [_along(leaf) for leaf in found.parts]
    zeros = sum(c == 0 for vector in vectors if vector for c in vector)
    if zeros:
        return True, f"the axes and normals have {zeros} components that are 0"
    return False, "no axis or normal lies along a coordinate axis or plane"


def _along(leaf: Leaf) -> tuple[float, float, float] | None:
    match leaf:
        case Sphere():
            return None
        case HalfSpace():
            return leaf.normal
        case _:
            return displacement(leaf.p, leaf.q)[0]


def _scaling(found: Findings) -> Verdict:
    if found.in_range:
        return True, "no number is so large or small that a product could leave the range"
    return False, f"lengths {_range(found.lengths)}, directions {_range(found.speeds)}"


def _caps(found: Findings) -> Verdict:
    n = found.count(InfiniteCylinder)
    return n > 0, f"{n} infinite cylinders have none" if n else "no infinite cylinder"


def _slab(found: Findings) -> Verdict:
    n, all_ = int(found.between.sum()), found.count(Cylinder) * len(found.between)
    if not all_:
        return False, "no cylinder has caps"
    return n > 0, f"in {_share(n, all_)} of the pairs of tile and cylinder no ray meets a cap"


def _misses(found: Findings) -> Verdict:
    n = found.count(Sphere, Cylinder, InfiniteCylinder)
    return n > 0, f"{n} curved faces, which rays may miss" if n else "no curved face"


def _lists(found: Findings) -> Verdict:
    if isinstance(found.scene.solid, Tree):
        return True, "in a tile with one part left, and where the other parts are not met"
    return True, "one solid, no Boolean"


def _first(found: Findings) -> Verdict:
    if found.show not in FIRST:
        return False, f"{found.show} asks for whole lists"
    if not found.in_range:
        return False, "a number is so large or small that a sign could underflow"
    if isinstance(found.scene.solid, Tree) and not isinstance(found.scene.solid, Union):
        return False, "the root is a Boolean that needs whole lists"
    return True, f"{found.show} asks for the first hit"


def _share(some: int, all_: int) -> str:
    return f"{100 * some / max(all_, 1):.3g} %"


def _range(bounds: tuple[float, float]) -> str:
    return f"from {bounds[0]:.2g} to {bounds[1]:.2g}"


ITEMS: dict[str, tuple[str, Judged]] = {
    "bounds": ("parts whose bounds the rays of a tile miss", _bounds),
    "origin": ("what depends on the origin alone, but once", _origin),
    "direction": ("what depends on the direction alone, but once", _direction),
    "shared": ("what parts with one axis have in common, but once a tile", _shared),
    "axis": ("products with the zeros of an axis or normal", _axis),
    "scaling": ("the powers of two that keep products in range", _scaling),
    "caps": ("the slab test of infinite cylinders", _caps),
    "slab": ("the slab test where no ray can meet the caps", _slab),
    "misses": ("norms to the last bit, for rays that miss by much", _misses),
    "lists": ("the comparator and the lists where there is no Boolean", _lists),
    "first": ("the second root and the lists, for the first hit alone", _first),
}
"""What each leaves out, and how a scene is judged: in the order of the table."""


def spans(numbers: list[float]) -> tuple[float, float]:
    """Return the least and the largest magnitude but 0; (1, 1) if all are 0."""
    sizes = [abs(x) for x in numbers if x]
    return (min(sizes), max(sizes)) if sizes else (1.0, 1.0)


def lengths(scene: Scene) -> tuple[float, float]:
    """Return the least and the largest length in a scene's solids and of its eye."""
    numbers = [
        [*leaf.point]
        if isinstance(leaf, HalfSpace)
        else [*leaf.center, leaf.radius]
        if isinstance(leaf, Sphere)
        else [*leaf.p, *leaf.q, 0.0 if isinstance(leaf, Slab) else leaf.radius]
        for _, leaf in leaves(scene.solid)
    ]
    return spans([*chain.from_iterable(numbers), *scene.camera.eye])


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
