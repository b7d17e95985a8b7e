"""Witness by enclosure: the seed's published formulas, in interval arithmetic.

Every quantity is an interval (mpmath's context `iv`) that contains the exact value. A decision is
taken where the interval has one sign, or where the exact polynomial says zero; else everything is
computed again with twice the bits, up to `CAP`, beyond which the witness is undecided.

The formulas are Problem 1 to 3 of the seed, with what = w/|w|, vbar = v x what, ybar = y x what:

    t = (-vbar.ybar -+ sqrt(r^2 vbar.vbar - |vbar x ybar|^2)) / vbar.vbar
    tp = -(u - p).n / v.n                                   n = (p - q) / |p - q|

a sphere's being those of Problem 1 with v and y themselves.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction

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
from raycert.oracle.witness.cells import combine, runs, span
from raycert.oracle.witness.ends import (
    Blurred,
    Box,
    End,
    MaybeEnd,
    Pair,
    compare,
    distinct,
    same,
    sign,
)
from raycert.oracle.witness.verdict import Verdict, lengths_differ

FIRST, CAP = 128, 1 << 15
"""Bits of precision. Numbers of binary64 differ by up to 2^2100, degree 6 in them by 2^12600."""

Boxes = tuple[Box, Box, Box]
Fractions = tuple[Fraction, Fraction, Fraction]
Quantity = tuple[Box, Fraction]
"""An enclosure, and an exact number of which it encloses a positive multiple."""


def witness(solid: Solid, ray: Ray, answer: Intervals, cap: int = CAP) -> Verdict:
    """Agree where every end of the answer is exactly the number enclosed; undecided past `cap`."""
    bits = FIRST
    while bits <= cap:
        with precision(bits):
            try:
                return _compare(solve(solid, ray), answer)
            except Blurred:
                bits *= 2
    return Verdict("undecided", "", f"a decision is not separated from zero at {bits // 2} bits")


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Set the precision of mpmath's interval context, and put it back."""
    before = iv.prec
    iv.prec = bits
    try:
        yield
    finally:
        iv.prec = before


def _compare(found: list[Pair], answer: Intervals) -> Verdict:
    text = "[" + ", ".join(f"[{_text(a)}, {_text(b)}]" for a, b in found) + "]"
    if len(found) != len(answer):
        return Verdict("disagreed", text, lengths_differ(len(found), len(answer)))
    for number, (pair, other) in enumerate(zip(found, answer, strict=True)):
        for name, mine, t in zip(("enter", "leave"), pair, other, strict=True):
            if why := _fault(mine, t):
                return Verdict("disagreed", text, f"the {name} of interval {number} {why}")
    return Verdict("agreed", text, f"every end is in its enclosure, at {iv.prec} bits")


def _fault(mine: MaybeEnd, t: Surd) -> str | None:
    """Return what is wrong with an endpoint of the answer; None if nothing is."""
    if mine is None or not t.finite:
        return None if mine is None and not t.finite else "is infinite in one of the lists only"
    box = (t.x + t.y * iv.sqrt(iv.mpf(t.d))) / t.z
    if box < mine.box or box > mine.box:
        return "is outside the enclosure"
    x, y, d, z = map(Fraction, (t.x, t.y, t.d, t.z))
    polynomial = (z * z, -2 * x * z, x * x - y * y * d) if y else (z, -x)
    same_number = same(mine, End(box, polynomial, int(y > 0)))
    return None if same_number else "is in the enclosure, and another number"


def _text(end: MaybeEnd) -> str:
    return "inf" if end is None else str(nstr(mp.make_mpf(end.box.mid._mpi_[0]), 20))


def solve(solid: Solid, ray: Ray) -> list[Pair]:
    """Return the interval list at the precision set. Raises `Blurred` where it does not suffice."""
    scene = _Scene(ray)
    lists = {id(leaf): _leaf(leaf, scene) for _, leaf in leaves(solid)}
    ends = distinct([scene.zero, *(e for pairs in lists.values() for p in pairs for e in p if e)])

    def cells(leaf: Leaf) -> int:
        return sum(span(rank(a) or 0, rank(b), len(ends)) for a, b in lists[id(leaf)])

    def rank(end: MaybeEnd) -> int | None:
        return None if end is None else next(i for i, e in enumerate(ends) if not compare(e, end))

    found = runs(combine(solid, cells, len(ends)), len(ends))
    return [(ends[a], None if b is None else ends[b]) for a, b in found]


class _Scene:
    """The ray as intervals and as fractions."""

    def __init__(self, ray: Ray) -> None:
        self.u, self.v = _boxes(ray.origin), _boxes(ray.direction)
        self.exact_u, self.exact_v = _fractions(ray.origin), _fractions(ray.direction)
        self.zero = End(iv.mpf(0), (Fraction(1), Fraction(0)), 0)


def _leaf(leaf: Leaf, scene: _Scene) -> list[Pair]:
    match leaf:
        case HalfSpace():
            return _plane(scene, leaf.point, _boxes(leaf.normal), _fractions(leaf.normal))
        case Sphere():
            return _sphere(leaf, scene)
    exact = _sub(_fractions(leaf.p), _fractions(leaf.q))
    n = _sub(_boxes(leaf.p), _boxes(leaf.q))
    if isinstance(leaf, InfiniteCylinder):
        return _rod(leaf.p, leaf.radius, n, exact, scene)
    minus = (-n[0], -n[1], -n[2]), (-exact[0], -exact[1], -exact[2])
    caps = _common(_plane(scene, leaf.p, n, exact), _plane(scene, leaf.q, *minus))
    if isinstance(leaf, Slab):
        return caps
    return _common(_rod(leaf.p, leaf.radius, n, exact, scene), caps)


def _sphere(leaf: Sphere, scene: _Scene) -> list[Pair]:
    """Return the list of a sphere, |y + t v|^2 = r^2."""
    y = _sub(scene.u, _boxes(leaf.center))
    exact_y = _sub(scene.exact_u, _fractions(leaf.center))
    v, r = scene.exact_v, Fraction(leaf.radius)
    polynomial = _dot(v, v), 2 * _dot(v, exact_y), _dot(exact_y, exact_y) - r * r
    return _round(scene, y, scene.v, leaf.radius, polynomial)


def _rod(p: Vector, radius: float, n: Boxes, exact: Fractions, scene: _Scene) -> list[Pair]:
    """Return the list of Problem 1, the infinite cylinder. The sign of what cancels."""
    hat = _unit(n)
    y = _cross(_sub(scene.u, _boxes(p)), hat)
    yw = _cross(_sub(scene.exact_u, _fractions(p)), exact)
    vw, r = _cross(scene.exact_v, exact), Fraction(radius)
    polynomial = _dot(vw, vw), 2 * _dot(vw, yw), _dot(yw, yw) - r * r * _dot(exact, exact)
    return _round(scene, y, _cross(scene.v, hat), radius, polynomial)


def _round(scene: _Scene, y: Boxes, v: Boxes, radius: float, polynomial: Fractions) -> list[Pair]:
    """Return what the six rows of Problem 1 (m) emit, for the barred y and v."""
    a, b, c = polynomial
    r, vv, vy = iv.mpf(radius), _dot(v, v), _dot(v, y)
    if sign(vv, a) == 0:
        return [] if sign(r * r - _dot(y, y), -c) < 0 else [(scene.zero, None)]
    vxy = _cross(v, y)
    disc = r * r * vv - _dot(vxy, vxy)
    match sign(disc, b * b - 4 * a * c):
        case -1:
            return []
        case 0:
            root = iv.mpf(0)
        case _:
            root = iv.sqrt(disc)
    t1, t2 = End((-vy - root) / vv, polynomial, 0), End((-vy + root) / vv, polynomial, 1)
    if compare(t2, scene.zero) < 0:
        return []
    return [(scene.zero if compare(t1, scene.zero) < 0 else t1, t2)]


def _plane(scene: _Scene, point: Vector, n: Boxes, exact: Fractions) -> list[Pair]:
    """Return the list of Problem 2 (c), A to D, of a half-space with the outward normal n."""
    hat = _unit(n)
    above = _dot(_sub(scene.u, _boxes(point)), hat)
    exact_above = _dot(_sub(scene.exact_u, _fractions(point)), exact)
    along, exact_along = _dot(scene.v, hat), _dot(scene.exact_v, exact)
    outside, rising = sign(above, exact_above) > 0, sign(along, exact_along)
    if not rising:
        return [] if outside else [(scene.zero, None)]
    t = End(-above / along, (exact_along, exact_above), 0)
    if outside:
        return [] if rising > 0 else [(t, None)]
    return [(scene.zero, t if rising > 0 else None)]


def _common(one: list[Pair], two: list[Pair]) -> list[Pair]:
    """Return the list of Problem 3: [max(a, c), min(b, d)] if that is not empty."""
    if not one or not two:
        return []
    (a, b), (c, d) = one[0], two[0]
    m = a if compare(a, c) > 0 else c
    n = b if compare(b, d) < 0 else d
    return [] if compare(m, n) > 0 else [(m, n)]


def _boxes(vector: Vector) -> Boxes:
    x, y, z = vector
    return iv.mpf(x), iv.mpf(y), iv.mpf(z)


def _fractions(vector: Vector) -> Fractions:
    x, y, z = vector
    return Fraction(x), Fraction(y), Fraction(z)


def _sub(a: tuple[Box, Box, Box], b: tuple[Box, Box, Box]) -> tuple[Box, Box, Box]:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: tuple[Box, Box, Box], b: tuple[Box, Box, Box]) -> Box:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: tuple[Box, Box, Box], b: tuple[Box, Box, Box]) -> tuple[Box, Box, Box]:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _unit(vector: Boxes) -> Boxes:
    """Return a vector of length 1; |vector| > 0 at any precision, its parts being almost exact."""
    length = iv.sqrt(_dot(vector, vector))
    if not length > 0:
        raise Blurred
    return vector[0] / length, vector[1] / length, vector[2] / length
