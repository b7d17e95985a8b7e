"""The witness by symbols: its proofs hold and can fail, and it solves cases by itself."""

from __future__ import annotations

from dataclasses import replace

import pytest

from raycert.cases.draw import fresh
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
)
from raycert.cases.table import PROBLEM_1, PROBLEM_2
from raycert.oracle.exact.surd import INFINITY, Surd
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness.proofs import PROOFS, complete, derivation, equal, exclusive, pretty
from raycert.oracle.witness.symbols import rod, witness

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)


def test_every_statement_is_proved() -> None:
    statements = derivation()
    assert len(statements) == len(PROOFS) + 8
    assert all(statement.proved for statement in statements)


@pytest.mark.parametrize(
    "text",
    [
        "dD = 2*s + 2*((x - p) @ h)",
        "Dmin = (x - p) @ (x - p) - ((x - p) @ w)**2",
        "F = (ybar + t*vbar) @ (ybar + t*vbar) - r**2",
        "wall.disc = r**2*(vbar @ vbar) - (vbar ^ ybar) @ (vbar ^ ybar)",
        "wall.a*t**2 + wall.b*t + wall.c = F",
        "roots[1] = (-l**2*(vbar @ ybar) - S) / (l**2*(vbar @ vbar))",
        "cross_q = -((u - p) @ n)/(v @ n)",
        "cap_q.c + cap_q.b*t = l*((u + t*v - q) @ n)",
        "h @ h = 2",
    ],
)
def test_a_wrong_statement_is_not(text: str) -> None:
    assert not equal(text)


def test_the_derived_condition_is_quadratic_and_rational() -> None:
    assert rod().degree() == 2
    assert all(c.as_numer_denom()[1] == 1 for c in rod().all_coeffs())


def test_equations_are_printed_as_people_write_them() -> None:
    assert pretty("F = l**2 * ((v ^ h) @ y)**2 - 2*r") == "F = l^2 ((v x h).y)^2 - 2 r"


def test_a_table_with_a_gap_is_not_complete() -> None:
    assert not complete(PROBLEM_2[:-1], "Problem 2")
    assert not complete(PROBLEM_1[1:], "Problem 1")


def test_a_table_whose_rows_overlap_is_not_exclusive() -> None:
    loose = replace(PROBLEM_2[0], condition=(("up", "<= 0"), ("uq", ">= 0"), ("vn", ">= 0")))
    assert not exclusive((loose, *PROBLEM_2[1:]), "Problem 2")


BY_HAND: list[tuple[Solid, Ray, str]] = [
    (CAN, Ray((-3, 0, 1), (1, 0, 0)), "[[2, 4]]"),
    (CAN, Ray((-3, 1, 1), (1, 0, 0)), "[[3, 3]]"),
    (CAN, Ray((0, 0, 1), (0, 0, 0)), "[[0, inf]]"),
    (Slab((0, 0, 0), (0, 0, 2)), Ray((0, 0, 2), (1, 0, 0)), "[[0, inf]]"),
    (HalfSpace((0, 0, 0), (0, 0, 1)), Ray((0, 0, 1), (0, 0, -3)), "[[1/3, inf]]"),
    (
        Sphere((0, 0, 0), 2),
        Ray((-3, 1, 0), (1, 0, 0)),
        "[[root 0 of t**2 - 6*t + 6, root 1 of t**2 - 6*t + 6]]",
    ),
    (Difference((CAN, CAN)), Ray((-3, 0, 1), (1, 0, 0)), "[]"),
    (Union((CAN, Sphere((2, 0, 1), 1))), Ray((-3, 0, 1), (1, 0, 0)), "[[2, 6]]"),
    (Intersection((CAN, Sphere((2, 0, 1), 1))), Ray((-3, 0, 1), (1, 0, 0)), "[[4, 4]]"),
]


@pytest.mark.parametrize(("solid", "ray", "found"), BY_HAND)
def test_list_by_hand(solid: Solid, ray: Ray, found: str) -> None:
    verdict = witness(solid, ray, trace(solid, ray).intervals)
    assert (verdict.outcome, verdict.found) == ("agreed", found)


def test_agrees_with_the_oracle_on_a_sample() -> None:
    for case in fresh(80, 13):
        verdict = witness(case.solid, case.ray, trace(case.solid, case.ray).intervals)
        assert verdict.outcome == "agreed", (case, verdict)


def test_one_number_in_two_forms_is_one_root() -> None:
    """sqrt(8) / 2 and sqrt(2) are the same root of the same polynomial."""
    solid, ray = Sphere((0, 0, 0), 2), Ray((-3, 1, 0), (1, 0, 0))
    forms = ((Surd(3, -1, 3, 1), Surd(6, 1, 12, 2)),)
    assert witness(solid, ray, forms).outcome == "agreed"


def test_the_conjugate_is_another_root() -> None:
    solid, ray = Sphere((0, 0, 0), 2), Ray((-3, 1, 0), (1, 0, 0))
    ((enter, leave),) = trace(solid, ray).intervals
    assert witness(solid, ray, ((leave, leave),)).outcome == "disagreed"
    assert witness(solid, ray, ((enter, INFINITY),)).outcome == "disagreed"
    assert witness(solid, ray, ()).outcome == "disagreed"


def test_roots_2_to_the_minus_1000_apart_are_isolated() -> None:
    tiny, ray = 2.0**-500, Ray((-3, 0, 0), (1, 0, 0))
    solid = Union((Sphere((0, 0, 0), 1), Sphere((0, tiny, 0), 1)))
    assert witness(solid, ray, trace(solid, ray).intervals).outcome == "agreed"
