"""The textbook tracer: the seed's formulas as printed, in doubles. A subject, never a truth.

With n = w/|w|, vbar = v x n and ybar = y x n it solves t^2 vbar.vbar + 2 t vbar.ybar + ybar.ybar -
r^2 = 0 by the discriminant b^2 - a c, and the planes by -(u - p).n / v.n. Nothing is scaled and no
root is chosen: what cancels, cancels. A NaN on the way makes the whole answer [(nan, nan)].

In binary32 every operation is rounded to binary32, as a client of that precision would have it.
"""

from __future__ import annotations

import math
from math import inf, nan

from raycert.cases.formats import BINARY32, BINARY64, Format
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
from raycert.oracle.exact.rounding import enclose
from raycert.oracle.exact.surd import dyadic
from raycert.oracle.exact.trace import combine

Pairs = tuple[tuple[float, float], ...]
LINE = (-inf, inf)
NONE = (inf, -inf)
"""An interval of no t, which survives every intersection as such."""
NAN = (nan, nan)


class Single(float):
    """A binary32 number: every operation is rounded to binary32.

    Rounding the binary64 result once more is right for + - * / and sqrt, as 53 >= 2 * 24 + 2.
    """

    __slots__ = ()

    def __add__(self, other: float) -> Single:
        return _single(float.__add__(self, other))

    def __sub__(self, other: float) -> Single:
        return _single(float.__sub__(self, other))

    def __mul__(self, other: float) -> Single:
        return _single(float.__mul__(self, other))

    def __truediv__(self, other: float) -> Single:
        return _single(float.__truediv__(self, other))

    def __neg__(self) -> Single:
        return Single(float.__neg__(self))


def _single(x: float) -> Single:
    return Single(BINARY32.nearest(x))


def textbook(solid: Solid, ray: Ray, fmt: Format = BINARY64) -> Pairs:
    """Return the textbook answer; never raises.

    >>> textbook(Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 0, 1), (1, 0, 0)))
    ((2.0, 4.0),)
    """
    match solid:
        case Union(of) | Intersection(of) | Difference(of):
            lists = [textbook(part, ray, fmt) for part in of]
            return _combined(solid, lists)
    u, v = _typed(ray.origin, fmt), _typed(ray.direction, fmt)
    parts = [(0.0, inf)]
    match solid:
        case HalfSpace(point, normal):
            parts.append(_plane(u, v, _typed(point, fmt), _typed(normal, fmt)))
        case Sphere(center, radius):
            parts.append(_quadratic(v, _minus(u, _typed(center, fmt)), _typed((radius,) * 3, fmt)))
        case InfiniteCylinder() | Slab() | Cylinder():
            p, q = _typed(solid.p, fmt), _typed(solid.q, fmt)
            n = _unit(_minus(q, p))
            if not isinstance(solid, Slab):
                ybar, r = _cross(_minus(u, p), n), _typed((solid.radius,) * 3, fmt)
                parts.append(_quadratic(_cross(v, n), ybar, r))
            if not isinstance(solid, InfiniteCylinder):
                parts += [_plane(u, v, p, _negative(n)), _plane(u, v, q, n)]
    return _common(parts)


def _typed(x: Vector, fmt: Format) -> Vector:
    return x if fmt is BINARY64 else (Single(x[0]), Single(x[1]), Single(x[2]))


def _quadratic(v: Vector, y: Vector, radius: Vector) -> tuple[float, float]:
    """Return where |y + t v| <= r on the whole line; `radius` is r three times over."""
    r = radius[0]
    a, b, c = _dot(v, v), _dot(v, y), _dot(y, y) - r * r
    if a == 0:
        return LINE if c <= 0 else NONE
    disc = b * b - a * c
    if disc < 0:
        return NONE
    root = _sqrt(disc)
    return _over(-b - root, a), _over(-b + root, a)


def _plane(u: Vector, v: Vector, point: Vector, normal: Vector) -> tuple[float, float]:
    """Return where (u + t v - point) . normal <= 0 on the whole line."""
    height, climb = _dot(_minus(u, point), normal), _dot(v, normal)
    if climb == 0:
        return LINE if height <= 0 else NONE
    t = _over(-height, climb)
    return (-inf, t) if climb > 0 else (t, inf)


def _common(parts: list[tuple[float, float]]) -> Pairs:
    """Return what intervals of the line have in common."""
    if any(math.isnan(x) for part in parts for x in part):
        return (NAN,)
    enter, leave = max(part[0] for part in parts), min(part[1] for part in parts)
    return ((float(enter) + 0.0, float(leave) + 0.0),) if enter <= leave else ()


def _combined(tree: Union | Intersection | Difference, lists: list[Pairs]) -> Pairs:
    """Return the list of a Boolean. Numbers are only compared, so the exact algebra serves."""
    if any(math.isnan(x) for pairs in lists for pair in pairs for x in pair):
        return (NAN,)
    exact = [tuple((dyadic(a), dyadic(b)) for a, b in pairs) for pairs in lists]
    combined = combine(tree, exact)
    return tuple((enclose(a, BINARY64).nearest, enclose(b, BINARY64).nearest) for a, b in combined)


def _sqrt(x: float) -> float:
    root = math.sqrt(x)
    return _single(root) if isinstance(x, Single) else root


def _over(a: float, b: float) -> float:
    """Return a / b as IEEE 754 has it, also for b = 0."""
    if b != 0 or math.isnan(b):
        return a / b
    return nan if a == 0 or math.isnan(a) else math.copysign(inf, a) * math.copysign(1, b)


def _unit(a: Vector) -> Vector:
    length = _sqrt(_dot(a, a))
    return (_over(a[0], length), _over(a[1], length), _over(a[2], length))


def _negative(a: Vector) -> Vector:
    return (-a[0], -a[1], -a[2])


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
