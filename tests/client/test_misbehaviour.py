"""What a target may do, and what is said of it: the table on the chapter's page, line by line."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from raycert.cases.model import Cylinder, Ray
from raycert.oracle.client.dialogue import Limits, Outcome, Question, Unusable, silence
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import Changed, Run, run
from raycert.oracle.client.target import target
from shared.places import CLIENTS, TESTS

CAN = Cylinder((0, 0, 0), (0, 0, 1), 1)
SHORT = Limits(hello=2.0, case=0.3)
PAGE = TESTS.parent / "oracle" / "client" / "README.md"


@dataclass(frozen=True)
class Line:
    """A line of the table: its first two columns, the client, and what has to be told of it."""

    misbehaviour: str
    verdict: str
    words: tuple[str, ...]
    tells: str = ""
    most: int = 300
    """Characters that are kept of it, in all."""
    limits: Limits = SHORT


def pipe(name: str, *words: str) -> tuple[str, ...]:
    return (sys.executable, str(CLIENTS / f"{name}.py"), *words)


LOADED = "(loaded code)"
LINES = (
    Line("ends, crashes or is killed", "crash", pipe("faulty", "crash=3"), "exit status 3"),
    Line("does not answer in time", "hang", pipe("faulty", "hang=3"), "no answer for 0.3 s"),
    Line("never reads its input", "hang", pipe("deaf"), "no answer"),
    Line("writes no newline, or does not flush", "hang", pipe("faulty", "no-newline=3"), "newline"),
    Line("ends in the middle of a line", "crash", pipe("faulty", "half=3"), "middle of a line"),
    Line("writes what is no answer", "bad-line", pipe("raw", "not-json"), "is not JSON"),
    Line("writes a line of more than 1 MiB", "bad-line", pipe("raw", "million"), "1048576 bytes"),
    Line("writes more than its answer", "bad-line", pipe("faulty", "after=3"), "traced one more"),
    Line("gives back another id", "wrong-id", pipe("faulty", "wrong-id=3"), "'something'"),
    Line("gives more pairs than an answer may have", "malformed", pipe("raw", "many"), "20 is the"),
    Line("gives NaN, a negative or an unordered list", "answered", pipe("raw", "nan")),
    Line("gives a reason, an error or `unsupported`", "refused",
         pipe("raw", "reason"), "(900000 characters)", 1100),
    Line("fails, but not when it is asked alone", "unrepeatable", pipe("counted"), "ended with"),
    Line("fails on 50 questions in a row, or is silent for 600 s", "given up",
         pipe("faulty", "crash=1"), "in a row", 400, Limits(case=0.3, in_a_row=2)),
    Line("floods its standard error", "answered", pipe("noisy")),
    Line("says more after its last answer", "bad-line", pipe("farewell", "bye"), "'bye'"),
    Line("ends with another exit status, or not at all", "a note", pipe("farewell", "3"), "3"),
    Line("starts processes that leave its session", "answered",
         pipe("family", os.devnull, "escapes")),
    Line("gives no hello, or a bad one", "cannot be run", pipe("hello", "banner"), "Tracer", 500),
    Line("gives another hello when it is started again", "the run ends, exit 3",
         pipe("once", "FILE", "another"), 'at first, and {"name": "another"}', 400),
    Line("declares a name of more than 1000 characters", "cannot be run",
         pipe("hello", "long"), "hello.name has more than 1000", 600),
    Line(f"returns what is no answer {LOADED}", "bad-line", ("planted:silly",), "the str 'xx"),
    Line(f"returns an endless list {LOADED}", "malformed", ("planted:endless",), "20 is the most"),
    Line("says that it has 2^30 pairs (library)", "malformed", ("./flood.so",), "1073741824"),
    Line(f"raises an exception {LOADED}", "refused",
         ("planted:fails",), "ValueError: xx", 1100),
    Line(f"prints {LOADED}", "answered", ("planted:talks",)),
    Line(f"writes into our pipe {LOADED}", "crash", ("planted:spoils",), "spoiled", 400),
)  # fmt: skip


def questions(count: int) -> list[Question]:
    return [Question(f"family/{n}", CAN, Ray((n, 0, 0), (0, 0, 1))) for n in range(count)]


def asked(line: Line, folder: Path) -> Run:
    words = [str(folder / "file") if word == "FILE" else word for word in line.words]
    if words == ["./flood.so"]:
        words = [library(folder)]
    return run(target(words), questions(12 if line.verdict == "unrepeatable" else 5), line.limits)


def library(folder: Path) -> str:
    if shutil.which("cc") is None:
        pytest.skip("cc is not installed")
    source, built = folder / "flood.c", folder / "flood.so"
    source.write_text("int raycert_intersect() { return 1 << 30; }\n")
    subprocess.run(["cc", "-shared", "-fPIC", "-w", "-o", built, source], check=True)
    return str(built)


def said(result: Run) -> tuple[str, str]:
    """Return the verdict on the run and its words: those of the first outcome that is no answer."""
    if result.notes:
        [note] = result.notes
        return ("given up", last(result)) if note.startswith("given up") else ("a note", note)
    for outcome in result.outcomes.values():
        if quiet := silence(outcome):
            kind, words = quiet
            return ("refused" if kind in ("error", "unsupported") else kind), words
    return "answered", ""


def last(result: Run) -> str:
    *_, outcome = result.outcomes.values()
    assert isinstance(outcome, Failure)
    return outcome.detail


@pytest.mark.parametrize("line", LINES, ids=lambda line: line.misbehaviour)
def test_what_a_target_may_do(line: Line, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(CLIENTS)
    monkeypatch.syspath_prepend("")
    try:
        result = asked(line, tmp_path)
    except Changed as error:
        verdict, words = "the run ends, exit 3", str(error)
    except Unusable as error:
        verdict, words = "cannot be run", str(error)
    else:
        verdict, words = said(result)
        assert len(result.outcomes) >= 5
        assert all(kept(outcome) <= line.most for outcome in result.outcomes.values())
    assert verdict == line.verdict
    assert line.tells in words
    assert len(words) <= line.most


def kept(outcome: Outcome) -> int:
    """Return how many characters or numbers are kept of an outcome."""
    if isinstance(outcome, Failure):
        return len(outcome.detail)
    return len(str(outcome.error or outcome.unsupported or "")) + 2 * len(outcome.intervals or ())


def test_the_page_lists_the_lines_in_this_order() -> None:
    table = PAGE.read_text("utf-8").partition("## What a run takes")[0]
    rows = [line.split(" | ") for line in table.splitlines() if "|" in line]
    listed = [(cells[0].removeprefix("| "), cells[1]) for cells in rows[2:]]
    assert listed == [(line.misbehaviour, line.verdict) for line in LINES]
