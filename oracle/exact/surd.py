"""Numbers of degree 1 and 2: (x + y sqrt(d)) / z in integers, with a total order.

Order and equality are decided by signs of integers, also between different quadratic fields;
there is no tolerance and no refinement loop. Infinity is (1 + 0 sqrt(0)) / 0: with z = 0 the same
cross-multiplication orders it above every number and equal to itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import total_ordering
from math import gcd, isqrt


def sign(n: int) -> int:
    """Return -1, 0 or 1."""
    return (n > 0) - (n < 0)


def sign_1(a: int, b: int, d: int) -> int:
    """Return the sign of a + b sqrt(d), d >= 0.

    Where a and b sqrt(d) have opposite signs, that of the larger square wins.
    """
    s, r = sign(a), sign(b) if d else 0
    if s == r or not r:
        return s
    return s * sign(a * a - b * b * d) if s else r


def sign_2(a: int, b: int, d: int, c: int, e: int) -> int:
    """Return the sign of a + b sqrt(d) + c sqrt(e), d >= 0 and e >= 0.

    Where the signs differ, (a + b sqrt(d))^2 - c^2 e = (a^2 + b^2 d - c^2 e) + 2 a b sqrt(d)
    decides.
    """
    s, r = sign_1(a, b, d), sign(c) if e else 0
    if s == r or not r:
        return s
    return s * sign_1(a * a + b * b * d - c * c * e, 2 * a * b, d) if s else r


@total_ordering
@dataclass(frozen=True, slots=True, eq=False)
class Surd:
    """(x + y sqrt(d)) / z with d >= 0 and z > 0; z = 0 (then x = 1, y = d = 0) is infinity.

    Equal numbers compare equal and hash alike, however they are represented.
    """

    x: int
    y: int
    d: int
    z: int

    def compare(self, other: Surd) -> int:
        """Return the sign of self - other; infinity equals itself."""
        a = self.x * other.z - other.x * self.z
        if not self.y:
            return sign_1(a, -other.y * self.z, other.d)
        if not other.y:
            return sign_1(a, self.y * other.z, self.d)
        if self.d == other.d:
            return sign_1(a, self.y * other.z - other.y * self.z, self.d)
        return sign_2(a, self.y * other.z, self.d, -other.y * self.z, other.d)

    def sign(self) -> int:
        """Return the sign of the number."""
        return sign_1(self.x, self.y, self.d)

    def __eq__(self, other: object) -> bool:
        """Decide equality as numbers."""
        return self.compare(other) == 0 if isinstance(other, Surd) else NotImplemented

    def __lt__(self, other: Surd) -> bool:
        """Decide order as numbers."""
        return self.compare(other) < 0

    def __hash__(self) -> int:
        """Hash the minimal polynomial and the root index, which equal numbers share."""
        return hash((self.polynomial(), self.root()))

    @property
    def finite(self) -> bool:
        """Tell whether this is a number and not infinity."""
        return self.z != 0

    def rational(self) -> Fraction | None:
        """Return the number as a fraction if it is rational, else None. Infinity is not."""
        root = isqrt(self.d)
        if not self.z or (self.y and root * root != self.d):
            return None
        return Fraction(self.x + self.y * root, self.z)

    def polynomial(self) -> tuple[int, ...]:
        """Return the primitive integer polynomial of least degree, its leading coefficient first.

        z^2 t^2 - 2 x z t + (x^2 - y^2 d), made primitive; z t - x if rational; () for infinity.
        """
        if not self.z:
            return ()
        value = self.rational()
        if value is not None:
            return (value.denominator, -value.numerator)
        a, b, c = self.z**2, -2 * self.x * self.z, self.x**2 - self.y**2 * self.d
        g = gcd(a, b, c)
        return (a // g, b // g, c // g)

    def root(self) -> int:
        """Return which root of `polynomial` the number is, from 0 upwards."""
        return int(len(self.polynomial()) == 3 and self.y > 0)

    def evaluate(self, a: int, b: int, c: int) -> int:
        """Return the sign of a t^2 + b t + c at this number, which is finite."""
        x, y, d, z = self.x, self.y, self.d, self.z
        return sign_1(a * (x * x + y * y * d) + b * x * z + c * z * z, (2 * a * x + b * z) * y, d)


ZERO = Surd(0, 0, 0, 1)
INFINITY = Surd(1, 0, 0, 0)


def fraction(numerator: int, denominator: int) -> Surd:
    """Return numerator / denominator, denominator != 0."""
    flip = 1 if denominator > 0 else -1
    return Surd(flip * numerator, 0, 0, flip * denominator)


def dyadic(number: float) -> Surd:
    """Return the number that a float is; infinity is infinity. NaN and -infinity are refused."""
    if number == float("inf"):
        return INFINITY
    return fraction(*number.as_integer_ratio())
