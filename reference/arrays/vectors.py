"""Vectors of many lanes: three components, each an array, of one length or of length 1.

An array of length 1 holds for every lane, so that what lanes share is computed once, by
broadcasting. A component may be None: zero in every lane, by construction. What is multiplied by
it is left out. That changes at most the sign of a zero, which no comparison sees.

`norm` is to the bit what `math.hypot` returns: the correctly rounded norm wherever that is not
within 2^-90 |a| of the middle between two numbers. CPython from 3.11 on computes it as h + c,
h = sqrt(sum of squares) and c the exact remainder over 2 h, with an error below 2^-98 |a| before
the last rounding. The same sum is made here: h + (c - d) and h + (c + d), d = 2^-93 h, round to one
number in nearly all lanes, and then that is the answer. The other lanes ask `math.hypot` itself:
those whose squares would leave the range of the format, and the ties, on which the versions of
CPython differ.
"""

from __future__ import annotations

from math import hypot

import numpy as np
import numpy.typing as npt

from raycert.cases.model import Vector
from raycert.reference.vectors import NOTHING

Array = npt.NDArray[np.float64]
Whole = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]
Component = Array | None
Vectors = tuple[Component, ...]
"""Three of them."""

ZERO = np.zeros(1)


def constant(a: Vector, drop: bool) -> Vectors:
    """Return a vector that all lanes share; `drop` makes its zeros None."""
    return tuple(None if drop and c == 0 else np.array([c]) for c in a)


def present(a: Vectors) -> list[Array]:
    return [c for c in a if c is not None]


def take(a: Array, lanes: Whole) -> Array:
    """Return the lanes of an array; one that holds for every lane stays."""
    return a if a.size == 1 else a[lanes]


def take_all(a: Vectors, lanes: Whole) -> Vectors:
    return tuple(None if c is None else take(c, lanes) for c in a)


def dot(a: Vectors, b: Vectors) -> Array:
    total: Component = None
    for x, y in zip(a, b, strict=True):
        total = _plus(total, _times(x, y))
    return ZERO if total is None else total


def cross(a: Vectors, b: Vectors) -> Vectors:
    return (
        _minus(_times(a[1], b[2]), _times(a[2], b[1])),
        _minus(_times(a[2], b[0]), _times(a[0], b[2])),
        _minus(_times(a[0], b[1]), _times(a[1], b[0])),
    )


def largest(a: Vectors) -> Array:
    size: Component = None
    for c in present(a):
        size = abs(c) if size is None else np.maximum(size, abs(c))
    return ZERO if size is None else size


def exponent(size: Array) -> Whole:
    """Return the e for which a magnitude is in [1/2, 1) 2^e; `NOTHING` for zero."""
    e = np.frexp(size)[1].astype(np.int64)
    return np.where(size == 0, NOTHING, e)


def shift(a: Vectors, e: Whole) -> Vectors:
    return tuple(None if c is None else np.ldexp(c, e) for c in a)


def scaled(a: Vectors) -> tuple[Vectors, Whole]:
    """Return (m, e) with a = m 2^e and the largest component of m in [1/2, 1)."""
    e = exponent(largest(a))
    return shift(a, -e), e


def difference(start: Vector, end: Vectors, drop: bool) -> Vectors:
    """Return end - start; with `drop`, None for what is zero in a lane that all share."""
    parts = [_values(e) - s for s, e in zip(start, end, strict=True)]
    return tuple(None if drop and c.size == 1 and not c.any() else c for c in parts)


def displacement(start: Vector, end: Vectors, drop: bool) -> tuple[Vectors, Whole]:
    """Return end - start, scaled. A lane that overflows is taken again between the halves."""
    parts = difference(start, end, drop)
    over = np.isinf(largest(parts))
    if not over.any():
        return scaled(parts)
    halves = [np.ldexp(_values(e), -1) - np.ldexp(s, -1) for s, e in zip(start, end, strict=True)]
    x, y, z = (np.where(over, h, _values(c)) for h, c in zip(halves, parts, strict=True))
    mantissas, e = scaled((x, y, z))
    return mantissas, e + over


def _values(c: Component) -> Array:
    return ZERO if c is None else c


def _times(x: Component, y: Component) -> Component:
    return None if x is None or y is None else x * y


def _plus(x: Component, y: Component) -> Component:
    if x is None or y is None:
        return x if y is None else y
    return x + y


def _minus(x: Component, y: Component) -> Component:
    if x is None or y is None:
        return x if y is None else -y
    return x - y


SPLIT = 2.0**27 + 1
DOUBT = 2.0**-93
WIDEST = 2.0**450


def norm(a: Vectors) -> Array:
    """Return |a|, as `raycert.reference.vectors.norm` does."""
    parts = present(a)
    if len(parts) < 2:
        return abs(parts[0]) if parts else ZERO
    low, certain = _bracket(parts)
    if not certain.all():
        size = np.broadcast_shapes(*(part.shape for part in parts))
        whole = [np.broadcast_to(part, size) for part in parts]
        for i in np.flatnonzero(~certain):
            low[i] = hypot(*(float(part[i]) for part in whole))
    return low


def rough(a: Vectors) -> Array:
    """Return |a| within 4 u |a|, where no square leaves the range of the format."""
    total = sum((part * part for part in present(a)), start=ZERO)
    return np.sqrt(total)


def _bracket(parts: list[Array]) -> tuple[Array, Mask]:
    """Return |a|, and the lanes for which it is certain: both roundings agree, in a safe range."""
    size = abs(parts[0])
    total, error = _square(parts[0])
    for part in parts[1:]:
        size = np.maximum(size, abs(part))
        square, rest = _square(part)
        total, lost = _sum(total, square)
        error = error + (rest + lost)
    root = np.sqrt(total)
    square, rest = _square(root)
    correction = (((total - square) - rest) + error) / (2 * root)
    doubt = DOUBT * root
    low, high = root + (correction - doubt), root + (correction + doubt)
    certain = (low == high) & (size < WIDEST) & (size > 1 / WIDEST)
    return low, certain


def _square(x: Array) -> tuple[Array, Array]:
    """Return x^2 rounded, and what it lacks, exactly (Dekker, Veltkamp)."""
    scaled = x * SPLIT
    high = scaled - (scaled - x)
    low = x - high
    square = x * x
    return square, ((high * high - square) + 2 * high * low) + low * low


def _sum(a: Array, b: Array) -> tuple[Array, Array]:
    """Return a + b rounded, and what it lacks, exactly (Knuth)."""
    total = a + b
    c = total - a
    return total, (a - (total - c)) + (b - c)
