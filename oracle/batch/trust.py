"""Whether the floating point of an engine is what the proofs need, asked before the first lane.

A compiler that contracts a * b - c to one rounding, a processor that flushes subnormals to 0, or
another rounding mode break `two_sum`, `two_prod` and the rounding test. Each changes one of these
results; what they must be is computed here in fractions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import inf
from typing import Any

import numpy as np

from raycert.oracle.batch.probe import probe

INPUT = (1 + 2.0**-30, 2.0**-53, 2.0**-1074, 3.0, 1e300, 1 + 2.0**-52)
Probe = Callable[[Any], Sequence[float]]


def wanted() -> list[tuple[str, float, float]]:
    """Return for each result of `probe` what it shows, and the two numbers it lies between."""
    one, large = Fraction(INPUT[0]), Fraction(INPUT[4])
    square = float(one * one)
    rest = float(one * one - Fraction(square))
    inverse = Fraction(1 / INPUT[4])
    error = float((large * inverse - Fraction(INPUT[4] * (1 / INPUT[4]))) * 2**60)
    tiny = 64 * 2.0**-106
    exact = [
        ("a product is rounded to nearest", square),
        ("the error of a product", rest),
        ("a product and a difference are two roundings", square - (1.0 + 2.0**-29)),
        ("a tie rounds to even", 1.0),
        ("the error of a sum", INPUT[1]),
        ("a tie rounds to even, from above", 0.0),
        ("a tie rounds to even, upwards", 2.0**-51),
        ("a negative tie rounds to even", 0.0),
        ("subnormal numbers are kept", INPUT[2]),
        ("subnormal results are kept", INPUT[2]),
        ("overflow is infinite", inf),
        ("the error of a product of extremes", error),
    ]
    bounded = [("a double-double quotient", -tiny, tiny), ("a double-double root", -tiny, tiny)]
    singles = [("binary32 rounds to nearest", 0.0), ("a tie of binary32 rounds to even", 1.0)]
    return [
        *((text, x, x) for text, x in exact),
        *bounded,
        *((text, x, x) for text, x in singles),
    ]


WANTED = tuple(wanted())


def untrustworthy(run: Probe = probe) -> str:
    """Return what a probe finds wrong, or an empty text."""
    with np.errstate(all="ignore"):
        results = [float(np.asarray(x).ravel()[0]) for x in run(_inputs(run))]
    for (text, low, high), x in zip(WANTED, results, strict=True):
        if not low <= x <= high:
            return f"{text}: {x!r}"
    return ""


def _inputs(run: Probe) -> Any:
    """Return the input as NumPy's lanes, or as the compiled ones'."""
    rows = np.array([INPUT] * 16).T
    return rows if run is probe else rows[:, 0].copy()


def trustworthy(run: Probe = probe) -> bool:
    """Tell whether the floating point of an engine is what the proofs need."""
    return not untrustworthy(run)
