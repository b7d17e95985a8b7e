"""|a| of many lanes, to the bit what `math.hypot` returns.

`math.hypot` returns the correctly rounded norm wherever that is not within 2^-90 |a| of the middle
between two numbers: CPython from 3.11 on computes it as h + c, h = sqrt(sum of squares) and c the
exact remainder over 2 h, with an error below 2^-98 |a| before the last rounding. The same sum is
made here: h + (c - d) and h + (c + d), d = 2^-93 h, round to one number in nearly all lanes, and
then that is the answer. The other lanes ask `math.hypot` itself: those whose squares would leave
the range of the format, and the ties, on which the versions of CPython differ.
"""

from __future__ import annotations

from math import hypot

import numpy as np

from raycert.reference.arrays.vectors import ZERO, Array, Mask, Vectors, present

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
