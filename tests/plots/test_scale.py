"""Scales: powers in their order, 0 beyond the last of them, marks that keep apart."""

from raycert.cases.families.sketch import ten, two
from raycert.oracle.measure.stress.sweeps import SWEEPS
from raycert.oracle.plots.scale import Scale, spaced


def test_a_scale_goes_from_mild_to_stiff_with_zero_last() -> None:
    start = Scale(SWEEPS["start"], SWEEPS["start"].steps)
    places = [start.at(x) for x in start.steps]
    assert places == sorted(places, reverse=True)
    left, right = start.limits
    assert left > places[0] > places[-1] > right
    assert list(start.ticks())[-1] == (places[-1], "0")
    far = Scale(SWEEPS["far"], (ten(0), ten(3)))
    assert [text for _, text in far.ticks()] == ["1", "$10^{1}$", "$10^{2}$", "$10^{3}$"]
    assert Scale(SWEEPS["speed"], (two(-1000), two(1000))).limits[0] < -1000


def test_marks_keep_apart() -> None:
    assert spaced([0, 1, 2, 3, 10, 11], [False, True, True, True, True, True], 2) == [1, 3, 4]
    assert spaced([0.0, 1.0], [False, False], 1) == []
