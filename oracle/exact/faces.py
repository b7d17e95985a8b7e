"""Where an endpoint lies, and whether an interval only touches: read off the exact signs there.

Faces: `side` (a curved face), `cap_p`, `cap_q`, `plane`, and `start` for t = 0; in a tree with the
path of the leaf. A point lies on a face if it is on its surface and in the leaf, exactly.

Kinds of an endpoint: `end` (infinity), `start` (t = 0, where the ray is cut off), `rim` (curved
face and cap of one leaf), `tangent` (double root of a curved face), else `crossing`.

Kinds of touch, of an interval with no point strictly inside a leaf: `tangent`, `wall` (along the
curved face), `cap` (along a plane), `rim` (a point of the rim alone), `start` (the ray leaves the
solid at t = 0).
"""

from __future__ import annotations

from dataclasses import dataclass

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    leaves,
)
from raycert.oracle.exact.grid import Grid
from raycert.oracle.exact.intervals import Interval
from raycert.oracle.exact.leaf import Plane, Quadric, ball, caps, half_space, wall
from raycert.oracle.exact.surd import Surd


@dataclass(frozen=True, slots=True)
class Surface:
    """One face of a leaf as a polynomial in t, <= 0 inside: (a, b, c) of a t^2 + b t + c."""

    face: str
    a: int
    b: int
    c: int

    def side(self, t: Surd, grid: Grid) -> int:
        """Return the sign at t: -1 inside, 0 on the surface, 1 outside."""
        shift = grid.length - grid.speed
        up, down = max(shift, 0), max(-shift, 0)
        return t.evaluate(self.a << 2 * up, self.b << up + down, self.c << 2 * down)

    @property
    def along(self) -> bool:
        """Whether the whole ray lies on the surface."""
        return self.a == self.b == self.c == 0

    def leaves_at_0(self) -> bool:
        """Tell, of a surface met at t = 0, whether the line is inside it just before."""
        return self.b > 0 or self.along

    def double(self) -> bool:
        """Whether the line touches the surface in a double root."""
        return self.a != 0 and self.b * self.b == 4 * self.a * self.c


def surfaces(leaf: Leaf, grid: Grid) -> tuple[Surface, ...]:
    """Return the faces of a leaf along the ray, its curved face first."""
    curved: Quadric | None = None
    flat: tuple[tuple[str, Plane], ...] = ()
    match leaf:
        case HalfSpace():
            flat = (("plane", half_space(leaf, grid)),)
        case Sphere():
            curved = ball(leaf, grid)
        case InfiniteCylinder() | Cylinder():
            curved = wall(leaf, grid)
    if isinstance(leaf, Slab | Cylinder):
        flat = tuple(zip(("cap_p", "cap_q"), caps(leaf, grid), strict=True))
    sides = (Surface("side", curved.a, 2 * curved.b, curved.c),) if curved else ()
    return (*sides, *(Surface(face, 0, plane.b, plane.c) for face, plane in flat))


@dataclass(frozen=True, slots=True)
class Place:
    """Where an endpoint lies: its faces in order, `start` last, and its kind."""

    faces: tuple[str, ...]
    kind: str


def place(t: Surd, solid: Solid, ray: Ray) -> Place:
    """Return the faces that an endpoint of the exact list lies on, and its kind."""
    if not t.finite:
        return Place((), "end")
    grid = Grid.of(solid, ray)
    faces: list[str] = []
    kinds: set[str] = set()
    for path, leaf in leaves(solid):
        found = on_faces(leaf, t, grid)
        faces += [f"{path}:{surface.face}" if path else surface.face for surface in found]
        kinds.add(_kind(found))
    if t.sign() == 0:
        return Place((*faces, "start"), "start")
    kind = next((k for k in ("rim", "tangent") if k in kinds), "crossing")
    return Place(tuple(faces), kind)


def on_faces(leaf: Leaf, t: Surd, grid: Grid) -> list[Surface]:
    """Return the faces of a leaf that the ray's point at t lies on."""
    sides = [(surface, surface.side(t, grid)) for surface in surfaces(leaf, grid)]
    if any(side > 0 for _, side in sides):
        return []
    return [surface for surface, side in sides if side == 0]


def _kind(found: list[Surface]) -> str:
    names = {surface.face for surface in found}
    if "side" in names and len(names) > 1:
        return "rim"
    return "tangent" if any(surface.double() for surface in found) else "crossing"


def touch(interval: Interval, leaf: Leaf, ray: Ray) -> str | None:
    """Return the kind of touch of an interval of a leaf's exact list, None if it goes inside."""
    grid = Grid.of(leaf, ray)
    enter, leave = interval
    if enter < leave:
        along = {surface.face for surface in surfaces(leaf, grid) if surface.along}
        if "side" in along:
            return "rim" if len(along) > 1 else "wall"
        return "cap" if along else None
    found = on_faces(leaf, enter, grid)
    if enter.sign() == 0 and all(surface.leaves_at_0() for surface in found):
        return "start"
    return _kind(found)
