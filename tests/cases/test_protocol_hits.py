"""A first hit and a truth value out of a list, against the table of the contract."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.protocol import FROM_INSIDE, FromInside, first, hit

Pairs = list[tuple[float, float]]


@st.composite
def lists(draw: st.DrawFn) -> Pairs:
    """Draw sorted and disjoint lists, touches, starts inside and endless ones among them."""
    ends = sorted(draw(st.lists(st.integers(0, 20), unique=True, max_size=6)))
    pairs = [(float(a), float(b)) for a, b in zip(ends[::2], ends[1::2], strict=False)]
    pairs = [(a, a) if draw(st.booleans()) else (a, b) for a, b in pairs]
    if pairs and draw(st.booleans()):
        pairs[-1] = (pairs[-1][0], math.inf)
    return pairs


def right(t: float | None, pairs: Pairs, mode: FromInside) -> bool:
    """Tell what the table of the contract says of t where inner and outer are the list itself."""
    inside = bool(pairs) and pairs[0][0] == 0
    entry = t is not None and bool(pairs) and t == pairs[0][0]
    if mode == "zero":
        return not pairs if t is None else entry
    if mode == "miss":
        return (not pairs or inside) if t is None else entry and not inside
    if t is None:
        return not pairs or pairs[0] == (0, math.inf)
    outside = not any(a <= t < b for a, b in pairs)
    return (entry and not inside) or (inside and t <= pairs[0][1] and outside)


@given(lists(), st.sampled_from(FROM_INSIDE))
def test_a_first_hit_is_right_by_the_table(pairs: Pairs, mode: FromInside) -> None:
    assert right(first(pairs, mode), pairs, mode)


@given(lists())
def test_a_hit_is_a_list_that_is_not_empty(pairs: Pairs) -> None:
    assert hit(pairs) is (pairs != [])
    assert hit(pairs) is (first(pairs, "zero") is not None)


@pytest.mark.parametrize(
    ("pairs", "zero", "leave", "miss"),
    [
        ([], None, None, None),
        ([(2.0, 4.0)], 2.0, 2.0, 2.0),
        ([(0.0, 4.0), (6.0, 7.0)], 0.0, 4.0, None),
        ([(0.0, 0.0), (6.0, 7.0)], 0.0, 0.0, None),
        ([(0.0, math.inf)], 0.0, None, None),
        ([(3.0, 3.0)], 3.0, 3.0, 3.0),
    ],
)
def test_the_modes_differ_from_inside_only(
    pairs: Pairs, zero: float | None, leave: float | None, miss: float | None
) -> None:
    assert [first(pairs, mode) for mode in ("zero", "exit", "miss")] == [zero, leave, miss]
