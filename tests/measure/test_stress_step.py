"""Steps: a point for every method that answers such solids, given answers judged like others."""

from raycert.cases.families.sketch import ten
from raycert.oracle.measure.methods.catalog import by_name
from raycert.oracle.measure.stress.measure import Point
from raycert.oracle.measure.stress.step import CauseJob, Step, StepJob, cases, tell, walk

STEP = Step("far", ten(4), 1, 4)


def test_a_step_gives_a_point_for_each_method() -> None:
    found = walk(StepJob(STEP, ("textbook", "oracle", "trimesh-8")))
    assert found is not None
    assert set(found.points) == {"textbook", "oracle", "trimesh-8"}
    assert found.points["textbook"].strict > 64 > found.points["textbook"].squared
    assert found.points["oracle"].exact == found.ground.count == 4
    assert found.ground.decisive == 4


def test_what_a_method_does_not_answer_is_left_out() -> None:
    found = walk(StepJob(Step("tilt-wall", ten(0), 1, 1), ("trimesh-8", "oracle")))
    assert found is not None
    assert set(found.points) == {"oracle"}


def test_given_answers_are_judged() -> None:
    answers = by_name("oracle").solve(cases(STEP.questions()))
    found = walk(StepJob(STEP, (), {"mine": answers, "none": [None] * 4}))
    assert found is not None
    assert found.points["mine"].exact == 4
    assert found.points["none"].failed == 4


def test_a_job_tells_a_cause() -> None:
    curve: dict[object, Point] = {}
    for x in (ten(0), ten(4)):
        walked = walk(StepJob(Step("far", x, 1, 8), ("textbook",)))
        assert walked is not None
        curve[x] = walked.points["textbook"]
    job = CauseJob("textbook", Step("far", ten(4), 1, 8), curve)  # type: ignore[arg-type]
    assert tell(job).told_by == "restart"
