"""Which rows can decide a level: those where no gross answer hides in the move of k = 64.

Gross is measured by each leaf's own c, 1/8 of the smaller of its radius and thickness; half-spaces
stay where they are on both sides of the comparison. A row is decisive if

- every exact interval that holds one of the list moved inward by c holds one of inner, and
- every outer interval meets an interval of the list moved outward by c that holds all the exact
  intervals which the outer one holds: outer neither joins nor adds what c does not.

`faithful` and `exact` compare with the expected list itself: every row decides them.
"""

from __future__ import annotations

from raycert.cases.levels import LEVELS, Level
from raycert.oracle.exact.intervals import Interval, Intervals, meets
from raycert.oracle.judge.levels import LIMIT, MEASURES, Judge
from raycert.oracle.judge.moved import Step


def decisive(judge: Judge) -> tuple[Level, ...]:
    """Return the levels for which a case is decisive, from weak to strong."""
    return tuple(level for level in LEVELS if level not in MEASURES or _decides(judge, level))


def _decides(judge: Judge, level: Level) -> bool:
    movable, measure, step = judge.movable, MEASURES[level], Step.at(LIMIT)
    inner, outer = (movable.by_k_but_half_spaces(step, measure, sigma) for sigma in (-1, 1))
    deep, wide = movable.by_constant(-1), movable.by_constant(1)
    return _keeps(judge.exact, deep, inner) and _adds_nothing(judge.exact, wide, outer)


def _keeps(exact: Intervals, deep: Intervals, inner: Intervals) -> bool:
    return all(_holds_any(e, inner) for e in exact if _holds_any(e, deep))


def _holds_any(one: Interval, lists: Intervals) -> bool:
    return any(meets(one, other) for other in lists)


def _adds_nothing(exact: Intervals, wide: Intervals, outer: Intervals) -> bool:
    def held(interval: Interval) -> set[int]:
        return {i for i, e in enumerate(exact) if meets(e, interval)}

    return all(any(meets(o, w) and held(o) <= held(w) for w in wide) for o in outer)
