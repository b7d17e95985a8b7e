"""An answer as what it claims, an interval list, a first hit, a yes or no, and how far it is right.

Each kind is compared with an inner list I and an outer list O, I <= exact <= O:

    intervals   I <= answer <= O, as sets of t, with not too many pairs in an interval of O
    first       `first_fault`: null, or a t that may be the first
    any         no: I is empty; yes: O is not

and with the expected list, for `faithful` and `exact`. All rules are monotone: what is right stays
so when I shrinks and O grows, so each kind has a backward error k.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isinf, isnan
from typing import Any, Protocol, TypeVar

from raycert.cases.accept import Accept, Numbers
from raycert.cases.protocol import FromInside, Hello, Reply, first_end
from raycert.oracle.exact.surd import ZERO, dyadic
from raycert.oracle.judge.backward import Bracket
from raycert.oracle.judge.levels import Enclosures, Judge
from raycert.oracle.judge.moved import LAST_STEP, Measure


class Claim(Protocol):
    """What every kind of answer can be asked."""

    def malformed(self, judge: Judge) -> str | None:
        """Return what is wrong with the answer as such; None if nothing is."""

    def fault(self, accept: Accept) -> str | None:
        """Return why it is not between the lists of a level; None if it is."""

    def is_expected(self, wanted: Numbers) -> str | None:
        """Return why it is not the answer that follows from a list; None if it is."""

    def is_faithful(self, wanted: Numbers, enclosures: Enclosures) -> str | None:
        """Return why a number of it is not one of the two around the exact one; None if it is."""

    def bracket(self, judge: Judge, measure: Measure) -> Bracket:
        """Return the least step of k that accepts it, to be found."""

    def backward_error(self, judge: Judge, measure: Measure) -> float:
        """Return the least k that accepts it; infinite where none does."""
        return self.bracket(judge, measure).k

    def forward_error(self, judge: Judge) -> float:
        """Return the largest distance of a number of it from the exact one, in ulps."""

    def keeps_touch(self, wanted: Numbers) -> bool | None:
        """Whether it kept the touches that are the whole of a list; None if it cannot tell."""

    def meets(self, down: float, up: float) -> bool:
        """Whether it has something between two numbers."""


def claim(reply: Reply, hello: Hello) -> Claim:
    """Return what a reply claims, -0 as 0; a first hit where answers are endless is a miss."""
    endless = inf if hello.infinity is None else hello.infinity
    if hello.answers == "any":
        return YesNo(bool(reply.hit))
    if hello.answers == "first":
        t = reply.first
        far = t is None or (hello.infinity is not None and t >= endless)
        return First(None if t is None or far else t + 0.0, hello.from_inside)
    pairs = ((a + 0.0, inf if b >= endless else b + 0.0) for a, b in reply.intervals or ())
    return Listed(tuple(pairs))


@dataclass(frozen=True, slots=True)
class Listed(Claim):
    """An interval list."""

    pairs: Numbers

    def malformed(self, judge: Judge) -> str | None:
        return judge.malformed(self.pairs)

    def fault(self, accept: Accept) -> str | None:
        return accept.fault(self.pairs)

    def is_expected(self, wanted: Numbers) -> str | None:
        shown = [list(pair) for pair in wanted]
        return None if self.pairs == wanted else f"is not the expected list {shown}"

    def is_faithful(self, wanted: Numbers, enclosures: Enclosures) -> str | None:
        if len(self.pairs) != len(wanted):
            return f"{len(self.pairs)} pairs, {len(wanted)} expected"
        for pair, around in zip(self.pairs, enclosures, strict=True):
            for x, two in zip(pair, around, strict=True):
                if x not in two:
                    return f"{x!r} is not one of the two numbers around the exact one, {two}"
        return None

    def bracket(self, judge: Judge, measure: Measure) -> Bracket:
        return judge.bracket_of_list(self.pairs, measure)

    def forward_error(self, judge: Judge) -> float:
        return judge.forward_error(self.pairs)

    def keeps_touch(self, wanted: Numbers) -> bool | None:
        return bool(self.pairs)

    def meets(self, down: float, up: float) -> bool:
        return any(a <= up and down <= b for a, b in self.pairs)


@dataclass(frozen=True, slots=True)
class First(Claim):
    """A first hit at t, or none; from inside it is what `from_inside` says."""

    t: float | None
    from_inside: FromInside

    def malformed(self, judge: Judge) -> str | None:
        if self.t is None:
            return None
        if isnan(self.t):
            return "first is NaN"
        if self.t < 0:
            return f"first {self.t!r} is negative"
        may_overflow = any(isinf(enter) for enter, _ in judge.expected)
        return "first is infinite" if isinf(self.t) and not may_overflow else None

    def fault(self, accept: Accept) -> str | None:
        return first_fault(self.t, accept.inner, accept.outer, self.from_inside, 0.0, inf)

    def is_expected(self, wanted: Numbers) -> str | None:
        end = first_end(wanted, self.from_inside)
        t = None if end is None else wanted[end[0]][end[1]]
        return None if self.t == t else f"first is {_null(self.t)}, {_null(t)} expected"

    def is_faithful(self, wanted: Numbers, enclosures: Enclosures) -> str | None:
        end = first_end(wanted, self.from_inside)
        if end is None or self.t is None:
            return self.is_expected(wanted)
        two = enclosures[end[0]][end[1]]
        if self.t in two:
            return None
        return f"{self.t!r} is not one of the two numbers around the exact one, {two}"

    def bracket(self, judge: Judge, measure: Measure) -> Bracket:
        if self.malformed(judge):
            return Bracket.at(LAST_STEP + 1)
        t = None if self.t is None else dyadic(self.t)
        last = dyadic(inf)
        return judge.bracket(
            measure,
            lambda inner, outer: not first_fault(t, inner, outer, self.from_inside, ZERO, last),
            () if self.t is None else ((self.t, self.t),),
        )

    def forward_error(self, judge: Judge) -> float:
        """Return the distance of t from the exact first; infinite where one of them is none."""
        end = first_end(judge.expected, self.from_inside)
        if end is None or self.t is None or self.malformed(judge):
            return 0.0 if end is None and self.t is None else inf
        return judge.ulps(self.t, judge.merged[end[0]][end[1]])

    def keeps_touch(self, wanted: Numbers) -> bool | None:
        """Whether there is a hit. From inside, no hit may be the mode, not the convention."""
        if self.from_inside != "zero" and wanted and wanted[0][0] == 0:
            return None
        return self.t is not None

    def meets(self, down: float, up: float) -> bool:
        return self.t is not None and down <= self.t <= up


@dataclass(frozen=True, slots=True)
class YesNo(Claim):
    """Whether anything is hit."""

    hit: bool

    def malformed(self, judge: Judge) -> str | None:
        return None

    def fault(self, accept: Accept) -> str | None:
        if self.hit:
            return None if accept.outer else "a hit, and the outer list is empty"
        return f"no hit, and the inner list has {accept.inner[0]}" if accept.inner else None

    def is_expected(self, wanted: Numbers) -> str | None:
        return None if self.hit == bool(wanted) else f"hit is {self.hit}, {bool(wanted)} expected"

    def is_faithful(self, wanted: Numbers, enclosures: Enclosures) -> str | None:
        return self.is_expected(wanted)

    def bracket(self, judge: Judge, measure: Measure) -> Bracket:
        return judge.bracket(
            measure, lambda inner, outer: bool(outer) if self.hit else not inner, ()
        )

    def forward_error(self, judge: Judge) -> float:
        return 0.0 if self.hit == bool(judge.expected) else inf

    def keeps_touch(self, wanted: Numbers) -> bool | None:
        return self.hit

    def meets(self, down: float, up: float) -> bool:
        return self.hit


def _null(t: float | None) -> str:
    return "null" if t is None else repr(t)


T = TypeVar("T", bound=Any)
"""A number of either kind that is compared: a float, or an exact t."""


def first_fault(
    t: T | None,
    inner: Sequence[tuple[T, T]],
    outer: Sequence[tuple[T, T]],
    from_inside: FromInside,
    zero: T,
    last: T,
) -> str | None:
    """Return why t, or None for no hit, cannot be the first hit; None if it can.

    `zero` and `last` are 0 and infinity as numbers of the lists. entry(t) means that t is in O, and
    I is empty or t <= its first enter.

        mode   no hit is right if              t is right if
        zero   I empty                         entry(t)
        miss   I empty or 0 in O               entry(t) and 0 not in I
        exit   I empty or O begins [0, inf)    (entry(t) and 0 not in I), or: 0 in O, t <= the leave
                                               of O's first, no [a, b] of I with a <= t < b
    """
    in_inner = bool(inner) and inner[0][0] <= zero
    in_outer = bool(outer) and outer[0][0] <= zero
    if t is None:
        excused = in_outer and (
            from_inside == "miss" or (from_inside, outer[0][1]) == ("exit", last)
        )
        return "no hit, and the inner list is not empty" if inner and not excused else None
    late = bool(inner) and t > inner[0][0]
    out = not any(a <= t <= b for a, b in outer)
    leaves = in_outer and t <= outer[0][1] and not any(a <= t < b for a, b in inner)
    if from_inside == "exit" and leaves:
        return None
    if from_inside != "zero" and in_inner:
        return f"a hit that is not right for a start inside, with from_inside {from_inside!r}"
    if out:
        return "a hit in no interval of the outer list"
    return "a hit beyond the first enter of the inner list" if late else None
