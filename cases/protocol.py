"""The line protocol as data: the messages, and what is refused in them. No input or output here.

    -> {"hello": 1}
    <- {"hello": 1, "name": "my tracer", ...}
    -> {"id": "7", "solid": {...}, "ray": {...}}
    <- {"id": "7", "intervals": [[2.0, 4.0]]}

Each message is one line of JSON. The `id` is opaque to an implementation.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal

from raycert.cases.formats import BINARY64, FORMATS, SPELLINGS, Format, Spelling, parse, spell
from raycert.cases.lines import question
from raycert.cases.model import SOLIDS, Ray, Solid

VERSION = 1
Answers = Literal["intervals", "first", "any"]
ANSWERS: tuple[Answers, ...] = ("intervals", "first", "any")
FromInside = Literal["zero", "exit", "miss"]
FROM_INSIDE: tuple[FromInside, ...] = ("zero", "exit", "miss")
TOUCHES = ("tangent", "wall", "cap", "rim", "start")
"""The kinds of touch that a convention may keep or drop."""

Pairs = tuple[tuple[float, float], ...]


class BadLine(ValueError):
    """A line that is not the message it has to be; the text says what is wrong with it."""


@dataclass(frozen=True, slots=True)
class Hello:
    """What an implementation declares of itself. Everything but `name` has a default."""

    name: str
    version: str = ""
    answers: Answers = "intervals"
    solids: tuple[str, ...] = tuple(SOLIDS)
    precision: str = "binary64"
    convention: str = "closed"
    numbers: Spelling = "decimal"
    tolerance: float = 0.0
    from_inside: FromInside = "zero"

    @property
    def format(self) -> Format:
        """Return the number format of the declared precision."""
        return FORMATS[self.precision]


@dataclass(frozen=True, slots=True)
class Reply:
    """One answer. Exactly one of the fields but `id` is set (`first` may hold None: a miss)."""

    id: str
    intervals: Pairs | None = None
    first: float | None = None
    hit: bool | None = None
    unsupported: str | None = None
    error: str | None = None


def encode(message: dict[str, Any]) -> bytes:
    """Return the message as one line of ASCII JSON, newline included."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False).encode("ascii") + b"\n"


def decode(line: bytes) -> dict[str, Any]:
    """Return the JSON object on a line. Raises `BadLine` for anything else."""
    try:
        # What begins so is UTF-8; json asks the bytes of others for their encoding, at some cost.
        plain = line[:2] == b'{"'
        message = json.loads(line.decode("utf-8", "surrogatepass") if plain else line)
    except (ValueError, RecursionError) as error:
        raise BadLine(f"is not JSON ({error}): {_shown(line)}") from None
    if not isinstance(message, dict):
        raise BadLine(f"is not a JSON object: {_shown(line)}")
    return message


def _shown(line: bytes) -> str:
    text = line.decode("utf-8", "replace").rstrip("\n")
    return repr(text if len(text) <= 80 else text[:77] + "...")


def ask(id: str, solid: Solid, ray: Ray, spelling: Spelling, fmt: Format) -> bytes:
    """Return the line that asks one case."""
    return question(id, solid, ray, spelling, fmt)


def reply_intervals(id: str, pairs: Iterable[tuple[float, float]], hello: Hello) -> bytes:
    """Return the line that answers a case with an interval list."""
    spelled = [[spell(x, hello.numbers, hello.format) for x in pair] for pair in pairs]
    return encode({"id": id, "intervals": spelled})


def reply_first(id: str, t: float | None, hello: Hello) -> bytes:
    """Return the line that answers a case with the first hit, or with a miss (None)."""
    return encode({"id": id, "first": None if t is None else spell(t, hello.numbers, hello.format)})


def reply_hit(id: str, hit: bool) -> bytes:
    """Return the line that answers a case with whether there is a hit."""
    return encode({"id": id, "hit": hit})


def write_hello(hello: Hello) -> bytes:
    """Return the line that declares an implementation."""
    fields = {name: getattr(hello, name) for name in Hello.__slots__}
    return encode({"hello": VERSION, **fields, "solids": list(hello.solids)})


def read_hello(line: bytes) -> Hello:
    """Return the declaration on a line. Raises `BadLine` naming the field that is wrong."""
    try:
        return _hello(decode(line), line)
    except RecursionError:
        raise BadLine(f"is nested too deep: {_shown(line)}") from None


def _hello(message: dict[str, Any], line: bytes) -> Hello:
    if message.get("hello") != VERSION or message["hello"] is True:
        raise BadLine(
            f'hello is not {VERSION}: {_shown(line)}; expected {{"hello": 1, "name": ...}}'
        )
    known = {name: message[name] for name in Hello.__slots__ if name in message}
    for name in message:
        if name not in Hello.__slots__ and name != "hello":
            raise BadLine(f"hello.{name:.40} is not a field (fields: {', '.join(Hello.__slots__)})")
    if not isinstance(known.get("name"), str) or not known["name"]:
        raise BadLine("hello.name is missing or not a string")
    choices: dict[str, Iterable[str]] = {
        "answers": ANSWERS,
        "precision": FORMATS,
        "numbers": SPELLINGS,
        "from_inside": FROM_INSIDE,
    }
    for name, allowed in choices.items():
        if name in known and known[name] not in list(allowed):
            raise BadLine(f"hello.{name} is not one of {', '.join(allowed)}: {known[name]!r:.40}")
    if "solids" in known:
        known["solids"] = _solids(known["solids"])
    if "tolerance" in known:
        known["tolerance"] = _tolerance(known["tolerance"])
    for name in ("version", "convention"):
        if name in known and not isinstance(known[name], str):
            raise BadLine(f"hello.{name} is not a string: {known[name]!r:.40}")
    convention(known.get("convention", "closed"))
    return Hello(**known)


def _solids(value: object) -> tuple[str, ...]:
    if not isinstance(value, list) or not value:
        raise BadLine("hello.solids is not a list of one or more solid types")
    for kind in value:
        if not isinstance(kind, str) or kind not in SOLIDS:
            raise BadLine(
                f"hello.solids has an unknown type {kind!r:.40} (known: {', '.join(SOLIDS)})"
            )
    return tuple(value)


def _tolerance(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise BadLine(f"hello.tolerance is not a number: {value!r:.40}")
    if not 0 <= value <= BINARY64.largest:
        raise BadLine(f"hello.tolerance is not a finite number >= 0: {value!r:.40}")
    return float(value)


def convention(text: str) -> dict[str, bool]:
    """Return, for each kind of touch, whether a convention keeps it as a pair.

    `closed` keeps all, `regularized` drops all; `closed but tangent rim` and
    `regularized but start` name the kinds that go the other way.

    >>> convention("closed but rim")["rim"]
    False
    """
    base, _, others = text.partition(" but ")
    if base not in ("closed", "regularized"):
        raise BadLine(f"convention is not closed or regularized [but KIND ...]: {text!r:.60}")
    names = others.replace(",", " ").split()
    for name in names:
        if name not in TOUCHES:
            raise BadLine(
                f"convention names an unknown kind of touch: {name!r:.40} ({', '.join(TOUCHES)})"
            )
    return {kind: (base == "closed") != (kind in names) for kind in TOUCHES}


def read_reply(line: bytes, hello: Hello) -> Reply:
    """Return the answer on a line, numbers rounded to the client's precision.

    Raises `BadLine` where the line is not of the form that the hello promised. Whether the numbers
    make a well-formed list is for the judge.
    """
    message = decode(line)
    id = message.get("id")
    if not isinstance(id, str):
        raise BadLine(f"has no id (a string): {_shown(line)}")
    if "unsupported" in message:
        return Reply(id, unsupported=_reason(message["unsupported"], line))
    if "error" in message:
        return Reply(id, error=_reason(message["error"], line))
    if hello.answers == "intervals":
        return Reply(id, intervals=_pairs(message, hello, line))
    if hello.answers == "any":
        if not isinstance(message.get("hit"), bool):
            raise BadLine(f"has no hit (true or false): {_shown(line)}")
        return Reply(id, hit=message["hit"])
    if "first" not in message:
        raise BadLine(f"has no first (a number or null): {_shown(line)}")
    value = message["first"]
    return Reply(id, first=None if value is None else _number(value, hello, line))


def _reason(value: object, line: bytes) -> str:
    if not isinstance(value, str):
        raise BadLine(f"gives a reason that is not a string: {_shown(line)}")
    return value[:1000]


def _number(value: object, hello: Hello, line: bytes) -> float:
    fmt = hello.format
    try:
        read = parse(value, hello.numbers, fmt)
        return read if fmt is BINARY64 else fmt.nearest(read)
    except (ValueError, OverflowError, RecursionError) as error:
        raise BadLine(f"has a bad number ({error}): {_shown(line)}") from None


def _pairs(message: dict[str, Any], hello: Hello, line: bytes) -> Pairs:
    pairs = message.get("intervals")
    if not isinstance(pairs, list):
        raise BadLine(f"has no intervals (a list of pairs): {_shown(line)}")
    plain = hello.numbers == "decimal" and hello.precision == "binary64"
    read = []
    for pair in pairs:
        if not isinstance(pair, list) or len(pair) != 2:
            raise BadLine(f"has an interval that is not a pair of numbers: {_shown(line)}")
        a, b = pair
        if not (plain and type(a) is type(b) is float):  # those are what they are
            a, b = _number(a, hello, line), _number(b, hello, line)
        read.append((a, b))
    return tuple(read)
