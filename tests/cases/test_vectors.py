"""Vectors: exact over exact numbers; over doubles, rounded in the order they are written in."""

from __future__ import annotations

from fractions import Fraction

import pytest

from raycert.cases.vectors import along, cross, dot, minus, norm, plus, times, unit


def test_integers_and_fractions_stay_exact() -> None:
    a, b = (10**30, 2, 3), (4, -5, 6)
    assert dot(a, b) == 4 * 10**30 + 8
    assert dot(cross(a, b), a) == dot(cross(a, b), b) == 0
    assert minus(plus(a, b), b) == a
    third = Fraction(1, 3)
    assert times(third, (third, 1, 3)) == (third**2, third, 1)
    assert along((1, 2, 3), third, (3, 6, 9)) == (2, 4, 6)


def test_a_dot_product_of_doubles_adds_from_the_left() -> None:
    assert dot((1e16, 1.0, 1.0), (1.0, 1.0, 1.0)) == 1e16
    assert dot((1.0, 1.0, 1e16), (1.0, 1.0, 1.0)) == 1e16 + 2


@pytest.mark.parametrize("size", [1e-308, 1.0, 1e300])
def test_lengths_neither_overflow_nor_vanish(size: float) -> None:
    assert norm((3 * size, 0.0, 4 * size)) == pytest.approx(5 * size)
    assert unit((3 * size, 0.0, 4 * size)) == pytest.approx((0.6, 0.0, 0.8))
