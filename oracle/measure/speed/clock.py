"""Processor seconds of several ways, taken in turn; the least time of each counts.

Others at work on the machine cost the clock on the wall, and the processor's own little: what is
left of them (caches, frequency) falls on all ways alike. The time is that of all threads, so none
gains by having several; those that can be told to are told to have one.
"""

from __future__ import annotations

import gc
import os
import sys
import time
from collections.abc import Callable, Mapping
from math import inf
from typing import Any, NamedTuple

FEWEST = 2
"""Passes of a way at least: the first one loads and compiles."""
THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMBA_NUM_THREADS",
)


class Timed(NamedTuple):
    """The least seconds of a way, and what it returned last."""

    seconds: float
    answer: Any


def one_thread() -> None:
    """Ask libraries for one thread; they read it when they are loaded, so before that only."""
    if not {"numpy", "numba"} & set(sys.modules):
        os.environ.update(dict.fromkeys(THREADS, "1"))


def race(
    ways: Mapping[str, Callable[[], Any]], repeats: int, patience: float = inf
) -> dict[str, Timed]:
    """Return the time of each way; one that has had `patience` seconds stops after the fewest.

    What was allocated before is left out of any collection of garbage meanwhile.
    """
    best, spent = dict.fromkeys(ways, inf), dict.fromkeys(ways, 0.0)
    answers: dict[str, Any] = {}
    gc.collect()
    gc.freeze()
    try:
        for number in range(max(repeats, FEWEST)):
            for name, way in ways.items():
                if number >= FEWEST and spent[name] > patience:
                    continue
                began = time.process_time()
                answers[name] = way()
                seconds = time.process_time() - began
                best[name] = min(best[name], seconds)
                spent[name] += seconds
    finally:
        gc.unfreeze()
    return {name: Timed(best[name], answers[name]) for name in ways}
