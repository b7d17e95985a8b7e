"""Exact zeros, exact ties, and binary32 without rounding twice."""

from __future__ import annotations

from fractions import Fraction
from math import nextafter

import numpy as np
import pytest

from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Slab, Sphere
from raycert.oracle.batch.blocks import trace_batch
from raycert.oracle.batch.booleans import aside, narrowed
from raycert.oracle.batch.lanes import KNOWN
from raycert.oracle.batch.rational import grown, single, vanishes
from shared.batch_rays import lattice, wrong

TINY = 2.0**-52
ORIGIN = (0.0, 0.0, 0.0)


def test_sums_that_do_not_overlap_are_the_same_sums() -> None:
    dice = np.random.default_rng(41)
    terms = list(dice.uniform(-1, 1, (8, 200)) * 2.0 ** dice.integers(-60, 60, (8, 200)))
    parts = grown(terms)
    for i in range(200):
        truth = sum(Fraction(float(x[i])) for x in terms)
        assert sum(Fraction(float(x[i])) for x in parts) == truth


def test_only_what_is_exactly_0_vanishes() -> None:
    dice = np.random.default_rng(42)
    x = dice.uniform(-1, 1, (6, 200))
    terms = [*x, *(-x)]
    assert vanishes(terms).all()
    assert not vanishes([*terms, np.full(200, 2.0**-900)]).any()


def test_a_sum_of_one_double_is_known() -> None:
    value, whole = single([np.array([1.0, 1.0, 0.0]), np.array([2.0**-52, 2.0**-53, 0.0])])
    assert whole.tolist() == [True, False, True]
    assert value[::2].tolist() == [1 + 2.0**-52, 0.0]


TIES = [
    (Sphere((0.75, 0, 0), 0.5), (1 + TINY, 0, 0), (-0.5, 0, 0)),
    (Sphere((3, 4, 0), 5), (-(2.0**53) - 2, 0, 0), (1, 0, 0)),
    (HalfSpace(ORIGIN, (0, 0, 1)), (0, 0, -(2.0**53 + 2) / 3), (1, 0, 2)),
    (HalfSpace((0, 0, 2.0**-53), (0, 0, 3)), (0, 0, 1 + TINY), (5, 1, -1)),
    (Slab((0, 0, 2.0**-53), (0, 0, 1)), (0, 0, 1 + TINY), (5, 1, -1)),
    (InfiniteCylinder((2.0**-53, 0, 0), (2.0**-53, 0, 1), 1), (3 + 2 * TINY, 0, 0), (-1, 0, 3)),
    (Cylinder((0, 0, 2.0**-53), (0, 0, 1), 1), (0.25, 0, 3 + 2 * TINY), (0, 0, -1)),
]


@pytest.mark.parametrize(("solid", "u", "v"), TIES, ids=lambda x: type(x).__name__)
@pytest.mark.parametrize("fmt", [BINARY64, BINARY32], ids=lambda fmt: fmt.name)
def test_ties_are_rounded_to_even_without_the_integers(solid, u, v, fmt) -> None:
    bad, found = wrong(solid, np.array([u], float), np.array([v], float), fmt)
    assert bad == []
    assert found.lanes["integer"] == 0


ZEROS = [
    (Sphere(ORIGIN, 5), (3, 4, 0), (-1, 0, 0)),
    (Sphere(ORIGIN, 5), (3, 4, 0), (1, 0, 0)),
    (Sphere(ORIGIN, 5), (5, -7, 0), (0, 2, 0)),
    (Sphere(ORIGIN, 0), (-1, 0, 0), (3, 0, 0)),
    (Sphere(ORIGIN, 1), (0, 1, 0), (0, 0, 0)),
    (InfiniteCylinder(ORIGIN, (1, 2, 2), 3), (2, 1, -2), (1, 2, 2)),
    (InfiniteCylinder(ORIGIN, (1, 2, 2), 3), (2, 1, -2), (-1, 4, 1)),
    (InfiniteCylinder(ORIGIN, (0, 0, 1), 1), (-4, 1, 3), (1, 0, 5)),
    (Cylinder(ORIGIN, (0, 0, 2), 1), (1, 0, -1), (0, 0, 1)),
    (Slab(ORIGIN, (0, 0, 2)), (0, 0, 2), (1, 0, 0)),
    (Slab(ORIGIN, (0, 0, 2)), (0, 0, 2), (1, 0, 1)),
    (HalfSpace(ORIGIN, (1, 2, 2)), (2, -1, 0), (0, 1, -1)),
]


@pytest.mark.parametrize(("solid", "u", "v"), ZEROS, ids=lambda x: type(x).__name__)
@pytest.mark.parametrize("fmt", [BINARY64, BINARY32], ids=lambda fmt: fmt.name)
def test_touches_walls_and_starts_on_a_face_are_decided_without_the_integers(
    solid, u, v, fmt
) -> None:
    bad, found = wrong(solid, np.array([u], float), np.array([v], float), fmt)
    assert bad == []
    assert found.lanes["rational"] == 1


def test_on_a_lattice_the_integers_have_next_to_nothing_to_do() -> None:
    dice, lanes, left = np.random.default_rng(43), 0, 0
    for _ in range(10):
        leaves, u, v = lattice(dice, 300)
        for leaf in leaves:
            found = trace_batch(leaf, u, v, engine="numpy").lanes
            lanes, left = lanes + 300, left + found["integer"]
    assert left <= 0.01 * lanes


MIDDLE = 1 + 2.0**-24


def test_a_double_that_is_a_midpoint_of_binary32_goes_where_the_endpoint_is() -> None:
    value = np.array([MIDDLE] * 4 + [nextafter(MIDDLE, 2), 0.0, np.inf, 3.5e38])
    side = np.array([1.0, -1.0, 0.0, KNOWN, 0.0, 0.0, 0.0, 0.0])
    with np.errstate(over="ignore"):
        moved, clear = aside(value, side)
        single_ = moved.astype(np.float32).tolist()
    up = 1 + 2.0**-23
    assert single_[:7] == [up, 1.0, 1.0, 1.0, up, 0.0, np.inf]
    assert clear.tolist() == [True, True, False, True, True, True, True, False]


def test_pairs_that_touch_in_binary32_are_joined() -> None:
    lane = np.array([0, 0, 0, 1])
    enter, leave = np.array([1.0, 2 + 1e-9, 4, 2]), np.array([2.0, 3, 5, 3])
    found = narrowed(lane, enter, leave)
    assert [x.tolist() for x in found] == [[0, 0, 1], [1, 4, 2], [3, 5, 3]]
