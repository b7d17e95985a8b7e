"""Plans: the same bits with and without every item, alone and in every company."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain, combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Slab,
    Solid,
    Sphere,
    Union,
)
from raycert.cases.scene import (
    Camera,
    Scene,
    frame,
    load,
    pixel_ray,
    read_scene,
    shipped,
    write_scene,
)
from raycert.cases.strategies import solids
from raycert.oracle.measure.pictures import crowd, worth
from raycert.reference import tracer
from raycert.reference.arrays import picture
from raycert.reference.arrays import tiles as bounds
from raycert.reference.arrays.plan import ITEMS, Show, plan
from raycert.reference.arrays.tiles import rays, tiles
from raycert.reference.arrays.vectors import Array

SMALL, SIDE = (16, 8), 8
EVERYTHING = frozenset(ITEMS)


def small(name: str) -> Scene:
    return replace(load(name), size=SMALL)


def lists(scene: Scene, off: frozenset[str] = frozenset(), side: int = SIDE) -> bytes:
    found = picture.lists(plan(scene, "lists", off, side=side))
    return found.enter.tobytes() + found.leave.tobytes() + found.count.tobytes()


def values(scene: Scene, show: Show, off: frozenset[str] = frozenset()) -> Array:
    return picture.picture(plan(scene, show, off, side=SIDE), show).values


def subsets(names: list[str]) -> list[frozenset[str]]:
    return [*map(frozenset, chain(*(combinations(names, n) for n in range(len(names) + 1))))]


@pytest.mark.parametrize("name", shipped())
def test_the_bits_of_the_scalar_tracer(name: str) -> None:
    scene = small(name)
    found = picture.lists(plan(scene, "lists", side=SIDE))
    seen, solid = frame(scene.camera), scene.solid
    width, height = scene.size
    for i in range(width * height):
        ray = pixel_ray(seen, scene.size, i % width, i // width)
        assert found.pairs(i) == tracer.intersect(solid, ray), i


@pytest.mark.parametrize("name", shipped())
def test_every_subset_gives_the_same_lists(name: str) -> None:
    scene = small(name)
    names = [item.name for item in plan(scene, "lists", side=SIDE).items if item.applies]
    expected = lists(scene, EVERYTHING)
    assert len(names) >= 3
    for off in subsets(names):
        assert lists(scene, off) == expected, off


@pytest.mark.parametrize("name", shipped())
@pytest.mark.parametrize("show", ["depth", "normal", "thickness", "count"])
def test_every_item_gives_the_same_picture(name: str, show: Show) -> None:
    scene = small(name)
    expected = values(scene, show, EVERYTHING)
    for off in (frozenset[str](), *map(frozenset, combinations(ITEMS, 1))):
        np.testing.assert_array_equal(values(scene, show, off), expected)
    alone = EVERYTHING - {"first"}
    np.testing.assert_array_equal(values(scene, show, alone), expected)


CAMERAS = st.one_of(
    st.builds(
        Camera,
        st.just("perspective"),
        *[st.just(v) for v in ((6.0, -7.0, 3.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))],
        st.sampled_from((40.0, 3.0, 120.0)),
    ),
    st.builds(
        Camera,
        st.just("orthographic"),
        st.sampled_from(((6.0, -7.0, 3.0), (0.0, -9.0, 0.0), (2.0, 1.0, 0.5))),
        st.just((0.0, 0.0, 0.0)),
        st.just((0.0, 0.0, 1.0)),
        st.sampled_from((8.0, 0.5, 100.0)),
    ),
)


@given(st.lists(solids(max_leaves=4), min_size=1, max_size=3), CAMERAS)
@settings(max_examples=25)
def test_drawn_scenes(drawn: list[Solid], camera: Camera) -> None:
    named = tuple((str(i), solid) for i, solid in enumerate(drawn))
    scene = Scene(named, camera, (6, 5))
    expected = lists(scene, EVERYTHING)
    assert lists(scene) == expected
    for name in ITEMS:
        assert lists(scene, frozenset((name,))) == expected, name
        assert lists(scene, EVERYTHING - {name}) == expected, name
    for show in ("depth", "normal"):
        np.testing.assert_array_equal(
            values(scene, show),
            values(scene, show, EVERYTHING),  # type: ignore[arg-type]
        )


def looking(solid: Solid, camera: Camera, size: tuple[int, int] = SMALL) -> Scene:
    return Scene((("solid", solid),), camera, size)


ABOVE = Camera("orthographic", (0.0, -9.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 2.0)
BESIDE = Camera("perspective", (0.0, -9.0, 0.5), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 10.0)


@pytest.mark.parametrize("camera", [ABOVE, BESIDE])
def test_a_long_pipe_is_met_between_its_caps(camera: Camera) -> None:
    scene = looking(Cylinder((0, 0, -9), (0, 0, 9), 0.5), camera)
    made = plan(scene, side=SIDE)
    assert "slab" in made.on
    assert made.between is not None
    assert made.between.all()
    assert lists(scene) == lists(scene, frozenset(("slab",))) == lists(scene, EVERYTHING)


@pytest.mark.parametrize("top", [0.25, 0.999, 1.0])
def test_caps_in_sight_are_not_left_out(top: float) -> None:
    scene = looking(Cylinder((0, 0, -9), (0, 0, top), 0.5), ABOVE)
    between = plan(scene, side=1).between
    assert between is None or not between[: SMALL[0]].any() or top > 0.99
    assert lists(scene) == lists(scene, EVERYTHING)


def test_a_part_that_is_missed_is_left_out() -> None:
    both = Union((Sphere((0, 0, 0), 0.25), Sphere((40, 0, 0), 1), Sphere((0, -30, 0), 1)))
    seen = plan(looking(both, ABOVE), side=SIDE).seen
    assert seen is not None
    assert seen[:, 1].any()
    assert not seen[:, 2:].any()


@pytest.mark.parametrize(
    "solid",
    [
        HalfSpace((0, 0, -40), (0, 0, 1)),
        Slab((0, 0, 40), (1, 1, 41)),
        InfiniteCylinder((40, 0, 0), (41, 1, 0), 1),
    ],
)
def test_what_has_no_bounds_is_not_left_out(solid: Solid) -> None:
    assert "bounds" not in plan(looking(solid, ABOVE), side=SIDE).on


def test_a_box_of_slabs_is_bounded() -> None:
    slabs = Intersection(
        (Slab((9, 0, 0), (10, 0, 0)), Slab((0, 9, 0), (0, 10, 0)), Slab((0, 0, 9), (0, 0, 10)))
    )
    made = plan(looking(slabs, ABOVE), side=SIDE)
    assert made.seen is not None
    assert not made.seen[:, 0].any()


def test_a_bound_that_is_too_tight_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = small("cylinder")
    true = bounds.box

    def shrunk(solid: Solid) -> bounds.Box:
        full = true(solid)
        middle = (full.low + full.high) / 2
        return bounds.Box((full.low + middle) / 2, (full.high + middle) / 2, full.size)

    assert lists(scene, side=2) == lists(scene, EVERYTHING)
    monkeypatch.setattr(bounds, "box", shrunk)
    assert lists(scene, side=2) != lists(scene, EVERYTHING)


def test_caps_left_out_in_sight_are_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = small("cylinder")
    monkeypatch.setattr(bounds, "between_caps", lambda cone, leaf: np.ones(len(cone.origin), bool))
    assert lists(scene) != lists(scene, EVERYTHING)


@pytest.mark.parametrize("name", shipped())
def test_the_rays_are_those_of_the_formula(name: str) -> None:
    scene = small(name)
    seen = frame(scene.camera)
    for tile in tiles(scene.size, 5):
        origin, direction = rays(seen, scene.size, tile)
        for lane, pixel in enumerate(tile.pixels(scene.size[0]).tolist()):
            ray = pixel_ray(seen, scene.size, pixel % SMALL[0], pixel // SMALL[0])
            for vectors, vector in ((origin, ray.origin), (direction, ray.direction)):
                at = [float(c[lane % c.size]) for c in vectors if c is not None]
                assert [x.hex() for x in at] == [x.hex() for x in vector]


def test_large_numbers_keep_their_scales() -> None:
    scene = looking(Sphere((2.0**40, 0, 0), 1), BESIDE)
    assert not {"scaling", "first"} & plan(scene).on
    assert {"scaling", "first"} <= plan(looking(Sphere((0, 0, 0), 1), BESIDE)).on


def test_the_textbook_rests_on_no_promise() -> None:
    made = plan(small("far"), tracer="textbook")
    assert not made.on & {"bounds", "slab", "misses", "first"}
    near = small("cylinder")
    seen = [
        picture.picture(plan(near, tracer=t), "depth").values for t in ("reference", "textbook")
    ]  # type: ignore[arg-type]
    np.testing.assert_allclose(*seen, rtol=1e-12)


def test_the_textbook_loses_a_far_scene() -> None:
    """From 3e7 radii the discriminant is right to some hundredths; its depth is off by as much."""
    far = replace(load("far"), size=(64, 48))
    seen = [picture.picture(plan(far, tracer=t), "depth").values for t in ("reference", "textbook")]  # type: ignore[arg-type]
    assert np.nanmax(abs(seen[0] - seen[1])) > 0.05


def test_worth_is_measured_for_what_applies() -> None:
    scene = replace(load("pipe"), size=(8, 6))
    found, (planned, plain) = worth(scene, "depth", repeats=1)
    assert [w.item.name for w in found] == list(ITEMS)
    for w in found:
        assert (w.with_it > 0) == (w.without > 0) == w.item.applies
        assert w.item.why
    assert planned > 0 < plain


def test_a_crowd_is_a_scene() -> None:
    scene = crowd(20, (8, 6))
    assert read_scene(write_scene(scene)).solid == scene.solid
    assert lists(scene) == lists(scene, EVERYTHING)
