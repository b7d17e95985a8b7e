"""Lists of many lanes: the algebra of the scalar lists, lane by lane."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.reference import intervals
from raycert.reference.arrays import lists
from raycert.reference.arrays.lists import Lists, Padded
from raycert.reference.intervals import Pairs

ENDS = st.one_of(st.integers(0, 8).map(float), st.just(np.inf))


@st.composite
def pairs(draw: st.DrawFn) -> Pairs:
    """Draw a list: ends of small integers, so that intervals touch often."""
    ends = draw(st.lists(st.tuples(ENDS, ENDS), max_size=4))
    return intervals.union([(min(end), max(end)) for end in ends])


LANES = 3
ROWS = st.lists(pairs(), min_size=LANES, max_size=LANES)


def packed(rows: Sequence[Pairs]) -> Lists:
    lane = np.array([i for i, row in enumerate(rows) for _ in row], np.int64)
    enter, leave = (np.array([p[i] for row in rows for p in row], float) for i in (0, 1))
    return Lists(lane, enter, leave, len(rows))


def unpacked(found: Lists) -> list[Pairs]:
    rows: Padded = lists.padded(found)
    return [rows.pairs(i) for i in range(found.lanes)]


@given(ROWS)
def test_there_and_back(rows: list[Pairs]) -> None:
    assert unpacked(packed(rows)) == rows
    assert packed(rows).counts().tolist() == [len(row) for row in rows]
    firsts = packed(rows).first(-1.0).tolist()
    assert firsts == [row[0][0] if row else -1.0 for row in rows]


@given(st.lists(ROWS, min_size=1, max_size=4))
def test_union(parts: list[list[Pairs]]) -> None:
    found = unpacked(lists.union([packed(rows) for rows in parts]))
    assert found == [intervals.union(*lane) for lane in zip(*parts, strict=True)]


@given(st.lists(ROWS, min_size=1, max_size=3))
def test_intersection(parts: list[list[Pairs]]) -> None:
    found = unpacked(lists.intersection([packed(rows) for rows in parts]))
    assert found == [intervals.intersection(*lane) for lane in zip(*parts, strict=True)]


@given(ROWS, ROWS)
def test_difference(first: list[Pairs], holes: list[Pairs]) -> None:
    found = unpacked(lists.difference(packed(first), packed(holes)))
    assert found == [intervals.difference(a, b) for a, b in zip(first, holes, strict=True)]


@given(ROWS, ROWS)
def test_a_union_less_nothing_is_itself(one: list[Pairs], two: list[Pairs]) -> None:
    both = lists.union([packed(one), packed(two)])
    assert unpacked(lists.difference(both, lists.nothing(LANES))) == unpacked(both)
    assert unpacked(reduce(lists.difference, [both, packed(one), packed(two)])) == unpacked(
        lists.difference(lists.difference(packed(two), packed(one)), packed(two))
    )


@pytest.mark.parametrize(
    ("first", "holes", "rest"),
    [
        ([(0, 5)], [(2, 2)], [(0, 5)]),
        ([(0, 2)], [(2, 5)], [(0, 2)]),
        ([(2, 2)], [(0, 5)], []),
        ([(0, 2)], [(0, 2)], []),
        ([(0, 9)], [(1, 2), (3, 4)], [(0, 1), (2, 3), (4, 9)]),
    ],
)
def test_differences_by_hand(first: Pairs, holes: Pairs, rest: Pairs) -> None:
    assert unpacked(lists.difference(packed([first]), packed([holes]))) == [rest]
