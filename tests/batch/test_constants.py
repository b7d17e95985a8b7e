"""A plan holds its leaf exactly, scaled, or says why no lane of it is fast."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest

from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Slab, Sphere
from raycert.oracle.batch.blocks import trace_batch
from raycert.oracle.batch.constants import BALL, PLANES, WALL, plan
from shared.batch_rays import FAMILIES, wrong

ORIGIN, X = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
TILTED = (1.0, 2.0, 2.0)


@pytest.mark.parametrize(
    ("leaf", "kind", "planes"),
    [
        (HalfSpace(ORIGIN, TILTED), PLANES, 1),
        (Slab(ORIGIN, TILTED), PLANES, 2),
        (Sphere(ORIGIN, 1), BALL, 0),
        (InfiniteCylinder(ORIGIN, X, 1), BALL, 0),
        (InfiniteCylinder(ORIGIN, TILTED, 1), WALL, 0),
        (Cylinder(ORIGIN, X, 1), BALL, 2),
        (Cylinder(ORIGIN, TILTED, 1), WALL, 2),
    ],
    ids=lambda x: type(x).__name__,
)
def test_kinds_of_lanes(leaf, kind: int, planes: int) -> None:
    assert (plan(leaf).kind, plan(leaf).planes, plan(leaf).reason) == (kind, planes, "")


def test_a_cylinder_along_an_axis_does_not_look_along_it() -> None:
    assert plan(Cylinder(ORIGIN, X, 1)).keep == (False, True, True)
    assert plan(Cylinder(ORIGIN, TILTED, 1)).keep == (True, True, True)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_the_constants_are_those_of_the_leaf(family) -> None:
    dice = np.random.default_rng(21)
    for leaf in family(dice, 1)[0]:
        prepared = plan(leaf)
        if prepared.reason or isinstance(leaf, HalfSpace | Slab | Sphere):
            continue
        unit = Fraction(prepared.stretch)
        assert [Fraction(x) for x in prepared.points[0]] == [Fraction(x) * unit for x in leaf.p]
        assert Fraction(prepared.radius) == Fraction(leaf.radius) * unit
        raw = [Fraction(b) - Fraction(a) for a, b in zip(leaf.p, leaf.q, strict=True)]
        w = [Fraction(h) + Fraction(low) for h, low in prepared.w]
        scales = {b / a for a, b in zip(raw, w, strict=True) if a}
        assert len(scales) == 1
        assert scales.pop().numerator.bit_count() == 1
        assert 0.5 <= prepared.size <= 2
        square = sum(x * x for x in w) if prepared.kind == WALL else 1
        cap, r2 = sum(map(Fraction, prepared.cap)), Fraction(prepared.radius) ** 2
        assert abs(cap - r2 * square) <= cap * Fraction(1, 2**106)
        root = Fraction(isqrt(int(square * 4**300)), 2**300)
        assert abs(sum(map(Fraction, prepared.root_w)) - root) <= root * Fraction(1, 2**105)


@pytest.mark.parametrize(
    ("leaf", "reason"),
    [
        (Sphere((0, 0, 1e35), 1e-5), "p is out of range beside the radius"),
        (InfiniteCylinder(ORIGIN, (1, 1e-60, 0), 1), "the axis has parts of too different sizes"),
        (InfiniteCylinder(ORIGIN, (1e-200, 1e-200, 0), 1), "q is out of range beside the radius"),
        (Slab((0, 0, -1.5e308), (1, 0, 1.5e308)), "the axis has parts of too different sizes"),
    ],
    ids=["far", "bent", "short", "huge"],
)
def test_what_is_out_of_range_goes_to_the_integers(leaf, reason: str) -> None:
    u, v = np.array([[0.5, 0.25, -3.0]]), np.array([[0.0, 0.0, 1.0]])
    found = trace_batch(leaf, u, v, engine="numpy")
    assert found.reason == reason
    assert found.lanes["integer"] == 1
    assert wrong(leaf, u, v)[0] == []
