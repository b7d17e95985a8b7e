"""Three numbers as a vector, over any kind of number that adds, subtracts and multiplies.

Integers and fractions stay exact; doubles are rounded at each operation, in the order written:
`dot` adds from the left, `cross` is exactly zero only where its products agree, and no sum is
fused. What is used where bits matter says so there. The witnesses, the reference and the starters
have vectors of their own: they are to share no line with what they check.
"""

from __future__ import annotations

from math import hypot, isqrt
from typing import Protocol, Self, TypeVar


class Arithmetic(Protocol):
    """A number as far as a vector needs one: a float, an int, a `Fraction`, a ball, an array."""

    def __add__(self, other: Self, /) -> Self: ...
    def __sub__(self, other: Self, /) -> Self: ...
    def __mul__(self, other: Self, /) -> Self: ...


N = TypeVar("N", bound=Arithmetic)


def plus(a: tuple[N, N, N], b: tuple[N, N, N]) -> tuple[N, N, N]:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def minus(a: tuple[N, N, N], b: tuple[N, N, N]) -> tuple[N, N, N]:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(k: N, a: tuple[N, N, N]) -> tuple[N, N, N]:
    return (k * a[0], k * a[1], k * a[2])


def along(a: tuple[N, N, N], t: N, b: tuple[N, N, N]) -> tuple[N, N, N]:
    """Return a + t b: where a ray from `a` towards `b` is at t."""
    return (a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2])


def dot(a: tuple[N, N, N], b: tuple[N, N, N]) -> N:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: tuple[N, N, N], b: tuple[N, N, N]) -> tuple[N, N, N]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a: tuple[float, float, float]) -> float:
    """Return |a|, without over- or underflow on the way."""
    return hypot(*a)


def unit(a: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return a / |a|, for `a` of any size but zero."""
    largest = max(map(abs, a))
    x, y, z = a[0] / largest, a[1] / largest, a[2] / largest
    size = hypot(x, y, z)
    return (x / size, y / size, z / size)


def norm_up(a: tuple[int, int, int]) -> int:
    """Return N(a): |a| rounded up to the bit, 0 for 0; of integers that 2^64 divides.

    With S = a.a and e = floor((bits(S) - 1) / 2) - 64, N = (isqrt(floor(S / 4^e)) + 1) 2^e.
    """
    square = dot(a, a)
    if not square:
        return 0
    e = (square.bit_length() - 1) // 2 - 64
    return isqrt(square >> 2 * e) + 1 << e
