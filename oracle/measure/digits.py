"""More digits than doubles have: mpmath, its intervals, SymPy, and arb's balls. Loaded when asked.

All compute the textbook formula; for arb, whose speed is looked at, it is written out for capped
cylinders. Enclosures decide or raise `Undecided`; an end counts only where both ends of its
enclosure round to one double. More bits are tried, up to the last of a ladder; what is undecided
then is a failure, and not a miss.

Enough bits make products of doubles exact, so that a double root is seen. But where two ends are
equal and no dyadic fraction (a touch at t = 1/3), no number of bits tells.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from math import inf
from operator import add, ge, gt, le, lt, mul, sub, truediv
from typing import Any, TypeVar

from raycert.cases.model import Cylinder, Ray, Solid
from raycert.cases.vectors import cross, dot, minus
from raycert.oracle.measure.quadratics import Arithmetic, Formula, Vector, rootless, textbook
from raycert.oracle.measure.way import Answered, Case, Pairs, Solve, lazily, one_by_one

FORMULA = partial(Formula, textbook, rootless, None)
"""The textbook formula, times |w|^2: rational but for one root."""
INTERVAL_BITS = (166, 332, 664, 1328)
ARB_BITS = (128, 256, 512, 1024, 2048)
T = TypeVar("T")


class Undecided(ArithmeticError):
    """An enclosure that is on both sides of what it is compared with."""


def ladder(bits: Sequence[int], context: Any, attempt: Callable[[], T]) -> T:
    """Return what the first number of bits decides; raises `Undecided` after the last."""
    before = context.prec
    try:
        for context.prec in bits:  # each in turn is what the library computes with
            try:
                return attempt()
            except Undecided:
                continue
    finally:
        context.prec = before
    raise Undecided(f"at {bits[-1]} bits")


def with_digits(digits: int) -> Solve:
    def make() -> Solve:
        mpmath = import_module("mpmath")
        mp, setting = mpmath.mp, partial(mpmath.workdps, digits)
        return FORMULA(Arithmetic(mp.mpf, mp.sqrt, float, setting, mp.inf))

    return lazily(make)


@lazily
def in_sympy() -> Solve:
    """Return the textbook formula in SymPy: exact, then 40 digits, from an empty cache."""
    sympy = import_module("sympy")
    forget = import_module("sympy.core.cache").clear_cache

    def number(x: float) -> Any:
        return sympy.Rational(*x.as_integer_ratio())

    def tell(x: Any) -> float:
        return inf if x == sympy.oo else float(x.evalf(40))

    exact = FORMULA(Arithmetic(number, sympy.sqrt, tell, infinity=sympy.oo))

    def solve(cases: Sequence[Case]) -> list[Answered]:
        forget()
        return exact(cases)

    return solve


@lazily
def in_intervals() -> Solve:
    """Return the textbook formula in mpmath's intervals, at 166 bits and up."""
    mpmath = import_module("mpmath")
    iv, mp = mpmath.iv, mpmath.mp

    def number(x: float) -> Box:
        return Box(iv.mpf(x))

    def tell(box: Box) -> float:
        low, high = (float(mp.make_mpf(end)) for end in box.value._mpi_)
        if low != high:
            raise Undecided
        return low

    formula = FORMULA(
        Arithmetic(number, lambda box: Box(iv.sqrt(box.value)), tell, infinity=number(inf))
    )

    def attempt(solid: Solid, ray: Ray) -> Pairs:
        return tuple((tell(a), tell(b)) for a, b in formula.node(solid, ray))

    return one_by_one(lambda *case: ladder(INTERVAL_BITS, iv, partial(attempt, *case)))


def _lifted(operation: Callable[[Any, Any], Any]) -> Callable[[Box, Box], Box]:
    return lambda self, other: Box(operation(self.value, other.value))


def _decided(
    holds: Callable[[Any, Any], Any], fails: Callable[[Any, Any], Any]
) -> Callable[[Box, Box | float], bool]:
    """Return a comparison that is sure: libraries say no, or None, where they are not."""

    def compare(self: Box, other: Box | float) -> bool:
        value = other.value if isinstance(other, Box) else other
        if holds(self.value, value):
            return True
        if fails(self.value, value):
            return False
        raise Undecided

    return compare


class Box:
    """An enclosure that compares for sure, or raises `Undecided`."""

    __slots__ = ("value",)

    def __init__(self, value: Any) -> None:
        self.value = value

    __add__, __sub__ = _lifted(add), _lifted(sub)
    __mul__, __truediv__ = _lifted(mul), _lifted(truediv)
    __lt__, __le__ = _decided(lt, ge), _decided(le, gt)
    __gt__, __ge__ = _decided(gt, le), _decided(ge, lt)

    def __neg__(self) -> Box:
        return Box(-self.value)

    def __abs__(self) -> Box:
        return Box(abs(self.value))

    def __eq__(self, other: object) -> bool:
        """Whether it is the same number: points only can be."""
        if self is other:
            return True
        assert isinstance(other, Box | int | float)
        return self <= other and self >= other

    __hash__ = None  # type: ignore[assignment]


# A capped cylinder in arb's balls (python-flint): roots, planes and order as in the tables.


def in_balls(solid: Solid, ray: Ray) -> Pairs:
    """Return the list of a capped cylinder, correctly rounded; raises `Undecided`."""
    assert isinstance(solid, Cylinder)
    flint = import_module("flint")
    return ladder(ARB_BITS, flint.ctx, lambda: _balls(flint.arb, solid, ray))


def _balls(arb: Any, solid: Cylinder, ray: Ray) -> Pairs:
    p, q, u, v = (
        (arb(x), arb(y), arb(z)) for x, y, z in (solid.p, solid.q, ray.origin, ray.direction)
    )
    w, y, z = minus(q, p), minus(u, p), minus(u, q)
    wall, slab = _wall(arb(solid.radius), w, y, v), _slab(w, y, z, v)
    if wall is None or slab is None:
        return ()
    both = (*wall, *slab)
    if not both:
        return ((0.0, inf),)
    enter, leave = arb(0), both[0][1]
    for first, last in both:
        enter, leave = enter.max(first), leave.min(last)
    return ((_rounded(enter), _rounded(leave)),) if _sign(leave - enter) >= 0 else ()


def _wall(radius: Any, w: Vector, y: Vector, v: Vector) -> list[tuple[Any, Any]] | None:
    """Return where the line is in the infinite cylinder: [] for everywhere, None for nowhere."""
    vw, yw = cross(v, w), cross(y, w)
    a, b, c = dot(vw, vw), dot(vw, yw), dot(yw, yw) - radius * radius * dot(w, w)
    if not _sign(a):
        return [] if _sign(c) <= 0 else None
    disc = b * b - a * c
    if _sign(disc) < 0:
        return None
    root = disc.sqrt()
    return [((-b - root) / a, (-b + root) / a)]


def _slab(w: Vector, y: Vector, z: Vector, v: Vector) -> list[tuple[Any, Any]] | None:
    """Return where the line is between the caps, likewise."""
    climb, at_p, at_q = dot(v, w), -dot(y, w), -dot(z, w)
    side = _sign(climb)
    if not side:
        return [] if _sign(at_p) <= 0 <= _sign(at_q) else None
    ends = (at_p / climb, at_q / climb)
    return [ends if side > 0 else ends[::-1]]


def _sign(x: Any) -> int:
    """Return the sign that all numbers of a ball have; raises `Undecided`."""
    if x > 0:
        return 1
    if x < 0:
        return -1
    if x == 0:
        return 0
    raise Undecided


def _rounded(x: Any) -> float:
    """Return the double that both ends of a ball round to; raises `Undecided`."""
    low, high = float(x.lower()), float(x.upper())
    if low != high:
        raise Undecided
    return low + 0.0
