"""The pipeline: what it asks, what it keeps when it is cut short, what it refuses to begin."""

import json
import os
import shutil
import signal
import sys
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from raycert.cases.corpus import GOLDEN, MANIFEST, manifest
from raycert.cases.model import Sphere
from raycert.oracle.certify.known import Expectation, Expectations
from raycert.oracle.certify.run import (
    BLOCK,
    NotInCorpus,
    Plan,
    Unsuitable,
    Watch,
    certify,
    conduct,
    prepare,
)
from raycert.oracle.certify.selection import Selection, Shard
from raycert.oracle.certify.verdict import by_family
from raycert.oracle.client.dialogue import Limits, Unusable
from raycert.oracle.client.replay import Changed
from raycert.oracle.client.target import target
from raycert.oracle.commands.main import main
from raycert.oracle.corpus.fresh import Fresh
from shared.corpus import golden

GOOD = (sys.executable, "-m", "raycert.reference")
FEW = Selection(families=("rim", "far-deep"))


def planted(folder: Path, tracer: str, hello: str = "'planted'") -> tuple[str, ...]:
    """Write a program that serves an expression: one of the zoo's tracers, or a function."""
    script = folder / "client.py"
    script.write_text(
        "from raycert.oracle.zoo.inhabitants import BY_NAME\n"
        "from raycert.cases.protocol import Hello\n"
        "from raycert.cases.protocol import serve\n"
        f"serve({tracer}, Hello({hello}))\n"
    )
    return (sys.executable, str(script))


def test_a_good_target_is_granted() -> None:
    result = certify(Plan(GOOD, level="stable", selection=FEW))
    assert result.verdict.granted
    assert {group.name for group in by_family(result.grades)} == {"rim", "far-deep"}
    assert not result.ran.interrupted
    form = result.form(("reference",))
    assert form["passed"]
    assert not form["granted"], "a part is no certificate"
    assert form["reproduce"].endswith("--family rim --family far-deep reference")


def test_shards_part_the_run_and_none_is_a_certificate() -> None:
    whole = prepare(Plan(GOOD, selection=FEW))
    parts = [
        prepare(Plan(GOOD, selection=replace(FEW, shard=Shard(number, 3)))) for number in (1, 2, 3)
    ]
    ids = [row.id for part in parts for row in part.rows]
    assert sorted(ids) == sorted(row.id for row in whole.rows)
    alone = Plan(GOOD, selection=Selection(solids=("slab",), shard=Shard(1, 40)))
    form = certify(alone).form(("reference",))
    assert form["passed"]
    assert not form["granted"]
    assert "--shard 1/40" in form["reproduce"]


def test_fresh_rows_are_asked_beside_the_golden_ones() -> None:
    plan = Plan(GOOD, level="stable", selection=Selection(families=("rim", "fresh-5")))
    result = certify(replace(plan, fresh=Fresh(5, 30)))
    assert sum(g.row.family == "fresh-5" for g in result.grades) == 30
    assert result.verdict.granted
    form = result.form(("reference",))
    assert form["fresh"] == {"seed": 5, "rows": 30}
    assert "--seed 5 --fresh 30" in form["reproduce"]
    assert not form["granted"]


def test_the_corpus_is_counted_whole_and_read_in_part(tmp_path: Path) -> None:
    (tmp_path / "golden").symlink_to(GOLDEN)
    command = planted(tmp_path, "BY_NAME['no-clip'].make()", "'ball', solids=('sphere',)")
    plan = Plan(command, selection=Selection(families=("sphere-far",)), golden=tmp_path / "golden")
    prepared = prepare(plan)
    assert {type(row.solid) for row in prepared.corpus.rows} == {Sphere}
    assert certify(plan).form(command)["corpus"]["rows"] == len(golden().rows)


def test_only_keeps_some_families() -> None:
    whole = prepare(Plan(GOOD, selection=FEW))
    part = whole.only(("rim",))
    assert {row.family for row in part.rows} == {"rim"}
    assert len(part.rows) + part.left.rows == len(whole.rows) + whole.left.rows
    assert part.known == whole.known


def test_fail_fast_ends_soon_and_says_so(tmp_path: Path) -> None:
    command = planted(tmp_path, "BY_NAME['no-clip'].make()")
    plan = Plan(command, selection=Selection(solids=("cylinder",)), fail_fast=True)
    result = certify(plan)
    assert len(result.grades) == BLOCK
    assert result.ran.interrupted
    assert any("the first row that fails" in note for note in result.ran.notes)
    form = result.form(command)
    assert not form["granted"]
    assert not form["passed"]


def test_fail_fast_asks_everything_of_a_good_target() -> None:
    selection = Selection(families=("rim", "far-deep", "behind", "start-inside"))
    plan = Plan(GOOD, level="stable", selection=selection, fail_fast=True)
    result = certify(plan)
    assert result.verdict.granted
    assert not result.ran.interrupted
    assert len(result.grades) == len(prepare(plan).rows) > BLOCK


def test_an_interruption_keeps_what_is_known() -> None:
    """The signal comes once some rows are judged."""

    @contextmanager
    def counting(verb: str, _: int) -> Any:
        done = 0

        def advance(n: int = 1) -> None:
            nonlocal done
            done += n
            if verb == "judging" and done == 20:
                os.kill(os.getpid(), signal.SIGINT)

        yield advance

    result = conduct(prepare(Plan(GOOD, level="stable", selection=FEW)), Watch(counting))
    assert result.ran.interrupted
    assert 15 < len(result.grades) < 40
    assert not result.form(("reference",))["passed"]


def test_an_interruption_while_asking_keeps_what_is_known() -> None:
    @contextmanager
    def counting(verb: str, _: int) -> Any:
        def advance(n: int = 1) -> None:
            if verb == "asking" and n:
                raise KeyboardInterrupt

        yield advance

    plan = Plan(GOOD, selection=FEW, limits=Limits(window=8))  # not all answered at one look
    result = conduct(prepare(plan), Watch(counting))
    assert result.ran.interrupted
    assert len(result.grades) < len(result.prepared.rows)


def test_what_the_adapter_does_wrong_is_noted_at_once(tmp_path: Path) -> None:
    said: list[str] = []
    swap = "lambda solid, ray: [(b, a) for a, b in BY_NAME['swapped'].make()(solid, ray)][:0]"
    plan = Plan(planted(tmp_path, swap), selection=Selection(families=("rim",)))
    result = certify(plan, Watch(note=said.append))
    assert any("a miss" in line for line in said)
    assert set(said) <= set(result.ran.notes)


def test_the_likely_fault_is_named(tmp_path: Path) -> None:
    plan = Plan(
        planted(tmp_path, "BY_NAME['no-clip'].make()"),
        selection=Selection(families=("behind", "rim", "start-inside")),
    )
    result = certify(plan)
    assert "no-clip" in str(result.ran.diagnosis["likely"])


def test_expected_failures_are_accepted_and_no_others(tmp_path: Path) -> None:
    """The roundtrip a person makes: record, accept, repair, be told."""
    selection = Selection(families=("rim", "behind"))
    bad = certify(Plan(planted(tmp_path, "BY_NAME['no-clip'].make()"), selection=selection))
    assert not bad.verdict.granted
    recorded = bad.recorded()
    assert bad.matched(recorded).accepted
    assert not bad.matched(Expectations()).accepted
    good = certify(Plan(GOOD, selection=selection))
    assert len(good.matched(recorded).unexpected_passes) == len(recorded.entries)
    outside = Expectations((Expectation("family", "needle", "why"),))
    assert good.matched(outside).accepted, "outside the selection is not unmatched"


def test_what_cannot_be_begun_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Unusable):
        certify(Plan(("no-such-program-anywhere",)))
    with pytest.raises(NotInCorpus, match="no-such-family"):
        certify(Plan(GOOD, selection=Selection(families=("no-such-family",))))
    trees = planted(tmp_path, "None", "'trees', solids=('union',)")
    with pytest.raises(Unsuitable, match="declares union"):
        certify(Plan(trees))


def test_not_one_easy_case_answered_is_nothing_tested(tmp_path: Path) -> None:
    mute = planted(tmp_path, "lambda solid, ray: __import__('os')._exit(3)")
    with pytest.raises(Unsuitable, match="none of the easy cases"):
        certify(Plan(mute, limits=Limits(case=2.0)))


def test_an_empty_corpus_is_blamed_on_the_corpus(tmp_path: Path) -> None:
    (tmp_path / MANIFEST).write_bytes(manifest({}))
    with pytest.raises(Unsuitable, match="no rows in binary64"):
        prepare(Plan(GOOD, golden=tmp_path))


def test_another_corpus_is_named_in_the_command_that_repeats(tmp_path: Path) -> None:
    shutil.copytree(GOLDEN, tmp_path / "golden")
    result = certify(Plan(GOOD, golden=tmp_path / "golden", selection=Selection(families=("rim",))))
    assert (
        f"--golden {tmp_path / 'golden'} --family rim" in result.form(("reference",))["reproduce"]
    )


TURNCOAT = """
import os, pathlib, sys
from raycert.cases.protocol import Hello, serve
from raycert.reference import tracer
starts = pathlib.Path(__file__).with_name("starts")
start = len(starts.read_text()) + 1 if starts.exists() else 1
starts.write_text("x" * start)
name = "another" if start >= AT else "honest 1.0"
hello, calls = {"name": name}, [0]

def intersect(solid, ray):
    calls[0] += 1
    if start == 3 and calls[0] == 70:
        os._exit(5)
    return tracer.intersect(solid, ray)

if __name__ == "__main__":
    serve(intersect, Hello(name))
"""
"""Is another target from start AT on; crashes once in its third start, which is asked the rows."""


@pytest.fixture(params=["program", "function"])
def turncoat(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[int], tuple[str, ...]]:
    monkeypatch.chdir(tmp_path)

    def turning(at: int) -> tuple[str, ...]:
        (tmp_path / "turncoat.py").write_text(TURNCOAT.replace("AT", str(at), 1))
        program = sys.executable, str(tmp_path / "turncoat.py")
        return program if request.param == "program" else ("turncoat:intersect",)

    return turning


@pytest.mark.parametrize("at", [2, 3])
def test_a_target_that_becomes_another_before_the_rows_is_not_tested(
    turncoat: Callable[[int], tuple[str, ...]], at: int
) -> None:
    with pytest.raises(Changed, match=r'"honest 1\.0".* at first, and .*"another"'):
        certify(Plan(target(turncoat(at)), selection=FEW))


def test_a_target_that_becomes_another_ends_the_run_and_what_is_graded_is_kept(
    turncoat: Callable[[int], tuple[str, ...]], tmp_path: Path
) -> None:
    out = tmp_path / "c.json"
    words = ["certify", "--family", "rim", "--out", str(out), "--", *turncoat(4)]
    ended = CliRunner().invoke(main, words)
    assert ended.exit_code == 3, ended.output
    assert '{"name": "honest 1.0"} at first, and {"name": "another"}' in ended.stderr
    form = json.loads(out.read_text())
    assert 64 <= form["tested"] < 70, "answers that it had sent, and no others"
    assert form["run"]["interrupted"]
    assert not form["passed"]
    assert any("became another" in note for note in form["run"]["notes"])


@pytest.mark.parametrize("last", ["range", "generic"])
def test_a_farewell_refuses_whatever_row_is_the_last(last: str, tmp_path: Path) -> None:
    script = tmp_path / "client.py"
    script.write_text(
        "from raycert.cases.protocol import Hello, serve\n"
        "from raycert.reference.tracer import intersect\n"
        "serve(intersect, Hello('polite'))\nprint('bye')\n"
    )
    rows = prepare(Plan(GOOD, selection=Selection(solids=("sphere",)))).rows
    ends = {row.tier: row for row in rows}
    asked = prepare(Plan((sys.executable, str(script)), selection=FEW))
    two = sorted((ends["range"], ends["generic"]), key=lambda row: row.tier == last)
    result = conduct(replace(asked, rows=tuple(two)))
    assert not result.verdict.granted
    [grade] = [g for g in result.grades if g.faults]
    assert "bye" in grade.faults["sound"]
    assert grade.row.tier == "generic"
