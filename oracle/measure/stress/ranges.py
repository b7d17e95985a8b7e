"""Ranges: how far from the mild step a method stays `stable` and `sound`, read from its curve.

Every step from the mild one to the last of a range holds the level, on all of its samples. What
comes after the first step that does not is outside, also where it happens to hold again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from raycert.oracle.measure.stress.measure import Point
from raycert.oracle.measure.stress.sweeps import Sweep

MOST = 64
"""The k that `sound` and `stable` allow."""
Holds = Callable[[Point], bool]


def is_stable(point: Point) -> bool:
    """Tell whether every answer of a step is `stable`."""
    return point.strict <= MOST


def is_sound(point: Point) -> bool:
    """Tell whether every answer of a step is `sound`."""
    return point.squared <= MOST


def is_exact(point: Point) -> bool:
    """Tell whether every answer of a step is the expected list."""
    return point.exact == point.count


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
        """Tell whether every step of the sweep holds."""
        return not self.broken


def sides(steps: Sequence[Fraction], mild: Fraction) -> tuple[list[Fraction], list[Fraction]]:
    """Return the steps before and after the mild one on the axis, each from there outward."""
    middle = steps.index(mild)
    return list(reversed(steps[:middle])), list(steps[middle + 1 :])


def reach(sweep: Sweep, curve: Mapping[Fraction, Point], holds: Holds) -> Range:
    """Return the range of a level on a curve that has every step asked, the mild one included."""
    steps = [x for x in sweep.steps if x in curve]
    if not holds(curve[sweep.mild]):
        return Range(None, None, (sweep.mild,))
    ends, broken = [], []
    for side in sides(steps, sweep.mild):
        last = sweep.mild
        for x in side:
            if not holds(curve[x]):
                broken.append(x)
                break
            last = x
        ends.append(last)
    return Range(ends[0], ends[1], tuple(broken))


@dataclass(frozen=True, slots=True)
class Ranges:
    """The ranges of one method on one sweep."""

    stable: Range
    sound: Range
    exact: Range

    @classmethod
    def read(cls, sweep: Sweep, curve: Mapping[Fraction, Point]) -> Ranges:
        """Return the ranges of a curve."""
        levels = (reach(sweep, curve, holds) for holds in (is_stable, is_sound, is_exact))
        return cls(*levels)


def spelled(found: Range, sweep: Sweep) -> str:
    """Return a range as people read it: `all`, `to 1e6`, `1e-4 .. 1e7`, `nowhere`.

    >>> from raycert.oracle.measure.stress.sweeps import SWEEPS
    >>> spelled(Range(Fraction(1), Fraction(1000), (Fraction(10000),)), SWEEPS["far"])
    'to 1e3'
    """
    if found.whole:
        return "all"
    if found.low is None or found.high is None:
        return "nowhere"
    low, high = sweep.text(found.low), sweep.text(found.high)
    if sweep.mild in (sweep.steps[0], sweep.steps[-1]):
        return f"to {high if found.low == sweep.mild else low}"
    return f"{low} .. {high}"
