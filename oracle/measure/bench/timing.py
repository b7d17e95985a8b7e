"""Time per ray, pass by pass in turn: machines are shared, and only what is interleaved compares.

Each pass of a method is a first one as far as it can be. The minimum is its price; median and
quartiles tell the noise. A slow method has fewer passes, never less than `FEWEST`.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median, quantiles
from time import perf_counter

from raycert.oracle.measure.methods.method import Case, Method

FEWEST = 3


@dataclass(frozen=True, slots=True)
class Time:
    """Seconds per ray: the least, the median, and the distance of the quartiles."""

    best: float
    median: float
    iqr: float
    passes: int
    rays: int
    """How many rays a pass has: all of the scenario, several times over for a batch."""

    @classmethod
    def of(cls, seconds: Sequence[float], rays: int) -> Time:
        """Return the figures of some passes."""
        each = [s / rays for s in seconds]
        low, _, high = quantiles(each, n=4, method="inclusive") if len(each) > 1 else each * 3
        return cls(min(each), median(each), high - low, len(each), rays)


class Race:
    """The passes of methods over the same cases; what is done is there at any time."""

    def __init__(self, methods: Sequence[Method], cases: Sequence[Case]) -> None:
        """Prepare the rays of each method."""
        self.methods = methods
        self._rays = {m.name: list(cases) * -(-m.lanes // len(cases)) for m in methods}
        self._seconds: dict[str, list[float]] = {m.name: [] for m in methods}

    def run(self, passes: int, seconds: float, advance: Callable[[], None]) -> None:
        """Do passes in turn; a method that has spent its seconds stops after the fewest.

        What was allocated before is left out of any collection of garbage meanwhile.
        """
        gc.collect()
        gc.freeze()
        try:
            for number in range(passes):
                for method in self.methods:
                    spent = self._seconds[method.name]
                    if number < FEWEST or sum(spent) < seconds:
                        spent.append(once(method, self._rays[method.name]))
                    advance()
        finally:
            gc.unfreeze()

    def time(self, method: Method) -> Time | None:
        """Return the time of a method; None before its first pass."""
        seconds = self._seconds[method.name]
        return Time.of(seconds, len(self._rays[method.name])) if seconds else None


def once(method: Method, cases: Sequence[Case]) -> float:
    """Return the seconds of one pass."""
    if method.timed is not None:
        return method.timed(cases)
    began = perf_counter()
    method.solve(cases)
    return perf_counter() - began
