"""Which levels a case decides: those for which no gross answer hides in the move of k = 64.

Gross is measured by each leaf's own c, 1/8 of the smaller of its radius and thickness. Half-spaces
have none: they stay where they are, on both sides of each comparison. A case is decisive if

- every exact interval that holds one of the list moved inward by c holds one of inner;
- every interval of outer meets an interval of the list moved outward by c that holds all the exact
  intervals which it holds itself: outer neither joins nor adds what c does not. What outer adds
  only where the ray has left the scene is left out (`far_out`);
- no touch lies where nothing moves: to keep or to drop it is a convention there.

`faithful` and `exact` compare with the expected list itself: every case decides them.
"""

from __future__ import annotations

from raycert.cases.levels import LEVELS, Level
from raycert.cases.model import HalfSpace, Leaf, Slab, Solid, Tree, leaves, radius
from raycert.oracle.exact.faces import touch
from raycert.oracle.exact.intervals import Intervals, meets
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd
from raycert.oracle.exact.trace import combine, trace
from raycert.oracle.judge.levels import LIMIT, MEASURES, Judge
from raycert.oracle.judge.moved import Measure, Movable, Step, below_zero

AT_LIMIT = Step.at(LIMIT)


def decisive(judge: Judge) -> tuple[Level, ...]:
    """Return the levels for which a case is decisive, from weak to strong."""
    tied = not judge.movable.tolerance_is_fine() or hangs_on_a_touch(judge)
    return tuple(
        level
        for level in LEVELS
        if level not in MEASURES or not (tied or _hides(judge, MEASURES[level]))
    )


def _hides(judge: Judge, measure: Measure) -> bool:
    """Whether a gross answer could hide between inner and outer."""
    movable, exact = judge.movable, judge.exact
    inner, outer = (movable.by_k(AT_LIMIT, measure, sigma, (HalfSpace,)) for sigma in (-1, 1))
    deep, wide = movable.by_constant(-1), movable.by_constant(1)
    horizon = far_out(movable, measure)
    seen = tuple((a, b) for a, b in outer if b.finite or a <= horizon)
    return not (_keeps(exact, deep, inner) and _adds_nothing(exact, wide, seen))


def _keeps(exact: Intervals, deep: Intervals, inner: Intervals) -> bool:
    return all(_holding((e,), inner) for e in exact if _holding((e,), deep))


def _adds_nothing(exact: Intervals, wide: Intervals, outer: Intervals) -> bool:
    return all(
        any(meets(o, w) and _holding(exact, (o,)) <= _holding(exact, (w,)) for w in wide)
        for o in outer
    )


def _holding(exact: Intervals, lists: Intervals) -> set[int]:
    """Return which exact intervals have a point in common with a list."""
    return {i for i, e in enumerate(exact) if any(meets(e, other) for other in lists)}


def far_out(movable: Movable, measure: Measure) -> Surd:
    """Return the t at which the move of every leaf that has a c has grown by c along the ray.

    The size of the numbers grows with t without bound, so outer reaches in the end whatever runs
    beside the ray for ever, and stays with it: endless intervals that begin beyond this t. They
    hide only answers of 2^43 radii (a strict k = 64 in binary64), so a parallel miss decides,
    however far beside. An interval of outer that ends is another matter: a solid far from the
    start, which the move may reach where it is.
    """
    sized = [leaf for _, leaf in leaves(movable.solid) if not isinstance(leaf, HalfSpace)]
    return max((_grown(leaf, movable, measure) for leaf in sized), default=INFINITY)


def _grown(leaf: Leaf, movable: Movable, measure: Measure) -> Surd:
    """Return the last t with (r + d1 t)^2 + g2 t^2 <= (r + c)^2; a slab has neither r nor g2."""
    move, c = movable.shift(leaf, AT_LIMIT, measure), movable.constant(leaf).d0
    r = 0 if isinstance(leaf, Slab) else movable.grid.scalar(radius(leaf))
    a = move.d1 * move.d1 + (0 if isinstance(leaf, Slab) else move.g2)
    return below_zero(a, 2 * r * move.d1, -c * (2 * r + c), movable.grid)[-1][1]


def hangs_on_a_touch(judge: Judge) -> bool:
    """Whether the start is in the exact list, or not, only by a touch where no face can move.

    s(t) = 0 is so of leaves that lie in the origin, for a ray that starts there.
    """
    move = judge.movable.shift
    pinned = {x for _, x in leaves(judge.solid) if not move(x, AT_LIMIT, "strict").d0}
    dropped = _without_touches(judge.solid, judge, pinned) if pinned else judge.exact
    return _holds_the_start(dropped) != _holds_the_start(judge.exact)


def _holds_the_start(found: Intervals) -> bool:
    return bool(found) and found[0][0] == ZERO


def _without_touches(solid: Solid, judge: Judge, pinned: set[Leaf]) -> Intervals:
    """Return the list with the touches at t = 0 of these leaves dropped."""
    if isinstance(solid, Tree):
        return combine(solid, [_without_touches(part, judge, pinned) for part in solid.of])
    found = trace(solid, judge.ray).intervals
    touched = solid in pinned and _holds_the_start(found) and touch(found[0], solid, judge.ray)
    return found[1:] if touched else found
