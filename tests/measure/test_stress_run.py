"""The run, and what it must show of the built-in methods: on small samples, all of every sweep."""

from collections.abc import Sequence
from dataclasses import replace

import pytest

from raycert.cases.families.sketch import ten, two
from raycert.oracle.measure.methods.catalog import by_name
from raycert.oracle.measure.methods.method import ALL, Answered, Case, Method
from raycert.oracle.measure.stress.ranges import MOST
from raycert.oracle.measure.stress.run import Plan, Report, causes_to_tell, run, tell_causes
from raycert.oracle.measure.stress.step import Step, StepJob, walk
from raycert.oracle.measure.stress.sweeps import SWEEPS

each = pytest.mark.parametrize("sweep", SWEEPS)


def point(method: str, sweep: str, x: object, count: int = 4) -> tuple[float, float]:
    """Return the worst strict and squared k of a method at a step."""
    found = walk(StepJob(Step(sweep, x, 1, count), (method,)))  # type: ignore[arg-type]
    assert found is not None
    return found.points[method].strict, found.points[method].squared


@each
def test_the_oracle_is_exact_and_the_reference_stable_over_the_whole_sweep(sweep: str) -> None:
    count = 1 if SWEEPS[sweep].weight > 1 else 3
    for x in SWEEPS[sweep].coarse(4):
        found = walk(StepJob(Step(sweep, x, 1, count), ("oracle", "reference")))
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
        found = walk(StepJob(Step("hard", x, 1, 4), ("mpmath-50", "oracle")))
        assert found is not None
        assert (found.points["mpmath-50"].inexact == 0) == exact
        assert found.points["oracle"].inexact == 0


FEW = Plan(
    (by_name("textbook"), by_name("oracle")),
    (SWEEPS["far"], SWEEPS["hard"]),
    quick=True,
    workers=1,
)


def counted(plan: Plan) -> tuple[Report, list[None], list[None]]:
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
    assert ranges.stable.broken == (cause.step,)
    assert cause.text == "cancellation in the discriminant"
    assert set(report.causes) == {("far", "textbook")}
    assert len(causes) == causes_to_tell(report) == 1
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

    tell_causes(report, stop)
    assert report.interrupted
    assert set(report.causes) == {("far", "textbook")}
    assert report.ranges(SWEEPS["far"], "textbook") is not None


def test_a_client_is_asked_once_for_a_sweep_and_judged_like_others() -> None:
    asked: list[int] = []

    def solve(cases: Sequence[Case]) -> list[Answered]:
        asked.append(len(cases))
        return by_name("textbook").solve(cases)

    client = Method("mine", "is asked", solve, ALL, "client")
    far = SWEEPS["far"]
    plan = Plan((client, by_name("textbook")), (far,), quick=True, workers=1)
    report = run(plan, lambda: None)
    assert report.curve("far", "mine") == report.curve("far", "textbook")
    assert report.causes["far", "mine"] == report.causes["far", "textbook"]
    assert asked[0] == plan.count * len(plan.steps(far))


def test_a_client_that_does_not_answer_all_solids_is_left_out() -> None:
    def solve(cases: Sequence[Case]) -> list[Answered]:
        raise AssertionError

    client = Method("mine", "is not asked", solve, frozenset({"sphere"}), "client")
    plan = Plan((client,), (SWEEPS["far"],), quick=True, workers=1)
    report = run(plan, lambda: None)
    assert report.ranges(SWEEPS["far"], "mine") is None
