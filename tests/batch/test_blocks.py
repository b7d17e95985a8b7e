"""The batch oracle gives the scalar oracle's rounded lists, lane for lane, and says how."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from raycert.cases.formats import BINARY32, BINARY64, FORMATS, Format
from raycert.cases.model import Cylinder, Ray, Refused, Solid, Sphere
from raycert.cases.strategies import scenes
from raycert.oracle.batch.blocks import trace_batch
from shared.batch_rays import FAMILIES, aligned, beside_ties, far, free, lattice, thin, wrong
from shared.corpus import golden


@pytest.mark.parametrize("fmt", [BINARY64, BINARY32], ids=lambda fmt: fmt.name)
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_every_lane_is_the_scalar_oracle_s(family, fmt: Format) -> None:
    dice = np.random.default_rng(5)
    for _ in range(2):
        leaves, u, v = family(dice, 120)
        for leaf in leaves:
            assert wrong(leaf, u, v, fmt)[0] == [], leaf


@pytest.mark.parametrize("precision", FORMATS)
def test_golden_rows_come_out_as_expected(precision: str) -> None:
    """Those of every eighth solid: each costs a plan of its own."""
    grouped: dict[Solid, list] = {}
    for row in golden(precision).rows:
        grouped.setdefault(row.solid, []).append(row)
    for solid, rows in list(grouped.items())[::8]:
        u, v = [row.ray.origin for row in rows], [row.ray.direction for row in rows]
        found = trace_batch(solid, u, v, FORMATS[precision], "numpy")
        for i, row in enumerate(rows):
            assert found.pairs(i) == row.expected, row.id


@settings(max_examples=100)
@given(scenes())
def test_scenes_of_the_strategies(scene: tuple[Solid, Ray]) -> None:
    solid, ray = scene
    for fmt in (BINARY64, BINARY32):
        assert wrong(solid, np.array([ray.origin]), np.array([ray.direction]), fmt)[0] == []


@pytest.mark.parametrize(
    ("family", "most"), [(free, 0.0), (far, 0.0), (thin, 0.0), (aligned, 0.01)]
)
def test_few_lanes_reach_the_integers(family, most: float) -> None:
    dice = np.random.default_rng(2)
    lanes = open_ = 0
    for _ in range(5):
        leaves, u, v = family(dice, 400)
        for leaf in leaves:
            rungs = trace_batch(leaf, u, v, engine="numpy").lanes
            lanes, open_ = lanes + sum(rungs.values()), open_ + rungs["integer"]
    assert open_ <= most * lanes, f"{open_} of {lanes}"


def test_counts_of_the_rungs_add_up() -> None:
    leaves, u, v = lattice(np.random.default_rng(1), 300)
    for leaf in leaves:
        found = trace_batch(leaf, u, v, engine="numpy")
        assert sum(found.lanes.values()) == sum(found.leaves.values()) == 300
        assert found.leaves == found.lanes, "of one leaf, leaves and lanes are the same"
        assert found.rungs == {"leaves": found.leaves, "lanes": found.lanes}


def test_blocks_do_not_matter() -> None:
    leaves, u, v = aligned(np.random.default_rng(3), 300)
    one = trace_batch(leaves[4], u, v, engine="numpy")
    two = trace_batch(leaves[4], u, v, engine="numpy", block=7)
    assert (one.enter == two.enter).all()
    assert (one.leave == two.leave).all()
    assert (one.offsets == two.offsets).all()
    assert one.rungs == two.rungs


@pytest.mark.parametrize("flat", [False, True])
def test_rays_beside_ties_are_right(flat: bool) -> None:
    dice = np.random.default_rng(4)
    scenes = [beside_ties(dice, flat) for _ in range(300)]
    assert all(wrong(*scene)[0] == [] for scene in scenes)


def test_the_result_as_arrays() -> None:
    solid = Sphere((0, 0, 0), 1)
    u, v = [(-3, 0, 0), (-3, 5, 0), (0, 0, 0)], [(1, 0, 0), (1, 0, 0), (0, 0, 0)]
    found = trace_batch(solid, u, v, engine="numpy")
    assert found.counts.tolist() == [1, 0, 1]
    assert [found.pairs(i) for i in range(3)] == [((2, 4),), (), ((0, math.inf),)]
    enter, leave = found.padded()
    assert enter[:, 0].tolist()[::2] == [2, 0]
    assert leave[:, 0].tolist()[::2] == [4, math.inf]
    assert np.isnan(enter[1, 0])
    assert found.padded(3)[0].shape == (3, 3)


def test_no_rays() -> None:
    found = trace_batch(Sphere((0, 0, 0), 1), np.zeros((0, 3)), np.zeros((0, 3)), engine="numpy")
    assert found.counts.tolist() == []
    assert sum(found.lanes.values()) == 0


@pytest.mark.parametrize(
    ("u", "v", "path"),
    [
        ([[0, 0, math.nan]], [[1, 0, 0]], "origins"),
        ([[0, 0, 0]], [[1, 0, math.inf]], "directions"),
        ([[0, 0]], [[1, 0, 0]], "origins"),
        ([[0, 0, 0]], [[1, 0, 0]] * 2, "directions"),
    ],
)
def test_what_is_no_ray_is_refused(u: list, v: list, path: str) -> None:
    with pytest.raises(Refused) as refusal:
        trace_batch(Cylinder((0, 0, 0), (0, 0, 1), 1), u, v)
    assert refusal.value.path == path
