"""The derivation says what the oracle found: the rows taken, every sign, the exact ends."""

import json
from fractions import Fraction
from math import isnan

import pytest
from hypothesis import given as forall
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
)
from raycert.cases.table import HALF_SPACE, PROBLEM_1, PROBLEM_2, PROBLEM_3
from raycert.oracle.exact.surd import INFINITY, Surd
from raycert.oracle.exact.trace import trace
from raycert.oracle.explain.console import passage_lines
from raycert.oracle.explain.derive import derive, given, judgement, solid_steps, to_json
from raycert.oracle.explain.wording import (
    Fact,
    Note,
    Passage,
    Table,
    brief,
    dyadic,
    endpoint,
    shorten,
    tidy,
    vector,
)
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo.textbook import textbook

UNIT = Cylinder((0, 0, 0), (0, 0, 2), 1)
BALL = Sphere((0, 0, 0), 1)
SIGNS = {"< 0": -1, "= 0": 0, "> 0": 1, "-": None}
TABLES = {
    "cylinder": (PROBLEM_1, PROBLEM_2, PROBLEM_3),
    "slab": (PROBLEM_2,),
    "infinite": (PROBLEM_1,),
    "half": (HALF_SPACE,),
    "ball": (PROBLEM_1,),
}
LEAVES: dict[str, Solid] = {
    "cylinder": UNIT,
    "slab": Slab((0, 0, 0), (0, 0, 2)),
    "infinite": InfiniteCylinder((0, 0, 0), (0, 0, 2), 1),
    "half": HalfSpace((0, 0, 1), (0, 0, 3)),
    "ball": BALL,
}
RAYS = {
    "through": Ray((-3, 0, 1), (1, 0, 0)),
    "oblique": Ray((-3.3, 0.1, 1.7), (1.3, 0.01, -0.2)),
    "tangent": Ray((-3, 1, 2), (2, 0, 0)),
    "miss": Ray((-3, 4, 2), (2, 0, 0)),
    "behind": Ray((3, 0, 1), (1, 0, 0)),
    "inside": Ray((0.5, 0, 1), (0, 1, 1)),
    "parallel": Ray((0.5, 0, 5), (0, 0, -1)),
    "outside": Ray((2, 0, 5), (0, 0, -1)),
    "still": Ray((0.5, 0, 1), (0, 0, 0)),
    "still-outside": Ray((5, 0, 9), (0, 0, 0)),
    "far": Ray((-3e9, 1e9, 1), (3, -1, 1e-10)),
    "huge": Ray((-3e200, 0, 1), (1e-200, 0, 5e-324)),
}

small = st.floats(-8, 8, width=32)
vectors = st.tuples(small, small, small)


def tables(steps: tuple[Passage, ...]) -> list[Table]:
    return [line for step in steps for line in step.lines if isinstance(line, Table)]


def facts(steps: tuple[Passage, ...]) -> dict[str, Fact]:
    return {line.name: line for step in steps for line in step.lines if isinstance(line, Fact)}


def text(steps: tuple[Passage, ...], width: int = 80, full: bool = False) -> str:
    return "\n".join(line.plain for step in steps for line in passage_lines(step, width, full))


@pytest.mark.parametrize("ray", RAYS.values(), ids=RAYS)
@pytest.mark.parametrize("kind", LEAVES)
def test_every_table_is_there_with_the_row_that_the_oracle_took(kind: str, ray: Ray) -> None:
    shown = tables(tuple(solid_steps(LEAVES[kind], ray)))
    decisions = trace(LEAVES[kind], ray).decisions
    assert [[row.name for row in table.rows] for table in shown] == [
        [row.name for row in rows] for rows in TABLES[kind]
    ]
    for table, decision in zip(shown, decisions, strict=True):
        assert [row.name for row in table.rows if row.taken] == [decision.row.name]
        for row in table.rows:
            asked = [cell for cell in row.cells if cell]
            assert row.taken == all(cell.holds for cell in asked)


@pytest.mark.parametrize("ray", RAYS.values(), ids=RAYS)
@pytest.mark.parametrize("kind", LEAVES)
def test_signs_of_the_facts_are_those_of_the_tables(kind: str, ray: Ray) -> None:
    steps = tuple(solid_steps(LEAVES[kind], ray))
    known = facts(steps)
    for table in tables(steps):
        for name, sign in zip(table.quantities, table.signs, strict=True):
            plain = name.replace(" ", "")
            same = [fact for fact in known.values() if fact.name.replace(" ", "") == plain]
            for fact in same:
                assert fact.sign == sign, name
            assert same or sign == "-" or name[:5] in ("t1", "t2", "pairs", "m - n")


@forall(vectors, vectors, vectors, st.floats(0, 4, width=32))
def test_values_computed_apart_have_the_signs_that_decided(
    u: tuple[float, float, float],
    v: tuple[float, float, float],
    q: tuple[float, float, float],
    r: float,
) -> None:
    p = (0.25, -1.0, 0.5)
    if p == q:
        return
    solid, ray = Cylinder(p, q, r), Ray(u, v)
    steps = tuple(solid_steps(solid, ray))
    known = facts(steps)
    one, two, _ = (dict(decision.signs) for decision in trace(solid, ray).decisions)
    names = {"vv": "|vbar|^2", "inside": "r^2 - |ybar|^2", "disc": "disc"}
    names |= {"up": "(u - p) . n", "uq": "(u - q) . n", "vn": "v . n"}
    for quantity, sign in (one | two).items():
        if quantity in names:
            assert SIGNS[known[names[quantity]].sign] == sign


def test_the_seeds_quantities_of_a_known_case() -> None:
    known = facts(derive(given(UNIT, RAYS["through"]), BINARY64).steps)
    assert known["w = q - p"].value == "(0, 0, 2)"
    assert known["y = u - p"].value == "(-3, 0, 1)"
    assert known["v x w"].value == "(0, -2, 0)"
    assert known["disc"].value == "4"
    assert (known["t1"].value, known["t2"].value) == ("2", "4")
    assert known["enter"].value == "2"
    assert known["a > c"].value == "m = max(a, c) = a"
    assert known["decisive for"].value == "sound, stable, faithful, exact"


def test_endpoints_are_exact() -> None:
    known = facts(derive(given(UNIT, RAYS["far"]), BINARY64).steps)
    assert known["enter"].value == "(10000000000 - sqrt(10)) / 10"
    assert known["leave"].value == "(10000000000 + sqrt(10)) / 10"
    assert known["  digits"].value.startswith("1000000000.3162277660")


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (Surd(6, -2, 8, 4), "(3 - sqrt(8)) / 2"),
        (Surd(0, 1, 2, 1), "sqrt(2)"),
        (Surd(0, -1, 2, 1), "-sqrt(2)"),
        (Surd(0, 1, 2, 3), "sqrt(2) / 3"),
        (Surd(1, 1, 2, 1), "1 + sqrt(2)"),
        (Surd(1, 1, 4, 6), "1/2"),
        (INFINITY, "inf"),
    ],
)
def test_endpoints_in_words(number: Surd, words: str) -> None:
    assert endpoint(number) == words


@pytest.mark.parametrize("digits", ["1.5e+0", "-2.25e-2", "1.0000e+2", "9.1e+300", "3.25e-9"])
def test_tidy_digits_are_the_same_number(digits: str) -> None:
    assert Fraction(tidy(digits)) == Fraction(digits)


@forall(st.floats(allow_nan=False, allow_infinity=False))
def test_dyadic_words_are_exact(x: float) -> None:
    whole, _, power = dyadic(Fraction(x)).partition("*2^")
    assert Fraction(whole) * Fraction(2) ** int(power or 0) == Fraction(x)


def test_vectors_share_one_power_of_two() -> None:
    fact = vector("w", (Fraction(0.1), Fraction(0), Fraction(-3)))
    whole, power = fact.value.split("*2^")
    values = [Fraction(n) * Fraction(2) ** int(power) for n in whole.strip("()").split(", ")]
    assert values == [Fraction(0.1), 0, -3]


def test_short_numbers_are_not_cut_and_long_ones_say_how_long_they_are() -> None:
    assert shorten("12345678901234567890") == "12345678901234567890"
    assert shorten("7" * 30 + "*2^-90") == "777777...7777 (30 digits)*2^-90"
    assert shorten("0." + "7" * 40) == "0." + "7" * 40
    assert brief(Surd(1, 0, 0, 3)) == "1/3"


@pytest.mark.parametrize("width", [80, 120])
@pytest.mark.parametrize("kind", LEAVES)
@pytest.mark.parametrize("ray", RAYS.values(), ids=RAYS)
def test_lines_fit_the_screen(kind: str, ray: Ray, width: int) -> None:
    shown = text(derive(given(LEAVES[kind], ray), BINARY64).steps, width)
    assert max(len(line.rstrip()) for line in shown.splitlines()) <= width


def test_a_cylinder_takes_about_a_screen_and_a_half() -> None:
    for ray in RAYS.values():
        assert len(text(derive(given(UNIT, ray), BINARY64).steps).splitlines()) <= 90


def test_full_cuts_nothing() -> None:
    steps = derive(given(UNIT, RAYS["oblique"]), BINARY64).steps
    assert "..." in text(steps)
    assert "..." not in text(steps, 10**9, full=True)


def test_special_directions_are_said_in_words() -> None:
    assert "v = 0: the ray stays" in text(tuple(solid_steps(UNIT, RAYS["still"])))
    assert "parallel to the axis" in text(tuple(solid_steps(UNIT, RAYS["parallel"])))
    assert "keeps its distance" in text(tuple(solid_steps(UNIT, RAYS["through"])))
    assert "double root" in text(tuple(solid_steps(UNIT, RAYS["tangent"])))


def test_a_tree_is_its_leaves_and_then_its_lists() -> None:
    tree = Difference((BALL, Union((Slab((0, 0, 0), (0, 0, 2)), UNIT))))
    ray = Ray((-3, 0, -0.5), (1, 0, 0))
    derivation = derive(given(tree, ray), BINARY64)
    headings = [step.heading for step in derivation.steps]
    assert any(heading.startswith("of[1].of[1] (cylinder): Problem 3") for heading in headings)
    known = facts(derivation.steps)
    assert known["of[1]"].note == "of[1].of[0] or of[1].of[1]"
    assert known["the solid"].note == "of[0], less of[1]"
    assert known["the solid"].value == known["of[0]"].value


def test_json_holds_the_row_and_every_step() -> None:
    form = json.loads(json.dumps(to_json(derive(given(UNIT, RAYS["through"]), BINARY64))))
    assert form["row"]["rows"][:3] == ["through", "AE", "meet"]
    assert {line["form"] for step in form["steps"] for line in step["lines"]} == {
        "fact",
        "table",
        "note",
    }


def test_the_textbook_answer_far_away_is_sound_and_not_stable() -> None:
    judge = Judge(UNIT, RAYS["far"], BINARY64)
    answer = textbook(UNIT, RAYS["far"])
    assert judge.holds("sound", answer)
    assert not judge.holds("stable", answer)
    step = judgement(derive(given(UNIT, RAYS["far"]), BINARY64).row, judge)
    strict = judge.backward_error(answer, "strict")
    assert strict > 1e5
    assert any(isinstance(x, Fact) and f"k {strict:.2g} strict" in x.value for x in step.lines)


def test_the_textbook_answer_is_right_where_nothing_cancels() -> None:
    for name in ("through", "tangent", "miss", "behind", "parallel", "outside", "still"):
        for solid in LEAVES.values():
            judge = Judge(solid, RAYS[name], BINARY64)
            assert judge.holds("stable", textbook(solid, RAYS[name])), name


def test_the_textbook_survives_overflow_and_says_nan() -> None:
    for ray, fmt in (
        (Ray((-3e200, 0, 1), (1e200, 0, 0)), BINARY64),
        (Ray((-3e30, 0, 1), (1e30, 0, 0)), BINARY32),
    ):
        [(enter, leave)] = textbook(UNIT, ray, fmt)
        assert isnan(enter)
        assert isnan(leave)
    lines = text(derive(given(UNIT, Ray((-3e200, 0, 1), (1e200, 0, 0))), BINARY64).steps)
    assert "not well-formed: NaN" in lines
    assert textbook(Cylinder((0, 0, 0), (0, 0, 5e-324), 5e-324), RAYS["through"])
    tree = Difference((BALL, UNIT))
    assert all(isnan(x) for x in textbook(tree, Ray((-3e200, 0, 1), (1e200, 0, 0)))[0])


def test_binary32_operations_are_rounded_to_binary32() -> None:
    solid, ray = Sphere((0, 0, 0), 0.75), Ray((-3, 0.25, 0.25), (1.5, 0.125, 0))
    [(enter, leave)] = textbook(solid, ray, BINARY32)
    assert BINARY32.holds(enter)
    assert BINARY32.holds(leave)
    [(wide, _)] = textbook(solid, ray)
    assert enter != wide
    assert abs(enter - wide) < 1e-6


def test_notes_name_the_part_of_the_seed() -> None:
    notes = [
        line.text
        for step in solid_steps(UNIT, RAYS["through"])
        for line in step.lines
        if isinstance(line, Note) and line.text.startswith("Row")
    ]
    assert notes == [
        "Row through, Problem 1 (f,g-II,i): (a, b) = (t1, t2)",
        "Row AE, Problem 2 (g): (c, d) = (0, inf)",
        "Row meet, Problem 3 (d): (m, n)",
    ]
