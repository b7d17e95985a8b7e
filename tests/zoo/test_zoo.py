"""Every fault of the zoo is refused for its own reason; a sound tracer gets what it deserves."""

from __future__ import annotations

import ast
import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner

from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.verdict import Touches, by_solid
from raycert.oracle.commands.zoo import zoo
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo import inhabitants
from raycert.oracle.zoo.inhabitants import (
    BY_NAME,
    CATALOGUE,
    FAULTS,
    PROCESS,
    SOUND,
    ProcessFault,
    Sound,
)
from raycert.oracle.zoo.matrix import Outcome, Trials, kind, line
from raycert.oracle.zoo.tracer import BASE, Fault, fault
from shared.corpus import golden
from shared.places import TESTS

HARMLESS = fault("harmless", "does nothing wrong", "nowhere", "behind", "missed")


JUDGE = cache(Judge)


@pytest.fixture(autouse=True)
def each_row_has_one_judge(monkeypatch: pytest.MonkeyPatch) -> None:
    """The exact list of a row is computed once, not for every tracer."""
    monkeypatch.setattr("raycert.oracle.certify.grading.Judge", JUDGE)


@cache
def bench() -> Trials:
    return Trials(golden().rows, golden().format)


def test_the_zoo_is_large_and_each_name_is_one():
    assert len(FAULTS) >= 50
    assert len(BY_NAME) == len(FAULTS)
    sentences = [animal.does for animal in (*FAULTS, *SOUND, *PROCESS)]
    assert len(set(sentences)) == len(sentences)
    for text in sentences:
        assert text[0].islower(), text
        assert not text.endswith("."), text
        assert len(text) <= 80, text
    assert all(animal.origin for animal in FAULTS)


@cache
def family(name: str) -> Trials:
    return Trials([row for row in golden().rows if row.family == name], golden().format)


@pytest.mark.parametrize("planted", CATALOGUE, ids=lambda f: f.name)
def test_a_fault_is_refused_by_its_home_for_its_own_reason(planted: Fault):
    """Where its home leaves it no level, no other row has a say in what it is granted."""
    found = line(family(planted.home), planted)
    if planted.stateful or found.trouble or found.granted:
        found = line(bench(), planted)
    assert found.trouble is None, {name: dict(n) for name, n in found.families.items()}


def test_no_two_faults_are_the_same():
    """Those that answer a few rows alike are asked more; nobody is asked what tells nothing."""
    alike = [list(FAULTS)]
    for some in (golden().rows[::40], golden().rows[1::5], golden().rows):
        alike = [group for one in alike for group in told_apart(one, some)]
    assert alike == []


def told_apart(faults: list[Fault], rows: Sequence[GoldenRow]) -> list[list[Fault]]:
    """Return the groups of faults that answer all these rows alike."""
    groups: dict[str, list[Fault]] = {}
    for planted in faults:
        tracer = planted.make()
        answers = repr([Outcome.of(tracer, row, golden().format).answer for row in rows])
        groups.setdefault(answers, []).append(planted)
    return [group for group in groups.values() if len(group) > 1]


def graded(sound: Sound) -> list[Grade]:
    """Return the grades of a sound tracer, asked as a client that declares what it is."""
    hello = Hello(sound.name, precision=sound.precision, convention=sound.convention)
    grades = []
    for row in golden(sound.precision).rows:
        outcome = Outcome.of(sound.tracer, row, hello.format)
        if outcome.answer is not None or row.tier != "range":
            assert outcome.answer is not None, (row.id, outcome.error)
            grades.append(grade(row, Reply(row.id, intervals=outcome.answer), hello))
    return grades


@pytest.mark.parametrize("sound", SOUND, ids=lambda s: s.name)
def test_a_sound_tracer_is_granted_what_it_deserves_and_no_more(sound: Sound):
    grades = graded(sound)
    other = dict(sound.but)
    for group in by_solid(grades):
        deserved = other.get(group.name, sound.deserves)
        failed = [g.row.id for g in group.grades if g.fault(deserved) and g.row.tier != "range"]
        assert group.granted() == deserved, (group.name, failed[:8])
    assert Touches.of(grades).name == sound.convention


def test_the_base_is_granted_every_row_the_range_included():
    for row in golden().rows:
        outcome = Outcome.of(BASE, row, golden().format)
        assert outcome.answer is not None, (row.id, outcome.error)
        assert bench().refusal(row, outcome, outcome) is None, row.id


@pytest.mark.parametrize("process", PROCESS, ids=lambda p: p.name)
def test_a_fault_of_a_process_has_its_test(process: ProcessFault):
    path, _, name = process.test.partition("::")
    tree = ast.parse((TESTS.parent / path).read_text())
    assert name in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


@pytest.mark.parametrize(
    ("answer", "expected"),
    [
        (((5.0, 6.0),), "phantom"),
        (((1.0, 2.0), (5.0, 6.0)), "phantom"),
        ((), "missed"),
        (((1.0, 1.1),), "missed"),
        (((1.0, 1.6),), "wrong end"),
        (((1.0, 3.5),), "wrong end"),
        (((1.0, 1.4), (1.5, 2.0)), "count"),
        (((1.0, 1.6), (1.65, 2.0)), "count"),
        (((0.9, 2.0), (2.05, 2.1)), "count"),
    ],
)
def test_how_an_answer_is_wrong(answer: tuple[tuple[float, float], ...], expected: str):
    assert kind([(0.9, 2.1)], [(1.5, 1.7)], answer) == expected


def test_a_fault_that_asks_the_past_is_told_apart():
    kinds = {f.name: line(bench(), f).kind for f in FAULTS if f.stateful}
    assert set(kinds.values()) == {"unrepeated"}


def test_the_command_shows_who_refuses_a_fault(tmp_path: Path):
    out = tmp_path / "matrix.json"
    result = CliRunner().invoke(zoo, ["--fault", "no-clip", "--json", str(out)])
    assert result.exit_code == 0, result.output
    assert "does not cut off what lies at t < 0" in result.output
    (planted,) = json.loads(out.read_text())["faults"]
    assert planted["refused"]["behind"]["sound"] > 10
    assert planted["first"]["id"].startswith("behind/")
    assert max(map(len, result.output.splitlines())) <= 80


def test_the_command_is_loud_about_a_fault_that_nothing_refuses(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(inhabitants.BY_NAME, "harmless", HARMLESS)
    result = CliRunner().invoke(zoo, ["--fault", "harmless"])
    assert result.exit_code == 1
    assert "no golden row refuses it" in result.output


@pytest.mark.parametrize(
    ("planted", "trouble"),
    [
        (HARMLESS, "no golden row refuses it"),
        (fault("x", "x", "x", "behind", "missed", tell=lambda *_: []), None),
        (fault("x", "x", "x", "behind", "phantom", tell=lambda *_: []), "finds missed, not"),
        (fault("x", "x", "x", "table-miss", "missed", tell=lambda *_: []), "does not refuse it"),
        (fault("x", "x", "x", "behind", "missed", "sound", tell=lambda *_: []), "granted None"),
    ],
)
def test_what_is_said_wrongly_of_a_fault_is_noticed(planted: Fault, trouble: str | None):
    found = line(bench(), planted).trouble
    assert trouble in found if trouble and found else found is trouble


def test_bad_usage_says_what_is_wrong():
    result = CliRunner().invoke(zoo, ["--fault", "no-such-fault"])
    assert result.exit_code == 2
    assert "no-such-fault" in result.output
