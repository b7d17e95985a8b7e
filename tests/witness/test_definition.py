"""The witness by definition: lists known by hand, closure at every node, rationals in every gap."""

from __future__ import annotations

from fractions import Fraction

import pytest

from raycert.cases.draw import fresh
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
)
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, Surd, fraction
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness.algebra import closed, combine, gaps, runs, span
from raycert.oracle.witness.definition import between, solve, witness

ALONG = Ray((0, 0, 0), (0, 0, 1))
FROM_LEFT = Ray((-3, 0, 1), (1, 0, 0))
CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)


def from_to(low: float, high: float) -> Solid:
    """Return a solid that the ray ALONG meets in [low, high]; a point where they are equal."""
    if low == high:
        return Sphere((0, 0, low), 0)
    return Slab((0, 0, low), (0, 0, high))


def lists(*pairs: tuple[float, float | None]) -> Intervals:
    """Return the exact list with these ends; None is infinity."""
    return tuple((number(a), INFINITY if b is None else number(b)) for a, b in pairs)


def number(x: float) -> Surd:
    return fraction(*Fraction(x).as_integer_ratio())


LEAVES = [
    (CAN, FROM_LEFT, lists((2, 4))),
    (CAN, Ray((-3, 1, 1), (1, 0, 0)), lists((3, 3))),
    (CAN, Ray((-3, 0, 2), (1, 0, 0)), lists((2, 4))),
    (CAN, Ray((-3, 1, 2), (1, 0, 0)), lists((3, 3))),
    (CAN, Ray((1, 0, 1), (1, 0, 0)), lists((0, 0))),
    (CAN, Ray((1, 0, 1), (0, 0, -1)), lists((0, 1))),
    (CAN, Ray((2, 0, 1), (1, 0, 0)), ()),
    (CAN, Ray((0, 0, 1), (0, 0, 0)), lists((0, None))),
    (CAN, Ray((0, 0, 3), (0, 0, 0)), ()),
    (InfiniteCylinder((0, 0, 0), (0, 0, 2), 1), ALONG, lists((0, None))),
    (InfiniteCylinder((0, 0, 0), (0, 0, 2), 0), FROM_LEFT, lists((3, 3))),
    (Slab((0, 0, 0), (0, 0, 2)), Ray((0, 0, 3), (0, 0, -2)), lists((0.5, 1.5))),
    (HalfSpace((0, 0, 2), (0, 0, 7)), ALONG, lists((0, 2))),
    (HalfSpace((0, 0, 2), (0, 0, -7)), ALONG, lists((2, None))),
    (Sphere((0, 0, 0), 1), FROM_LEFT, lists((3, 3))),
]


@pytest.mark.parametrize(("solid", "ray", "truth"), LEAVES)
def test_leaf_by_hand(solid: Solid, ray: Ray, truth: Intervals) -> None:
    assert solve(solid, ray) == truth


A, B, C = from_to(0, 2), from_to(2, 5), from_to(0, 5)
TREES = [
    (Union((A, B)), lists((0, 5))),
    (Intersection((A, B)), lists((2, 2))),
    (Difference((A, B)), lists((0, 2))),
    (Difference((C, from_to(2, 2))), lists((0, 5))),
    (Difference((from_to(2, 2), C)), ()),
    (Difference((A, A)), ()),
    (Difference((C, from_to(1, 2))), lists((0, 1), (2, 5))),
    (Difference((C, from_to(1, 2), from_to(2, 3))), lists((0, 1), (3, 5))),
    (Difference((C,)), lists((0, 5))),
    # Every node is closed: the point that the inner difference loses comes back at once.
    (Intersection((Difference((C, B)), B)), lists((2, 2))),
    (Difference((C, Difference((C, B)))), lists((2, 5))),
    (Difference((B, Difference((C, B)))), lists((2, 5))),
    # What lies at t < 0 is cut off at the leaf: the slab is the point 0, and nothing remains of it.
    (Difference((from_to(-1, 0), A)), ()),
    (Difference((A, from_to(-1, 0))), lists((0, 2))),
]


@pytest.mark.parametrize(("solid", "truth"), TREES)
def test_tree_by_hand(solid: Solid, truth: Intervals) -> None:
    assert solve(solid, ALONG) == truth


def test_agrees_with_the_oracle_on_a_sample() -> None:
    for case in fresh(600, 11):
        verdict = witness(case.solid, case.ray, trace(case.solid, case.ray).intervals)
        assert verdict.outcome == "agreed", (case, verdict)


def test_disagrees_with_another_number_of_intervals() -> None:
    verdict = witness(CAN, FROM_LEFT, ())
    assert verdict.outcome == "disagreed"
    assert verdict.why == "1 intervals, and the answer has 0"


@pytest.mark.parametrize(
    ("low", "high"),
    [
        (fraction(0, 1), fraction(1, 2**300)),
        (Surd(0, 1, 2, 1), Surd(1, 1, 2 * 4**200, 2**200)),
        (Surd(3, -1, 2, 1), Surd(0, 1, 3, 1)),
        (Surd(0, 1, 4, 1), INFINITY),
    ],
)
def test_a_rational_lies_between(low: Surd, high: Surd) -> None:
    middle = between(low, high)
    assert middle.rational() is not None
    assert low < middle < high


def test_runs_of_a_set_that_is_not_closed_are_refused() -> None:
    with pytest.raises(ArithmeticError, match="not closed"):
        runs(gaps(3), "abc")
    with pytest.raises(ArithmeticError, match="not closed"):
        runs(2, "a")
    assert runs(closed(gaps(3), 3), "abc") == [("a", None)]
    assert runs(0, "abc") == []


def test_cells_of_a_span() -> None:
    assert span(1, 2, 4) == 0b11100
    assert span(1, None, 3) == 0b111100
    assert combine(CAN, lambda _: 5, 3) == 5
