"""How far answers are from right: one question judged exactly, and what a step has of a method.

The lists moved by k are made once for a question, whoever answers. An answer that is the expected
list has k <= 1 by proof, so that the search for its k is short.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil, frexp, inf

from raycert.cases.accept import Numbers
from raycert.cases.formats import BINARY64
from raycert.cases.model import Refused
from raycert.oracle.exact.condition import kappa
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.rounding import enclose
from raycert.oracle.exact.surd import Surd
from raycert.oracle.judge.decisive import decisive
from raycert.oracle.judge.levels import LIMIT, Judge
from raycert.oracle.judge.moved import LAST_STEP, Measure, Step
from raycert.oracle.measure.methods.method import Answered, Case
from raycert.oracle.measure.stress.sample import Sample

ONE = 8
"""The step of k = 1."""
HIGH = 0.9
"""The quantile beside the maximum."""


@dataclass(frozen=True)
class Question(Judge):
    """A judge that keeps the moved lists: every method is judged by the same ones."""

    @classmethod
    def of(cls, sample: Sample) -> Question | None:
        """Return the question of a sample; None where rounding leaves no solid."""
        try:
            solid, ray = sample.posed()
        except Refused:
            return None
        return cls(solid, ray, BINARY64)

    @property
    def case(self) -> Case:
        """Return it as methods take it."""
        return Case(self.solid, self.ray)

    @cached_property
    def _lists(self) -> dict[tuple[int, Measure, int], Intervals]:
        return {}

    @cached_property
    def _known(self) -> dict[Answered, Measured]:
        return {}

    def moved(self, step: int, measure: Measure, sigma: int) -> Intervals:
        """Return the outer or inner list of a step of k, made once."""
        key = (step, measure, sigma)
        if key not in self._lists:
            self._lists[key] = super().moved(step, measure, sigma)
        return self._lists[key]

    def measured(self, answer: Answered) -> Measured:
        """Return how far an answer is from right, worked out once."""
        if answer not in self._known:
            self._known[answer] = self._measure(answer)
        return self._known[answer]

    def _measure(self, answer: Answered) -> Measured:
        if answer is None or self.malformed(answer):
            return FAILED
        pairs = tuple(answer)
        exact = pairs == self.expected
        last = ONE if exact else LAST_STEP
        strict, squared = self._least(pairs, "strict", last), self._least(pairs, "squared", last)
        count = len(pairs) - len(self.expected)
        return Measured(strict, squared, self.forward_error(pairs), count, exact=exact)

    def is_stable(self, answer: Answered) -> bool:
        """Tell whether an answer is well-formed and its strict k at most 64."""
        if answer is None or self.malformed(answer):
            return False
        return self.accepts(tuple(answer), LIMIT, "strict")

    def _least(self, pairs: Numbers, measure: Measure, last: int) -> float:
        """Return the least k of the steps up to `last` that accepts a list; else infinity."""
        steps = range(last + 1)
        i = bisect_left(steps, True, key=lambda step: self.accepts(pairs, step, measure))
        return float(Step.at(i)) if i <= last else inf

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
        """Tell whether no gross answer could hide in the move of k = 64, strictly."""
        return "stable" in decisive(self)


@dataclass(frozen=True, slots=True)
class Measured:
    """One answer: k strict and squared, ulps, how many pairs too many (< 0: too few)."""

    strict: float
    squared: float
    ulps: float
    pairs: int = 0
    failed: bool = False
    exact: bool = False


FAILED = Measured(inf, inf, inf, failed=True)


@dataclass(frozen=True, slots=True)
class Point:
    """What a method did at one step: worst and high quantile of the errors, and the counts.

    `ulps` are over the answers with the right number of pairs; None where there is none.
    """

    count: int
    strict: float
    strict_high: float
    squared: float
    squared_high: float
    ulps: float | None
    ulps_high: float | None
    missed: int
    phantom: int
    failed: int
    exact: int

    @property
    def wrong(self) -> float:
        """Return the fraction of wrong counts and failures."""
        return (self.missed + self.phantom + self.failed) / self.count

    @property
    def inexact(self) -> float:
        """Return the fraction of answers that are not the expected list."""
        return (self.count - self.exact) / self.count

    @classmethod
    def over(cls, answers: Sequence[Measured]) -> Point:
        """Return the point of one or more answers."""
        strict, squared = [a.strict for a in answers], [a.squared for a in answers]
        ulps = [a.ulps for a in answers if not a.failed and not a.pairs]
        return cls(
            len(answers),
            max(strict),
            high(strict),
            max(squared),
            high(squared),
            max(ulps, default=None),
            high(ulps) if ulps else None,
            sum(a.pairs < 0 for a in answers),
            sum(a.pairs > 0 for a in answers),
            sum(a.failed for a in answers),
            sum(a.exact for a in answers),
        )


@dataclass(frozen=True, slots=True)
class Ground:
    """What a step is like, whoever answers: the condition line, and how many questions decide."""

    count: int
    floor: float
    floor_high: float
    decisive: int

    @classmethod
    def over(cls, questions: Sequence[Question]) -> Ground:
        """Return the ground of one or more questions."""
        floors = [q.floor for q in questions]
        decides = sum(q.decides for q in questions)
        return cls(len(questions), max(floors), high(floors), decides)


def high(values: Iterable[float]) -> float:
    """Return the high quantile of one or more values: the least that so many do not exceed."""
    ordered = sorted(values)
    return ordered[max(ceil(HIGH * len(ordered)) - 1, 0)]
