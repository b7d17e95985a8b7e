"""Where a ray is inside a solid: Problems 1 to 3 of cases/README.md, in doubles.

Each function follows one table row by row and names the rows. Symbols are those of
`cases`: the ray is u + t v, the axis runs from p to q, w = q - p, y = u - p, and the barred vectors
are crossed with w. Where doubles need another formula than the derivation's, the docstring says
which and why.
"""

from __future__ import annotations

from math import inf, ldexp
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
from raycert.reference.intervals import Pairs, difference, intersection, pair, union
from raycert.reference.quadratic import chord
from raycert.reference.vectors import cross, displacement, dot, exponent, norm, scaled, shift


def intersect(solid: Solid, ray: Ray) -> Pairs:
    """Return the intervals of t >= 0 for which the ray is in the solid, sorted and disjoint.

    >>> intersect(Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 0, 1), (1, 0, 0)))
    [(2.0, 4.0)]
    >>> intersect(Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 1, 2), (2, 0, 0)))
    [(1.5, 1.5)]
    """
    match solid:
        case Cylinder(p, q, radius):
            m = meet(p, q, radius, ray)
            return unscale(cylinder(m), m.e)
        case InfiniteCylinder(p, q, radius):
            m = meet(p, q, radius, ray)
            return unscale(infinite_cylinder(m), m.e)
        case Slab(p, q):
            m = meet(p, q, 0.0, ray)
            return unscale(slab(m), m.e)
        case HalfSpace(point, normal):
            return half_space(point, normal, ray)
        case Sphere(center, radius):
            return sphere(center, radius, ray)
        case Union(of):
            return union(*(intersect(part, ray) for part in of))
        case Intersection(of):
            return intersection(*(intersect(part, ray) for part in of))
        case Difference(of):
            return difference(*(intersect(part, ray) for part in of))


class Meeting(NamedTuple):
    """A ray and an axis, scaled: y, z and r by one power of two, v by another, w by a third."""

    y: Vector
    """From p to the start of the ray."""
    z: Vector
    """From q to the start of the ray."""
    v: Vector
    w: Vector
    r: float
    e: int
    """What the scales of y and v do to t: t = (the scaled t) 2^e."""


def meet(p: Vector, q: Vector, radius: float, ray: Ray) -> Meeting:
    """Return the ray and the axis from p to q, scaled."""
    v, ve = scaled(ray.direction)
    y, ye = displacement(p, ray.origin)
    z, ze = displacement(q, ray.origin)
    w, _ = displacement(p, q)
    e = max(ye, ze, exponent(radius))
    return Meeting(shift(y, ye - e), shift(z, ze - e), v, w, ldexp(radius, -e), e - ve)


def infinite_cylinder(m: Meeting) -> Pairs:
    """Problem 1. Return where the distance from the line pq is at most r.

    Unlike in the derivation w is not normalised: every length across the axis, r too, is
    multiplied by |w| instead, which leaves t as it is. So a direction parallel to the axis has a
    vbar of exactly zero, whichever way the axis points; with a rounded w/|w| it would not.
    """
    return chord(cross(m.y, m.w), cross(m.v, m.w), m.r * norm(m.w))


def slab(m: Meeting) -> Pairs:
    """Problem 2 (g). Return where the ray is between the planes through p and q square to pq.

    Unlike in the derivation n = -w is not normalised: only signs and quotients are used. Far
    from a thin slab both F may come out at once, which cannot be; tq > tp then gives no pair.
    """
    up, uq, vn = -dot(m.y, m.w), -dot(m.z, m.w), -dot(m.v, m.w)
    if vn == 0:
        return [(0.0, inf)] if up <= 0 <= uq else []  # AE; AH, DE
    tp, tq = -up / vn, -uq / vn
    if uq < 0:
        return pair(tq, tp) if vn > 0 else []  # BG, AH
    if up > 0:
        return pair(tp, tq) if vn < 0 else []  # CF, DE
    return [(0.0, tp if vn > 0 else tq)]  # BE, AF


def cylinder(m: Meeting) -> Pairs:
    """Problem 3. Return where the ray is in the infinite cylinder and in the slab."""
    return intersection(infinite_cylinder(m), slab(m))


def half_space(point: Vector, normal: Vector, ray: Ray) -> Pairs:
    """Problem 2 (c). Return where (x - point) . normal <= 0."""
    n, _ = scaled(normal)
    v, ve = scaled(ray.direction)
    y, ye = displacement(point, ray.origin)
    up, vn = dot(y, n), dot(v, n)
    if vn == 0 or (vn > 0) == (up > 0):
        return [(0.0, inf)] if up <= 0 else []  # A, D
    t = _times(-up / vn, ye - ve)
    return [(0.0, t)] if vn > 0 else [(t, inf)]  # B, C


def sphere(center: Vector, radius: float, ray: Ray) -> Pairs:
    """Return where the distance from the center is at most the radius.

    The table of Problem 1 with the vectors unbarred: `along` is then the zero direction.
    """
    v, ve = scaled(ray.direction)
    y, ye = displacement(center, ray.origin)
    e = max(ye, exponent(radius))
    return unscale(chord(shift(y, ye - e), v, ldexp(radius, -e)), e - ve)


def unscale(pairs: Pairs, e: int) -> Pairs:
    """Return the pairs with every t multiplied by 2^e."""
    return [(_times(enter, e), _times(leave, e)) for enter, leave in pairs]


def _times(t: float, e: int) -> float:
    """Return t 2^e for t >= 0: infinite if that overflows, and never -0."""
    try:
        return ldexp(t, e) + 0.0
    except OverflowError:
        return inf
