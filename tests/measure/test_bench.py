"""Rays are the same everywhere; errors are what was planted; what is lost is never dropped."""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Sequence
from dataclasses import replace
from math import hypot, inf, isclose, isfinite, nan, nextafter, sqrt
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Ray, Slab, Sphere
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.levels import Judge
from raycert.oracle.measure.bench.commands import command
from raycert.oracle.measure.bench.errors import Error, Spread, backward, error, judges, unit_of
from raycert.oracle.measure.bench.files import as_json, write
from raycert.oracle.measure.bench.rows import Row, as_csv, pareto, row
from raycert.oracle.measure.bench.run import BASE, Effort, Report, Scenario, run, sample, steps
from raycert.oracle.measure.bench.scenarios import SCENARIOS, SOLIDS, TIES, scenario, ten
from raycert.oracle.measure.bench.shapes import Can, heading, spoke, towards
from raycert.oracle.measure.bench.timing import FEWEST, Race, Time
from raycert.oracle.measure.methods.catalog import by_name
from raycert.oracle.measure.methods.method import ALL, Answered, Case, Method

SEEDED = {
    "random": "efb46b7c9d608610",
    "far": "843f39209d5a416c",
    "thin": "1050bcbf05a08419",
    "tilted": "55d84ec716733b14",
    "tangent": "c512df9783a9ff23",
    "rim": "110dbe989e1d5bd9",
    "tiny": "680eb0fbe923d50c",
    "huge": "09f6bff96d99ffc1",
    "boolean": "9f0f56e2ca578e63",
    "ties": "bb5d1b0f92292dd8",
}
"""The first half of the SHA-256 of 40 cases of each scenario, seed 1."""
FEW = Effort(8, 4, 2, 0.1)
BALL, CAN = Sphere((0, 0, 0), 1), Cylinder((0, 0, 0), (0, 0, 2), 1)
CHORD = Case(BALL, Ray((-3, 0.25, 0), (2, 0, 0)))


def digest(cases: Sequence[Case]) -> str:
    return hashlib.sha256(repr([tuple(case) for case in cases]).encode()).hexdigest()[:16]


@pytest.mark.parametrize("name", SCENARIOS)
def test_a_seed_gives_the_same_rays_on_every_machine(name: str) -> None:
    assert digest(scenario(name, 40)) == SEEDED[name]
    assert digest(scenario(name, 40, seed=2)) != SEEDED[name]


@pytest.mark.parametrize("name", SCENARIOS)
def test_a_scenario_has_four_solids_and_hits_and_fewer_rays_are_the_first_of_more(
    name: str,
) -> None:
    cases = scenario(name, 40)
    assert len(cases) == 40
    assert len({case.solid for case in cases}) == SOLIDS
    assert scenario(name, 4) == cases[::10]
    assert len(scenario(name, 5)) == 8
    hits = sum(bool(trace(*case).intervals) for case in cases)
    assert 15 <= hits <= 40
    assert name in ("ties",) or hits < 40


def test_scenarios_are_as_stiff_as_they_say() -> None:
    far = [hypot(*c.ray.origin) / c.solid.radius for c in scenario("far", 56)]  # type: ignore[union-attr]
    assert min(far) < 1e3
    assert max(far) > 3e7
    thin = {c.solid.radius for c in scenario("thin", 8)}  # type: ignore[union-attr]
    assert thin == {1e-3, 1e-5, 1e-7, 1e-9}
    tilts = [_tilt(c) for c in scenario("tilted", 40)]
    assert 1e-9 < min(tilts) < 1e-7
    assert 1e-3 < max(tilts) < 0.1
    large = [c.solid.radius for c in scenario("huge", 8)]  # type: ignore[union-attr]
    assert min(large) > 1e149


def _tilt(case: Case) -> float:
    assert isinstance(case.solid, Cylinder)
    w = tuple(b - a for a, b in zip(case.solid.p, case.solid.q, strict=True))
    v = case.ray.direction
    cross = (w[1] * v[2] - w[2] * v[1], w[2] * v[0] - w[0] * v[2], w[0] * v[1] - w[1] * v[0])
    return hypot(*cross) / hypot(*w) / hypot(*v)


def test_a_tie_is_a_hair_above_the_middle_of_two_doubles() -> None:
    """Without its y = 2^-j, the ray would enter exactly in the middle, above an even number."""
    for case in scenario("ties", 4 * len(TIES)):
        solid, u = case.solid, case.ray.origin
        centred = tuple(0.0 if 0 < abs(x) <= 2.0 ** -TIES[0] else x for x in u)
        exact = Judge(solid, Ray(centred, case.ray.direction), BINARY64)  # type: ignore[arg-type]
        (down, up), _ = exact.enclosures[0]
        assert exact.ulps(down, exact.exact[0][0]) == exact.ulps(up, exact.exact[0][0]) == 0.5
        assert exact.expected[0][0] == down
        assert Judge(*case, BINARY64).expected[0][0] == up


def test_powers_of_ten_are_correctly_rounded() -> None:
    assert [ten(k) for k in (-3, 0, 1, 5, 15)] == [1000.0, 1.0, 0.1, 1e-5, 1e-15]


def test_shapes_are_where_they_say() -> None:
    dice = Dice("shapes")
    can = Can.of(dice, 0.5, 3.0)
    way = spoke(dice)
    assert isclose(hypot(*way), 1)
    assert isclose(hypot(*heading(dice)), 1)
    for rise, across in ((0.0, 1.0), (0.5, 0.3), (1.2, 2.0)):
        x = can.point(rise, across, way)
        y = [a - b for a, b in zip(x, can.solid.p, strict=True)]
        height = sum(a * b for a, b in zip(y, can.n, strict=True))
        assert isclose(height, 3 * rise, abs_tol=1e-12)
        assert isclose(sqrt(hypot(*y) ** 2 - height**2), 0.5 * across, rel_tol=1e-9)
    ray = towards((1.0, 2.0, 3.0), (2.0, 4.0, 5.0), 0.5)
    assert ray.direction == (0.5, 1.0, 1.0)


def plant(case: Case, answer: Answered) -> Error:
    [judge] = judges([case])
    return error(answer, judge)


def test_planted_errors_are_measured() -> None:
    [(a, b)] = judges([CHORD])[0].expected
    right = plant(CHORD, ((a, b),))
    assert right.exact
    assert right.counts
    assert right.ulps <= 0.5
    near = plant(CHORD, ((a, nextafter(b, inf)),))
    assert 0.5 <= near.ulps <= 1.5
    assert not near.exact
    assert isclose(plant(CHORD, ((a + 0.125, b),)).radii, 0.25, rel_tol=1e-12)
    assert (plant(CHORD, ()).missed, plant(CHORD, ()).ulps) == (1, inf)
    assert plant(CHORD, ((0.0, 0.5), (a, b))).phantom == 1
    assert plant(Case(BALL, Ray((-3, 2, 0), (1, 0, 0))), ()).idle


@pytest.mark.parametrize("answer", [None, ((nan, 1.0),), ((2.0, 1.0),), ((-1.0, 1.0),)])
def test_what_is_no_list_is_a_failure(answer: Answered) -> None:
    found = plant(CHORD, answer)
    assert found.failed
    assert not found.counts
    assert backward(answer, judges([CHORD])[0], "strict") == inf


@pytest.mark.parametrize("scale", [2.0**-500, 1.0, 2.0**500])
def test_errors_in_radii_do_not_depend_on_the_scale(scale: float) -> None:
    case = Case(Sphere((0, 0, 0), scale), Ray((-3 * scale, 0.25 * scale, 0), (2 * scale, 0, 0)))
    [(a, b)] = judges([case])[0].expected
    assert isclose(plant(case, ((a, b - 0.5),)).radii, 1.0, rel_tol=1e-12)


def test_the_unit_is_the_smallest_radius_or_thickness() -> None:
    assert unit_of(Judge(CAN, CHORD.ray, BINARY64)) == 1
    assert unit_of(Judge(Slab((0, 0, 0), (0, 3, 4)), CHORD.ray, BINARY64)) == 5
    assert unit_of(Judge(Sphere((0, 0, 0), 0), CHORD.ray, BINARY64)) == 1


def test_remembering_changes_no_backward_error() -> None:
    cases = scenario("random", 4)
    for case, judge in zip(cases, judges(cases), strict=True):
        plain = Judge(*case, BINARY64)
        for name in ("textbook", "reference", "numpy-float32"):
            [answer] = by_name(name).solve([case])
            assert answer is not None
            for measure in ("strict", "squared"):
                assert backward(answer, judge, measure) == plain.backward_error(answer, measure)


@given(st.lists(st.floats(min_value=0, allow_nan=False), min_size=1, max_size=300))
def test_a_spread_is_by_rank(figures: list[float]) -> None:
    found = Spread.of(figures)
    assert found is not None
    assert found.median <= found.p99 <= found.largest == max(figures)
    assert found.median in figures
    assert sum(x > found.p99 for x in figures) <= len(figures) / 100
    assert sum(x > found.median for x in figures) <= len(figures) / 2
    assert Spread.of([]) is None


@given(st.lists(st.tuples(st.integers(0, 9), st.sampled_from([0, 1, 2, 5, inf])), max_size=20))
def test_a_front_is_what_nothing_beats(points: list[tuple[float, float]]) -> None:
    on = pareto(points)
    for (a, b), front in zip(points, on, strict=True):
        beaten = any(c <= a and d <= b and (c < a or d < b) for c, d in points)
        assert front == (b < inf and not beaten)


def clocked(name: str, seconds: Sequence[float], answer: Answered = ((1.0, 2.0),)) -> Method:
    passes = iter(seconds)
    return Method(name, "is planted", lambda cases: [answer] * len(cases), ALL, "float64",
                  timed=lambda cases: next(passes))  # fmt: skip


def test_a_race_has_minimum_median_and_quartiles() -> None:
    method = clocked("x", (8.0, 2.0, 4.0, 6.0, 10.0))
    race = Race([method], [CHORD] * 2)
    assert race.time(method) is None
    race.run(5, inf, lambda: None)
    assert race.time(method) == Time(1.0, 3.0, 2.0, 5, 2)


def test_a_slow_method_has_fewer_passes_and_a_batch_more_rays() -> None:
    slow, quick = clocked("slow", [10.0] * 9), clocked("quick", [0.1] * 9)
    batch = replace(clocked("batch", [1.0] * 9), lanes=100)
    advanced: list[int] = []
    race = Race([slow, quick, batch], [CHORD] * 8)
    race.run(9, 5.0, lambda: advanced.append(1))
    times = [race.time(m) for m in (slow, quick, batch)]
    assert [t.passes for t in times if t] == [FEWEST, 9, 5]
    assert [t.rays for t in times if t] == [8, 8, 104]
    assert len(advanced) == 27


def made(name: str, errors: Sequence[Error], best: float = 1e-6) -> Row:
    method = clocked(name, ())
    return row("random", method, Time(best, best, 0.0, 3, 8), errors, ([1.0, 2.0], [0.5, 0.5]))


def test_what_is_lost_is_counted_and_never_dropped() -> None:
    good, idle = Error(1.0, 1e-16), Error(0.0, 0.0, idle=True, exact=True)
    lost, extra = Error(inf, inf, missed=1), Error(inf, inf, phantom=2)
    found = made("x", [good, good, idle, lost, extra, Error(inf, inf, failed=True)])
    assert (found.rays, found.exact, found.wrong, found.failures, found.lost) == (6, 1, 2, 1, 3)
    assert (found.missed, found.phantom) == (1, 2)
    assert found.ulps == Spread(inf, inf, inf)
    assert found.ulps_counted == Spread(1.0, 1.0, 1.0)
    none = made("x", [lost, idle, idle])
    assert none.ulps == Spread(inf, inf, inf)
    assert none.ulps_counted is None


def test_rows_are_strict_json_and_a_flat_table() -> None:
    rows = [made("x", [Error(1.0, 1e-16), Error(inf, inf, missed=1)]), made("y", [])]
    data = [json.loads(json.dumps(r.as_json(), allow_nan=False)) for r in rows]
    assert data[0]["ulps"] == {"median": 1.0, "p99": None, "largest": None}
    assert data[0]["bits_counted"]["median"] == 1.0
    assert data[0]["missed_pairs"] == 1
    table = list(csv.DictReader(io.StringIO(as_csv(rows))))
    assert [line["method"] for line in table] == ["x", "y"]
    assert table[0]["ulps_p99"] == ""
    assert float(table[0]["seconds_per_ray_min"]) == 1e-6
    assert as_csv([]) == ""


def test_a_run_grades_all_methods_on_the_same_rays() -> None:
    methods = [by_name(name) for name in ("textbook", "reference", "oracle", "reference-batch")]
    advanced: list[int] = []
    report = run(["random", "boolean"], methods, FEW, advance=lambda: advanced.append(1))
    assert report.scenarios == ["random", "boolean"]
    assert len(advanced) == steps(report.scenarios, methods, FEW)
    for name in report.scenarios:
        rows = {r.method.name: r for r in report.of(name)}
        assert list(rows) == [m.name for m in methods]
        assert rows[BASE].ratio == 1
        assert rows[BASE].exact == 8
        assert rows[BASE].front
        assert rows["reference-batch"].front
        assert rows["reference"].ulps == rows["reference-batch"].ulps
        for r in rows.values():
            assert r.ratio is not None
            assert isclose(r.ratio, r.time.best / rows[BASE].time.best)
            assert r.strict is not None
            assert r.sample == 4
            assert r.lost == 0


def test_a_method_that_does_not_answer_a_scenario_is_named() -> None:
    balls = replace(by_name("textbook"), solids=frozenset({"sphere"}))
    report = run(["random"], [balls, by_name("oracle")], FEW)
    assert [r.method.name for r in report.rows] == ["oracle"]
    assert report.notes == ["random: not for textbook"]


@pytest.mark.parametrize(("call", "rows"), [(1, 0), (2, 1), (4, 2), (5, 3)])
def test_an_interrupted_run_keeps_what_it_has(call: int, rows: int) -> None:
    """A method is called three times a scenario: for its answers, and in each pass."""
    calls: list[int] = []

    def solve(cases: Sequence[Case]) -> list[Answered]:
        calls.append(1)
        if len(calls) == call:
            raise KeyboardInterrupt
        return [()] * len(cases)

    fragile = Method("fragile", "is planted", solve, ALL, "float64")
    report = run(["random", "far"], [by_name("oracle"), fragile], Effort(4, 2, 2, 0.1))
    assert report.interrupted
    assert len(report.rows) == rows
    json.dumps(as_json(report), allow_nan=False)


def test_the_forward_errors_of_what_was_timed_outlive_an_interruption() -> None:
    def timed(cases: Sequence[Case]) -> float:
        raise KeyboardInterrupt

    stops = replace(by_name("textbook"), timed=timed, name="stops")
    one = Scenario("random", scenario("random", 8), [by_name("oracle"), stops], FEW)
    with pytest.raises(KeyboardInterrupt):
        one.run(lambda: None)
    [found] = one.rows()
    assert found.method.name == "oracle"
    assert found.exact == 8
    assert found.strict is None
    assert found.sample == 0


def test_a_sample_is_drawn_without_repeats() -> None:
    assert sample(5, 9) == [0, 1, 2, 3, 4]
    drawn = sample(100, 20)
    assert drawn == sorted(set(drawn))
    assert len(drawn) == 20
    assert len({i % 4 for i in drawn}) == 4


def test_files_hold_the_rows_the_machine_and_the_seed(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    report = run(["ties"], [by_name("oracle"), by_name("textbook")], FEW, seed=7)
    paths, troubles = write(report, tmp_path)
    assert troubles == []
    names = {"bench.json", "bench.csv", "bench-ties.svg", "bench-ties.png"}
    assert {path.name for path in paths} == names == {path.name for path in tmp_path.iterdir()}
    data = json.loads((tmp_path / "bench.json").read_text())
    assert data["seed"] == 7
    assert data["effort"]["rays"] == 8
    assert [r["method"] for r in data["rows"]] == ["oracle", "textbook"]
    place = data["environment"]
    assert {"tool", "python", "machine", "processor", "packages", "load"} <= set(place)
    assert all(isfinite(x) for x in place["load"])


def test_a_report_of_nothing_is_written_too(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    paths, _ = write(Report(1, FEW, interrupted=True), tmp_path)
    assert [path.name for path in paths] == ["bench.json", "bench.csv"]
    assert json.loads(paths[0].read_text())["interrupted"] is True


def test_a_whole_command_is_timed() -> None:
    timing = command("--help", 2)
    assert timing.name == "raycert --help"
    assert 0 < timing.best <= timing.median
