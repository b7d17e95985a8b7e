"""Three-vectors of doubles, and their exact scaling by powers of two.

A vector is scaled to have its largest component in [1/2, 1), and its exponent is kept beside it.
Products of scaled vectors do not overflow, and what underflows in them is less than the rounding
of the larger terms.
"""

from __future__ import annotations

from math import frexp, hypot, inf, ldexp

from raycert.cases.model import Vector

NOTHING = -1200
"""The exponent of zero: below that of every double."""


def dot(a: Vector, b: Vector) -> float:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b.

    Guarantee: exactly zero for parallel vectors of any length. Each component is the difference
    of two products that are equal, and equal products round alike.
    """
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def norm(a: Vector) -> float:
    """Return |a|. Guarantee: within an ulp, exact for a vector along a coordinate axis."""
    return hypot(*a)


def exponent(*numbers: float) -> int:
    """Return the e for which the largest magnitude is in [1/2, 1) 2^e.

    >>> exponent(0.75, -3.0)
    2
    """
    largest = max(map(abs, numbers))
    return frexp(largest)[1] if largest else NOTHING


def shift(a: Vector, e: int) -> Vector:
    """Return a 2^e, which must not overflow."""
    return (ldexp(a[0], e), ldexp(a[1], e), ldexp(a[2], e))


def scaled(a: Vector) -> tuple[Vector, int]:
    """Return (m, e) with a = m 2^e and the largest component of m in [1/2, 1).

    >>> scaled((0.0, 3.0, -6.0))
    ((0.0, 0.375, -0.75), 3)
    """
    e = exponent(*a)
    return shift(a, -e), e


def displacement(start: Vector, end: Vector) -> tuple[Vector, int]:
    """Return end - start, scaled.

    Guarantee: each component within u of its own size, so zero only if start = end: a difference
    never underflows. One that overflows is taken again between the halves.
    """
    difference = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    if inf in map(abs, difference):
        half, e = displacement(shift(start, -1), shift(end, -1))
        return half, e + 1
    return scaled(difference)
