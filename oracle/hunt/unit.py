"""A piece of work: so many cases, chosen by a seed and the number of the piece alone.

The same unit of the same job gives the same result wherever it is done, and however often: so a
unit that was lost with its worker is done again. Of three units two are of the directed search, and
one of that which Hypothesis drives (pursuit). The target is started anew for each.

A target that failed is started again, and answers every question: what was under way when its
process broke is asked again, alone, as the replay does.

The ledger has the results. One may come twice, where a unit was done again because its worker
seemed lost; it is the same one, and the second is dropped. Results that come early wait for the
ones before them, so that what a hunt finds does not depend on who was faster.
"""

from __future__ import annotations

import time
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from pathlib import Path

from raycert.cases.corpus import GOLDEN
from raycert.cases.model import SOLIDS
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
from raycert.oracle.hunt.look import Criterion, Flaw, Looker, Observation

CASES = 1000
"""Cases of a unit."""
HISTORY = 8
"""Scenes asked before a failure that are kept, since an answer may depend on them."""
EACH = 3
"""Failures of one coarse cause that a unit reports."""


@dataclass(frozen=True, slots=True)
class Job:
    """What all units of a hunt share. `golden` is where cases to move are taken from, or None."""

    target: Target
    limits: Limits = field(default_factory=Limits)
    criterion: Criterion = field(default_factory=Criterion)
    seed: int = 0
    solids: tuple[str, ...] = tuple(SOLIDS)
    golden: Path | None = GOLDEN
    examples: Path | None = None
    methods: tuple[str, ...] = ("directed", "drawn", "directed")


@dataclass(frozen=True, slots=True)
class Unit:
    """The number of a piece of work, and its budget."""

    number: int
    cases: int = CASES
    seconds: float | None = None


@dataclass(frozen=True, slots=True)
class Suspect:
    """A case that the target got wrong, and what it was asked before."""

    probe: Probe
    flaw: Flaw
    before: tuple[Probe, ...] = ()


@dataclass(frozen=True, slots=True)
class Worst:
    """The largest backward error among the cases that decide, and where; without one, at most 1."""

    k: float = 1.0
    probe: Probe | None = None


@dataclass(frozen=True, slots=True)
class Haul:
    """What came of a unit. `cut` says that it ended before its cases did."""

    number: int
    tried: int
    worst: Worst
    failures: tuple[Suspect, ...]
    cut: bool = False


def coarse(suspect: Suspect) -> tuple[str, str, str]:
    """Return what tells failures apart before they are made simple: level, kind, type of solid."""
    return suspect.flaw.level, suspect.flaw.kind, type(suspect.probe.solid).__name__


class Spent(BaseException):
    """The cases of a unit are used up. No `Exception`, as `TimeUp`."""


class Site:
    """Where a unit works: probes in, what was seen out; failures and the worst k are kept."""

    def __init__(self, job: Job, unit: Unit) -> None:
        """Start the target. Raises `Unusable`."""
        self.job, self.unit, self.tried = job, unit, 0
        self.clock = Clock.of(unit.seconds)
        self.session = Session(job.target, job.limits, self.clock)
        hello = self.session.hello
        self.looker = Looker(hello, job.criterion, job.solids)
        self.solids = tuple(name for name in job.solids if name in hello.solids)
        self.worst = Worst()
        self.failures: list[Suspect] = []
        self._counts = Counter[tuple[str, str, str]]()
        self._history: tuple[Probe, ...] = ()

    def look(self, probes: list[Probe]) -> list[tuple[Probe, Observation]]:
        """Ask the probes that count. Raises `Spent` once no case is left, and `TimeUp`."""
        self.clock.check()
        left = self.unit.cases - self.tried
        if left <= 0:
            raise Spent
        wanted = [probe for probe in probes if self.looker.wants(probe)][:left]
        outcomes = self.session.ask(wanted) if wanted else []
        seen = []
        for probe, outcome in zip(wanted, outcomes, strict=True):
            self.clock.check()
            seen.append((probe, self._note(probe, outcome)))
        return seen

    def _note(self, probe: Probe, outcome: Outcome) -> Observation:
        self.tried += 1
        seen, before = self.looker(probe, outcome), self._history
        self._history = (*before, probe)[-HISTORY:]
        if seen.flaw:
            suspect = Suspect(probe, seen.flaw, before)
            self._counts[coarse(suspect)] += 1
            if self._counts[coarse(suspect)] <= EACH:
                self.failures.append(suspect)
        if seen.k > max(self.worst.k, 1.0) and (seen.k < inf or seen.flaw):
            k = self.looker.true_k(probe, outcome)
            self.worst = Worst(k, probe) if k > self.worst.k else self.worst
        return seen

    def haul(self, cut: bool) -> Haul:
        return Haul(self.unit.number, self.tried, self.worst, tuple(self.failures), cut)


class Ledger:
    """The results so far."""

    def __init__(self) -> None:
        self.results: dict[int, Haul] = {}
        self._next = 0

    def add(self, result: Haul) -> bool:
        if result.number in self.results:
            return False
        self.results[result.number] = result
        return True

    def in_order(self) -> Iterator[Haul]:
        """Yield the results whose turn it is, each once."""
        while self._next in self.results:
            self._next += 1
            yield self.results[self._next - 1]

    def rest(self) -> Iterator[Haul]:
        """Yield the results that wait for one that will not come, in order."""
        for number in sorted(n for n in self.results if n >= self._next):
            self._next = number + 1
            yield self.results[number]

    @property
    def tried(self) -> int:
        return sum(result.tried for result in self.results.values())


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
        self._first: Hello | None = None

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
        again = replay.run(self._target, under_way, limits, hello=self._first).outcomes
        known.update(again)
        if not any(isinstance(outcome, Failure) for outcome in again.values()):
            detail = f"did not come again: {failure.kind}: {failure.detail}"
            known[under_way[0].id] = Failure("unrepeatable", detail)

    def _live(self) -> Dialogue:
        if self._dialogue is None:
            self._dialogue = self._open()
            self._first = self._dialogue.hello
        return self._dialogue

    def _open(self) -> Dialogue:
        for _ in range(STARTS - 1):
            try:
                return self._started()
            except replay.Changed:
                raise
            except Unusable:
                self.clock.check()
        return self._started()

    def _started(self) -> Dialogue:
        return replay.open_again(self._target, self._limits, self._ids, self._first)
