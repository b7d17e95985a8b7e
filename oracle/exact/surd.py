"""Numbers of degree 1 and 2: (x + y sqrt(d)) / z in integers, with a total order.

Order and equality are decided by signs of integers, also between different quadratic fields;
there is no tolerance and no refinement loop. Infinity is (1 + 0 sqrt(0)) / 0: with z = 0 the same
cross-multiplication orders it above every number and equal to itself.

One floor decides all roundings: to nearest even, down and up, and to decimals. With N = y^2 d 4^k,

    floor(v 2^k) = floor((x 2^k + floor(+-sqrt N)) / z):

the fraction that `isqrt` drops cannot carry the quotient over an integer. What was dropped is kept
as one sticky bit, so ties, subnormals and overflow need no further precision.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, inf, isnan, isqrt, ldexp
from numbers import Rational, Real
from operator import eq, ge, gt, le, lt
from typing import Any, NamedTuple, TypeAlias

from raycert.cases.formats import BINARY64, Format

Number: TypeAlias = "Surd | Fraction | float"


def sign(n: int) -> int:
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


def _ordered(holds: Callable[[int, int], bool]) -> Callable[[Any, Any], bool]:
    """Return the comparison with any real number that holds of the sign of the difference."""

    def compare(self: Surd, other: object) -> bool:
        found = self._against(other)
        return found if found is NotImplemented else holds(found, 0)

    return compare


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Surd:
    """(x + y sqrt(d)) / z with d >= 0 and z > 0; z = 0 (then x = 1, y = d = 0) is infinity.

    Equal numbers compare equal and hash alike, however they are represented, and so do an int, a
    float and a `Fraction`, each taken as exactly the number it is.

    >>> golden = Surd(1, 1, 5, 2)
    >>> print(golden, float(golden), format(golden, ".40"))
    (1 + sqrt(5))/2 1.618033988749895 1.618033988749894848204586834365638117720
    >>> 1.618033988749894 < golden < 1.618033988749895 and Surd(4, z=2) == 2
    True
    """

    x: int
    y: int = 0
    d: int = 0
    z: int = 1

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

    def _against(self, other: object) -> Any:
        """Return the sign of self - other, of any real number; NaN, which has no place, for NaN."""
        if type(other) is Surd:
            return self.compare(other)
        if not isinstance(other, Real):
            return NotImplemented
        if isinstance(other, Rational):
            return self.compare(fraction(int(other.numerator), int(other.denominator)))
        number = float(other)
        if isnan(number):
            return number
        return 1 if number == -inf else self.compare(dyadic(number))

    def sign(self) -> int:
        return sign_1(self.x, self.y, self.d)

    __eq__ = _ordered(eq)
    __lt__ = _ordered(lt)
    __le__ = _ordered(le)
    __gt__ = _ordered(gt)
    __ge__ = _ordered(ge)

    def __hash__(self) -> int:
        """Hash the number: as Python hashes it where it is rational, else its polynomial."""
        value = self.rational()
        if value is not None:
            return hash(value)
        return hash((self.polynomial(), self.root())) if self.z else hash(inf)

    def __neg__(self) -> Surd:
        return Surd(-self.x, -self.y, self.d, self.z)

    def __float__(self) -> float:
        """Return the binary64 nearest to the number, ties to even."""
        return enclose(self, BINARY64).nearest

    def __repr__(self) -> str:
        """Return what gives the number back: `Surd(1, 1, 5, 2)`, `Surd(2)`, `INFINITY`."""
        if not self.z:
            return "INFINITY"
        x, y, d, z = self._reduced()
        given = [x, y, d][: 3 if y else 1]
        return f"Surd({', '.join(map(str, given))}{f', z={z}' * (z != 1)})"

    def __str__(self) -> str:
        """Return the closed form: `(1 + sqrt(5))/2`, `2/3`, `inf`."""
        if not self.z:
            return "inf"
        x, y, d, z = self._reduced()
        root = f"{abs(y)}*sqrt({d})" if abs(y) != 1 else f"sqrt({d})"
        if not y:
            top = str(x)
        elif x:
            top = f"{x} {'+' if y > 0 else '-'} {root}"
        else:
            top = root if y > 0 else f"-{root}"
        if z == 1:
            return top
        return f"({top})/{z}" if x and y else f"{top}/{z}"

    def __format__(self, spec: str) -> str:
        """Return the closed form for "", for ".40" that many digits, else as a float is shown.

        Digits are rounded to nearest; those of a rational number have no zeros at their end.
        """
        if not spec:
            return str(self)
        if not (spec[0] == "." and spec[1:].isdecimal()) or not self.z:
            return format(float(self), spec)
        wanted = max(int(spec[1:]), 1)
        digits, _, power = decimal(self, wanted).partition("e")
        minus, digits, place = digits[: digits[0] == "-"], digits.lstrip("-"), int(power or 0)
        digits = digits.replace(".", "")
        if self.rational() is not None:
            digits = digits.rstrip("0") or "0"
        if not -5 < place < wanted:
            rest = f".{digits[1:]}" if digits[1:] else ""
            return f"{minus}{digits[0]}{rest}e{place:+03d}"
        digits = "0" * -place + digits.ljust(place + 1, "0")
        whole, rest = digits[: max(place, 0) + 1], digits[max(place, 0) + 1 :]
        return f"{minus}{whole}.{rest}" if rest else minus + whole

    def _reduced(self) -> tuple[int, int, int, int]:
        """Return x, y, d, z without common factors, the squares of small ones taken out of d."""
        value = self.rational()
        if value is not None:
            return value.numerator, 0, 0, value.denominator
        y, d = self.y, self.d
        for n in (2, 3, 5, 7, 11, 13):
            while d % (n * n) == 0:
                y, d = n * y, d // (n * n)
        common = gcd(self.x, y, self.z)
        return self.x // common, y // common, d, self.z // common

    @property
    def finite(self) -> bool:
        """Whether this is a number and not infinity."""
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
    if number == inf:
        return INFINITY
    return fraction(*number.as_integer_ratio())


class Rounded(NamedTuple):
    """The three roundings of one number: `down` <= number <= `up`, `nearest` with ties to even."""

    down: float
    nearest: float
    up: float


def _scaled_floor(v: Surd, numerator: int, denominator: int) -> tuple[int, bool]:
    """Return floor(v * numerator / denominator) and whether that is exact."""
    square = v.y * v.y * v.d * numerator * numerator
    root = isqrt(square)
    exact = root * root == square
    if v.y < 0:
        root = -root if exact else -root - 1
    quotient, rest = divmod(v.x * numerator + root, v.z * denominator)
    return quotient, exact and not rest


def floor_shifted(v: Surd, shift: int) -> tuple[int, bool]:
    """Return floor(v * 2^shift) and whether that is exact."""
    return _scaled_floor(v, 1 << shift, 1) if shift >= 0 else _scaled_floor(v, 1, 1 << -shift)


def exponent(v: Surd) -> int:
    """Return e with 2^(e-3) < |v| < 2^(e+3), v finite and not 0.

    Where x and y sqrt(d) cancel, |v| = |x^2 - y^2 d| / (z (|x| + |y| sqrt(d))).
    """
    square = v.y * v.y * v.d
    top = max(v.x.bit_length(), (square.bit_length() + 1) // 2)
    if v.x and v.y and (v.x < 0) != (v.y < 0):
        return (v.x * v.x - square).bit_length() - top - v.z.bit_length()
    return top - v.z.bit_length()


def enclose(v: Surd, fmt: Format) -> Rounded:
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


def nearest(v: Surd, fmt: Format) -> float:
    """Return v rounded to nearest even."""
    return enclose(v, fmt).nearest


def decimal(v: Surd, digits: int = 40) -> str:
    """Return v in scientific notation with this many significant digits, rounded to nearest.

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
