"""Double-double operations against fractions: exact where they say so, else within their bounds."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest

from raycert.oracle.batch import arithmetic as dd

UU = Fraction(1, 2**106)


def numbers(dice: np.random.Generator, n: int = 400) -> np.ndarray:
    """Return doubles of all signs and of sizes 2^-40 to 2^40, some with few bits."""
    x = dice.uniform(-1, 1, n) * 2.0 ** dice.integers(-40, 40, n)
    return np.where(dice.random(n) < 0.2, np.round(x), x)


def pairs(dice: np.random.Generator, n: int = 400) -> tuple[np.ndarray, np.ndarray]:
    x = numbers(dice, n)
    return dd.fast_two_sum(x, x * dice.uniform(-1, 1, n) * 2.0**-53)


def exact(x, i: int) -> Fraction:
    return Fraction(float(x[0][i])) + Fraction(float(x[1][i]))


@pytest.mark.parametrize("operation", [dd.two_sum, dd.two_prod], ids=["sum", "product"])
def test_the_error_free_ones_are_exact(operation) -> None:
    dice = np.random.default_rng(1)
    a, b = numbers(dice), numbers(dice)
    found = operation(a, b)
    for i in range(len(a)):
        x, y = Fraction(float(a[i])), Fraction(float(b[i]))
        assert exact(found, i) == (x + y if operation is dd.two_sum else x * y)


def near(a, dice):
    """Return numbers that cancel a to a few bits or to nothing."""
    return -a[0], -a[1] * dice.choice([0.0, 1.0, 0.5], len(a[1]))


@pytest.mark.parametrize("cancel", [False, True])
def test_sums_and_differences_are_within_their_bounds(cancel: bool) -> None:
    dice = np.random.default_rng(2)
    a = pairs(dice)
    b = near(a, dice) if cancel else pairs(dice)
    for operation, s in ((dd.add, 1), (dd.sub, -1)):
        found = operation(a, b)
        for i in range(len(a[0])):
            x, y = exact(a, i), exact(b, i)
            bound = Fraction(31, 10) * UU * (abs(x) + abs(y))
            assert abs(exact(found, i) - (x + s * y)) <= bound


@pytest.mark.parametrize(("operation", "units"), [(dd.mul, 5), (dd.div, 16)], ids=["mul", "div"])
def test_products_and_quotients_are_within_their_bounds(operation, units: int) -> None:
    dice = np.random.default_rng(3)
    a, b = pairs(dice), pairs(dice)
    at = np.nonzero(b[0])[0]
    a, b = (a[0][at], a[1][at]), (b[0][at], b[1][at])
    found = operation(a, b)
    for i in range(len(at)):
        x, y = exact(a, i), exact(b, i)
        truth = x * y if operation is dd.mul else x / y
        assert abs(exact(found, i) - truth) <= units * UU * abs(truth)


def test_products_with_a_double_are_within_their_bound() -> None:
    dice = np.random.default_rng(4)
    a, b = pairs(dice), numbers(dice)
    found = dd.scale(a, b)
    for i in range(len(b)):
        truth = exact(a, i) * Fraction(float(b[i]))
        assert abs(exact(found, i) - truth) <= 3 * UU * abs(truth)


def test_roots_are_within_their_bound() -> None:
    dice = np.random.default_rng(5)
    a = pairs(dice)
    at = np.nonzero(a[0] > 0)[0]
    a = a[0][at], a[1][at]
    found = dd.root(a)
    for i in range(len(at)):
        scaled = exact(a, i) * 4**400
        truth = Fraction(isqrt(int(scaled)), 2**400)
        assert abs(exact(found, i) - truth) <= 6 * UU * truth + Fraction(1, 2**390)


def test_forms_of_vectors_are_within_their_bounds() -> None:
    dice = np.random.default_rng(6)
    a, b = (tuple(pairs(dice, 100) for _ in range(3)) for _ in range(2))
    single = tuple(x[0] for x in b)
    for i in range(100):
        x, y = [exact(part, i) for part in a], [exact(part, i) for part in b]
        z = [Fraction(float(part[i])) for part in single]
        size = sum(abs(p * q) for p, q in zip(x, y, strict=True))
        truth = sum(p * q for p, q in zip(x, y, strict=True))
        assert abs(exact(dd.dot(a, b), i) - truth) <= 12 * UU * size
        truth = sum(p * q for p, q in zip(x, z, strict=True))
        assert abs(exact(dd.dot_scaled(a, single), i) - truth) <= 10 * UU * size
        truth, size = x[1] * y[2] - x[2] * y[1], abs(x[1] * y[2]) + abs(x[2] * y[1])
        assert abs(exact(dd.cross(a, b)[0], i) - truth) <= 9 * UU * size
        truth = x[1] * z[2] - x[2] * z[1]
        assert abs(exact(dd.cross_scaled(a, single)[0], i) - truth) <= 7 * UU * size
