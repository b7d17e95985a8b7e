"""Roundings and decimals of surds against their definition, checked by squaring in fractions."""

from __future__ import annotations

import struct
from decimal import ROUND_HALF_UP, Context, Decimal
from fractions import Fraction
from math import inf, isinf, isqrt, nextafter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64, FORMATS, Format
from raycert.oracle.exact.surd import (
    INFINITY,
    Rounded,
    Surd,
    decimal,
    enclose,
    exponent,
    floor_shifted,
    fraction,
)

both = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)
formats = st.sampled_from([BINARY64, BINARY32])
integers = st.one_of(st.integers(-9, 9), st.integers(-(2**70), 2**70))
naturals = st.one_of(st.integers(0, 12), st.integers(0, 2**70))


@st.composite
def surds(draw: st.DrawFn) -> Surd:
    """Return surds of every size that a format knows, and beyond."""
    power = draw(st.one_of(st.integers(-40, 40), st.integers(-1200, 1200)))
    up, down = 1 << max(power, 0), 1 << max(-power, 0)
    x, y = draw(integers) * up, draw(integers) * up
    return Surd(x, y, draw(naturals), draw(naturals.filter(bool)) * down)


def side(v: Surd, f: Fraction) -> int:
    """Return the sign of v - f, from the squares of y sqrt(d) and of f z - x."""
    left, right = Fraction(v.y * abs(v.y) * v.d), f * v.z - v.x
    right *= abs(right)
    return (left > right) - (left < right)


def following(x: float, fmt: Format) -> float:
    """Return the next number of the format above x."""
    if fmt is BINARY64:
        return nextafter(x, inf)
    if x == 0:
        return 2.0**-149
    (bits,) = struct.unpack(">i", struct.pack(">f", x))
    up: float = struct.unpack(">f", struct.pack(">i", bits + (1 if x > 0 else -1)))[0]
    return up


def midpoint(low: float, high: float, fmt: Format) -> Fraction:
    """Return the number halfway; infinity counts as 2^overflow."""
    bound = Fraction(2) ** fmt.overflow
    ends = [Fraction(x) if not isinf(x) else (bound if x > 0 else -bound) for x in (low, high)]
    return sum(ends, Fraction(0)) / 2


def is_even(x: float, fmt: Format) -> bool:
    """Tell whether the last bit of the pattern is 0, as it is for infinity."""
    return int(fmt.bits(x)[-1], 16) % 2 == 0


def assert_rounded(v: Surd, fmt: Format, got: Rounded) -> None:
    """Assert that the three numbers are what their names say, by definition."""
    assert all(fmt.holds(x) for x in (got.down, got.nearest, got.up))
    assert isinf(got.down) or side(v, Fraction(got.down)) >= 0
    assert isinf(got.up) or side(v, Fraction(got.up)) <= 0
    if got.down == got.up:
        assert side(v, Fraction(got.down)) == 0
        assert got.nearest == got.down
        return
    assert got.up == following(got.down, fmt)
    middle = side(v, midpoint(got.down, got.up, fmt))
    even = got.down if is_even(got.down, fmt) else got.up
    assert got.nearest == {-1: got.down, 0: even, 1: got.up}[middle]


@settings(max_examples=400)
@given(surds(), formats)
def test_enclose_is_rounding_by_definition(v: Surd, fmt: Format) -> None:
    assert_rounded(v, fmt, enclose(v, fmt))


@settings(max_examples=300)
@given(st.integers(-(2**80), 2**80), st.integers(1, 2**80), st.integers(-1150, 1150))
def test_nearest_of_a_fraction_is_what_python_divides(top: int, bottom: int, power: int) -> None:
    """CPython rounds the quotient of two integers correctly."""
    top, bottom = top << max(power, 0), bottom << max(-power, 0)
    try:
        truth = float(Fraction(top, bottom))
    except OverflowError:
        truth = inf if top > 0 else -inf
    assert enclose(fraction(top, bottom), BINARY64).nearest == truth


@given(surds(), formats)
def test_a_negative_number_mirrors_a_positive_one(v: Surd, fmt: Format) -> None:
    one, two = enclose(v, fmt), enclose(Surd(-v.x, -v.y, v.d, v.z), fmt)
    assert (two.down, two.nearest, two.up) == (-one.up, -one.nearest, -one.down)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_of_the_format_is_its_own_rounding(x: float) -> None:
    for fmt in FORMATS.values():
        number = fmt.nearest(x)
        if not isinf(number):
            v = fraction(*number.as_integer_ratio())
            assert enclose(v, fmt) == Rounded(number, number, number)


def test_zero_and_infinity() -> None:
    for fmt in FORMATS.values():
        assert enclose(fraction(0, 1), fmt) == Rounded(0.0, 0.0, 0.0)
        assert enclose(Surd(-3, 1, 9, 7), fmt) == Rounded(0.0, 0.0, 0.0)
        assert enclose(INFINITY, fmt) == Rounded(inf, inf, inf)


def ties(fmt: Format) -> list[Fraction]:
    """Return midpoints: below an even and an odd number, across a power of two, subnormal, last."""
    last = Fraction(2) ** (1 - fmt.precision)
    least = Fraction(2) ** fmt.least
    return [
        1 + last / 2,
        1 + 3 * last / 2,
        2 - last / 2,
        (1 + last / 2) * Fraction(2) ** 40,
        (1 + 5 * last / 2) * Fraction(2) ** -40,
        least / 2,
        least * 3 / 2,
        least * 5 / 2,
        least * (Fraction(2) ** (fmt.precision - 2) + Fraction(1, 2)),
        least * (Fraction(2) ** (fmt.precision - 1) - Fraction(1, 2)),
        midpoint(fmt.largest, inf, fmt),
    ]


def neighbours(tie: Fraction, fmt: Format) -> tuple[float, float]:
    """Return the numbers of the format that a midpoint lies between."""
    step = max(fmt.least, int(tie).bit_length() - fmt.precision)
    if tie < 1:
        step = max(fmt.least, 1 - (int(1 / tie)).bit_length() - fmt.precision)
    low = tie // Fraction(2) ** step * Fraction(2) ** step
    return float(low), following(float(low), fmt)


@both
def test_ties_go_to_even(fmt: Format) -> None:
    for tie in ties(fmt):
        down, up = neighbours(tie, fmt)
        assert midpoint(down, up, fmt) == tie
        got = enclose(fraction(*tie.as_integer_ratio()), fmt)
        assert got == Rounded(down, down if is_even(down, fmt) else up, up)


@both
def test_a_tie_moved_by_the_least_goes_the_way_it_moved(fmt: Format) -> None:
    """tie +- 2^-2j of its size, as a fraction and as an irrational: sqrt(tie^2 +- 2^-2j)."""
    for tie in ties(fmt):
        down, up = neighbours(tie, fmt)
        for j in range(1, 501):
            move = tie / 4**j
            between = move < tie - Fraction(down)
            for way, truth in ((1, up), (-1, down)):
                n, z = (tie * tie * (1 + Fraction(way, 4**j))).as_integer_ratio()
                for v in (
                    fraction(*(tie + way * move).as_integer_ratio()),
                    Surd(0, 1, n * z, z),
                ):
                    got = enclose(v, fmt)
                    if between:
                        assert got == Rounded(down, truth, up)
                    else:
                        assert_rounded(v, fmt, got)


@both
def test_a_moved_tie_behind_a_large_cancellation(fmt: Format) -> None:
    """x - y sqrt(d), both huge, for the same numbers: -N + sqrt((N + tie)^2 + 2^-2j)."""
    for tie in ties(fmt)[:4]:
        down, up = neighbours(tie, fmt)
        top, z = tie.as_integer_ratio()
        for j in range(fmt.precision, 501, 7):
            for way, truth in ((1, up), (-1, down)):
                far = z << 90
                square = ((far + top) ** 2 << 2 * j) + way * z * z
                v = Surd(-far << j, 1, square, z << j)
                assert enclose(v, fmt) == Rounded(down, truth, up)


@both
def test_overflow_is_that_of_ieee_754(fmt: Format) -> None:
    largest = Fraction(fmt.largest)
    edge = midpoint(fmt.largest, inf, fmt)
    tiny = Fraction(1, 2**400)
    for v, nearest in ((edge, inf), (edge - tiny, fmt.largest), (edge + tiny, inf)):
        got = enclose(fraction(*v.as_integer_ratio()), fmt)
        assert got == Rounded(fmt.largest, nearest, inf)
    for v in (largest * 2, 2 * edge, Fraction(2) ** 5000):
        assert enclose(fraction(*v.as_integer_ratio()), fmt) == Rounded(fmt.largest, inf, inf)
    power = Fraction(2) ** fmt.overflow
    assert enclose(fraction(int(power), 1), fmt) == Rounded(fmt.largest, inf, inf)
    assert enclose(fraction(-int(power), 1), fmt) == Rounded(-inf, -inf, -fmt.largest)


@both
def test_below_the_least_number(fmt: Format) -> None:
    least = 2.0**fmt.least
    for v, nearest in (
        (Fraction(least) / 2, 0.0),
        (Fraction(least) / 2 + Fraction(2) ** -3000, least),
        (Fraction(2) ** -5000, 0.0),
    ):
        assert enclose(fraction(*v.as_integer_ratio()), fmt) == Rounded(0.0, nearest, least)


@given(surds(), st.integers(-300, 300))
def test_floor_shifted_is_the_floor(v: Surd, shift: int) -> None:
    floor, exact = floor_shifted(v, shift)
    unit = Fraction(1, 2) ** shift if shift >= 0 else Fraction(2) ** -shift
    assert side(v, floor * unit) >= 0
    assert side(v, (floor + 1) * unit) < 0
    assert exact == (side(v, floor * unit) == 0)


@given(surds())
def test_exponent_is_within_three(v: Surd) -> None:
    if v.sign():
        e = exponent(v)
        size = v if v.sign() > 0 else Surd(-v.x, -v.y, v.d, v.z)
        assert side(size, Fraction(2) ** (e - 3)) > 0
        assert side(size, Fraction(2) ** (e + 3)) < 0


def digits_of(v: Surd, digits: int) -> Decimal:
    """Return v rounded half up to this many digits, by long division of ever more digits."""
    scale = 10 ** (2 * digits + 1000)
    root = isqrt(v.y * v.y * v.d * scale * scale) * (1 if v.y > 0 else -1)
    context = Context(prec=digits, rounding=ROUND_HALF_UP, Emax=10**6, Emin=-(10**6))
    return context.divide(Decimal(v.x * scale + root), Decimal(v.z * scale))


@settings(max_examples=200)
@given(surds(), st.integers(1, 60))
def test_decimal_digits_are_rounded_to_nearest(v: Surd, digits: int) -> None:
    text = decimal(v, digits)
    if v.sign() == 0:
        assert text == "0"
        return
    assert Decimal(text) == digits_of(v, digits)
    mantissa, _, power = text.partition("e")
    assert len(mantissa.lstrip("-").replace(".", "")) == digits
    assert power[0] in "+-"


@pytest.mark.parametrize(
    ("v", "text"),
    [
        (Surd(0, 1, 2, 1), "1.414213562e+0"),
        (fraction(999_999_999_95, 100), "1.000000000e+9"),
        (fraction(-1, 3), "-3.333333333e-1"),
        (fraction(10**400, 1), "1.000000000e+400"),
        (fraction(1, 10**400), "1.000000000e-400"),
        (INFINITY, "inf"),
    ],
)
def test_decimal_by_hand(v: Surd, text: str) -> None:
    assert decimal(v, 10) == text
