"""Decisive rows: where no gross answer hides in the move of k = 64."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.domain import Tolerance
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
    Sphere,
    Union,
)
from raycert.oracle.exact.surd import INFINITY
from raycert.oracle.judge.decisive import decisive
from raycert.oracle.judge.levels import LIMIT, Judge
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


@settings(deadline=None)
@given(leaves, rays)
def test_on_a_small_grid_every_row_is_decisive(leaf: Solid, ray: Ray) -> None:
    """A move of 2^-45 hides nothing in a scene of size 1, unless c is 0: a radius of 0."""
    if getattr(leaf, "radius", 1) > 0 and not isinstance(leaf, HalfSpace):
        assert levels(leaf, ray) == ALL


TUBE, LAYER = InfiniteCylinder((0, 0, 0), (0, 0, 2), 1), Slab((0, 0, 0), (0, 0, 2))
PARALLEL: dict[str, tuple[Solid, Callable[[float], Ray]]] = {
    "tube": (TUBE, lambda far: Ray((1 + far, 0, 0), (0, 0, 1))),
    "slab": (LAYER, lambda far: Ray((0, 0, 2 + far), (4, 0, 0))),
    "line": (InfiniteCylinder((0, 0, 0), (0, 0, 2), 0), lambda far: Ray((0, far, 1), (0, 0, -1))),
    "union": (Union((TUBE, can())), lambda far: Ray((1 + far, 0, 3), (0, 0, 1))),
    "behind": (Union((TUBE, can())), lambda far: Ray((1 + far, 0, -9), (0, 0, 1))),
}


@both
@pytest.mark.parametrize("power", [-2, 0, 1, 9, 21, 30, 60, 100])
@pytest.mark.parametrize("name", PARALLEL)
def test_a_parallel_miss_decides_however_far_beside(name: str, power: int, fmt: Format) -> None:
    """What outer adds begins where the move has grown by c, beyond 2^(precision - 10) radii."""
    solid, beside = PARALLEL[name]
    judge = Judge(solid, beside(2.0**power), fmt)
    assert judge.exact == ()
    assert decisive(judge) == ALL
    for level, reach in (("sound", fmt.precision // 2 - 6), ("stable", fmt.precision - 12)):
        for t in (0.0, 1.0, 2.0**reach):
            assert judge.accept(level).fault([(t, inf)]), "a gross answer hides"


def test_inside_what_is_taken_away_a_parallel_miss_decides_too() -> None:
    """The move inward makes the bore vanish in the end: outer adds what is left around it."""
    bored = Difference((HalfSpace((0, 0, 1), (-1, 0, 0)), TUBE))
    judge = Judge(bored, Ray((0.5, 0, 3), (0, 0, 1)))
    assert judge.exact == ()
    assert judge.moved(LIMIT, "strict", 1) != ()
    assert decisive(judge) == ALL


@both
def test_a_ray_as_good_as_parallel_decides_and_a_far_miss_does_not(fmt: Format) -> None:
    """Tilted by one unit in the last place, the ray leaves more slowly than the move grows.

    The far miss is met where it is, and left again: its interval has an end.
    """
    tilted = Ray((3, 0, 0), (2.0 ** (1 - fmt.precision), 0, 1))
    assert levels(TUBE, tilted, fmt) == ALL
    assert Judge(TUBE, tilted, fmt).moved(LIMIT, "strict", 1)[-1][1] == INFINITY
    for power in (fmt.precision - 7, fmt.precision, 100):
        assert levels(TUBE, far(power, 3), fmt) == FINER


def test_a_parallel_miss_is_lost_where_the_numbers_are_coarser_than_the_gap() -> None:
    """At 2^50, the move at the start is 24: it reaches a tube 3 radii beside at once."""
    place = 2.0**50
    there = InfiniteCylinder((place, 0, 0), (place, 0, 2), 1)
    assert levels(there, Ray((place + 4, 0, 0), (0, 0, 1))) == FINER
    assert "stable" in levels(there, Ray((place + 64, 0, 0), (0, 0, 1)))


FLOOR = HalfSpace((0, 0, 0), (0, 0, 1))
DOT = Sphere((0, 0, 0), 0)
OUT, ALONG, IN = (1, 0, 2), (1, 2, 0), (0, 1, -2)


@both
@pytest.mark.parametrize(
    ("solid", "direction", "wanted"),
    [
        (FLOOR, OUT, FINER),
        (FLOOR, ALONG, FINER),
        (FLOOR, (0, 0, 0), FINER),
        (FLOOR, IN, ALL),
        (DOT, OUT, FINER),
        (Intersection((FLOOR, Sphere((0, 0, 0), 2))), OUT, FINER),
        (Union((FLOOR, Sphere((0, 0, 9), 2))), OUT, FINER),
        (Union((FLOOR, Sphere((0, 0, 1), 2))), OUT, ALL),
        (Difference((Sphere((0, 0, 1), 2), FLOOR)), OUT, ALL),
    ],
)
def test_a_touch_where_nothing_moves_is_a_convention(
    solid: Solid, direction: tuple[float, float, float], wanted: tuple[str, ...], fmt: Format
) -> None:
    """Start and leaf lie in the origin: s(0) = 0, and to drop the touch is no gross answer."""
    assert levels(solid, Ray((0, 0, 0), direction), fmt) == wanted


@both
def test_a_touch_where_something_moves_is_no_convention(fmt: Format) -> None:
    """At (0, 0, 1) the plane moves; and a tolerance moves it in the origin too."""
    ray = Ray((0, 0, 1), OUT)
    assert levels(HalfSpace((0, 0, 1), (0, 0, 1)), ray, fmt) == ALL
    tolerant = Judge(FLOOR, Ray((0, 0, 0), OUT), fmt, tolerance=Tolerance(2.0**-9))
    assert decisive(tolerant) == ALL


def test_a_tolerance_beyond_c_decides_nothing_that_moves() -> None:
    ray = Ray((-3, 0, 1), (1, 0, 0))
    assert decisive(Judge(can(), ray, tolerance=Tolerance(0.125))) == ALL
    assert decisive(Judge(can(), ray, tolerance=Tolerance(0.126))) == FINER


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
