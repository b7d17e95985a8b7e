"""How far an answer is from the exact one: ends forward, the question backward, and the count.

What is no answer, or has another number of pairs, has an infinite forward error. Backward errors
take milliseconds a case and are asked for where they are wanted; what one method was compared
with is remembered for the next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil, frexp, hypot, inf, isinf, log2

from raycert.cases.accept import malformed
from raycert.cases.formats import BINARY64
from raycert.cases.model import Slab, leaves
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.rounding import enclose
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import Measure
from raycert.oracle.measure.methods.method import Answered, Case


@dataclass(frozen=True)
class Remembering(Judge):
    """A judge that moves the faces of its case by each k once."""

    @cached_property
    def _known(self) -> dict[tuple[int, Measure, int], Intervals]:
        return {}

    def moved(self, step: int, measure: Measure, sigma: int) -> Intervals:
        """Return the outer or inner list of a step of k."""
        key = step, measure, sigma
        if key not in self._known:
            self._known[key] = super().moved(step, measure, sigma)
        return self._known[key]


def judges(cases: Sequence[Case]) -> list[Remembering]:
    """Return a judge for each case."""
    return [Remembering(case.solid, case.ray, BINARY64) for case in cases]


@dataclass(frozen=True, slots=True)
class Error:
    """What is wrong with an answer. `missed` and `phantom` count pairs; a failure has neither.

    `idle` is an empty list that is right: it has no end whose error could be told.
    """

    ulps: float
    radii: float
    missed: int = 0
    phantom: int = 0
    failed: bool = False
    exact: bool = False
    idle: bool = False

    @property
    def counts(self) -> bool:
        """Tell whether there is an answer, with the right number of pairs."""
        return not (self.missed or self.phantom or self.failed)


def error(answer: Answered, judge: Judge) -> Error:
    """Return the forward error of an answer."""
    if answer is None or malformed(answer, True):
        return Error(inf, inf, failed=True)
    more = len(answer) - len(judge.expected)
    if more:
        return Error(inf, inf, missed=max(-more, 0), phantom=max(more, 0))
    right = answer == judge.expected
    return Error(judge.forward_error(answer), _radii(answer, judge), exact=right, idle=not answer)


def backward(answer: Answered, judge: Judge, measure: Measure) -> float:
    """Return the least k that explains an answer; infinite where none does."""
    return inf if answer is None else judge.backward_error(answer, measure)


def _radii(answer: tuple[tuple[float, float], ...], judge: Judge) -> float:
    """Return the largest distance of an end from the exact one along the ray, in radii.

    Computed by logarithms, as neither t nor lengths need be anywhere near 1. For people to read.
    """
    pace, worst = hypot(*judge.ray.direction), 0.0
    for pair, exact in zip(answer, judge.merged, strict=True):
        for x, t in zip(pair, exact, strict=True):
            off, below = judge.ulps(x, t), enclose(t, BINARY64).down
            if not off or not pace or isinf(off):
                worst = max(worst, off if isinf(off) else 0.0)
                continue
            ulp = (
                BINARY64.least
                if not below
                else max(frexp(below)[1] - BINARY64.precision, BINARY64.least)
            )
            bits = log2(off) + ulp + log2(pace) - log2(unit_of(judge))
            worst = max(worst, 2.0**bits if bits < 1000 else inf)
    return worst


def unit_of(judge: Judge) -> float:
    """Return the smallest radius or thickness of a solid; 1 where there is none but 0."""
    sizes = [
        hypot(*(b - a for a, b in zip(leaf.p, leaf.q, strict=True)))
        if isinstance(leaf, Slab)
        else getattr(leaf, "radius", 0.0)
        for _, leaf in leaves(judge.solid)
    ]
    return min((size for size in sizes if 0 < size < inf), default=1.0)


@dataclass(frozen=True, slots=True)
class Spread:
    """How a figure is spread over rays, failures as infinite: by rank, nothing interpolated."""

    median: float
    p99: float
    largest: float

    @classmethod
    def of(cls, figures: Sequence[float]) -> Spread | None:
        """Return the spread of figures; None of none."""
        ranked = sorted(figures)
        if not ranked:
            return None
        at = [ranked[ceil(share * len(ranked)) - 1] for share in (0.5, 0.99)]
        return cls(at[0], at[1], ranked[-1])
