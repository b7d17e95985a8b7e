"""Fresh cases: what a construction says of its answer is what the oracle finds."""

from fractions import Fraction

import pytest

from raycert.cases.dice import Dice
from raycert.cases.draw import LADDERS, Draw, any_shot, jittered, sampled
from raycert.cases.flags import FLAGS
from raycert.cases.formats import FORMATS, Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import SOLIDS, type_of
from raycert.cases.numbers import Probe, numbers
from raycert.oracle.corpus.golden import known
from raycert.oracle.exact.trace import trace

each_format = pytest.mark.parametrize("fmt", FORMATS.values(), ids=lambda fmt: fmt.name)
ROUNDS = 30 * len(LADDERS)


@each_format
def test_every_ladder_holds_what_its_construction_says(fmt: Format) -> None:
    told = dict.fromkeys((ladder[0] for ladder in LADDERS), 0)
    for number in range(ROUNDS):
        case = jittered(11, number, fmt)
        if case.known is not None:
            told[case.slug.partition("-")[0]] += 1
            assert known(case.known) == trace(case.solid, case.ray).intervals, case
    evident = {"far", "start", "behind", "tangent", "displaced", "speed", "size", "thin"}
    assert {name for name, count in told.items() if count} >= evident


@each_format
def test_cases_are_of_the_format_and_flagged(fmt: Format) -> None:
    for number in range(ROUNDS):
        case = jittered(12, number, fmt)
        assert all(fmt.holds(x) for x in (*case.ray.origin, *case.ray.direction))
        assert case.flags
        assert set(case.flags) <= set(FLAGS)
        assert case.tier == "stiff"


@each_format
def test_a_case_depends_on_nothing_but_seed_number_and_format(fmt: Format) -> None:
    assert jittered(5, 40, fmt) == jittered(5, 40, fmt)
    differing = [n for n in range(ROUNDS) if jittered(5, n, fmt).ray != jittered(6, n, fmt).ray]
    assert len(differing) > 0.8 * ROUNDS


@each_format
def test_steps_stay_on_their_ladders(fmt: Format) -> None:
    draw = Draw(Dice("steps"), fmt)
    most = 13 if fmt.precision == 53 else 6
    for _ in range(200):
        assert 10 <= draw.large() < 10**most
        assert 0 < draw.small() < Fraction(1, 9)
        gap = draw.gap()
        assert all(Fraction(fmt.nearest(float(x))) == x for x in (1 - gap, 1 + gap, 32 + gap))


def test_aims_are_at_every_type_of_leaf() -> None:
    draw = Draw(Dice("aims"), FORMATS["binary64"])
    assert len({any_shot(draw).text for _ in range(200)}) == 5
    kinds = {type_of(jittered(1, n, FORMATS["binary64"]).solid) for n in range(ROUNDS)}
    assert len(kinds) == 8


@each_format
def test_the_sample_has_every_type_and_what_is_hard(fmt: Format) -> None:
    cases = [sampled(number, 3, fmt) for number in range(400)]
    assert cases[:20] == [sampled(number, 3, fmt) for number in range(20)]
    assert [type_of(case.solid) for case in cases[:8]] == list(SOLIDS)
    for case in cases:
        assert all(fmt.holds(x) for x in numbers(Probe(case.solid, case.ray)))
    lists = [trace(case.solid, case.ray).intervals for case in cases]
    touches = sum(any(enter == leave for enter, leave in found) for found in lists)
    assert sum(map(bool, lists)) > 200
    assert touches > 20
    assert sum(len(found) > 1 for found in lists) > 1
    assert sum(is_lattice(case.solid, case.ray) for case in cases) > 20
