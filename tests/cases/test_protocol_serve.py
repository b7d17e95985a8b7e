"""The implementation's side: every line is answered, in order, flushed."""

from __future__ import annotations

import io
import json
import math
import subprocess
import sys
from collections.abc import Iterable, Iterator

import pytest

from raycert.cases.formats import FORMATS, SPELLINGS, Spelling
from raycert.cases.model import Cylinder, Ray, Solid
from raycert.cases.protocol import (
    LINE,
    FromInside,
    Hello,
    Pairs,
    Reply,
    answer,
    ask,
    lines_of,
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


HOSTILE = (
    b'{"id":NaN}',
    b'{"id":1e999}',
    b'{"id":[-Infinity,{"x":Infinity}]}',
    b'{"id":' + b"[" * 900 + b"]" * 900 + b"}",
    b'{"id":' + b"[" * 100_000,
    b'{"id":"7","solid":' + b'{"type":"union","of":[' * 300 + b"]}" * 300 + b"}",
    b'{"id":"7","solid":' + b'{"type":"union","of":[' * 5000 + b"]}" * 5000 + b"}",
    b'{"id":"7","solid":' + b"[" * 900 + b"]" * 900 + b"}",
    b'{"id":"7","solid":{"type":"sphere","center":[1e999,NaN,0],"radius":' + b"9" * 4000 + b"}}",
    b'{"id":"7","ray":' + b"9" * 100_000 + b"}",
    b'{"id":"7","solid":{"type":"sphere","center":[0,0,0],"radius":1,"' + b"x" * 90_000 + b'":1}}',
    b'{"id":"\\ud800","solid":"\\udfff"}',
    b'{"id":"\xed\xa0\x80","solid":1}',
    b'{"id":"7","solid":"' + b"x" * LINE + b'"}',
    b"\x00\xff\xfe",
    b"",
)
"""Lines that no question is."""


@pytest.mark.parametrize("name", ["oracle", "reference"])
def test_whatever_comes_is_answered_and_serving_goes_on(name: str):
    good = ask("good", CAN, ACROSS, "decimal", HELLO.format)
    text = b"".join(line + b"\n" + good for line in HOSTILE)
    command = [sys.executable, "-m", "raycert", "serve", name]
    served = subprocess.run(command, input=text, capture_output=True, check=True)
    answers = [json.loads(line) for line in served.stdout.splitlines()]
    assert answers[1::2] == [{"id": "good", "intervals": [[2.0, 4.0]]}] * len(HOSTILE)
    for line, message in zip(HOSTILE, answers[::2], strict=True):
        assert 0 < len(message["error"]) < 1200
        assert message.get("id") == ("7" if b'"7"' in line else message.get("id"))


class Flood(io.BytesIO):
    """A line of a gigabyte that is nowhere held, and one more."""

    left = 1 << 30

    def readline(self, size: int | None = -1, /) -> bytes:
        assert size is not None
        assert 0 < size <= LINE + 1
        if self.left <= 0:
            return super().readline(size)
        self.left -= size
        return b"x" * size if self.left > 0 else b"\n"


def test_a_line_of_a_gigabyte_is_refused_and_not_held():
    first, *others = lines_of(Flood(b"what\n"))
    assert others == [b"what\n"]
    assert len(first) == LINE + 1
    message = json.loads(answer(first, radius, HELLO))
    assert message["error"].startswith(f"the line has more than {LINE} bytes: 'xxx")


@pytest.mark.parametrize("end", [b"", b"\n"])
@pytest.mark.parametrize("length", [0, 1, 6, 7, 8, 15, 16, 17])
def test_lines_are_told_apart_at_the_limit(length: int, end: bytes):
    begin, body = b"before\n", b"x" * length
    text = begin + body + end + (b"after" if end else b"")
    whole = body + end if length <= 7 else body[:8]
    expected = [begin, whole, b"after" if end else b""]
    assert list(lines_of(io.BytesIO(text), 7)) == [line for line in expected if line]


def test_a_tracer_that_breaks_answers_the_next():
    def breaks(solid: Solid, ray: Ray) -> Pairs:
        raise ZeroDivisionError("x" * 5000)

    out = io.BytesIO()
    asked = ask("7", CAN, ACROSS, "decimal", HELLO.format)
    serve(breaks, HELLO, [asked, asked], out)
    errors = [read_reply(line, HELLO).error or "" for line in out.getvalue().splitlines()]
    assert [error.startswith("ZeroDivisionError: xxx") for error in errors] == [True, True]
    assert max(map(len, errors)) < 1100
