"""Which engine answers, and whether its floating point is what the proofs need, asked beforehand.

A compiler that contracts a * b - c to one rounding, a processor that flushes subnormals to 0, or
another rounding mode break `two_sum`, `two_prod` and the rounding test. Each changes one of the
results of `arithmetic.probe`; what they must be is computed here in fractions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import inf
from typing import Any

import numpy as np

from raycert.cases.hints import lacking
from raycert.oracle.batch import compiled, lanes
from raycert.oracle.batch.arithmetic import probe
from raycert.oracle.batch.constants import LeafPlan
from raycert.oracle.batch.lanes import Floats, Outcomes

INPUT = (1 + 2.0**-30, 2.0**-53, 2.0**-1074, 3.0, 1e300, 1 + 2.0**-52)
Probe = Callable[[Any], Sequence[float]]


def _wanted() -> list[tuple[str, float, float]]:
    """Return for each result of `probe` what it shows, and the two numbers it lies between."""
    one, large = Fraction(INPUT[0]), Fraction(INPUT[4])
    square = float(one * one)
    inverse = 1 / INPUT[4]
    error = float((large * Fraction(inverse) - Fraction(INPUT[4] * inverse)) * 2**60)
    tiny = 64 * 2.0**-106
    exact = {
        "a product is rounded to nearest": square,
        "the error of a product": float(one * one - Fraction(square)),
        "a product and a difference are two roundings": square - (1.0 + 2.0**-29),
        "a tie rounds to even": 1.0,
        "the error of a sum": INPUT[1],
        "a tie rounds to even, from above": 0.0,
        "a tie rounds to even, upwards": 2.0**-51,
        "a negative tie rounds to even": 0.0,
        "subnormal numbers are kept": INPUT[2],
        "subnormal results are kept": INPUT[2],
        "overflow is infinite": inf,
        "the error of a product of extremes": error,
    }
    bounded = [("a double-double quotient", -tiny, tiny), ("a double-double root", -tiny, tiny)]
    singles = {"binary32 rounds to nearest": 0.0, "a tie of binary32 rounds to even": 1.0}
    first, last = ([(text, x, x) for text, x in some.items()] for some in (exact, singles))
    return [*first, *bounded, *last]


WANTED = tuple(_wanted())


def untrustworthy(run: Probe = probe) -> str:
    """Return what a probe finds wrong, or an empty text."""
    rows = np.array([INPUT] * 16).T if run is probe else np.array(INPUT)  # lanes of NumPy, or one
    with np.errstate(all="ignore"):
        results = [float(np.asarray(x).ravel()[0]) for x in run(rows)]
    for (text, low, high), x in zip(WANTED, results, strict=True):
        if not low <= x <= high:
            return f"{text}: {x!r}"
    return ""


LeafBlock = Callable[[LeafPlan, Floats], Outcomes]
ENGINES = ("auto", "numpy", "numba")


@dataclass(frozen=True, slots=True)
class Engine:
    """A way to run the fast rungs: its name, and what to tell the user.

    Where its floating point is not what the proofs need, it is not `trusted`: every lane goes to
    the integers, and `reason` says why.
    """

    name: str
    leaf_block: LeafBlock
    trusted: bool = True
    reason: str = ""


def engine_of(name: str) -> Engine:
    """Return an engine by name, `auto` for numba where it is there.

    Raises `ValueError` for an unknown name, and for numba where it is missing.
    """
    if name not in ENGINES:
        raise ValueError(f"unknown engine {name!r}; known are {', '.join(ENGINES)}")
    if name == "numpy":
        return _numpy()
    try:
        return _numba()
    except ImportError as error:
        missing = f"{lacking('the batch engine', 'speed', 'numba')} ({error})"
    if name == "numba":
        raise ValueError(missing)
    return Engine("numpy", _numpy().leaf_block, _numpy().trusted, missing)


@cache
def _numpy() -> Engine:
    return _checked("numpy", lanes.leaf_block, untrustworthy())


@cache
def _numba() -> Engine:
    return _checked("numba", compiled.leaf_block, untrustworthy(compiled.compiled("probe")))


def _checked(name: str, run: LeafBlock, fault: str) -> Engine:
    if not fault:
        return Engine(name, run)
    reason = f"{name}: {fault}; every lane in integers"
    return Engine(name, lambda plan, rays: Outcomes.unsure(rays.shape[1]), False, reason)
