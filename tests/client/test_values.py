"""Whatever code returns gets an outcome: the answer that it means, or a few words on what it is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.protocol import Hello, Reply
from raycert.oracle.client.process import Failure
from raycert.oracle.client.worker import outcome

MOST = 20
PLAIN = Hello("x")
FIRST, ANY = Hello("x", answers="first"), Hello("x", answers="any")
SINGLE = Hello("x", precision="binary32")


def given_back(value: object, hello: Hello = PLAIN) -> Reply | Failure:
    return outcome(lambda: value, hello, MOST)


@given(st.lists(st.tuples(st.floats(allow_nan=False), st.floats(allow_nan=False)), max_size=MOST))
def test_a_list_of_pairs_is_itself(pairs: list[tuple[float, float]]) -> None:
    for value in (pairs, tuple(pairs), iter(pairs), [list(pair) for pair in pairs]):
        assert given_back(value) == Reply("", intervals=tuple(pairs))


@pytest.mark.parametrize(
    ("value", "pairs"),
    [
        (np.array([[1.0, 2.0], [3.0, math.inf]]), ((1.0, 2.0), (3.0, math.inf))),
        (np.zeros((0, 2)), ()),
        ([(np.float32(0.5), np.int64(3))], ((0.5, 3.0),)),
        ([(Fraction(1, 2), Decimal(2))], ((0.5, 2.0),)),
        ([(1, None)], ((1.0, math.inf),)),
        ([(0, 10**400)], ((0.0, math.inf),)),
        ([(-(10**400), 0)], ((-math.inf, 0.0),)),
        ([iter((1.0, 2.0))], ((1.0, 2.0),)),
        ((pair for pair in [(1, 2)]), ((1.0, 2.0),)),
        ([(0.0, 0.0)] * MOST, ((0.0, 0.0),) * MOST),
    ],
)
def test_what_is_as_good_as_pairs(value: object, pairs: object) -> None:
    reply = given_back(value)
    assert reply == Reply("", intervals=pairs)  # type: ignore[arg-type]
    assert isinstance(reply, Reply)
    assert reply.intervals is not None
    assert all(type(end) is float for pair in reply.intervals for end in pair)


def test_nan_and_disorder_are_left_to_the_judge() -> None:
    reply = given_back([(math.nan, -1.0), (5.0, 2.0)])
    assert isinstance(reply, Reply)
    assert repr(reply.intervals) == "((nan, -1.0), (5.0, 2.0))"


def test_numbers_are_rounded_to_the_precision() -> None:
    assert given_back([(0.1, 1e39)], SINGLE) == Reply(
        "", intervals=((0.10000000149011612, math.inf),)
    )
    assert given_back(0.1, Hello("x", answers="first", precision="binary32")) == Reply(
        "", first=0.10000000149011612
    )


@pytest.mark.parametrize(
    ("value", "hello", "reply"),
    [
        (None, FIRST, Reply("", first=None)),
        (2, FIRST, Reply("", first=2.0)),
        (np.float64(2.5), FIRST, Reply("", first=2.5)),
        (True, ANY, Reply("", hit=True)),
        (np.bool_(False), ANY, Reply("", hit=False)),
    ],
)
def test_first_and_any(value: object, hello: Hello, reply: Reply) -> None:
    assert given_back(value, hello) == reply


class Awkward:
    def __repr__(self) -> str:
        raise RuntimeError("no repr")


class Liar:
    def __float__(self) -> float:
        return "1"  # type: ignore[return-value]


@pytest.mark.parametrize(
    ("value", "says", "hello"),
    [
        (None, "None, and not a list of pairs", PLAIN),
        (True, "True, and not a list", PLAIN),
        (2.5, "the float 2.5, and not a list", PLAIN),
        ("miss", "the str 'miss', and not a list", PLAIN),
        (b"", "the bytes b'', and not a list", PLAIN),
        ({}, "a dict, and not a list", PLAIN),
        (Awkward(), "a Awkward, and not a list", PLAIN),
        ([2.0, 4.0], "an interval that is the float 2.0", PLAIN),
        (["24"], "an interval that is the str '24'", PLAIN),
        ([{1, 2}], "an interval that is a set", PLAIN),
        ([(1.0,)], "has not two numbers: a tuple (1.0,)", PLAIN),
        ([(1.0, 2.0, 3.0)], "more than two numbers", PLAIN),
        ([(1.0, "2")], "the str '2' where a number has to be", PLAIN),
        ([(1.0, True)], "True where a number has to be", PLAIN),
        ([(1.0, 2j)], "a complex where a number has to be", PLAIN),
        ([(1.0, Awkward())], "a Awkward where a number has to be", PLAIN),
        ([(1.0, Liar())], "a Liar where a number has to be", PLAIN),
        ([(0, 1)] * (MOST + 1), "more pairs, and 20 is", PLAIN),
        ([(0, 1)] * 10**6, "more pairs, and 20 is", PLAIN),
        ("x" * 10**7, "and not a list", PLAIN),
        (1 << 3_321_928, "an integer of 3321929 bits, and not a list", PLAIN),
        ([(1 << 3_321_928, 1, 2)], "more than two numbers: a tuple", PLAIN),
        ([(1, 2)], "a list where a number has to be", FIRST),
        (False, "False where a number has to be", FIRST),
        (1, "the int 1, and not True or False", ANY),
        (None, "None, and not True or False", ANY),
        ([], "a list, and not True or False", ANY),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 60 else "",
)
def test_a_value_of_no_meaning_is_a_failure(value: object, says: str, hello: Hello) -> None:
    failure = given_back(value, hello)
    assert isinstance(failure, Failure)
    assert failure.kind == ("malformed" if "pairs, and" in says else "bad-line")
    assert says in failure.detail
    assert len(failure.detail) < 200


def endless() -> Iterator[tuple[float, float]]:
    while True:
        yield (1.0, 2.0)


def test_an_endless_list_ends() -> None:
    assert isinstance(given_back(endless()), Failure)


class Untold(Exception):
    def __str__(self) -> str:
        raise RuntimeError("no text")


def breaks() -> Iterator[tuple[float, float]]:
    yield (1.0, 2.0)
    raise ZeroDivisionError("float division by zero")


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (ValueError("no such thing"), "ValueError: no such thing"),
        (KeyError("radius"), "KeyError: 'radius'"),
        (RecursionError(), "RecursionError"),
        (Untold(), "Untold"),
        (ValueError("x" * 5000), "ValueError: " + "x" * 988 + "... (5012 characters)"),
    ],
)
def test_an_exception_is_the_reply_error(error: Exception, text: str) -> None:
    def call() -> Any:
        raise error

    assert outcome(call, PLAIN, MOST) == Reply("", error=text)
    assert outcome(breaks, PLAIN, MOST) == Reply(
        "", error="ZeroDivisionError: float division by zero"
    )


def test_what_is_not_implemented_is_unsupported() -> None:
    def call() -> Any:
        raise NotImplementedError("no caps")

    assert outcome(call, PLAIN, MOST) == Reply("", unsupported="NotImplementedError: no caps")
