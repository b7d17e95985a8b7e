"""Condition numbers, checked by solving again with moved inputs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields, replace
from fractions import Fraction
from math import inf, nextafter
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

import raycert.oracle.exact.condition
from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
)
from raycert.oracle.exact.condition import ceil_log2, condition, kappa
from raycert.oracle.exact.faces import place
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, fraction
from raycert.oracle.exact.trace import trace

Scene = tuple[Solid, Ray]
Draw = Callable[[], float]
TINY = 2.0**-40
FACES = [
    ("half_space", "plane"),
    ("sphere", "side"),
    ("infinite_cylinder", "side"),
    ("slab", "cap_p"),
    ("slab", "cap_q"),
    ("cylinder", "side"),
    ("cylinder", "cap_p"),
    ("cylinder", "cap_q"),
]
on_each_face = pytest.mark.parametrize(("kind", "face"), FACES)


def coarse(dice: Random) -> float:
    """Return a number of 12 bits, so that 1 + 2^-40 times it is a number too."""
    return dice.randint(-(2**11), 2**11) / 2**10


def fine(dice: Random) -> float:
    return dice.uniform(-2, 2)


def make(kind: str, draw: Draw) -> Solid:
    def point() -> tuple[float, float, float]:
        return (draw(), draw(), draw())

    match kind:
        case "half_space":
            return HalfSpace(point(), point())
        case "sphere":
            return Sphere(point(), abs(draw()))
        case "slab":
            return Slab(point(), point())
        case "infinite_cylinder":
            return InfiniteCylinder(point(), point(), abs(draw()))
    return Cylinder(point(), point(), abs(draw()))


def scenes(kind: str, face: str, number: Callable[[Random], float]) -> Iterator[tuple[Scene, int]]:
    """Yield scenes with an endpoint on this face alone, t > 0: (scene, which endpoint)."""
    dice = Random(f"{kind} {face}")

    def draw() -> float:
        return number(dice)

    while True:
        solid = make(kind, draw)
        scene = (solid, Ray((draw(), draw(), draw()), (draw(), draw(), draw())))
        for i, t in enumerate(ends(scene)):
            if place(t, *scene).faces == (face,) and kappa(t, *scene) < fraction(5000, 1):
                yield scene, i


def ends(scene: Scene) -> list[Surd]:
    return [t for interval in trace(*scene).intervals for t in interval]


def value(t: Surd) -> mpf:
    with mp.workprec(600):
        return (t.x + t.y * mp.sqrt(t.d)) / t.z


def slots(scene: Scene) -> list[tuple[int, str, int | None]]:
    """Return where each number stands: (solid or ray, field, component)."""
    found: list[tuple[int, str, int | None]] = []
    for which, part in enumerate(scene):
        for field in fields(part):
            held = getattr(part, field.name)
            places = range(3) if isinstance(held, tuple) else (None,)
            found += [(which, field.name, i) for i in places]
    return found


def moved(scene: Scene, slot: tuple[int, str, int | None], move: Callable[[float], float]) -> Scene:
    """Return the scene with one number moved."""
    which, name, i = slot
    part = scene[which]
    held = getattr(part, name)
    new = move(held) if i is None else (*held[:i], move(held[i]), *held[i + 1 :])
    changed = replace(part, **{name: new})
    return (changed, scene[1]) if which == 0 else (scene[0], changed)  # type: ignore[return-value]


def step(scene: Scene, which: int, slot: tuple[int, str, int | None]) -> mpf:
    """Return (t' - t) / (2^-40 t) for one input times 1 + 2^-40."""
    with mp.workprec(600):
        t = value(ends(scene)[which])
        again = value(ends(moved(scene, slot, lambda x: x * (1 + TINY)))[which])
        return (again - t) / (t * mpf(TINY))


def error(scene: Scene, which: int) -> float:
    """Return how far kappa is, relatively, from the sum of the steps."""
    with mp.workprec(600):
        measured = sum(abs(step(scene, which, slot)) for slot in slots(scene))
        return float(abs(value(kappa(ends(scene)[which], *scene)) / measured - 1))


def some(
    kind: str, face: str, count: int, number: Callable[[Random], float] = coarse
) -> list[tuple[Scene, int]]:
    return [found for found, _ in zip(scenes(kind, face, number), range(count), strict=False)]


@on_each_face
def test_kappa_is_the_sum_of_the_relative_derivatives(kind: str, face: str) -> None:
    for scene, which in some(kind, face, 12):
        assert error(scene, which) < 1e-6


@on_each_face
def test_one_ulp_in_every_input_moves_t_by_kappa_at_most(kind: str, face: str) -> None:
    """An ulp is between 2^-53 and 2^-52 of a number; the signs are the worst ones."""
    for scene, which in some(kind, face, 6, fine):
        t, near = ends(scene)[which], scene
        for slot in slots(scene):
            # at this size a step of 2^-40 is inexact, but its sign is right
            near = moved(near, slot, outward if step(scene, which, slot) > 0 else inward)
        with mp.workprec(600):
            shift = abs(value(ends(near)[which]) / value(t) - 1)
            bound = value(kappa(t, *scene))
            assert shift <= bound * mpf(2) ** -52 * (1 + mpf(10) ** -6)
            assert shift >= bound * mpf(2) ** -53 * (1 - mpf(10) ** -3)


def outward(x: float) -> float:
    return nextafter(x, inf if x > 0 else -inf)


def inward(x: float) -> float:
    return nextafter(x, 0)


@on_each_face
def test_a_dropped_term_is_noticed(kind: str, face: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Drop the last term of the leaf's own: the radius, or a component of p or of the point."""
    whole = raycert.oracle.exact.condition.At.kappa

    def short(self: object, gradient: object, others: Iterator[object]) -> Surd:
        return whole(self, gradient, iter(list(others)[:-1]))  # type: ignore[arg-type]

    monkeypatch.setattr(raycert.oracle.exact.condition.At, "kappa", short)
    assert max(error(scene, which) for scene, which in some(kind, face, 4)) > 1e-3


@on_each_face
def test_a_dropped_direction_is_noticed(
    kind: str, face: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = raycert.oracle.exact.condition.At.ray_terms

    def short(self: object, gradient: object) -> Iterator[object]:
        return iter(list(whole(self, gradient))[::2])  # type: ignore[arg-type]

    monkeypatch.setattr(raycert.oracle.exact.condition.At, "ray_terms", short)
    assert max(error(scene, which) for scene, which in some(kind, face, 4)) > 1e-3


@pytest.mark.parametrize(
    ("solid", "origin", "direction"),
    [
        (InfiniteCylinder((0, 0, 0), (0, 0, 1), 1), (-3, 1, 0), (1, 0, 0)),
        (Cylinder((0, 0, 0), (0, 0, 2), 1), (-3, 1, 1), (1, 0, 0)),
        (Sphere((0, 0, 0), 5), (-9, 3, 4), (1, 0, 0)),
        (Sphere((0, 0, 0), 0), (-9, 0, 0), (1, 0, 0)),
    ],
)
def test_a_double_root_has_no_condition(solid: Solid, origin: object, direction: object) -> None:
    ray = Ray(origin, direction)  # type: ignore[arg-type]
    intervals = trace(solid, ray).intervals
    assert len(intervals) == 1
    assert kappa(intervals[0][0], solid, ray) == INFINITY
    assert condition(intervals, solid, ray) is None


def test_ends_that_no_input_moves() -> None:
    """t = 0 inside, infinity, and an empty list have no condition; t = 0 on a face is infinite."""
    can = Cylinder((0, 0, 0), (0, 0, 2), 1)
    for origin, direction in (((0, 0, 1), (0, 0, 0)), ((9, 9, 9), (1, 0, 0))):
        ray = Ray(origin, direction)
        assert condition(trace(can, ray).intervals, can, ray) is None
    inside = Ray((0, 0, 1), (1, 0, 0))
    assert kappa(ZERO, can, inside) == ZERO
    assert kappa(INFINITY, can, inside) == ZERO
    assert condition(trace(can, inside).intervals, can, inside) == 1
    start = Ray((-1, 0, 1), (1, 0, 0))
    assert kappa(ZERO, can, start) == INFINITY


def test_a_plane_by_hand() -> None:
    """t = (z - h) / v with h = 1, z = 3, v = -1: |dt/t| is 3/2 + 1/2 + 1."""
    solid, ray = HalfSpace((0, 0, 1), (0, 0, 2)), Ray((0, 0, 3), (0, 0, -1))
    t = trace(solid, ray).intervals[0][0]
    assert kappa(t, solid, ray) == fraction(3, 1)
    assert condition(trace(solid, ray).intervals, solid, ray) == 2


def test_the_worst_face_counts() -> None:
    """On a rim, and where two leaves meet, the larger condition number is the point's."""
    can, ray = Cylinder((0, 0, 1), (0, 0, 3), 1), Ray((-3, 0, 0), (2, 0, 1))
    t = fraction(1, 1)
    assert place(t, can, ray).faces == ("side", "cap_p")
    tube, slab = InfiniteCylinder(can.p, can.q, 1), Slab(can.p, can.q)
    both = Intersection((tube, slab))
    assert kappa(t, can, ray) == max(kappa(t, tube, ray), kappa(t, slab, ray))
    assert kappa(t, both, ray) == kappa(t, can, ray)


@given(st.integers(1, 2**80), st.integers(0, 2**80), st.integers(0, 99), st.integers(1, 2**80))
def test_ceil_log2_is_the_least_power_above(x: int, y: int, d: int, z: int) -> None:
    v = Surd(x, y, d, z)
    n = ceil_log2(v)
    power = Fraction(2) ** n
    assert v <= fraction(*power.as_integer_ratio())
    assert v > fraction(*(power / 2).as_integer_ratio())
