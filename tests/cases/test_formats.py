"""Numbers and their spellings: bit for bit there and back, and nothing else is read."""

from __future__ import annotations

import json
import math
import struct
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import (
    BINARY32,
    BINARY64,
    FORMATS,
    SPELLINGS,
    Format,
    Spelling,
    parse,
    spell,
)

QUICK = settings(deadline=None, max_examples=60)
BOTH = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)
EACH = pytest.mark.parametrize("spelling", SPELLINGS)
DOUBLES = st.floats(allow_nan=False)
SINGLES = st.floats(allow_nan=False, width=32)


def numbers(fmt: Format) -> st.SearchStrategy[float]:
    return DOUBLES if fmt is BINARY64 else SINGLES


def same(a: float, b: float) -> bool:
    """Tell bit-for-bit equality."""
    return struct.pack(">d", a) == struct.pack(">d", b)


@BOTH
@EACH
@QUICK
@given(data=st.data())
def test_a_number_survives_its_spelling_and_json(
    fmt: Format, spelling: Spelling, data: st.DataObject
):
    number = data.draw(numbers(fmt))
    text = json.dumps(spell(number, spelling, fmt), allow_nan=False)
    back = parse(json.loads(text), spelling, fmt)
    assert same(back, abs(number) if math.isinf(number) else number)


@QUICK
@given(st.floats())
def test_nearest_is_what_the_machine_rounds_to(number: float):
    assert same(BINARY64.nearest(number), number) or math.isnan(number)
    single = BINARY32.nearest(number)
    if math.isnan(number):
        assert math.isnan(single)
    else:
        assert BINARY32.holds(single)
        assert BINARY32.holds(number) == (single == number)


@pytest.mark.parametrize(
    ("number", "single"),
    [
        (1 + 2.0**-24, 1.0),
        (1 + 3 * 2.0**-24, 1 + 2.0**-22),
        (2.0**-150, 0.0),
        (2.0**-150 * (1 + 2.0**-52), 2.0**-149),
        (BINARY32.largest + 2.0**102, BINARY32.largest),
        (BINARY32.largest + 2.0**103, math.inf),
        (-1e300, -math.inf),
        (-math.inf, -math.inf),
    ],
)
def test_ties_subnormals_and_overflow_of_binary32(number: float, single: float):
    assert same(BINARY32.nearest(number), single)


@BOTH
def test_the_constants_describe_the_format(fmt: Format):
    assert fmt.holds(fmt.largest)
    ulp = Fraction(2) ** (fmt.overflow - fmt.precision)
    assert Fraction(fmt.largest) + ulp == Fraction(2) ** fmt.overflow
    assert fmt.holds(math.ldexp(1.0, fmt.least))
    assert fmt.nearest(math.ldexp(1.0, fmt.least) / 2) == 0
    assert not fmt.holds(math.nan)
    assert fmt.holds(math.inf)
    assert FORMATS[fmt.name] is fmt


@pytest.mark.parametrize(
    ("number", "bits64", "bits32"),
    [
        (1.0, "3ff0000000000000", "3f800000"),
        (-2.0, "c000000000000000", "c0000000"),
        (0.0, "0000000000000000", "00000000"),
        (-0.0, "8000000000000000", "80000000"),
    ],
)
def test_bit_patterns_are_most_significant_first(number: float, bits64: str, bits32: str):
    assert BINARY64.bits(number) == bits64
    assert BINARY32.bits(number) == bits32
    assert same(BINARY64.from_bits(bits64), number)
    assert same(BINARY32.from_bits(bits32.upper()), number)
    assert (BINARY64.digits, BINARY32.digits) == (16, 8)


@EACH
@pytest.mark.parametrize("value", [None, "inf", "Infinity"])
def test_infinity_is_read_in_its_three_ways(spelling: Spelling, value: object):
    assert parse(value, spelling) == math.inf
    assert spell(math.inf, spelling) is None


def test_decimals_beyond_the_format_are_infinite():
    assert parse(10**400, "decimal") == math.inf
    assert parse(-(10**400), "decimal") == -math.inf
    assert parse(1e39, "decimal", BINARY32) == math.inf
    assert parse(0.1, "decimal", BINARY32) == BINARY32.nearest(0.1) != 0.1
    assert math.isnan(parse(math.nan, "decimal"))


@pytest.mark.parametrize(
    ("value", "spelling"),
    [
        *[(value, spelling) for spelling in SPELLINGS for value in (True, False, [], {}, [1.0])],
        ("1.0", "decimal"),
        ("0x1p0", "decimal"),
        (1.0, "hex"),
        (1, "bits"),
        ("", "hex"),
        ("one", "hex"),
        ("", "bits"),
        ("3ff", "bits"),
        ("3ff000000000000g", "bits"),
        ("3ff00000000000000", "bits"),
        ("3ff0 0000 0000  ", "bits"),
        ("3f800000", "bits"),
    ],
)
def test_anything_else_is_a_value_error(value: object, spelling: Spelling):
    with pytest.raises(ValueError, match=r"is not|has not|invalid|non-hexadecimal"):
        parse(value, spelling)


def test_a_hex_float_beyond_binary64_is_an_overflow():
    with pytest.raises(OverflowError):
        parse("0x1p2000", "hex")
