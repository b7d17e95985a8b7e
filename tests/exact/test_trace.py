"""The oracle's lists against the definitions of the solids, and answers derived by hand."""

from __future__ import annotations

from fractions import Fraction
from math import inf
from random import Random

import pytest
from hypothesis import find, given, settings
from hypothesis import strategies as st

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
    Vector,
)
from raycert.oracle.exact.faces import touch
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, Surd, fraction
from raycert.oracle.exact.trace import trace
from shared.definition import at, inside, member, on_a_surface, samples
from shared.grid import directions, leaves, points, radii, rays, solids


@settings(max_examples=300)
@given(leaves, rays, st.sets(st.fractions(0, 12, max_denominator=12), max_size=12))
def test_a_point_is_in_the_list_where_it_is_in_the_leaf(
    leaf: Solid, ray: Ray, more: set[Fraction]
) -> None:
    intervals = trace(leaf, ray).intervals
    for t in samples(intervals) | more:
        assert member(t, intervals) == inside(leaf, at(ray, t)), t


@settings(max_examples=200)
@given(solids, rays, st.sets(st.fractions(0, 12, max_denominator=10**6), max_size=12))
def test_a_point_off_all_surfaces_is_in_the_list_where_it_is_in_the_tree(
    solid: Solid, ray: Ray, more: set[Fraction]
) -> None:
    """On a surface the closure of a difference decides, not membership."""
    intervals = trace(solid, ray).intervals
    for t in samples(intervals) | more:
        x = at(ray, t)
        if not on_a_surface(solid, ray, t):
            assert member(t, intervals) == inside(solid, x), t


@given(leaves, rays)
def test_a_list_of_a_leaf_is_one_interval_at_most(leaf: Solid, ray: Ray) -> None:
    intervals = trace(leaf, ray).intervals
    assert len(intervals) <= 1
    assert all(a.sign() >= 0 and a <= b and a.finite for a, b in intervals)


@given(solids, rays)
def test_the_rows_are_those_of_the_decisions(solid: Solid, ray: Ray) -> None:
    answer = trace(solid, ray)
    assert len(answer.rows) >= len(answer.decisions) >= 1
    names = [d.row.name for d in answer.decisions]
    assert [r.rpartition(":")[2] for r in answer.rows if r.rpartition(":")[2] in names] == names


def pairs(*ends: tuple[object, object]) -> Intervals:
    return tuple((_end(a), _end(b)) for a, b in ends)


def _end(t: object) -> Surd:
    if isinstance(t, Surd):
        return t
    return INFINITY if t == inf else fraction(*Fraction(str(t)).as_integer_ratio())


CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
TUBE = InfiniteCylinder((0, 0, 0), (0, 0, 2), 1)
SLAB = Slab((0, 0, 0), (0, 0, 2))
FLOOR = HalfSpace((0, 0, 0), (0, 0, 5))
BALL = Sphere((0, 0, 0), 5)
ROOT = Surd(4, -1, 3, 4)  # |(-2 + 2t, 1/2)| = 1 at t = 1 +- sqrt(3)/4
BY_HAND = [
    # Problem 1: the six rows
    (TUBE, (0.5, 0, 9), (0, 0, -1), pairs((0, inf)), "along-inside"),
    (TUBE, (1, 0, 9), (0, 0, 3), pairs((0, inf)), "along-inside"),
    (TUBE, (2, 0, 9), (0, 0, -1), (), "along-outside"),
    (TUBE, (-3, 2, 0), (1, 0, 0), (), "miss"),
    (TUBE, (3, 0, 0), (1, 0, 0), (), "behind"),
    (TUBE, (0.5, 0, 0), (1, 0, 4), pairs((0, "1/2")), "from-inside"),
    (TUBE, (-2, 0.5, 0), (2, 0, 1), pairs((ROOT, Surd(4, 1, 3, 4))), "through"),
    (TUBE, (-3, 1, 0), (1, 0, 0), pairs((3, 3)), "through"),
    (TUBE, (1, 0, 0), (1, 0, 0), pairs((0, 0)), "from-inside"),
    (TUBE, (1, 0, 0), (-1, 0, 0), pairs((0, 2)), "through"),
    (TUBE, (1, 0, 0), (0, 1, 1), pairs((0, 0)), "through"),
    # Problem 2: the seven rows, p at z = 0 and q at z = 2, so n = -z
    (SLAB, (9, 9, 1), (1, 0, 0), pairs((0, inf)), "AE"),
    (SLAB, (9, 9, 2), (1, 0, 0), pairs((0, inf)), "AE"),
    (SLAB, (9, 9, 1), (0, 0, -4), pairs((0, "1/4")), "BE"),
    (SLAB, (9, 9, 0), (0, 0, -4), pairs((0, 0)), "BE"),
    (SLAB, (9, 9, 0), (0, 0, 4), pairs((0, "1/2")), "AF"),
    (SLAB, (0, 0, 3), (1, 0, 0), (), "AH"),
    (SLAB, (0, 0, 3), (0, 0, 1), (), "AH"),
    (SLAB, (0, 0, 3), (0, 0, -1), pairs((1, 3)), "BG"),
    (SLAB, (0, 0, -1), (0, 0, 0), (), "DE"),
    (SLAB, (0, 0, -1), (0, 0, -2), (), "DE"),
    (SLAB, (0, 0, -1), (7, 0, 1), pairs((1, 3)), "CF"),
    # Problem 2 (c): one plane
    (FLOOR, (0, 0, 0), (1, 1, 0), pairs((0, inf)), "A"),
    (FLOOR, (0, 0, -3), (0, 0, 2), pairs((0, "3/2")), "B"),
    (FLOOR, (0, 0, 3), (0, 0, -2), pairs(("3/2", inf)), "C"),
    (FLOOR, (0, 0, 3), (1, 0, 0), (), "D"),
    # Problem 3
    (CAN, (-3, 0, 1), (1, 0, 0), pairs((2, 4)), "m<n"),
    (CAN, (-3, 0, 5), (1, 0, 0), (), "no-2"),
    (CAN, (-3, 2, 1), (1, 0, 0), (), "no-1"),
    (CAN, (-3, 2, 5), (1, 0, 0), (), "neither"),
    (CAN, (-3, 0, 0), (1, 0, 0), pairs((2, 4)), "meet"),
    (CAN, (0, 0, -3), (0, 0, 1), pairs((3, 5)), "a<c"),
    (CAN, (-3, 0, -2), (1, 0, 1), pairs((2, 4)), "a=c"),
    (CAN, (-3, 0, -4), (1, 0, 1), pairs((4, 4)), "m=n"),
    (CAN, (-3, 0, -5), (1, 0, 1), (), "apart"),
    (CAN, (0, 0, 1), (0, 0, 0), pairs((0, inf)), "b=d"),
    # the sphere, with v and y for the barred vectors
    (BALL, (-9, 3, 0), (1, 0, 0), pairs((5, 13)), "through"),
    (BALL, (-9, 3, 4), (1, 0, 0), pairs((9, 9)), "through"),
    (BALL, (3, 4, 0), (0, 0, 0), pairs((0, inf)), "along-inside"),
]


@pytest.mark.parametrize(("solid", "origin", "direction", "truth", "row"), BY_HAND)
def test_answers_derived_by_hand(
    solid: Solid, origin: Vector, direction: Vector, truth: Intervals, row: str
) -> None:
    answer = trace(solid, Ray(origin, direction))
    assert answer.intervals == truth
    assert row in answer.rows


A, B = Slab((0, 0, 0), (2, 0, 0)), Slab((2, 0, 0), (5, 0, 0))
LONG = Slab((0, 0, 0), (5, 0, 0))
POINT = Sphere((2, 0, 0), 0)


@pytest.mark.parametrize(
    ("tree", "truth"),
    [
        (Difference((A, B)), pairs((0, 2))),
        (Difference((LONG, POINT)), pairs((0, 5))),
        (Difference((POINT, LONG)), ()),
        (Difference((A, A)), ()),
        (Union((A, B)), pairs((0, 5))),
        (Intersection((A, B)), pairs((2, 2))),
        (Difference((LONG, Slab((1, 0, 0), (2, 0, 0)), POINT)), pairs((0, 1), (2, 5))),
        (Union((A, Slab((3, 0, 0), (4, 0, 0)))), pairs((0, 2), (3, 4))),
        (Difference((Union((A, B)), A)), pairs((2, 5))),
    ],
)
def test_booleans_of_the_contract(tree: Solid, truth: Intervals) -> None:
    assert trace(tree, Ray((0, 0, 0), (1, 0, 0))).intervals == truth
    back = trace(tree, Ray((9, 0, 0), (-1, 0, 0))).intervals
    assert back == tuple(
        (fraction(9 * b.z - b.x, b.z), fraction(9 * a.z - a.x, a.z)) for a, b in reversed(truth)
    )


def test_rows_of_a_tree_carry_their_path() -> None:
    answer = trace(Union((FLOOR, Difference((CAN, BALL)))), Ray((-9, 0, 1), (1, 0, 0)))
    assert answer.rows == (
        "of[0]:D",
        *(f"of[1].of[0]:{name}" for name in ("through", "AE", "meet", "a>c", "b<d", "m<n")),
        "of[1].of[1]:through",
    )


@pytest.mark.parametrize("kind", ["tangent", "wall", "cap", "rim", "start"])
def test_the_strategies_reach_every_touch(kind: str) -> None:
    """The laws would prove little if rays never touched."""
    cylinders = st.builds(lambda r, h: Cylinder((0, 0, 0), (0, 0, h), r), radii, st.just(2.0))
    rays_ = st.builds(Ray, points, directions)

    def touches(scene: tuple[Solid, Ray]) -> bool:
        lists = trace(*scene).intervals
        return any(touch(i, scene[0], scene[1]) == kind for i in lists)

    scenes = st.tuples(cylinders, rays_)
    find(scenes, touches, settings=settings(max_examples=5000, database=None), random=Random(0))
