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
from enum import Enum
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
from raycert.oracle.witness.algebra import Vec

Form = tuple[Fraction, Fraction]
ZERO, ONE = Fraction(0), Fraction(1)


class Part(Enum):
    """The parts of the surface of a unit cylinder, or of a prism."""

    WALL = 0
    BOTTOM = 1
    TOP = 2


AWAY = 8
"""How many steps before the middle a cast starts; a step is 0.7 to 2, a body lies within 1.6."""

STRAY = Vec(Fraction(3, 7), Fraction(5, 7), Fraction(4, 7))
"""The direction of the cast that tells whether a ray that stays at its origin is inside."""

NEEDLE = Fraction(1, 2**20)
"""A solid of radius 0 is enclosed in one of this radius, in units of its scene."""


@dataclass(frozen=True, slots=True)
class Placed:
    """The local coordinates of f(t), which body to cast at, and which of its parts count."""

    forms: tuple[Form, Form, Form]
    round: bool
    parts: frozenset[Part] = frozenset(Part)
    hollow: bool = False
    """The leaf has no interior: its inner body is empty."""

    @property
    def still(self) -> bool:
        return not any(slope for _, slope in self.forms)


@dataclass(frozen=True, slots=True)
class CastLine:
    """A cast from `start` along `direction`, whose parameter tau is t = t0 + pace (tau - AWAY).

    start and direction are the exact ones, rounded: their points are off by less than 1e-14 on the
    whole way of 16 steps, as coordinates below 32 round by 2^-49 and slopes below 2 by 2^-53.
    """

    start: tuple[float, float, float]
    direction: tuple[float, float, float]
    t0: Fraction
    pace: Fraction

    def time(self, tau: float) -> Fraction:
        """Return the ray's t at a parameter of the cast, exactly."""
        return self.t0 + self.pace * (Fraction(tau) - AWAY)


def exact(vector: Vector) -> Vec:
    return Vec.of(vector, Fraction)


def across(w: Vec) -> tuple[Vec, Vec]:
    """Return two vectors square to w != 0 and to each other."""
    least = min(range(3), key=lambda i: abs(w.parts[i]))
    e = w ^ Vec(*(Fraction(i == least) for i in range(3)))
    return e, w ^ e


def floats(a: Vec) -> tuple[float, float, float]:
    return (float(a.x), float(a.y), float(a.z))


def root(square: Fraction) -> Fraction:
    """Return the square root of a positive fraction, to a relative 2^-64.

    sqrt(n / d) = sqrt(n d) / d; the integer root has 66 bits or more.
    """
    product = square.numerator * square.denominator
    shift = max(0, 66 - product.bit_length() // 2)
    return Fraction(isqrt(product << 2 * shift), square.denominator << shift)


def power(size: Fraction) -> Fraction:
    """Return the power of two 2^k with 1/2 < size / 2^k < 2, size > 0."""
    return Fraction(2) ** (size.numerator.bit_length() - size.denominator.bit_length())


def place(leaf: Leaf, ray: Ray) -> Placed:
    """Return the ray in the coordinates of a leaf."""
    u, v = exact(ray.origin), exact(ray.direction)
    match leaf:
        case Sphere():
            return _sphere(leaf, u, v)
        case HalfSpace():
            return _half_space(leaf, u, v)
        case Slab():
            return _slab(leaf, u, v)
    return _cylinder(leaf, u, v)


def _radius(radius: float, *nearby: Vec) -> Fraction:
    size = max(abs(x) for point in nearby for x in point.parts)
    return Fraction(radius) or (NEEDLE * size if size else ONE)


def _sphere(leaf: Sphere, u: Vec, v: Vec) -> Placed:
    y = u - exact(leaf.center)
    r = _radius(leaf.radius, y)
    forms = zip((y / r).parts, (v / r).parts, strict=True)
    return Placed(tuple(forms), round=True, hollow=not leaf.radius)  # type: ignore[arg-type]


def _along(leaf: Slab | Cylinder | InfiniteCylinder, u: Vec, v: Vec) -> Form:
    """Return the form of z: -1 on the plane through p, 1 on the one through q."""
    p = exact(leaf.p)
    w = exact(leaf.q) - p
    half = w @ w / 2
    return (u - p) @ w / half - 1, v @ w / half


def _cylinder(leaf: Cylinder | InfiniteCylinder, u: Vec, v: Vec) -> Placed:
    p = exact(leaf.p)
    w, y = exact(leaf.q) - p, u - p
    r = _radius(leaf.radius, y, w)
    e, f = (g / (r * root(g @ g)) for g in across(w))
    x1, x2 = (y @ e, v @ e), (y @ f, v @ f)
    hollow = not leaf.radius
    if isinstance(leaf, Cylinder):
        return Placed((x1, x2, _along(leaf, u, v)), round=False, hollow=hollow)
    z = _free_axis(x1, x2, v @ w)
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


def _sideways(normal: Vec, v: Vec, climb: Fraction, crossing: Fraction) -> tuple[Form, Form]:
    """Return x and y for a body of planes: 0 at t = `crossing`, and slopes below |climb| / 4.

    With climb = 0 the slopes are any; the ray then leaves through the wall.
    """
    forms: list[Form] = []
    for e in across(normal):
        slope = v @ e
        if slope:
            slope *= power(abs(climb) or ONE) / power(abs(slope)) / 16
        forms.append((-slope * crossing, slope))
    return forms[0], forms[1]


def _slab(leaf: Slab, u: Vec, v: Vec) -> Placed:
    z = _along(leaf, u, v)
    w = exact(leaf.q) - exact(leaf.p)
    x, y = _sideways(w, v, z[1], -z[0] / z[1] if z[1] else ZERO)
    return Placed((x, y, z), round=False, parts=frozenset({Part.TOP, Part.BOTTOM}))


def _half_space(leaf: HalfSpace, u: Vec, v: Vec) -> Placed:
    normal = exact(leaf.normal)
    height, climb = (u - exact(leaf.point)) @ normal, v @ normal
    x, y = _sideways(normal, v, climb, -height / climb if climb else ZERO)
    level = ZERO if height < 0 else ONE if height == 0 else 2 * ONE
    z = (1 + height, climb) if climb else (level, ZERO)
    return Placed((x, y, z), round=False, parts=frozenset({Part.TOP}))


def line(placed: Placed) -> CastLine | None:
    """Return the cast of a ray; None where its line stays more than AWAY from the middle.

    The direction is brought to a length of 0.7 to 2 by a power of two, which is exact: the caster
    takes 1e-5 for parallel and -1e-6 for behind whatever the direction is. With 1/2 < s / 2^k < 2
    for the square s of its length, that over 4^floor(k / 2) lies between 1/2 and 4.
    """
    a, b = (Vec(*numbers) for numbers in zip(*placed.forms, strict=True))
    if placed.still:
        return _through(a, STRAY, ZERO, ONE)
    t0 = -(a @ b) / (b @ b)
    pace = moderate(b)
    return _through(a + t0 * b, pace * b, t0, pace)


def moderate(v: Vec) -> Fraction:
    """Return the power of two by which v gets a length of 0.7 to 2."""
    square: Fraction = v @ v
    k = (square.numerator.bit_length() - square.denominator.bit_length()) // 2
    return Fraction(2) ** -k


def _through(middle: Vec, d: Vec, t0: Fraction, pace: Fraction) -> CastLine | None:
    if max(map(abs, middle.parts)) > AWAY:
        return None
    return CastLine(floats(middle - AWAY * d), floats(d), t0, pace)
