"""The run: every method on every step of every sweep, then the causes of what broke.

Built-in methods answer in the worker processes, which judge all answers; a client is asked from
here, one sweep at a time. Interrupted, a run keeps all the steps that are done.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from multiprocessing import get_context
from typing import TypeVar

from raycert.oracle.measure.methods.method import Answered, Method
from raycert.oracle.measure.stress.causes import Cause
from raycert.oracle.measure.stress.measure import Ground, Point
from raycert.oracle.measure.stress.ranges import Ranges
from raycert.oracle.measure.stress.step import (
    CauseJob,
    Step,
    StepJob,
    Stepped,
    cases,
    quiet,
    tell,
    told,
    walk,
)
from raycert.oracle.measure.stress.sweeps import SWEEPS, Sweep

SAMPLES, QUICK_SAMPLES, QUICK_EVERY = 24, 8, 3
Advance = Callable[..., None]
Curve = dict[Fraction, Point]
Job = TypeVar("Job")
Result = TypeVar("Result")


@dataclass(frozen=True)
class Plan:
    """What to run. Methods of the family `client` are asked from this process."""

    methods: tuple[Method, ...]
    sweeps: tuple[Sweep, ...] = tuple(SWEEPS.values())
    seed: int = 1
    quick: bool = False
    workers: int = 2

    @property
    def count(self) -> int:
        """Return the samples of a step."""
        return QUICK_SAMPLES if self.quick else SAMPLES

    def steps(self, sweep: Sweep) -> tuple[Fraction, ...]:
        """Return the steps of a sweep that are run."""
        return sweep.coarse(QUICK_EVERY if self.quick else 1)

    def step(self, sweep: Sweep, x: Fraction) -> Step:
        """Return a step as workers take it."""
        return Step(sweep.name, x, self.seed, self.count)

    @property
    def total(self) -> int:
        """Return the number of steps over all sweeps."""
        return sum(len(self.steps(sweep)) for sweep in self.sweeps)


@dataclass
class Report:
    """What came of a run. Curves and grounds go by sweep; curves then by method, and by step."""

    plan: Plan
    grounds: dict[str, dict[Fraction, Ground]] = field(default_factory=dict)
    curves: dict[str, dict[str, Curve]] = field(default_factory=dict)
    causes: dict[tuple[str, str], list[Cause]] = field(default_factory=dict)
    interrupted: bool = False

    def add(self, stepped: Stepped) -> None:
        """Keep what came of a step."""
        sweep, x = stepped.step.sweep, stepped.step.x
        self.grounds.setdefault(sweep, {})[x] = stepped.ground
        curves = self.curves.setdefault(sweep, {})
        for name, point in stepped.points.items():
            curves.setdefault(name, {})[x] = point

    def tell(self, name: tuple[str, str], cause: Cause) -> None:
        """Keep a cause, in the order of the steps."""
        told = self.causes.setdefault(name, [])
        told.append(cause)
        told.sort(key=lambda cause: SWEEPS[name[0]].steps.index(cause.step))

    def curve(self, sweep: str, method: str) -> Curve:
        """Return a curve, as far as it is known."""
        return self.curves.get(sweep, {}).get(method, {})

    def ranges(self, sweep: Sweep, method: str) -> Ranges | None:
        """Return the ranges of a method; None where its curve lacks a step of the sweep."""
        curve, grounds = self.curve(sweep.name, method), self.grounds.get(sweep.name, {})
        if not curve or len(grounds) < len(self.plan.steps(sweep)) or len(curve) < len(grounds):
            return None
        return Ranges.read(sweep, curve)


def run(plan: Plan, on_step: Advance, on_cause: Advance = lambda: None) -> Report:
    """Return the report of a plan; what is known by then if the person interrupts it.

    `on_step()` is called after each step, `on_cause()` after each cause.
    """
    report = measure(plan, on_step)
    tell_causes(report, on_cause)
    return report


def measure(plan: Plan, advance: Advance) -> Report:
    """Return the report of a plan without causes; `advance()` is called `plan.total` times."""
    report = Report(plan)
    try:
        with _workers(plan.workers) as workers:
            for sweep in plan.sweeps:
                for stepped in workers.each(walk, _step_jobs(plan, sweep)):
                    if stepped is not None:
                        report.add(stepped)
                    advance()
    except KeyboardInterrupt:
        report.interrupted = True
    return report


def tell_causes(report: Report, advance: Advance) -> None:
    """Add the causes to a report; `advance()` is called `causes_to_tell(report)` times.

    An interrupted report is left as it is.
    """
    if report.interrupted or not causes_to_tell(report):
        return
    try:
        with _workers(report.plan.workers) as workers:
            for name, cause in _causes(report, workers):
                report.tell(name, cause)
                advance()
    except KeyboardInterrupt:
        report.interrupted = True


@dataclass(frozen=True, slots=True)
class Workers:
    """What does jobs: a pool of processes, or this one."""

    pool: ProcessPoolExecutor | None

    def each(self, do: Callable[[Job], Result], jobs: Iterable[Job]) -> Iterator[Result]:
        """Yield the results of jobs, in any order."""
        if self.pool is None:
            yield from map(do, jobs)
            return
        for done in as_completed([self.pool.submit(do, job) for job in jobs]):
            yield done.result()


@contextmanager
def _workers(count: int) -> Iterator[Workers]:
    if count == 1:
        yield Workers(None)
        return
    pool = ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=quiet)
    try:
        yield Workers(pool)
    finally:
        pool.shutdown(cancel_futures=True)


def _clients(plan: Plan) -> list[Method]:
    return [method for method in plan.methods if method.family == "client"]


def _step_jobs(plan: Plan, sweep: Sweep) -> Iterator[StepJob]:
    built_in = tuple(method.name for method in plan.methods if method.family != "client")
    steps = [plan.step(sweep, x) for x in plan.steps(sweep)]
    given = {client.name: _asked(client, steps) for client in _clients(plan)}
    for i, step in enumerate(steps):
        here = {name: lists[i] for name, lists in given.items() if lists is not None}
        yield StepJob(step, built_in, here)


def _asked(client: Method, steps: Sequence[Step]) -> list[list[Answered]] | None:
    """Return what a client answers to each step, in one conversation.

    None if it does not answer all the solids.
    """
    asked = [step.questions() for step in steps]
    if not all(client.answers(q.solid) for questions in asked for q in questions):
        return None
    answers = iter(client.solve([case for questions in asked for case in cases(questions)]))
    return [[next(answers) for _ in questions] for questions in asked]


Named = tuple[tuple[str, str], Cause]
"""A cause with its sweep and method."""


def _causes(report: Report, workers: Workers) -> Iterator[Named]:
    """Yield the cause of every step at which a method breaks."""
    plan, jobs = report.plan, []
    for sweep in plan.sweeps:
        for method in plan.methods:
            ranges = report.ranges(sweep, method.name)
            for x in ranges.stable.broken if ranges else ():
                step, curve = plan.step(sweep, x), report.curve(sweep.name, method.name)
                if method.family == "client":
                    yield (sweep.name, method.name), told(step, curve, method.solve)
                else:
                    jobs.append(CauseJob(method.name, step, curve))
    yield from workers.each(_tell, jobs)


def _tell(job: CauseJob) -> Named:
    return (job.step.sweep, job.name), tell(job)


def causes_to_tell(report: Report) -> int:
    """Return how many causes there are to tell."""
    plan = report.plan
    every = (report.ranges(s, m.name) for s in plan.sweeps for m in plan.methods)
    return sum(len(ranges.stable.broken) for ranges in every if ranges)
