"""More digits than doubles have: mpmath, its intervals, SymPy, and arb's balls. Loaded when asked.

All compute the textbook formula. Enclosures decide or raise `Undecided`; an end counts only where
both ends of its enclosure round to one double. More bits are tried, up to the last of a ladder;
what is undecided then is a failure, and not a miss.

Enough bits make products of doubles exact, so that a double root is seen. But where two ends are
equal and no dyadic fraction (a touch at t = 1/3), no number of bits tells.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from math import inf
from operator import add, ge, gt, le, lt, mul, sub, truediv
from typing import Any

from raycert.cases.model import Ray, Solid
from raycert.oracle.measure.formulas import Arithmetic, Formula, rootless, textbook
from raycert.oracle.measure.way import Answered, Case, Pairs, Solve, lazily, one_by_one

FORMULA = partial(Formula, textbook, rootless, None)
"""The textbook formula, times |w|^2: rational but for one root."""
INTERVAL_BITS = (166, 332, 664, 1328)
ARB_BITS = (128, 256, 512, 1024, 2048)


class Undecided(ArithmeticError):
    """An enclosure that is on both sides of what it is compared with."""


def with_digits(digits: int) -> Solve:
    """Return the textbook formula in mpmath, at so many decimal digits."""

    def make() -> Solve:
        mpmath = import_module("mpmath")
        mp, setting = mpmath.mp, partial(mpmath.workdps, digits)
        return FORMULA(Arithmetic(mp.mpf, mp.sqrt, float, setting, mp.inf))

    return lazily(make)


def with_sympy() -> Solve:
    """Return the textbook formula in SymPy: exact, then 40 digits, from an empty cache."""

    def make() -> Solve:
        sympy = import_module("sympy")
        forget = import_module("sympy.core.cache").clear_cache
        exact = FORMULA(
            Arithmetic(
                lambda x: sympy.Rational(*x.as_integer_ratio()),
                sympy.sqrt,
                lambda x: inf if x == sympy.oo else float(x.evalf(40)),
                infinity=sympy.oo,
            ),
        )

        def solve(cases: Sequence[Case]) -> list[Answered]:
            forget()
            return exact(cases)

        return solve

    return lazily(make)


def with_intervals() -> Solve:
    """Return the textbook formula in mpmath's intervals, at 166 bits and up."""

    def make() -> Solve:
        mpmath = import_module("mpmath")
        iv, mp = mpmath.iv, mpmath.mp

        def ends(x: Any) -> tuple[float, float]:
            low, high = (float(mp.make_mpf(end)) for end in x._mpi_)
            return low, high

        return ladder(INTERVAL_BITS, iv, enclosing(iv.mpf, iv.sqrt, ends, iv.mpf(inf)))

    return lazily(make)


def with_arb() -> Solve:
    """Return the textbook formula in the balls of arb (python-flint), at 128 bits and up."""

    def make() -> Solve:
        flint = import_module("flint")
        arb = flint.arb

        def ends(x: Any) -> tuple[float, float]:
            return float(x.lower()), float(x.upper())

        return ladder(ARB_BITS, flint.ctx, enclosing(arb, arb.sqrt, ends, arb.pos_inf()))

    return lazily(make)


def ladder(bits: Sequence[int], context: Any, arithmetic: Arithmetic) -> Solve:
    """Return the textbook formula, at the first number of bits that decides."""
    formula, tell = FORMULA(arithmetic), arithmetic.tell

    def intersect(solid: Solid, ray: Ray) -> Pairs:
        before = context.prec
        try:
            for context.prec in bits:  # each in turn is what the library computes with
                try:
                    return tuple((tell(a), tell(b)) for a, b in formula.node(solid, ray))
                except Undecided:
                    continue
        finally:
            context.prec = before
        raise Undecided(f"at {bits[-1]} bits")

    return one_by_one(intersect)


def enclosing(
    number: Callable[[Any], Any],
    root: Callable[[Any], Any],
    ends: Callable[[Any], tuple[float, float]],
    infinity: Any,
) -> Arithmetic:
    """Return the arithmetic of enclosures of a library; `ends` are those of one, as doubles."""

    def tell(box: Box) -> float:
        low, high = ends(box.value)
        if low != high:
            raise Undecided
        return low

    return Arithmetic(
        lambda x: Box(number(x)), lambda box: Box(root(box.value)), tell, infinity=Box(infinity)
    )


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
        """Hold an interval or a ball of a library."""
        self.value = value

    __add__, __sub__ = _lifted(add), _lifted(sub)
    __mul__, __truediv__ = _lifted(mul), _lifted(truediv)
    __lt__, __le__ = _decided(lt, ge), _decided(le, gt)
    __gt__, __ge__ = _decided(gt, le), _decided(ge, lt)

    def __neg__(self) -> Box:
        """Return the negative."""
        return Box(-self.value)

    def __abs__(self) -> Box:
        """Return the magnitude."""
        return Box(abs(self.value))

    def __eq__(self, other: object) -> bool:
        """Whether it is the same number: points only can be."""
        if self is other:
            return True
        assert isinstance(other, Box | int | float)
        return self <= other and self >= other

    __hash__ = None  # type: ignore[assignment]
