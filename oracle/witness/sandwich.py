"""Two lists around the true one: their Booleans, and what they say about an answer.

A `Sandwich` promises inner <= true <= outer as sets of t, up to single points of the inner list's
ends. The algebra here is not the oracle's: a list is a set of the elementary segments between all
ends that occur, each decided by itself. Single points are dropped, which a sandwich may do: inner
may be smaller, and outer reaches beyond the true list by more than a point wherever that is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import inf

from raycert.cases.model import Difference, Intersection, Tree, Union
from raycert.oracle.exact.intervals import Interval, Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, decimal, fraction
from raycert.oracle.witness.testimony import Outcome

NONE: Intervals = ()
ALL: Intervals = ((ZERO, INFINITY),)
Rule = Callable[[Sequence[bool]], bool]


@dataclass(frozen=True, slots=True)
class Sandwich:
    """An inner and an outer list, and the casts that said nothing."""

    inner: Intervals
    outer: Intervals
    doubts: tuple[str, ...] = ()


def surd(x: Fraction) -> Surd:
    return fraction(x.numerator, x.denominator)


def covers(intervals: Intervals, low: Surd, high: Surd) -> bool:
    """Whether [low, high] lies in one interval."""
    return any(a <= low and high <= b for a, b in intervals)


def select(lists: Sequence[Intervals], rule: Rule) -> Intervals:
    """Return the closure of the segments of t >= 0 for whose memberships the rule holds."""
    ends = {end for one in lists for interval in one for end in interval}
    cuts = sorted(ends | {ZERO, INFINITY})
    kept: list[Interval] = []
    for low, high in pairwise(cuts):
        if rule([covers(one, low, high) for one in lists]):
            joined = kept and kept[-1][1] == low
            kept[-1 if joined else len(kept) :] = [(kept[-1][0] if joined else low, high)]
    return tuple(kept)


def _only_first(inside: Sequence[bool]) -> bool:
    return inside[0] and not any(inside[1:])


RULES: dict[type, Rule] = {Union: any, Intersection: all, Difference: _only_first}


def combine(tree: Tree, parts: Sequence[Sandwich]) -> Sandwich:
    """Return the sandwich of a Boolean: a part that is taken away changes sides."""
    inner, outer = [part.inner for part in parts], [part.outer for part in parts]
    doubts = tuple(doubt for part in parts for doubt in part.doubts)
    if isinstance(tree, Difference):
        inner, outer = [inner[0], *outer[1:]], [outer[0], *inner[1:]]
    rule = RULES[type(tree)]
    return Sandwich(select(inner, rule), select(outer, rule), doubts)


def judge(answer: Intervals, sandwich: Sandwich) -> tuple[Outcome, str]:
    """Return what a sandwich says of an answer, and why.

    disagreed   an inner interval is not in one of the answer, or one of the answer not in an outer
    agreed      neither, and there is one inner for each outer interval, at least half as long, and
                one of the answer between the two: the number of pairs is settled, and each of
                them. An outer list that is empty settles an empty answer.
    undecided   neither, and something is too thin for the bodies: a touch, a sliver, a slit
    """
    for a, b in sandwich.inner:
        if not covers(answer, a, b):
            return "disagreed", f"{show_pair(a, b)} is inside, and in no pair of the answer"
    for a, b in answer:
        if not covers(sandwich.outer, a, b):
            return "disagreed", f"{show_pair(a, b)} of the answer reaches outside"
    doubt = f" ({'; '.join(sandwich.doubts)})" if sandwich.doubts else ""
    for low, high in sandwich.outer:
        inside = [(a, b) for a, b in sandwich.inner if low <= a and b <= high]
        pairs = sum(low <= a and b <= high for a, b in answer)
        if len(inside) != 1 or pairs != 1:
            why = (
                f"{show_pair(low, high)} holds {len(inside)} inner and {pairs} pairs of the answer"
            )
            return "undecided", why + doubt
        if 2 * length(inside[0]) < length((low, high)):
            return "undecided", f"{show_pair(low, high)} is less than half confirmed{doubt}"
    return "agreed", f"inner and outer settle {len(answer)} pairs"


def length(interval: Interval) -> Fraction | float:
    """Return how long an interval with rational ends is, inf where it never ends."""
    low, high = (end.rational() for end in interval)
    assert low is not None
    return inf if high is None else high - low


def show_pair(a: Surd, b: Surd) -> str:
    return f"[{decimal(a, 8)}, {decimal(b, 8)}]"


def show(sandwich: Sandwich) -> str:
    inner, outer = (
        ", ".join(show_pair(a, b) for a, b in one) for one in (sandwich.inner, sandwich.outer)
    )
    return f"inner [{inner}], outer [{outer}]"
