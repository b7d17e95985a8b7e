"""Cells move inputs along the grid exactly, add up, and keep the case in the middle."""

from fractions import Fraction
from math import inf, nextafter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Cylinder, Ray, Refused
from raycert.cases.recipes import neighbour
from raycert.oracle.map.raster import UNITS, Inputs, Raster, Unit, moved, on_grid

ROD = Inputs(Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 0.1, 1), (1, 0, 0)))
FINITE = st.floats(allow_nan=False, allow_infinity=False)


def plan(x: str, y: str, unit: Unit = "ulps", span: object = 8, most: int = 17) -> Raster:
    axes = ROD.direction(x), ROD.direction(y)
    return Raster.of(ROD, axes, unit, Fraction(str(span)), most)


@given(FINITE.filter(bool), st.integers(0, 40))
def test_a_walk_on_the_grid_takes_the_next_number_each_time(x: float, steps: int) -> None:
    up = down = x
    for _ in range(steps):
        up, down = nextafter(up, inf), nextafter(down, -inf)
    assert on_grid(x, steps, BINARY64) == up
    assert on_grid(x, -steps, BINARY64) == down


@given(FINITE.filter(lambda x: abs(x) > 1e-300 and abs(x) < 1e300), st.booleans())
def test_one_step_is_the_neighbour_of_the_recipes(x: float, up: bool) -> None:
    assert on_grid(x, 1 if up else -1, BINARY64) == neighbour(x, up)


def test_from_0_the_steps_are_those_of_the_recipes() -> None:
    assert on_grid(0.0, 1, BINARY64) == neighbour(0.0, True)
    assert on_grid(-0.0, -3, BINARY64) == -3 * 2.0**-53
    assert on_grid(0.0, 1, BINARY32) == 2.0**-24


@given(st.floats(width=32, allow_nan=False, allow_infinity=False), st.integers(-99, 99))
def test_binary32_stays_in_binary32_and_comes_back(x: float, steps: int) -> None:
    there = on_grid(x, steps, BINARY32)
    assert BINARY32.holds(there)
    if x and there and abs(there) < inf:
        assert on_grid(there, -steps, BINARY32) == x


def test_the_ends_of_the_grid_are_infinite() -> None:
    assert on_grid(BINARY64.largest, 1, BINARY64) == inf
    assert on_grid(-BINARY32.largest, -1000, BINARY32) == -inf


@pytest.mark.parametrize("unit", UNITS)
@given(x=FINITE)
def test_no_move_is_the_number_itself(unit: Unit, x: float) -> None:
    assert moved(x, Fraction(0), unit, BINARY64) == x


def test_units_and_shares_are_rounded_once() -> None:
    assert moved(0.1, Fraction(1, 5), "units", BINARY64) == float(Fraction(0.1) + Fraction(1, 5))
    assert moved(3.0, Fraction(1, 3), "relative", BINARY64) == 4.0
    assert moved(1e300, Fraction(10) ** 9, "relative", BINARY64) == inf


@pytest.mark.parametrize("unit", UNITS)
def test_the_case_is_in_the_middle_and_comes_first(unit: Unit) -> None:
    found = plan("ray.origin[1]", "solid.radius", unit, 2 if unit == "ulps" else 0.5)
    assert found.places[0] == (0, 0)
    assert found.probe((0, 0)) == ROD.probe({})
    distances = [max(abs(i), abs(j)) for i, j in found.places]
    assert distances == sorted(distances)
    assert len(set(found.places)) == (2 * found.half + 1) ** 2


@given(st.integers(1, 500), st.integers(2, 200))
def test_in_ulps_steps_are_whole_and_the_span_is_kept(span: int, most: int) -> None:
    found = plan("ray.origin[1]", "solid.radius", "ulps", span, most)
    assert found.step.denominator == 1
    assert span - found.step < found.half * found.step <= span or found.half == 1
    assert found.half <= most // 2
    if span <= most // 2:
        assert (found.step, found.half) == (1, span)


def test_directions_move_all_their_inputs_and_add() -> None:
    found = plan("ray.origin[1]=1,solid.radius=-2", "solid.radius=3", "ulps", 8)
    values = found.values((2, 1))
    assert values == {
        "ray.origin[1]": on_grid(0.1, 2, BINARY64),
        "solid.radius": on_grid(1.0, 3 - 4, BINARY64),
    }


@pytest.mark.parametrize(
    ("x", "unit", "span", "words"),
    [
        ("ray.origin[1]=0.5", "ulps", 8, "whole"),
        ("ray.origin[1]", "ulps", 0.5, "whole number of ulps"),
        ("ray.origin[1]", "units", 0, "not positive"),
        ("ray.direction[1]", "relative", 1, "no relative change"),
        ("solid.radius", "units", 1, "same direction"),
    ],
)
def test_what_cannot_be_moved_so_is_refused(x: str, unit: Unit, span: float, words: str) -> None:
    with pytest.raises(Refused, match=words):
        plan(x, "solid.radius", unit, span)
