"""The error bounds hold against exact arithmetic, and are not so wide that they could not fail."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest

from raycert.cases.model import InfiniteCylinder, Slab, Sphere
from raycert.oracle.batch import decide, formulas
from raycert.oracle.batch.arithmetic import heads, minus, offset, size
from raycert.oracle.batch.constants import WALL, LeafPlan, plan
from raycert.oracle.batch.formulas import (
    UU,
    U,
    ball,
    cross_bound,
    cross_plain,
    divisor,
    gap_ball,
    gap_wall,
    plane,
    plane_plain,
    wall,
)
from raycert.oracle.batch.lanes import Lanes
from shared.batch_rays import aligned, beside_ties, far, free, grazing, tilted, wrong

Vector = tuple[Fraction, Fraction, Fraction]


def exact(x) -> Fraction:
    """Return a double, or a pair, as a fraction."""
    return Fraction(float(x[0])) + Fraction(float(x[1])) if isinstance(x, tuple) else Fraction(x)


def dot(a: Vector, b: Vector) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def lane(arrays, i: int) -> Vector:
    """Return a vector of arrays, or of pairs of them, at lane i."""
    parts = [exact((a[0][i], a[1][i])) if isinstance(a, tuple) else exact(a[i]) for a in arrays]
    return (parts[0], parts[1], parts[2])


def truths(leaf: LeafPlan, lanes: Lanes, i: int) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """Return A, B, C and G of a lane exactly."""
    start, way, points = lanes.ray(leaf, leaf.keep)
    y, v = lane(offset(start, points[0]), i), lane(way, i)
    a, g, r2 = v, y, Fraction(leaf.radius) ** 2
    gap = r2 * dot(v, v) - dot(cross(y, v), cross(y, v))
    if leaf.kind == WALL:
        w = tuple(map(exact, leaf.w))
        a, g = cross(v, w), cross(y, w)
        gap = r2 * dot(a, a) - dot(y, a) ** 2
        r2 *= dot(w, w)
    return dot(a, a), dot(a, g), dot(g, g) - r2, gap


def curved_shares(leaf: LeafPlan, lanes: Lanes) -> list[list[float]]:
    """Return the error in units of its bound: of A, B, C, G in pairs, and of G in doubles."""
    u, v, points = lanes.ray(leaf, leaf.keep)
    y, plain = offset(u, points[0]), minus(u, points[0])
    if leaf.kind == WALL:
        terms = wall(y, v, leaf.w, leaf.size, leaf.rr, leaf.cap)
        a, ea = cross_plain(v, heads(leaf.w)), cross_bound(U, size(v), leaf.size)
        gap, bound = gap_wall(plain, size(plain), a, size(a), ea, leaf.rr[0])
    else:
        terms = ball(y, v, leaf.rr)
        gap, bound = gap_ball(plain, size(plain), v, size(v), leaf.rr[0])
    shares = []
    for i in range(len(gap)):
        truth = truths(leaf, lanes, i)
        found = [(exact((x[0][i], x[1][i])), exact(e[i])) for x, e in terms]
        found.append((exact(gap[i]), exact(bound[i])))
        both = zip(found, (*truth, truth[3]), strict=True)
        shares.append([float(abs(x - t) / e) if e else float(x != t) for (x, e), t in both])
    return shares


@pytest.mark.parametrize("family", [free, far, tilted, grazing, aligned])
def test_the_forms_of_curved_faces_are_within_their_bounds(family) -> None:
    dice = np.random.default_rng(7)
    shares = []
    for _ in range(2):
        leaves, u, v = family(dice, 60)
        for leaf in leaves:
            if isinstance(leaf, Sphere | InfiniteCylinder):
                prepared = plan(leaf)
                lanes = Lanes.of(prepared, np.concatenate([u.T, v.T]))
                assert lanes.in_range.all()
                shares += curved_shares(prepared, lanes)
    worst = np.max(shares, axis=0)
    assert (worst <= 1).all(), worst
    if family is free:
        assert (worst > 2.0**-14).all(), "a bound so wide would be no bound"


@pytest.mark.parametrize("family", [free, far, aligned])
def test_the_forms_of_planes_are_within_their_bounds(family) -> None:
    leaves, u, v = family(np.random.default_rng(8), 100)
    leaf = plan(next(leaf for leaf in leaves if isinstance(leaf, Slab)))
    lanes = Lanes.of(leaf, np.concatenate([u.T, v.T]))
    start, way, (_, q) = lanes.ray(leaf)
    y, w = offset(start, q), tuple(map(exact, leaf.w))
    pairs = plane(y, way, leaf.w, leaf.size)
    c, ec, b, eb = plane_plain(minus(start, q), way, heads(leaf.w), leaf.size)
    for i in range(len(c)):
        truth = dot(lane(y, i), w), dot(lane(way, i), w)
        for (x, e), (s, es), t in zip(pairs, ((c, ec), (b, eb)), truth, strict=True):
            assert abs(exact((x[0][i], x[1][i])) - t) <= exact(e[i])
            assert abs(exact(s[i]) - t) <= exact(es[i])


def test_the_root_of_the_discriminant_is_within_its_bound() -> None:
    leaves, u, v = free(np.random.default_rng(9), 100)
    leaf = plan(leaves[3])
    lanes = Lanes.of(leaf, np.concatenate([u.T, v.T]))
    start, way, points = lanes.ray(leaf)
    gap = wall(offset(start, points[0]), way, leaf.w, leaf.size, leaf.rr, leaf.cap)[3]
    with np.errstate(all="ignore"):
        root, bound = divisor(gap, leaf.root_w)
    w = tuple(map(exact, leaf.w))
    sure = np.nonzero(gap[0][0] > gap[1])[0]
    assert len(sure) > 10
    for i in sure:
        d = truths(leaf, lanes, i)[3] * dot(w, w)
        truth = Fraction(isqrt(int(d * 2**600)), 2**300)
        assert abs(exact((root[0][i], root[1][i])) - truth) <= exact(bound[i]) + Fraction(1, 2**290)


def faults_beside_ties(flat: bool) -> int:
    dice = np.random.default_rng(4)
    return sum(len(wrong(*beside_ties(dice, flat))[0]) for _ in range(300))


@pytest.mark.parametrize("flat", [False, True])
def test_lower_bounds_in_double_double_are_found_out(flat, monkeypatch) -> None:
    assert faults_beside_ties(flat) == 0
    monkeypatch.setattr(formulas, "UU", UU * 2.0**-20)
    assert faults_beside_ties(flat) > 0


def faults_of_grazing() -> int:
    """Count wrong lanes of rays that miss or touch a face by a rounding of its radius."""
    dice, faults = np.random.default_rng(6), 0
    for _ in range(60):
        p, q, u, v = dice.uniform(-4, 4, (4, 3))
        n = np.cross(v, q - p)
        axial = float(abs(np.dot(u - p, n)) / np.linalg.norm(n))
        central = float(np.linalg.norm(np.cross(u - p, v)) / np.linalg.norm(v))
        a, b = tuple(p.tolist()), tuple(q.tolist())
        for solid in (InfiniteCylinder(a, b, axial), Sphere(a, central)):
            faults += len(wrong(solid, u[None], v[None])[0])
    return faults


def test_lower_bounds_in_float64_are_found_out(monkeypatch) -> None:
    assert faults_of_grazing() == 0
    for module in (formulas, decide):
        monkeypatch.setattr(module, "U", U * 2.0**-20)
    assert faults_of_grazing() > 0
