"""Arrays compute what single rays do; pairs hold 106 bits."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import inf
from typing import Any

import pytest

from raycert.cases.model import Cylinder, Ray, Sphere
from raycert.oracle.measure.catalog import BY_NAME
from raycert.oracle.measure.errors import referees
from raycert.oracle.measure.rays import LEAVES, SETS, rays_of
from raycert.oracle.measure.rays import arrays as draw
from raycert.oracle.measure.way import Case

np = pytest.importorskip("numpy")
arrays = pytest.importorskip("raycert.oracle.measure.arrays")
from raycert.oracle.measure.arrays import DoubleDouble, scattered, shape  # noqa: E402

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)


@pytest.mark.parametrize("name", SETS)
def test_float64_in_arrays_is_as_wrong_as_the_textbook_and_no_more(name: str) -> None:
    """Both are the textbook in doubles: they lose like numbers of rays, and no one raises."""
    cases = rays_of(name, 40)
    lost = []
    for method in ("textbook", "numpy-float64"):
        each = zip(BY_NAME[method].solve(cases), referees(cases), strict=True)
        lost.append(sum(not judge.forward(answer).counts for answer, judge in each))
    assert abs(lost[0] - lost[1]) <= 4


@pytest.mark.parametrize("name", ["random", "far", "boolean"])
def test_more_digits_are_nearer(name: str) -> None:
    cases = rays_of(name, 40)
    ladder = ("numpy-float32", "numpy-float64", "numpy-longdouble", "double-double")
    errors = []
    for method in ladder:
        each = [
            j.forward(a) for a, j in zip(BY_NAME[method].solve(cases), referees(cases), strict=True)
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
    found = BY_NAME["numpy-float64"].solve(cases)
    assert found == [((2.0, 4.0),), ((2.0, 4.0),), ((2.5, 3.5),), ((1.0, 5.0),)]
    assert shape(cases[0].solid) != shape(cases[1].solid)
    assert scattered(cases, shape, lambda group: [((0.0, float(len(group))),)] * len(group)) == [
        ((0.0, 3.0),), ((0.0, 1.0),), ((0.0, 3.0),), ((0.0, 3.0),)
    ]  # fmt: skip


def test_nan_is_a_failure() -> None:
    huge = Case(Sphere((0, 0, 0), 1e200), Ray((-1e300, 0, 0), (1e200, 0, 0)))
    assert BY_NAME["numpy-float64"].solve([huge]) == [None]


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


def test_a_batch_is_timed_on_its_arrays_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    cases, seen = rays_of("random", 8), []
    monkeypatch.setattr(
        arrays, "function", lambda name: lambda *work: seen.append([x.shape for x in work[1:]])
    )
    run = arrays.ready_batch("any:function", cases)
    assert not seen
    run()
    assert seen == [[(2, 3), (2, 3)]] * 4


def test_the_naive_formula_is_the_textbook_at_one_solid() -> None:
    for solid in LEAVES:
        some = draw(solid, "random", 300, 1)
        enter, leave = arrays.naive(some.solid, some.origins, some.directions)
        lanes = arrays.Columns(arrays.KINDS["float64"], some.origins, some.directions)
        first, last = lanes.spans([some.solid])
        hit = ~np.isnan(enter)
        assert (hit == ((first <= last) & (last >= 0))).all()
        assert 0 < hit.sum() < 300
        assert np.allclose(enter[hit], first[hit], 1e-9, 1e-9)
        assert np.allclose(leave[hit], last[hit], 1e-9)
