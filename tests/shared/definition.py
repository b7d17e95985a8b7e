"""What the solids are by definition, in fractions that share no code with the oracle."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import isqrt

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
    Tree,
    Union,
    Vector,
)
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import Surd, fraction
from raycert.oracle.exact.trace import trace

Exact = tuple[Fraction, Fraction, Fraction]


def exact(a: Vector) -> Exact:
    return (Fraction(a[0]), Fraction(a[1]), Fraction(a[2]))


def minus(a: Exact, b: Exact) -> Exact:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: Exact, b: Exact) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def inside(solid: Solid, x: Exact) -> bool:
    """Tell whether x is in the set that the contract's table defines."""
    match solid:
        case HalfSpace(point, normal):
            return dot(minus(x, exact(point)), exact(normal)) <= 0
        case Sphere(center, radius):
            m = minus(x, exact(center))
            return dot(m, m) <= Fraction(radius) ** 2
        case Slab(p, q):
            w = minus(exact(q), exact(p))
            return 0 <= dot(minus(x, exact(p)), w) <= dot(w, w)
        case InfiniteCylinder(p, q, radius):
            w, y = minus(exact(q), exact(p)), minus(x, exact(p))
            foot = dot(y, w) / dot(w, w)  # the nearest point of the line is p + foot w
            away = (y[0] - foot * w[0], y[1] - foot * w[1], y[2] - foot * w[2])
            return dot(away, away) <= Fraction(radius) ** 2
        case Cylinder(p, q, radius):
            return inside(Slab(p, q), x) and inside(InfiniteCylinder(p, q, radius), x)
        case Union(of):
            return any(inside(part, x) for part in of)
        case Intersection(of):
            return all(inside(part, x) for part in of)
        case Difference(of):
            return inside(of[0], x) and not any(inside(part, x) for part in of[1:])


def at(ray: Ray, t: Fraction) -> Exact:
    u, v = exact(ray.origin), exact(ray.direction)
    return (u[0] + t * v[0], u[1] + t * v[1], u[2] + t * v[2])


def member(t: Fraction, intervals: Intervals) -> bool:
    s = fraction(*t.as_integer_ratio())
    return any(a <= s <= b for a, b in intervals)


def near(t: Surd, bits: int = 40) -> Fraction:
    """Return a fraction within 2^-bits of a finite t, or t itself if it is rational."""
    root = isqrt(t.y * t.y * t.d << 2 * bits) * (1 if t.y > 0 else -1)
    return t.rational() or Fraction((t.x << bits) + root, t.z << bits)


def samples(intervals: Intervals) -> set[Fraction]:
    """Return ends, their neighbours on both sides, and the middles between them; all t >= 0."""
    ends = sorted(near(t) for interval in intervals for t in interval if t.finite)
    gap = Fraction(1, 2**20)
    marks = {Fraction(0), Fraction(1, 3), Fraction(100)}
    for t in ends:
        marks |= {t, t - gap, t + gap}
    marks |= {(a + b) / 2 for a, b in pairwise(ends)}
    return {t for t in marks if t >= 0}


def on_a_surface(solid: Solid, ray: Ray, t: Fraction) -> bool:
    """Tell whether any leaf's list begins or ends within 2^-30 of t, or only touches."""
    if isinstance(solid, Tree):
        return any(on_a_surface(part, ray, t) for part in solid.of)
    ends = (e for interval in trace(solid, ray).intervals for e in interval if e.finite)
    return any(abs(near(e) - t) < Fraction(1, 2**30) for e in ends)
