"""Causes: told by remedies, of planted faults whose cause is known; and not told without one."""

from collections.abc import Sequence
from fractions import Fraction

import pytest

from raycert.cases.families.sketch import ten, two
from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Cylinder, InfiniteCylinder, Solid
from raycert.oracle.judge.levels import Judge
from raycert.oracle.measure.methods.catalog import by_name
from raycert.oracle.measure.methods.method import Answered, Case
from raycert.oracle.measure.stress.causes import (
    CONTROL,
    NOT_TOLD,
    Cause,
    Solve,
    copies,
    diagnose,
    has_few_digits,
    lending,
)
from raycert.oracle.measure.stress.causes import Broken as Instance
from raycert.oracle.measure.stress.measure import FAILED, Measured, Point, Question
from raycert.oracle.measure.stress.ranges import Ranges
from raycert.oracle.measure.stress.sample import Sample
from raycert.oracle.measure.stress.sweeps import SWEEPS, Sweep


def right(case: Case) -> Answered:
    return Judge(case.solid, case.ray, BINARY64).expected


def axis(solid: Solid) -> tuple[float, float, float]:
    assert isinstance(solid, InfiniteCylinder | Cylinder)
    return tuple(b - a for a, b in zip(solid.p, solid.q, strict=True))  # type: ignore[return-value]


def absolute(cases: Sequence[Case]) -> list[Answered]:
    """Lose what is smaller than 1e-9."""
    return [() if c.solid.radius < 1e-9 else right(c) for c in cases]  # type: ignore[union-attr]


def narrow(cases: Sequence[Case]) -> list[Answered]:
    """Round what is right to binary32."""
    near = BINARY32.nearest
    return [tuple((near(a), near(b)) for a, b in right(c) or ()) for c in cases]


def takes_for_parallel(cases: Sequence[Case]) -> list[Answered]:
    """Take slopes below 1e-5 for none."""
    found: list[Answered] = []
    for case in cases:
        v, w = case.ray.direction, axis(case.solid)
        climb = sum(a * b for a, b in zip(v, w, strict=True))
        length = sum(b * b for b in w)
        side = [a - climb / length * b for a, b in zip(v, w, strict=True)]
        slope = max(map(abs, side)) * length**0.5 / abs(climb)
        found.append(((0.0, 1e300),) if slope < 1e-5 else right(case))
    return found


def fails(cases: Sequence[Case]) -> list[Answered]:
    """Fail, whatever is asked."""
    return [None for _ in cases]


def told(sweep: Sweep, solve: Solve, steps: Sequence[Fraction], count: int = 8) -> Cause:
    """Return the cause at the first step of a curve that is not stable."""
    curve = {}
    for x in steps:
        questions = [q for s in sweep.samples(x, 1, count) if (q := Question.of(s))]
        answers = solve([q.case for q in questions])
        curve[x] = Point.over([q.measured(a) for q, a in zip(questions, answers, strict=True)])
    [first] = Ranges.read(sweep, curve).stable.broken
    return diagnose(sweep, curve, first, solve, lambda x: sweep.samples(x, 1, count))


DECADES = [ten(-k) for k in (0, 3, 6, 9)]


@pytest.mark.parametrize(
    ("sweep", "solve", "steps", "text", "by"),
    [
        ("scale", absolute, [two(0), two(-50)], "an absolute tolerance", "scaled"),
        ("tilt-wall", takes_for_parallel, DECADES, "parallel test", "parallel"),
        ("far", narrow, [ten(0), ten(3)], "digits of binary32", "binary32"),
        ("far", fails, [ten(0), ten(3)], NOT_TOLD, None),
    ],
)
def test_a_planted_fault_is_told(
    sweep: str, solve: Solve, steps: list[Fraction], text: str, by: str | None
) -> None:
    cause = told(SWEEPS[sweep], solve, steps, 4)
    assert (cause.text, cause.told_by) == (text, by)


@pytest.mark.parametrize(
    ("sweep", "method", "steps", "text"),
    [
        ("far", "textbook", [ten(0), ten(4)], "cancellation in the discriminant"),
        ("thin", "shift", [ten(0), ten(-8)], "p far along the axis"),
        ("tilt-axis", "determinant", [ten(0), ten(-7)], "axial part of origin - p"),
        ("speed", "seed", [two(0), two(600)], "over- or underflow"),
        ("scale", "local-frame", [two(0), two(-400)], "over- or underflow"),
    ],
)
def test_published_formulas_break_for_the_reason_that_is_known(
    sweep: str, method: str, steps: list[Fraction], text: str
) -> None:
    assert told(SWEEPS[sweep], by_name(method).solve, steps).text == text


def test_a_rare_failure_is_seen_in_copies() -> None:
    """C / q at a tangent start breaks in one of a hundred roundings; any other one avoids it."""
    sweep, solve = SWEEPS["start"], by_name("q-root").solve
    cause = told(sweep, solve, [two(0), two(-53)], 3)
    assert cause.text == "cancellation at a start near the wall"
    assert cause.count >= 1000
    assert 0.9 < cause.evidence[CONTROL] / cause.count < 1
    assert cause.evidence["restart"] == cause.count


def test_steps_that_hold_lend_nothing() -> None:
    sweep = SWEEPS["far"]
    bad, good = Point.over([FAILED]), Point.over([Measured(1.0, 1.0, 1.0)])
    curve = {ten(0): good, ten(1): bad, ten(2): good, ten(3): bad, ten(4): bad}
    assert lending(sweep, curve, ten(1)) == [ten(1), ten(3)]
    assert lending(sweep, curve | {ten(0): bad}, ten(0)) == [ten(0)]


def test_copies_are_other_sizes_of_the_same() -> None:
    sample = SWEEPS["far"].samples(ten(2), 1, 1)[0]
    many = copies(sample, 3)
    assert len({copy.frame.stretch for copy in (sample, *many)}) == 4
    assert {copy.origin for copy in many} == {sample.origin}


def test_few_digits_have_errors_of_their_size() -> None:
    sample = SWEEPS["far"].samples(ten(2), 1, 1)[0]

    def told(answer: Answered, k: float) -> bool:
        return has_few_digits(Instance(sample, answer, Measured(k, k, 1.0)))

    assert told(((0.5, 2.0),), 1e8)
    assert not told(((0.5, 2.0),), 1e11)
    assert not told(((0.1, 2.0),), 1e8)
    assert not told((), 1e8)
    assert not told(None, float("inf"))


def test_what_does_not_break_here_is_not_told() -> None:
    sweep = SWEEPS["far"]
    curve = {ten(0): Point.over([FAILED])}
    found = diagnose(
        sweep,
        curve,
        ten(0),
        lambda cases: [right(case) for case in cases],
        lambda x: list[Sample](sweep.samples(x, 1, 2)),
    )
    assert (found.text, found.count) == (NOT_TOLD, 0)
