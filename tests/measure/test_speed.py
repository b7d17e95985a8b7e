"""Ways take turns, answers are looked at, and planted wrong ones are seen: never a time itself."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from math import cos, inf, nan, pi
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from raycert.cases.model import Cylinder, Ray
from raycert.oracle.measure.methods.method import FAILURES, Case, Method, one_by_one
from raycert.oracle.measure.methods.programs import exact
from raycert.oracle.measure.price import Row as Measured
from raycert.oracle.measure.speed import certified, clock, libraries, run, scalar, scenes
from raycert.oracle.measure.speed.casters import CASTERS, SIDES, Caster
from raycert.oracle.measure.speed.casting import CASTS, QUESTIONS, Cast, Hits, cast
from raycert.oracle.measure.speed.clock import FEWEST, THREADS, race
from raycert.oracle.measure.speed.libraries import check
from raycert.oracle.measure.speed.run import Effort, Report
from raycert.oracle.measure.speed.tables import show

SIZE = (16, 10)
TINY = Effort(2000, 4, (8, 5), (16, 12), 2, 1)
MESHED = ("trimesh, Embree", "embreex")


# clock


def test_ways_take_turns_and_the_last_answer_is_kept() -> None:
    seen: list[str] = []

    def way(name: str) -> int:
        seen.append(name)
        return len(seen)

    times = race({"a": lambda: way("a"), "b": lambda: way("b")}, 3)
    assert seen == ["a", "b"] * 3
    assert [times[name].answer for name in "ab"] == [5, 6]
    assert all(0 <= times[name].seconds < inf for name in "ab")


def test_a_way_that_has_had_its_seconds_stops_after_the_fewest() -> None:
    seen: list[str] = []
    race({"a": lambda: seen.append("a")}, 9, patience=-1.0)
    assert len(seen) == FEWEST
    race({"a": lambda: seen.append("a")}, 0)
    assert len(seen) == 2 * FEWEST


def test_the_least_time_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    ticks = iter([0.0, 5.0, 5.0, 7.0, 7.0, 10.0])
    monkeypatch.setattr(clock.time, "process_time", lambda: next(ticks))
    assert race({"a": lambda: None}, 3)["a"].seconds == 2.0


@pytest.mark.parametrize("loaded", [True, False])
def test_threads_are_set_only_before_anybody_reads_them(
    loaded: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    environ: dict[str, str] = {}
    monkeypatch.setattr(clock, "os", SimpleNamespace(environ=environ))
    modules = {"numpy": np} if loaded else {}
    monkeypatch.setattr(clock, "sys", SimpleNamespace(modules=modules))
    clock.one_thread()
    assert environ == ({} if loaded else dict.fromkeys(THREADS, "1"))


# certified


def measured(scenario: str = "random", **ratios: float) -> Measured:
    shares = {"float64": 0.5, "double-double": 0.5, "rational": 0.0, "integer": 0.0}
    ns = {name: 100.0 * ratio for name, ratio in ratios.items()}
    return Measured("sphere", scenario, 100_000, 0.3, 100.0, ns, shares)


@pytest.mark.parametrize(
    ("one", "met"),
    [
        (measured(numpy=8.0, numba=1.0), {"numpy": True, "numba": True, "integer": True}),
        (measured(numpy=8.1, numba=1.1), {"numpy": False, "numba": False, "integer": True}),
        (measured(numpy=3.0), {"numpy": True, "integer": True}),
        (measured("far", numpy=9.0, numba=2.0), {"integer": True}),
    ],
)
def test_aims_on_ratios_hold_for_random_rays_and_the_engines_there(
    one: Measured, met: dict[str, bool]
) -> None:
    assert certified.row(one).met == met


@pytest.mark.parametrize(
    ("scenario", "share", "met"),
    [
        ("far", 0.00009, True),
        ("far", 0.0001, False),
        ("axis-aligned", 0.009, True),
        ("axis-aligned", 0.01, False),
    ],
)
def test_aims_at_the_integers(scenario: str, share: float, met: bool) -> None:
    one = measured(scenario)
    assert certified.row(replace(one, shares=one.shares | {"integer": share})).met == {
        "integer": met
    }


def test_a_row_for_each_solid_and_scenario() -> None:
    rows = list(certified.rows(500, 1, 1))
    assert len({(row.solid, row.scenario) for row in rows}) == len(rows) == certified.steps()
    for row in rows:
        assert sum(row.shares.values()) == pytest.approx(1)
        assert "numpy" in row.ratios
        assert row.rays == 500


# scalar and arb


@pytest.mark.parametrize("scenario", scalar.SCENARIOS)
def test_rays_are_as_many_as_asked_and_the_seeds_own(scenario: str) -> None:
    one, again, other = (scalar.cases(scenario, 7, seed) for seed in (1, 1, 2))
    assert one == again != other
    assert len(one) == 7
    assert len({case.solid for case in one}) >= 2


def test_each_ray_of_the_touching_ones_touches() -> None:
    lists = [exact(*case) for case in scalar.cases("touching", 60, 1)]
    assert all(len(pairs) == 1 and pairs[0][0] == pairs[0][1] for pairs in lists)
    assert len({pairs[0][0] for pairs in lists}) > 6


@pytest.mark.parametrize("scenario", scalar.SCENARIOS)
def test_arb_is_right_or_undecided(scenario: str) -> None:
    arb = pytest.importorskip("raycert.oracle.measure.speed.arb")
    pytest.importorskip("flint")
    decided = 0
    for case in scalar.cases(scenario, 120, 5):
        try:
            assert arb.intersect(*case) == exact(*case)
            decided += 1
        except arb.Undecided:
            assert scenario == "touching"
    assert decided > 60
    assert (decided < 120) == (scenario == "touching")


CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)


@pytest.mark.parametrize(
    ("ray", "pairs"),
    [
        (Ray((-3, 0, 1), (1, 0, 0)), ((2.0, 4.0),)),
        (Ray((0, 0, 1), (3, 0, 0)), ((0.0, 1 / 3),)),
        (Ray((-1, 1, 1), (1, 0, 0)), ((1.0, 1.0),)),
        (Ray((1, 0, -3), (0, 0, -1)), ()),
        (Ray((1, 0, -3), (0, 0, 1)), ((3.0, 5.0),)),
        (Ray((-3, 0, 2), (1, 0, 0)), ((2.0, 4.0),)),
        (Ray((-3, 0, 2.5), (1, 0, 0)), ()),
        (Ray((5, 5, 1), (1, 0, 0)), ()),
        (Ray((2, 0, 1), (0, 0, 1)), ()),
        (Ray((0, 0, 1), (0, 0, 0)), ((0.0, inf),)),
    ],
)
def test_arb_decides_what_is_exact_in_bits(
    ray: Ray, pairs: tuple[tuple[float, float], ...]
) -> None:
    pytest.importorskip("flint")
    from raycert.oracle.measure.speed.arb import intersect

    assert intersect(CAN, ray) == pairs == exact(CAN, ray)


def test_no_number_of_bits_tells_arb_of_a_touch_at_a_third() -> None:
    flint = pytest.importorskip("flint")
    from raycert.oracle.measure.speed.arb import Undecided, intersect

    rim = Ray((-2, 0, 1), (3, 0, -3))
    assert exact(CAN, rim) == ((1 / 3, 1 / 3),)
    before = flint.ctx.prec
    with pytest.raises(Undecided, match="bits"):
        intersect(CAN, rim)
    assert flint.ctx.prec == before
    assert issubclass(Undecided, FAILURES)


def planted(name: str, answer: object) -> Method:
    return Method(name, "", lambda cases: [answer] * len(cases), frozenset(), "exact")  # type: ignore[list-item]


def test_what_is_wrong_and_what_is_undecided_is_counted() -> None:
    oracle = Method("oracle", "", one_by_one(exact), frozenset(), "exact")
    some = [oracle, planted("wild", ((-1.0, 7.0),)), planted("silent", None)]
    for rows in scalar.rows(6, 1, 1, some):
        assert [(r.rounded, r.undecided, r.wrong) for r in rows] == [
            (6, 0, 0),
            (0, 0, 6),
            (0, 6, 0),
        ]
        assert rows[0].ratio == 1
        assert {r.rays for r in rows} == {6}


def test_what_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scalar, "find_spec", lambda name: None if name == "flint" else name)
    found, notes = scalar.methods()
    assert [m.name for m in found] == list(scalar.METHODS)
    assert notes == ["scalar: arb: not installed: flint"]
    monkeypatch.setattr(libraries, "find_spec", lambda name: None if name == "embreex" else name)
    casters, notes = libraries.here()
    assert not {c.name for c in casters} & set(MESHED)
    assert [note.rpartition(": ")[2] for note in notes] == ["embreex", "embreex"]


# libraries


@pytest.fixture(scope="module", params=CASTS)
def asked(request: pytest.FixtureRequest) -> Cast:
    return cast(request.param, SIZE, 1)


def test_rays_start_outside_and_their_hits_are_the_scalar_oracles(asked: Cast) -> None:
    found = asked.exact("all")
    assert len(found.t) > 10
    assert (found.t > 0).all()
    for i, (u, v) in enumerate(zip(asked.origins.tolist(), asked.directions.tolist(), strict=True)):
        case = Case(asked.solid, Ray(tuple(u), tuple(v)))
        ends = [t for pair in exact(*case) for t in pair]
        assert found.t[found.ray == i].tolist() == ends
        first = asked.exact("first")
        assert first.t[first.ray == i].tolist() == ends[:1]
    if asked.scene is not None:
        assert (asked.origins == asked.origins[0]).all()
        assert len(asked.origins) == SIZE[0] * SIZE[1]


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("caster", CASTERS, ids=lambda caster: caster.name)
def test_each_library_answers_the_question_as_well_as_it_can(
    asked: Cast, caster: Caster, question: str
) -> None:
    """A formula in doubles is right; a mesh is, where its facets are, in binary32."""
    for package in caster.needs:
        pytest.importorskip(package)
    way = caster.way(asked, question)
    if way is None:
        assert caster.name == "embreex" or (question, asked.inner) != ("first", None)
        return
    found = way.read(way.run())
    wrong, error = check(found, asked.exact(question), len(asked.origins))
    assert error is not None
    if caster.name in MESHED:
        assert wrong == 0
        on_the_surface(asked, found)
        return
    assert wrong == 0
    assert error < 1e-9  # raysect's own epsilon, and the largest of these casters
    assert caster.name != "oracle, batched" or error == 0


def on_the_surface(asked: Cast, found: Hits) -> None:
    """Assert that each hit is on a face, or on the facet within: binary32 at 32 about a mesh."""
    loose = 32 * 2.0**-22
    p, q = np.array(asked.outer.p), np.array(asked.outer.q)
    n = (q - p) / np.linalg.norm(q - p)
    y = asked.origins[found.ray] + found.t[:, None] * asked.directions[found.ray] - p
    height, across = y @ n, np.linalg.norm(y - (y @ n)[:, None] * n, axis=1)
    on = (abs(height) < loose) | (abs(height - np.linalg.norm(q - p)) < loose)
    for wall in (asked.outer, asked.inner):
        if wall is not None:
            on |= (across < wall.radius + loose) & (across > wall.radius * cos(pi / SIDES) - loose)
    assert on.all()


TRUTH = Hits(np.array([0, 0, 2, 2]), np.array([1.0, 2.0, 3.0, 4.0]))


@pytest.mark.parametrize(
    ("ray", "t", "verdict"),
    [
        ([0, 0, 2, 2], [1, 2, 3, 4], (0.0, 0.0)),
        ([2, 0, 2, 0], [4, 2, 3, 1], (0.0, 0.0)),
        ([0, 0, 2, 2], [1, 2, 3, 5], (0.0, 0.25)),
        ([0, 0, 2], [1, 2, 3], (0.25, 0.0)),
        ([0, 0, 2, 2, 3], [1, 2, 3, 4, 9], (0.25, 0.0)),
        ([0, 0, 2, 2], [1, 2, 3, nan], (0.25, 0.0)),
        ([1, 1, 3, 3], [1, 2, 3, 4], (1.0, None)),
        ([], [], (0.5, None)),
    ],
)
def test_a_planted_fault_is_wrong_or_an_error(
    ray: list[int], t: list[float], verdict: tuple[float, float | None]
) -> None:
    found = Hits(np.array(ray, int), np.array(t, float))
    assert check(found, TRUTH, 4) == verdict


def test_rows_are_in_units_of_the_reference(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(libraries, "CASTS", ("pipe",))
    ours = [c for c in CASTERS if c.needs == ("numpy",)]
    first, every = libraries.rows((6, 4), 1, 1, ours)
    assert [r.question for r in (*first, *every)] == ["first", "first", "all", "all"]
    assert first[0].ratio == every[0].ratio == 1
    assert first[1].ratio == pytest.approx(first[1].ns / first[0].ns)


# solids


def test_pictures_are_the_same_with_the_plan() -> None:
    rows = list(scenes.rows((16, 12), 5, 1))
    assert [r.solids for r in rows] == [1, 2, 5]
    assert all(r.same for r in rows)
    assert all(r.ratio == pytest.approx(r.plain_us / r.planned_us) for r in rows)


def test_a_picture_that_is_not_the_same_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        scenes, "_picture", lambda scene, off: np.full(4, 1.0 + 2.0**-52 * bool(off))
    )
    assert [r.same for r in scenes.rows((2, 2), 1, 1)] == [False]


# run and tables


def test_all_sections_make_a_report_that_is_plain_data() -> None:
    report = run.run(run.SECTIONS, TINY)
    assert not report.interrupted
    form = json.loads(json.dumps(report.as_json(), allow_nan=False))
    assert list(form["sections"]) == list(run.SECTIONS)
    assert all(form["sections"].values())
    assert form["environment"]["packages"]["numpy"] == np.__version__
    assert form["aims"]["ratios"] == {"numba": 1.0, "numpy": 8.0}
    text = shown(report)
    for words in ("axis-aligned", "undecided", "trace_batch", "with nothing left out", "seed 1"):
        assert words in text


def test_steps_are_the_advances_of_a_run() -> None:
    done: list[int] = []
    run.run(("scalar", "solids"), TINY, advance=lambda: done.append(1))
    assert len(done) == run.steps(("scalar", "solids"), TINY)


def test_what_is_measured_survives_an_interruption() -> None:
    def stop() -> None:
        raise KeyboardInterrupt

    report = run.run(("solids", "scalar"), TINY, advance=stop)
    assert report.interrupted
    assert [len(rows) for rows in report.sections.values()] == [1]


def test_missed_aims_and_other_bits_are_marked() -> None:
    missed = certified.row(measured(numpy=9.5, numba=0.5))
    other = scenes.Row(3, (4, 4), 1.0, 2.0, 2.0, False)
    text = shown(Report(1, TINY, {"certified": [missed], "solids": [other]}))
    assert "! 9.5" in text
    assert "certified, 100000 rays in a call" in text
    assert "! 0.5" not in text
    assert "NO" in text


def test_the_facets_of_a_mesh_are_stated() -> None:
    row = libraries.Row("camera", "first", "embreex", "run", 256, 9, 1.0, 1.0, 0.0, None)
    assert "embreex, 256" in shown(Report(1, TINY, {"libraries": [row]}))
    caster = CASTERS[-1]
    for package in caster.needs:
        pytest.importorskip(package)
    way = caster.way(cast("camera", (4, 3), 1), "first")
    assert way is not None
    assert way.facets == SIDES


def shown(report: Report) -> str:
    file = io.StringIO()
    show(report, Console(file=file, width=160))
    return file.getvalue()
