"""A fresh sample of cases: seeded, the same on every machine, biased to the degenerate.

Coordinates lie on a small lattice or are random; leaves of a tree share axes, planes and centers;
rays aim at tangents, rims, faces and axes; some numbers are moved to their neighbours.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf, nextafter

from raycert.cases.case import Case
from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
    leaves,
    type_of,
)

LEAVES = (HalfSpace, Sphere, InfiniteCylinder, Slab, Cylinder)
PARTS = (HalfSpace, Slab, InfiniteCylinder, InfiniteCylinder, Sphere, Sphere, Cylinder, Cylinder)
"""What the parts of a tree are drawn from."""
TREES = (Union, Intersection, Difference)
RADII = (0.0, 0.5, 1.0, 1.0, 2.0, 2.5, 3.0, 5.0)


def fresh(count: int, seed: int) -> Iterator[Case]:
    """Yield `count` cases of a seed; a larger count begins with the same cases."""
    for number in range(count):
        yield case(number, seed)


def case(number: int, seed: int) -> Case:
    """Return one case of a seed; every type of solid has its turn."""
    draw = _Draw(Dice(f"crosscheck {seed} {number}"))
    kind = (*LEAVES, *TREES)[number % 8]
    solid = draw.leaf(kind) if kind in LEAVES else draw.tree(draw.dice.integer(1, 3), kind)
    ray = draw.ray(solid)
    why = f"Case {number} of the sample with seed {seed}, a {type_of(solid).replace('_', ' ')}."
    return Case(f"{seed}-{number}", why, solid, ray, "generic")


@dataclass(slots=True)
class _Draw:
    """Draws the parts of one case, and remembers them so that later parts share them."""

    dice: Dice
    points: list[Vector] = field(default_factory=list)
    axes: list[tuple[Vector, Vector]] = field(default_factory=list)
    radii: list[float] = field(default_factory=list)
    lattice: bool = field(init=False)

    def __post_init__(self) -> None:
        """Choose, once a case, whether numbers lie on a lattice (three cases of four)."""
        self.lattice = self.one_in(4, times=3)

    def one_in(self, of: int, times: int = 1) -> bool:
        """Tell whether a draw with chance times / of came out."""
        return self.dice.integer(1, of) <= times

    def real(self) -> float:
        """Return a coordinate: a small integer, or any number."""
        if self.lattice:
            return float(self.dice.integer(-4, 4))
        return self.dice.real(BINARY64, -4, 4)

    def near(self, number: float) -> float:
        """Return the number, or in one case of twelve one of its neighbours."""
        if self.one_in(12):
            return nextafter(number, inf if self.one_in(2) else -inf)
        return number

    def vector(self) -> Vector:
        """Return three coordinates."""
        return (self.real(), self.real(), self.real())

    def direction(self) -> Vector:
        """Return a vector other than 0, often along a coordinate axis."""
        if self.one_in(3):
            axis, length = self.dice.integer(0, 2), self.dice.integer(1, 3)
            signed = float(length if self.one_in(2) else -length)
            return (signed * (axis == 0), signed * (axis == 1), signed * (axis == 2))
        vector = self.vector()
        return vector if any(vector) else (0.0, 0.0, 1.0)

    def point(self) -> Vector:
        """Return a point, one of those already there in one case of three."""
        if self.points and self.one_in(3):
            return self._moved(self.points[self.dice.integer(0, len(self.points) - 1)])
        self.points.append(self.vector())
        return self.points[-1]

    def _moved(self, point: Vector) -> Vector:
        return (self.near(point[0]), self.near(point[1]), self.near(point[2]))

    def axis(self) -> tuple[Vector, Vector]:
        """Return two points p != q; in one case of three on an axis already there."""
        if self.axes and self.one_in(3):
            p, q = self.axes[self.dice.integer(0, len(self.axes) - 1)]
            match self.dice.integer(0, 3):
                case 0:
                    return q, p
                case 1:
                    return q, _plus(q, _minus(q, p))
                case 2:
                    return p, _plus(q, _minus(q, p))
            return p, q
        p = self.point()
        q = _plus(p, self.direction())
        self.axes.append((p, q if q != p else _plus(p, (0.0, 0.0, 16.0))))
        return self.axes[-1]

    def radius(self) -> float:
        """Return a radius, one of those already there in one case of three."""
        if self.radii and self.one_in(3):
            return abs(self.near(self.radii[-1]))
        if self.lattice:
            self.radii.append(RADII[self.dice.integer(0, len(RADII) - 1)])
        else:
            self.radii.append(self.dice.real(BINARY64, 0.01, 4))
        return self.radii[-1]

    def leaf(self, kind: type[Solid]) -> Leaf:
        """Return a leaf of a kind."""
        if kind is HalfSpace:
            if self.axes and self.one_in(2):
                p, q = self.axes[-1]
                return HalfSpace(q, _minus(q, p) if self.one_in(2) else _minus(p, q))
            return HalfSpace(self.point(), self.direction())
        if kind is Sphere:
            return Sphere(self.point(), self.radius())
        p, q = self.axis()
        if kind is Slab:
            return Slab(p, q)
        if kind is InfiniteCylinder:
            return InfiniteCylinder(p, q, self.radius())
        return Cylinder(p, q, self.radius())

    def tree(self, depth: int, kind: type[Solid]) -> Solid:
        """Return a Boolean of one to four parts, at most `depth` deep."""
        parts: list[Solid] = []
        for _ in range((2, 2, 3, 2, 3, 4, 2, 1)[self.dice.integer(0, 7)]):
            if parts and self.one_in(10):
                parts.append(parts[0])
            elif depth > 1 and self.one_in(2):
                parts.append(self.tree(depth - 1, TREES[self.dice.integer(0, 2)]))
            else:
                parts.append(self.leaf(PARTS[self.dice.integer(0, 7)]))
        return kind(of=tuple(parts))  # type: ignore[call-arg]

    def ray(self, solid: Solid) -> Ray:
        """Return a ray that has a reason to be hard, or any."""
        aims = [_aim(leaf) for _, leaf in leaves(solid)]
        place, along, radius = aims[self.dice.integer(0, len(aims) - 1)]
        scale = float(2 ** self.dice.integer(-2, 2)) if self.one_in(3) else 1.0
        toward = along if self.one_in(5) else self.direction()
        if self.one_in(100):
            toward = (0.0, 0.0, 0.0)
        direction = self._moved(_times(scale, toward))
        target = _plus(place, self._offset(radius))
        match self.dice.integer(0, 4):
            case 0:
                return Ray(target, direction)
            case 1:
                return Ray(self.point(), direction)
        back = float(self.dice.integer(-1, 10))
        return Ray(self._moved(_plus(target, _times(-back, toward))), direction)

    def _offset(self, radius: float) -> Vector:
        """Return a step of the radius along a coordinate axis or a 3-4-5 slope, or no step."""
        step = radius if self.one_in(4, times=3) else -radius
        steps: tuple[Vector, ...] = (
            (step, 0.0, 0.0),
            (0.0, step, 0.0),
            (0.0, 0.0, step),
            (0.6 * step, 0.8 * step, 0.0),
            (0.0, 0.0, 0.0),
            (step / 2, 0.0, 0.0),
        )
        return steps[self.dice.integer(0, 5)]


def _aim(leaf: Leaf) -> tuple[Vector, Vector, float]:
    """Return what a ray may aim at: a place, a direction along a face, and a radius."""
    match leaf:
        case HalfSpace():
            a, b, c = leaf.normal
            return leaf.point, (-b, a, 0.0) if a or b else (c, 0.0, 0.0), 1.0
        case Sphere():
            return leaf.center, (1.0, 0.0, 0.0), leaf.radius
        case Slab():
            return leaf.q, _minus(leaf.q, leaf.p), 1.0
    return leaf.q, _minus(leaf.q, leaf.p), leaf.radius


def _plus(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _times(factor: float, a: Vector) -> Vector:
    return (factor * a[0], factor * a[1], factor * a[2])
