"""All methods over all scenarios; an interruption ends it with what is measured by then.

For each scenario: every method answers once, unclocked, which loads what it needs; then the passes
in turn; then the errors. Interrupted, the forward errors of what has been timed are still taken.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from math import inf

from raycert.cases.dice import Dice
from raycert.oracle.measure.bench.errors import Error, Remembering, backward, error, judges
from raycert.oracle.measure.bench.rows import Row, pareto, row
from raycert.oracle.measure.bench.scenarios import scenario
from raycert.oracle.measure.bench.timing import Race
from raycert.oracle.measure.methods.method import Answered, Case, Method

BASE = "oracle"
"""The method whose time the ratios are of."""


@dataclass(frozen=True, slots=True)
class Effort:
    """Rays of a scenario, how many of them have a backward error, passes, seconds of a method."""

    rays: int
    sample: int
    passes: int
    seconds: float


FULL = Effort(200, 200, 7, 3.0)
QUICK = Effort(40, 16, 3, 0.3)
MESHES = 16
"""A mesh is far from right on every ray, in its own way: that many tell its backward error."""


@dataclass
class Report:
    """The rows so far, and what is to be said of them."""

    seed: int
    effort: Effort
    rows: list[Row] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    interrupted: bool = False

    @property
    def scenarios(self) -> list[str]:
        """Return the scenarios that have rows."""
        return list(dict.fromkeys(r.scenario for r in self.rows))

    def of(self, name: str) -> list[Row]:
        """Return the rows of a scenario."""
        return [r for r in self.rows if r.scenario == name]


def steps(scenarios: Sequence[str], methods: Sequence[Method], effort: Effort) -> int:
    """Return how often a full run advances at most."""
    return len(scenarios) * len(methods) * (effort.passes + 2)


def run(
    scenarios: Sequence[str],
    methods: Sequence[Method],
    effort: Effort,
    seed: int = 1,
    advance: Callable[[], None] = lambda: None,
) -> Report:
    """Return the report on methods over scenarios; partial after KeyboardInterrupt."""
    report = Report(seed, effort)
    for name in scenarios:
        one = None
        try:
            one = Scenario(name, scenario(name, effort.rays, seed), methods, effort)
            one.run(advance)
        except KeyboardInterrupt:
            report.interrupted = True
        if one is not None:
            report.notes += one.notes
            report.rows += one.rows()
        if report.interrupted:
            break
    return report


def fronts(rows: Sequence[Row]) -> list[bool]:
    """Tell which rows are on the front of their kind: batches, or one ray at a time."""

    def place(r: Row) -> tuple[float, float]:
        return r.time.best, r.ulps.p99 if r.ulps else inf

    kinds = [r.method.batch for r in rows]
    points = {
        kind: [place(r) for r, k in zip(rows, kinds, strict=True) if k == kind] for kind in kinds
    }
    on = {kind: iter(pareto(each)) for kind, each in points.items()}
    return [next(on[kind]) for kind in kinds]


class Scenario:
    """The state of one scenario, from which rows can be made at any time."""

    def __init__(
        self, name: str, cases: list[Case], methods: Sequence[Method], effort: Effort
    ) -> None:
        """Take the methods that answer all of the solids."""
        self.name, self.cases, self.effort = name, cases, effort
        self.methods = [m for m in methods if all(m.answers(case.solid) for case in cases)]
        left = [m.name for m in methods if m not in self.methods]
        self.notes = [f"{name}: not for " + ", ".join(left)] if left else []
        self.judges: list[Remembering] = judges(cases)
        self.answers: dict[str, list[Answered]] = {}
        self.backward: dict[str, tuple[list[float], list[float]]] = {}
        self.race = Race(self.methods, cases)

    def run(self, advance: Callable[[], None]) -> None:
        """Answer, race, and judge a sample backward."""
        for method in self.methods:
            self.answers[method.name] = method.solve(self.cases)
            advance()
        self.race.run(self.effort.passes, self.effort.seconds, advance)
        for method in self.methods:
            size = min(self.effort.sample, MESHES if method.family == "mesh" else len(self.cases))
            at = sample(len(self.cases), size)
            answers = self.answers[method.name]
            each = [(answers[i], self.judges[i]) for i in at]
            self.backward[method.name] = (
                [backward(answer, judge, "strict") for answer, judge in each],
                [backward(answer, judge, "squared") for answer, judge in each],
            )
            advance()

    def rows(self) -> list[Row]:
        """Return the rows of all methods that have been timed, front and ratios included."""
        found = []
        for method in self.methods:
            time = self.race.time(method)
            if time is not None:
                errors = self.errors(self.answers[method.name])
                back = self.backward.get(method.name, ([], []))
                found.append(row(self.name, method, time, errors, back))
        front = fronts(found)
        base = next((r.time.best for r in found if r.method.name == BASE), None)
        return [
            replace(r, front=on, ratio=r.time.best / base if base else None)
            for r, on in zip(found, front, strict=True)
        ]

    def errors(self, answers: Sequence[Answered]) -> list[Error]:
        """Return the forward error of each answer."""
        return [error(answer, judge) for answer, judge in zip(answers, self.judges, strict=True)]


def sample(rays: int, size: int) -> list[int]:
    """Return which rays are judged backward: drawn, as rays repeat in steps; all if size allows."""
    dice, left = Dice("bench sample"), list(range(rays))
    return sorted(left.pop(dice.integer(0, len(left) - 1)) for _ in range(min(size, rays)))
