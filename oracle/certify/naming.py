"""How well faults are named: subjects whose faults are known, diagnosed as if they were not.

    alone     a planted fault
    pairs     two of them in one tracer; triples three. Faults in steps of their own are put
              together; where they share a step, or are no steps, the one answers that errs, and
              of two that err each row has its own
    rare      a sound tracer, one answer in twenty spoilt, each in a way of its own
    noise     every other answer spoilt so

Of each subject its own roundings are on top, as another tracer's would be.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from math import inf, isfinite, nextafter
from typing import Any, Literal, get_args

from raycert.cases.accept import Numbers
from raycert.cases.levels import Level
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Hello, Reply, first
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.cover import LEAST
from raycert.oracle.certify.diagnosis import Past, Trial, diagnose
from raycert.oracle.certify.grading import Grade, grade, usual
from raycert.oracle.certify.verdict import by_solid
from raycert.oracle.zoo.inhabitants import CATALOGUE, DISCRIMINANT, SOUND
from raycert.oracle.zoo.matrix import Outcome
from raycert.oracle.zoo.tracer import BASE, Fault, Intersect, Pairs, Tracer

Trouble = Literal["alone", "pairs", "triples", "rare", "noise"]
TROUBLES: tuple[Trouble, ...] = get_args(Trouble)
KNOWN = {fault.name: fault for fault in CATALOGUE}
SPOILT = {"rare": 0.05, "noise": 0.5}
"""The part of the answers that is spoilt."""


@dataclass(frozen=True)
class Unknown:
    """A tracer and the faults that it has, none if what it has is no fault of the catalogue."""

    faults: tuple[Fault, ...]
    make: Callable[[], Intersect]

    @property
    def name(self) -> str:
        return " + ".join(fault.name for fault in self.faults) or "none"


def subjects(trouble: Trouble, count: int, seed: int = 1) -> Iterator[Unknown]:
    """Yield so many subjects, or for `alone` each fault; the same for the same seed."""
    dice = random.Random(f"{trouble} {seed}")
    if trouble == "alone":
        yield from (Unknown((fault,), fault.make) for fault in CATALOGUE)
        return
    sound = [s for s in SOUND if s.precision == "binary64"]
    for number in range(count):
        if trouble in SPOILT:
            one = sound[number % len(sound)]
            spoil = spoilt(one.tracer, SPOILT[trouble], dice.random())
            planted = (DISCRIMINANT,) if one.name == "textbook" else ()
            yield Unknown(planted, lambda spoil=spoil: spoil)  # type: ignore[misc]
        else:
            faults = tuple(dice.sample(CATALOGUE, 2 if trouble == "pairs" else 3))
            yield Unknown(faults, lambda faults=faults: mixed(faults))  # type: ignore[misc]


def mixed(faults: Sequence[Fault]) -> Intersect:
    """Return a tracer with all of these faults."""
    together = put_together([fault.make() for fault in faults])
    return together or by_rows([fault.make() for fault in faults])


def put_together(tracers: Sequence[Intersect]) -> Tracer | None:
    """Return the tracer that takes the steps of all; None where two want the same."""
    changed: dict[str, Any] = {}
    for tracer in tracers:
        steps = _steps(tracer) if isinstance(tracer, Tracer) else changed
        if not steps or steps.keys() & changed.keys():
            return None
        changed |= steps
    return replace(BASE, **changed)


def _steps(tracer: Tracer) -> dict[str, Any]:
    """Return the steps that are not those of the base."""
    steps = {field.name: getattr(tracer, field.name) for field in fields(Tracer)}
    return {name: step for name, step in steps.items() if step is not getattr(BASE, name)}


def by_rows(tracers: Sequence[Intersect]) -> Intersect:
    """Return the tracer that errs wherever one of these does, in the way of one that does."""

    def answer(solid: Solid, ray: Ray) -> Pairs:
        right = BASE(solid, ray)
        order = list(tracers)
        random.Random(repr((solid, ray))).shuffle(order)
        for tracer in order:
            if (pairs := tracer(solid, ray)) != right:
                return pairs
        return right

    return answer


def spoilt(intersect: Intersect, part: float, seed: float) -> Intersect:
    """Return a tracer that spoils a part of its answers, each in one of many ways."""

    def answer(solid: Solid, ray: Ray) -> Pairs:
        dice = random.Random(repr((seed, solid, ray)))
        pairs = intersect(solid, ray)
        return dice.choice(WAYS)(pairs, dice) if dice.random() < part else pairs

    return answer


WAYS: tuple[Callable[[Pairs, random.Random], Pairs], ...] = (
    lambda pairs, dice: [],
    lambda pairs, dice: [(0.0, inf)],
    lambda pairs, dice: [(a * dice.uniform(0.5, 1), b * dice.uniform(1, 2)) for a, b in pairs],
    lambda pairs, dice: [(a, b * (1 + dice.uniform(1e-9, 1e-3))) for a, b in pairs],
    lambda pairs, dice: [(a + dice.random(), b + 1) for a, b in pairs] or [(0.0, dice.random())],
    lambda pairs, dice: [*pairs, *[(b + dice.random(), inf) for _, b in pairs if b < inf]],
)
"""How an answer is spoilt."""


def rounded(answer: Numbers, dice: random.Random) -> Numbers:
    """Return an answer as another formula might round it: points stay points, 0 stays 0."""

    def off(x: float) -> float:
        for _ in range(dice.randrange(3) if x and isfinite(x) else 0):
            x = nextafter(x, 0.0)
        return x

    return tuple((off(a), off(b)) if a != b else (a, b) for a, b in answer)


def graded(
    intersect: Intersect, rows: Sequence[GoldenRow], hello: Hello, independently: bool = True
) -> list[Grade]:
    """Return the grades of a tracer that, if `independently`, rounds in its own way."""
    dice, grades = random.Random(1), []
    for row in sorted(rows, key=lambda row: row.tier == "range"):
        outcome = Outcome.of(intersect, row, hello.format)
        answer = outcome.answer
        if answer is None:
            reply = Reply(row.id, error=outcome.error)
        else:
            answer = rounded(answer, dice) if independently else answer
            reply = Reply(row.id, answer, first(answer, hello.from_inside), bool(answer))
        grades.append(grade(row, reply, hello))
    return grades


@dataclass
class Naming:
    """How the faults of subjects are named, over their solids and both levels.

    A fault shows where at least a few failing answers are its own and no other's of the subject;
    `showing` counts these, `named` those of them that are named. `all_show` counts the solids where
    every fault of a subject shows, `all_named` those where all are named too. `other` counts names
    of faults that a subject has not, `signatures` what is said of answers alone.
    """

    subjects: int = 0
    failures: int = 0
    explained: int = 0
    showing: int = 0
    named: int = 0
    all_show: int = 0
    all_named: int = 0
    other: int = 0
    signatures: int = 0
    missed: list[str] = field(default_factory=list)
    """What was not named, or named otherwise, in words."""

    def add(self, subject: Unknown, rows: Sequence[GoldenRow], hello: Hello) -> None:
        """Diagnose a subject, and count what is said."""
        grades = graded(subject.make(), rows, hello)
        trials, own = trials_of(grades), {fault.name for fault in subject.faults}
        self.subjects += 1
        for record in diagnose(grades):
            trial = trials[record["solid"], record["level"]]
            mine, said = showing(subject, trial), names(subject, trial, record)
            self.failures += record["failures"]
            self.explained += record["failures"] - record["unexplained"]
            self.showing += len(mine)
            self.named += len(mine & said)
            self.all_show += bool(own) and mine == own
            self.all_named += bool(own) and mine == own <= said
            self.other += len(said & KNOWN.keys() - own)
            self.signatures += len(said - KNOWN.keys())
            if mine - said or said & KNOWN.keys() - own:
                causes = ", ".join(f"{c['fault']} {c['rows']}" for c in record["explained"])
                words = f"{causes or 'none'}; not named: {', '.join(mine - said) or 'none'}"
                self.missed.append(f"{subject.name}: {trial.solid} {trial.level}: {words}")


def trials_of(grades: Sequence[Grade]) -> dict[tuple[str, str], Trial]:
    """Return what is tried of each solid on each level."""
    past = Past(grades)
    found: dict[tuple[str, str], Trial] = {}
    levels: tuple[tuple[Level, bool], ...] = (("sound", False), ("stable", True))
    for group in by_solid(usual(grades)):
        for level, fine in levels:
            rows = [g for g in group.grades if not (fine and g.fault("sound"))]
            found[group.name, level] = Trial(group.name, level, rows, past)
    return found


def alike(fault: Fault, trial: Trial) -> frozenset[int]:
    """Return the failures that a fault explains."""
    return trial.explained(trial.explains(fault, trial.answers(fault)), trial.failing)


def showing(subject: Unknown, trial: Trial) -> set[str]:
    """Return the faults of a subject that show."""
    found = {fault.name: alike(fault, trial) for fault in subject.faults}
    return {
        name
        for name, rows in found.items()
        if len(rows.difference(*(others for n, others in found.items() if n != name))) >= LEAST
    }


def names(subject: Unknown, trial: Trial, record: dict[str, Any]) -> set[str]:
    """Return what is named, twins by the name that the subject has: they explain the same rows."""
    own = {alike(fault, trial): fault.name for fault in subject.faults}
    found = set()
    for cause in record["explained"]:
        name = cause["fault"]
        mine = any(fault.name == name for fault in subject.faults)
        if name in KNOWN and not mine:
            name = own.get(alike(KNOWN[name], trial), name)
        found.add(name)
    return found


def score(
    trouble: Trouble, count: int, rows: Sequence[GoldenRow], hello: Hello, seed: int = 1
) -> Naming:
    """Return how well the faults of so many subjects are named."""
    found = Naming()
    for subject in subjects(trouble, count, seed):
        found.add(subject, rows, hello)
    return found
