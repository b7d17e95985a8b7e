"""Ways raced over sets of rays: what each costs, how wrong it is. `bench` in one word.

For each set every way answers once, unclocked, which loads what it needs; then the passes in turn;
then the errors. An interruption ends it with what is measured by then: the forward errors of what
has been timed are still taken.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf, isinf, log2
from typing import Any

from raycert.cases.dice import Dice
from raycert.cases.interrupts import interruptible
from raycert.oracle.measure.clock import Race, Time
from raycert.oracle.measure.errors import Error, Referee, Spread, backward, referees
from raycert.oracle.measure.files import Effort, Report
from raycert.oracle.measure.rays import rays_of
from raycert.oracle.measure.way import Answered, Case, Way

BASE = "oracle"
"""The way whose time the ratios are of."""
MESHES = 16
"""A mesh is far from right on every ray, in its own way: that many tell its backward error."""
SHARES = ("median", "p99", "largest")
TIMES = ("min", "median", "iqr", "passes", "rays_per_pass")
SPREADS = ("ulps", "ulps_counted", "radii_counted", "strict", "squared")


@dataclass(frozen=True)
class Figures:
    """What a way did on a set.

    `ulps` is over all rays but right misses, infinite where there is no answer or a wrong number
    of pairs; `ulps_counted` and `radii_counted` over those with the right number alone. The
    backward errors are those of a sample of `sample` rays, misses too. `ratio` is the time over
    that of the oracle, of the same run.
    """

    scenario: str
    way: Way
    time: Time
    rays: int
    exact: int
    wrong: int
    missed: int
    phantom: int
    failures: int
    ulps: Spread | None
    ulps_counted: Spread | None
    radii_counted: Spread | None
    strict: Spread | None
    squared: Spread | None
    sample: int
    ratio: float | None = None
    front: bool = False

    @property
    def lost(self) -> int:
        return self.wrong + self.failures

    def as_json(self) -> dict[str, Any]:
        """Return the row as plain data; null is infinite, or not measured."""
        return {
            "scenario": self.scenario,
            "method": self.way.name,
            "does": self.way.does,
            "family": self.way.precision,
            "rays": self.rays,
            "seconds_per_ray": dict(zip(TIMES, self.time, strict=True)),
            "ratio_to_oracle": self.ratio,
            "correctly_rounded": self.exact,
            "wrong_counts": self.wrong,
            "missed_pairs": self.missed,
            "phantom_pairs": self.phantom,
            "failures": self.failures,
            **{name: _spread(getattr(self, name)) for name in SPREADS},
            "bits": _bits(self.ulps),
            "bits_counted": _bits(self.ulps_counted),
            "backward_sample": self.sample,
            "pareto": self.front,
        }


def _spread(spread: Spread | None) -> dict[str, float | None]:
    return {
        name: None if spread is None or isinf(x := getattr(spread, name)) else x for name in SHARES
    }


def _bits(spread: Spread | None) -> dict[str, float | None]:
    """Return the same in bits of error, log2(1 + ulps)."""
    return {name: None if x is None else log2(1 + x) for name, x in _spread(spread).items()}


def figures(
    scenario: str,
    way: Way,
    time: Time,
    errors: Sequence[Error],
    radii: Sequence[float] = (),
    sampled: tuple[Sequence[float], Sequence[float]] = ((), ()),
) -> Figures:
    """Return the row of a way from its errors, and the strict and squared k of a sample."""
    ends = [e for e in errors if not e.idle]
    return Figures(
        scenario=scenario,
        way=way,
        time=time,
        rays=len(errors),
        exact=sum(e.exact for e in errors),
        wrong=sum(e.pairs != 0 for e in errors),
        missed=sum(max(-e.pairs, 0) for e in errors),
        phantom=sum(max(e.pairs, 0) for e in errors),
        failures=sum(e.failed for e in errors),
        ulps=Spread.of([e.ulps for e in ends]),
        ulps_counted=Spread.of([e.ulps for e in ends if e.counts]),
        radii_counted=Spread.of(radii),
        strict=Spread.of(sampled[0]),
        squared=Spread.of(sampled[1]),
        sample=len(sampled[0]),
    )


def pareto(points: Sequence[tuple[float, float]]) -> list[bool]:
    """Say which (time, error) no other beats: none as cheap and better, nor as good and cheaper.

    What has an infinite error is on no front.
    """
    return [
        b < inf and not any(c <= a and d <= b and (c, d) != (a, b) for c, d in points)
        for a, b in points
    ]


def fronts(rows: Sequence[Figures]) -> list[bool]:
    """Say which rows are on the front of their kind: batches, or one ray at a time."""
    on: dict[int, bool] = {}
    for kind in (True, False):
        some = [i for i, row in enumerate(rows) if row.way.batch == kind]
        places = [(rows[i].time.best, u.p99 if (u := rows[i].ulps) else inf) for i in some]
        on.update(zip(some, pareto(places), strict=True))
    return [on[i] for i in range(len(rows))]


def steps(names: Sequence[str], ways: Sequence[Way], effort: Effort) -> int:
    """Return how often a full run advances at most."""
    return len(names) * len(ways) * (effort.passes + 2)


def run(
    names: Sequence[str],
    ways: Sequence[Way],
    report: Report,
    advance: Callable[[], None] = lambda: None,
    section: str = "methods",
) -> None:
    """Add to the report what the ways do on sets; partial after KeyboardInterrupt."""
    rows = report.sections.setdefault(section, [])
    for name in names:
        course = Course(name, rays_of(name, report.effort.rays, report.seed), ways, report.effort)
        report.notes += course.notes
        try:
            with interruptible():
                course.run(advance)
        except KeyboardInterrupt:
            report.interrupted = True
            return
        finally:
            rows += course.rows()


class Course:
    """One set on the way, from which rows can be made at any time."""

    def __init__(self, name: str, cases: list[Case], ways: Sequence[Way], effort: Effort) -> None:
        """Take the ways that answer all of the solids."""
        self.name, self.cases, self.effort = name, cases, effort
        self.ways = [way for way in ways if all(way.answers(case.solid) for case in cases)]
        left = [way.name for way in ways if way not in self.ways]
        self.notes = [f"{name}: not for " + ", ".join(left)] if left else []
        self.referees: list[Referee] = referees(cases)
        self.answers: dict[str, list[Answered]] = {}
        self.backward: dict[str, tuple[list[float], list[float]]] = {}
        self.race = Race({})
        self._sizes = {way.name: -(-way.lanes // len(cases)) for way in self.ways}

    def run(self, advance: Callable[[], None]) -> None:
        for way in self.ways:
            self.answers[way.name] = way.solve(self.cases)
            advance()
        self.race = Race(
            {way.name: way.call(self.cases * self._sizes[way.name]) for way in self.ways}
        )
        self.race.run(self.effort.passes, self.effort.seconds, advance)
        for way in self.ways:
            size = MESHES if way.precision == "mesh" else len(self.cases)
            at = sample(len(self.cases), min(self.effort.sample, size))
            each = [(self.referees[i], self.answers[way.name][i]) for i in at]
            self.backward[way.name] = backward(each)
            advance()

    def rows(self) -> list[Figures]:
        """Return the rows of all ways that have been timed, front and ratios included."""
        rows = [self._row(way) for way in self.ways if self.race.seconds.get(way.name)]
        base = next((row.time.best for row in rows if row.way.name == BASE), None)
        return [
            replace(row, front=front, ratio=row.time.best / base if base else None)
            for row, front in zip(rows, fronts(rows), strict=True)
        ]

    def _row(self, way: Way) -> Figures:
        time = Time.of(self.race.seconds[way.name], len(self.cases) * self._sizes[way.name])
        each = list(zip(self.referees, self.answers[way.name], strict=True))
        errors = [referee.forward(answer) for referee, answer in each]
        radii = [r.radii(a) for (r, a), e in zip(each, errors, strict=True) if e.counts and a]
        return figures(self.name, way, time, errors, radii, self.backward.get(way.name, ([], [])))


def sample(rays: int, size: int) -> list[int]:
    """Return which rays are judged backward: drawn, as rays repeat in steps; all if size allows."""
    dice, left = Dice("bench sample"), list(range(rays))
    return sorted(left.pop(dice.integer(0, len(left) - 1)) for _ in range(min(size, rays)))
