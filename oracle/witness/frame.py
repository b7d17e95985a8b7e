"""The ray in the coordinates of a leaf, where the leaf is a unit body.

The parameter t does not change under an affine map, so each leaf is looked at where it has size 1:
a form a + b t in fractions for each local coordinate of f(t). Nothing is solved for here; the map
is written down from the definition of the leaf, and where the leaf is invariant under a motion or
a stretch (a slab along its planes, an infinite cylinder along its axis, a half-space in all three)
that freedom is used to bring the ray to the middle of the body, at a moderate slope.

    leaf                x, y                          z                       faces that count
    cylinder            square to pq, over r          -1 at p, 1 at q         all
    infinite cylinder   square to pq, over r          0 nearest to the axis   wall
    slab                0 where z = 0, |slope| < 1/4  -1 at p, 1 at q         top and bottom
    half-space          0 where z = 1, |slope| < 1/4  1 on the plane          top
    sphere              x, y, z - center, over r                              all

A ray that leaves the prism by a face that does not count goes on for ever on that side: the slopes
above see to it that it meets such a face only where the leaf has no end.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Sphere,
    Vector,
)
from raycert.oracle.witness.prism import Part

Exact = tuple[Fraction, Fraction, Fraction]
Form = tuple[Fraction, Fraction]
Triple = tuple[float, float, float]
ZERO, ONE = Fraction(0), Fraction(1)
EVERY_PART = frozenset(Part)

AWAY = 8
"""How many steps before the middle a cast starts; a step is 0.7 to 2, a body lies within 1.6."""

STRAY: Exact = (Fraction(3, 7), Fraction(5, 7), Fraction(4, 7))
"""The direction of the cast that tells whether a ray that stays at its origin is inside."""

NEEDLE = Fraction(1, 2**20)
"""A solid of radius 0 is enclosed in one of this radius, in units of its scene."""


@dataclass(frozen=True, slots=True)
class Placed:
    """The local coordinates of f(t), which body to cast at, and which of its parts count."""

    forms: tuple[Form, Form, Form]
    round: bool
    parts: frozenset[Part] = EVERY_PART
    hollow: bool = False
    """The leaf has no interior: its inner body is empty."""

    @property
    def still(self) -> bool:
        """Tell whether the ray stays at its origin."""
        return not any(slope for _, slope in self.forms)


@dataclass(frozen=True, slots=True)
class Line:
    """A cast from `start` along `direction`, whose parameter tau is t = t0 + pace (tau - AWAY).

    start and direction are the exact ones, rounded: their points are off by less than 1e-14 on the
    whole way of 16 steps, as coordinates below 32 round by 2^-49 and slopes below 2 by 2^-53.
    """

    start: Triple
    direction: Triple
    t0: Fraction
    pace: Fraction


def vector(v: Vector) -> Exact:
    """Return three numbers as fractions."""
    return (Fraction(v[0]), Fraction(v[1]), Fraction(v[2]))


def dot(a: Exact, b: Exact) -> Fraction:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def minus(a: Exact, b: Exact) -> Exact:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a: Exact, b: Exact) -> Exact:
    """Return a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def across(w: Exact) -> tuple[Exact, Exact]:
    """Return two vectors square to w != 0 and to each other."""
    least = min(range(3), key=lambda i: abs(w[i]))
    axis = (Fraction(least == 0), Fraction(least == 1), Fraction(least == 2))
    e = cross(w, axis)
    return e, cross(w, e)


def root(square: Fraction) -> Fraction:
    """Return the square root of a positive fraction, to a relative 2^-64.

    sqrt(n / d) = sqrt(n d) / d; the integer root has 66 bits or more.
    """
    product = square.numerator * square.denominator
    shift = max(0, 66 - product.bit_length() // 2)
    return Fraction(isqrt(product << 2 * shift), square.denominator << shift)


def power(size: Fraction) -> Fraction:
    """Return the power of two 2^k with 1/2 < size / 2^k < 2, size > 0."""
    return two_to(size.numerator.bit_length() - size.denominator.bit_length())


def two_to(k: int) -> Fraction:
    """Return 2^k."""
    return Fraction(1 << k) if k >= 0 else Fraction(1, 1 << -k)


def place(leaf: Leaf, ray: Ray) -> Placed:
    """Return the ray in the coordinates of a leaf."""
    u, v = vector(ray.origin), vector(ray.direction)
    match leaf:
        case Sphere():
            return _sphere(leaf, u, v)
        case HalfSpace():
            return _half_space(leaf, u, v)
        case Slab():
            return _slab(leaf, u, v)
    return _cylinder(leaf, u, v)


def _radius(radius: float, *nearby: Exact) -> Fraction:
    size = max(abs(x) for point in nearby for x in point)
    return Fraction(radius) or (NEEDLE * size if size else ONE)


def _sphere(leaf: Sphere, u: Exact, v: Exact) -> Placed:
    y = minus(u, vector(leaf.center))
    r = _radius(leaf.radius, y)
    x, y_, z = ((a / r, b / r) for a, b in zip(y, v, strict=True))
    return Placed((x, y_, z), round=True, hollow=not leaf.radius)


def _along(leaf: Slab | Cylinder | InfiniteCylinder, u: Exact, v: Exact) -> Form:
    """Return the form of z: -1 on the plane through p, 1 on the one through q."""
    p, q = vector(leaf.p), vector(leaf.q)
    w = minus(q, p)
    half = dot(w, w) / 2
    return dot(minus(u, p), w) / half - 1, dot(v, w) / half


def _cylinder(leaf: Cylinder | InfiniteCylinder, u: Exact, v: Exact) -> Placed:
    p = vector(leaf.p)
    w, y = minus(vector(leaf.q), p), minus(u, p)
    r = _radius(leaf.radius, y, w)
    e, f = across(w)
    scales = [1 / (r * root(dot(g, g))) for g in (e, f)]
    x1, x2 = ((dot(y, g) * s, dot(v, g) * s) for g, s in zip((e, f), scales, strict=True))
    hollow = not leaf.radius
    if isinstance(leaf, Cylinder):
        return Placed((x1, x2, _along(leaf, u, v)), round=False, hollow=hollow)
    z = _free_axis(x1, x2, dot(v, w))
    return Placed((x1, x2, z), round=False, parts=frozenset({Part.WALL}), hollow=hollow)


def _free_axis(x: Form, y: Form, climb: Fraction) -> Form:
    """Return z for an infinite cylinder: 0 nearest to the axis, |slope| < 1/4.

    Inside the wall x and y stay within 1.1, so |z| < 1 there.
    """
    if not climb:
        return ZERO, ZERO
    square = x[1] * x[1] + y[1] * y[1]
    if not square:
        return ZERO, ONE if climb > 0 else -ONE
    nearest = -(x[0] * x[1] + y[0] * y[1]) / square
    slope = power(max(abs(x[1]), abs(y[1]))) / (8 if climb > 0 else -8)
    return -slope * nearest, slope


def _sideways(normal: Exact, v: Exact, climb: Fraction, crossing: Fraction) -> tuple[Form, Form]:
    """Return x and y for a body of planes: 0 at t = `crossing`, and slopes below |climb| / 4.

    With climb = 0 the slopes are any; the ray then leaves through the wall.
    """
    forms: list[Form] = []
    for e in across(normal):
        slope = dot(v, e)
        if slope:
            slope *= power(abs(climb) or ONE) / power(abs(slope)) / 16
        forms.append((-slope * crossing, slope))
    return forms[0], forms[1]


def _slab(leaf: Slab, u: Exact, v: Exact) -> Placed:
    z = _along(leaf, u, v)
    w = minus(vector(leaf.q), vector(leaf.p))
    x, y = _sideways(w, v, z[1], -z[0] / z[1] if z[1] else ZERO)
    return Placed((x, y, z), round=False, parts=frozenset({Part.TOP, Part.BOTTOM}))


def _half_space(leaf: HalfSpace, u: Exact, v: Exact) -> Placed:
    normal = vector(leaf.normal)
    height, climb = dot(minus(u, vector(leaf.point)), normal), dot(v, normal)
    if climb:
        z = (1 + height, climb)
        x, y = _sideways(normal, v, climb, -height / climb)
    else:
        z = (ZERO if height < 0 else ONE if height == 0 else 2 * ONE, ZERO)
        x, y = _sideways(normal, v, ZERO, ZERO)
    return Placed((x, y, z), round=False, parts=frozenset({Part.TOP}))


def line(placed: Placed) -> Line | None:
    """Return the cast of a ray; None where its line stays more than AWAY from the middle.

    The direction is brought to a length of 0.7 to 2 by a power of two, which is exact: the caster
    takes 1e-5 for parallel and -1e-6 for behind whatever the direction is. With 1/2 < s / 2^k < 2
    for the square s of its length, that over 4^floor(k / 2) lies between 1/2 and 4.
    """
    x, y, z = placed.forms
    a, b = (x[0], y[0], z[0]), (x[1], y[1], z[1])
    if placed.still:
        return _through(a, STRAY, ZERO, ONE)
    square = dot(b, b)
    t0 = -dot(a, b) / square
    k = square.numerator.bit_length() - square.denominator.bit_length()
    pace = two_to(-(k // 2))
    middle = (a[0] + b[0] * t0, a[1] + b[1] * t0, a[2] + b[2] * t0)
    return _through(middle, (b[0] * pace, b[1] * pace, b[2] * pace), t0, pace)


def _through(middle: Exact, d: Exact, t0: Fraction, pace: Fraction) -> Line | None:
    if max(abs(c) for c in middle) > AWAY:
        return None
    x, y, z = (float(m - AWAY * s) for m, s in zip(middle, d, strict=True))
    return Line((x, y, z), (float(d[0]), float(d[1]), float(d[2])), t0, pace)
