"""The search for k: a guess decides nothing, and little is asked."""

from __future__ import annotations

from typing import get_args

from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64, Format
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import FROM_INSIDE
from raycert.cases.row import GoldenRow
from raycert.cases.strategies import scenes as drawn
from raycert.oracle.exact.intervals import contains
from raycert.oracle.judge.answer import Claim, First, Listed, YesNo
from raycert.oracle.judge.backward import Bracket, nearest_step
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import LAST_STEP, Measure, Step
from raycert.oracle.zoo.inhabitants import SOUND
from shared.corpus import golden
from shared.grid import rays, solids

MEASURES: tuple[Measure, ...] = get_args(Measure)
steps = st.integers(-1, LAST_STEP + 1)
scenes = st.one_of(st.tuples(solids, rays), drawn(3, fmt=BINARY32))


class Asked:
    """What holds from a step on; counts how often it is asked."""

    def __init__(self, least: int) -> None:
        self.least, self.times = least, 0

    def __call__(self, step: int) -> bool:
        assert 0 <= step <= LAST_STEP
        self.times += 1
        return step >= self.least


@given(st.integers(0, LAST_STEP + 1), st.integers(-9, LAST_STEP + 9), st.lists(steps, max_size=4))
def test_every_guess_and_every_question_before_lead_to_the_least_step(
    least: int, guess: int, before: list[int]
) -> None:
    asked = Asked(least)
    bracket = Bracket(asked, lambda: guess)
    for step in before:
        assert bracket.within(step) == (step >= least)
    assert bracket.least == least
    known = asked.times
    assert bracket.least == least
    assert bracket.within(least)
    assert not bracket.within(least - 1)
    assert asked.times == known, "what is proved is not asked again"
    assert asked.times <= len(before) + 2 * (LAST_STEP + 1).bit_length()


@given(st.integers(0, LAST_STEP))
def test_a_right_guess_is_proved_by_two_questions(least: int) -> None:
    asked = Asked(least)
    assert Bracket(asked, lambda: least).least == least
    assert asked.times == min(least + 1, 2)


@given(steps, steps, steps)
def test_what_is_known_from_elsewhere_is_not_asked(least: int, known: int, step: int) -> None:
    asked = Asked(least := max(least, 0))
    bracket = Bracket(asked)
    bracket.at_most(max(least, known))
    assert bracket.within(step) == (step >= least)
    assert asked.times == (0 <= step < max(least, known))
    assert bracket.least == least
    assert Bracket.at(least).least == least


def test_the_step_of_a_k_is_the_least_that_is_not_below_it() -> None:
    for i in range(LAST_STEP):
        at, above = float(Step.at(i)), float(Step.at(i + 1))
        assert nearest_step(at) == i
        assert nearest_step((at + above) / 2) == i + 1
    assert nearest_step(0.0) == 0
    assert nearest_step(2.0**300) == LAST_STEP


@settings(max_examples=60, deadline=None)
@given(scenes, st.sampled_from([BINARY64, BINARY32]), st.integers(0, LAST_STEP))
def test_the_squared_measure_allows_whatever_the_strict_one_does(
    scene: tuple[Solid, Ray], fmt: Format, step: int
) -> None:
    judge = Judge(*scene, fmt)
    assert contains(judge.moved(step, "squared", 1), judge.moved(step, "strict", 1))
    assert contains(judge.moved(step, "strict", -1), judge.moved(step, "squared", -1))


def claims(row: GoldenRow) -> list[Claim]:
    """Return all kinds of answer to a row, right ones and wrong ones."""
    ends = [t for pair in row.expected for t in pair][:2]
    firsts = (None, 0.0, *ends)
    modes = [First(t, mode) for mode in FROM_INSIDE for t in firsts]
    lists = row.expected, (), ((0.0, 1.0),), *(((0.0, t),) for t in ends)
    return [*map(Listed, lists), *modes, YesNo(True), YesNo(False)]


def test_what_is_right_of_the_exact_list_is_right_of_every_k() -> None:
    """The short cut is asked where formats end: the range tier, and one row in many of others."""
    rows = golden().rows
    for row in [*rows[::150], *[row for row in rows if row.tier == "range"][::15]]:
        judge = Judge(row.solid, row.ray, tier=row.tier)
        for claim in claims(row):
            for measure in MEASURES:
                bracket = claim.bracket(judge, measure)
                assert bracket.high or bracket.holds(0), (row.id, claim, measure)


def test_the_guess_is_mostly_right() -> None:
    [textbook] = [sound.tracer for sound in SOUND if sound.name == "textbook"]
    asked = brackets = 0
    for row in golden().rows[::16]:
        said = Listed(tuple((a + 0.0, b + 0.0) for a, b in textbook(row.solid, row.ray)))
        for measure in MEASURES:
            bracket = said.bracket(Judge(row.solid, row.ray), measure)
            if bracket.high:
                counted = Asked(bracket.least)
                assert Bracket(counted, lambda guess=bracket.guess: guess).least == bracket.least  # type: ignore[misc]
                asked, brackets = asked + counted.times, brackets + 1
    assert brackets > 100
    assert asked < 2 * brackets
