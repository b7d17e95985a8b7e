"""The implementation's side: every line is answered, in order, flushed."""

from __future__ import annotations

import io
import json
import math
from collections.abc import Iterable, Iterator

import pytest

from raycert.cases.formats import FORMATS, SPELLINGS, Spelling
from raycert.cases.model import Cylinder, Ray, Solid
from raycert.cases.protocol import (
    FromInside,
    Hello,
    Pairs,
    Reply,
    answer,
    ask,
    read_hello,
    read_reply,
    serve,
)

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
ACROSS = Ray((-3, 0, 1), (1, 0, 0))
HELLO = Hello("test")


def radius(solid: Solid, ray: Ray) -> Iterable[tuple[float, float]]:
    """Answer with numbers of the question, to see that they arrive."""
    assert isinstance(solid, Cylinder)
    return [(solid.radius, ray.direction[0] + 7)]


@pytest.mark.parametrize("numbers", SPELLINGS)
@pytest.mark.parametrize("precision", FORMATS)
def test_a_question_gets_its_answer(numbers: Spelling, precision: str):
    hello = Hello("test", numbers=numbers, precision=precision)
    asked = ask("some id", CAN, ACROSS, numbers, hello.format)
    reply = read_reply(answer(asked, radius, hello), hello)
    assert reply.id == "some id"
    assert reply.intervals == ((1.0, 8.0),)


def test_a_hello_gets_the_hello():
    hello = Hello("test", "3", solids=("slab",), precision="binary32", numbers="bits")
    assert read_hello(answer(b'{"hello": 1}\n', radius, hello)) == hello


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (b"what\n", "the line is not JSON"),
        (b"[]\n", "the line is not a JSON object"),
        (b'{"id": "7"}\n', "solid: is not an object"),
        (b'{"id": "7", "solid": {"type": "cone"}}\n', "solid.type: is not one of"),
    ],
)
def test_a_line_that_cannot_be_answered_gets_an_error(text: bytes, says: str):
    message = json.loads(answer(text, radius, HELLO))
    assert says in message["error"]
    assert message.get("id") == ("7" if b"id" in text else None)


def test_a_refusal_names_the_field():
    asked = ask("7", CAN, ACROSS, "decimal", HELLO.format).replace(b'"radius":1.0', b'"radius":-1')
    assert (
        read_reply(answer(asked, radius, HELLO), HELLO).error == "solid.radius: is negative: -1.0"
    )


@pytest.mark.parametrize("numbers", SPELLINGS)
@pytest.mark.parametrize("pair", [(math.nan, 1.0), (1.0, math.nan)])
def test_an_answer_with_nan_is_an_error(numbers: Spelling, pair: tuple[float, float]):
    hello = Hello("test", numbers=numbers)
    asked = ask("7", CAN, ACROSS, numbers, hello.format)
    reply = read_reply(answer(asked, lambda *_: [pair], hello), hello)
    assert reply.error is not None
    assert "holds NaN: ((" in reply.error


@pytest.mark.parametrize("numbers", SPELLINGS)
@pytest.mark.parametrize(
    ("mode", "pairs", "t"),
    [
        ("zero", [(2.0, 4.0)], 2.0),
        ("zero", [(0.0, 4.0)], 0.0),
        ("exit", [(0.0, 4.0)], 4.0),
        ("exit", [(0.0, math.inf)], None),
        ("miss", [(0.0, 4.0), (5.0, 6.0)], None),
        ("miss", [], None),
    ],
)
def test_a_first_hit_is_served(numbers: Spelling, mode: FromInside, pairs: Pairs, t: float | None):
    hello = Hello("test", answers="first", from_inside=mode, numbers=numbers)
    asked = ask("7", CAN, ACROSS, numbers, hello.format)
    assert read_reply(answer(asked, lambda *_: iter(pairs), hello), hello) == Reply("7", first=t)


@pytest.mark.parametrize("pairs", [[], [(1.0, 1.0)]])
def test_whether_there_is_a_hit_is_served(pairs: Pairs):
    hello = Hello("test", answers="any")
    asked = ask("7", CAN, ACROSS, "decimal", hello.format)
    reply = read_reply(answer(asked, lambda *_: pairs, hello), hello)
    assert reply == Reply("7", hit=bool(pairs))


class Watched(io.BytesIO):
    """A stream that remembers what had been flushed."""

    flushed = 0

    def flush(self) -> None:
        self.flushed = len(self.getvalue())


def test_every_line_is_answered_in_order_before_the_next_is_read():
    out = Watched()

    def lines() -> Iterator[bytes]:
        yield b'{"hello": 1}\n'
        for n in range(20):
            assert out.getvalue().count(b"\n") == n + 1
            assert out.flushed == len(out.getvalue())
            yield ask(str(n), CAN, ACROSS, "decimal", HELLO.format)

    serve(radius, HELLO, lines(), out)
    hello, *answers = out.getvalue().splitlines()
    assert read_hello(hello) == HELLO
    assert [read_reply(text, HELLO).id for text in answers] == [str(n) for n in range(20)]
