"""A target that stays open for batch after batch: one answer to every question, whatever it does.

A failure of the process is pinned as the replay pins it: what was under way is asked again, alone.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf

from raycert.cases.numbers import Probe
from raycert.cases.protocol import Hello
from raycert.oracle.client import replay
from raycert.oracle.client.dialogue import (
    Dialogue,
    Limits,
    Outcome,
    Question,
    Target,
    Unusable,
    fresh_ids,
)
from raycert.oracle.client.process import Broken, Failure

STARTS = 3
WINDOW = 64
"""Questions under way at a time: after a crash they are asked one by one."""


class TimeUp(BaseException):
    """The time of the work is over. No `Exception`: nothing between may take it for one."""


@dataclass(frozen=True, slots=True)
class Clock:
    """When to stop, in seconds of `time.monotonic`."""

    end: float = inf

    @classmethod
    def of(cls, seconds: float | None) -> Clock:
        """Return the clock that stops so many seconds from now; None is never."""
        return cls(inf if seconds is None else time.monotonic() + seconds)

    def left(self) -> float:
        """Return how many seconds are left; a little when none are."""
        return max(self.end - time.monotonic(), 0.1)

    def check(self) -> None:
        if time.monotonic() > self.end:
            raise TimeUp


class Session:
    """A target, open until `close`. It is opened at the first question, and `hello` asks none."""

    def __init__(self, target: Target, limits: Limits, clock: Clock | None = None) -> None:
        self._target, self._limits, self.clock = target, limits, clock or Clock()
        self._ids = fresh_ids()
        self._dialogue: Dialogue | None = None

    @property
    def hello(self) -> Hello:
        return self._live().hello

    def ask(self, probes: Sequence[Probe]) -> list[Outcome]:
        """Return the outcome of each probe, in order. Raises `Unusable` and `TimeUp`."""
        questions = [Question(str(i), probe.solid, probe.ray) for i, probe in enumerate(probes)]
        known: dict[str, Outcome] = {}
        while len(known) < len(questions):
            self.clock.check()
            self._stream([question for question in questions if question.id not in known], known)
        return [known[question.id] for question in questions]

    def fresh(self, probes: Sequence[Probe]) -> list[Outcome]:
        """Return the outcomes of probes that are the first that a new process is asked."""
        self.close()
        return self.ask(probes)

    def close(self) -> None:
        dialogue, self._dialogue = self._dialogue, None
        if dialogue is not None:
            dialogue.kill()

    def _stream(self, questions: Sequence[Question], known: dict[str, Outcome]) -> None:
        """Ask until all are answered, or up to the first that breaks the process."""
        dialogue, pending = self._live(), deque(questions)
        try:
            while pending or dialogue.owed:
                room = min(WINDOW - dialogue.owed, len(pending))
                if room > 0:
                    dialogue.ask([pending.popleft() for _ in range(room)])
                known.update((question.id, outcome) for question, outcome in dialogue.answers())
        except Broken as broken:
            self.close()
            self._pin(dialogue, broken.failure, known)
        except BaseException:
            self.close()
            raise

    def _pin(self, dialogue: Dialogue, failure: Failure, known: dict[str, Outcome]) -> None:
        """Ask what was under way again, as the replay does."""
        last = [dialogue.last] if dialogue.last else []
        under_way = dialogue.unanswered or last
        self.clock.check()
        limits = replace(self._limits, lost=min(self._limits.lost, self.clock.left()))
        again = replay.run(self._target, under_way, limits).outcomes
        known.update(again)
        if not any(isinstance(outcome, Failure) for outcome in again.values()):
            detail = f"did not come again: {failure.kind}: {failure.detail}"
            known[under_way[0].id] = Failure("unrepeatable", detail)

    def _live(self) -> Dialogue:
        if self._dialogue is None:
            self._dialogue = self._open()
        return self._dialogue

    def _open(self) -> Dialogue:
        for _ in range(STARTS - 1):
            try:
                return self._target.open(self._limits, self._ids)
            except Unusable:
                self.clock.check()
        return self._target.open(self._limits, self._ids)
