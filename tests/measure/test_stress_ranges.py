"""Ranges: outward from the mild step, to the first that fails."""

from fractions import Fraction

import pytest

from raycert.cases.families.sketch import ten
from raycert.oracle.measure.stress.measure import Measured, Point
from raycert.oracle.measure.stress.ranges import Ranges, reach, sides, spelled
from raycert.oracle.measure.stress.sweeps import SWEEPS, Sweep

FAR, THIN, TILT = SWEEPS["far"], SWEEPS["thin"], SWEEPS["tilt-wall"]


def point(k: float) -> Point:
    return Point.over([Measured(k, min(k, 8.0), 1.0)])


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
    found = Ranges.read(sweep, curve(sweep, bad))
    assert spelled(found.stable, sweep) == text
    assert found.stable.broken == tuple(ten(k) for k in broken)
    assert found.stable.whole == (not broken)
    assert spelled(found.sound, sweep) == "all"
    assert spelled(found.exact, sweep) == "nowhere"


def test_a_range_needs_only_the_steps_that_were_run() -> None:
    few = {x: point(1.0 if x < ten(9) else 99.0) for x in FAR.coarse(3)}
    found = reach(FAR, few, lambda point: point.strict <= 64)
    assert (found.high, found.broken) == (ten(6), (ten(9),))


def test_sides_go_outward() -> None:
    before, after = sides([ten(k) for k in (-2, -1, 0, 1)], ten(0))
    assert before == [ten(-1), ten(-2)]
    assert after == [ten(1)]
