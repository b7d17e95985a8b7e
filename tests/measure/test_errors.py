"""Errors are what was planted; a memory changes no verdict."""

from __future__ import annotations

from math import inf, isclose, nan, nextafter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.families.sketch import ten
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Ray, Slab, Sphere
from raycert.oracle.exact.condition import condition
from raycert.oracle.judge.levels import Judge
from raycert.oracle.measure.catalog import BY_NAME
from raycert.oracle.measure.errors import Error, Referee, Spread, quantile, referees
from raycert.oracle.measure.rays import rays_of
from raycert.oracle.measure.sweeps import SWEEPS
from raycert.oracle.measure.way import Answered, Case

BALL, CAN = Sphere((0, 0, 0), 1), Cylinder((0, 0, 0), (0, 0, 2), 1)
CHORD = Case(BALL, Ray((-3, 0.25, 0), (2, 0, 0)))
DRUM = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 1.0)
ACROSS = Referee(DRUM, Ray((-3.0, 0.25, 1.0), (1.0, 0.0, 0.0)), BINARY64)


def plant(case: Case, answer: Answered) -> Error:
    return Referee.of(case).forward(answer)


def test_planted_errors_are_measured() -> None:
    referee = Referee.of(CHORD)
    [(a, b)] = referee.expected
    right = plant(CHORD, ((a, b),))
    assert right.exact
    assert right.counts
    assert right.ulps <= 0.5
    near = plant(CHORD, ((a, nextafter(b, inf)),))
    assert 0.5 <= near.ulps <= 1.5
    assert not near.exact
    assert isclose(referee.radii(((a + 0.125, b),)), 0.25, rel_tol=1e-12)
    assert (plant(CHORD, ()).pairs, plant(CHORD, ()).ulps) == (-1, inf)
    assert plant(CHORD, ((0.0, 0.5), (a, b))).pairs == 1
    assert plant(Case(BALL, Ray((-3, 2, 0), (1, 0, 0))), ()).idle


@pytest.mark.parametrize("answer", [None, ((nan, 1.0),), ((2.0, 1.0),), ((-1.0, 1.0),)])
def test_what_is_no_list_is_a_failure(answer: Answered) -> None:
    error = plant(CHORD, answer)
    assert error == Error(inf, failed=True)
    assert not error.counts
    assert Referee.of(CHORD).backward(answer, "strict") == inf
    assert not Referee.of(CHORD).is_stable(answer)


@pytest.mark.parametrize("scale", [2.0**-500, 1.0, 2.0**500])
def test_errors_in_radii_do_not_depend_on_the_scale(scale: float) -> None:
    case = Case(Sphere((0, 0, 0), scale), Ray((-3 * scale, 0.25 * scale, 0), (2 * scale, 0, 0)))
    referee = Referee.of(case)
    [(a, b)] = referee.expected
    assert isclose(referee.radii(((a, b - 0.5),)), 1.0, rel_tol=1e-12)


def test_the_unit_is_the_smallest_radius_or_thickness() -> None:
    for solid, unit in ((CAN, 1), (Slab((0, 0, 0), (0, 3, 4)), 5), (Sphere((0, 0, 0), 0), 1)):
        assert Referee(solid, CHORD.ray, BINARY64).unit == unit


def test_k_is_that_of_a_judge_without_a_memory() -> None:
    cases = rays_of("random", 4) + [
        sample.posed()
        for name in ("far", "thin", "start", "faces", "speed")
        for sample in SWEEPS[name].samples(SWEEPS[name].steps[5], 1, 2)
    ]
    for case, referee in zip(cases, referees(cases), strict=True):
        plain = Judge(*case, BINARY64)
        answers = [BY_NAME[name].solve([case])[0] for name in ("textbook", "numpy-float32")]
        for answer in (*answers, referee.expected):
            if answer is None or referee.malformed(answer):
                continue
            for measure in ("strict", "squared"):
                assert referee.backward(answer, measure) == plain.backward_error(answer, measure)
            assert referee.is_stable(answer) == (referee.backward(answer, "strict") <= 64)


def test_the_expected_list_is_exact_and_within_one() -> None:
    assert ACROSS.forward(ACROSS.expected).exact
    assert ACROSS.backward(ACROSS.expected, "strict") <= 1


def test_a_moved_end_is_measured() -> None:
    (enter, leave), *_ = ACROSS.expected
    off = ((enter, leave * (1 + 2.0**-30)),)
    assert 2.0**20 < ACROSS.backward(off, "strict") < 2.0**24
    assert ACROSS.forward(off).counts
    assert ACROSS.backward(((nextafter(enter, 9), leave),), "strict") <= 2


def test_the_floor_is_the_condition_number_in_ulps() -> None:
    for sample in SWEEPS["thin"].samples(ten(-6), 1, 6):
        referee = sample.referee()
        assert referee is not None
        power = condition(referee.exact, referee.solid, referee.ray)
        assert power is not None
        assert 2.0 ** (power - 3) < referee.floor <= 2.0**power


def test_a_tangent_has_no_floor() -> None:
    for y, floor in ((1.0, inf), (2.0, 0)):
        assert Referee(DRUM, Ray((-3.0, y, 1.0), (1.0, 0.0, 0.0)), BINARY64).floor == floor


@given(st.lists(st.floats(min_value=0, allow_nan=False), min_size=1, max_size=300))
def test_a_spread_is_by_rank(figures: list[float]) -> None:
    spread = Spread.of(figures)
    assert spread is not None
    assert spread.median <= spread.p99 <= spread.largest == max(figures)
    assert spread.median in figures
    assert sum(x > spread.p99 for x in figures) <= len(figures) / 100
    assert sum(x > spread.median for x in figures) <= len(figures) / 2
    assert Spread.of([]) is None


def test_a_quantile_is_one_of_the_values() -> None:
    assert quantile(range(1, 11), 0.9) == 9
    assert quantile([7.0], 0.9) == 7.0
