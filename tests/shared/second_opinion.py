"""The answers once more, by a road that shares no code with the oracle.

The seed's formulas in mpmath intervals, from the raw floats: w normalised, the barred vectors
ybar = y x w/|w| and vbar = v x w/|w|, roots and crossings as the seed prints them. Every decision
is a sign: the precision is doubled until an interval leaves zero out, and what does not separate by
512 bits is shown to be exactly zero in fractions, or doubled on. Rounding is done here, in
integers: `float(mpf)` rounds subnormals twice in mpmath 1.3.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import inf, ldexp
from typing import Any

from mpmath import iv
from mpmath.libmp import finf, fnan, fninf, to_rational

from raycert.cases.formats import Format
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

Approximate = Callable[[], Any]
"""A number as an mpmath interval at the precision of the moment."""
FIRST, PATIENCE, LAST = 128, 512, 1 << 17


@dataclass(frozen=True, slots=True)
class Number:
    """A real number: intervals around it, and a test whether it is exactly a fraction."""

    around: Approximate
    is_exactly: Callable[[Fraction], bool]
    fraction: Fraction | None = None


Pair = tuple[Number, Number | None]
"""(enter, leave); None is infinity."""


def rational(value: Fraction) -> Number:
    """Return a fraction as a number."""
    return Number(lambda: iv.mpf(value.numerator) / iv.mpf(value.denominator), value.__eq__, value)


ZERO = rational(Fraction(0))


def precisions() -> Iterator[int]:
    """Yield the working precisions, each set in mpmath while it is out."""
    before, bits = iv.prec, FIRST
    try:
        while bits <= LAST:
            iv.prec = bits
            yield bits
            bits *= 2
    finally:
        iv.prec = before
    raise ArithmeticError("undecided")


def sign(around: Approximate, is_zero: Callable[[], bool]) -> int:
    """Return the sign of a number, -1, 0 or 1."""
    for bits in precisions():
        value = around()
        if value.a > 0:
            return 1
        if value.b < 0:
            return -1
        if bits == PATIENCE and is_zero():
            return 0
    raise AssertionError


def compare(one: Number, two: Number) -> int:
    """Return the sign of one - two; one of them has a known fraction."""

    def equal() -> bool:
        if two.fraction is not None:
            return one.is_exactly(two.fraction)
        assert one.fraction is not None
        return two.is_exactly(one.fraction)

    return sign(lambda: one.around() - two.around(), equal)


def vector(a: Vector) -> list[Any]:
    """Return a vector of floats as intervals of no width."""
    return [iv.mpf(x) for x in a]


def minus(a: list[Any], b: list[Any]) -> list[Any]:
    """Return a - b, of intervals or of fractions."""
    return [x - y for x, y in zip(a, b, strict=True)]


def dot(a: list[Any], b: list[Any]) -> Any:
    """Return a . b, of intervals or of fractions."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: list[Any], b: list[Any]) -> list[Any]:
    """Return a x b, of intervals or of fractions."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def exactly(a: Vector) -> list[Fraction]:
    """Return a vector of floats as fractions."""
    return [Fraction(x) for x in a]


def unit(a: list[Any]) -> list[Any]:
    """Return a / |a|, of intervals."""
    length = iv.sqrt(dot(a, a))
    return [x / length for x in a]


def barred(leaf: Sphere | InfiniteCylinder | Cylinder, ray: Ray) -> tuple[list[Any], list[Any]]:
    """Return (vbar, ybar) of Problem 1; of a sphere v and y themselves."""
    u, v = vector(ray.origin), vector(ray.direction)
    if isinstance(leaf, Sphere):
        return v, minus(u, vector(leaf.center))
    p = vector(leaf.p)
    w = unit(minus(vector(leaf.q), p))
    return cross(v, w), cross(minus(u, p), w)


def condition(
    leaf: Sphere | InfiniteCylinder | Cylinder, ray: Ray
) -> tuple[Fraction, Fraction, Fraction]:
    """Return (a, b, c) of a t^2 + 2 b t + c <= 0 in fractions, to show that something is 0."""
    u, v, r = exactly(ray.origin), exactly(ray.direction), Fraction(leaf.radius)
    if isinstance(leaf, Sphere):
        y = minus(u, exactly(leaf.center))
        return dot(v, v), dot(v, y), dot(y, y) - r * r
    y, w = minus(u, exactly(leaf.p)), minus(exactly(leaf.q), exactly(leaf.p))
    ww, vw, yw = dot(w, w), dot(v, w), dot(y, w)  # projected, not crossed
    return dot(v, v) * ww - vw * vw, dot(v, y) * ww - vw * yw, (dot(y, y) - r * r) * ww - yw * yw


def round_face(leaf: Sphere | InfiniteCylinder | Cylinder, ray: Ray) -> list[Pair]:
    """Problem 1."""
    a, b, c = condition(leaf, ray)
    r = leaf.radius

    def inside() -> Any:
        ybar = barred(leaf, ray)[1]
        return iv.mpf(r) ** 2 - dot(ybar, ybar)

    def discriminant() -> Any:
        vbar, ybar = barred(leaf, ray)
        area = cross(vbar, ybar)
        return iv.mpf(r) ** 2 * dot(vbar, vbar) - dot(area, area)

    if sign(lambda: dot(*[barred(leaf, ray)[0]] * 2), lambda: a == 0) == 0:
        return [] if sign(inside, lambda: c == 0) < 0 else [(ZERO, None)]
    touches = sign(discriminant, lambda: b * b == a * c)
    if touches < 0:
        return []

    def root(way: int) -> Number:
        def around() -> Any:
            vbar, ybar = barred(leaf, ray)
            top = -dot(vbar, ybar)
            if touches:
                d = discriminant()
                top += way * iv.sqrt(iv.mpf([max(d.a, 0), d.b]))
            return top / dot(vbar, vbar)

        def is_exactly(t: Fraction) -> bool:
            return a * t * t + 2 * b * t + c == 0 and (a * t + b) * way >= 0

        return Number(around, is_exactly)

    t1, t2 = root(-1), root(1)
    if compare(t2, ZERO) < 0:
        return []
    return [(ZERO if compare(t1, ZERO) < 0 else t1, t2)]


def plane(
    point: Vector, outward: Callable[[], list[Any]], exact: list[Fraction], ray: Ray
) -> list[Pair]:
    """Problem 2 (c), with the outward normal as intervals and as fractions."""
    u, v = exactly(ray.origin), exactly(ray.direction)
    height, climb = dot(minus(u, exactly(point)), exact), dot(v, exact)

    def over() -> Any:
        return dot(minus(vector(ray.origin), vector(point)), unit(outward()))

    def up() -> Any:
        return dot(vector(ray.direction), unit(outward()))

    above, way = sign(over, lambda: height == 0), sign(up, lambda: climb == 0)
    if above > 0 and way >= 0:
        return []
    if way == 0 or (above <= 0 and way < 0):
        return [(ZERO, None)]
    t = -height / climb
    crossing = Number(lambda: -over() / up(), t.__eq__, t)
    return [(ZERO, crossing)] if way > 0 else [(crossing, None)]


def caps(leaf: Slab | Cylinder, ray: Ray) -> list[list[Pair]]:
    """Problem 2: the two planes of a slab."""
    p, q = leaf.p, leaf.q
    return [
        plane(a, lambda a=a, b=b: minus(vector(a), vector(b)), minus(exactly(a), exactly(b)), ray)
        for a, b in ((p, q), (q, p))
    ]


def common(lists: list[list[Pair]]) -> list[Pair]:
    """Problem 3: what lists of one pair at most have in common."""
    if not all(lists):
        return []
    enter, leave = lists[0][0]
    for ((c, d),) in lists[1:]:
        enter = c if compare(c, enter) > 0 else enter
        if d is not None and (leave is None or compare(d, leave) < 0):
            leave = d
    if leave is not None and compare_any(enter, leave) > 0:
        return []
    return [(enter, leave)]


def compare_any(enter: Number, leave: Number) -> int:
    """Compare the ends of a pair: the two roots of one face are in order as they are."""
    if enter.fraction is None and leave.fraction is None:
        return -1
    return compare(enter, leave)


def solve(leaf: Leaf, ray: Ray) -> list[Pair]:
    """Return the exact list of a leaf."""
    match leaf:
        case HalfSpace(point, normal):
            return plane(point, lambda: vector(normal), exactly(normal), ray)
        case Sphere() | InfiniteCylinder():
            return round_face(leaf, ray)
        case Slab():
            return common(caps(leaf, ray))
    return common([round_face(leaf, ray), *caps(leaf, ray)])


def grid(value: Fraction, fmt: Format) -> Fraction:
    """Return the distance of the numbers of a format just above |value|, a finite one."""
    if not value:
        return Fraction(2) ** fmt.least
    e = abs(value.numerator).bit_length() - value.denominator.bit_length()
    e -= abs(value) < Fraction(2) ** e
    return Fraction(2) ** max(e + 1 - fmt.precision, fmt.least)


def nearest(number: Number | None, fmt: Format) -> float:
    """Return a number >= 0 rounded to nearest even."""
    if number is None:
        return inf
    if compare(number, ZERO) == 0:
        return 0.0
    for bits in precisions():
        value = number.around()
        ends = value.a._mpi_[0], value.b._mpi_[0]
        if {finf, fninf, fnan}.intersection(ends):
            continue  # a divisor not yet told from 0
        low, high = (Fraction(*to_rational(end)) for end in ends)
        step = grid(low, fmt)
        floor = low // step * step
        middle = floor + step / 2
        if high < middle or (middle < low and high < floor + step):
            return finite(floor if high < middle else floor + step, fmt)
        if bits >= PATIENCE and low <= middle <= high and number.is_exactly(middle):
            return finite(floor if floor / step % 2 == 0 else floor + step, fmt)
        if bits >= PATIENCE and number.is_exactly(floor + step):
            return finite(floor + step, fmt)
    raise AssertionError


def finite(value: Fraction, fmt: Format) -> float:
    """Return a number of the format, or infinity where it is beyond the largest."""
    if value >= Fraction(2) ** fmt.overflow:
        return inf
    top, bottom = value.as_integer_ratio()
    shift = max(top.bit_length() - fmt.precision, 0)
    return ldexp(top >> shift, shift - bottom.bit_length() + 1)


def second_opinion(leaf: Leaf, ray: Ray, fmt: Format) -> list[tuple[float, float]]:
    """Return the list of a leaf, each endpoint rounded to nearest even."""
    return [(nearest(enter, fmt), nearest(leave, fmt)) for enter, leave in solve(leaf, ray)]
