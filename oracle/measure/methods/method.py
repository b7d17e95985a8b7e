"""What a way to answer rays is, and what its answers are.

A method takes all cases at once, so that a batch may be a batch. For each it returns the list of
pairs as doubles, or None where it fails: an exception, NaN, a decision that it cannot take.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import isnan
from typing import NamedTuple

from raycert.cases.model import SOLIDS, Ray, Solid, types


class Case(NamedTuple):
    """A question."""

    solid: Solid
    ray: Ray


Answered = tuple[tuple[float, float], ...] | None
Solve = Callable[[Sequence[Case]], list[Answered]]
ALL = frozenset(SOLIDS)
FAMILIES = (
    "float64",
    "float32",
    "longdouble",
    "double-double",
    "mpmath",
    "interval",
    "symbolic",
    "exact",
    "mesh",
    "client",
)
FAILURES = (ArithmeticError, ValueError, TypeError, RecursionError)
"""What a computation may raise that is a failure to answer, and no fault of ours."""


@dataclass(frozen=True)
class Method:
    """A way to answer; `does` completes "a method that ...".

    `solids` are the types that it answers; a tree counts with all its types. `stress` tells
    whether it is cheap enough for sweeps. `lanes` is the number of rays that one call is priced
    at: a batch has a price per call, which is no property of the rays. `timed` measures the
    seconds of a call where they are not those of `solve`. `needs` are the packages it loads.
    """

    name: str
    does: str
    solve: Solve
    solids: frozenset[str]
    family: str
    stress: bool = True
    lanes: int = 1
    timed: Callable[[Sequence[Case]], float] | None = None
    needs: tuple[str, ...] = ()

    @property
    def batch(self) -> bool:
        """Tell whether it takes many rays in one call, and is priced so."""
        return self.lanes > 1 and self.family != "client"

    def answers(self, solid: Solid) -> bool:
        """Tell whether it answers a solid, with all of its parts."""
        return types(solid) <= self.solids


def answered(pairs: Iterable[tuple[float, float]]) -> Answered:
    """Return pairs as an answer: without -0, and joined where they touch; None for a NaN."""
    found: list[tuple[float, float]] = []
    for a, b in pairs:
        if isnan(a) or isnan(b):
            return None
        if found and a <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], b + 0.0))
        else:
            found.append((a + 0.0, b + 0.0))
    return tuple(found)


def one_by_one(intersect: Callable[[Solid, Ray], Iterable[tuple[float, float]]]) -> Solve:
    """Return the `solve` of a function that answers one case; what it raises is a failure."""

    def solve(cases: Sequence[Case]) -> list[Answered]:
        return [_try(intersect, case) for case in cases]

    return solve


def _try(intersect: Callable[[Solid, Ray], Iterable[tuple[float, float]]], case: Case) -> Answered:
    try:
        return answered(intersect(case.solid, case.ray))
    except FAILURES:
        return None
