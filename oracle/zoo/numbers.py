"""Vectors and their scaling, over whatever numbers a tracer computes with.

A number is a double, a `Single` or a `Fraction`. It is called a float throughout: all three add,
multiply and compare alike, and only `root` and `shift` look which one they have.
"""

from __future__ import annotations

from fractions import Fraction
from math import frexp, inf, isqrt, ldexp, sqrt
from typing import Any, cast

from raycert.cases.formats import BINARY32
from raycert.cases.model import Vector
from raycert.oracle.zoo.textbook import Single

BITS = 240
"""The bits of a root that a fraction gets."""


def dot(a: Vector, b: Vector) -> float:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b: exactly zero for parallel vectors."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def minus(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(k: float, a: Vector) -> Vector:
    """Return k a."""
    return (k * a[0], k * a[1], k * a[2])


def norm(a: Vector) -> float:
    """Return |a|."""
    return root(dot(a, a))


def root(x: float) -> float:
    """Return the square root: of a double or a `Single` rounded right, of a fraction to BITS."""
    if type(x) is float:
        return sqrt(x)
    if isinstance(x, Single):
        return Single(BINARY32.nearest(sqrt(x)))
    f = Fraction(x)
    up = max(2 * BITS - f.numerator.bit_length() + f.denominator.bit_length(), 0) // 2
    return cast(float, Fraction(isqrt((f.numerator << 2 * up) // f.denominator), 1 << up))


def shift(x: float, e: int) -> float:
    """Return x 2^e as a number of the same kind; a double that overflows is infinite."""
    if not e or not x:
        return x
    if type(x) is not float and isinstance(x, Fraction):
        return cast(float, x * Fraction(2) ** e)
    try:
        moved = ldexp(x, e)
    except OverflowError:
        moved = inf if x > 0 else -inf
    return moved if type(x) is float else type(x)(moved)


def shifted(a: Vector, e: int) -> Vector:
    """Return a 2^e."""
    if not e:
        return a
    if type(a[0]) is float and -1022 <= e <= 1022:  # the factor is exact: one rounding, as in shift
        k = ldexp(1.0, e)
        return (a[0] * k, a[1] * k, a[2] * k)
    return (shift(a[0], e), shift(a[1], e), shift(a[2], e))


def exponent(*numbers: float) -> int:
    """Return the e for which the largest magnitude is in [1/2, 1) 2^e; 0 for zeros."""
    largest = max(map(abs, numbers))
    return frexp(largest)[1] if largest else 0


def fraction(x: float) -> float:
    """Return a double as the fraction it is."""
    return cast(float, Fraction(x))


def single(x: float) -> float:
    """Return the binary32 number nearest to a double."""
    return Single(BINARY32.nearest(x))


def over(a: Any, b: Any) -> float:
    """Return a / b as IEEE 754 has it, also for b = 0."""
    if b:
        return float(a / b)
    if not a or a != a:
        return float("nan")
    return inf if (a > 0) == (str(b)[0] != "-") else -inf
