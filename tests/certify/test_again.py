"""State is seen: what passes when asked alone is told, and what is simply wrong is not."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import pytest

from raycert.cases.model import type_of
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.certify.again import LEAST, MOST, ask_again, failing, sample
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.run import Plan, Result, certify
from raycert.oracle.certify.selection import Selection
from raycert.oracle.client.dialogue import Outcome, Question
from raycert.oracle.client.process import Failure
from raycert.oracle.client.target import target
from shared.corpus import golden
from shared.places import CLIENTS

HELLO = Hello("client")
ROWS = golden().rows[::20]
BY_ID = {row.id: row for row in ROWS}
WRONG = Reply("", intervals=((7.0, 8.0), (9.0, 10.0)))
ANOTHER = Reply("", intervals=((7.0, 8.0),))


def graded(outcome: Outcome = WRONG) -> list[Grade]:
    return [grade(row, outcome, HELLO) for row in ROWS]


def right(question: Question) -> Outcome:
    return Reply("", intervals=BY_ID[question.id].expected)


@pytest.fixture(params=["function", "program"])
def leaky(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Sequence[str]:
    monkeypatch.chdir(CLIENTS)
    monkeypatch.setattr("raycert.oracle.certify.again.MOST", 8)
    monkeypatch.setattr("raycert.oracle.certify.again.LONGEST", 100.0)
    return ("leaky:intersect",) if request.param == "function" else (sys.executable, "leaky.py")


def certified(words: Sequence[str], families: Sequence[str]) -> Result:
    return certify(Plan(target(words), selection=Selection(families=tuple(families))))


def test_a_client_that_leaks_after_an_exception_is_told(leaky: Sequence[str]) -> None:
    result = certified(leaky, ("sphere-scale", "sphere-rows", "sphere-start"))
    form = result.form(leaky)
    state = form["state"]
    assert 0 < len(state["then_passed"]) < state["asked_again"] == 8
    count, first = len(state["then_passed"]), state["then_passed"][0]
    [reason] = [text for text in form["reasons"] if "asked before" in text]
    assert f"{count} of {state['asked_again']} failing rows pass when asked alone" in reason
    assert reason.endswith(first)
    assert not form["passed"]
    raised = {f["id"] for f in form["failures"] if "too large" in f["faults"].get("sound", "")}
    assert raised.isdisjoint(state["then_passed"])


def test_what_is_wrong_alone_too_is_not_put_down_to_state() -> None:
    again = ask_again(graded(), "sound", HELLO, lambda question: WRONG, 60.0)
    assert len(again.asked) == MOST
    assert again.passed == again.differed == again.reasons == again.notes == ()


def test_another_wrong_answer_is_noted_and_refuses_no_more_than_it_did() -> None:
    again = ask_again(graded(), "sound", HELLO, lambda question: ANOTHER, 60.0)
    assert again.differed == again.asked
    assert again.reasons == ()
    assert "get another wrong answer when asked alone" in again.notes[0]


def test_nan_is_the_same_answer_as_nan() -> None:
    nan = Reply("", intervals=((float("nan"), 1.0),))
    assert not ask_again(graded(nan), "sound", HELLO, lambda question: nan, 60.0).differed


def test_the_time_is_kept_and_a_few_are_asked() -> None:
    assert len(ask_again(graded(), "sound", HELLO, lambda question: WRONG, 0.0).asked) == LEAST
    every = ask_again(graded(), "sound", HELLO, right, 0.0)
    assert len(every.asked) == MOST, "once one has passed, the sample is asked whole"
    assert every.passed == every.asked


def test_the_sample_spreads_over_solids_and_families() -> None:
    chosen = sample(graded(), "sound")
    assert len(chosen) == MOST
    assert {type_of(g.row.solid) for g in chosen} == {type_of(row.solid) for row in ROWS}
    spheres = [g.row.family for g in chosen if type_of(g.row.solid) == "sphere"]
    assert len(set(spheres)) == len(spheres)
    assert [g.row.id for g in sample(graded()[::-1], "sound")] == [g.row.id for g in chosen]


@pytest.mark.parametrize("kind", ["crash", "hang", "unrepeatable", "wrong-id"])
def test_what_was_asked_alone_when_it_failed_is_not_asked_again(kind: str) -> None:
    assert failing(graded(Failure(kind, "seen")), "sound") == []  # type: ignore[arg-type]
    assert failing(graded(Reply("", error="crash course")), "sound")


def test_a_lone_row_was_asked_alone_already(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(CLIENTS)
    row = next(row for row in golden().rows if row.family == "sphere-rows")
    alone = certify(Plan(target(("planted:steady",)), selection=Selection(ids=(row.id,))))
    assert not alone.verdict.granted
    assert alone.form(("planted:steady",))["state"]["asked_again"] == 0
