"""The case table, proved: its rows exclude one another and leave nothing out.

First the axioms that link the quantities, as polynomial identities in the inputs; then boolean
reasoning over the three signs of every quantity; then which cells occur, by exhaustion over the
order types of the endpoints, on real scenes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import combinations, combinations_with_replacement, permutations, product

import pytest
from sympy import And, Expr, Matrix, Not, Or, Symbol, Xor, expand, simplify, sqrt, symbols
from sympy.logic.inference import satisfiable

from raycert.cases.model import Cylinder, Ray
from raycert.cases.table import (
    HALF_SPACE,
    HOLDS,
    IMPOSSIBLE,
    PROBLEM_1,
    PROBLEM_2,
    PROBLEM_3,
    Row,
    cells,
    comparison_names,
    pairs_of_rows,
    unreachable,
)
from raycert.oracle.exact.trace import trace

TABLES = {
    "problem-1": PROBLEM_1,
    "problem-2": PROBLEM_2,
    "half-space": HALF_SPACE,
    "problem-3": PROBLEM_3,
}


def vector(name: str) -> Matrix:
    return Matrix(symbols(f"{name}1:4", real=True))


U, V, P, Q, X = (vector(name) for name in "uvpqx")
R, T = symbols("r t", real=True)
W, Y = Q - P, U - P
WW = W.dot(W)
# times |w|^2, so that no root and no quotient is left
VV = V.cross(W).dot(V.cross(W))
VY = V.cross(W).dot(Y.cross(W))
YY = Y.cross(W).dot(Y.cross(W))
INSIDE = R**2 * WW - YY


def is_zero(expression: Expr) -> bool:
    return bool(expand(expression) == 0)


# (a) the axioms, as identities


def test_lagrange() -> None:
    assert is_zero(U.dot(V) ** 2 + U.cross(V).dot(U.cross(V)) - U.dot(U) * V.dot(V))


def test_the_condition_of_problem_1_is_that_of_the_distance() -> None:
    """|(x - p) x w|^2 <= r^2 |w|^2 at x = u + t v is vv t^2 + 2 vy t + yy - r^2 ww <= 0."""
    x = U + T * V - P
    distance = x.cross(W).dot(x.cross(W)) - R**2 * WW
    assert is_zero(distance - (VV * T**2 + 2 * VY * T - INSIDE))


def test_the_discriminant_is_that_of_the_seed() -> None:
    """With vbar = v x w/|w|: b^2 - a c = |w|^4 (r^2 |vbar|^2 - |vbar x ybar|^2)."""
    cross = V.cross(W).cross(Y.cross(W))
    seed_times_ww2 = R**2 * VV * WW - cross.dot(cross)
    det = V.cross(W).dot(Y)
    assert is_zero(VY**2 + VV * INSIDE - seed_times_ww2)
    assert is_zero(cross.dot(cross) - WW * det**2)


def test_vv_is_a_sum_of_squares_and_its_vanishing_leaves_no_t() -> None:
    """vv >= 0; where v x w = 0 the condition is -inside <= 0 for every t."""
    c = V.cross(W)
    assert is_zero(VV - (c[0] ** 2 + c[1] ** 2 + c[2] ** 2))
    parallel = {V[i]: X[0] * W[i] for i in range(3)}  # v = x w
    assert is_zero((VV * T**2 + 2 * VY * T).subs(parallel))


def test_the_roots_are_roots_in_order() -> None:
    """a f(t) = (a t + b)^2 - disc: no sign change where disc < 0; t2 - t1 = 2 sqrt(disc) / a."""
    a, s = symbols("a s", positive=True)
    b, c = symbols("b c", real=True)
    f, disc = a * T**2 + 2 * b * T + c, b * b - a * c
    assert is_zero(a * f - ((a * T + b) ** 2 - disc))
    t1, t2 = (-b - s) / a, (-b + s) / a
    assert simplify((t2 - t1).subs(s, sqrt(s))).is_positive
    assert is_zero((f - a * (T - t1) * (T - t2)).subs(c, (b * b - s * s) / a))


def test_up_is_below_uq() -> None:
    """Times |q - p|, n is p - q: up - uq = -|q - p|^2 < 0, since p != q."""
    n = P - Q
    up, uq = (U - P).dot(n), (U - Q).dot(n)
    assert is_zero(up - uq + WW)
    assert is_zero(WW - sum((Q[i] - P[i]) ** 2 for i in range(3)))


def test_the_crossings_are_where_the_planes_vanish_and_in_order() -> None:
    """tp - tq = (uq - up) / vn has the sign of vn: tq < tp in BG, tp < tq in CF."""
    up, uq, vn = symbols("up uq vn", real=True)
    tp, tq = -up / vn, -uq / vn
    assert simplify(up + tp * vn) == 0
    assert simplify((tp - tq) - (uq - up) / vn) == 0


# (b) the rows, by their signs

AXIOMS = {
    "problem-1": (("vv", {0, 1}),),
    "problem-3": (("pairs_1", {0, 1}), ("pairs_2", {0, 1})),
}
SIGNS = {-1: "neg", 0: "zero", 1: "pos"}


def atom(quantity: str, sign: int) -> Symbol:
    return Symbol(f"{quantity}_{SIGNS[sign]}")


def one_of(quantity: str, signs: set[int] | frozenset[int]) -> Or:
    return Or(*(atom(quantity, s) for s in sorted(signs)))


def holds(row: Row) -> And:
    return And(*(one_of(quantity, HOLDS[relation]) for quantity, relation in row.condition))


def axioms(name: str, table: tuple[Row, ...]) -> And:
    """Return trichotomy of every quantity in the table, and what links them."""
    facts: list[object] = []
    for quantity in sorted({q for row in table for q, _ in row.condition}):
        facts.append(one_of(quantity, {-1, 0, 1}))
        facts += [Not(And(atom(quantity, s), atom(quantity, t))) for s, t in combinations(SIGNS, 2)]
    facts += [one_of(quantity, signs) for quantity, signs in AXIOMS.get(name, ())]
    if name == "problem-2":  # up < uq
        facts.append(Or(atom("up", -1), atom("uq", 1)))
    return And(*facts)


def faults(table: tuple[Row, ...], facts: And) -> Iterator[str]:
    """Yield every overlap of two rows, and whether anything is left out."""
    for one, two in combinations(table, 2):
        if satisfiable(And(facts, holds(one), holds(two))):
            yield f"{one.name} and {two.name}"
    if satisfiable(And(facts, Not(Or(*(holds(row) for row in table))))):
        yield "a gap"


@pytest.mark.parametrize("name", TABLES)
def test_rows_exclude_one_another_and_leave_nothing_out(name: str) -> None:
    assert list(faults(TABLES[name], axioms(name, TABLES[name]))) == []


@pytest.mark.parametrize("name", TABLES)
def test_every_row_can_occur(name: str) -> None:
    facts = axioms(name, TABLES[name])
    assert all(satisfiable(And(facts, holds(row))) for row in TABLES[name])


def test_without_up_below_uq_the_rows_of_problem_2_overlap() -> None:
    """The proof uses the axiom, so it is not vacuous."""
    assert list(faults(PROBLEM_2, axioms("no axioms", PROBLEM_2))) == [
        "AH and DE",
        "AH and CF",
        "BG and DE",
    ]


def mutants(table: tuple[Row, ...]) -> Iterator[tuple[Row, Row, tuple[Row, ...]]]:
    """Yield every table with one relation replaced by another: (row, its mutant, table)."""
    for i, row in enumerate(table):
        for j, (quantity, relation) in enumerate(row.condition):
            for other in HOLDS:
                if other != relation:
                    condition = (*row.condition[:j], (quantity, other), *row.condition[j + 1 :])
                    mutant = replace(row, condition=condition)
                    yield row, mutant, (*table[:i], mutant, *table[i + 1 :])


@pytest.mark.parametrize("name", TABLES)
def test_any_other_relation_in_any_row_is_noticed(name: str) -> None:
    facts = axioms(name, TABLES[name])
    noticed = 0
    for row, mutant, table in mutants(TABLES[name]):
        means_another = satisfiable(And(facts, Xor(holds(row), holds(mutant))))
        assert any(faults(table, facts)) == bool(means_another), mutant.condition
        noticed += bool(means_another)
    assert noticed > 4 * len(TABLES[name])


@pytest.mark.parametrize("name", TABLES)
def test_a_table_takes_the_row_that_holds(name: str) -> None:
    """For every combination of signs: the row, or ArithmeticError where the axioms forbid it."""
    table = TABLES[name]
    quantities = sorted({q for row in table for q, _ in row.condition})
    for signs in product(SIGNS, repeat=len(quantities)):
        known = dict(zip(quantities, signs, strict=True))
        rows = [r for r in table if all(known[q] in HOLDS[relation] for q, relation in r.condition)]
        if rows:
            row, asked = table.decide(known.__getitem__)
            assert row == rows[0]
            assert all(known[q] == s for q, s in asked)
            assert {q for q, _ in row.condition} <= {q for q, _ in asked}
        else:
            with pytest.raises(ArithmeticError):
                table.decide(known.__getitem__)


@pytest.mark.parametrize("name", TABLES)
def test_no_row_asks_for_what_is_undefined(name: str) -> None:
    """The roots are asked for only where vv != 0 and disc >= 0, m - n only with two pairs."""
    needs = {
        "t1": {"vv": {1}, "disc": {0, 1}},
        "t2": {"vv": {1}, "disc": {0, 1}},
        "disc": {"vv": {1}},
        "m-n": {"pairs_1": {1}, "pairs_2": {1}},
    }
    table = TABLES[name]
    allowed = dict(AXIOMS.get(name, ()))
    quantities = sorted({q for row in table for q, _ in row.condition})
    for signs in product(*(sorted(allowed.get(q, set(SIGNS))) for q in quantities)):
        known = dict(zip(quantities, signs, strict=True))

        def ask(quantity: str, known: dict[str, int] = known) -> int:
            assert all(known[q] in s for q, s in needs.get(quantity, {}).items()), quantity
            return known[quantity]

        if name == "problem-2" and not (known["up"] < 0 or known["uq"] > 0):
            continue
        table.decide(ask)


# Which cells occur


def scene(one: Fraction, two: Fraction, tp: Fraction, tq: Fraction) -> tuple[Cylinder, Ray]:
    """Return a scene whose wall is crossed at `one` <= `two`, its cap planes at tp != tq."""
    middle, radius = (one + two) / 2, (two - one) / 2
    ray = Ray((float(-middle), 0, 0), (1, 0, 1))
    return Cylinder((0, 0, float(tp)), (0, 0, float(tq)), float(radius)), ray


def scenes() -> Iterator[tuple[Cylinder, Ray]]:
    """Yield scenes with every order of 0, t1, t2, tp, tq and infinity."""
    grid = [Fraction(n) for n in range(-4, 5)]
    for tp, tq in permutations(grid, 2):
        for one, two in combinations_with_replacement(grid, 2):
            can, ray = scene(one, two, tp, tq)
            yield can, ray
            for height in (float(tp), 9.0, -9.0):  # square to the axis: in a cap plane, and off
                yield can, Ray((ray.origin[0], 0, height), (1, 0, 0))
        for radius, z in product((1.0, 3.0), (0.0, 9.0, -9.0)):
            can = Cylinder((0, 0, float(tp)), (0, 0, float(tq)), radius)
            for v in ((0, 0, 1), (0, 0, 0)):  # along the axis, and nowhere
                yield can, Ray((2, 0, z), v)
            for v in ((1, 0, 0), (1, 0, 1)):  # past the wall
                yield can, Ray((-9, 8, z), v)


@cache
def reached(moving: bool = False) -> frozenset[tuple[str, ...]]:
    """Return the cells that occur, of all scenes or of those with a direction."""
    return frozenset(
        trace(can, ray).rows for can, ray in scenes() if any(ray.direction) or not moving
    )


def test_exactly_the_cells_of_the_table_occur() -> None:
    found, listed = reached(), cells()
    assert len(set(listed)) == len(listed)
    assert found == set(listed)


def test_all_42_pairs_of_rows_have_cells() -> None:
    assert len(pairs_of_rows()) == len(set(pairs_of_rows())) == 42
    assert {cell[:2] for cell in cells()} == set(pairs_of_rows())


def both_give_a_pair() -> list[tuple[str, str]]:
    ones = [row.name for row in PROBLEM_1 if row.pairs != "{}"]
    twos = [row.name for row in PROBLEM_2 if row.pairs != "{}"]
    return list(product(ones, twos))


def test_what_does_not_occur_has_a_reason_and_each_reason_is_needed() -> None:
    occur = {cell for cell in reached() if len(cell) == 6}
    used = set()
    for one, two in both_give_a_pair():
        for ac, bd, mn in product(SIGNS, repeat=3):
            names = comparison_names({"a-c": ac, "b-d": bd, "m-n": mn})
            occurs = (one, two, "apart" if mn > 0 else "meet", *names) in occur
            why = [r for r, forbids in IMPOSSIBLE if forbids(one, two, ac, bd, mn)]
            assert bool(why) != occurs, (one, two, names)
            assert unreachable(one, two, (ac, bd, mn)) == (why[0] if why else None)
            used |= set(why[:1]) if len(why) == 1 else set()
    assert used == {reason for reason, _ in IMPOSSIBLE}


def test_two_pairs_of_rows_need_the_zero_direction() -> None:
    """Parallel to the axis and square to it at once: only v = 0. All others have a v != 0."""
    still = {("along-inside", "AE"), ("along-outside", "AE")}
    assert {cell[:2] for cell in reached(moving=True)} == set(pairs_of_rows()) - still
    can = Cylinder((0, 0, 0), (0, 0, 2), 1)
    assert {trace(can, Ray((x, 0, 1), (0, 0, 0))).rows[:2] for x in (0, 9)} == still
