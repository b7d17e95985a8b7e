"""The oracle against its witnesses: planted errors are caught by at least two of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import cycle

import pytest
from click.testing import CliRunner

from raycert.cases.draw import fresh
from raycert.cases.model import Cylinder, Difference, Ray, Slab, Sphere, Union, leaves
from raycert.cases.table import PROBLEM_2, Row, Signs
from raycert.oracle.commands.crosscheck import NAMES
from raycert.oracle.commands.crosscheck import crosscheck as command
from raycert.oracle.exact import intervals
from raycert.oracle.exact import trace as traces
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import ZERO, Surd
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness import crosscheck as crosschecks
from raycert.oracle.witness.crosscheck import Query, Summary, check, crosscheck
from raycert.oracle.witness.testimony import WITNESSES, Testimony, load
from shared.corpus import golden

EXACT = ("definition", "enclosure", "symbols")
CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
ACROSS = Ray((-3, 0, 1), (1, 0, 0))
HOLLOW = Query("hollow", Difference((CAN, Sphere((0, 0, 1), 0.5))), ACROSS)
TWO = Query("two", Union((CAN, Sphere((1, 0, 1), 1), Slab((5, 0, 0), (6, 0, 0)))), ACROSS)
UP = Query("up", CAN, Ray((0.25, 0, 3), (0.125, 0, -1)))


def sample(count: int, seed: int) -> list[Query]:
    return [Query(case.slug, case.solid, case.ray) for case in fresh(count, seed)]


def outcomes(question: Query, answer: Intervals | None = None) -> list[str]:
    return [v.outcome for _, v, _ in check(question, EXACT, answer).testimonies]


def test_sample_is_the_same_each_time_and_holds_every_type() -> None:
    cases = list(fresh(64, 5))
    assert cases == list(fresh(80, 5))[:64]
    assert cases != list(fresh(64, 6))
    assert len({type(case.solid) for case in cases}) == 8
    assert max(len(list(leaves(case.solid))) for case in cases) > 4


def test_sample_is_biased_to_the_degenerate() -> None:
    answers = [trace(case.solid, case.ray).intervals for case in fresh(800, 5)]
    assert sum(any(a == b for a, b in answer) for answer in answers) > 40
    assert sum(len(answer) > 1 for answer in answers) > 5
    assert sum(bool(answer) for answer in answers) > 400


def moved(t: Surd) -> Surd:
    """Return t moved by one part in 2^60."""
    return Surd(t.x * (2**60 + 1), t.y * (2**60 + 1), t.d, t.z * 2**60)


def test_one_endpoint_moved_is_caught_by_every_exact_witness() -> None:
    planted = 0
    for question in sample(48, 21):
        answer = trace(question.solid, question.ray).intervals
        for i, (enter, leave) in enumerate(answer):
            if leave.finite and leave > ZERO:
                wrong = (*answer[:i], (enter, moved(leave)), *answer[i + 1 :])
                assert outcomes(question, wrong) == ["disagreed"] * 3
                planted += 1
    assert planted > 10


def caught(questions: list[Query]) -> int:
    """Return how many answers changed; each that did is caught by all three."""
    changed = 0
    for question in questions:
        found = outcomes(question)
        assert found in (["agreed"] * 3, ["disagreed"] * 3)
        changed += found[0] == "disagreed"
    return changed


ROWS = {row.name: row for row in PROBLEM_2}


@pytest.mark.parametrize(("row", "taken"), [("BG", "BE"), ("CF", "AF"), ("AH", "AE"), ("BE", "AF")])
def test_one_row_taken_for_another_is_caught(
    row: str, taken: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Mistaken:
        def decide(self, sign: Callable[[str], int]) -> tuple[Row, Signs]:
            right, signs = PROBLEM_2.decide(sign)
            return ROWS[taken if right.name == row else right.name], signs

    monkeypatch.setattr(traces, "PROBLEM_2", Mistaken())
    assert caught([*sample(96, 22), UP]) > 0


def first_piece_only(one: Intervals, two: Intervals) -> Intervals:
    return intervals.subtract(one, two)[:1]


def unmerged(lists: list[Intervals]) -> Intervals:
    return tuple(sorted(interval for intervals in lists for interval in intervals))


def open_ended(one: Intervals, two: Intervals) -> Intervals:
    return tuple(i for i in intervals.subtract(one, two) if i[0] not in dict(two).values())


@pytest.mark.parametrize(
    ("boolean", "fault", "shown_by"),
    [
        ("subtract", first_piece_only, HOLLOW),
        ("subtract", open_ended, HOLLOW),
        ("union", unmerged, TWO),
        ("intersection", lambda lists: lists[0], TWO),
    ],
)
def test_one_wrong_boolean_is_caught(
    boolean: str,
    fault: Callable[..., Intervals],
    shown_by: Query,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(traces, boolean, fault)
    assert caught([*sample(96, 23), shown_by]) > 0


def test_undecided_is_counted_as_such() -> None:
    summary = Summary()
    checked = replace(
        check(HOLLOW, []), testimonies=(("enclosure", Testimony("undecided", "", "too near"), 0.5),)
    )
    summary.add(checked)
    tally = summary.scores["enclosure"]
    assert tally.outcomes == {"undecided": 1}
    assert tally.undecided == {"too near": 1}
    assert (tally.seconds, summary.differing) == (0.5, [])


def test_a_witness_that_contradicts_itself_disagrees(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> Testimony:
        raise ZeroDivisionError("1/0")

    monkeypatch.setattr(crosschecks, "load", lambda name: broken)
    checked = check(HOLLOW, ["definition"])
    assert checked.disagreed
    assert "contradicts itself: ZeroDivisionError: 1/0" in checked.testimonies[0][1].why


def test_workers_find_the_same_in_the_same_order() -> None:
    questions = sample(40, 24)
    alone = list(crosscheck(questions, ("definition",), 1))
    shared = list(crosscheck(questions, ("definition",), 2))
    assert [c.query for c in shared] == questions
    assert [c.answer for c in shared] == [c.answer for c in alone]


def test_registry_has_the_witnesses_of_the_command() -> None:
    assert tuple(WITNESSES) == NAMES
    assert all(callable(load(name)) for name in NAMES)


def run(*arguments: str, given: str | None = None) -> tuple[int, str]:
    result = CliRunner().invoke(command, list(arguments), input=given, terminal_width=100)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.output


ONLY = ("--witness", "definition", "--witness", "enclosure", "--workers", "1")


def test_command_counts_agreement() -> None:
    status, output = run("--fresh", "8", *ONLY)
    assert status == 0
    lines = [line.split()[:4] for line in output.splitlines() if line.strip()]
    assert ["definition", "8", "0", "0"] in lines
    assert ["enclosure", "8", "0", "0"] in lines


def test_command_prints_a_disagreement_and_how_to_repeat_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    case = (
        '{"id":"case-1","solid":{"type":"slab","p":[0.0,0.0,1.0],"q":[0.0,0.0,2.0]},'
        '"ray":{"origin":[0.0,0.0,0.0],"direction":[0.0,0.0,1.0]}}'
    )
    monkeypatch.setattr(traces, "_slab", lambda *_: ((ZERO, ZERO),))
    status, output = run("--case", "-", *ONLY, given=case)
    assert status == 1
    assert "case-1: the oracle and a witness differ" in output
    assert "oracle      [[0, 0]]" in output
    assert "definition  [[1, 2]]" in output
    assert "enclosure   [[1.0, 2.0]]" in output
    again = "raycert crosscheck --witness definition --witness enclosure --case - <<< "
    assert f"{again}'{case}'" in output


NO_RADIUS = '{"solid": {"type": "sphere", "center": [0, 0, 0]}, "ray": '
NO_RADIUS += '{"origin": [0, 0, 0], "direction": [1, 0, 0]}}'


def test_command_refuses_what_is_no_case() -> None:
    status, output = run("--case", "-", *ONLY, given=NO_RADIUS)
    assert status == 2
    assert "solid.radius: is missing" in output
    assert run("--case", "-", *ONLY, given="{")[0] == 2
    assert run("--fresh", "5", "--family", "far", *ONLY)[0] == 2
    assert run("--family", "no-such-family", *ONLY)[0] == 2


def test_command_names_the_extra_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(WITNESSES, "symbols", "no_such_module:witness")
    status, output = run("--fresh", "5")
    assert status == 3
    assert 'symbols needs no_such_module: pip install "raycert[symbols]"' in output


@pytest.mark.parametrize("precision", ["binary64", "binary32"])
def test_every_golden_row_has_the_word_of_a_witness_as_it_is_now(precision: str) -> None:
    """When it was written it had the word of all: now of one, the next row of the other."""
    turns = cycle(map(load, ("definition", "enclosure")))
    found = {
        row.id: witness(row.solid, row.ray, trace(row.solid, row.ray).intervals)
        for row, witness in zip(golden(precision).rows, turns, strict=False)
    }
    assert {id: v for id, v in found.items() if v.outcome != "agreed"} == {}
    assert len(found) > 5000
