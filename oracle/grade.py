"""One row, one outcome: which levels it passes, and how far the answer is from the exact one.

Levels are decided by the row's own lists, as any reader could; the measured errors come from the
exact judge. A failure to answer fails every level.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import inf

from cases.accept import Numbers
from cases.protocol import Hello, Reply, convention
from cases.row import GoldenRow
from oracle.client.process import Failure
from oracle.decisive import decisive
from oracle.judge import LEVELS, MEASURES, Judge, Level


@dataclass(frozen=True)
class Grade:
    """What came of one row. `faults` names, for each level it fails, the reason.

    `outside` does so for the levels that the row does not decide; it is told, and not counted.
    `answer` is None where there was none. The errors are measured when they are asked for:
    `strict` and `squared` are the backward errors k, `ulps` the forward error; infinite where the
    answer is no list or has another number of pairs.
    """

    row: GoldenRow
    answer: Numbers | None
    faults: Mapping[str, str]
    judge: Judge
    decides: tuple[str, ...] = ()
    outside: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def strict(self) -> float:
        """Return the strict backward error k."""
        return inf if self.answer is None else self.judge.backward_error(self.answer, "strict")

    @cached_property
    def squared(self) -> float:
        """Return the squared backward error k."""
        return inf if self.answer is None else self.judge.backward_error(self.answer, "squared")

    @cached_property
    def ulps(self) -> float:
        """Return the forward error in ulps."""
        return inf if self.answer is None else self.judge.forward_error(self.answer)

    def fault(self, level: Level) -> str | None:
        """Return why the row fails a level, or None. A row not decisive can only be malformed."""
        return self.faults.get(level)

    def counts(self, level: Level) -> bool:
        """Tell whether the row decides a level, or fails whatever it decides."""
        return level in self.decides or level in self.faults

    @property
    def keeps_touch(self) -> bool | None:
        """Tell whether a touch was kept as a pair; None where the row has none to grade."""
        touched = any(span.touch for span in self.row.intervals)
        if self.row.tier != "lattice" or not touched or self.answer is None:
            return None
        return bool(self.answer)


def grade(row: GoldenRow, outcome: Reply | Failure, hello: Hello) -> Grade:
    """Return the grade of what an implementation answered to a row."""
    judge = Judge(row.solid, row.ray, hello.format, row.tier, hello.tolerance)
    failure = _failure(outcome)
    if failure is not None:
        return Grade(row, None, dict.fromkeys(LEVELS, failure), judge, row.decisive)
    assert isinstance(outcome, Reply)
    answer = tuple((a + 0.0, b + 0.0) for a, b in outcome.intervals or ())
    malformed = judge.malformed(answer)
    if malformed is not None:
        return Grade(row, answer, dict.fromkeys(LEVELS, malformed), judge, row.decisive)
    decides = deciding(row, judge)
    faults, outside = _faults(row, answer, judge, hello, decides)
    return Grade(row, answer, faults, judge, decides, outside)


def deciding(row: GoldenRow, judge: Judge) -> tuple[str, ...]:
    """Return the levels that a row decides for a client, whose tolerance may take some away.

    A tolerance beyond c, 1/8 of the smallest radius or thickness, would excuse a gross answer.
    """
    if not judge.tolerance:
        return row.decisive
    finer = tuple(level for level in LEVELS if level not in MEASURES)
    return decisive(judge) if judge.scene.tolerance_is_fine() else finer


def _failure(outcome: Reply | Failure) -> str | None:
    if isinstance(outcome, Failure):
        return f"{outcome.kind}: {outcome.detail}"
    if outcome.unsupported is not None:
        return f"unsupported: {outcome.unsupported}"
    return None if outcome.error is None else f"error: {outcome.error}"


def _faults(
    row: GoldenRow, answer: Numbers, judge: Judge, hello: Hello, decides: Collection[str]
) -> tuple[dict[str, str], dict[str, str]]:
    """Return the reasons why the answer fails levels: those the row decides, and the others."""
    faults: dict[str, str] = {}
    outside: dict[str, str] = {}
    for level in LEVELS:
        fault = _level_fault(level, row, answer, judge, hello)
        if level not in decides:
            outside |= {level: fault} if fault else {}
        elif fault or faults:
            faults[level] = fault or next(reversed(faults.values()))
    return faults, outside


def _level_fault(
    level: Level, row: GoldenRow, answer: Numbers, judge: Judge, hello: Hello
) -> str | None:
    match level:
        case "sound" | "stable":
            accept = judge.accept(level) if hello.tolerance else row.accept[level]
            return accept.fault(answer)
        case "faithful":
            wanted = kept(row, hello)
            if len(answer) != len(wanted):
                return f"{len(answer)} pairs, {len(wanted)} expected"
            adjacent = wanted != row.expected or judge.faithful(answer)
            return None if adjacent else "an endpoint is not one of the two numbers around it"
    wanted = kept(row, hello)
    return None if answer == wanted else f"is not the expected list {_shown(wanted)}"


def kept(row: GoldenRow, hello: Hello) -> Numbers:
    """Return the expected list without the touches that the declared convention drops."""
    keeps = convention(hello.convention)
    if len(row.expected) != len(row.intervals):
        return row.expected
    pairs = zip(row.expected, row.intervals, strict=True)
    return tuple(pair for pair, span in pairs if span.touch is None or keeps[span.touch])


def _shown(pairs: Numbers) -> str:
    return str([list(pair) for pair in pairs])
