"""Numbers of other libraries to compute with: mpmath, its intervals, SymPy. Loaded when asked.

The intervals decide or raise `Undecided`; a list counts only where both ends of each enclosure
round to one double. More bits are tried, up to `MOST`; what is undecided then is a failure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache, partial
from importlib import import_module
from math import inf
from typing import Any

from raycert.oracle.measure.methods.formulas import Arithmetic, textbook
from raycert.oracle.measure.methods.method import Answered, Case, Solve
from raycert.oracle.measure.methods.scalar import Formula, Scalar, rootless

FORMULA = Formula(textbook, rootless)
"""The textbook formula, times |w|^2: rational but for one root."""
FEWEST, MOST = 166, 1328


class Undecided(ArithmeticError):
    """An enclosure that is on both sides of what it is compared with."""


def lazily(make: Callable[[], Solve]) -> Solve:
    """Return the `solve` that is made when it is first asked."""
    made = cache(make)
    return lambda cases: made()(cases)


def with_digits(digits: int) -> Solve:
    """Return the textbook formula in mpmath, at so many decimal digits."""

    def make() -> Solve:
        mpmath = import_module("mpmath")
        mp = mpmath.mp
        setting = partial(mpmath.workdps, digits)
        return Scalar(FORMULA, Arithmetic(mp.mpf, mp.sqrt, float, setting, mp.inf))

    return lazily(make)


def with_sympy() -> Solve:
    """Return the textbook formula in SymPy: exact, then 40 digits, from an empty cache."""

    def make() -> Solve:
        sympy = import_module("sympy")
        forget = import_module("sympy.core.cache").clear_cache
        exact = Scalar(
            FORMULA,
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
        iv = mpmath.iv
        plain = Scalar(FORMULA, _enclosing(mpmath))

        def answer(case: Case) -> Answered:
            bits = FEWEST
            while bits <= MOST:
                with _bits(iv, bits):
                    found = plain.answer(case)
                if found is not None:
                    return found
                bits *= 2
            return None

        return lambda cases: [answer(case) for case in cases]

    return lazily(make)


@contextmanager
def _bits(iv: Any, bits: int) -> Iterator[None]:
    before = iv.prec
    iv.prec = bits
    try:
        yield
    finally:
        iv.prec = before


def _enclosing(mpmath: Any) -> Arithmetic:
    iv, mp = mpmath.iv, mpmath.mp

    def tell(box: Box) -> float:
        low, high = (float(mp.make_mpf(end)) for end in box.value._mpi_)
        if low != high:
            raise Undecided
        return low

    return Arithmetic(
        lambda x: Box(iv.mpf(x)),
        lambda box: Box(iv.sqrt(box.value)),
        tell,
        infinity=Box(iv.mpf(inf)),
    )


class Box:
    """An enclosure that compares for sure, or raises `Undecided`."""

    __slots__ = ("value",)

    def __init__(self, value: Any) -> None:
        """Hold an interval of mpmath."""
        self.value = value

    def __add__(self, other: Box) -> Box:
        """Return the sum."""
        return Box(self.value + other.value)

    def __sub__(self, other: Box) -> Box:
        """Return the difference."""
        return Box(self.value - other.value)

    def __mul__(self, other: Box) -> Box:
        """Return the product."""
        return Box(self.value * other.value)

    def __truediv__(self, other: Box) -> Box:
        """Return the quotient."""
        return Box(self.value / other.value)

    def __neg__(self) -> Box:
        """Return the negative."""
        return Box(-self.value)

    def __abs__(self) -> Box:
        """Return the magnitude."""
        return Box(abs(self.value))

    def __lt__(self, other: Box | float) -> bool:
        """Tell whether it is less."""
        return _sure(self.value < _value(other))

    def __le__(self, other: Box | float) -> bool:
        """Tell whether it is at most as large."""
        return _sure(self.value <= _value(other))

    def __gt__(self, other: Box | float) -> bool:
        """Tell whether it is greater."""
        return _sure(self.value > _value(other))

    def __ge__(self, other: Box | float) -> bool:
        """Tell whether it is at least as large."""
        return _sure(self.value >= _value(other))

    def __eq__(self, other: object) -> bool:
        """Tell whether it is the same number: points only can be."""
        if self is other:
            return True
        assert isinstance(other, Box | int | float)
        return _sure(self.value <= _value(other)) and _sure(self.value >= _value(other))

    __hash__ = None  # type: ignore[assignment]


def _value(other: Box | float) -> Any:
    return other.value if isinstance(other, Box) else other


def _sure(decision: bool | None) -> bool:
    if decision is None:
        raise Undecided
    return decision
