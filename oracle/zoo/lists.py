"""Lists of closed intervals of t: the algebra that a tree needs, done right."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, nan

Pair = tuple[float, float]
Pairs = list[Pair]
LINE: Pairs = [(-inf, inf)]
NAN: Pairs = [(nan, nan)]


def common(first: Pairs, second: Pairs) -> Pairs:
    """Return the t in both lists; NaN where one has it."""
    if len(first) == len(second) == 1:
        (a, b), (c, d) = first[0], second[0]
        if a != a or c != c:
            return NAN
        enter, leave = (a if a > c else c), (b if b < d else d)
        return [(enter, leave)] if enter <= leave else []
    pieces = [(max(a, c), min(b, d)) for a, b in first for c, d in second]
    return [(a, b) for a, b in pieces if a <= b]


def share(lists: Sequence[Pairs]) -> Pairs:
    """Return the t in all lists."""
    left = lists[0]
    for pairs in lists[1:]:
        left = common(left, pairs)
    return left


def merged(pairs: Pairs) -> Pairs:
    """Return the list of intervals in any order, sorted, and joined where they touch."""
    found: Pairs = []
    for a, b in sorted(pairs):
        if found and a <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], b))
        else:
            found.append((a, b))
    return found


def unite(lists: Sequence[Pairs]) -> Pairs:
    """Return the t in any list."""
    return merged([pair for pairs in lists for pair in pairs])


def subtract(lists: Sequence[Pairs]) -> Pairs:
    """Return the closure of the t in the first list and in no other."""
    left = list(lists[0])
    for hole in unite(lists[1:]):
        left = [piece for pair in left for piece in cut(pair, hole)]
    return merged(left)


def cut(pair: Pair, hole: Pair) -> Pairs:
    """Return the closures of what is before a hole and of what is after it."""
    (a, b), (c, d) = pair, hole
    before = [(a, min(b, c))] if a < c else []
    return before + ([(max(a, d), b)] if d < b else [])
