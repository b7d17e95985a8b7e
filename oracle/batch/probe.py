"""Sums and products whose exact results are known, as an engine computes them.

Each is a number that only IEEE 754 binary64, rounded to nearest even, with subnormals and without
contraction, gives. The compiled engine compiles this very text.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from raycert.oracle.batch.arithmetic import div, mul, root, two_prod, two_sum


def probe(x: Any) -> Any:
    """Return what an engine makes of [1 + 2^-30, 2^-53, 2^-1074, 3, 1e300, 1 + 2^-52]."""
    one, half, least, three, large, next_ = x[0], x[1], x[2], x[3], x[4], x[5]
    p, e = two_prod(one, one)
    s, r = two_sum(1.0 + 0.0 * one, half)
    third = div((three, 0.0 * three), (next_, 0.0 * next_))
    product = mul(third, (next_, 0.0 * next_))
    two = root((three, 0.0 * three))
    square = mul(two, two)
    return (
        p,
        e,
        one * one - (1.0 + 2.0**-29),
        s,
        r,
        (1.0 + half) - 1.0,
        (next_ + half) - 1.0,
        (-1.0 - half) + 1.0,
        least * 1.0,
        (least * 2.0**600) * 2.0**-600,
        large * large,
        two_prod(large, 1.0 / large)[1] * 2.0**60,
        (product[0] - three) + product[1],
        (square[0] - three) + square[1],
        np.float64(np.float32(next_)) - 1.0,
        np.float64(np.float32(1.0 + 2.0**-24 + 0.0 * one)),
    )
