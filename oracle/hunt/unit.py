"""A piece of work: so many cases, chosen by a seed and the number of the piece alone.

The same unit of the same job gives the same result wherever it is done, and however often: so a
unit that was lost with its worker is done again. Of three units two are of the directed search, and
one of that which Hypothesis drives. The target is started anew for each.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf
from pathlib import Path

from raycert.cases.corpus import GOLDEN
from raycert.cases.model import SOLIDS
from raycert.cases.numbers import Probe
from raycert.oracle.client.dialogue import Limits, Outcome, Target
from raycert.oracle.corpus.fresh import possible
from raycert.oracle.hunt.look import Asked, Fault, Looker, Seen
from raycert.oracle.hunt.session import Clock, Session, TimeUp

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
    asked: Asked = field(default_factory=Asked)
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
class Failing:
    """A case that the target got wrong, and what it was asked before."""

    probe: Probe
    fault: Fault
    before: tuple[Probe, ...] = ()


@dataclass(frozen=True, slots=True)
class Worst:
    """The largest backward error among the cases that decide, and where; without one, at most 1."""

    k: float = 1.0
    probe: Probe | None = None


@dataclass(frozen=True, slots=True)
class Done:
    """What came of a unit. `cut` says that it ended before its cases did."""

    number: int
    tried: int
    worst: Worst
    failures: tuple[Failing, ...]
    cut: bool = False


def coarse(failing: Failing) -> tuple[str, str, str]:
    """Return what tells failures apart before they are made simple: level, kind, type of solid."""
    fault = failing.fault
    return fault.level, fault.kind, type(failing.probe.solid).__name__


class Spent(BaseException):
    """The cases of a unit are used up. No `Exception`, as `TimeUp`."""


class Field:
    """Where a unit works: probes in, what was seen out; failures and the worst k are kept."""

    def __init__(self, job: Job, unit: Unit) -> None:
        """Start the target. Raises `Unusable`."""
        self.job, self.unit, self.tried = job, unit, 0
        self.clock = Clock.of(unit.seconds)
        self.session = Session(job.target, job.limits, self.clock)
        hello = self.session.hello
        self.looker = Looker(hello, job.asked, job.solids)
        self.solids = tuple(name for name in job.solids if name in hello.solids)
        self.worst = Worst()
        self.failures: list[Failing] = []
        self._counts: dict[tuple[str, str, str], int] = {}
        self._history: tuple[Probe, ...] = ()

    def look(self, probes: list[Probe]) -> list[tuple[Probe, Seen]]:
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

    def _note(self, probe: Probe, outcome: Outcome) -> Seen:
        self.tried += 1
        seen, before = self.looker(probe, outcome), self._history
        self._history = (*before, probe)[-HISTORY:]
        if seen.fault:
            self._keep(Failing(probe, seen.fault, before))
        if seen.k > max(self.worst.k, 1.0) and (seen.k < inf or seen.fault):
            k = self.looker.true_k(probe, outcome)
            self.worst = Worst(k, probe) if k > self.worst.k else self.worst
        return seen

    def _keep(self, failing: Failing) -> None:
        key = coarse(failing)
        self._counts[key] = self._counts.get(key, 0) + 1
        if self._counts[key] <= EACH:
            self.failures.append(failing)

    def done(self, cut: bool) -> Done:
        """Return the result so far."""
        return Done(self.unit.number, self.tried, self.worst, tuple(self.failures), cut)


def work(job: Job, unit: Unit) -> Done:
    """Do a unit. On `KeyboardInterrupt` what is known is returned, cut. Raises `Unusable`."""
    from raycert.oracle.hunt.directed import directed
    from raycert.oracle.hunt.drawn import drawn

    ways = {"directed": directed, "drawn": drawn}
    place = Field(job, unit)
    try:
        if possible(place.solids):
            ways[job.methods[unit.number % len(job.methods)]](place)
    except Spent:
        return place.done(cut=False)
    except (TimeUp, KeyboardInterrupt):
        return place.done(cut=True)
    finally:
        place.session.close()
    return place.done(cut=False)
