"""Errors on many cores are those of one, in the same order, whatever becomes of the processes."""

from collections.abc import Callable, Iterator
from concurrent.futures.process import BrokenProcessPool
from typing import Any

import pytest

from raycert.cases.protocol import Hello, Reply
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.measured import measured
from raycert.oracle.zoo.inhabitants import BY_NAME
from shared.corpus import golden

WHERE = "raycert.oracle.certify.measured"


def graded() -> list[Grade]:
    """Return grades of which many fail; some without an answer, some malformed."""
    tracer, rows = BY_NAME["minus-forgotten"].make(), golden().rows[::32]
    replies = [Reply("0", intervals=tuple(tracer(row.solid, row.ray))) for row in rows]
    replies[::9] = [Reply("0", error="no")] * len(replies[::9])
    replies[1::9] = [Reply("0", intervals=((-1.0, 2.0),))] * len(replies[1::9])
    return [grade(row, reply, Hello("x")) for row, reply in zip(rows, replies, strict=True)]


def errors(grades: Iterator[Grade]) -> list[tuple[str, Any]]:
    return [(g.row.id, g.measure() if g.faults else None) for g in grades]


@pytest.fixture
def alone() -> list[tuple[str, Any]]:
    return errors(measured(graded()))


def test_processes_measure_what_one_measures(
    alone: list[tuple[str, Any]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"{WHERE}.MANY", 1)
    monkeypatch.setattr(f"{WHERE}.cores", lambda: 2)
    some = graded()

    def moved(*_: object) -> None:
        raise AssertionError("it is measured here")

    monkeypatch.setattr("raycert.oracle.judge.levels.Judge.moved", moved)
    assert errors(measured(some)) == alone


class Dying:
    """Processes of which the one that has done `after` ends."""

    after = 5

    def __init__(self, count: int) -> None:
        assert count > 1

    def __enter__(self) -> "Dying":
        return self

    def __exit__(self, *_: object) -> None: ...

    def map(self, call: Callable[..., Any], *some: Any, chunksize: int) -> Iterator[Any]:
        for i, each in enumerate(zip(*some, strict=True)):
            if i == self.after:
                raise BrokenProcessPool
            yield call(*each)


def test_what_lost_processes_leave_is_measured_here(
    alone: list[tuple[str, Any]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"{WHERE}.MANY", 1)
    monkeypatch.setattr(f"{WHERE}.cores", lambda: 2)
    monkeypatch.setattr(f"{WHERE}.Workers", Dying)
    assert errors(measured(graded())) == alone


def test_few_failures_start_no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(f"{WHERE}.Workers")
    assert len(list(measured(graded()))) == len(graded())
