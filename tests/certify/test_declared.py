"""What is declared, and where it holds: domains, degenerate inputs, conventions, hello files."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import Any
from zlib import crc32

import pytest
from click.testing import CliRunner, Result

from raycert.cases.accept import Numbers
from raycert.cases.degenerate import DEGENERACIES, degenerate
from raycert.cases.domain import Domain, quantities
from raycert.cases.files import BadFile
from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade, usual
from raycert.oracle.certify.known import failed_level
from raycert.oracle.certify.verdict import Tally, Touches, by_solid, verdict
from raycert.oracle.client.declared import Declared, read_declared
from raycert.oracle.client.dialogue import Command, Unusable
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.client.replay import greet
from raycert.oracle.commands.main import main
from raycert.oracle.reports.markdown import markdown
from raycert.oracle.zoo.inhabitants import FAULTS
from raycert.oracle.zoo.matrix import Outcome
from shared.certificates import made
from shared.corpus import golden

CLIENTS = Path(__file__).parents[1] / "clients"
NEARSIGHTED = ("--", sys.executable, str(CLIENTS / "nearsighted.py"), "sphere")


@pytest.fixture(autouse=True)
def elsewhere(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)


def run(*options: str) -> Result:
    return CliRunner().invoke(main, ["certify", "--out", "c.json", "--force", *options])


def form() -> dict[str, Any]:
    read: dict[str, Any] = json.loads(Path("c.json").read_text())
    return read


def test_the_measured_domain_is_written_read_and_granted() -> None:
    """The whole way of a tracer that is right but for starts beyond 1e6 sizes."""
    refused = run("--write-domain", "hello.json", *NEARSIGHTED)
    assert refused.exit_code == 1, refused.output
    text = " ".join(refused.output.split())
    assert "sound for starts within 1e6 sizes; first failure beyond:" in text
    assert json.loads(Path("hello.json").read_text()) == {"domain": {"distance": 1e6}}
    granted = run("--level", "stable", "--hello", "hello.json", *NEARSIGHTED)
    assert granted.exit_code == 0, granted.output
    text = " ".join(granted.output.split())
    assert "nearsighted is granted stable and closed, for starts within 1e6 sizes" in text
    certificate = form()
    assert certificate["granted"]
    assert certificate["overridden"] == ["domain"]
    assert certificate["subject"]["domain"] == {"distance": 1e6}
    assert certificate["solids"]["sphere"]["outside"]["sound"]["wrong"] > 0
    assert "--hello hello.json" in certificate["reproduce"]
    assert "outside the domain: " in text


@pytest.mark.parametrize("name", ["hello.json", "hello.toml"])
def test_a_file_overrides_the_hello_field_by_field(name: str) -> None:
    text = {
        "hello.json": '{"hello": 1, "version": "9", "tolerance": {"relative": 0.25}}',
        "hello.toml": 'version = "9"\ntolerance = {relative = 0.25}\n',
    }
    Path(name).write_text(text[name])
    target = Command(NEARSIGHTED[1:])
    said = greet(target)
    given = greet(Declared(target, read_declared(Path(name)), name))
    assert given == replace(said, version="9", tolerance=given.tolerance)
    assert given.tolerance.relative == 0.25


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("a.json", "[]", "is not an object"),
        ("a.json", '{"hello": 2}', "hello is not 1"),
        ("a.json", '{"speed": 1}', "hello.speed is not a field"),
        ("a.json", '{"domian": {}}', "did you mean domain?"),
        ("a.json", '{"domain": {"size": [2, 1]}}', "hello.domain.size has its low bound above"),
        ("a.toml", "domain = 1\n", "hello.domain is not an object of bounds"),
        ("a.toml", "domain = \n", "is not TOML"),
    ],
)
def test_a_file_that_is_no_hello_is_refused_before_the_run(name: str, text: str, says: str) -> None:
    Path(name).write_text(text)
    with pytest.raises(BadFile, match=says):
        read_declared(Path(name))
    result = run("--hello", name, "reference")
    assert result.exit_code == 2
    assert says in result.output
    assert result.output.count(name) == 1


def test_how_code_answers_is_not_for_a_file_to_say(monkeypatch: pytest.MonkeyPatch) -> None:
    target = InProcess("callable", "raycert.reference.tracer:intersect")
    with pytest.raises(Unusable, match="answers is for the code itself to declare"):
        greet(Declared(target, {"answers": "first"}, "a.json"))
    assert greet(Declared(target, {"name": "other"}, "a.json")).name == "other"


# In process: rows, and who answers them.


@cache
def rows() -> tuple[GoldenRow, ...]:
    """Return some rows of all kinds, those that are degenerate, and a third of the touches."""
    return tuple(
        row
        for i, row in enumerate(golden().rows)
        if i % 29 == 0
        or degenerate(row.solid, row.ray)
        or (i % 3 == 0 and row.tier == "lattice" and any(span.touch for span in row.intervals))
    )


def graded(hello: Hello, answer: Callable[[GoldenRow], Reply] | None = None) -> list[Grade]:
    answer = answer or (lambda row: Reply(row.id, intervals=row.expected))
    return [grade(row, answer(row), hello) for row in rows()]


def resting(row: GoldenRow) -> Reply:
    """Refuse the zero direction, as 21 of 33 libraries do; the rest is right."""
    if any(row.ray.direction):
        return Reply(row.id, intervals=row.expected)
    return Reply(row.id, error="ValueError: zero direction")


def test_degenerate_inputs_count_where_they_are_declared() -> None:
    silent, bold = Hello("x"), Hello("x", degenerate=DEGENERACIES)
    assert verdict(graded(silent, resting), "exact", "closed").granted
    refused = verdict(graded(bold, resting), "sound", "closed")
    assert not refused.granted
    assert all("of them refused" in reason for reason in refused.reasons)
    for g in graded(silent, resting):
        assert (g.place == "degenerate") == bool(degenerate(g.row.solid, g.row.ray))
    told = made(lambda row, n: resting(row), rows=rows())
    kinds = told["solids"]["sphere"]["degenerate"]
    rest = kinds["zero_direction"]
    assert rest["rows"] == rest["refused"] > 0
    assert kinds["zero_radius"]["answered"] > 0
    assert told["granted"]
    assert "zero direction, not declared" in markdown(told)


def test_refusals_are_counted_apart() -> None:
    def answer(row: GoldenRow) -> Reply:
        known = quantities(row.solid, row.ray).distance
        if known and known > 100:
            return Reply(row.id, unsupported="too far")
        return Reply(row.id, intervals=row.expected if known and known < 10 else ())

    for group in by_solid(graded(Hello("x"), answer)):
        tally = Tally.of(group.grades, "sound")
        quiet = [g for g in usual(group.grades) if g.refused]
        assert tally.refused == len(quiet)
        assert {g.fare("sound") for g in quiet} <= {"refused"}
        assert tally.failed >= tally.refused


@pytest.mark.parametrize("planted", FAULTS[::4], ids=lambda fault: fault.name)
def test_a_domain_of_the_usual_hides_no_fault(planted: Any) -> None:
    """What is refused at home without a domain is refused with that of a usual library."""
    home = [row for row in golden().rows if row.family == planted.home]
    usual_domain = Domain((1e-300, None), (1e-300, None), 1e300, 1e300, 1e300)
    hello = Hello("x", degenerate=DEGENERACIES, domain=usual_domain)
    tracer, faults = planted.make(), []
    for row in home:
        said = Outcome.of(tracer, row, hello.format)
        reply = (
            Reply(row.id, error="crash")
            if said.answer is None
            else Reply(row.id, intervals=said.answer)
        )
        faults.append(failed_level(grade(row, reply, hello), "exact"))
    assert any(faults) or planted.granted


def test_whoever_keeps_half_the_tangents_can_be_granted() -> None:
    """By rounding: every other touch is kept. Neither closed nor regularized holds, `any` does."""
    turns = iter(range(10**6))

    def half(row: GoldenRow) -> Reply:
        touched = row.tier == "lattice" and any(span.touch == "tangent" for span in row.intervals)
        drop = touched and len(row.expected) == 1 and next(turns) % 2
        kept: Numbers = () if drop else row.expected
        return Reply(row.id, intervals=kept)

    grades = graded(Hello("x", convention="closed but any tangent"), half)
    for wanted, granted in (
        ("closed", False),
        ("regularized", False),
        ("closed but tangent", False),
        ("closed but any tangent", True),
        ("any", True),
    ):
        assert verdict(grades, "exact", wanted).granted == granted, wanted
    mixed = [t for g in by_solid(grades) if "any" in (t := Touches.of(g.grades)).name]
    assert mixed
    for touches in mixed:
        assert touches.follows(touches.name)
        assert "kept" in touches.told
    assert not [g for g in usual(grades) if g.fault("exact")]


def dropping(quarters: int, row: GoldenRow) -> Reply:
    """Drop so many quarters of the touches."""
    spans = zip(row.expected, row.intervals, strict=False)
    kept = (
        pair for pair, span in spans if not span.touch or crc32(row.id.encode()) % 4 >= quarters
    )
    return Reply(row.id, intervals=tuple(kept))


def test_every_convention_that_is_told_can_be_asked_for() -> None:
    hello = Hello("x")
    for drop in range(5):
        grades = graded(hello, partial(dropping, drop))
        for group in by_solid(grades):
            touches = Touches.of(group.grades)
            assert touches.name == "not tested" or touches.follows(touches.name)


def test_rows_outside_fail_nothing_and_are_told() -> None:
    hello = Hello("x", domain=Domain(distance=10.0), degenerate=DEGENERACIES)

    def answer(row: GoldenRow) -> Reply:
        near = hello.domain.holds(quantities(row.solid, row.ray))
        return Reply(row.id, intervals=row.expected if near else ((1e300, 1.5e300),))

    grades = graded(hello, answer)
    judged = verdict(grades, "stable", "closed", hello.domain.words())
    assert judged.granted, judged.reasons
    assert any(g.place == "outside" and g.fare("stable") == "wrong" for g in grades)
    assert all(failed_level(g, "exact") is None for g in grades)
    wrong = [grade(row, Reply(row.id, intervals=((1e300, 1.5e300),)), hello) for row in rows()]
    reasons = verdict(wrong, "stable", "closed", hello.domain.words()).reasons
    assert all("sound, for starts within 10 sizes, fails on" in r for r in reasons if "fails" in r)
