"""Ranges: outward from the mild step, to the first that fails."""

from __future__ import annotations

from fractions import Fraction
from math import inf

import pytest

from raycert.cases.families.sketch import ten
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Ray
from raycert.oracle.measure.errors import Error, Referee
from raycert.oracle.measure.ranges import Ground, Point, ranges_of, reach, sides, spelled
from raycert.oracle.measure.sweeps import SWEEPS, Sweep
from raycert.oracle.measure.way import Answered

FAR, THIN, TILT = SWEEPS["far"], SWEEPS["thin"], SWEEPS["tilt-wall"]


def point(k: float) -> Point:
    return Point.of([Error(1.0)], [k], [min(k, 8.0)])


def curve(sweep: Sweep, bad: dict[int, float]) -> dict[Fraction, Point]:
    return {x: point(bad.get(sweep.power(x), 1.0)) for x in sweep.steps}


@pytest.mark.parametrize(
    ("sweep", "bad", "text", "broken"),
    [
        (FAR, {}, "all", ()),
        (FAR, {3: 65.0}, "to 1e2", (3,)),
        (FAR, {3: 64.0, 16: 1e9}, "to 1e15", (16,)),
        (FAR, {0: 65.0}, "nowhere", (0,)),
        (FAR, {5: 1e9, 2: 1e3}, "to 1e1", (2,)),
        (TILT, {-4: 1e3}, "to 1e-3", (-4,)),
        (THIN, {-4: 1e3}, "1e-3 .. 1e15", (-4,)),
        (THIN, {-4: 1e3, 7: 1e9}, "1e-3 .. 1e6", (-4, 7)),
    ],
)
def test_a_range_ends_at_the_first_step_that_fails(
    sweep: Sweep, bad: dict[int, float], text: str, broken: tuple[int, ...]
) -> None:
    found = ranges_of(sweep, curve(sweep, bad))
    assert spelled(found["stable"], sweep) == text
    assert found["stable"].broken == tuple(ten(k) for k in broken)
    assert found["stable"].whole == (not broken)
    assert spelled(found["sound"], sweep) == "all"
    assert spelled(found["exact"], sweep) == "nowhere"


def test_a_range_needs_only_the_steps_that_were_run() -> None:
    few = {x: point(1.0 if x < ten(9) else 99.0) for x in FAR.coarse(3)}
    found = reach(FAR, few, lambda point: point.strict <= 64)
    assert (found.high, found.broken) == (ten(6), (ten(9),))


def test_sides_go_outward() -> None:
    before, after = sides([ten(k) for k in (-2, -1, 0, 1)], ten(0))
    assert before == [ten(-1), ten(-2)]
    assert after == [ten(1)]


def test_counts_of_pairs_are_told_by_their_side() -> None:
    drum = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 1.0)
    across = Referee(drum, Ray((-3.0, 0.25, 1.0), (1.0, 0.0, 0.0)), BINARY64)
    [pair] = across.expected
    answers: list[Answered] = [(), (pair, (9.0, 10.0)), (pair,), None]
    point = Point.over([across] * 4, answers)
    assert (point.missed, point.phantom, point.failed, point.exact) == (1, 1, 1, 1)
    assert point.wrong == 0.75
    assert point.inexact == 0.75
    assert point.strict == inf
    assert point.ulps is not None
    assert point.ulps <= 0.5
    assert Point.over([across], [None]).ulps is None


def test_the_far_end_does_not_decide() -> None:
    def ground(x: int) -> Ground:
        asked = (sample.referee() for sample in FAR.samples(ten(x), 1, 2))
        return Ground.over([referee for referee in asked if referee])

    assert ground(6).decisive == 2
    assert ground(16).decisive == 0
