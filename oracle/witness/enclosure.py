"""Witness by enclosure: the derivation's formulas, in interval arithmetic.

Every quantity is an interval (mpmath's context `iv`) that contains the exact value. A decision is
taken where the interval has one sign, or where the exact polynomial says zero; else everything is
computed again with twice the bits, up to `CAP`, beyond which the witness is undecided.

The formulas are those of Problems 1 to 3, with h = w/|w|, vbar = v x h, ybar = y x h:

    t = (-vbar.ybar -+ sqrt(r^2 vbar.vbar - |vbar x ybar|^2)) / vbar.vbar
    tp = -(u - p).n / v.n                                   n = (p - q) / |p - q|

a sphere's being those of Problem 1 with v and y themselves.

An endpoint is an enclosure that carries its polynomial: order by the one, equality by the other.
Two enclosures that do not overlap are in order. Two that do are one number only if their
polynomials have a common root and both stand for it, which is decided in fractions; else they are
`Blurred`, and have to be computed again, more precisely.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cmp_to_key
from itertools import groupby
from typing import Any

from mpmath import iv, mp, nstr

from raycert.cases.model import (
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Vector,
    leaves,
)
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import Surd
from raycert.oracle.witness.algebra import Vec, combine, runs, span
from raycert.oracle.witness.testimony import Testimony, compared

FIRST, CAP = 128, 1 << 15
"""Bits of precision. Numbers of binary64 differ by up to 2^2100, degree 6 in them by 2^12600."""

Box = Any
"""An interval of mpmath's context `iv`."""
Polynomial = tuple[Fraction, ...]
"""Coefficients from the highest power down, the first not zero."""
Both = tuple[Vec, Vec]
"""A vector in boxes, and one in fractions of which it is a positive multiple."""


class Blurred(ArithmeticError):
    """Two numbers that are not equal, and whose enclosures overlap at this precision."""


@dataclass(frozen=True, slots=True, eq=False)
class Enclosed:
    """The `root`-th root of `polynomial`, which lies in `box`."""

    box: Box
    polynomial: Polynomial
    root: int


End = Enclosed | None
"""An end of an interval; None is infinity."""
Pair = tuple[Enclosed, End]
START = Enclosed(iv.mpf(0), (Fraction(1), Fraction(0)), 0)
"""t = 0."""


def witness(solid: Solid, ray: Ray, answer: Intervals, cap: int = CAP) -> Testimony:
    """Agree where every end of the answer is exactly the number enclosed; undecided past `cap`."""
    bits = FIRST
    while bits <= cap:
        with precision(bits):
            try:
                agreed = f"every end is in its enclosure, at {bits} bits"
                return compared(solve(solid, ray), answer, _show, _fault, agreed)
            except Blurred:
                bits *= 2
    why = f"a decision is not separated from zero at {bits // 2} bits"
    return Testimony("undecided", "", why)


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Set the precision of mpmath's interval context, and put it back."""
    before = iv.prec
    iv.prec = bits
    try:
        yield
    finally:
        iv.prec = before


def _fault(mine: End, t: Surd) -> str | None:
    """Return what is wrong with an endpoint of the answer; None if nothing is."""
    if mine is None or not t.finite:
        return None if mine is None and not t.finite else "is infinite in one of the lists only"
    box = (t.x + t.y * iv.sqrt(iv.mpf(t.d))) / t.z
    if box < mine.box or box > mine.box:
        return "is outside the enclosure"
    x, y, d, z = map(Fraction, (t.x, t.y, t.d, t.z))
    polynomial = (z * z, -2 * x * z, x * x - y * y * d) if y else (z, -x)
    same_number = same(mine, Enclosed(box, polynomial, int(y > 0)))
    return None if same_number else "is in the enclosure, and another number"


def _show(end: End) -> str:
    return "inf" if end is None else str(nstr(mp.make_mpf(end.box.mid._mpi_[0]), 20))


def solve(solid: Solid, ray: Ray) -> list[Pair]:
    """Return the interval list at the precision set. Raises `Blurred` where it does not suffice."""
    lists = {id(leaf): _leaf(leaf, ray) for _, leaf in leaves(solid)}
    ends = distinct([START, *(e for pairs in lists.values() for pair in pairs for e in pair if e)])

    def cells(leaf: Leaf) -> int:
        return sum(span(rank(a) or 0, rank(b), len(ends)) for a, b in lists[id(leaf)])

    def rank(end: End) -> int | None:
        return None if end is None else next(i for i, e in enumerate(ends) if not compare(e, end))

    return runs(combine(solid, cells, len(ends)), ends)


def _leaf(leaf: Leaf, ray: Ray) -> list[Pair]:
    match leaf:
        case HalfSpace():
            return _plane(leaf.point, _both(leaf.normal), ray)
        case Sphere():
            start = _between(leaf.center, ray.origin)
            return _round(start, _both(ray.direction), leaf.radius, Fraction(1))
    n, exact_n = _between(leaf.q, leaf.p)
    lists: list[list[Pair]] = []
    if not isinstance(leaf, Slab):
        (y, exact_y), (v, exact_v) = _between(leaf.p, ray.origin), _both(ray.direction)
        hat = _unit(n)  # the boxes are crossed with w/|w|, the fractions with w
        barred = (y ^ hat, exact_y ^ exact_n), (v ^ hat, exact_v ^ exact_n)
        lists.append(_round(*barred, leaf.radius, exact_n @ exact_n))
    if not isinstance(leaf, InfiniteCylinder):
        lists += [_plane(leaf.p, (n, exact_n), ray), _plane(leaf.q, (-n, -exact_n), ray)]
    return _common(*lists)


def _round(y: Both, v: Both, radius: float, square: Fraction) -> list[Pair]:
    """Return what the six rows of Problem 1 (m) emit, for the barred y and v.

    `square` is what the squares of the exact ones are multiplied by.
    """
    (ybar, exact_y), (vbar, exact_v) = y, v
    a, b = exact_v @ exact_v, 2 * (exact_v @ exact_y)
    c = exact_y @ exact_y - Fraction(radius) ** 2 * square
    r, vv, vy = iv.mpf(radius), vbar @ vbar, vbar @ ybar
    if sign(vv, a) == 0:
        return [] if sign(r * r - ybar @ ybar, -c) < 0 else [(START, None)]
    area = vbar ^ ybar
    disc = r * r * vv - area @ area
    touch = sign(disc, b * b - 4 * a * c)
    if touch < 0:
        return []
    root = iv.sqrt(disc) if touch else iv.mpf(0)
    t1, t2 = (Enclosed((-vy + s * root) / vv, (a, b, c), i) for i, s in enumerate((-1, 1)))
    if compare(t2, START) < 0:
        return []
    return [(START if compare(t1, START) < 0 else t1, t2)]


def _plane(point: Vector, normal: Both, ray: Ray) -> list[Pair]:
    """Return the list of Problem 2 (c), A to D, of a half-space with the outward normal."""
    (y, exact_y), (v, exact_v) = _between(point, ray.origin), _both(ray.direction)
    hat, exact_n = _unit(normal[0]), normal[1]
    above, exact_above = y @ hat, exact_y @ exact_n
    along, exact_along = v @ hat, exact_v @ exact_n
    outside, rising = sign(above, exact_above) > 0, sign(along, exact_along)
    if not rising:
        return [] if outside else [(START, None)]
    t = Enclosed(-above / along, (exact_along, exact_above), 0)
    if outside:
        return [] if rising > 0 else [(t, None)]
    return [(START, t if rising > 0 else None)]


def _common(first: list[Pair], *others: list[Pair]) -> list[Pair]:
    """Return the list of Problem 3, [max(a, c), min(b, d)] if that is not empty, of several."""
    for other in others:
        if not first or not other:
            return []
        (a, b), (c, d) = first[0], other[0]
        m = a if compare(a, c) > 0 else c
        n = b if compare(b, d) < 0 else d
        first = [] if compare(m, n) > 0 else [(m, n)]
    return first


def _both(vector: Vector) -> Both:
    return Vec.of(vector, iv.mpf), Vec.of(vector, Fraction)


def _between(start: Vector, end: Vector) -> Both:
    (a, exact_a), (b, exact_b) = _both(end), _both(start)
    return a - b, exact_a - exact_b


def _unit(vector: Vec) -> Vec:
    """Return a vector of length 1; |vector| > 0 at any precision, its parts being almost exact."""
    length = iv.sqrt(vector @ vector)
    if not length > 0:
        raise Blurred
    hat: Vec = vector / length
    return hat


def compare(one: End, two: End) -> int:
    """Return the sign of one - two, infinity being equal to itself. Raises `Blurred`."""
    if one is None or two is None:
        return (one is None) - (two is None)
    if one.box < two.box:
        return -1
    if one.box > two.box:
        return 1
    if same(one, two):
        return 0
    raise Blurred


def sign(box: Box, exact: Fraction) -> int:
    """Return the sign of a number in `box`, zero only where `exact` is. Raises `Blurred`.

    `exact` is a positive multiple of the number; where the two have opposite signs, the formula and
    its polynomial differ, which raises a plain `ArithmeticError`.
    """
    if exact == 0:
        return 0
    if not (box > 0 or box < 0):
        raise Blurred
    if (box > 0) != (exact > 0):
        raise ArithmeticError(f"{box} is an enclosure of a number of the other sign")
    return 1 if box > 0 else -1


def same(one: Enclosed, two: Enclosed) -> bool:
    """Whether two ends are one number: their polynomials share a root, and both stand for it.

    Different polynomials of degree 2 at most share one root at most, and that is rational: the root
    of the linear one, or of the difference of two monic quadratics.
    """
    p, q = ([c / end.polynomial[0] for c in end.polynomial[1:]] for end in (one, two))
    if p == q:
        return one.root == two.root or (len(p) == 2 and p[0] * p[0] == 4 * p[1])
    if len(p) == len(q):
        if p[0] == q[0] or len(p) == 1:
            return False
        shared = (q[1] - p[1]) / (p[0] - q[0])
    else:
        shared = -min(p, q, key=len)[0]
    return _is(one, shared) and _is(two, shared)


def _is(end: Enclosed, x: Fraction) -> bool:
    """Whether an end is x: a root of its polynomial, and the one that it stands for."""
    if len(end.polynomial) == 2:
        return end.polynomial[0] * x + end.polynomial[1] == 0
    a, b, c = end.polynomial
    other = -b / a - x
    return a * x * x + b * x + c == 0 and (x == other or end.root == int(x > other))


def distinct(ends: Iterable[Enclosed]) -> list[Enclosed]:
    """Return the ends in order, one for each number. Raises `Blurred`."""
    order = cmp_to_key(compare)
    return [next(group) for _, group in groupby(sorted(ends, key=order), key=order)]
