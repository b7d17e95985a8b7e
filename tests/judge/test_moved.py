"""The moved lists against their definition, evaluated in fractions that share no code with them."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import isqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.domain import Tolerance
from raycert.cases.formats import BINARY32, BINARY64, Format
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
from raycert.cases.model import leaves as leaves_of
from raycert.cases.vectors import norm_up
from raycert.oracle.exact.grid import dyadics
from raycert.oracle.exact.intervals import Intervals, contains
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.levels import LIMIT
from raycert.oracle.judge.moved import LAST_STEP, REFINE, Movable, Shift, Step, moved_leaf
from shared.definition import at, dot, exact, inside, member, minus, on_a_surface, samples
from shared.grid import leaves, rays, solids

formats = st.sampled_from([BINARY64, BINARY32])
measures = st.sampled_from(["strict", "squared"])
sigmas = st.sampled_from([1, -1])
steps = st.one_of(st.sampled_from([0, 8, 10, LIMIT]), st.integers(0, LAST_STEP))
floats = st.floats(-(2.0**40), 2.0**40, allow_nan=False)


def big_norm(x: tuple[Fraction, ...]) -> Fraction:
    """Return N(x) as the contract defines it."""
    square = sum((c * c for c in x), Fraction(0))
    if not square:
        return Fraction(0)
    top, bottom = square.as_integer_ratio()
    e = (top.bit_length() - bottom.bit_length()) // 2 - 64
    floor = square / Fraction(4) ** e
    return (isqrt(floor.numerator // floor.denominator) + 1) * Fraction(2) ** e


def size(leaf: Solid, ray: Ray, t: Fraction) -> Fraction:
    """Return s(t) as the contract's table has it."""
    u, v = exact(ray.origin), exact(ray.direction)
    match leaf:
        case HalfSpace(point, _):
            o = exact(point)
            s0 = big_norm(u) + big_norm(o) + big_norm(minus(u, o))
            return s0 + 2 * big_norm(v) * t
        case Sphere(center, radius):
            return big_norm(u) + big_norm(exact(center)) + Fraction(radius) + big_norm(v) * t
    p, q = exact(leaf.p), exact(leaf.q)
    radius = Fraction(0 if isinstance(leaf, Slab) else leaf.radius)
    s0 = big_norm(u) + big_norm(p) + big_norm(q) + radius + big_norm(minus(u, p))
    return s0 + 2 * big_norm(v) * t


def under_root(a: Fraction, b: Fraction, square: Fraction) -> bool:
    """Tell whether a <= b sqrt(square), by signs and squares."""
    if a <= 0 <= b:
        return True
    if b < 0 <= a:
        return a == 0 == square
    return (a * a <= b * b * square) if a > 0 else (a * a >= b * b * square)


NONE = Fraction(0)


def within(
    leaf: Solid, ray: Ray, t: Fraction, delta: Fraction, slack: Fraction, part: Fraction = NONE
) -> bool:
    """Tell whether f(t) is in a leaf whose faces moved outward by delta (inward if negative).

    They move by a part of the leaf's own size besides: of its radius, or of its thickness.
    """
    x = at(ray, t)
    match leaf:
        case HalfSpace(point, normal):
            n = exact(normal)
            return under_root(dot(minus(x, exact(point)), n), delta, dot(n, n))
        case Sphere(center, radius):
            m, moved = minus(x, exact(center)), Fraction(radius) * (1 + part) + delta
            return moved >= 0 and dot(m, m) <= moved * moved + slack
        case Slab(p, q):
            w = minus(exact(q), exact(p))
            by = delta + part * big_norm(w)
            return all(
                under_root(dot(minus(x, exact(end)), n), by, dot(w, w))
                for end, n in ((p, minus(exact(p), exact(q))), (q, w))
            )
        case InfiniteCylinder(p, q, radius):
            w, y = minus(exact(q), exact(p)), minus(x, exact(p))
            moved = Fraction(radius) * (1 + part) + delta
            distance = dot(y, y) - dot(y, w) ** 2 / dot(w, w)
            return moved >= 0 and distance <= moved * moved + slack
    assert isinstance(leaf, Cylinder)
    tube = InfiniteCylinder(leaf.p, leaf.q, leaf.radius)
    slab = Slab(leaf.p, leaf.q)
    return all(within(part_of, ray, t, delta, slack, part) for part_of in (tube, slab))


def truth(
    leaf: Solid, ray: Ray, t: Fraction, ku: Fraction, measure: str, sigma: int, tolerance: Tolerance
) -> bool:
    """Tell whether t is in the moved list, by the contract's table of measures."""
    s = size(leaf, ray, t)
    slack = ku * s * s / 4 if measure == "squared" else Fraction(0)
    by, part = Fraction(tolerance.absolute), Fraction(tolerance.relative)
    return within(leaf, ray, t, sigma * (ku * s + by), sigma * slack, sigma * part)


def unit(fmt: Format) -> Fraction:
    return Fraction(1, 2**53 if fmt is BINARY64 else 2**24)


@settings(max_examples=200)
@given(
    leaves,
    rays,
    steps,
    formats,
    measures,
    sigmas,
    st.sampled_from([Tolerance(), Tolerance(0.125), Tolerance(0.0, 0.3), Tolerance(1.0, 2.0**-40)]),
    st.sets(st.fractions(0, 12, max_denominator=12), max_size=6),
)
def test_a_moved_leaf_is_what_its_definition_says(
    leaf: Solid,
    ray: Ray,
    step: int,
    fmt: Format,
    measure: str,
    sigma: int,
    tolerance: Tolerance,
    more: set[Fraction],
) -> None:
    k = Step.at(step)
    moved = Movable(leaf, ray, fmt, tolerance).by_k(k, measure, sigma)  # type: ignore[arg-type]
    ku = Fraction(float(k)) * unit(fmt)
    for t in samples(moved) | samples(trace(leaf, ray).intervals) | more:
        found = truth(leaf, ray, t, ku, measure, sigma, tolerance)
        assert member(t, moved) == found, t


@settings(max_examples=120)
@given(solids, rays, st.integers(40, 104), measures, sigmas)
def test_a_moved_tree_is_what_its_moved_leaves_say(
    solid: Solid, ray: Ray, step: int, measure: str, sigma: int
) -> None:
    """Away from the ends of the moved leaves. These k move faces by 2^-40 to 2^-8 and more."""
    k = Step.at(step)
    ku = Fraction(float(k)) * unit(BINARY64)
    scene = Movable(solid, ray, BINARY64)
    moved = scene.by_k(k, measure, sigma)  # type: ignore[arg-type]

    def member_of(part: Solid, t: Fraction, way: int) -> bool:
        match part:
            case Union(of):
                return any(member_of(x, t, way) for x in of)
            case Intersection(of):
                return all(member_of(x, t, way) for x in of)
            case Difference(of):
                first = member_of(of[0], t, way)
                return first and not any(member_of(x, t, -way) for x in of[1:])
        return truth(part, ray, t, ku, measure, way, Tolerance())

    ends = [
        e
        for _, leaf in leaves_of(solid)
        for way in (1, -1)
        for i in moved_leaf(leaf, scene.shift(leaf, k, measure), way, scene.grid)  # type: ignore[arg-type]
        for e in i
        if e.finite
    ]
    marks = samples(tuple((e, e) for e in ends)) | {Fraction(n, 7) for n in range(40)}
    for t in marks:
        if not any(e.x * t.denominator == t.numerator * e.z and not e.y for e in ends):
            assert member(t, moved) == member_of(solid, t, sigma), t


@settings(max_examples=120)
@given(solids, rays, steps, steps, formats, measures)
def test_lists_are_monotone_in_k(
    solid: Solid, ray: Ray, one: int, two: int, fmt: Format, measure: str
) -> None:
    """The inner list shrinks, the outer one grows, and the exact one lies between."""
    scene = Movable(solid, ray, fmt)
    low, high = (Step.at(i) for i in sorted((one, two)))
    lists: list[Intervals] = [
        scene.by_k(high, measure, -1),  # type: ignore[arg-type]
        scene.by_k(low, measure, -1),  # type: ignore[arg-type]
        trace(solid, ray).intervals,
        scene.by_k(low, measure, 1),  # type: ignore[arg-type]
        scene.by_k(high, measure, 1),  # type: ignore[arg-type]
    ]
    for inner, outer in pairwise(lists):
        assert contains(outer, inner)


@given(solids, rays, steps, formats)
def test_the_squared_measure_allows_more(solid: Solid, ray: Ray, step: int, fmt: Format) -> None:
    scene, k = Movable(solid, ray, fmt), Step.at(step)
    assert contains(scene.by_k(k, "squared", 1), scene.by_k(k, "strict", 1))
    assert contains(scene.by_k(k, "strict", -1), scene.by_k(k, "squared", -1))


@given(leaves, rays, sigmas)
def test_moved_by_zero_is_the_exact_list(leaf: Solid, ray: Ray, sigma: int) -> None:
    grid = Movable(leaf, ray, BINARY64).grid
    assert moved_leaf(leaf, Shift(0), sigma, grid) == trace(leaf, ray).intervals  # type: ignore[arg-type]


@given(leaves, rays, sigmas)
def test_the_constant_move_is_an_eighth_of_the_leaf(leaf: Solid, ray: Ray, sigma: int) -> None:
    moved = Movable(leaf, ray, BINARY64).by_constant(sigma)
    thickness: list[Fraction] = []
    if not isinstance(leaf, HalfSpace | Slab):
        thickness.append(Fraction(leaf.radius))
    if isinstance(leaf, Slab | Cylinder):
        thickness.append(big_norm(minus(exact(leaf.q), exact(leaf.p))))
    c = min(thickness, default=Fraction(0)) / 8
    for t in samples(moved):
        assert member(t, moved) == within(leaf, ray, t, sigma * c, Fraction(0))


@given(st.tuples(floats, floats, floats))
def test_norm_is_the_norm_of_the_contract(x: Vector) -> None:
    bits, integers = dyadics(x, REFINE)
    a, b, c = (integers[number] for number in x)
    assert Fraction(norm_up((a, b, c)), 2**bits) == big_norm(exact(x))


@given(st.tuples(floats, floats, floats))
def test_norm_is_rounded_up_by_2_to_the_minus_63_at_most(x: Vector) -> None:
    n, square = big_norm(exact(x)), dot(exact(x), exact(x))
    assert (n * n > square) or n == square == 0
    assert (n * (1 - Fraction(1, 2**62))) ** 2 <= square


def test_the_steps_of_k() -> None:
    values = [float(Step.at(i)) for i in range(LAST_STEP + 1)]
    assert values[:6] == [1 / 16, 3 / 32, 1 / 8, 3 / 16, 1 / 4, 3 / 8]
    assert values == sorted(set(values))
    assert (float(Step.at(8)), float(Step.at(LIMIT)), values[-1]) == (1, 64, 2.0**55)


CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)


def test_a_needle_vanishes_inward_and_a_miss_is_hit_outward() -> None:
    needle = Cylinder((0, 0, 0), (0, 0, 2.0**60), 1)
    ray = Ray((-(2.0**10), 0, 2.0**59), (1, 0, 0))
    assert trace(needle, ray).intervals
    assert Movable(needle, ray, BINARY64).by_k(Step.at(LIMIT), "strict", -1) == ()
    miss = Ray((-3, 1 + 2.0**-50, 1), (1, 0, 0))
    assert trace(CAN, miss).intervals == ()
    scene = Movable(CAN, miss, BINARY64)
    assert len(scene.by_k(Step.at(LIMIT), "strict", 1)) == 1
    assert scene.by_k(Step.at(0), "strict", 1) == ()


def test_a_leaf_may_fall_into_two_intervals_under_the_squared_measure_only() -> None:
    """The ray leaves the wall slowly; what it is allowed grows with t^2, and catches up."""
    tube = InfiniteCylinder((0, 0, 0), (0, 0, 1), 1)
    ray = Ray((-1, 0, 0), (-1, 0, 2.0**26))
    scene = Movable(tube, ray, BINARY64)
    lists = [
        scene.by_k(Step.at(i), measure, 1)  # type: ignore[arg-type]
        for i in range(LAST_STEP)
        for measure in ("strict", "squared")
    ]
    assert max(len(one) for one in lists[1::2]) == 2
    assert max(len(one) for one in lists[::2]) == 1


def test_half_spaces_can_be_left_where_they_are() -> None:
    tree = Intersection((HalfSpace((0, 0, 1), (0, 0, 1)), CAN))
    ray = Ray((0, 0, -3), (0, 0, 1))
    scene, k = Movable(tree, ray, BINARY64), Step.at(60)
    stays = scene.by_k(k, "strict", 1, (HalfSpace,))
    assert stays[0][1] == trace(tree, ray).intervals[0][1]
    assert stays[0][0] == scene.by_k(k, "strict", 1)[0][0] < trace(tree, ray).intervals[0][0]


def test_a_refinement_that_is_too_coarse_is_noticed() -> None:
    with pytest.raises(AssertionError, match="too coarse"):
        Step.at(0).times(1, 53)


def test_the_helpers_know_inside_from_outside() -> None:
    """The independent evaluation moved by zero is the plain definition."""
    ray = Ray((-3, 0, 1), (1, 0, 0))
    for n in range(60):
        t = Fraction(n, 7)
        assert within(CAN, ray, t, Fraction(0), Fraction(0)) == inside(CAN, at(ray, t))
    assert on_a_surface(CAN, ray, Fraction(2))
