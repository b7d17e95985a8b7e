"""A time is clocked: ways run in turn, several times over, and the least time of each counts.

Only what is interleaved in one run compares. The time is the processor's, of all threads: others at
work on the machine cost the clock on the wall, and the processor's own little; what is left of
them (caches, frequency) falls on all ways alike, and no way gains by having several threads. What
runs in another process cannot be timed so: such a way returns a `Timed` of its own, by the wall.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from math import inf
from statistics import median, quantiles
from time import perf_counter, process_time
from typing import Any, NamedTuple

FEWEST = 3
"""Passes of a way at least, however slow it is, if so many are asked for."""
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


class Timed(NamedTuple):
    """Seconds, and what was returned."""

    seconds: float
    answer: Any = None


class Time(NamedTuple):
    """Seconds per ray: the least, the median, the distance of the quartiles, and of how many."""

    best: float
    median: float
    iqr: float
    passes: int
    rays: int

    @classmethod
    def of(cls, seconds: Sequence[float], rays: int = 1) -> Time:
        each = [s / rays for s in seconds]
        low, _, high = quantiles(each, n=4, method="inclusive") if len(each) > 1 else each * 3
        return cls(min(each), median(each), high - low, len(each), rays)


def one_thread() -> None:
    """Ask libraries for one thread; they read it when they are loaded, so before that only."""
    if not {"numpy", "numba"} & set(sys.modules):
        os.environ.update(dict.fromkeys(THREADS, "1"))


def wall(call: Callable[[], Any]) -> Timed:
    began = perf_counter()
    answer = call()
    return Timed(perf_counter() - began, answer)


def processor(call: Callable[[], Any]) -> Timed:
    """Return the processor's time of a call, or the time that the call took for itself."""
    began = process_time()
    answer = call()
    return answer if isinstance(answer, Timed) else Timed(process_time() - began, answer)


class Race:
    """Passes of ways in turn. What is done is there at any time: an interruption loses no pass."""

    def __init__(self, ways: Mapping[str, Callable[[], Any]]) -> None:
        self.ways = ways
        self.seconds: dict[str, list[float]] = {name: [] for name in ways}
        self.answers: dict[str, Any] = {}

    def run(
        self, passes: int, patience: float = inf, advance: Callable[[], None] = lambda: None
    ) -> Race:
        """Run passes; a way that has spent its patience, in seconds, stops after the fewest.

        What was allocated before is left out of any collection of garbage meanwhile.
        """
        gc.collect()
        gc.freeze()
        try:
            for number in range(passes):
                for name, way in self.ways.items():
                    if number < FEWEST or sum(self.seconds[name]) < patience:
                        seconds, self.answers[name] = processor(way)
                        self.seconds[name].append(seconds)
                    advance()
        finally:
            gc.unfreeze()
        return self

    def least(self, name: str) -> float:
        return min(self.seconds[name])
