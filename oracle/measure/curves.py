"""Ways along the sweeps, each with a curve of its errors: `stress` in one word.

Built-in ways answer in the worker processes, which judge all answers; a client is asked from here,
one sweep at a time. Then the causes of what broke. Interrupted, a run keeps all the steps that are
done. As data, a number that no k accepts is null; steps are given as text, exactly (1e-7, 2^-53),
and as the nearest double.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import as_completed
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from fractions import Fraction
from typing import Any, NamedTuple, TypeVar

from raycert.cases.interrupts import interruptible
from raycert.cases.workers import Workers
from raycert.oracle.certify.environment import environment
from raycert.oracle.measure.catalog import BY_NAME
from raycert.oracle.measure.causes import Cause, diagnose
from raycert.oracle.measure.errors import Referee
from raycert.oracle.measure.facets import CASTERS, Sides, slope
from raycert.oracle.measure.files import as_csv, finite
from raycert.oracle.measure.ranges import LEVELS, Ground, Point, Range, Ranges, ranges_of, spelled
from raycert.oracle.measure.sweeps import SWEEPS, Sample, Sweep
from raycert.oracle.measure.way import Answered, Solve, Way

SAMPLES, QUICK_SAMPLES, QUICK_EVERY = 24, 8, 3
FORMAT = 1
"""The version of the form of stress.json."""
KEY = ("sweep", "step", "value", "method")
Advance = Callable[..., None]
Curve = dict[Fraction, Point]
Given = Mapping[str, Sequence[Answered]]
Data = dict[str, Any]
Task = TypeVar("Task")
Result = TypeVar("Result")


# What a worker process does. Its arguments and results travel.


class Stop(NamedTuple):
    """One step of a sweep: `x` of the sweep of this name, so many samples of a seed."""

    sweep: str
    x: Fraction
    seed: int
    size: int

    def samples(self, x: Fraction) -> list[Sample]:
        return SWEEPS[self.sweep].samples(x, self.seed, self.size)

    def referees(self) -> list[Referee]:
        """Return what is asked: the samples that are a solid in doubles."""
        return [one for sample in self.samples(self.x) if (one := sample.referee()) is not None]


class Walked(NamedTuple):
    """What came of a step: its ground, and a point for each way that answers such solids."""

    stop: Stop
    ground: Ground
    points: Mapping[str, Point]


def walk(task: tuple[Stop, Sequence[str], Given]) -> Walked | None:
    """Return what came of a step, of built-in ways and of answers given; None without a question.

    Rounding may leave no question.
    """
    stop, names, given = task
    asked = stop.referees()
    if not asked:
        return None
    points = {name: Point.over(asked, answers) for name, answers in given.items()}
    for name in names:
        fit = [one for one in asked if BY_NAME[name].answers(one.solid)]
        if fit:
            points[name] = Point.over(fit, BY_NAME[name].solve([one.case for one in fit]))
    return Walked(stop, Ground.over(asked), points)


def explain(task: tuple[str, Stop, Curve]) -> tuple[str, Stop, Cause]:
    name, stop, curve = task
    return name, stop, cause_of(stop, curve, BY_NAME[name].solve)


def cause_of(stop: Stop, curve: Mapping[Fraction, Point], solve: Solve) -> Cause:
    return diagnose(SWEEPS[stop.sweep], curve, stop.x, solve, stop.samples)


@contextmanager
def workers(
    count: int,
) -> Iterator[Callable[[Callable[[Task], Result], Iterable[Task]], Iterator[Result]]]:
    """Yield what does tasks, in any order, in so many processes: with one, in this one."""
    if count == 1:
        yield map
        return

    with Workers(count) as pool:

        def each(do: Callable[[Task], Result], tasks: Iterable[Task]) -> Iterator[Result]:
            for done in as_completed([pool.submit(do, task) for task in tasks]):
                yield done.result()

        yield each


# The run.


@dataclass(frozen=True)
class Itinerary:
    """What to run. Clients are asked from this process."""

    ways: tuple[Way, ...]
    sweeps: tuple[Sweep, ...] = tuple(SWEEPS.values())
    seed: int = 1
    quick: bool = False
    workers: int = 2

    @property
    def count(self) -> int:
        return QUICK_SAMPLES if self.quick else SAMPLES

    def steps(self, sweep: Sweep) -> tuple[Fraction, ...]:
        return sweep.coarse(QUICK_EVERY if self.quick else 1)

    def stop(self, sweep: Sweep, x: Fraction) -> Stop:
        return Stop(sweep.name, x, self.seed, self.count)

    @property
    def total(self) -> int:
        return sum(len(self.steps(sweep)) for sweep in self.sweeps)

    def tasks(self, sweep: Sweep) -> Iterator[tuple[Stop, Sequence[str], Given]]:
        """Yield the work on each step of a sweep, clients' answers included."""
        built_in = tuple(way.name for way in self.ways if way.precision != "client")
        clients = [way for way in self.ways if way.precision == "client"]
        stops = [self.stop(sweep, x) for x in self.steps(sweep)]
        lists = {client.name: _asked(client, stops) for client in clients}
        for i, stop in enumerate(stops):
            yield stop, built_in, {name: each[i] for name, each in lists.items() if each}


def _asked(client: Way, stops: Sequence[Stop]) -> list[list[Answered]] | None:
    """Return what a client answers to each step, in one conversation; None if not to all solids."""
    asked = [stop.referees() for stop in stops]
    if not all(client.answers(one.solid) for referees in asked for one in referees):
        return None
    answers = iter(client.solve([one.case for referees in asked for one in referees]))
    return [[next(answers) for _ in referees] for referees in asked]


@dataclass
class Stress:
    """What came of a run. Curves and grounds go by sweep; curves then by way, and by step."""

    plan: Itinerary
    grounds: dict[str, dict[Fraction, Ground]] = field(default_factory=dict)
    curves: dict[str, dict[str, Curve]] = field(default_factory=dict)
    causes: dict[tuple[str, str], list[Cause]] = field(default_factory=dict)
    interrupted: bool = False

    def add(self, walked: Walked) -> None:
        sweep, x = walked.stop.sweep, walked.stop.x
        self.grounds.setdefault(sweep, {})[x] = walked.ground
        curves = self.curves.setdefault(sweep, {})
        for name, point in walked.points.items():
            curves.setdefault(name, {})[x] = point

    def add_cause(self, name: str, stop: Stop, cause: Cause) -> None:
        """Keep a cause, in the order of the steps."""
        causes = self.causes.setdefault((stop.sweep, name), [])
        causes.append(cause)
        causes.sort(key=lambda cause: SWEEPS[stop.sweep].steps.index(cause.step))

    def curve(self, sweep: str, name: str) -> Curve:
        return self.curves.get(sweep, {}).get(name, {})

    def ranges(self, sweep: Sweep, name: str) -> Ranges | None:
        """Return the ranges of a way; None where its curve lacks a step of the sweep."""
        curve, grounds = self.curve(sweep.name, name), self.grounds.get(sweep.name, {})
        if not curve or len(grounds) < len(self.plan.steps(sweep)) or len(curve) < len(grounds):
            return None
        return ranges_of(sweep, curve)

    def whole(self) -> Iterator[tuple[Sweep, Way, Ranges]]:
        """Yield each sweep and way whose curve is whole, with its ranges."""
        for sweep in self.plan.sweeps:
            for way in self.plan.ways:
                if (ranges := self.ranges(sweep, way.name)) is not None:
                    yield sweep, way, ranges

    def broken(self) -> list[tuple[Way, Stop, Curve]]:
        """Return every step at which a way breaks, with its curve: what there are causes of."""
        return [
            (way, self.plan.stop(sweep, x), self.curve(sweep.name, way.name))
            for sweep, way, ranges in self.whole()
            for x in ranges["stable"].broken
        ]


def run(plan: Itinerary, on_step: Advance, on_cause: Advance = lambda: None) -> Stress:
    """Return what comes of a plan; what is known by then if the person interrupts it.

    `on_step()` is called after each step, `on_cause()` after each cause.
    """
    stress = measure(plan, on_step)
    find_causes(stress, on_cause)
    return stress


def measure(plan: Itinerary, advance: Advance) -> Stress:
    """Return the curves of a plan, without causes; `advance()` is called `plan.total` times."""
    stress = Stress(plan)
    try:
        with interruptible(), workers(plan.workers) as each:
            for sweep in plan.sweeps:
                for walked in each(walk, plan.tasks(sweep)):
                    if walked is not None:
                        stress.add(walked)
                    advance()
    except KeyboardInterrupt:
        stress.interrupted = True
    return stress


def find_causes(stress: Stress, advance: Advance) -> None:
    """Add the causes; `advance()` is called after each. What is interrupted is left as it is."""
    broken = stress.broken()
    if stress.interrupted or not broken:
        return
    built_in = [(w.name, stop, curve) for w, stop, curve in broken if w.precision != "client"]
    try:
        with interruptible():
            for way, stop, curve in broken:
                if way.precision == "client":
                    stress.add_cause(way.name, stop, cause_of(stop, curve, way.solve))
                    advance()
        with interruptible(), workers(stress.plan.workers) as each:
            for told in each(explain, built_in):
                stress.add_cause(*told)
                advance()
    except KeyboardInterrupt:
        stress.interrupted = True


# As data, and in words.


def form(stress: Stress, sides: Sequence[Sides] = ()) -> Data:
    plan = stress.plan
    slopes = {caster: slope(sides, caster) for caster in CASTERS}
    return {
        "format": FORMAT,
        "about": "backward error k, forward error and wrong counts against stiffness",
        "environment": environment(),
        "seed": plan.seed,
        "quick": plan.quick,
        "samples": plan.count,
        "complete": not stress.interrupted,
        "methods": [{"name": w.name, "does": w.does, "family": w.precision} for w in plan.ways],
        "sweeps": [_sweep(stress, sweep) for sweep in plan.sweeps],
        "ranges": range_rows(stress),
        "rows": list(rows(stress)),
        "meshes": {"slopes": finite(slopes), "rows": [finite(asdict(one)) for one in sides]},
    }


def _sweep(stress: Stress, sweep: Sweep) -> Data:
    grounds = stress.grounds.get(sweep.name, {})
    steps = [x for x in stress.plan.steps(sweep) if x in grounds]
    return {
        "name": sweep.name,
        "title": sweep.title,
        "parameter": sweep.axis,
        "mild": sweep.text(sweep.mild),
        "samples": stress.plan.count * sweep.weight,
        "steps": [_step(sweep, x) | finite(asdict(grounds[x])) for x in steps],
    }


def _step(sweep: Sweep, x: Fraction) -> Data:
    return {"step": sweep.text(x), "value": float(x)}


def rows(stress: Stress) -> Iterator[Data]:
    """Yield one row for each sweep, way and step that is known, in the order of the plan."""
    for sweep in stress.plan.sweeps:
        for way in stress.plan.ways:
            curve = stress.curve(sweep.name, way.name)
            for x in (x for x in sweep.steps if x in curve):
                about = {"sweep": sweep.name, **_step(sweep, x), "method": way.name}
                floor = {"condition": stress.grounds[sweep.name][x].floor}
                yield about | finite(asdict(curve[x]) | floor)


def table(stress: Stress) -> str:
    return as_csv(rows(stress), KEY)


def range_rows(stress: Stress) -> list[Data]:
    """Return the ranges and causes of each sweep and way whose curve is whole."""
    return [
        {"sweep": sweep.name, "method": way.name}
        | {level: _range(ranges[level], sweep) for level in LEVELS}
        | {
            "causes": [
                {
                    "at": sweep.text(cause.step),
                    "cause": cause.text,
                    "told_by": cause.told_by,
                    "broken": cause.count,
                    "restored": dict(cause.evidence),
                }
                for cause in stress.causes.get((sweep.name, way.name), [])
            ]
        }
        for sweep, way, ranges in stress.whole()
    ]


def _range(steps: Range, sweep: Sweep) -> Data:
    return {
        "text": spelled(steps, sweep),
        "low": None if steps.low is None else sweep.text(steps.low),
        "high": None if steps.high is None else sweep.text(steps.high),
        "whole": steps.whole,
        "breaks_at": [sweep.text(x) for x in steps.broken],
    }


def notes(stress: Stress, names: Sequence[str]) -> list[str]:
    """Return what breaks, in lines for people: sweep, ways, where they are stable, and why."""
    alike: dict[tuple[str, str, str], list[str]] = {}
    for sweep, way, ranges in stress.whole():
        if way.name in names and not ranges["stable"].whole:
            causes = stress.causes.get((sweep.name, way.name), [])
            why = "; ".join(dict.fromkeys(cause.text for cause in causes))
            where = spelled(ranges["stable"], sweep)
            alike.setdefault((sweep.title, where, why), []).append(way.name)
    return [
        f"{title}: {', '.join(ways)} stable {where}" + (f"; {why}" if why else "")
        for (title, where, why), ways in alike.items()
    ]
