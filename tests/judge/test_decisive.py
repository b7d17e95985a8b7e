"""Decisive rows: where no gross answer hides in the move of k = 64."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64, FORMATS, Format
from raycert.cases.levels import LEVELS
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Union,
)
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.levels import Judge, decisive
from shared.grid import leaves, rays, solids

ALL = LEVELS
FINER = ("faithful", "exact")
both = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)


def levels(solid: Solid, ray: Ray, fmt: Format = BINARY64) -> tuple[str, ...]:
    return decisive(Judge(solid, ray, fmt))


def can(height: float = 2, radius: float = 1) -> Cylinder:
    return Cylinder((0, 0, 0), (0, 0, height), radius)


@both
@pytest.mark.parametrize(
    ("origin", "direction"),
    [
        ((-3, 0, 1), (1, 0, 0)),
        ((0, 0, -3), (0, 0, 1)),
        ((-3, 0.25, -1), (2, 0, 1)),
        ((0, 0, 1), (1, 0, 0)),
        ((-3, 0, 1), (-1, 0, 0)),
        ((-3, 2, 1), (1, 0, 0)),
        ((0, 0, 1), (0, 0, 0)),
    ],
)
def test_near_rows_are_decisive_on_every_level(
    origin: tuple[float, float, float], direction: tuple[float, float, float], fmt: Format
) -> None:
    assert levels(can(), Ray(origin, direction), fmt) == ALL


@both
@pytest.mark.parametrize("direction", [(1, 0, 0), (1, 0, 1)])
def test_tangent_and_rim_rows_are_decisive(
    direction: tuple[float, float, float], fmt: Format
) -> None:
    """A touch may be kept or dropped, but anything longer than what c allows is seen."""
    for y in (1, 1 - 2.0**-20, 1 + 2.0**-20):
        assert levels(can(), Ray((-3, y, 1), direction), fmt) == ALL
    assert levels(can(), Ray((-3, 0, -4), (1, 0, 1)), fmt) == ALL


def far(power: int, y: float = 0.0) -> Ray:
    return Ray((-(2.0**power), y, 1), (1, 0, 0))


@both
def test_a_far_hit_through_the_axis_stops_being_decisive_where_the_move_exceeds_the_radius(
    fmt: Format,
) -> None:
    """At distance L, s is 3 L and 2 L from N(u), N(u - p) and 2 N(v) t: the move is 64 u 4 L.

    Strict: inner is lost where 256 u L > r. That is first so at L = 2^(precision - 8), where the
    size of p and r, added to 4 L, exceeds r exactly.
    """
    limit = fmt.precision - 8
    assert levels(can(), far(limit - 1), fmt)[-3:] == ("stable", *FINER)
    assert levels(can(), far(limit), fmt) == FINER
    assert levels(can(), far(limit + 30), fmt) == FINER


@both
def test_the_squared_measure_stops_far_earlier(fmt: Format) -> None:
    """Squared: inner is lost where (r - 64 u s)^2 < 16 u s^2, s = 4 L: about L > 2^(p/2) / 16."""
    granted = [levels(can(), far(n), fmt) for n in range(1, fmt.precision + 4)]
    first_without = next(n for n, got in enumerate(granted, 1) if "sound" not in got)
    assert abs(first_without - (fmt.precision / 2 - 4)) <= 1
    assert all("sound" not in got for got in granted[first_without - 1 :])
    assert all(got == ALL for got in granted[: first_without - 1])


@both
def test_a_far_miss_stops_being_decisive_when_the_move_reaches_it(fmt: Format) -> None:
    """Two radii beside the axis: the move outward by more than r/8 adds a hit c does not."""
    granted = ["stable" in levels(can(), far(n, 2), fmt) for n in range(1, fmt.precision)]
    last = len(granted) - granted[::-1].index(True)
    assert granted == sorted(granted, reverse=True)
    assert abs(last - (fmt.precision - 9)) <= 1


@both
def test_a_needle_through_the_axis_stops_too(fmt: Format) -> None:
    """Height 2^n, radius 1, seen from near: q alone is far, and the size of q moves the wall."""

    def needle(n: int) -> tuple[str, ...]:
        return levels(can(2.0**n), Ray((-3, 0, 1), (1, 0, 0)), fmt)

    assert needle(fmt.precision // 2 - 8) == ALL
    assert needle(fmt.precision - 4) == FINER


def test_a_far_disk_seen_along_its_axis_counts_its_thickness() -> None:
    """Thickness 2^-20: the caps' own c is 2^-23, whatever the radius."""
    disk = can(2.0**-20, 8)
    near, away = Ray((0, 0, -1), (0, 0, 1)), Ray((0, 0, -(2.0**30)), (0, 0, 1))
    assert levels(disk, near) == ALL
    assert levels(disk, away) == FINER


@given(solids, rays, st.sampled_from([BINARY64, BINARY32]))
@settings(deadline=None)
def test_every_row_decides_what_compares_numbers(solid: Solid, ray: Ray, fmt: Format) -> None:
    found = levels(solid, ray, fmt)
    assert found[-2:] == FINER
    assert set(found) <= set(LEVELS)
    assert list(found) == [level for level in LEVELS if level in found]


def is_parallel_miss(leaf: Solid, ray: Ray) -> bool:
    """Tell whether the ray runs beside an infinite leaf at one distance for ever."""
    answer = trace(leaf, ray)
    signs = dict(answer.decisions[0].signs)
    parallel = 0 in (signs.get("vv"), signs.get("vn")) and any(ray.direction)
    return not answer.intervals and parallel and isinstance(leaf, InfiniteCylinder | Slab)


@settings(deadline=None)
@given(leaves, rays)
def test_on_a_small_grid_every_row_but_a_parallel_miss_is_decisive(leaf: Solid, ray: Ray) -> None:
    """A move of 2^-45 hides nothing in a scene of size 1, unless c is 0: a radius of 0."""
    if getattr(leaf, "radius", 1) > 0 and not isinstance(leaf, HalfSpace):
        assert levels(leaf, ray) == ALL or is_parallel_miss(leaf, ray)


@pytest.mark.parametrize(
    ("near", "away", "direction"),
    [
        (InfiniteCylinder((0, 0, 0), (0, 0, 2), 1), (3, 0, 0), (0, 0, 1)),
        (Slab((0, 0, 0), (0, 0, 2)), (0, 0, 3), (1, 0, 0)),
    ],
)
def test_beside_an_infinite_leaf_the_move_arrives_in_the_end(
    near: Solid, away: tuple[float, float, float], direction: tuple[float, float, float]
) -> None:
    """s(t) grows without bound: some t far out is in outer, and c adds no hit unless it is near."""
    assert levels(near, Ray(away, direction)) == FINER
    close = (1.0625, 0.0, 2.125)
    assert levels(near, Ray(close, direction)) == ALL
    assert levels(can(), Ray(away, direction)) == ALL


def test_a_point_is_decisive_for_nothing_it_could_lose() -> None:
    """Radius 0: c = 0. Its own list survives the move by c, and is lost to any k."""
    ray = Ray((-3, 0, 1), (1, 0, 0))
    assert levels(can(2, 0), ray) == FINER
    assert levels(can(2, 0), Ray((-3, 2, 1), (1, 0, 0))) == ALL


def test_half_spaces_stay_where_they_are() -> None:
    """Seen from 2^60 away their move is greater than the can; the can's own is what decides."""
    plane = HalfSpace((0, 0, 1), (0, 0, 1))
    ray = Ray((0, 0, 2.0**60), (1, 0, 0))
    assert levels(plane, ray) == ALL
    assert levels(plane, Ray((0, 0, 1), (1, 0, 0))) == ALL


def test_parts_of_a_tree_decide_with_their_own_c() -> None:
    ray = Ray((0, 0, -3), (0, 0, 1))
    thick, thin = Slab((0, 0, 0), (0, 0, 1)), Slab((0, 0, 2), (0, 0, 2 + 2.0**-50))
    assert levels(Union((thick,)), ray) == ALL
    assert levels(Union((thick, thin)), ray) == FINER
    assert levels(Difference((thick, thin)), ray) == ALL
    cut = Slab((0, 0, 0.5), (0, 0, 0.5 + 2.0**-50))
    assert levels(Difference((thick, cut)), ray) == FINER
    assert levels(Intersection((thick, cut)), ray) == FINER


def test_two_slabs_closer_than_the_move_may_join() -> None:
    """Gap 2^-30, c = 1/8: c joins them as well, so the row stays decisive; a gap of 1/2 stays."""
    ray = Ray((0, 0, -3), (0, 0, 1))
    for gap in (2.0**-30, 2.0**-60, 0.5):
        pair = Union((Slab((0, 0, 0), (0, 0, 1)), Slab((0, 0, 1 + gap), (0, 0, 2 + gap))))
        assert levels(pair, ray) == ALL
    far_ray = Ray((0, 0, -(2.0**46)), (0, 0, 1))
    apart = Union((Slab((0, 0, 0), (0, 0, 1)), Slab((0, 0, 1.5), (0, 0, 2.5))))
    assert "stable" not in levels(apart, far_ray)
