"""All ways answer the same rays; what is lost is counted and never dropped."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import replace
from math import inf, isclose, isfinite

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.oracle.measure.catalog import BY_NAME
from raycert.oracle.measure.clock import Time, Timed
from raycert.oracle.measure.errors import Error, Spread
from raycert.oracle.measure.files import Effort, Report, as_csv
from raycert.oracle.measure.race import BASE, Course, Figures, figures, pareto, run, sample, steps
from raycert.oracle.measure.rays import rays_of
from raycert.oracle.measure.way import Answered, Case, Way

FEW = Effort(8, 4, 2, 0.1)


def ran(names: Sequence[str], ways: Sequence[Way], effort: Effort = FEW) -> Report:
    report = Report(1, effort)
    run(names, ways, report)
    return report


@given(st.lists(st.tuples(st.integers(0, 9), st.sampled_from([0, 1, 2, 5, inf])), max_size=20))
def test_a_front_is_what_nothing_beats(points: list[tuple[float, float]]) -> None:
    on = pareto(points)
    for (a, b), front in zip(points, on, strict=True):
        beaten = any(c <= a and d <= b and (c < a or d < b) for c, d in points)
        assert front == (b < inf and not beaten)


def made(name: str, errors: Sequence[Error], best: float = 1e-6) -> Figures:
    way = Way(name, "is planted", lambda cases: [])
    backward = [1.0, 2.0], [0.5, 0.5]
    return figures("random", way, Time(best, best, 0.0, 3, 8), errors, [1e-16], backward)


def test_what_is_lost_is_counted_and_never_dropped() -> None:
    good, idle = Error(1.0), Error(0.0, idle=True, exact=True)
    lost, extra = Error(inf, -1), Error(inf, 2)
    row = made("x", [good, good, idle, lost, extra, Error(inf, failed=True)])
    assert (row.rays, row.exact, row.wrong, row.failures, row.lost) == (6, 1, 2, 1, 3)
    assert (row.missed, row.phantom) == (1, 2)
    assert row.ulps == Spread(inf, inf, inf)
    assert row.ulps_counted == Spread(1.0, 1.0, 1.0)
    none = made("x", [lost, idle, idle])
    assert none.ulps == Spread(inf, inf, inf)
    assert none.ulps_counted is None


def test_rows_are_strict_json_and_a_flat_table() -> None:
    rows = [made("x", [Error(1.0), Error(inf, -1)]), made("y", [])]
    data = [json.loads(json.dumps(r.as_json(), allow_nan=False)) for r in rows]
    assert data[0]["ulps"] == {"median": 1.0, "p99": None, "largest": None}
    assert data[0]["bits_counted"]["median"] == 1.0
    assert data[0]["missed_pairs"] == 1
    table = list(csv.DictReader(io.StringIO(as_csv(rows))))
    assert [line["method"] for line in table] == ["x", "y"]
    assert table[0]["ulps_p99"] == ""
    assert float(table[0]["seconds_per_ray_min"]) == 1e-6
    assert as_csv([]) == ""


def test_a_run_grades_all_ways_on_the_same_rays() -> None:
    ways = [BY_NAME[name] for name in ("textbook", "reference", "oracle", "reference-batch")]
    advanced: list[int] = []
    report = Report(1, FEW)
    run(["random", "boolean"], ways, report, lambda: advanced.append(1))
    assert report.sets() == ["random", "boolean"]
    assert len(advanced) == steps(report.sets(), ways, FEW)
    for name in report.sets():
        rows = {r.way.name: r for r in report.rows(name)}
        assert list(rows) == [way.name for way in ways]
        assert rows[BASE].ratio == 1
        assert rows[BASE].exact == 8
        assert rows[BASE].front
        assert rows["reference-batch"].front
        assert rows["reference"].ulps == rows["reference-batch"].ulps
        assert rows["reference-batch"].time.rays == 4096
        for r in rows.values():
            assert r.ratio is not None
            assert isclose(r.ratio, r.time.best / rows[BASE].time.best)
            assert r.strict is not None
            assert r.sample == 4
            assert r.lost == 0
    place = json.loads(json.dumps(report.as_json(), allow_nan=False))["environment"]
    assert {"tool", "python", "machine", "processor", "packages", "load"} <= set(place)
    assert all(isfinite(x) for x in place["load"])


def test_a_way_that_does_not_answer_a_set_is_named() -> None:
    balls = replace(BY_NAME["textbook"], solids=frozenset({"sphere"}))
    report = ran(["random"], [balls, BY_NAME["oracle"]])
    assert [r.way.name for r in report.rows("random")] == ["oracle"]
    assert report.notes == ["random: not for textbook"]


@pytest.mark.parametrize(("call", "rows"), [(1, 0), (2, 1), (4, 2), (5, 3)])
def test_an_interrupted_run_keeps_what_it_has(call: int, rows: int) -> None:
    """A way is called three times a set: for its answers, and in each pass."""
    calls: list[int] = []

    def solve(cases: Sequence[Case]) -> list[Answered]:
        calls.append(1)
        if len(calls) == call:
            raise KeyboardInterrupt
        return [()] * len(cases)

    fragile = Way("fragile", "is planted", solve)
    report = ran(["random", "far"], [BY_NAME["oracle"], fragile], Effort(4, 2, 2, 0.1))
    assert report.interrupted
    assert len(report.sections["methods"]) == rows
    json.dumps(report.as_json(), allow_nan=False)


def test_the_forward_errors_of_what_was_timed_outlive_an_interruption() -> None:
    def stop() -> Timed:
        raise KeyboardInterrupt

    stops = replace(BY_NAME["textbook"], ready=lambda cases: stop, name="stops")
    course = Course("random", rays_of("random", 8), [BY_NAME["oracle"], stops], FEW)
    with pytest.raises(KeyboardInterrupt):
        course.run(lambda: None)
    [row] = course.rows()
    assert row.way.name == "oracle"
    assert row.exact == 8
    assert row.strict is None
    assert row.sample == 0


def test_a_sample_is_drawn_without_repeats() -> None:
    assert sample(5, 9) == [0, 1, 2, 3, 4]
    drawn = sample(100, 20)
    assert drawn == sorted(set(drawn))
    assert len(drawn) == 20
    assert len({i % 4 for i in drawn}) == 4
