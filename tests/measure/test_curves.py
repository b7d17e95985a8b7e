"""Curves, and what they must show of the built-in ways: on small samples, all of every sweep."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import pytest

from raycert.cases.families.sketch import ten, two
from raycert.oracle.measure.catalog import BY_NAME
from raycert.oracle.measure.curves import (
    Itinerary,
    Stop,
    Stress,
    explain,
    find_causes,
    form,
    notes,
    range_rows,
    rows,
    run,
    table,
    walk,
)
from raycert.oracle.measure.facets import Sides
from raycert.oracle.measure.ranges import MOST, Point
from raycert.oracle.measure.sweeps import SWEEPS
from raycert.oracle.measure.way import ALL, Answered, Case, Way

each = pytest.mark.parametrize("sweep", SWEEPS)


def point(method: str, sweep: str, x: object, count: int = 4) -> tuple[float, float]:
    """Return the worst strict and squared k of a method at a step."""
    found = walk((Stop(sweep, x, 1, count), (method,), {}))  # type: ignore[arg-type]
    assert found is not None
    return found.points[method].strict, found.points[method].squared


@each
def test_the_oracle_is_exact_and_the_reference_stable_over_the_whole_sweep(sweep: str) -> None:
    count = 1 if SWEEPS[sweep].weight > 1 else 3
    for x in SWEEPS[sweep].coarse(4):
        found = walk((Stop(sweep, x, 1, count), ("oracle", "reference"), {}))
        assert found is not None
        assert found.points["oracle"].inexact == 0
        assert found.points["reference"].strict <= MOST
        assert found.points["reference"].failed == 0


def test_the_strict_k_of_the_textbook_grows_with_the_distance_and_its_squared_one_does_not() -> (
    None
):
    found = [point("textbook", "far", ten(k), 8) for k in (0, 2, 4, 6, 8)]
    strict, squared = zip(*found, strict=True)
    assert list(strict) == sorted(strict)
    assert strict[0] < 8
    assert strict[-1] > 1e5
    assert max(squared) < 8


def test_the_determinant_form_breaks_near_parallel() -> None:
    assert point("determinant", "tilt-axis", ten(0))[0] <= MOST
    assert point("determinant", "tilt-axis", ten(-7))[0] > 1e3
    assert point("determinant", "tilt-wall", ten(-9), 16)[0] > 1e3


def test_c_over_q_breaks_at_tangent_starts_and_nowhere_before() -> None:
    assert point("q-root", "start", two(-40))[0] <= 1
    assert point("q-root", "start", two(-53))[1] > 1e9
    assert point("seed", "start", two(-53))[0] <= 1


def test_fifty_digits_do_not_round_what_is_hard() -> None:
    for x, exact in ((two(-20), True), (two(-320), False)):
        found = walk((Stop("hard", x, 1, 4), ("mpmath-50", "oracle"), {}))
        assert found is not None
        assert (found.points["mpmath-50"].inexact == 0) == exact
        assert found.points["oracle"].inexact == 0


FEW = Itinerary(
    (BY_NAME["textbook"], BY_NAME["oracle"]), (SWEEPS["far"], SWEEPS["hard"]), quick=True, workers=1
)


def counted(plan: Itinerary) -> tuple[Stress, list[None], list[None]]:
    steps: list[None] = []
    causes: list[None] = []
    report = run(plan, lambda: steps.append(None), lambda: causes.append(None))
    return report, steps, causes


def test_a_run_has_every_step_and_the_causes_of_what_broke() -> None:
    report, steps, causes = counted(FEW)
    assert len(steps) == FEW.total
    assert not report.interrupted
    ranges = report.ranges(SWEEPS["far"], "textbook")
    assert ranges is not None
    [cause] = report.causes["far", "textbook"]
    assert ranges["stable"].broken == (cause.step,)
    assert cause.text == "cancellation in the discriminant"
    assert set(report.causes) == {("far", "textbook")}
    assert len(causes) == len(report.broken()) == 1
    assert set(report.curve("hard", "oracle")) == set(FEW.steps(SWEEPS["hard"]))


def test_processes_find_the_same() -> None:
    here, there = run(FEW, lambda: None), run(replace(FEW, workers=2), lambda: None)
    assert here.grounds == there.grounds
    assert here.curves == there.curves
    assert here.causes == there.causes


def test_an_interrupted_run_keeps_what_it_has() -> None:
    done: list[None] = []

    def advance() -> None:
        done.append(None)
        if len(done) == 3:
            raise KeyboardInterrupt

    report = run(FEW, advance)
    assert report.interrupted
    assert len(report.curve("far", "textbook")) == 3
    assert report.ranges(SWEEPS["far"], "textbook") is None
    assert report.causes == {}


def test_interrupted_causes_leave_the_curves() -> None:
    report, _, _ = counted(FEW)
    report.causes.clear()

    def stop() -> None:
        raise KeyboardInterrupt

    find_causes(report, stop)
    assert report.interrupted
    assert set(report.causes) == {("far", "textbook")}
    assert report.ranges(SWEEPS["far"], "textbook") is not None


def test_a_client_is_asked_once_for_a_sweep_and_judged_like_others() -> None:
    asked: list[int] = []

    def solve(cases: Sequence[Case]) -> list[Answered]:
        asked.append(len(cases))
        return BY_NAME["textbook"].solve(cases)

    client = Way("mine", "is asked", solve, ALL, "client")
    far = SWEEPS["far"]
    plan = Itinerary((client, BY_NAME["textbook"]), (far,), quick=True, workers=1)
    report = run(plan, lambda: None)
    assert report.curve("far", "mine") == report.curve("far", "textbook")
    assert report.causes["far", "mine"] == report.causes["far", "textbook"]
    assert asked[0] == plan.count * len(plan.steps(far))


def test_a_client_that_does_not_answer_all_solids_is_left_out() -> None:
    def solve(cases: Sequence[Case]) -> list[Answered]:
        raise AssertionError

    client = Way("mine", "is not asked", solve, frozenset({"sphere"}), "client")
    plan = Itinerary((client,), (SWEEPS["far"],), quick=True, workers=1)
    report = run(plan, lambda: None)
    assert report.ranges(SWEEPS["far"], "mine") is None


# Steps.

STEP = Stop("far", ten(4), 1, 4)


def test_a_step_gives_a_point_for_each_method() -> None:
    found = walk((STEP, ("textbook", "oracle", "trimesh-8"), {}))
    assert found is not None
    assert set(found.points) == {"textbook", "oracle", "trimesh-8"}
    assert found.points["textbook"].strict > 64 > found.points["textbook"].squared
    assert found.points["oracle"].exact == found.ground.count == 4
    assert found.ground.decisive == 4


def test_what_a_method_does_not_answer_is_left_out() -> None:
    found = walk((Stop("tilt-wall", ten(0), 1, 1), ("trimesh-8", "oracle"), {}))
    assert found is not None
    assert set(found.points) == {"oracle"}


def test_given_answers_are_judged() -> None:
    answers = BY_NAME["oracle"].solve([one.case for one in STEP.referees()])
    found = walk((STEP, (), {"mine": answers, "none": [None] * 4}))
    assert found is not None
    assert found.points["mine"].exact == 4
    assert found.points["none"].failed == 4


def test_a_job_tells_a_cause() -> None:
    curve: dict[object, Point] = {}
    for x in (ten(0), ten(4)):
        walked = walk((Stop("far", x, 1, 8), ("textbook",), {}))
        assert walked is not None
        curve[x] = walked.points["textbook"]
    _, _, cause = explain(("textbook", Stop("far", ten(4), 1, 8), curve))  # type: ignore[arg-type]
    assert cause.told_by == "restart"


# As data.

PLAN = Itinerary(
    (BY_NAME["textbook"], BY_NAME["seed"], BY_NAME["oracle"]),
    (SWEEPS["far"], SWEEPS["speed"]),
    quick=True,
    workers=1,
)


@cache
def report() -> Stress:
    return run(PLAN, lambda: None)


def test_it_is_json_without_extensions() -> None:
    sides = [Sides("trimesh", 8, 0.05, 0), Sides("trimesh", 16, float("nan"), 3)]
    found = json.loads(json.dumps(form(report(), sides), allow_nan=False))
    assert found["complete"]
    assert (found["seed"], found["samples"], found["quick"]) == (1, PLAN.count, True)
    assert {"tool", "python", "machine"} <= set(found["environment"])
    assert [sweep["name"] for sweep in found["sweeps"]] == ["far", "speed"]
    assert found["meshes"]["rows"][1]["error"] is None
    assert found["meshes"]["slopes"]["trimesh"] is None
    speed = found["sweeps"][1]
    assert speed["steps"][0]["step"] == "2^-1000"
    assert speed["steps"][0]["value"] == 2.0**-1000


def test_a_row_for_every_method_and_step() -> None:
    found = list(rows(report()))
    assert len(found) == PLAN.total * len(PLAN.ways)
    assert found[0]["sweep"] == "far"
    assert [row["step"] for row in found[:3]] == ["1e0", "1e3", "1e6"]
    last = found[-1]
    assert (last["method"], last["step"], last["exact"]) == ("oracle", "2^1000", PLAN.count)
    overflown = next(r for r in found if r["method"] == "seed" and r["step"] == "2^1000")
    assert overflown["strict"] is None
    assert overflown["condition"] > 0


def test_the_table_is_the_rows() -> None:
    read = list(csv.DictReader(io.StringIO(table(report()))))
    assert len(read) == PLAN.total * len(PLAN.ways)
    assert read[0]["sweep"] == "far"
    assert "" in {row["strict"] for row in read}
    assert table(Stress(PLAN)).startswith("sweep,step,value,method")


def test_ranges_say_where_it_breaks_and_why() -> None:
    found = {(row["sweep"], row["method"]): row for row in range_rows(report())}
    far, speed = found["far", "textbook"], found["speed", "textbook"]
    assert far["stable"]["text"] == "to 1e0"
    assert far["stable"]["breaks_at"] == ["1e3"]
    assert far["sound"]["whole"]
    [cause] = far["causes"]
    assert cause["cause"] == "cancellation in the discriminant"
    assert cause["restored"][cause["told_by"]] == cause["broken"]
    assert [cause["at"] for cause in speed["causes"]] == ["2^-600", "2^600"]
    assert found["speed", "oracle"]["exact"]["whole"]
    assert found["speed", "oracle"]["causes"] == []


def test_notes_join_methods_that_break_alike() -> None:
    found = notes(report(), ["textbook", "seed", "oracle"])
    assert len(found) == 2
    assert found[0].startswith("start far from the solid: textbook stable to 1e0; ")
    assert "textbook, seed stable 2^-450 .. 2^450; over- or underflow" in found[1]


def test_nothing_known_is_a_report_too() -> None:
    empty = form(Stress(PLAN, interrupted=True))
    assert not empty["complete"]
    assert empty["rows"] == []
    assert empty["ranges"] == []
