"""The planes in which a picture may show a ray and a leaf, and the vectors that span them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot

from raycert.cases.model import HalfSpace, Leaf, Slab, Sphere, Vector

OFF_AXIS = 0.6
"""From this share of the radius on, a ray is seen from the side that shows how far it passes."""


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane of the picture: `up` square to the ray, `aside` from the ray, and its name."""

    up: Vector
    name: str
    aside: Vector = (0.0, 0.0, 0.0)


def planes(leaf: Leaf, along: Vector) -> list[Plane]:
    """Return the planes through the ray to look at a leaf in, the best first."""
    match leaf:
        case Sphere():
            return [Plane(square(leaf.center, along), "The plane of ray and centre")]
        case HalfSpace():
            return [Plane(square(leaf.normal, along), "The plane of ray and normal")]
    axis = unit(minus(leaf.q, leaf.p))
    views = lengthwise(leaf, along)
    common = cross(along, axis)
    if isinstance(leaf, Slab) or norm(common) < 1e-9:
        return views
    distance = dot(leaf.p, unit(common))
    if abs(distance) <= OFF_AXIS * leaf.radius:
        return views
    return [crosswise(leaf, along), views[-1]]


def lengthwise(leaf: Leaf, along: Vector) -> list[Plane]:
    """Return the planes along the axis of a leaf, the best first; of one with none, `planes`.

    The last is another plane than the ray's own: that of the axis, before which the ray is seen.
    """
    if isinstance(leaf, Sphere | HalfSpace):
        return planes(leaf, along)
    axis = unit(minus(leaf.q, leaf.p))
    plane = Plane(square(axis, along), "The plane of the ray that runs along the axis")
    common = cross(along, axis)
    if isinstance(leaf, Slab):
        return [plane]
    if norm(common) < 1e-9:
        return [Plane(square(off(leaf.p, axis), along), "The plane of ray and axis")]
    aside = times(dot(leaf.p, unit(common)), unit(common))
    return [plane, replace(plane, aside=aside, name="The ray, seen before a cut along the axis")]


def crosswise(leaf: Leaf, along: Vector) -> Plane:
    """Return the plane of the ray that is square to its best plane along the axis."""
    middle, up = anchor(leaf), lengthwise(leaf, along)[0].up
    common = cross(along, up)
    towards = times(-1.0 if dot(middle, common) < 0 else 1.0, common)
    return Plane(towards, "The plane of the ray that cuts across the axis")


def anchor(leaf: Leaf) -> Vector:
    """Return the point of the middle of a leaf that is nearest to the middle of the picture."""
    match leaf:
        case Sphere():
            return leaf.center
        case HalfSpace():
            return times(dot(leaf.point, unit(leaf.normal)), unit(leaf.normal))
    w = minus(leaf.q, leaf.p)
    share = max(0.0, min(-dot(leaf.p, unit(w)) / norm(w), 1.0))
    x, y, z = (a + share * b for a, b in zip(leaf.p, w, strict=True))
    return (x, y, z)


def dot(a: Vector, b: Vector) -> float:
    """Return a . b."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def norm(a: Vector) -> float:
    """Return |a|."""
    return hypot(*a)


def times(k: float, a: Vector) -> Vector:
    """Return k a."""
    return (k * a[0], k * a[1], k * a[2])


def minus(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def unit(a: Vector) -> Vector:
    """Return a / |a|; a of any size but zero."""
    largest = max(map(abs, a))
    scaled = times(1 / largest, a)
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
