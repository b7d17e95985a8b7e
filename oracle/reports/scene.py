"""A ray and a solid in a plane: what to look at, from where, and how large.

The ray runs from left to right, so x is t. The plane holds the ray and is turned about it to show
most: along the axis of the solid, or across, towards the axis where the ray passes far from it.
Coordinates are moved and scaled exactly before they become floats, so a scene 1e12 radii away looks
as it does here. What is drawn is the solid's exact trace on close lines parallel to the ray.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from raycert.cases.formats import BINARY64
from raycert.cases.model import (
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Refused,
    Slab,
    Solid,
    Sphere,
    Tree,
    Vector,
    leaves,
)
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import trace
from raycert.oracle.reports.plane import Plane, anchor, dot, minus, norm, planes, times

Exact = tuple[Fraction, Fraction, Fraction]
ASPECT = 0.44
"""Height of a picture over its width."""
LINES = 96
"""On how many lines a solid is traced."""
MANY = 12
"""Of how many leaves the outlines are drawn."""
FARTHEST = 40
"""A solid that is behind the start by more than this times its size is out of the picture."""

Spans = tuple[tuple[float, float], ...]
Choose = Callable[[Leaf, Vector], list[Plane]]
"""From a leaf and the direction of the ray to the planes to look in, the best first."""


@dataclass(frozen=True, slots=True)
class Scene:
    """A picture's contents. Lengths are scaled; the middle of the picture is t = `middle`."""

    solid: Solid
    along: Vector
    plane: Plane
    middle: Fraction
    speed: Fraction
    """Scaled length in a unit of t."""
    half: float
    """Half of the picture's width."""
    rise: float
    """How far the middle of the picture is above the ray."""

    def heights(self) -> list[float]:
        """Return the heights above the ray at which the solid is traced; 0 is one of them."""
        step = 2 * self.half * ASPECT / LINES
        low = self.rise - self.half * ASPECT
        return sorted({low + step * i for i in range(LINES + 1)} | {0.0})

    def across(self, solid: Solid, height: float) -> Spans:
        """Return where a line parallel to the ray is in a solid, within the picture."""
        start = [
            -self.half * e + height * u + a
            for e, u, a in zip(self.along, self.plane.up, self.plane.aside, strict=True)
        ]
        x, y, z = start
        found = expected(trace(solid, Ray((x, y, z), self.along)).intervals, BINARY64)[1]
        width = 2 * self.half
        return tuple((a - self.half, min(b, width) - self.half) for a, b in found if a < width)

    def filled(self) -> Iterator[tuple[float, float, float]]:
        """Yield (height, from, to) of the lines inside the solid."""
        for height in self.heights():
            for a, b in self.across(self.solid, height):
                yield height, a, b

    def outlines(self) -> Iterator[list[tuple[float, float]]]:
        """Yield the outline of each leaf, which is convex."""
        for _, leaf in list(leaves(self.solid))[:MANY]:
            ends = [(y, *spans[0]) for y, spans in self._edges(leaf)]
            if ends:
                yield [(a, y) for y, a, _ in ends] + [(b, y) for y, _, b in reversed(ends)]

    def _edges(self, leaf: Leaf) -> list[tuple[float, Spans]]:
        """Return the lines that meet a leaf, with its first and last found by halving."""
        tried = [(y, self.across(leaf, y)) for y in self.heights()]
        met = [i for i, (_, spans) in enumerate(tried) if spans]
        if not met:
            return []
        first, last = met[0], met[-1]
        found = [item for item in tried if item[1]]
        if first:
            found.insert(0, self._halved(leaf, tried[first], tried[first - 1][0]))
        if last + 1 < len(tried):
            found.append(self._halved(leaf, tried[last], tried[last + 1][0]))
        return found

    def _halved(self, leaf: Leaf, met: tuple[float, Spans], missed: float) -> tuple[float, Spans]:
        for _ in range(8):
            y = (met[0] + missed) / 2
            if spans := self.across(leaf, y):
                met = (y, spans)
            else:
                missed = y
        return met


def scene(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> Scene | None:
    """Return what to draw; `ends` are the finite endpoints. None for what no picture can hold."""
    return seen(solid, exact(ray.origin), exact(ray.direction), ends, planes)


def seen(
    solid: Solid, origin: Exact, direction: Exact, ends: Sequence[Fraction], choose: Choose
) -> Scene | None:
    """Return what to draw of an exact ray; `choose` tells in which planes to look."""
    try:
        return _scene(solid, origin, direction, ends, choose)
    except (Refused, OverflowError, ZeroDivisionError):
        return None


def _scene(
    solid: Solid, origin: Exact, direction: Exact, ends: Sequence[Fraction], choose: Choose
) -> Scene | None:
    leaf = pivot(solid)
    middle = (min(ends) + max(ends)) / 2 if ends else _closest(leaf, origin, direction)
    here = _at(origin, direction, middle)
    scale = _scale(leaf, here)
    near = _moved(solid, here, scale)
    if not any(direction):
        return None
    fast = max(_bits(x) for x in direction if x)
    v = _vector(x / Fraction(2) ** fast for x in direction)
    length = norm(v)
    speed = Fraction(length) * Fraction(2) ** fast * scale
    along = times(1 / length, v)
    reach = float(max((abs(t - middle) * speed for t in ends), default=Fraction(0)))
    leaf = pivot(near)
    views = [_view(near, along, p, leaf, middle, speed, reach) for p in choose(leaf, along)]
    return next((view for view in views if any(view.filled())), views[-1])


def _view(
    solid: Solid,
    along: Vector,
    plane: Plane,
    leaf: Leaf,
    middle: Fraction,
    speed: Fraction,
    reach: float,
) -> Scene:
    middle_of = anchor(leaf)
    height = dot(middle_of, plane.up)
    size = min(_size(part, reach) for _, part in leaves(solid))
    behind = 0.0
    if not reach:
        size = max(size, abs(height) / 1.5)
        behind = min(abs(dot(middle_of, along)) + size, FARTHEST * size)
    half = max(1.25 * max(reach, behind), 1.3 * size / ASPECT)
    room = 0.75 * half * ASPECT
    return Scene(solid, along, plane, middle, speed, half, max(-room, min(height, room)))


def pivot(solid: Solid) -> Leaf:
    """Return the leaf to look at: the first that is bounded somewhere, else the first."""
    found = [leaf for _, leaf in leaves(solid)]
    return next((leaf for leaf in found if not isinstance(leaf, HalfSpace)), found[0])


def _size(leaf: Leaf, reach: float) -> float:
    """Return the length of a leaf that makes it and the way inside both visible."""
    if isinstance(leaf, HalfSpace):
        return reach or 1.0
    radius = 0.0 if isinstance(leaf, Slab) else leaf.radius
    height = 0.0 if isinstance(leaf, Sphere) else norm(minus(leaf.q, leaf.p))
    sizes = sorted(x for x in (radius, height) if x) or [reach or 1.0]
    return next((x for x in sizes if x >= 0.2 * reach), sizes[-1])


def exact(v: Sequence[float]) -> Exact:
    """Return a vector in fractions."""
    x, y, z = map(Fraction, v)
    return (x, y, z)


def _at(origin: Exact, direction: Exact, t: Fraction) -> Exact:
    x, y, z = (a + t * b for a, b in zip(origin, direction, strict=True))
    return (x, y, z)


def _closest(leaf: Leaf, origin: Exact, direction: Exact) -> Fraction:
    """Return the t >= 0 at which the ray is nearest to a point of the leaf's middle."""
    square = sum((x * x for x in direction), Fraction(0))
    if not square:
        return Fraction(0)
    if isinstance(leaf, InfiniteCylinder):
        return max(_beside(leaf, origin, direction), Fraction(0))
    aims = [getattr(leaf, name) for name in ("center", "point", "p", "q") if hasattr(leaf, name)]
    aim = [sum(map(Fraction, xs), Fraction(0)) / len(aims) for xs in zip(*aims, strict=True)]
    way = sum(((c - o) * v for c, o, v in zip(aim, origin, direction, strict=True)), Fraction(0))
    return max(way / square, Fraction(0))


def _beside(leaf: InfiniteCylinder, origin: Exact, direction: Exact) -> Fraction:
    """Return the t at which the ray passes nearest to an axis; 0 where it runs along it."""
    w = _sub(exact(leaf.q), exact(leaf.p))
    v, y = _across(direction, w), _across(_sub(origin, exact(leaf.p)), w)
    square = sum(x * x for x in v)
    if not square:
        return Fraction(0)
    return -sum((a * b for a, b in zip(v, y, strict=True)), Fraction(0)) / square


def _sub(a: Exact, b: Exact) -> Exact:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _across(a: Exact, b: Exact) -> Exact:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _scale(leaf: Leaf, here: Exact) -> Fraction:
    """Return the power of two that brings a leaf, seen from here, to a size of about 1."""
    numbers = [
        abs(Fraction(x) - c)
        for name in ("center", "point", "p", "q")
        if hasattr(leaf, name)
        for x, c in zip(getattr(leaf, name), here, strict=True)
    ]
    largest = max(*numbers, Fraction(getattr(leaf, "radius", 0.0)))
    return Fraction(2) ** -(_bits(largest) if largest else 0)


def _bits(x: Fraction) -> int:
    """Return about log2 of the size of a number, which is not 0."""
    return x.numerator.bit_length() - x.denominator.bit_length()


def _moved(solid: Solid, here: Exact, scale: Fraction) -> Solid:
    """Return the solid as seen from a point, scaled."""
    if isinstance(solid, Tree):
        return type(solid)(tuple(_moved(part, here, scale) for part in solid.of))
    changed: dict[str, Vector | float] = {}
    for name in ("center", "point", "p", "q"):
        if hasattr(solid, name):
            vector = zip(exact(getattr(solid, name)), here, strict=True)
            changed[name] = _vector((x - c) * scale for x, c in vector)
    if hasattr(solid, "radius"):
        changed["radius"] = float(Fraction(solid.radius) * scale)
    return replace(solid, **changed)  # type: ignore[arg-type]


def _vector(numbers: Iterator[Fraction]) -> Vector:
    x, y, z = map(float, numbers)
    return (x, y, z)
