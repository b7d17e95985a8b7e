"""The work on one step and on one cause: what a worker process is given, and what it returns."""

from __future__ import annotations

import signal
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from raycert.oracle.measure.methods.catalog import by_name
from raycert.oracle.measure.methods.method import Answered, Case
from raycert.oracle.measure.stress.causes import Cause, Solve, diagnose
from raycert.oracle.measure.stress.measure import Ground, Measured, Point, Question
from raycert.oracle.measure.stress.sample import Sample
from raycert.oracle.measure.stress.sweeps import SWEEPS


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a sweep: `x` of the sweep of this name, so many samples of a seed."""

    sweep: str
    x: Fraction
    seed: int
    count: int

    def samples(self) -> list[Sample]:
        """Return the samples of the step."""
        return SWEEPS[self.sweep].samples(self.x, self.seed, self.count)

    def questions(self) -> list[Question]:
        """Return what is asked: the samples that are a solid in doubles."""
        return [q for sample in self.samples() if (q := Question.of(sample)) is not None]


@dataclass(frozen=True, slots=True)
class StepJob:
    """A step, the built-in methods that answer it here, and what others have answered already."""

    step: Step
    names: tuple[str, ...]
    given: Mapping[str, Sequence[Answered]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Stepped:
    """What came of a step: its ground, and a point for each method that answers such solids."""

    step: Step
    ground: Ground
    points: Mapping[str, Point]


@dataclass(frozen=True, slots=True)
class CauseJob:
    """A built-in method that breaks at a step of its curve."""

    name: str
    step: Step
    curve: Mapping[Fraction, Point]


def walk(job: StepJob) -> Stepped | None:
    """Return what came of a step; None where rounding leaves no question."""
    questions = job.step.questions()
    if not questions:
        return None
    points = {}
    for name, answers in job.given.items():
        points[name] = Point.over(_measured(questions, answers))
    for name in job.names:
        method = by_name(name)
        fit = [q for q in questions if method.answers(q.solid)]
        if fit:
            points[name] = Point.over(_measured(fit, method.solve(cases(fit))))
    return Stepped(job.step, Ground.over(questions), points)


def cases(questions: Sequence[Question]) -> list[Case]:
    """Return questions as methods take them."""
    return [question.case for question in questions]


def _measured(questions: Sequence[Question], answers: Sequence[Answered]) -> list[Measured]:
    return [q.measured(answer) for q, answer in zip(questions, answers, strict=True)]


def tell(job: CauseJob) -> Cause:
    """Return why a built-in method breaks."""
    return told(job.step, job.curve, by_name(job.name).solve)


def told(step: Step, curve: Mapping[Fraction, Point], solve: Solve) -> Cause:
    """Return why what `solve` answers breaks at a step."""
    sweep = SWEEPS[step.sweep]

    def samples(x: Fraction) -> list[Sample]:
        return sweep.samples(x, step.seed, step.count)

    return diagnose(sweep, curve, step.x, solve, samples)


def quiet() -> None:
    """Leave Ctrl-C to the process that started this one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
