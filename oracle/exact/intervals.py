"""Interval lists on t >= 0 and their algebra: sorted, disjoint, closed, maximal.

A list is a tuple of (enter, leave) with 0 <= enter_i <= leave_i < enter_{i+1}; the last leave may
be infinity. Every operation takes such lists and gives one: intervals that touch merge, and a
difference is closed again.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from raycert.cases.accept import Numbers
from raycert.cases.formats import Format
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, nearest

Interval = tuple[Surd, Surd]
Intervals = tuple[Interval, ...]

NOTHING: Intervals = ()
EVERYTHING: Intervals = ((ZERO, INFINITY),)


def clip(enter: Surd, leave: Surd) -> Intervals:
    """Return [enter, leave] cut off at t = 0; nothing where it ends before, or is empty."""
    if leave.sign() < 0 or enter > leave:
        return NOTHING
    return ((ZERO if enter.sign() < 0 else enter, leave),)


def merge(intervals: Iterable[Interval]) -> Intervals:
    """Return the union of intervals given in any order."""
    merged: list[Interval] = []
    for enter, leave in sorted(intervals):
        if merged and enter <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(merged[-1][1], leave))
        else:
            merged.append((enter, leave))
    return tuple(merged)


def union(lists: Iterable[Intervals]) -> Intervals:
    """Return the points in any of the lists.

    [0, 1] u [1, 2] = [0, 2].
    """
    return merge(interval for intervals in lists for interval in intervals)


def intersect(one: Intervals, two: Intervals) -> Intervals:
    """Return the points in both lists.

    [0, 1] n [1, 2] = [1, 1].
    """
    common = []
    i = j = 0
    while i < len(one) and j < len(two):
        enter, leave = max(one[i][0], two[j][0]), min(one[i][1], two[j][1])
        if enter <= leave:
            common.append((enter, leave))
        if one[i][1] < two[j][1]:
            i += 1
        else:
            j += 1
    return tuple(common)


def intersection(lists: Iterable[Intervals]) -> Intervals:
    """Return the points in every one of the lists, one or more."""
    return reduce(intersect, lists)


def subtract(one: Intervals, two: Intervals) -> Intervals:
    """Return the closure, within t >= 0, of the points in the first list and not in the second.

    [0, 5] - [2, 2] = [0, 5]; [0, 2] - [2, 5] = [0, 2]; [2, 2] - [0, 5] = []; [0, 2] - [0, 2] = [].
    """
    rest: list[Interval] = []
    for enter, leave in one:
        if enter == leave:
            if not any(a <= enter <= b for a, b in two):
                rest.append((enter, leave))
            continue
        start = enter
        for a, b in two:
            if b <= start or a >= leave:
                continue
            if start < a:
                rest.append((start, a))
            start = b
        if start < leave:
            rest.append((start, leave))
    return merge(rest)


def contains(outer: Intervals, inner: Intervals) -> bool:
    """Whether every interval of `inner` lies in one of `outer`."""
    return all(any(a <= x and y <= b for a, b in outer) for x, y in inner)


def meets(one: Interval, two: Interval) -> bool:
    """Whether two closed intervals have a point in common."""
    return max(one[0], two[0]) <= min(one[1], two[1])


def expected(intervals: Intervals, fmt: Format) -> tuple[Intervals, Numbers]:
    """Return a list with the pairs joined that touch after rounding: exactly, and rounded."""
    exact, near = list(intervals), [(nearest(a, fmt), nearest(b, fmt)) for a, b in intervals]
    for i in range(len(near) - 1, 0, -1):
        if near[i][0] <= near[i - 1][1]:
            exact[i - 1 : i + 1] = [(exact[i - 1][0], exact[i][1])]
            near[i - 1 : i + 1] = [(near[i - 1][0], near[i][1])]
    return tuple(exact), tuple(near)
