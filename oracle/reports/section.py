"""A ray and a solid in a plane: what to look at, from where, and how large.

The ray runs from left to right, so x is t. The plane holds the ray and is turned about it to show
most: along the axis of the solid, where the caps are lines, or across, towards the axis where the
ray passes far from it. Coordinates are moved and scaled exactly before they become floats, so a
solid 1e12 radii away looks as it does here. What is drawn is the solid's exact trace on close lines
parallel to the ray.

A case has two views: along its axis, and across. Across, a lone cylinder is seen in the direction
of its axis, a disc before which the ray goes as ybar + t vbar; of a tree it is the plane of the ray
that cuts across. What has no axis looks the same from all sides of the ray, and has one view. A ray
that does not move in a view is its start alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any

from raycert.cases.formats import BINARY64
from raycert.cases.model import (
    SHAPES,
    Cylinder,
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
    map_leaves,
    points,
    radius,
)
from raycert.cases.vectors import along, cross, dot, minus, norm, plus, times
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import trace

OFF_AXIS = 0.6
"""From this share of the radius on, a ray is seen from the side that shows how far it passes."""


@dataclass(frozen=True, slots=True)
class ViewPlane:
    """A plane of the picture: `up` square to the ray, `aside` from the ray, and its name."""

    up: Vector
    name: str
    aside: Vector = (0.0, 0.0, 0.0)


def planes(leaf: Leaf, ahead: Vector) -> list[ViewPlane]:
    """Return the planes through the ray to look at a leaf in, the best first."""
    match leaf:
        case Sphere():
            return [ViewPlane(square(leaf.center, ahead), "The plane of ray and centre")]
        case HalfSpace():
            return [ViewPlane(square(leaf.normal, ahead), "The plane of ray and normal")]
    axis = unit(minus(leaf.q, leaf.p))
    views = lengthwise(leaf, ahead)
    common = cross(ahead, axis)
    if isinstance(leaf, Slab) or norm(common) < 1e-9:
        return views
    distance = dot(leaf.p, unit(common))
    if abs(distance) <= OFF_AXIS * leaf.radius:
        return views
    return [*crosswise(leaf, ahead), views[-1]]


def lengthwise(leaf: Leaf, ahead: Vector) -> list[ViewPlane]:
    """Return the planes along the axis of a leaf, the best first; of one with none, `planes`.

    The last is another plane than the ray's own: that of the axis, before which the ray is seen.
    """
    if isinstance(leaf, Sphere | HalfSpace):
        return planes(leaf, ahead)
    axis = unit(minus(leaf.q, leaf.p))
    plane = ViewPlane(square(axis, ahead), "The plane of the ray that runs along the axis")
    common = cross(ahead, axis)
    if isinstance(leaf, Slab):
        return [plane]
    if norm(common) < 1e-9:
        return [ViewPlane(square(off(leaf.p, axis), ahead), "The plane of ray and axis")]
    aside = times(dot(leaf.p, unit(common)), unit(common))
    return [plane, replace(plane, aside=aside, name="The ray, seen before a cut along the axis")]


def crosswise(leaf: Leaf, ahead: Vector) -> list[ViewPlane]:
    """Return the plane of the ray that is square to its best plane along the axis."""
    middle, up = anchor(leaf), lengthwise(leaf, ahead)[0].up
    common = cross(ahead, up)
    towards = times(-1.0 if dot(middle, common) < 0 else 1.0, common)
    return [ViewPlane(towards, "The plane of the ray that cuts across the axis")]


def anchor(leaf: Leaf) -> Vector:
    """Return the point of the middle of a leaf that is nearest to the middle of the picture."""
    match leaf:
        case Sphere():
            return leaf.center
        case HalfSpace():
            return times(dot(leaf.point, unit(leaf.normal)), unit(leaf.normal))
    w = minus(leaf.q, leaf.p)
    share = max(0.0, min(-dot(leaf.p, unit(w)) / norm(w), 1.0))
    return along(leaf.p, share, w)


def unit(a: Vector) -> Vector:
    """Return a / |a|, a not zero; in these steps: where a ray lies in a face, a rounding shows."""
    scaled = times(1 / max(map(abs, a)), a)
    return times(1 / norm(scaled), scaled)


def off(a: Vector, ahead: Vector) -> Vector:
    """Return the part of a vector that is square to a unit vector."""
    return minus(a, times(dot(a, ahead), ahead))


def square(a: Vector, ahead: Vector) -> Vector:
    """Return the unit vector square to another, on the side of `a`; any where `a` is along it."""
    part = off(a, ahead)
    if norm(part) > 1e-9 * (norm(a) or 1.0):
        return unit(part)
    x, y, z = ahead
    least = min((abs(x), (1.0, 0.0, 0.0)), (abs(y), (0.0, 1.0, 0.0)), (abs(z), (0.0, 0.0, 1.0)))
    return unit(off(least[1], ahead))


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
Choose = Callable[[Leaf, Vector], list[ViewPlane]]
"""From a leaf and the direction of the ray to the planes to look in, the best first."""


@dataclass(frozen=True, slots=True)
class Slice:
    """A picture's contents. Lengths are scaled; the middle of the picture is t = `middle`."""

    solid: Solid
    ahead: Vector
    plane: ViewPlane
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
        start = along(times(-self.half, self.ahead), height, self.plane.up)
        ray = Ray(plus(start, self.plane.aside), self.ahead)
        found = expected(trace(solid, ray).intervals, BINARY64)[1]
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


def section(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> Slice | None:
    """Return what to draw; `ends` are the finite endpoints. None for what no picture can hold."""
    return section_of(solid, exact(ray.origin), exact(ray.direction), ends, planes)


def section_of(
    solid: Solid, origin: Exact, direction: Exact, ends: Sequence[Fraction], choose: Choose
) -> Slice | None:
    """Return what to draw of an exact ray; `choose` tells in which planes to look."""
    if not any(direction):
        return None
    with suppress(Refused, OverflowError, ZeroDivisionError):
        leaf = pivot(solid)
        middle = (min(ends) + max(ends)) / 2 if ends else _closest(leaf, origin, direction)
        here = along(origin, middle, direction)
        scale = _scale(leaf, here)
        near = _moved(solid, here, scale)
        fast = Fraction(2) ** max(_bits(x) for x in direction if x)
        v = _vector(x / fast for x in direction)
        length = norm(v)
        speed = Fraction(length) * fast * scale
        ahead = times(1 / length, v)
        reach = float(max((abs(t - middle) * speed for t in ends), default=Fraction(0)))
        views = [
            Slice(near, ahead, plane, middle, speed, *_frame(near, ahead, plane, reach))
            for plane in choose(pivot(near), ahead)
        ]
        return next((view for view in views if any(view.filled())), views[-1])
    return None


def _frame(solid: Solid, ahead: Vector, plane: ViewPlane, reach: float) -> tuple[float, float]:
    """Return half of the width of a picture, and how far its middle is above the ray."""
    middle = anchor(pivot(solid))
    height = dot(middle, plane.up)
    size = min(_size(part, reach) for _, part in leaves(solid))
    behind = 0.0
    if not reach:
        size = max(size, abs(height) / 1.5)
        behind = min(abs(dot(middle, ahead)) + size, FARTHEST * size)
    half = max(1.25 * max(reach, behind), 1.3 * size / ASPECT)
    room = 0.75 * half * ASPECT
    return half, max(-room, min(height, room))


def pivot(solid: Solid) -> Leaf:
    """Return the leaf to look at: the first that is bounded somewhere, else the first."""
    found = [leaf for _, leaf in leaves(solid)]
    return next((leaf for leaf in found if not isinstance(leaf, HalfSpace)), found[0])


def _size(leaf: Leaf, reach: float) -> float:
    """Return the length of a leaf that makes it and the way inside both visible."""
    if isinstance(leaf, HalfSpace):
        return reach or 1.0
    height = 0.0 if isinstance(leaf, Sphere) else norm(minus(leaf.q, leaf.p))
    sizes = sorted(x for x in (radius(leaf), height) if x) or [reach or 1.0]
    return next((x for x in sizes if x >= 0.2 * reach), sizes[-1])


def exact(v: Sequence[float]) -> Exact:
    x, y, z = map(Fraction, v)
    return (x, y, z)


def _closest(leaf: Leaf, origin: Exact, direction: Exact) -> Fraction:
    """Return the t >= 0 at which the ray is nearest to a point of the leaf's middle."""
    square = dot(direction, direction)
    if not square:
        return Fraction(0)
    if isinstance(leaf, InfiniteCylinder):
        return max(_beside(leaf, origin, direction), Fraction(0))
    aims = [exact(point) for point in points(leaf)]
    x, y, z = (sum(xs, Fraction(0)) / len(aims) for xs in zip(*aims, strict=True))
    way = dot(minus((x, y, z), origin), direction)
    return max(way / square, Fraction(0))


def _beside(leaf: InfiniteCylinder, origin: Exact, direction: Exact) -> Fraction:
    """Return the t at which the ray passes nearest to an axis; 0 where it runs along it."""
    w = minus(exact(leaf.q), exact(leaf.p))
    v, y = cross(direction, w), cross(minus(origin, exact(leaf.p)), w)
    square = dot(v, v)
    if not square:
        return Fraction(0)
    return -dot(v, y) / square


def _scale(leaf: Leaf, here: Exact) -> Fraction:
    """Return the power of two that brings a leaf, seen from here, to a size of about 1."""
    numbers = [abs(x) for point in points(leaf) for x in minus(exact(point), here)]
    largest = max(*numbers, Fraction(radius(leaf)))
    return Fraction(2) ** -(_bits(largest) if largest else 0)


def _bits(x: Fraction) -> int:
    """Return about log2 of the size of a number, which is not 0."""
    return x.numerator.bit_length() - x.denominator.bit_length()


def _moved(solid: Solid, here: Exact, scale: Fraction) -> Solid:
    """Return the solid as seen from a point, scaled; normals stay as they are."""

    def move(leaf: Leaf) -> Leaf:
        shape, value = SHAPES[type(leaf)], partial(getattr, leaf)
        changed: dict[str, Any] = {
            name: _vector(scale * x for x in minus(exact(value(name)), here))
            for name in shape.points
        }
        changed |= {name: float(Fraction(value(name)) * scale) for name in shape.lengths}
        return replace(leaf, **changed)

    return map_leaves(move, solid)


def _vector(numbers: Iterator[Fraction]) -> Vector:
    x, y, z = map(float, numbers)
    return (x, y, z)


@dataclass(frozen=True, slots=True)
class View:
    """A view: its name, its contents, and whether the ray stays at its start there."""

    name: str
    section: Slice
    still: bool = False


def views(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> list[View]:
    """Return the views of a case, none for what no picture can hold; `ends` are finite."""
    found = [_along(solid, ray, ends)]
    if isinstance(solid, Cylinder | InfiniteCylinder):
        found.append(_end_on(solid, ray, ends))
    elif isinstance(solid, Tree):
        found.append(_across(solid, ray, ends))
    return [view for view in found if view is not None]


def _along(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> View | None:
    origin, direction = exact(ray.origin), exact(ray.direction)
    leaf, still = pivot(solid), not any(ray.direction)
    if still:
        axis = isinstance(leaf, Cylinder | InfiniteCylinder | Slab)
        direction = _axis(leaf) if axis else exact((1.0, 0.0, 0.0))  # type: ignore[arg-type]
    section = section_of(solid, origin, direction, [Fraction(0)] if still else ends, lengthwise)
    return None if section is None else View(section.plane.name, section, still)


def _across(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> View | None:
    section = section_of(solid, exact(ray.origin), exact(ray.direction), ends, crosswise)
    return None if section is None else View("The plane of the ray across the first", section)


def _end_on(leaf: Cylinder | InfiniteCylinder, ray: Ray, ends: Sequence[Fraction]) -> View | None:
    """Return the view in the direction of the axis; the caps are not seen there."""
    w, v = _axis(leaf), exact(ray.direction)
    share = dot(v, w) / dot(w, w)
    across = along(v, -share, w)
    still = not any(across)
    if still:
        towards = minus(exact(leaf.p), exact(ray.origin))
        across = along(towards, -dot(towards, w) / dot(w, w), w)
        least = min(range(3), key=lambda i: abs(w[i]))
        axis = exact([float(i == least) for i in range(3)])
        across = across if any(across) else along(axis, -w[least] / dot(w, w), w)
    wall, times = InfiniteCylinder(leaf.p, leaf.q, leaf.radius), [Fraction(0)] if still else ends
    section = section_of(wall, exact(ray.origin), across, times, crosswise)
    name = "Seen along the axis: the wall is a circle, the ray is ybar + t vbar"
    return None if section is None else View(name, section, still)


def _axis(leaf: Cylinder | InfiniteCylinder | Slab) -> Exact:
    return minus(exact(leaf.q), exact(leaf.p))
