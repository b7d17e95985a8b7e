"""The batched tracer gives the bits of the scalar one: golden rows, random rays, drawn scenes."""

from __future__ import annotations

import doctest
import random
from collections import defaultdict
from importlib import import_module
from math import inf, ldexp

import numpy as np
import pytest
from hypothesis import given, settings
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
from raycert.cases.strategies import ensembles, scenes
from raycert.reference import tracer
from raycert.reference.arrays.tracer import BLOCK, PLAIN, QUICK, Switches, intersect, joined
from raycert.reference.intervals import Pairs
from shared.corpus import golden

WAYS = [PLAIN, QUICK, Switches(axis=True), Switches(shared=True), Switches(misses=True)]
WAYS += [Switches(lists=False), Switches(caps=False)]


def bits(pairs: Pairs) -> list[tuple[str, str]]:
    return [(float(a).hex(), float(b).hex()) for a, b in pairs]


def batched(solid: Solid, rays: list[Ray], switches: Switches = QUICK) -> list[Pairs]:
    origins = np.array([ray.origin for ray in rays])
    directions = np.array([ray.direction for ray in rays])
    answer = intersect(solid, origins, directions, switches)
    return [answer.pairs(i) for i in range(len(rays))]


def assert_same(solid: Solid, rays: list[Ray], switches: Switches = QUICK) -> None:
    for ray, pairs in zip(rays, batched(solid, rays, switches), strict=True):
        assert bits(pairs) == bits(tracer.intersect(solid, ray)), (solid, ray)


@pytest.mark.parametrize("precision", ["binary64", "binary32"])
@pytest.mark.parametrize("switches", [PLAIN, QUICK], ids=["plain", "quick"])
def test_golden_rows(precision: str, switches: Switches) -> None:
    """Those of every third solid."""
    rays = defaultdict(list)
    for row in golden(precision).rows:
        rays[row.solid].append(row.ray)
    assert sum(map(len, rays.values())) > 5000
    for solid, those in list(rays.items())[::3]:
        assert_same(solid, those, switches)


@pytest.mark.parametrize("switches", WAYS, ids=range(len(WAYS)))
@given(ensembles(3))
@settings(max_examples=30)
def test_drawn_solids(switches: Switches, drawn: tuple[tuple[Solid, ...], Ray]) -> None:
    solids, ray = drawn
    for solid in solids:
        assert_same(solid, [ray], switches)


@given(scenes(max_leaves=5), st.sampled_from(WAYS))
def test_drawn_trees(scene: tuple[Solid, Ray], switches: Switches) -> None:
    solid, ray = scene
    back = Ray(ray.origin, tuple(-x for x in ray.direction))  # type: ignore[arg-type]
    still = Ray(ray.origin, (0, 0, 0))
    assert_same(solid, [ray, back, still, ray], switches)


BALL, ROD = Sphere((0.1, 0, 0), 1), Cylinder((0, 0, -1), (0.2, 0.1, 1), 0.7)
SOLIDS: list[Solid] = [
    BALL,
    ROD,
    InfiniteCylinder((0, 0, 0), (1, 2, 3), 0.5),
    Slab((0, 0, 0), (0.1, 0.2, 0.3)),
    HalfSpace((0, 0, 0), (1, 1, 0)),
    Union((BALL, ROD, Sphere((1.5, 0, 0), 0.5))),
    Intersection((BALL, ROD, Slab((0, 0, -0.5), (0, 0, 0.5)))),
    Difference((BALL, ROD, Sphere((0.5, 0.5, 0), 0.6))),
    Difference((Union((BALL, Sphere((3, 0, 0), 1))), Union((ROD, Sphere((3, 0, 0), 0.5))))),
]


def some_rays(n: int, seed: int = 1) -> list[Ray]:
    dice = random.Random(seed)

    def vector(reach: float) -> Vector:
        return (dice.gauss(0, reach), dice.gauss(0, reach), dice.gauss(0, reach))

    return [Ray(vector(2), vector(1)) for _ in range(n)]


@pytest.mark.parametrize("solid", SOLIDS, ids=lambda solid: type(solid).__name__)
@pytest.mark.parametrize("switches", [PLAIN, QUICK], ids=["plain", "quick"])
def test_random_rays(solid: Solid, switches: Switches) -> None:
    assert_same(solid, some_rays(2000), switches)


def test_lengths_and_times_that_overflow() -> None:
    far, slow = ldexp(1.0, 1023), ldexp(1.0, -1000)
    drum = Cylinder((0, 0, -far), (0, 0, far), far)
    assert_same(drum, [Ray((-far, 0, far), (far, 0, 0)), Ray((0, 0, 0), (1, 0, 0))])
    assert_same(Sphere((far, 0, 0), far), [Ray((-far, 0, 0), (far, 0, 0))])
    endless = Sphere((2.0**100, 0, 0), 1), [Ray((0, 0, 0), (slow, 0, 0))]
    assert_same(*endless)
    assert batched(*endless) == [[(inf, inf)]]


def test_more_rays_than_a_block_and_none() -> None:
    rays = [Ray((-3, 0, 0), (1, 0, 0)), Ray((-3, 5, 0), (1, 0, 0))] * BLOCK
    found = batched(Sphere((0, 0, 0), 1), rays)
    assert found == [[(2, 4)], []] * BLOCK
    assert intersect(BALL, np.empty((0, 3)), np.empty((0, 3))).count.size == 0
    assert joined([]).lanes == 0


def test_a_planted_fault_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A norm that is only nearly right changes some bits of these rays."""
    from raycert.reference.arrays import quadratic
    from raycert.reference.arrays.vectors import rough

    monkeypatch.setattr(quadratic, "norm", rough)
    with pytest.raises(AssertionError):
        assert_same(BALL, some_rays(2000))


def test_scales_left_out_where_they_are_needed_are_noticed() -> None:
    huge = Sphere((2.0**600, 0, 0), 2.0**599), [Ray((0, 0, 0), (2.0**590, 1, 0))]
    assert_same(*huge)
    with pytest.raises(AssertionError):
        assert_same(*huge, Switches(scaling=False))


def test_the_example_in_the_docstring() -> None:
    result = doctest.testmod(import_module("raycert.reference.arrays.tracer"))
    assert result.attempted
    assert not result.failed
