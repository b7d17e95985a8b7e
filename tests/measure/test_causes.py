"""Causes: told by remedies, of planted faults whose cause is known; and not told without one."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import inf

import pytest

from raycert.cases.families.frames import SEVENTHS, UPRIGHT
from raycert.cases.families.sketch import ball, pipe, rod, ten, two
from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Cylinder, InfiniteCylinder, Solid
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import Surd, nearest
from raycert.oracle.judge.levels import Judge
from raycert.oracle.measure.catalog import BY_NAME
from raycert.oracle.measure.causes import (
    CONTROL,
    NOT_TOLD,
    REMEDIES,
    Breakage,
    Cause,
    abreast,
    at_origin,
    beside,
    copies,
    diagnose,
    doublings,
    has_few_digits,
    lending,
    magnitude,
    open_ended,
    parallel,
    restart,
    scaled,
    start_distance,
    upright,
)
from raycert.oracle.measure.errors import Error, Referee
from raycert.oracle.measure.ranges import Point, ranges_of
from raycert.oracle.measure.sweeps import SWEEPS, Sample, Sweep
from raycert.oracle.measure.way import Answered, Case, Solve


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
        asked = [one for s in sweep.samples(x, 1, count) if (one := s.referee())]
        curve[x] = Point.over(asked, solve([one.case for one in asked]))
    [first] = ranges_of(sweep, curve)["stable"].broken
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
    assert told(SWEEPS[sweep], BY_NAME[method].solve, steps).text == text


def test_a_rare_failure_is_seen_in_copies() -> None:
    """C / q at a tangent start breaks in one of a hundred roundings; any other one avoids it."""
    sweep, solve = SWEEPS["start"], BY_NAME["q-root"].solve
    cause = told(sweep, solve, [two(0), two(-53)], 3)
    assert cause.text == "cancellation at a start near the wall"
    assert cause.count >= 1000
    assert 0.9 < cause.evidence[CONTROL] / cause.count < 1
    assert cause.evidence["restart"] == cause.count


def test_steps_that_hold_lend_nothing() -> None:
    sweep = SWEEPS["far"]
    bad, good = (Point.of([Error(1.0)], [k], [k]) for k in (inf, 1.0))
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
        referee = Referee.of(sample.posed())
        referee._known[answer, "strict"] = k  # type: ignore[index]
        return has_few_digits(Breakage(sample, answer, referee))

    assert told(((0.5, 2.0),), 1e8)
    assert not told(((0.5, 2.0),), 1e11)
    assert not told(((0.1, 2.0),), 1e8)
    assert not told((), 1e8)
    assert not told(None, float("inf"))


def test_what_does_not_break_here_is_not_told() -> None:
    sweep = SWEEPS["far"]
    curve = {ten(0): Point.of([Error(inf, failed=True)], [inf], [inf])}
    found = diagnose(
        sweep,
        curve,
        ten(0),
        lambda cases: [right(case) for case in cases],
        lambda x: list[Sample](sweep.samples(x, 1, 2)),
    )
    assert (found.text, found.count) == (NOT_TOLD, 0)


# Remedies.

PLAIN = Sample(rod((0, 0, 0), (0, 0, 2), 1), (-3, 0, 1), (1, 0, 0))
TUBE = Sample(pipe((0, 0, 0), (0, 0, 2), 1), (-3, 0, 64), (1, 0, two(-20)))


def exact(sample: Sample | None) -> Intervals:
    assert sample is not None
    referee = sample.referee()
    assert referee is not None
    return referee.exact


def test_what_they_do_not_concern_they_leave() -> None:
    half = Fraction(3, 4)
    assert scaled(Sample(pipe((0, 0, 0), (0, 0, 2), half), (0, 0, 0), (half, 0, 0))) is None
    assert at_origin(PLAIN) is None
    assert beside(PLAIN) is None
    assert upright(PLAIN) is None
    assert restart(Sample(ball(1), (3, 0, 0), (1, 0, 0))) is None
    assert restart(Sample(PLAIN.shape, (3, 0, 0), (0, 0, 1))) is None


@pytest.mark.parametrize("name", ["speed", "scale"])
@pytest.mark.parametrize("power", [-1000, -300, 300, 1000])
def test_scaling_is_exact_and_ends_in_range(name: str, power: int) -> None:
    for sample in SWEEPS[name].samples(two(power), 1, 4):
        changed = scaled(sample)
        assert changed is not None
        assert doublings(sample) > abs(power) - 5
        assert doublings(changed) <= 3
        if power > 0:
            factor = two(power if name == "speed" else 0)
            for (a, b), (c, d) in zip(exact(changed), exact(sample), strict=True):
                for new, old in ((a, c), (b, d)):
                    assert near_power(new, old, factor)


def near_power(new: Surd, old: Surd, factor: Fraction) -> bool:
    """Tell whether new is old times a power of two, about the factor."""
    one, other = (Fraction(nearest(x, BINARY64)) for x in (new, old))
    if not other:
        return not one
    ratio = one / other
    return ratio == two(magnitude(ratio) - 1) and factor / 64 <= ratio <= factor * 64


def test_p_at_the_origin() -> None:
    moved = Sample(PLAIN.shape, PLAIN.origin, PLAIN.direction, SEVENTHS.moved((48, -80, 96)))
    changed = at_origin(moved)
    assert changed is not None
    assert changed.frame.shift == (0, 0, 0)
    assert exact(changed) == exact(moved)


def test_sliding_p_leaves_an_infinite_cylinder() -> None:
    assert exact(beside(TUBE)) == exact(TUBE)
    assert exact(abreast(TUBE)) == exact(TUBE)
    slid = beside(TUBE)
    assert slid is not None
    assert slid.shape.p == (0, 0, 64)  # type: ignore[union-attr]


def test_the_wall_alone_is_the_wall() -> None:
    assert exact(open_ended(PLAIN)) == exact(PLAIN)
    assert open_ended(TUBE) is None


def test_a_restart_shifts_t() -> None:
    far = Sample(PLAIN.shape, (-1024, 0, 1), (1, 0, 0))
    assert start_distance(far) == 1024
    assert exact(restart(far)) == exact(PLAIN)
    assert start_distance(PLAIN) == 3


def test_upright_keeps_the_sketch() -> None:
    oblique = Sample(PLAIN.shape, PLAIN.origin, PLAIN.direction, SEVENTHS.moved((1, 2, 3)))
    changed = upright(oblique)
    assert changed is not None
    assert changed.frame == UPRIGHT.scaled(7).moved((1, 2, 3))
    assert exact(changed) == exact(oblique) == exact(PLAIN)


def test_parallel_is_parallel() -> None:
    for sample in SWEEPS["tilt-wall"].samples(ten(-9), 1, 4):
        assert parallel(sample).direction[:2] == (0, 0)


def test_every_remedy_gives_a_question_or_none() -> None:
    for sweep in SWEEPS.values():
        for sample in sweep.samples(sweep.steps[-2], 1, 2):
            for remedy in REMEDIES.values():
                changed = remedy(sample)
                assert changed is None or changed.referee() is not None


def test_magnitudes() -> None:
    assert [magnitude(x) for x in (1, Fraction(1, 2), 3, Fraction(1, 3))] == [1, 0, 2, -1]
