"""Arrays of unevaluated sums h + l, with the operators of numbers: about 106 bits.

The arithmetic is that of the batch oracle; nothing here is bounded or scaled, so that it ends
where its products leave the range of doubles.
"""

from __future__ import annotations

from typing import Any

from raycert.oracle.batch import arithmetic

Array = Any


class DoubleDouble:
    """A pair of arrays; what is not a pair is taken as doubles."""

    __slots__ = ("high", "low")

    def __init__(self, high: Array, low: Array = 0.0) -> None:
        """Hold high + low."""
        self.high, self.low = high, low

    @property
    def pair(self) -> tuple[Array, Array]:
        """Return both parts."""
        return self.high, self.low

    def __add__(self, other: DoubleDouble) -> DoubleDouble:
        """Return the sum."""
        return DoubleDouble(*arithmetic.add(self.pair, other.pair))

    def __sub__(self, other: DoubleDouble) -> DoubleDouble:
        """Return the difference."""
        return DoubleDouble(*arithmetic.sub(self.pair, other.pair))

    def __mul__(self, other: DoubleDouble) -> DoubleDouble:
        """Return the product."""
        return DoubleDouble(*arithmetic.mul(self.pair, other.pair))

    def __truediv__(self, other: DoubleDouble) -> DoubleDouble:
        """Return the quotient."""
        return DoubleDouble(*arithmetic.div(self.pair, other.pair))

    def __neg__(self) -> DoubleDouble:
        """Return the negative."""
        return DoubleDouble(-self.high, -self.low)

    def __lt__(self, other: DoubleDouble | float) -> Array:
        """Tell in which lanes it is less."""
        high, low = other.pair if isinstance(other, DoubleDouble) else (other, 0.0)
        return (self.high < high) | ((self.high == high) & (self.low < low))

    def __gt__(self, other: DoubleDouble | float) -> Array:
        """Tell in which lanes it is greater."""
        high, low = other.pair if isinstance(other, DoubleDouble) else (other, 0.0)
        return (self.high > high) | ((self.high == high) & (self.low > low))
