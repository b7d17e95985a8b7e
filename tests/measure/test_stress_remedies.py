"""Remedies change one thing: the rest of the problem, and its exact answer, are what they were."""

from fractions import Fraction

import pytest

from raycert.cases.families.frames import SEVENTHS, UPRIGHT
from raycert.cases.families.sketch import ball, pipe, rod, ten, two
from raycert.cases.formats import BINARY64
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.rounding import nearest
from raycert.oracle.exact.surd import Surd
from raycert.oracle.measure.stress.measure import Question
from raycert.oracle.measure.stress.remedies import (
    REMEDIES,
    abreast,
    at_origin,
    beside,
    doublings,
    magnitude,
    open_ended,
    parallel,
    restart,
    scaled,
    start_distance,
    upright,
)
from raycert.oracle.measure.stress.sample import Sample
from raycert.oracle.measure.stress.sweeps import SWEEPS

PLAIN = Sample(rod((0, 0, 0), (0, 0, 2), 1), (-3, 0, 1), (1, 0, 0))
TUBE = Sample(pipe((0, 0, 0), (0, 0, 2), 1), (-3, 0, 64), (1, 0, two(-20)))


def exact(sample: Sample | None) -> Intervals:
    assert sample is not None
    question = Question.of(sample)
    assert question is not None
    return question.exact


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
    return ratio == two(magnitude((ratio, 0, 0)) - 1) and factor / 64 <= ratio <= factor * 64


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
                assert changed is None or Question.of(changed) is not None


def test_magnitudes() -> None:
    assert [magnitude((x, 0, 0)) for x in (1, Fraction(1, 2), 3, Fraction(1, 3))] == [1, 0, 2, -1]
