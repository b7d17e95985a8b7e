"""Arrays compute what single rays do; prisms come nearer as 1 / n^2; pairs hold 106 bits."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from math import cos, inf, isclose, nan, pi
from typing import Any

import pytest

from raycert.cases.model import Cylinder, Ray, Sphere
from raycert.oracle.measure.bench.errors import error, judges
from raycert.oracle.measure.bench.scenarios import SCENARIOS, scenario
from raycert.oracle.measure.methods.catalog import METHODS, by_name
from raycert.oracle.measure.methods.method import Case, Method

np = pytest.importorskip("numpy")
kernel = pytest.importorskip("raycert.oracle.measure.methods.vector.kernel")
from raycert.oracle.measure.methods.vector.batches import rays, scattered, shape  # noqa: E402
from raycert.oracle.measure.methods.vector.double_double import DoubleDouble  # noqa: E402
from raycert.oracle.measure.methods.vector.timing import seconds  # noqa: E402

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)


@pytest.mark.parametrize("name", SCENARIOS)
def test_float64_in_arrays_is_as_wrong_as_the_textbook_and_no_more(name: str) -> None:
    """Both are the textbook in doubles: they lose like numbers of rays, and no one raises."""
    cases = scenario(name, 40)
    lost = []
    for method in ("textbook", "numpy-float64"):
        each = zip(by_name(method).solve(cases), judges(cases), strict=True)
        lost.append(sum(not error(answer, judge).counts for answer, judge in each))
    assert abs(lost[0] - lost[1]) <= 4


@pytest.mark.parametrize("name", ["random", "far", "boolean"])
def test_more_digits_are_nearer(name: str) -> None:
    cases = scenario(name, 40)
    ladder = ("numpy-float32", "numpy-float64", "numpy-longdouble", "double-double")
    errors = []
    for method in ladder:
        each = [
            error(a, j) for a, j in zip(by_name(method).solve(cases), judges(cases), strict=True)
        ]
        errors.append(max((e.ulps for e in each if e.counts), default=inf))
    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 1e6
    assert errors[-1] <= 0.51


def test_lanes_have_solids_of_their_own_and_keep_their_order() -> None:
    cases = [
        Case(Cylinder((0, 0, 0), (0, 0, 2), r), Ray((-3, 0, 1), (1, 0, 0))) if r else
        Case(Sphere((0, 0, 0), 1), Ray((-3, 0, 0), (1, 0, 0)))
        for r in (1.0, 0.0, 0.5, 2.0)
    ]  # fmt: skip
    found = by_name("numpy-float64").solve(cases)
    assert found == [((2.0, 4.0),), ((2.0, 4.0),), ((2.5, 3.5),), ((1.0, 5.0),)]
    assert shape(cases[0].solid) != shape(cases[1].solid)
    assert scattered(cases, shape, lambda group: [((0.0, float(len(group))),)] * len(group)) == [
        ((0.0, 3.0),), ((0.0, 1.0),), ((0.0, 3.0),), ((0.0, 3.0),)
    ]  # fmt: skip


def test_nan_is_a_failure() -> None:
    huge = Case(Sphere((0, 0, 0), 1e200), Ray((-1e300, 0, 0), (1e200, 0, 0)))
    assert by_name("numpy-float64").solve([huge]) == [None]


OPERATIONS: list[tuple[Callable[[Any, Any], Any], Callable[[Any, Any], Any]]] = [
    (lambda a, b: a + b, lambda a, b: a + b),
    (lambda a, b: a - b, lambda a, b: a - b),
    (lambda a, b: a * b, lambda a, b: a * b),
    (lambda a, b: a / b, lambda a, b: a / b),
    (lambda a, b: -a, lambda a, b: -a),
]


@pytest.mark.parametrize("number", range(len(OPERATIONS)))
def test_pairs_of_doubles_hold_a_hundred_bits(number: int) -> None:
    mine, exact = OPERATIONS[number]
    third, sqrt2 = (1 / 3, 1.850371707708594e-17), (1.4142135623730951, -9.667293313452913e-17)
    a, b = (DoubleDouble(np.array([h]), np.array([low])) for h, low in (third, sqrt2))
    x, y = (Fraction(h) + Fraction(low) for h, low in (third, sqrt2))
    found = mine(a, b)
    value = Fraction(float(found.high[0])) + Fraction(float(found.low[0]))
    assert abs(value - exact(x, y)) <= abs(exact(x, y)) / 2**100
    assert bool((a < b)[0])
    assert not bool((a > b)[0])
    assert bool((a > 0.0)[0])


def test_a_batch_is_timed_on_its_arrays_alone() -> None:
    cases = scenario("random", 8)
    seen = []
    measured = seconds(lambda solid, u, v: seen.append((solid, u.shape, v.shape)))(cases)
    assert 0 <= measured < 1
    assert len(seen) == 4
    assert all(u == v == (2, 3) for _, u, v in seen)
    assert rays(cases)[0].shape == (8, 3)


MESHES = [m for m in METHODS if m.family == "mesh"]


def caster(name: str) -> None:
    pytest.importorskip("trimesh")
    pytest.importorskip("rtree")
    if name == "embree":
        pytest.importorskip("embreex")


@pytest.mark.parametrize("name", ["trimesh", "embree"])
def test_prisms_come_nearer_as_the_square_of_their_sides(name: str) -> None:
    """The rays meet the wall at cosines above 0.9, and go a tenth up."""
    caster(name)
    cases = [Case(CAN, Ray((-3, 0.02 * i - 0.4, 1.1), (1, 0.01, 0.1))) for i in range(40)]
    truth = judges(cases)
    errors = []
    for n in (16, 64, 256):
        answers = by_name(f"{name}-{n}").solve(cases)
        errors.append(max(error(a, j).radii for a, j in zip(answers, truth, strict=True)))
    for coarse, fine in pairwise(errors):
        assert 10 < coarse / fine < 25
    assert errors[0] < 1.1 * (1 - cos(pi / 16)) / 0.9


@pytest.mark.parametrize("name", ["trimesh", "embree"])
def test_a_cast_from_inside_starts_at_zero_and_a_miss_is_empty(name: str) -> None:
    caster(name)
    inside, past = Ray((0.1, 0.2, 0.9), (1, 0.1, 0.2)), Ray((-3, 5, 1), (1, 0, 0.1))
    mine, miss = by_name(f"{name}-512").solve([Case(CAN, inside), Case(CAN, past)])
    [(_, leave)] = by_name("oracle").solve([Case(CAN, inside)])[0] or ()
    assert mine is not None
    assert mine[0][0] == 0.0
    assert isclose(mine[0][1], leave, rel_tol=1e-4)
    assert miss == ()


@pytest.mark.parametrize("name", ["tiny", "huge"])
def test_a_caster_that_cannot_take_the_numbers_fails_and_does_not_raise(name: str) -> None:
    caster("trimesh")
    cases = scenario(name, 12)
    assert len(by_name("trimesh-8").solve(cases)) == 12


def test_hits_that_are_no_chord_are_a_failure() -> None:
    caster("trimesh")
    from raycert.oracle.measure.methods.vector.casters import _chord

    assert _chord([(1.0, True), (2.0, False)]) == ((1.0, 2.0),)
    assert _chord([(1.0, True), (1.0 + 1e-12, True), (2.0, False)]) == ((1.0, 2.0),)
    for hits in (
        [(1.0, True)],
        [(1.0, False), (2.0, True)],
        [(1.0, True), (2.0, False), (3.0, True)],
        [(nan, True), (2.0, False)],
    ):
        assert _chord(hits) is None


@pytest.mark.parametrize("method", MESHES[::5], ids=lambda m: m.name)
def test_meshes_answer_capped_cylinders_only(method: Method) -> None:
    assert method.solids == {"cylinder"}
    assert not method.stress
