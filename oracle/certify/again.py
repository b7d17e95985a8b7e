"""State is seen: failing rows asked again, each alone in a fresh process, and what is said then.

A row that passes alone, and failed among others, has an answer that depends on what was asked
before: a cache that is not cleared, a scene that keeps what an exception left in it. The failure is
real and stays; what is told is where to look for it. Crashes and hangs are asked again as they
come (client/replay.py), and are left out here.

A sample, so that a run grows by a part of its own time only: spread over solids, kinds of failure
and families, as far as the time goes. Once one has passed, the whole sample is asked, to tell how
far it goes.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from typing import Any

from raycert.cases.levels import Level
from raycert.cases.model import type_of
from raycert.cases.protocol import Hello
from raycert.oracle.certify.grading import Grade, grade, usual
from raycert.oracle.client.dialogue import Outcome, Question

MOST, LEAST = 32, 2
"""Rows that are asked again: at most, and whatever the time."""
PART = 1 / 3
"""Of the time of the run until then, the part that asking again may take."""
LONG, LONGEST = 5.0, 10.0
"""Seconds that it may take at most, and where a row has passed."""
REPEATED = ("crash", "hang", "wrong-id", "unrepeatable")
"""Failures of a process, each of which was asked again when it came."""


@dataclass(frozen=True, slots=True)
class Again:
    """What came of asking again, by the ids of the rows.

    `failing` is how many rows there were to choose from. `passed` are those that were right then,
    `differed` those that were wrong in another way.
    """

    failing: int = 0
    asked: tuple[str, ...] = ()
    passed: tuple[str, ...] = ()
    differed: tuple[str, ...] = ()

    def form(self) -> dict[str, Any]:
        """Return it as the certificate has it."""
        return {
            "failing": self.failing,
            "asked_again": len(self.asked),
            "then_passed": list(self.passed),
            "then_differed": list(self.differed),
        }

    @property
    def reasons(self) -> tuple[str, ...]:
        """Return why this refuses: a sentence, or none."""
        return self._told(self.passed, "pass")

    @property
    def notes(self) -> tuple[str, ...]:
        return self._told(self.differed, "get another wrong answer")

    def _told(self, ids: tuple[str, ...], verb: str) -> tuple[str, ...]:
        if not ids:
            return ()
        of = f"{len(ids)} of {len(self.asked)} failing rows"
        return (
            f"depends on what was asked before: {of} {verb} when asked alone, in a fresh process; "
            f"first {ids[0]}",
        )


def sample(grades: Sequence[Grade], level: Level) -> list[Grade]:
    """Return failing rows in the order to ask them: of every solid each kind once, then families.

    Kinds are wrong answers and each sort of refusal. Which of a family is told by the hash of its
    id, so that no place in a run is preferred.
    """
    left = sorted(failing(grades, level), key=lambda g: sha256(g.row.id.encode()).digest())
    groups = {g.row.id: _groups(g, level) for g in left}
    times, chosen = Counter[str](), list[Grade]()

    def rank(solid: str, kind: str, family: str) -> tuple[int, int, int]:
        return times[solid], min(times[kind], 1), times[family]

    while left and len(chosen) < MOST:
        best = min(left, key=lambda g: rank(*groups[g.row.id]))
        left.remove(best)
        chosen.append(best)
        times.update(groups[best.row.id])
    return chosen


def _groups(grade: Grade, level: Level) -> tuple[str, str, str]:
    solid = type_of(grade.row.solid)
    sort = "" if grade.said else ":".join(str(grade.fault(level)).split(":")[:2])
    return solid, f"{solid} that is {sort}", f"{solid} of {grade.row.family}"


def failing(grades: Sequence[Grade], level: Level) -> list[Grade]:
    """Return what fails a level with an answer, or without one that was asked again as it came."""
    return [
        g for g in usual(grades) if (fault := g.fault(level)) and not fault.startswith(REPEATED)
    ]


def ask_again(
    grades: Sequence[Grade],
    level: Level,
    hello: Hello,
    alone: Callable[[Question], Outcome],
    seconds: float,
    advance: Callable[[], None] = lambda: None,
) -> Again:
    """Ask a sample of failing rows again, at least LEAST, in about so many seconds.

    `alone` asks one question of a fresh process; what it raises ends this.
    """
    asked, passed, differed = list[str](), list[str](), list[str]()
    began = time.monotonic()
    for g in sample(grades, level):
        spent = time.monotonic() - began
        if len(asked) >= LEAST and spent > (LONGEST if passed else min(seconds, LONG)):
            break
        then = grade(g.row, alone(Question(g.row.id, g.row.solid, g.row.ray)), hello)
        asked.append(g.row.id)
        if not then.fault(level):
            passed.append(g.row.id)
        elif repr(then.said) != repr(g.said):  # NaN is no other answer than NaN
            differed.append(g.row.id)
        advance()
    return Again(len(failing(grades, level)), tuple(asked), tuple(passed), tuple(differed))
