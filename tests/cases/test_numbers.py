"""Scenes as numbers: round trips, neighbours, what lies between."""

from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Cylinder, Ray, Sphere
from raycert.cases.numbers import (
    Probe,
    at,
    between,
    is_usual,
    near,
    numbers,
    ordinal,
    with_number,
    with_numbers,
)
from raycert.cases.strategies import numbers as drawn
from raycert.cases.strategies import scenes

BALL = Probe(Sphere((0, 0, 0), 1), Ray((-3, 0, 0), (1, 0, 0)))
FORMATS = st.sampled_from((BINARY32, BINARY64))


@given(scenes())
def test_a_probe_is_its_numbers(probe):
    whole = Probe(*probe)
    assert with_numbers(whole, numbers(whole)) == whole


def test_numbers_that_make_no_solid_make_no_probe():
    assert with_number(BALL, 3, -1.0) is None
    rod = Probe(Cylinder((0, 0, 0), (0, 0, 1), 1), BALL.ray)
    assert with_number(rod, 5, 0.0) is None
    assert with_number(rod, 5, 2.0) is not None


@given(FORMATS.flatmap(lambda fmt: st.tuples(st.just(fmt), drawn(fmt))))
def test_the_line_of_ordinals_has_each_number_once_and_in_order(given_):
    fmt, x = given_
    place = ordinal(x, fmt)
    assert at(place, fmt) == x
    assert at(place - 1, fmt) < x < at(place + 1, fmt)
    assert fmt.holds(at(place + 1, fmt))


def test_a_neighbour_of_nothing_is_not_the_least_number():
    assert near(0.0, 1, BINARY64) == 2.0**-53
    assert near(1.0, -1, BINARY64) == 1 - 2.0**-53


def test_what_lies_between_two_probes_begins_and_ends_with_them():
    other = with_number(BALL, 0, 2.0)
    assert between(BALL, other, 0, 16, BINARY64) == BALL
    assert between(BALL, other, 16, 16, BINARY64) == other
    middle = between(BALL, other, 8, 16, BINARY64)
    assert 0 < middle.solid.center[0] < 2


def test_usual_is_what_does_not_overflow():
    assert is_usual(BALL, BINARY64)
    assert not is_usual(with_number(BALL, 0, 2.0**200), BINARY64)
    assert not is_usual(with_number(BALL, 0, 2.0**-200), BINARY64)
    assert not is_usual(with_number(BALL, 0, 2.0**40), BINARY32)
