"""Order, equality and the views of `exact.surd`, against mpmath and constructed equalities."""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import pairwise
from math import gcd, inf, isqrt, nan, ulp

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, dyadic, fraction, sign, sign_1, sign_2

BITS = 64
PRECISION = 6000
"""Two surds of integers below 2^64 that differ do so by more than 2^-700: over the denominators
z z' < 2^128, the product of the four conjugates of their difference is an integer other than 0, and
each of them is below 2^163. What is below 2^-3000 at this precision is therefore zero."""
SETTLED = mpf(2) ** -3000

small = st.integers(-6, 6)
large = st.integers(-(2**BITS) + 1, 2**BITS - 1)
numbers = st.one_of(small, small, large)
naturals = st.one_of(st.integers(0, 12), st.integers(0, 2**BITS - 1))
positives = st.one_of(st.integers(1, 6), st.integers(1, 2**BITS - 1))
surds = st.builds(Surd, numbers, numbers, naturals, positives)
anything = st.one_of(surds, surds, st.just(INFINITY))
coefficients = st.tuples(st.integers(-30, 30), st.integers(-30, 30), st.integers(-30, 30))


def value(v: Surd) -> mpf:
    """Return the number a surd is, to PRECISION bits."""
    with mp.workprec(PRECISION):
        return (v.x + v.y * mp.sqrt(v.d)) / v.z if v.z else mpf(inf)


def settled_sign(number: mpf) -> int:
    return 0 if abs(number) < SETTLED else (1 if number > 0 else -1)


def truth(a: Surd, b: Surd) -> int:
    """Return the sign of a - b as mpmath finds it."""
    if not (a.z and b.z):
        return bool(b.z) - bool(a.z)
    with mp.workprec(PRECISION):
        return settled_sign(value(a) - value(b))


def rewritten(v: Surd, times: int, square: int) -> Surd:
    """Return the same number with other integers: `times` cancels, `square` leaves the root."""
    return Surd(v.x * times * square, v.y * times, v.d * square * square, v.z * times * square)


@given(anything, anything)
def test_order_is_that_of_the_numbers(a: Surd, b: Surd) -> None:
    assert a.compare(b) == truth(a, b)
    assert b.compare(a) == -truth(a, b)
    assert (a < b, a == b, a > b) == (truth(a, b) < 0, truth(a, b) == 0, truth(a, b) > 0)
    assert (a <= b, a >= b, a != b) == (truth(a, b) <= 0, truth(a, b) >= 0, truth(a, b) != 0)


@given(numbers, numbers, numbers, numbers, naturals, naturals)
def test_order_within_one_field(x: int, y: int, x2: int, y2: int, d: int, z: int) -> None:
    a, b = Surd(x, y, d, z + 1), Surd(x2, y2, d, 3)
    assert a.compare(b) == truth(a, b)


@given(st.lists(anything, max_size=8))
def test_sorting_agrees_with_the_numbers(many: list[Surd]) -> None:
    ordered = sorted(many)
    assert all(truth(a, b) <= 0 for a, b in pairwise(ordered))


@given(anything, st.integers(1, 50), st.integers(1, 50))
def test_a_number_equals_itself_in_every_representation(v: Surd, times: int, square: int) -> None:
    again = rewritten(v, times, square) if v.finite else v
    assert again == v
    assert hash(again) == hash(v)
    assert again.polynomial() == v.polynomial()
    assert again.root() == v.root()
    assert again.rational() == v.rational()
    assert len({v, again}) == 1


@given(numbers, small, st.integers(0, 2**20), positives)
def test_a_square_under_the_root_is_rational(x: int, y: int, root: int, z: int) -> None:
    v = Surd(x, y, root * root, z)
    assert v.rational() == Fraction(x + y * root, z)
    assert v == fraction(x + y * root, z)
    assert hash(v) == hash(fraction(x + y * root, z))


@given(coefficients, st.integers(1, 99))
def test_proportional_polynomials_have_equal_roots(abc: tuple[int, int, int], k: int) -> None:
    a, b, c = abc
    disc = b * b - a * c
    if a <= 0 or disc < 0:
        return
    for y in (-1, 1):
        one, two = Surd(-b, y, disc, a), Surd(-k * b, y, k * k * disc, k * a)
        assert one == two
        assert hash(one) == hash(two)


@given(st.integers(-9, 9), st.integers(1, 9), small, small)
def test_a_shared_rational_root_is_equal_across_polynomials(
    top: int, bottom: int, other: int, another: int
) -> None:
    shared = Fraction(top, bottom)
    found = []
    for second in (other, another):  # (bottom t - top)(t - second)
        half, product = bottom * second + top, top * second
        disc = half * half - 4 * bottom * product
        found.append(Surd(half, 1 if shared >= second else -1, disc, 2 * bottom))
    assert found[0] == found[1] == fraction(top, bottom)
    assert hash(found[0]) == hash(found[1]) == hash(fraction(top, bottom))


@given(surds)
def test_conjugates_differ_unless_the_root_vanishes(v: Surd) -> None:
    conjugate = Surd(v.x, -v.y, v.d, v.z)
    assert (v == conjugate) == (v.y * v.d == 0)
    assert v.compare(conjugate) == sign(v.y * v.d)
    if v.rational() is None:
        assert v.polynomial() == conjugate.polynomial()
        assert {v.root(), conjugate.root()} == {0, 1}


@pytest.mark.parametrize("steps", [1, 5, 40, 200])
def test_convergents_close_in_on_the_square_root_of_2(steps: int) -> None:
    """p/q alternates around sqrt(2), at a distance below 1/q^2: no fixed precision tells."""
    p, q = 1, 1
    for _ in range(steps):
        p, q = p + 2 * q, p + q
    assert fraction(p, q).compare(Surd(0, 1, 2, 1)) == sign(p * p - 2 * q * q)
    assert fraction(p, q) != Surd(0, 1, 2, 1)


def test_close_numbers_of_different_fields_are_told_apart() -> None:
    """sqrt(n^2 + 1) - sqrt(n^2 - 1) is about 1/n; both are irrational."""
    n = 10**300
    assert Surd(0, 1, n * n + 1, 1) > Surd(0, 1, n * n - 1, 1)
    assert Surd(-n, 1, n * n + 1, 1) < Surd(n, -1, n * n - 1, 1)


@given(surds)
def test_infinity_is_above_every_number_and_equals_itself(v: Surd) -> None:
    assert v < INFINITY
    assert not v > INFINITY
    assert INFINITY.compare(Surd(1, 0, 0, 0)) == 0
    assert (INFINITY.finite, INFINITY.polynomial(), INFINITY.rational()) == (False, (), None)
    assert INFINITY.sign() == 1


@given(surds)
def test_sign_is_that_of_the_number(v: Surd) -> None:
    assert v.sign() == truth(v, ZERO) == v.compare(ZERO)


@given(surds)
def test_a_number_is_the_named_root_of_its_polynomial(v: Surd) -> None:
    polynomial = v.polynomial()
    assert polynomial[0] > 0
    assert gcd(*polynomial) == 1
    with mp.workprec(PRECISION):
        residue = sum(c * value(v) ** i for i, c in enumerate(reversed(polynomial)))
        assert settled_sign(residue / polynomial[0]) == 0
        if len(polynomial) == 3:
            a, b, c = polynomial
            disc = b * b - 4 * a * c
            assert isqrt(disc) ** 2 != disc, "reducible"
            assert v.root() == (value(v) > mpf(-b) / (2 * a))
        else:
            assert v.root() == 0


@given(st.builds(Surd, small, small, st.integers(0, 12), st.integers(1, 6)), coefficients)
def test_evaluate_gives_the_sign_of_a_polynomial(v: Surd, abc: tuple[int, int, int]) -> None:
    a, b, c = abc
    with mp.workprec(PRECISION):
        t = value(v)
        assert v.evaluate(a, b, c) == settled_sign(a * t * t + b * t + c)
    if len(v.polynomial()) == 3:
        assert v.evaluate(*v.polynomial()) == 0


@given(numbers, numbers, naturals, numbers, naturals)
def test_signs_of_sums_of_roots(a: int, b: int, d: int, c: int, e: int) -> None:
    with mp.workprec(PRECISION):
        one = a + b * mp.sqrt(d)
        assert sign_1(a, b, d) == settled_sign(one)
        assert sign_2(a, b, d, c, e) == settled_sign(one + c * mp.sqrt(e))


@pytest.mark.parametrize(("d", "k", "e"), [(8, 2, 2), (18, 3, 2), (12, 2, 3), (36, 2, 9)])
def test_roots_of_different_radicands_cancel_exactly(d: int, k: int, e: int) -> None:
    """sqrt(8) - 2 sqrt(2) = 0 and the like: found zero, not small."""
    assert sign_2(0, 1, d, -k, e) == 0
    assert sign_2(1, 10**50, d, -k * 10**50, e) == 1
    assert sign_2(-1, 10**50, d, -k * 10**50, e) == -1


@given(st.integers(-99, 99), st.integers(-99, 99).filter(bool))
def test_a_fraction_may_have_a_negative_denominator(top: int, bottom: int) -> None:
    assert fraction(top, bottom).rational() == Fraction(top, bottom)
    assert fraction(top, bottom).z > 0


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_float_is_exactly_the_number_it_is(x: float) -> None:
    assert dyadic(x).rational() == Fraction(x)


def test_floats_that_are_no_numbers() -> None:
    assert dyadic(inf) == INFINITY
    with pytest.raises(ValueError, match="NaN"):
        dyadic(nan)
    with pytest.raises(OverflowError):
        dyadic(-inf)
    assert ZERO != "0"


@given(anything, st.integers() | st.fractions() | st.floats(allow_nan=False))
def test_other_numbers_compare_as_exactly_what_they_are(a: Surd, b: int | Fraction | float) -> None:
    if b == -inf:
        assert a > b
        assert a != b
        return
    other = dyadic(b) if isinstance(b, float) else fraction(b.numerator, b.denominator)
    assert (a < b, a <= b, a == b, a >= b, a > b) == (
        a < other, a <= other, a == other, a >= other, a > other
    )  # fmt: skip
    assert (b < a, b <= a, b == a, b >= a, b > a) == (a > b, a >= b, a == b, a <= b, a < b)
    assert hash(other) == hash(b)


def test_numbers_of_numpy_compare_and_nan_has_no_place() -> None:
    np = pytest.importorskip("numpy")
    root = Surd(0, 1, 2)
    assert root > np.float32(1.4142135)
    assert root < np.float64(1.4142135623730951)
    assert Surd(3) == np.int64(3) == Surd(6, z=2)
    assert Surd(2**70) > np.int64(2**62)
    assert not root < nan
    assert not root > nan
    assert root != nan
    assert root != "1"
    with pytest.raises(TypeError):
        assert root < "1"  # type: ignore[operator]


@given(surds)
def test_float_is_the_nearest_number(v: Surd) -> None:
    near = float(v)
    with mp.workprec(PRECISION):
        assert abs(value(v) - near) <= mpf(ulp(near)) / 2


@given(anything)
def test_what_is_shown_can_be_pasted_back(v: Surd) -> None:
    assert eval(repr(v), {"Surd": Surd, "INFINITY": INFINITY}) == v


@given(surds)
def test_the_closed_form_is_the_number(v: Surd) -> None:
    with mp.workprec(PRECISION):
        form = re.sub(r"(\d+)", r"mpf(\1)", str(v))
        assert not settled_sign(eval(form, {"sqrt": mp.sqrt, "mpf": mpf}) - value(v))


@pytest.mark.parametrize(
    ("number", "form"),
    [
        (Surd(4, z=2), "2"),
        (Surd(-2, z=6), "-1/3"),
        (Surd(0, 1, 8, 4), "sqrt(2)/2"),
        (Surd(0, -3, 2, 1), "-3*sqrt(2)"),
        (Surd(6, -2, 5, 4), "(3 - sqrt(5))/2"),
        (INFINITY, "inf"),
    ],
)
def test_closed_forms_are_in_lowest_terms(number: Surd, form: str) -> None:
    assert str(number) == f"{number}" == form


@pytest.mark.parametrize(
    ("number", "spec", "text"),
    [
        (Surd(0, 1, 2), ".40", "1.414213562373095048801688724209698078570"),
        (Surd(1, z=3), ".5", "0.33333"),
        (Surd(-1, z=8), ".40", "-0.125"),
        (Surd(2), ".40", "2"),
        (Surd(0), ".40", "0"),
        (Surd(12345, z=1000), ".3", "12.3"),
        (Surd(10**50), ".3", "1e+50"),
        (Surd(123 * 10**50), ".2", "1.2e+52"),
        (Surd(0, 1, 2, 10**9), ".3", "1.41e-09"),
        (Surd(1, z=10000), ".3", "0.0001"),
        (Surd(99999), ".3", "1e+05"),
        (Surd(0, 1, 2), ".3f", "1.414"),
        (INFINITY, ".40", "inf"),
    ],
)
def test_digits_are_shown_as_python_shows_them(number: Surd, spec: str, text: str) -> None:
    assert format(number, spec) == text
