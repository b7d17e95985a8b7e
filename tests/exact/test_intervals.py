"""The algebra of interval lists: laws, and a model that counts points and gaps."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.oracle.exact.intervals import (
    EVERYTHING,
    NOTHING,
    Intervals,
    clip,
    contains,
    intersect,
    intersection,
    meets,
    merge,
    subtract,
    union,
)
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, fraction

SCALE = (
    ZERO,
    Surd(0, 1, 2, 2),  # sqrt(1/2)
    fraction(1, 1),
    Surd(0, 1, 2, 1),
    Surd(0, 1, 3, 1),
    fraction(7, 4),
    fraction(22, 7),
    Surd(1, 1, 5, 1),
)
"""Eight numbers in order. In the model they are the cells 0, 2, 4, ..., the gaps above them 1, 3,
5, ...; the last gap reaches to infinity."""
CELLS = 2 * len(SCALE)
Cells = frozenset[int]


def end(cell: int) -> Surd:
    return INFINITY if cell == CELLS else SCALE[cell // 2]


def closed(cells: Iterable[int]) -> Cells:
    """Return the cells with the end points of every gap among them."""
    found = set(cells)
    for gap in [cell for cell in found if cell % 2]:
        found |= {gap - 1, gap + 1} - {CELLS}
    return frozenset(found)


def to_list(cells: Cells) -> Intervals:
    """Return the maximal runs of a closed set of cells as an interval list."""
    starts = sorted(cell for cell in cells if cell - 1 not in cells)
    runs = []
    for start in starts:
        last = start
        while last + 1 in cells:
            last += 1
        runs.append((end(start), end(last + last % 2)))
    return tuple(runs)


def to_cells(intervals: Intervals) -> Cells:
    """Return the cells whose points lie in the list."""
    index = {t: 2 * i for i, t in enumerate(SCALE)} | {INFINITY: CELLS}
    return frozenset(
        cell
        for enter, leave in intervals
        for cell in range(index[enter], index[leave] + 1)
        if cell < CELLS
    )


lists = st.frozensets(st.integers(0, CELLS - 1)).map(closed).map(to_list)


def disguise(v: Surd) -> Surd:
    """Return the same number in other integers."""
    return Surd(6 * v.x, 3 * v.y, 4 * v.d, 6 * v.z) if v.finite else v


def complement(one: Intervals) -> Intervals:
    return subtract(EVERYTHING, one)


def regular(one: Intervals) -> Intervals:
    """Return the list without its single points."""
    return tuple((a, b) for a, b in one if a < b)


def is_a_list(one: Intervals) -> bool:
    return all(ZERO <= a <= b and a.finite for a, b in one) and all(
        a[1] < b[0] for a, b in pairwise(one)
    )


@given(lists)
def test_the_model_is_faithful(one: Intervals) -> None:
    assert is_a_list(one)
    assert to_list(to_cells(one)) == one


@settings(max_examples=300)
@given(lists, lists)
def test_every_operation_agrees_with_the_model(one: Intervals, two: Intervals) -> None:
    a, b = to_cells(one), to_cells(two)
    assert union([one, two]) == to_list(a | b)
    assert intersect(one, two) == to_list(a & b)
    assert subtract(one, two) == to_list(closed(a - b))
    assert contains(one, two) == (b <= a)


@given(lists, lists)
def test_results_are_sorted_disjoint_and_maximal(one: Intervals, two: Intervals) -> None:
    for result in (union([one, two]), intersect(one, two), subtract(one, two)):
        assert is_a_list(result)


@given(lists, lists)
def test_how_a_number_is_written_does_not_matter(one: Intervals, two: Intervals) -> None:
    again = tuple((disguise(a), disguise(b)) for a, b in two)
    assert union([one, again]) == union([one, two])
    assert intersect(one, again) == intersect(one, two)
    assert subtract(one, again) == subtract(one, two)


@given(lists, lists, lists)
def test_union_and_intersection_commute_associate_distribute(
    a: Intervals, b: Intervals, c: Intervals
) -> None:
    assert union([a, b]) == union([b, a])
    assert intersect(a, b) == intersect(b, a)
    assert union([a, union([b, c])]) == union([union([a, b]), c]) == union([a, b, c])
    assert intersect(a, intersect(b, c)) == intersect(intersect(a, b), c) == intersection([a, b, c])
    assert intersect(a, union([b, c])) == union([intersect(a, b), intersect(a, c)])
    assert union([a, intersect(b, c)]) == intersect(union([a, b]), union([a, c]))


@given(lists, lists)
def test_absorption_and_neutral_elements(a: Intervals, b: Intervals) -> None:
    assert union([a, intersect(a, b)]) == a == intersect(a, union([a, b]))
    assert union([a, a]) == a == intersect(a, a)
    assert union([a, NOTHING]) == a == intersect(a, EVERYTHING) == subtract(a, NOTHING)
    assert intersect(a, NOTHING) == NOTHING == subtract(a, a) == subtract(a, EVERYTHING)
    assert union([a, EVERYTHING]) == EVERYTHING


@given(lists, lists, lists)
def test_a_difference_takes_away_only_what_is_there(
    a: Intervals, b: Intervals, c: Intervals
) -> None:
    assert subtract(a, b) == subtract(a, intersect(a, b))
    assert union([subtract(a, b), intersect(a, b)]) == a
    assert subtract(union([a, c]), b) == union([subtract(a, b), subtract(c, b)])
    assert contains(a, subtract(a, b))


@given(lists, lists)
def test_de_morgan_up_to_closure(a: Intervals, b: Intervals) -> None:
    """cl(A' u B') = cl A' u cl B' always; cl(A' n B') lacks only points where A and B touch."""
    assert complement(intersect(a, b)) == union([complement(a), complement(b)])
    neither, both = complement(union([a, b])), intersect(complement(a), complement(b))
    assert contains(both, neither)
    assert regular(both) == neither


@given(lists)
def test_the_complement_of_the_complement_loses_single_points(a: Intervals) -> None:
    assert complement(complement(a)) == regular(a)
    assert union([a, complement(a)]) == EVERYTHING


@given(st.lists(st.tuples(st.integers(0, CELLS // 2 - 1), st.integers(0, CELLS // 2 - 1))))
def test_merging_takes_intervals_in_any_order(pairs: list[tuple[int, int]]) -> None:
    intervals = [(SCALE[min(pair)], SCALE[max(pair)]) for pair in pairs]
    whole = merge(intervals)
    assert whole == merge(reversed(intervals)) == union((i,) for i in intervals)
    assert is_a_list(whole)
    assert to_cells(whole) == frozenset().union(*(to_cells((i,)) for i in intervals))


@given(lists, lists)
def test_intervals_meet_where_they_share_a_point(a: Intervals, b: Intervals) -> None:
    for one in a:
        for two in b:
            assert meets(one, two) == bool(to_cells((one,)) & to_cells((two,)))


def n(*pairs: tuple[int, int]) -> Intervals:
    return tuple((fraction(a, 1), fraction(b, 1)) for a, b in pairs)


@pytest.mark.parametrize(
    ("one", "two", "truth"),
    [
        (n((0, 2)), n((2, 5)), n((0, 2))),
        (n((0, 5)), n((2, 2)), n((0, 5))),
        (n((2, 2)), n((0, 5)), n()),
        (n((0, 2)), n((0, 2)), n()),
        (n((0, 9)), n((2, 3), (3, 4), (6, 7)), n((0, 2), (4, 6), (7, 9))),
        (n((0, 0), (5, 6)), n((0, 1)), n((5, 6))),
    ],
)
def test_differences_of_the_contract(one: Intervals, two: Intervals, truth: Intervals) -> None:
    assert subtract(one, two) == truth


def test_touching_intervals() -> None:
    assert union([n((0, 1)), n((1, 2))]) == n((0, 2))
    assert intersect(n((0, 1)), n((1, 2))) == n((1, 1))
    assert intersect(n((0, 10)), n((1, 2), (3, 4))) == n((1, 2), (3, 4))
    assert intersect(n((1, 2), (3, 4)), n((0, 10))) == n((1, 2), (3, 4))


def test_clip_cuts_at_zero() -> None:
    one, minus = fraction(1, 1), fraction(-1, 1)
    assert clip(minus, one) == ((ZERO, one),)
    assert clip(minus, ZERO) == ((ZERO, ZERO),)
    assert clip(ZERO, ZERO) == ((ZERO, ZERO),)
    assert clip(minus, minus) == NOTHING
    assert clip(one, ZERO) == NOTHING
    assert clip(one, INFINITY) == ((one, INFINITY),)
