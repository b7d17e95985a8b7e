"""The whole hunt: units out, failures in, each confirmed, shrunk, told apart and kept.

Units are done anywhere; failures are taken up here, in the order of the units' numbers. So with a
budget of cases the same seed finds the same, whoever did the units. With a budget of time it finds
the same up to where it got. A failure counts only if it comes again in a new process, alone or
after what was asked before it.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import count
from math import inf

from raycert.cases.interrupts import interruptible
from raycert.cases.numbers import Probe
from raycert.oracle.client.dialogue import Outcome, Unusable
from raycert.oracle.hunt.executors import Executor, Lost
from raycert.oracle.hunt.look import UNREPEATED, Flaw, Looker, Symptom, symptom
from raycert.oracle.hunt.moves import Shrinker, cost
from raycert.oracle.hunt.unit import (
    CASES,
    EACH,
    Clock,
    Haul,
    Job,
    Ledger,
    Session,
    Suspect,
    TimeUp,
    Unit,
    Worst,
    coarse,
)

WIND_UP = 6.0
"""Seconds to take up what is there, once the cluster or the processes are lost."""
LINGER = 2.0
"""Seconds after the last for units to give what they have."""
MOST = 100
"""Findings of a hunt, if nobody says otherwise."""
POLL = 0.25
Probes = tuple[Probe, ...]


@dataclass(frozen=True, slots=True)
class Budget:
    """When to end: cases, or seconds; or once so many causes are found."""

    cases: int | None = None
    seconds: float | None = None
    most: int = MOST
    unit: int = CASES


@dataclass(frozen=True, slots=True)
class Finding:
    """A cause of failures: its simplest case, how it fails, and what has to be asked before it.

    `first` is the case as it was found. `repeats` is False for a failure that never came again.
    """

    symptom: Symptom
    probe: Probe
    flaw: Flaw
    outcome: Outcome
    first: Probe
    k: float
    before: Probes = ()
    repeats: bool = True
    after: float = 0.0


@dataclass(slots=True)
class Hunt:
    """What a hunt has found so far. `ended` says how it ended: budget, most, interrupted.

    If the target or what does the units was `lost`, it says in words what was seen.
    """

    looker: Looker
    tried: int = 0
    worst: Worst = field(default_factory=Worst)
    findings: dict[Symptom, Finding] = field(default_factory=dict)
    seconds: float = 0.0
    ended: str = "budget"
    lost: bool = False


Progress = Callable[[Hunt], None]


def hunt(job: Job, budget: Budget, executor: Executor, on_progress: Progress | None = None) -> Hunt:
    """Hunt until the budget is used up, or the person interrupts.

    Raises `Unusable` and `Lost` if nothing was tried by then: later what was found is returned, and
    `ended` says the rest.
    """
    try:
        with interruptible():
            course = _Course(job, budget, executor, on_progress or (lambda _: None))
    except BaseException:
        executor.close()
        raise
    try:
        with interruptible():
            course.run()
    except TimeUp:
        pass
    except KeyboardInterrupt:
        course.found.ended = "interrupted"
    except (Unusable, Lost) as error:
        course.wind_up(str(error))
        if not course.found.tried:
            raise
    finally:
        executor.close()
        course.close()
    return course.found


class _Course:
    """A hunt under way; a target is started here too, to confirm failures and to shrink them."""

    def __init__(self, job: Job, budget: Budget, executor: Executor, on_progress: Progress) -> None:
        self._budget, self._executor, self._on_progress = budget, executor, on_progress
        self._began, self._clock = time.monotonic(), Clock.of(budget.seconds)
        self._out, self._ledger = 0, Ledger()
        self._session = Session(job.target, job.limits)
        self._looker = Looker(self._session.hello, job.criterion, job.solids)
        self._counts: Counter[tuple[str, str, str]] = Counter()
        self.found = Hunt(self._looker)

    def run(self) -> None:
        units, end = self._units(), self._clock.end
        waiting = next(units, None)
        while waiting or self._out:
            while waiting and self._out < self._executor.places:
                seconds = None if end == inf else max(end - time.monotonic(), 0.01)
                self._executor.submit(replace(waiting, seconds=seconds))
                self._out += 1
                waiting = next(units, None)
            for result in self._executor.finished(POLL):
                self._out -= self._ledger.add(result)
            self._tell()
            if self._take(self._ledger.in_order()) or time.monotonic() > end + LINGER:
                break
            if time.monotonic() > end:
                waiting = None
        self._take(self._ledger.rest())

    def wind_up(self, words: str) -> None:
        """Take up the failures that have come, once no more will."""
        self._clock = Clock.of(WIND_UP)
        with suppress(TimeUp, KeyboardInterrupt, Unusable):
            self._take(self._ledger.rest())
        self._tell()
        self.found.ended, self.found.lost = words, True

    def _units(self) -> Iterator[Unit]:
        cases, size = self._budget.cases, self._budget.unit
        if cases is None:
            yield from (Unit(number, size) for number in count())
        else:
            for number, start in enumerate(range(0, cases, size)):
                yield Unit(number, min(size, cases - start))

    def _take(self, results: Iterator[Haul]) -> bool:
        """Take up the failures of units in turn; return whether enough causes were found.

        Of each coarse cause only the first few are taken.
        """
        for result in results:
            if result.worst.k > self.found.worst.k:
                self.found.worst = result.worst
            for suspect in result.failures:
                self._counts[coarse(suspect)] += 1
                if self._counts[coarse(suspect)] <= EACH:
                    self._add(self._confirmed(suspect))
                self._tell()
                if len(self.found.findings) >= self._budget.most:
                    self.found.ended = "most"
                    return True
        return False

    def _tell(self) -> None:
        self.found.tried = self._ledger.tried
        self.found.seconds = time.monotonic() - self._began
        self._on_progress(self.found)

    def close(self) -> None:
        self._tell()
        self._session.close()

    def _add(self, finding: Finding | None) -> None:
        """Keep a finding, unless one as simple has the same cause."""
        if finding and not self._is_known(finding.symptom, finding.probe):
            self.found.findings[finding.symptom] = finding

    def _is_known(self, cause: Symptom, probe: Probe) -> bool:
        """Whether the cause was found in a case that is as simple."""
        old = self.found.findings.get(cause)
        return old is not None and cost(old.probe) <= cost(probe)

    def _afresh(self, probe: Probe, before: Sequence[Probe]) -> tuple[Outcome, Flaw | None]:
        """Return what a new process answers to a probe after some others, and its flaw."""
        *_, outcome = self._session.fresh([*before, probe])
        return outcome, self._looker(probe, outcome).flaw

    def _confirmed(self, suspect: Suspect) -> Finding | None:
        """Return the finding that a failure makes: alone, after some others, or never again."""
        lost = any(known.kind == UNREPEATED for known in self.found.findings)
        for length in range(1 if lost else len(suspect.before) + 1):
            before = suspect.before[len(suspect.before) - length :]
            outcome, flaw = self._afresh(suspect.probe, before)
            if flaw:
                return self._shrunk(suspect, flaw, before)
        return self._unrepeated(suspect, outcome)

    def _shrunk(self, suspect: Suspect, flaw: Flaw, before: Probes) -> Finding | None:
        def fails(probes: Sequence[Probe]) -> list[bool]:
            if time.monotonic() > self._clock.end + LINGER:
                raise TimeUp
            asked = [s for probe in probes for s in (*before, probe)]
            outcomes = self._session.ask(asked)[len(before) :: len(before) + 1]
            return [self._same(s, o, flaw) for s, o in zip(probes, outcomes, strict=True)]

        def is_known(probe: Probe) -> bool:
            return self._is_known(symptom(probe, flaw), probe)

        shrinker = Shrinker(suspect.probe, fails, self._looker.hello.format)
        try:
            shrinker.run(is_known)
        except (TimeUp, KeyboardInterrupt):
            self._add(self._finished(shrinker.best, suspect, before))
            raise
        if is_known(shrinker.best):
            return None
        return self._finished(shrinker.best, suspect, before)

    def _finished(self, best: Probe, suspect: Suspect, before: Probes) -> Finding:
        for probe in (best, suspect.probe):
            outcome, again = self._afresh(probe, before)
            if again:
                return self._finding(suspect, probe, again, outcome, before)
        return self._unrepeated(suspect, outcome)

    def _unrepeated(self, suspect: Suspect, outcome: Outcome) -> Finding:
        flaw = replace(suspect.flaw, kind=UNREPEATED)
        return replace(self._finding(suspect, suspect.probe, flaw, outcome), repeats=False)

    def _same(self, probe: Probe, outcome: Outcome, flaw: Flaw) -> bool:
        """Whether a case fails in the same way, on the same level or a weaker one."""
        seen = self._looker(probe, outcome).flaw if self._looker.wants(probe) else None
        levels = {flaw.level, "sound"} if flaw.level == "stable" else {flaw.level}
        return seen is not None and seen.kind == flaw.kind and seen.level in levels

    def _finding(
        self, suspect: Suspect, probe: Probe, flaw: Flaw, outcome: Outcome, before: Probes = ()
    ) -> Finding:
        after = time.monotonic() - self._began
        k = self._looker.true_k(probe, outcome)
        return Finding(
            symptom(probe, flaw), probe, flaw, outcome, suspect.probe, k, before, after=after
        )
