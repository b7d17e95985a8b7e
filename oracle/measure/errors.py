"""An error is judged: how far an answer is from the exact one, forward and backward.

Forward, in ulps of the worst end; what is no answer, or has another number of pairs, is infinitely
far. Backward, as the k of `certify`, which takes milliseconds a case: so a referee remembers what
it has worked out, and every way is judged by the same lists.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil, frexp, hypot, inf, isinf, log2

from raycert.cases.formats import BINARY64
from raycert.cases.model import Slab, leaves
from raycert.oracle.exact.condition import kappa
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import Surd, enclose
from raycert.oracle.judge.decisive import decisive
from raycert.oracle.judge.levels import LIMIT, Judge
from raycert.oracle.judge.moved import LAST_STEP, Measure, Step
from raycert.oracle.measure.way import Answered, Case, Pairs

ONE = 8
"""The step of k = 1."""


@dataclass(frozen=True, slots=True)
class Error:
    """What is wrong with an answer, forward; `pairs` are too many, or too few where it is < 0.

    `idle` is an empty list that is right: it has no end whose error could be told.
    """

    ulps: float
    pairs: int = 0
    failed: bool = False
    exact: bool = False
    idle: bool = False

    @property
    def counts(self) -> bool:
        """Whether there is an answer, with the right number of pairs."""
        return not (self.pairs or self.failed)


@dataclass(frozen=True)
class Referee(Judge):
    """A judge with a memory."""

    @classmethod
    def of(cls, case: Case) -> Referee:
        return cls(case.solid, case.ray, BINARY64)

    @property
    def case(self) -> Case:
        return Case(self.solid, self.ray)

    @cached_property
    def _lists(self) -> dict[tuple[int, Measure, int], Intervals]:
        return {}

    @cached_property
    def _known(self) -> dict[tuple[Pairs, Measure], float]:
        return {}

    def moved(self, step: int, measure: Measure, sigma: int) -> Intervals:
        """Return the outer or inner list of a step of k."""
        key = step, measure, sigma
        if key not in self._lists:
            self._lists[key] = super().moved(step, measure, sigma)
        return self._lists[key]

    def forward(self, answer: Answered) -> Error:
        """Return the forward error of an answer."""
        if answer is None or self.malformed(answer):
            return Error(inf, failed=True)
        right = answer == self.expected
        more = len(answer) - len(self.expected)
        return Error(self.forward_error(answer), more, exact=right, idle=right and not answer)

    def backward(self, answer: Answered, measure: Measure) -> float:
        """Return the least k that explains an answer; infinite where none does."""
        if answer is None or self.malformed(answer):
            return inf
        if (answer, measure) not in self._known:
            self._known[answer, measure] = self._least(answer, measure)
        return self._known[answer, measure]

    def _least(self, answer: Pairs, measure: Measure) -> float:
        # The expected list has k <= 1 by proof, so that the search for its k is short.
        last = ONE if answer == self.expected else LAST_STEP
        i = bisect_left(range(last + 1), True, key=lambda k: self.accepts(answer, k, measure))
        return float(Step.at(i)) if i <= last else inf

    def is_stable(self, answer: Answered) -> bool:
        if answer is None or self.malformed(answer):
            return False
        return self.accepts(answer, LIMIT, "strict")

    def radii(self, answer: Pairs) -> float:
        """Return the largest distance of an end from the exact one along the ray, in radii.

        The answer has the right number of pairs. By logarithms, as neither t nor lengths need be
        anywhere near 1. For people to read.
        """
        pace, worst = hypot(*self.ray.direction), 0.0
        for x, t in self._ends(answer):
            off, below = self.ulps(x, t), enclose(t, BINARY64).down
            if not off or not pace or isinf(off):
                worst = max(worst, off if isinf(off) else 0.0)
                continue
            ulp = max(frexp(below)[1] - BINARY64.precision, BINARY64.least)
            bits = log2(off) + (ulp if below else BINARY64.least) + log2(pace) - log2(self.unit)
            worst = max(worst, 2.0**bits if bits < 1000 else inf)
        return worst

    @property
    def unit(self) -> float:
        """Return the smallest radius or thickness of the solid; 1 where there is none but 0."""
        sizes = [
            hypot(*(b - a for a, b in zip(leaf.p, leaf.q, strict=True)))
            if isinstance(leaf, Slab)
            else getattr(leaf, "radius", 0.0)
            for _, leaf in leaves(self.solid)
        ]
        return min((size for size in sizes if 0 < size < inf), default=1.0)

    @cached_property
    def floor(self) -> float:
        """Return the condition number of the worst endpoint times u, in ulps of that endpoint.

        Infinite for a double root; 0 where there is no endpoint but 0 and infinity. A rounded
        number for people.
        """
        ends = [t for pair in self.exact for t in pair if t.finite and t.sign()]
        return max((self._in_ulps(kappa(t, self.solid, self.ray), t) for t in ends), default=0.0)

    def _in_ulps(self, condition: Surd, t: Surd) -> float:
        near, size = enclose(t, BINARY64).nearest, enclose(condition, BINARY64).nearest
        return size * frexp(near)[0] if near < inf else inf

    @cached_property
    def decides(self) -> bool:
        """Whether no gross answer could hide in the move of k = 64, strictly."""
        return "stable" in decisive(self)


def referees(cases: Iterable[Case]) -> list[Referee]:
    return [Referee.of(case) for case in cases]


def backward(each: Iterable[tuple[Referee, Answered]]) -> tuple[list[float], list[float]]:
    """Return the strict and the squared k of answers."""
    known = list(each)
    return (
        [referee.backward(answer, "strict") for referee, answer in known],
        [referee.backward(answer, "squared") for referee, answer in known],
    )


def quantile(figures: Iterable[float], share: float) -> float:
    """Return the least of one or more figures that so many do not exceed."""
    ranked = sorted(figures)
    return ranked[max(ceil(share * len(ranked)) - 1, 0)]


@dataclass(frozen=True, slots=True)
class Spread:
    """How a figure is spread over rays, failures as infinite: by rank, nothing interpolated."""

    median: float
    p99: float
    largest: float

    @classmethod
    def of(cls, figures: Sequence[float]) -> Spread | None:
        if not figures:
            return None
        return cls(quantile(figures, 0.5), quantile(figures, 0.99), max(figures))
