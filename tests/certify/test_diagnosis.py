"""A fault given as an unknown subject is named right or not at all; nothing else is ever named."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from itertools import cycle
from math import inf, isinf, isnan, nan, nextafter

import pytest

from raycert.cases.accept import Numbers
from raycert.cases.formats import BINARY64
from raycert.cases.levels import LEVELS
from raycert.cases.row import GoldenRow
from raycert.oracle.certify import diagnosis as diagnoses
from raycert.oracle.certify.certificate import Json
from raycert.oracle.certify.diagnosis import LEAST, SHARE, close, likely
from raycert.oracle.certify.grading import Grade
from raycert.oracle.judge.answer import Listed
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo.inhabitants import FAULTS, SOUND
from raycert.oracle.zoo.matrix import Outcome, Trials
from raycert.oracle.zoo.tracer import Fault, Intersect, Tracer, crossed, projected, unscaled
from shared.corpus import golden

SILENT = {
    "zero-radius", "tangents-dropped", "wall-outside", "cap-outside", "rim-dropped",
    "start-dropped", "flushed", "overflow",
}  # fmt: skip
"""Faults that no level refuses, or on a few rows only: there is too little to compare."""
TIES = {"union-unmerged", "union-in-order", "difference-open"}
"""Faults at equal ends, which independent roundings make unequal."""


@cache
def rows() -> tuple[GoldenRow, ...]:
    """Return half the trees, an eighth of the leaves, and all of what is rare."""
    trees, leaves = cycle((True, False)), cycle((True, *[False] * 7))
    return tuple(
        row
        for row in golden().rows
        if next(trees if hasattr(row.solid, "of") else leaves) or row.family in ("csg-gap", "disk")
    )


@cache
def bench() -> Trials:
    return Trials(rows(), BINARY64)


def rounded(answer: Numbers, dice: random.Random) -> Numbers:
    """Return an answer as another formula might round it: points stay points, 0 stays 0."""

    def off(x: float) -> float:
        if not x or isinf(x) or isnan(x):
            return x
        for _ in range(dice.randrange(3)):
            x = nextafter(x, 0.0)
        return x

    return tuple((off(a), off(b)) if a != b else (a, b) for a, b in answer)


def graded(intersect: Intersect, independently: bool = True) -> list[Grade]:
    """Return the grades of a tracer that rounds in its own way."""
    dice, grades = random.Random(1), []
    for row, base in zip(rows(), bench().base, strict=True):
        outcome = Outcome.of(intersect, row, BINARY64)
        if independently and outcome.answer is not None:
            outcome = Outcome(rounded(outcome.answer, dice))
        refusal, faults = bench().refusal(row, outcome, base), {}
        if refusal and refusal.level in ("sound", "stable"):
            words = f"crash: {refusal.reason}" if refusal.kind == "crash" else refusal.reason
            faults = dict.fromkeys(LEVELS[refusal.level == "stable" :], words)
        judge = bench().judges.get(row.id) or Judge(row.solid, row.ray, BINARY64, row.tier)
        grades.append(
            Grade(row, None if outcome.answer is None else Listed(outcome.answer), faults, judge)
        )
    return grades


def diagnose(grades: Sequence[Grade]) -> list[Json]:
    """Return what is likely over all solids together."""
    return likely("all", grades)


def without(planted: Fault, grades: Sequence[Grade], patch: pytest.MonkeyPatch) -> list[Json]:
    """Return what a zoo says that has never seen the fault."""
    patch.setattr(diagnoses, "FAULTS", [f for f in FAULTS if f is not planted])
    return diagnose(grades)


@pytest.mark.parametrize("planted", FAULTS, ids=lambda f: f.name)
def test_a_fault_is_named_and_where_it_is_unknown_no_other(
    planted: Fault, monkeypatch: pytest.MonkeyPatch
):
    """Where it is named, it is the only one to reach the threshold; else it is tried unknown."""
    grades = graded(planted.make())
    said = diagnose(grades)
    if planted.name in SILENT:
        assert said == []
    elif planted.name not in TIES or said:
        [cause] = said[0]["explained"]
        assert (cause["fault"], cause["does"]) == (planted.name, planted.does)
        assert cause["rows"] + said[0]["unexplained"] == said[0]["failures"]
    if not said:
        assert without(planted, grades, monkeypatch) == []


@pytest.mark.parametrize("name", sorted(TIES))
def test_a_fault_at_equal_ends_is_named_where_they_are_equal(name: str):
    planted = next(f for f in FAULTS if f.name == name)
    [found] = diagnose(graded(planted.make(), independently=False))
    assert [cause["fault"] for cause in found["explained"]] == [name]


@pytest.mark.parametrize("planted", FAULTS[::6], ids=lambda f: f.name)
def test_a_fault_in_another_tracer_is_named_right_or_not_at_all(planted: Fault):
    """The same fault where nothing is scaled and the ray is projected on the axis's plane."""
    tracer = planted.make()
    if not isinstance(tracer, Tracer) or tracer.wall is not crossed:
        pytest.skip("the wall, or all of it, is the fault's own")
    for found in diagnose(graded(replace(tracer, wall=projected, scale=unscaled))):
        assert [cause["fault"] for cause in found["explained"]] == [planted.name]


@pytest.mark.parametrize(
    "sound", [s for s in SOUND if s.precision == "binary64"], ids=lambda s: s.name
)
def test_of_a_sound_tracer_nothing_is_said(sound: object):
    assert diagnose(graded(sound.tracer)) == []  # type: ignore[attr-defined]


def test_few_failures_and_no_rows_say_nothing():
    grades = graded(next(f for f in FAULTS if f.name == "no-clip").make())
    failing = [g for g in grades if g.fault("sound")]
    assert diagnose(failing[: LEAST - 1]) == []
    assert diagnose(failing[:LEAST]) != []
    assert diagnose([]) == []


def test_two_faults_at_once_are_not_one():
    one, two = (next(f for f in FAULTS if f.name == n).make() for n in ("no-clip", "diameter"))
    turns = cycle((one, two))
    assert diagnose(graded(lambda solid, ray: next(turns)(solid, ray))) == []


def test_the_threshold_is_between_one_fault_and_two():
    """The share of rows on which the two most alike faults agree is well below SHARE."""
    grades = graded(next(f for f in FAULTS if f.name == "unit-length").make())
    alike = next(f for f in FAULTS if f.name == "unscaled-heights")
    level, failing = diagnoses.failures(grades)
    agreed, _ = diagnoses.explained(alike, level, bench(), grades, failing)
    refused = {r.id for r, (_, x) in zip(rows(), bench().tried(alike), strict=True) if x}
    share = agreed / len(refused | {g.row.id for g in failing})
    assert 0.5 < share < SHARE - 0.05


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ((), (), True),
        (((1.0, 2.0),), (), False),
        (((1.0, 2.0),), ((1.0 + 2**-50, 2.0),), True),
        (((1.0, 2.0),), ((1.0 + 2**-30, 2.0),), False),
        (((0.0, inf),), ((1e-20, inf),), False),
        (((1.0, inf),), ((1.0, 2.0),), False),
        (((nan, nan),), ((nan, 1.0),), True),
        (((nan, nan),), ((1.0, 2.0),), False),
    ],
)
def test_answers_are_alike_but_for_roundings(one: Numbers, other: Numbers, same: bool):
    assert close(one, other, BINARY64) is same
