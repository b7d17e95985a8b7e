"""The witness by enclosure: agreement, precision that grows and is put back, and no guesses."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import iv

from raycert.cases.draw import fresh
from raycert.cases.model import Cylinder, Intersection, Ray, Slab, Sphere, Union
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, fraction
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness.enclosure import (
    Blurred,
    Enclosed,
    compare,
    precision,
    same,
    sign,
    witness,
)

LEAST = 2.0**-1074
CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
NEAR_TANGENT = (Sphere((0, LEAST, 0), 1.0), Ray((-3, 1, 0), (1, 0, 0)))


def truth(solid: Sphere | Cylinder | Union, ray: Ray) -> Intervals:
    return trace(solid, ray).intervals


def test_agrees_with_the_oracle_on_a_sample() -> None:
    for case in fresh(400, 12):
        verdict = witness(case.solid, case.ray, trace(case.solid, case.ray).intervals)
        assert verdict.outcome == "agreed", (case, verdict)


def test_precision_grows_until_every_decision_is_separated() -> None:
    verdict = witness(*NEAR_TANGENT, truth(*NEAR_TANGENT))
    assert verdict.outcome == "agreed"
    assert verdict.why == "every end is in its enclosure, at 2048 bits"


def test_a_decision_beyond_the_cap_is_undecided() -> None:
    verdict = witness(*NEAR_TANGENT, truth(*NEAR_TANGENT), cap=1024)
    assert verdict.outcome == "undecided"
    assert verdict.found == ""
    assert verdict.why == "a decision is not separated from zero at 1024 bits"


def test_undecided_also_where_the_answer_is_wrong() -> None:
    assert witness(*NEAR_TANGENT, ((ZERO, INFINITY),), cap=1024).outcome == "undecided"


def test_a_tangent_needs_no_precision() -> None:
    ray = Ray((-3, 1, 1), (1, 0, 0))
    verdict = witness(CAN, ray, truth(CAN, ray))
    assert (verdict.outcome, verdict.why) == (
        "agreed",
        "every end is in its enclosure, at 128 bits",
    )


def test_precision_is_put_back() -> None:
    iv.prec = 61
    try:
        witness(*NEAR_TANGENT, ())
        assert iv.prec == 61
        with pytest.raises(RuntimeError), precision(99):
            raise RuntimeError
        assert iv.prec == 61
    finally:
        iv.prec = 53


@pytest.mark.parametrize("bits", [60, 200, 500])
def test_an_endpoint_moved_by_any_amount_is_another_number(bits: int) -> None:
    ray = Ray((-3, 0.25, 1), (1, 0.125, 0))
    ((enter, leave),) = truth(CAN, ray)
    part = 1 << bits
    moved = Surd(enter.x * (part + 1), enter.y * (part + 1), enter.d, enter.z * part)
    verdict = witness(CAN, ray, ((moved, leave),))
    assert verdict.outcome == "disagreed"
    assert verdict.why.startswith("the enter of interval 0 is ")
    assert ("another number" in verdict.why) == (bits > 128)


def test_the_other_root_of_the_polynomial_is_not_the_end() -> None:
    ray = Ray((-3, 0.25, 1), (1, 0.125, 0))
    ((enter, leave),) = truth(CAN, ray)
    assert witness(CAN, ray, ((enter, enter),)).outcome == "disagreed"
    assert witness(CAN, ray, ((leave, leave),)).outcome == "disagreed"
    assert witness(CAN, ray, ((enter, INFINITY),)).outcome == "disagreed"


def test_equal_ends_of_different_faces_are_one() -> None:
    ray = Ray((-3, 0, 1), (1, 0, 0))
    solid = Union((CAN, Slab((1, 0, 0), (5, 0, 0)), Intersection((Sphere((0, 0, 1), 1),))))
    verdict = witness(solid, ray, trace(solid, ray).intervals)
    assert (verdict.outcome, verdict.found) == ("agreed", "[[2.0, 8.0]]")


def end(low: float, high: float, root: int, *coefficients: int) -> Enclosed:
    return Enclosed(iv.mpf([low, high]), tuple(map(Fraction, coefficients)), root)


def test_overlapping_ends_are_equal_only_by_their_polynomials() -> None:
    root_2 = end(1, 2, 1, 1, 0, -2)
    assert compare(root_2, end(1, 2, 1, 3, 0, -6)) == 0
    assert compare(root_2, end(3, 4, 1, 1, 0, -12)) == -1
    assert compare(root_2, None) == -1
    assert compare(None, None) == 0
    with pytest.raises(Blurred):
        compare(root_2, end(1, 2, 1, 1, 0, -3))
    assert not same(root_2, end(-2, 2, 0, 1, 0, -2))


def test_a_shared_rational_root_is_told_from_the_other_one() -> None:
    one_two = end(0, 3, 0, 1, -3, 2)
    assert same(one_two, end(0, 3, 0, 1, -1))
    assert not same(one_two, end(0, 3, 0, 1, -2))
    assert same(one_two, end(0, 3, 1, 1, 0, -1))
    assert not same(one_two, end(0, 3, 0, 1, 0, -1))
    assert same(end(0, 2, 0, 1, -2, 1), end(0, 2, 1, 1, -2, 1))


def test_a_formula_that_contradicts_its_polynomial_is_no_verdict() -> None:
    with pytest.raises(ArithmeticError, match="enclosure of a number"):
        sign(iv.mpf([1, 2]), Fraction(-1))
    with pytest.raises(Blurred):
        sign(iv.mpf([-1, 2]), Fraction(1))
    assert sign(iv.mpf([-1, 2]), Fraction(0)) == 0
    assert compare(end(0, 0, 0, 1, 0), end(-1, 1, 0, 5, 0)) == 0
    assert fraction(0, 5) == ZERO
