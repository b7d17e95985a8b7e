"""The items of a plan: what each leaves out, and whether a scene allows it, and why.

None changes a bit of an answer. An item leaves out what cannot matter: by construction (`origin`,
`direction`, `shared`, `axis`, `caps`, `lists`), by scaling that is exact (`scaling`), or by a bound
that holds with rounding to spare (`bounds`, `slab`, `misses`, `first`). The bounds rest on what the
reference tracer promises, so the textbook's formula goes without the items of `OWN`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Literal

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
from raycert.cases.scene import Scene
from raycert.reference.arrays.vectors import Mask
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
