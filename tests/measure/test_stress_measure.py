"""Measures: the judge's own k, kept lists or not; counts; the condition line."""

from math import inf, nextafter

import pytest

from raycert.cases.families.sketch import ten, two
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Ray
from raycert.oracle.exact.condition import condition
from raycert.oracle.judge.levels import Judge
from raycert.oracle.measure.methods.method import Answered
from raycert.oracle.measure.stress.measure import FAILED, Ground, Measured, Point, Question, high
from raycert.oracle.measure.stress.sweeps import SWEEPS
from raycert.oracle.zoo.textbook import textbook

DRUM = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 1.0)


def question(ray: Ray) -> Question:
    return Question(DRUM, ray, BINARY64)


ACROSS = question(Ray((-3.0, 0.25, 1.0), (1.0, 0.0, 0.0)))


def test_k_is_that_of_the_judge() -> None:
    for sweep in ("far", "thin", "start", "faces", "speed"):
        for sample in SWEEPS[sweep].samples(SWEEPS[sweep].steps[5], 1, 3):
            asked = Question.of(sample)
            assert asked is not None
            judge = Judge(asked.solid, asked.ray, BINARY64)
            for answer in (textbook(asked.solid, asked.ray), asked.expected):
                found = asked.measured(answer)
                if found.failed:
                    continue
                assert found.strict == judge.backward_error(answer, "strict")
                assert found.squared == judge.backward_error(answer, "squared")
                assert asked.is_stable(answer) == (found.strict <= 64)


def test_the_expected_list_is_exact_and_within_one() -> None:
    found = ACROSS.measured(ACROSS.expected)
    assert found.exact
    assert found.strict <= 1
    assert found.ulps <= 0.5


def test_a_moved_end_is_measured() -> None:
    (enter, leave), *_ = ACROSS.expected
    off = ACROSS.measured(((enter, leave * (1 + 2.0**-30)),))
    assert 2.0**20 < off.strict < 2.0**24
    assert off.pairs == 0
    assert not off.exact
    near = ACROSS.measured(((nextafter(enter, 9), leave),))
    assert near.strict <= 2


@pytest.mark.parametrize("answer", [None, ((2.0, 1.0),), ((float("nan"), 1.0),), ((-1.0, 2.0),)])
def test_what_is_no_list_failed(answer: Answered) -> None:
    assert ACROSS.measured(answer) == FAILED
    assert not ACROSS.is_stable(answer)


def test_counts_of_pairs_are_told_by_their_side() -> None:
    pair = ACROSS.expected[0]
    answers: list[Answered] = [(), (pair, (9.0, 10.0)), (pair,), None]
    point = Point.over([ACROSS.measured(answer) for answer in answers])
    assert (point.missed, point.phantom, point.failed, point.exact) == (1, 1, 1, 1)
    assert point.wrong == 0.75
    assert point.inexact == 0.75
    assert point.strict == inf
    assert point.ulps is not None
    assert point.ulps <= 0.5


def test_no_right_count_has_no_ulps() -> None:
    assert Point.over([FAILED]).ulps is None


def test_a_quantile_is_one_of_the_values() -> None:
    assert high(range(1, 11)) == 9
    assert high([7.0]) == 7.0


def test_the_floor_is_the_condition_number_in_ulps() -> None:
    for sample in SWEEPS["thin"].samples(ten(-6), 1, 6):
        asked = Question.of(sample)
        assert asked is not None
        power = condition(asked.exact, asked.solid, asked.ray)
        assert power is not None
        assert 2.0 ** (power - 3) < asked.floor <= 2.0**power


def test_a_tangent_has_no_floor() -> None:
    assert question(Ray((-3.0, 1.0, 1.0), (1.0, 0.0, 0.0))).floor == inf
    assert question(Ray((-3.0, 2.0, 1.0), (1.0, 0.0, 0.0))).floor == 0


def test_the_far_end_does_not_decide() -> None:
    def ground(x: int) -> Ground:
        asked = (Question.of(sample) for sample in SWEEPS["far"].samples(ten(x), 1, 2))
        return Ground.over([question for question in asked if question])

    assert ground(6).decisive == 2
    assert ground(16).decisive == 0


def test_a_rounded_away_solid_is_no_question() -> None:
    sample = SWEEPS["displaced"].samples(two(0), 1, 1)[0]
    lost = type(sample)(
        sample.shape, sample.origin, sample.direction, sample.frame.moved((10**40,) * 3)
    )
    assert Question.of(lost) is None


def test_measured_is_kept() -> None:
    assert ACROSS.measured(()) is ACROSS.measured(())
    assert isinstance(ACROSS.measured(()), Measured)
