"""Cells hold what the oracle and the judge say of their cases; an interrupt keeps the middle."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from math import inf

import pytest

from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Ray
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.client.target import target
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.answer import First, YesNo
from raycert.oracle.judge.levels import Judge
from raycert.oracle.map.raster import Inputs, Raster
from raycert.oracle.map.sampling import (
    BEYOND,
    EXACT,
    FAITHFUL,
    FEW,
    MANY,
    RIGHT,
    WITHIN,
    Comparison,
    Map,
    Mismatch,
    Show,
    difference,
    looks,
    sample,
)

ROD = Cylinder((0, 0, 0), (0, 0, 2), 1)
TANGENT = Inputs(ROD, Ray((-3, 1, 1), (1, 0, 0)))
FAR = Inputs(ROD, Ray((-8e7, -6e7, 1), (0.8, 0.6, 0)))
REFERENCE, TEXTBOOK = "raycert.reference.tracer:intersect", "raycert.oracle.zoo.textbook:textbook"


def plan(inputs: Inputs = TANGENT, unit: str = "ulps", span: object = 3) -> Raster:
    axes = inputs.direction("ray.origin[1]"), inputs.direction("solid.radius")
    return Raster.of(inputs, axes, unit, Fraction(str(span)), 7)  # type: ignore[arg-type]


def asked(show: Show, name: str = REFERENCE, **more: object) -> Map:
    return sample(plan(**more), show, target([name]))  # type: ignore[arg-type]


def test_every_cell_has_the_exact_answer_of_its_own_case() -> None:
    found = sample(plan(), "exact")
    assert found.whole
    assert found.hello is None
    for at, cell in found.cells.items():
        exact = trace(*found.raster.probe(at)).intervals
        assert cell.expected == expected(exact, BINARY64)[1]
        assert cell.topology is not None
        assert cell.topology.pairs == len(exact) == (at[0] <= at[1])
        assert bool(cell.topology.kinds) == (at[0] == at[1])


def test_what_is_no_case_says_why() -> None:
    found = sample(plan(unit="units"), "exact")
    refused = {at for at, cell in found.cells.items() if cell.refused}
    assert refused == {at for at in found.raster.places if at[1] < -1}
    assert "solid.radius: is negative" in found.cells[0, -3].refused


@pytest.mark.parametrize("name", [REFERENCE, TEXTBOOK])
def test_k_and_ulps_are_the_judges(name: str) -> None:
    ks = asked("k", name, inputs=FAR, unit="units", span=0.75)
    ulps = asked("ulps", name, inputs=FAR, unit="units", span=0.75)
    for at, cell in ks.cells.items():
        judge = Judge(*ks.raster.probe(at), BINARY64)
        assert isinstance(cell.outcome, Reply)
        pairs = cell.outcome.intervals
        assert pairs is not None
        assert cell.value == judge.backward_error(pairs, "strict")
        assert ulps.cells[at].value == judge.forward_error(pairs)


def test_the_textbook_loses_hits_far_away_and_the_reference_none() -> None:
    far = {"inputs": FAR, "unit": "units", "span": 0.75}
    says = {cell.says for cell in asked("disagreement", TEXTBOOK, **far).cells.values()}
    assert RIGHT + BEYOND in says
    assert {FEW + BEYOND, MANY + BEYOND} & says
    says = {cell.says for cell in asked("disagreement", **far).cells.values()}
    assert says <= {EXACT, FAITHFUL, RIGHT + WITHIN}


def test_what_is_answered_is_told() -> None:
    found = asked("answer")
    assert found.cells[0, 0].says == "1 pair, a touch"
    assert found.cells[-3, 3].says == "1 pair"
    assert found.cells[3, -3].says == "no pair"


@pytest.mark.parametrize(
    ("pairs", "says"),
    [
        (((2.0, 4.0),), EXACT),
        (((2.0, 4 + 2.0**-50),), RIGHT + WITHIN),
        (((2.0, 5.0),), RIGHT + BEYOND),
        ((), FEW + BEYOND),
        (((2.0, 3.0), (3.5, 4.0)), MANY + BEYOND),
    ],
)
def test_a_difference_is_named(pairs: tuple[tuple[float, float], ...], says: str) -> None:
    from raycert.oracle.judge.answer import Listed

    case = ROD, Ray((-3, 0, 1), (1, 0, 0))
    assert difference(Listed(pairs), Judge(*case, BINARY64)) == says


def test_first_hits_and_yes_or_no_have_looks_and_differences() -> None:
    judge = Judge(ROD, Ray((-3, 0, 1), (1, 0, 0)), BINARY64)
    assert difference(First(2.0, "zero"), judge) == EXACT
    assert difference(First(None, "zero"), judge) == FEW + BEYOND
    assert difference(First(1.0, "zero"), judge) == RIGHT + BEYOND
    assert difference(YesNo(False), judge) == FEW + BEYOND
    said = [looks(a) for a in (First(2.0, "zero"), First(0.0, "zero"), First(None, "zero"))]
    assert said == ["a first hit", "a first hit at 0", "no hit"]
    assert [looks(YesNo(True)), looks(YesNo(False))] == ["a hit", "no hit"]


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        (Reply("", intervals=((1.0, 0.0),)), "malformed"),
        (Reply("", unsupported="too hard"), "unsupported: too hard"),
        (Reply("", error="oh"), "error: oh"),
    ],
)
def test_what_is_no_answer_says_why(reply: Reply, says: str) -> None:
    cell = Comparison("k", Hello("x"), BINARY64)(TANGENT.probe({}), reply)
    assert cell.value is None
    assert says in cell.says


def test_a_gross_answer_has_an_infinite_error() -> None:
    reply = Reply("", intervals=())
    cell = Comparison("ulps", Hello("x"), BINARY64)(Probe(ROD, Ray((-3, 0, 1), (1, 0, 0))), reply)
    assert cell.value == inf


def test_a_target_that_cannot_take_the_case_is_refused() -> None:
    from raycert.cases.formats import BINARY32

    with pytest.raises(Mismatch, match="binary32"):
        asked("k", inputs=Inputs(*TANGENT.probe({}), BINARY32))


@contextmanager
def _impatient(verb: str, _total: int) -> Iterator[Callable[..., None]]:
    done = 0

    def advance(n: int = 1) -> None:
        nonlocal done
        done += n
        if verb == "comparing" and done == 9:
            raise KeyboardInterrupt

    yield advance


@pytest.mark.parametrize("show", ["exact", "k"])
def test_an_interrupt_keeps_the_cells_around_the_case(show: Show) -> None:
    found = sample(plan(), show, target([REFERENCE]), None, _impatient)
    assert set(found.cells) == {(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)}
    assert not found.whole
    assert found.cells == {
        at: sample(plan(), show, target([REFERENCE])).cells[at] for at in found.cells
    }
