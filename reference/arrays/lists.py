"""Interval lists of many lanes, and their algebra: what `reference.intervals` does, lane by lane.

`Lists` holds the pairs of all lanes in one column each, sorted by lane and then by t; a lane with
no pair takes no room. Only comparisons: no number is changed. `Padded` is the form handed out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import NamedTuple

import numpy as np

from raycert.reference.arrays.vectors import Array, Mask, Whole


class Lists(NamedTuple):
    """The pairs of `lanes` lanes: pair i is (enter[i], leave[i]) in lane[i]."""

    lane: Whole
    enter: Array
    leave: Array
    lanes: int

    def where(self, keep: Mask) -> Lists:
        return Lists(self.lane[keep], self.enter[keep], self.leave[keep], self.lanes)

    def counts(self) -> Whole:
        return np.bincount(self.lane, minlength=self.lanes)

    def first(self, fill: float = np.nan) -> Array:
        """Return the first enter of each lane, `fill` where it has none."""
        enters = np.full(self.lanes, fill)
        enters[self.lane[::-1]] = self.enter[::-1]
        return enters


@dataclass(frozen=True, slots=True)
class Padded:
    """Row i has count[i] pairs (enter[i, j], leave[i, j]); what follows them is NaN."""

    enter: Array
    leave: Array
    count: Whole

    def pairs(self, i: int) -> list[tuple[float, float]]:
        """Return the list of one lane, as the scalar tracer has it."""
        n = self.count[i]
        return list(zip(self.enter[i, :n].tolist(), self.leave[i, :n].tolist(), strict=True))


def nothing(lanes: int) -> Lists:
    return Lists(np.empty(0, np.int64), np.empty(0), np.empty(0), lanes)


def padded(lists: Lists) -> Padded:
    count = lists.counts()
    width = int(count.max(initial=0))
    column = np.arange(lists.lane.size) - _starts(count)[lists.lane]
    enter, leave = (np.full((lists.lanes, width), np.nan) for _ in range(2))
    enter[lists.lane, column] = lists.enter
    leave[lists.lane, column] = lists.leave
    return Padded(enter, leave, count)


def union(parts: list[Lists]) -> Lists:
    """Return the t in any of the parts, one or more. Intervals that touch merge."""
    lanes = parts[0].lanes
    lane, enter, leave = (np.concatenate([part[i] for part in parts]) for i in range(3))
    order = np.lexsort((leave, enter, lane))
    return _merged(Lists(lane[order], enter[order], leave[order], lanes))


def intersection(parts: list[Lists]) -> Lists:
    """Return the t in all of the parts, one or more."""
    return reduce(_common, parts)


def difference(first: Lists, holes: Lists) -> Lists:
    """Return the closure of the t in the first list and not in the holes.

    An interval (a, b) and the holes (c1, d1), (c2, d2), ... of its lane leave the pieces
    (a, min(b, c1)), (max(a, d1), min(b, c2)), ... with a < c1, d1 < b and max(a, d1) < c2, ...:
    cutting by one hole after the other, as the scalar tracer does, gives these.
    """
    count = holes.counts()
    gaps = count[first.lane] + 1
    row, gap = _expand(gaps)
    before, after = gap > 0, gap < gaps[row] - 1
    hole = _starts(count)[first.lane[row]] + gap
    a, b = first.enter[row], first.leave[row]
    low, high, keep = a.copy(), b.copy(), np.ones(row.size, bool)
    end = holes.leave[hole[before] - 1]
    low[before] = np.maximum(a[before], end)
    keep[before] = end < b[before]
    start = holes.enter[hole[after]]
    high[after] = np.minimum(b[after], start)
    keep[after] &= low[after] < start
    return _merged(Lists(first.lane[row], low, high, first.lanes).where(keep))


def _common(one: Lists, two: Lists) -> Lists:
    """Return what each interval of one list has in common with each of the other."""
    count = two.counts()
    row, k = _expand(count[one.lane])
    other = _starts(count)[one.lane[row]] + k
    enter = np.maximum(one.enter[row], two.enter[other])
    leave = np.minimum(one.leave[row], two.leave[other])
    return Lists(one.lane[row], enter, leave, one.lanes).where(enter <= leave)


def _merged(lists: Lists) -> Lists:
    """Return sorted pairs with those joined that meet.

    A pair begins a new interval where its enter is beyond every leave before it in its lane. The
    largest leave so far is found on ranks, which sort by lane first.
    """
    lane, leave = lists.lane, lists.leave
    if lane.size < 2 or not (lane[1:] == lane[:-1]).any():
        return lists
    order = np.lexsort((leave, lane))
    rank = np.empty_like(order)
    rank[order] = np.arange(order.size)
    furthest = order[np.maximum.accumulate(rank)]
    begins = np.ones(lane.size, bool)
    begins[1:] = (lane[1:] != lane[:-1]) | (lists.enter[1:] > leave[furthest[:-1]])
    ends = np.append(begins[1:], True)
    return Lists(lane[begins], lists.enter[begins], leave[furthest[ends]], lists.lanes)


def _starts(count: Whole) -> Whole:
    """Return where each group begins, groups of these sizes one after the other."""
    return np.cumsum(count) - count


def _expand(count: Whole) -> tuple[Whole, Whole]:
    """Return (row, 0), (row, 1), ... for each row, as often as its count says."""
    row = np.repeat(np.arange(count.size), count)
    return row, np.arange(row.size) - _starts(count)[row]
