"""The base tracer of the zoo: plain doubles, every step replaceable. Sound, stable and closed.

Symbols: the ray is u + t v, the axis runs from p to q, w = q - p (for a half-space, its normal);
y = u - p (u - center, u - point) and z = u - q. Each leaf gives intervals of the whole line of t,
which `ahead` cuts off at 0. A fault is `replace(BASE, step=...)`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf
from typing import NamedTuple

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
)
from raycert.oracle.zoo.lists import LINE, Pairs, common, share, subtract, unite
from raycert.oracle.zoo.numbers import cross, dot, exponent, minus, norm, root, shift, shifted


class Sight(NamedTuple):
    """A leaf as a ray meets it. Lengths u, y, z, r are scaled together, v and w each alone."""

    u: Vector
    y: Vector
    z: Vector
    v: Vector
    w: Vector
    r: float
    e: int
    """t = (the t of the scaled numbers) 2^e."""


Combine = Callable[[Sequence[Pairs]], Pairs]


def as_given(solid: Solid, ray: Ray) -> tuple[Solid, Ray]:
    """Return the question unchanged."""
    return solid, ray


def chord(y: Vector, v: Vector, r: float) -> Pairs:
    """Return where |y + t v| <= r, from the closest approach."""
    speed, offset, reach = norm(v), norm(cross(v, y)), r * norm(v)
    if speed == 0:
        return LINE if norm(y) <= r else []
    if reach < offset:
        return []
    half, middle = root((reach - offset) * (reach + offset)), -dot(v, y)
    a = dot(v, v)
    return [((middle - half) / a, (middle + half) / a)]


def plane(height: float, climb: float) -> Pairs:
    """Return where height + t climb <= 0."""
    if climb == 0:
        return LINE if height <= 0 else []
    t = -height / climb
    return [(-inf, t)] if climb > 0 else [(t, inf)]


def crossed(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the wall: y and v crossed with w, and r |w| for r."""
    return self.chord(cross(s.y, s.w), cross(s.v, s.w), s.r * norm(s.w))


def ball(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the sphere."""
    return self.chord(s.y, s.v, s.r)


def caps(self: Tracer, s: Sight) -> tuple[Pairs, Pairs]:
    """Return where the ray is above the plane through p, and where below the one through q."""
    climb = dot(s.v, s.w)
    return self.plane(-dot(s.y, s.w), -climb), self.plane(dot(s.z, s.w), climb)


def can(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the cylinder."""
    return share([self.wall(self, s), *self.caps(self, s)])


def below(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the half-space with normal w."""
    return self.plane(dot(s.y, s.w), dot(s.v, s.w))


def ahead(pairs: Pairs) -> Pairs:
    """Return what lies at t >= 0."""
    return common(pairs, [(0.0, inf)])


def as_found(solid: Solid, ray: Ray, pairs: Pairs) -> Pairs:
    """Return the answer unchanged."""
    return pairs


def identity(x: float) -> float:
    """Return a number unchanged."""
    return x


@dataclass(frozen=True)
class Tracer:
    """The steps, in the order in which they are taken; calling it answers a question."""

    read: Callable[[Solid, Ray], tuple[Solid, Ray]] = as_given
    number: Callable[[float], float] = identity
    scale: Callable[..., int] = exponent
    chord: Callable[[Vector, Vector, float], Pairs] = chord
    plane: Callable[[float, float], Pairs] = plane
    wall: Callable[[Tracer, Sight], Pairs] = crossed
    ball: Callable[[Tracer, Sight], Pairs] = ball
    caps: Callable[[Tracer, Sight], tuple[Pairs, Pairs]] = caps
    can: Callable[[Tracer, Sight], Pairs] = can
    below: Callable[[Tracer, Sight], Pairs] = below
    ahead: Callable[[Pairs], Pairs] = ahead
    unite: Combine = unite
    share: Combine = share
    subtract: Combine = subtract
    tell: Callable[[Solid, Ray, Pairs], Pairs] = as_found

    def __call__(self, solid: Solid, ray: Ray) -> Pairs:
        """Return the list of the t >= 0 for which the ray is in the solid."""
        solid, ray = self.read(solid, ray)
        return self.tell(solid, ray, self.node(solid, ray))

    def node(self, solid: Solid, ray: Ray) -> Pairs:
        """Return the list of a solid or of a part of it."""
        match solid:
            case Union(of):
                return self.unite([self.node(part, ray) for part in of])
            case Intersection(of):
                return self.share([self.node(part, ray) for part in of])
            case Difference(of):
                return self.subtract([self.node(part, ray) for part in of])
        s, line = self.leaf(solid, ray)
        return self.ahead([(shift(a, s.e), shift(b, s.e)) for a, b in line])

    def leaf(self, solid: Solid, ray: Ray) -> tuple[Sight, Pairs]:
        """Return a leaf as the ray meets it, and its intervals of the scaled line."""
        match solid:
            case HalfSpace(point, normal):
                s = self.sight(ray, point, point, normal, 0.0)
                return s, self.below(self, s)
            case Sphere(center, radius):
                s = self.sight(ray, center, center, (0.0, 0.0, 0.0), radius)
                return s, self.ball(self, s)
            case InfiniteCylinder(p, q, radius):
                s = self.sight(ray, p, q, None, radius)
                return s, self.wall(self, s)
            case Slab(p, q):
                s = self.sight(ray, p, q, None, 0.0)
                return s, share(self.caps(self, s))
            case Cylinder(p, q, radius):
                s = self.sight(ray, p, q, None, radius)
                return s, self.can(self, s)
        raise TypeError(solid)

    def sight(self, ray: Ray, p: Vector, q: Vector, w: Vector | None, radius: float) -> Sight:
        """Return the leaf at p and q, with axis or normal w (q - p if None), scaled."""
        e = self.scale(*ray.origin, *p, *q, radius)
        u = shifted(self.vector(ray.origin), -e)
        p, q = shifted(self.vector(p), -e), shifted(self.vector(q), -e)
        y, z, r = minus(u, p), minus(u, q), shift(self.number(radius), -e)
        v, w = self.vector(ray.direction), minus(q, p) if w is None else self.vector(w)
        small, ve, we = self.scale(*y, *z, r), self.scale(*v), self.scale(*w)
        u, y, z, r = shifted(u, -small), shifted(y, -small), shifted(z, -small), shift(r, -small)
        return Sight(u, y, z, shifted(v, -ve), shifted(w, -we), r, e + small - ve)

    def vector(self, a: Vector) -> Vector:
        """Return the components as numbers to compute with."""
        if self.number is identity:
            return a
        return (self.number(a[0]), self.number(a[1]), self.number(a[2]))


BASE = Tracer()
