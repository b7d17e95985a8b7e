"""Surds to digits: correct rounding to nearest even, down and up, and decimal digits.

One floor decides all of them. With N = y^2 d 4^k,

    floor(v 2^k) = floor((x 2^k + floor(+-sqrt N)) / z):

the fraction that `isqrt` drops cannot carry the quotient over an integer. What was dropped is kept
as one sticky bit, so ties, subnormals and overflow need no further precision.
"""

from __future__ import annotations

from math import inf, isqrt, ldexp
from typing import NamedTuple, Protocol, Self

from raycert.cases.formats import Format


class Quadratic(Protocol):
    """(x + y sqrt(d)) / z in integers: a `Surd`, or infinity."""

    @property
    def x(self) -> int:
        """Return the rational part."""

    @property
    def y(self) -> int:
        """Return the factor of the root."""

    @property
    def d(self) -> int:
        """Return what is under the root, >= 0."""

    @property
    def z(self) -> int:
        """Return the denominator, > 0; 0 for infinity."""

    def sign(self) -> int:
        """Return the sign of the number."""

    def __neg__(self) -> Self:
        """Return the negative."""


class Rounded(NamedTuple):
    """The three roundings of one number: `down` <= number <= `up`, `nearest` with ties to even."""

    down: float
    nearest: float
    up: float


def _scaled_floor(v: Quadratic, numerator: int, denominator: int) -> tuple[int, bool]:
    """Return floor(v * numerator / denominator) and whether that is exact."""
    square = v.y * v.y * v.d * numerator * numerator
    root = isqrt(square)
    exact = root * root == square
    if v.y < 0:
        root = -root if exact else -root - 1
    quotient, rest = divmod(v.x * numerator + root, v.z * denominator)
    return quotient, exact and not rest


def floor_shifted(v: Quadratic, shift: int) -> tuple[int, bool]:
    """Return floor(v * 2^shift) and whether that is exact."""
    return _scaled_floor(v, 1 << shift, 1) if shift >= 0 else _scaled_floor(v, 1, 1 << -shift)


def exponent(v: Quadratic) -> int:
    """Return e with 2^(e-3) < |v| < 2^(e+3), v finite and not 0.

    Where x and y sqrt(d) cancel, |v| = |x^2 - y^2 d| / (z (|x| + |y| sqrt(d))).
    """
    square = v.y * v.y * v.d
    top = max(v.x.bit_length(), (square.bit_length() + 1) // 2)
    if v.x and v.y and (v.x < 0) != (v.y < 0):
        return (v.x * v.x - square).bit_length() - top - v.z.bit_length()
    return top - v.z.bit_length()


def enclose(v: Quadratic, fmt: Format) -> Rounded:
    """Return the three roundings of v to the format; all equal where v is one of its numbers.

    Beyond the largest finite number, `up` is infinite and `down` the largest number; `nearest`
    overflows as IEEE 754 says, from the midpoint above the largest number on.
    """
    if not v.z:
        return Rounded(inf, inf, inf)
    shift = -max(exponent(v) - fmt.precision - 6, fmt.least - 2)
    floor, exact = floor_shifted(v, shift)
    if floor < 0:
        mirrored = enclose(-v, fmt)
        return Rounded(-mirrored.up, -mirrored.nearest, -mirrored.down)
    if exact and not floor:
        return Rounded(0.0, 0.0, 0.0)
    drop = max(floor.bit_length() - fmt.precision, fmt.least + shift)
    kept = floor >> drop
    rest, half = floor - (kept << drop), 1 << (drop - 1)
    lsb = drop - shift
    down = _number(kept, lsb, fmt)
    if exact and not rest:
        return Rounded(down, down, down) if down < inf else Rounded(fmt.largest, inf, inf)
    up = _number(kept + 1, lsb, fmt)
    above = rest > half or (rest == half and (not exact or kept & 1))
    nearest = up if above else down
    return Rounded(min(down, fmt.largest), nearest, up)


def _number(significand: int, lsb: int, fmt: Format) -> float:
    """Return significand * 2^lsb, which is a number of the format or beyond its largest."""
    if significand.bit_length() + lsb > fmt.overflow:
        return inf
    return ldexp(significand, lsb)


def nearest(v: Quadratic, fmt: Format) -> float:
    """Return v rounded to nearest even."""
    return enclose(v, fmt).nearest


def decimal(v: Quadratic, digits: int = 40) -> str:
    """Return v in scientific notation with this many significant digits, rounded to nearest.

    >>> from raycert.oracle.exact.surd import Surd
    >>> decimal(Surd(0, 1, 2), 12)
    '1.41421356237e+0'
    """
    if not v.z:
        return "inf"
    sign = v.sign()
    if sign == 0:
        return "0"
    if sign < 0:
        return "-" + decimal(-v, digits)
    power = exponent(v) * 1233 // 4096 - 2  # 1233/4096 = log10(2); never too high
    while True:
        shift = digits - 1 - power
        doubled, _ = _scaled_floor(v, 2 * 10 ** max(shift, 0), 10 ** max(-shift, 0))
        rounded = (doubled + 1) // 2
        if rounded < 10**digits:
            break
        power += 1
    text = str(rounded)
    power += len(text) - digits
    return f"{text[0]}.{text[1:]}e{power:+d}"
