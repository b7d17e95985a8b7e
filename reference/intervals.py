"""The algebra of lists of closed intervals of t.

A list is sorted and disjoint: enter_i <= leave_i < enter_{i+1}. Every function takes such lists
and returns one, and only compares: no number is changed, so nothing is rounded here.
"""

from __future__ import annotations

from collections.abc import Iterable

Pair = tuple[float, float]
Pairs = list[Pair]


def pair(enter: float, leave: float) -> Pairs:
    """Return the list of the one interval, empty if it would end before it begins."""
    return [(enter, leave)] if enter <= leave else []


def union(*lists: Iterable[Pair]) -> Pairs:
    """Return the t in any of the lists. Intervals that touch merge.

    >>> union([(0.0, 1.0), (3.0, 4.0)], [(1.0, 2.0)])
    [(0.0, 2.0), (3.0, 4.0)]
    """
    merged: Pairs = []
    for enter, leave in sorted(interval for pairs in lists for interval in pairs):
        if merged and enter <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(merged[-1][1], leave))
        else:
            merged.append((enter, leave))
    return merged


def intersection(first: Iterable[Pair], *others: Iterable[Pair]) -> Pairs:
    """Return the t in all of the lists: Problem 3 (d), for each interval with each.

    >>> intersection([(0.0, 2.0)], [(1.0, 5.0)])
    [(1.0, 2.0)]
    >>> intersection([(0.0, 2.0)], [(2.0, 5.0)])
    [(2.0, 2.0)]
    """
    common = list(first)
    for other in others:
        common = [
            piece for a, b in common for c, d in other for piece in pair(max(a, c), min(b, d))
        ]
    return common


def difference(first: Iterable[Pair], *others: Iterable[Pair]) -> Pairs:
    """Return the closure of the t in the first list and in none of the others.

    An end that the cut leaves open is closed again, so removing a point removes only a point.

    >>> difference([(0.0, 5.0)], [(2.0, 3.0)])
    [(0.0, 2.0), (3.0, 5.0)]
    >>> difference([(0.0, 5.0)], [(2.0, 2.0)])
    [(0.0, 5.0)]
    >>> difference([(2.0, 2.0)], [(0.0, 5.0)])
    []
    """
    left = list(first)
    for hole in union(*others):
        left = [piece for interval in left for piece in _cut(interval, hole)]
    return union(left)


def _cut(interval: Pair, hole: Pair) -> Pairs:
    """Return the closures of what is before the hole and of what is after it."""
    (a, b), (c, d) = interval, hole
    before = [(a, min(b, c))] if a < c else []
    after = [(max(a, d), b)] if d < b else []
    return before + after
