"""Answers compared as answers: whether two are one but for roundings, and of what kind one is.

A fault of the zoo answers with interval lists. What it would answer to a client's question, be that
for a first hit or for a yes, follows from the list as it would from the client's own.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isinf, isnan, ldexp
from typing import Literal, get_args

from raycert.cases.accept import Numbers
from raycert.cases.formats import Format
from raycert.cases.levels import Level, upto
from raycert.cases.protocol import first
from raycert.oracle.certify.grading import Grade
from raycert.oracle.judge.answer import Claim, First, Listed, YesNo

SLACK = 12
"""Bits of an endpoint that may differ: roundings of another formula. Faults differ in far more."""
CLOSER = 16
"""How many times nearer than to the right one an answer is to one that it is said to be."""
Kind = Literal["none", "nan", "miss", "zero", "endless", "numbers", "place"]
"""What kind of answer one is: all but `numbers` are given by many faults alike. `place` is one that
nothing is known of but that the row fails."""
KINDS: tuple[Kind, ...] = get_args(Kind)


@dataclass(frozen=True, slots=True)
class Manner:
    """How a client answers, as one of its claims shows."""

    like: Claim

    def claim(self, pairs: Numbers | None) -> Claim | None:
        """Return the claim of a client whose interval list is this one; None if it has none."""
        match self.like:
            case _ if pairs is None:
                return None
            case First(_, from_inside):
                return First(first(pairs, from_inside), from_inside)
            case YesNo():
                return YesNo(bool(pairs))
        return Listed(pairs)


def numbers(said: Claim) -> Numbers:
    """Return a claim as pairs: a first hit is a point, and yes is always."""
    match said:
        case Listed(pairs):
            return pairs
        case First(t):
            return () if t is None else ((t, t),)
    return ((0.0, inf),) if said == YesNo(True) else ()


def kind(said: Claim | None) -> Kind:
    if said is None:
        return "none"
    pairs = numbers(said)
    if not pairs:
        return "miss"
    if any(isnan(x) for pair in pairs for x in pair):
        return "nan"
    if all(x == 0 for pair in pairs for x in pair):
        return "zero"
    return "endless" if pairs == ((0.0, inf),) else "numbers"


def fails(said: Claim | None, grade: Grade, level: Level) -> bool:
    """Whether the row of a grade would fail a level with this answer."""
    if said is None or said.malformed(grade.judge) is not None:
        return True
    levels = [low for low in upto(level) if low in grade.decides]
    return any(said.fault(grade.accept(low)) for low in levels)


def close(one: Numbers, other: Numbers, fmt: Format) -> bool:
    """Whether two lists differ by some roundings of their largest number.

    NaN is NaN wherever it stands, and a list is only close to one as long.
    """
    ends, others = [x for pair in one for x in pair], [x for pair in other for x in pair]
    if any(map(isnan, ends)) or any(map(isnan, others)):
        return any(map(isnan, ends)) and any(map(isnan, others))
    if len(ends) != len(others):
        return False
    size = max((abs(x) for x in (*ends, *others) if not isinf(x)), default=0.0)
    return apart(one, other) <= ldexp(size, SLACK - fmt.precision)


def apart(one: Numbers, other: Numbers) -> float:
    """Return how far two lists are apart: the most that an end differs; infinite if one is longer.

    >>> apart(((1.0, inf),), ((1.5, inf),))
    0.5
    """
    if len(one) != len(other):
        return inf
    ends = ((x, y) for pair in zip(one, other, strict=True) for x, y in zip(*pair, strict=True))
    return max((abs(x - y) for x, y in ends if x != y), default=0.0)


def agrees(grade: Grade, said: Claim | None) -> bool:
    """Whether a graded answer is this one but for roundings, which account for no error in it.

    No answer agrees with none. What errs by less than SLACK has to be nearer to this answer than to
    the right one.
    """
    if grade.said is None or said is None:
        return grade.said is said
    mine, other = numbers(grade.said), numbers(said)
    if not close(mine, other, grade.judge.format):
        return False
    right = numbers(Manner(grade.said).claim(grade.row.expected) or grade.said)
    return kind(said) == "nan" or CLOSER * apart(mine, other) <= apart(mine, right)
