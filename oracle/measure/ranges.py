"""What a way does at a step of a sweep, and how far from the mild step it stays on a level.

Every step from the mild one to the last of a range holds the level, on all of its samples. What
comes after the first step that does not is outside, also where it happens to hold again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from raycert.oracle.measure.errors import Error, Referee, backward, quantile
from raycert.oracle.measure.sweeps import Sweep
from raycert.oracle.measure.way import Answered

MOST = 64
"""The k that `sound` and `stable` allow."""
HIGH = 0.9
"""The quantile beside the maximum."""


def _worst(figures: Sequence[float]) -> tuple[float, float]:
    return max(figures), quantile(figures, HIGH)


@dataclass(frozen=True, slots=True)
class Point:
    """What a way did at one step: worst and high quantile of the errors, and the counts.

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
        return (self.missed + self.phantom + self.failed) / self.count

    @property
    def inexact(self) -> float:
        return (self.count - self.exact) / self.count

    @classmethod
    def of(
        cls, errors: Sequence[Error], strict: Sequence[float], squared: Sequence[float]
    ) -> Point:
        """Return the point of one or more answers: their errors, forward and backward."""
        ulps = [e.ulps for e in errors if e.counts]
        worst = (*_worst(strict), *_worst(squared), *(_worst(ulps) if ulps else (None, None)))
        counts = ((e.pairs < 0, e.pairs > 0, e.failed, e.exact) for e in errors)
        return cls(len(errors), *worst, *map(sum, zip(*counts, strict=True)))

    @classmethod
    def over(cls, referees: Sequence[Referee], answers: Sequence[Answered]) -> Point:
        each = list(zip(referees, answers, strict=True))
        return cls.of([referee.forward(answer) for referee, answer in each], *backward(each))


@dataclass(frozen=True, slots=True)
class Ground:
    """What a step is like, whoever answers: the condition line, and how many questions decide."""

    count: int
    floor: float
    floor_high: float
    decisive: int

    @classmethod
    def over(cls, referees: Sequence[Referee]) -> Ground:
        decisive = sum(referee.decides for referee in referees)
        return cls(len(referees), *_worst([referee.floor for referee in referees]), decisive)


Holds = Callable[[Point], bool]
LEVELS: dict[str, Holds] = {
    "stable": lambda point: point.strict <= MOST,
    "sound": lambda point: point.squared <= MOST,
    "exact": lambda point: point.exact == point.count,
}
"""Whether every answer of a step is on a level: `exact` is the expected list."""


@dataclass(frozen=True, slots=True)
class Range:
    """The steps that hold a level: from `low` to `high` on the axis; None where the mild one fails.

    `broken` are the first steps beyond, on each side that has one.
    """

    low: Fraction | None
    high: Fraction | None
    broken: tuple[Fraction, ...]

    @property
    def whole(self) -> bool:
        """Whether every step of the sweep holds."""
        return not self.broken


Ranges = Mapping[str, Range]
"""By level, of one way on one sweep."""


def sides(steps: Sequence[Fraction], mild: Fraction) -> tuple[list[Fraction], list[Fraction]]:
    """Return the steps before and after the mild one on the axis, each from there outward."""
    middle = steps.index(mild)
    return list(reversed(steps[:middle])), list(steps[middle + 1 :])


def reach(sweep: Sweep, curve: Mapping[Fraction, Point], holds: Callable[[Point], bool]) -> Range:
    """Return the range of a level on a curve that has every step asked, the mild one included."""
    if not holds(curve[sweep.mild]):
        return Range(None, None, (sweep.mild,))
    ends, broken = [], []
    for side in sides([x for x in sweep.steps if x in curve], sweep.mild):
        first = next((i for i, x in enumerate(side) if not holds(curve[x])), len(side))
        ends.append([sweep.mild, *side][first])
        broken += side[first : first + 1]
    return Range(ends[0], ends[1], tuple(broken))


def ranges_of(sweep: Sweep, curve: Mapping[Fraction, Point]) -> Ranges:
    """Return the ranges of a curve, by level."""
    return {level: reach(sweep, curve, holds) for level, holds in LEVELS.items()}


def spelled(steps: Range, sweep: Sweep) -> str:
    """Return a range as people read it: `all`, `to 1e6`, `1e-4 .. 1e7`, `nowhere`.

    >>> from raycert.oracle.measure.sweeps import SWEEPS
    >>> spelled(Range(Fraction(1), Fraction(1000), (Fraction(10000),)), SWEEPS["far"])
    'to 1e3'
    """
    if steps.whole:
        return "all"
    if steps.low is None or steps.high is None:
        return "nowhere"
    low, high = sweep.text(steps.low), sweep.text(steps.high)
    if sweep.mild in (sweep.steps[0], sweep.steps[-1]):
        return f"to {high if steps.low == sweep.mild else low}"
    return f"{low} .. {high}"
