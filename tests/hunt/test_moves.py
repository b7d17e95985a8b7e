"""The moves: what they return is asked, so it has to be of the format; walks end at an edge."""

import pytest

from raycert.cases.dice import Dice
from raycert.cases.draw import jittered
from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Ray, Sphere
from raycert.cases.numbers import Probe, numbers, ordinal
from raycert.oracle.exact.faces import touch
from raycert.oracle.exact.trace import trace
from raycert.oracle.hunt.moves import MOVES, form, on_lattice, overflow, walk

BALL = Probe(Sphere((0, 0, 0), 1), Ray((-3, 0.25, 0), (1, 0, 0)))


@pytest.mark.parametrize("fmt", [BINARY32, BINARY64], ids=lambda fmt: fmt.name)
@pytest.mark.parametrize("move", dict.fromkeys((*MOVES, overflow)), ids=lambda m: m.__name__)
def test_a_move_makes_probes_of_the_format_the_same_each_time(move, fmt):
    made = 0
    for number in range(18):
        case = jittered(3, number, fmt)
        probe = Probe(case.solid, case.ray)
        found = move(probe, Dice(f"{number}"), fmt)
        assert found == move(probe, Dice(f"{number}"), fmt)
        assert all(fmt.holds(x) for other in found for x in numbers(other))
        made += len(found)
    assert made > 18


def test_the_lattice_is_where_sound_formulas_decide_touches():
    dice = Dice("lattice")
    drawn = [on_lattice(dice) for _ in range(800)]
    assert all(is_lattice(probe.solid, probe.ray) for probe in drawn)
    names = set()
    for probe in drawn:
        for interval in trace(probe.solid, probe.ray).intervals:
            names.add(touch(interval, probe.solid, probe.ray))
    assert names >= {"tangent", "wall", "cap", "start", None}


def test_a_walk_ends_on_both_sides_of_where_the_answer_changes_its_form():
    edges = 0
    for number in range(60):
        path = walk(BALL, Dice(f"walk {number}"), BINARY64)
        if len(path) < 5:
            continue
        forms = {form(probe) for probe in path[-4:]}
        places = [[ordinal(x, BINARY64) for x in numbers(probe)] for probe in path]
        nearest = min(
            sum(abs(a - b) for a, b in zip(one, other, strict=True))
            for one, f in zip(places, map(form, path), strict=True)
            for other, g in zip(places, map(form, path), strict=True)
            if f != g
        )
        edges += len(forms) > 1 and nearest == 1
    assert edges >= 5
