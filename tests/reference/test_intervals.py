"""The algebra of float lists: its laws, and membership as the meaning of each operation."""

from __future__ import annotations

from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.reference.intervals import Pairs, difference, intersection, pair, union

POINTS = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, inf]
BETWEEN = [0.5, 1.5, 2.5, 3.5, 4.5, 100.0]
"""One t inside each gap of `POINTS`: a list with its ends in `POINTS` is constant there."""


@st.composite
def lists(draw: st.DrawFn) -> Pairs:
    """Draw a sorted, disjoint list with ends on few points, so that lists often touch."""
    drawn = draw(st.lists(st.tuples(st.sampled_from(POINTS[:-1]), st.sampled_from(POINTS))))
    return union([(a, b) for a, b in drawn if a <= b])


def holds(pairs: Pairs, t: float) -> bool:
    """Tell whether t is in a list."""
    return any(enter <= t <= leave for enter, leave in pairs)


def well_formed(pairs: Pairs) -> bool:
    """Tell whether a list is sorted and disjoint, with no pair back to front."""
    ends = [end for interval in pairs for end in interval]
    gaps = zip(ends[1::2], ends[2::2], strict=False)
    return ends == sorted(ends) and all(leave < enter for leave, enter in gaps)


@given(lists(), lists())
def test_every_operation_returns_a_well_formed_list(a: Pairs, b: Pairs) -> None:
    for result in (union(a, b), intersection(a, b), difference(a, b)):
        assert well_formed(result)


@given(lists(), lists())
def test_union_and_intersection_are_what_is_in_any_and_in_all(a: Pairs, b: Pairs) -> None:
    for t in POINTS[:-1] + BETWEEN:
        assert holds(union(a, b), t) == (holds(a, t) or holds(b, t))
        assert holds(intersection(a, b), t) == (holds(a, t) and holds(b, t))


@given(lists(), lists())
def test_difference_is_the_closure_of_what_is_left(a: Pairs, b: Pairs) -> None:
    left = difference(a, b)
    for t in BETWEEN:
        assert holds(left, t) == (holds(a, t) and not holds(b, t))
    for t in POINTS[:-1]:
        remains = holds(a, t) and not holds(b, t)
        limit = any(holds(left, t + step) for step in (-0.5, 0.5) if t + step > 0)
        assert holds(left, t) == (remains or limit)


@given(lists(), lists(), lists())
def test_union_and_intersection_commute_associate_and_distribute(
    a: Pairs, b: Pairs, c: Pairs
) -> None:
    for operation in (union, intersection):
        assert operation(a, b) == operation(b, a)
        assert operation(a, operation(b, c)) == operation(operation(a, b), c) == operation(a, b, c)
        assert operation(a, a) == a
    assert intersection(a, union(b, c)) == union(intersection(a, b), intersection(a, c))
    assert union(a, intersection(b, c)) == intersection(union(a, b), union(a, c))


@given(lists(), lists(), lists())
def test_de_morgan(a: Pairs, b: Pairs, c: Pairs) -> None:
    cuts = difference(a, b), difference(a, c)
    assert difference(a, intersection(b, c)) == union(*cuts)
    # The other law loses touches to the closures: [0, 5] less [0, 2] and less [2, 5] share 2, and
    # [0, 5] less both is empty.
    assert difference(a, union(b, c)) == difference(a, b, c)
    assert intersection(difference(a, b, c), *cuts) == difference(a, b, c)


@pytest.mark.parametrize(
    ("first", "other", "left"),
    [
        ([(0, 2)], [(2, 5)], [(0, 2)]),
        ([(0, 5)], [(2, 2)], [(0, 5)]),
        ([(2, 2)], [(0, 5)], []),
        ([(0, 2)], [(0, 2)], []),
        ([(0, inf)], [(0, inf)], []),
        ([(0, inf)], [(3, inf)], [(0, 3)]),
        ([(0, inf)], [(0, 0)], [(0, inf)]),
        ([(0, 0)], [(0, 0)], []),
        ([(2, 2)], [(3, 4)], [(2, 2)]),
        ([(0, 5)], [(1, 2), (3, 4)], [(0, 1), (2, 3), (4, 5)]),
    ],
)
def test_difference_by_hand(first: Pairs, other: Pairs, left: Pairs) -> None:
    assert difference(first, other) == left


def test_a_difference_with_nothing_and_an_intersection_of_one_change_nothing() -> None:
    assert difference([(0, 1)]) == intersection([(0, 1)]) == [(0, 1)]


def test_a_pair_back_to_front_is_no_interval() -> None:
    assert pair(2, 1) == []
    assert pair(1, 1) == [(1, 1)]
