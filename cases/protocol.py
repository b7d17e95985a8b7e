"""The line protocol: its messages, what is refused in them, and the implementation's side of it.

    -> {"hello": 1}
    <- {"hello": 1, "name": "my tracer", ...}
    -> {"id": "7", "solid": {...}, "ray": {...}}
    <- {"id": "7", "intervals": [[2.0, 4.0]]}

Each message is one line of JSON. The `id` is opaque to an implementation, which brings a function
`intersect(solid, ray) -> pairs of floats` for `serve` to answer with. Where its hello promises the
first hit or a truth value, that is what the list says of it: lists are sorted and disjoint, and a
start inside, or on the boundary, shows as a first interval that begins at 0.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from math import inf, isinf, isnan
from typing import Any, BinaryIO, Literal, TypeVar

from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.domain import EVERYWHERE, EXACT, Domain, Tolerance, read_domain, read_tolerance
from raycert.cases.formats import BINARY64, FORMATS, SPELLINGS, Format, Spelling, parse, spell
from raycert.cases.forms import question, read_ray, read_solid
from raycert.cases.model import SOLIDS, Ray, Refused, Solid, leaves, real

VERSION = 1
Answers = Literal["intervals", "first", "any"]
ANSWERS: tuple[Answers, ...] = ("intervals", "first", "any")
FromInside = Literal["zero", "exit", "miss"]
FROM_INSIDE: tuple[FromInside, ...] = ("zero", "exit", "miss")
REPLIES: dict[Answers, str] = {
    "intervals": '{"id": ..., "intervals": [[enter, leave], ...]}',
    "first": '{"id": ..., "first": t or null}',
    "any": '{"id": ..., "hit": true or false}',
}
"""The form of a reply by what the hello says."""
CHOICES: dict[str, Iterable[str]] = {
    "answers": ANSWERS, "precision": FORMATS, "numbers": SPELLINGS, "from_inside": FROM_INSIDE,
}  # fmt: skip
"""The fields of a hello that are one of some words."""
TOUCHES = ("tangent", "wall", "cap", "rim", "start")
"""The kinds of touch that a convention may keep or drop."""

Pairs = tuple[tuple[float, float], ...]
Intersect = Callable[[Solid, Ray], Iterable[tuple[float, float]]]
T = TypeVar("T", bound=float)
WORDS = 1000
"""Characters of a text of others that are kept: a reason, an exception, a name."""
HEAD = rb'\s*\{\s*"id"\s*:\s*"(?P<id>[^"\\]*)"'
"""How a line begins that is a question or an answer, as nearly everybody writes it."""
LINE = 1 << 20
"""No line has more bytes."""
LONG = 4096
"""A line of more bytes is looked at for its pairs before it is read."""
ask = question
"""The line that asks one case."""


class BadLine(ValueError):
    """A line that is not the message it has to be; the text says what is wrong with it."""


class TooMany(BadLine):
    """An answer, to the question `id`, of more pairs than one may have; the others are good."""

    def __init__(self, id: str, most: int) -> None:
        super().__init__(f"has more than {most} pairs, and {most} is the most for this solid")
        self.id = id


def most_pairs(solid: Solid) -> int:
    """Return how many pairs an answer may have; one with more is malformed, and is not read.

    The right list has at most one for each leaf. The rest is room for what is wrong and worth
    showing, so that nobody's answers take more memory, time or paper than their questions deserve.
    """
    return 16 + 4 * sum(1 for _ in leaves(solid))


def cut(text: str, most: int = WORDS) -> str:
    """Return a text of others as far as it is kept; what is cut says so.

    >>> cut("abcdef", 4)
    'abcd... (6 characters)'
    """
    return text if len(text) <= most else f"{text[:most]}... ({len(text)} characters)"


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
    tolerance: Tolerance = EXACT
    from_inside: FromInside = "zero"
    domain: Domain = EVERYWHERE
    degenerate: tuple[str, ...] = ()
    infinity: float | None = None

    @property
    def format(self) -> Format:
        return FORMATS[self.precision]

    def form(self) -> dict[str, Any]:
        """Return the fields as JSON has them."""
        form = {name: getattr(self, name) for name in Hello.__slots__}
        form |= {name: list(form[name]) for name in ("solids", "degenerate")}
        return form | {name: form[name].form() for name in ("tolerance", "domain")}

    def but(self, fields: dict[str, Any]) -> Hello:
        """Return the same with some fields as a JSON object has them. Raises `BadLine`."""
        return read_fields(self.form() | fields)


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


def reply_intervals(id: str, pairs: Iterable[tuple[float, float]], hello: Hello) -> bytes:
    spelled = [[spell(x, hello.numbers, hello.format) for x in pair] for pair in pairs]
    return encode({"id": id, "intervals": spelled})


def reply_first(id: str, t: float | None, hello: Hello) -> bytes:
    """Return the line that answers a case with the first hit, or with a miss (None)."""
    return encode({"id": id, "first": None if t is None else spell(t, hello.numbers, hello.format)})


def reply_hit(id: str, hit: bool) -> bytes:
    return encode({"id": id, "hit": hit})


def write_hello(hello: Hello) -> bytes:
    return encode({"hello": VERSION, **hello.form()})


def read_hello(line: bytes) -> Hello:
    """Return the declaration on a line. Raises `BadLine` naming the field that is wrong."""
    try:
        message = decode(line)
        if message.get("hello") != VERSION or message["hello"] is True:
            expected = '{"hello": 1, "name": ...}'
            raise BadLine(f"hello is not {VERSION}: {_shown(line)}; expected {expected}")
        return read_fields({name: message[name] for name in message if name != "hello"})
    except RecursionError:
        raise BadLine(f"is nested too deep: {_shown(line)}") from None


def read_fields(form: dict[str, Any]) -> Hello:
    """Return the hello of which these are the fields. Raises `BadLine` naming what is wrong."""
    for name in form:
        if name not in Hello.__slots__:
            from raycert.cases.hints import near

            meant = near(name, Hello.__slots__) or f"fields: {', '.join(Hello.__slots__)}"
            raise BadLine(f"hello.{name:.40} is not a field ({meant})")
    if not isinstance(form.get("name"), str) or not form["name"]:
        raise BadLine("hello.name is missing or not a string")
    for name, allowed in CHOICES.items():
        if name in form and form[name] not in list(allowed):
            raise BadLine(f"hello.{name} is not one of {', '.join(allowed)}: {form[name]!r:.40}")
    for name in ("name", "version", "convention"):
        if not isinstance(form.get(name, ""), str):
            raise BadLine(f"hello.{name} is not a string: {form[name]!r:.40}")
        if len(form.get(name, "")) > WORDS:
            raise BadLine(f"hello.{name} has more than {WORDS} characters: {form[name]!r:.40}")
    convention(form.get("convention", "closed"))
    try:
        return Hello(**form | {name: READ[name](form[name]) for name in READ if name in form})
    except Refused as refusal:
        raise BadLine(f"hello.{refusal.path} {refusal.reason}") from None


def _solids(value: object) -> tuple[str, ...]:
    if not isinstance(value, list | tuple) or not value:
        raise BadLine("hello.solids is not a list of one or more solid types")
    for kind in value:
        if not isinstance(kind, str) or kind not in SOLIDS:
            known = ", ".join(SOLIDS)
            raise BadLine(f"hello.solids has an unknown type {kind!r:.40} (known: {known})")
    return tuple(dict.fromkeys(value))


def _degenerate(value: object) -> tuple[str, ...]:
    if not isinstance(value, list | tuple) or not all(kind in DEGENERACIES for kind in value):
        raise Refused("degenerate", f"is not a list of {', '.join(DEGENERACIES)}: {value!r:.40}")
    return tuple(kind for kind in DEGENERACIES if kind in value)


def _infinity(value: object) -> float | None:
    if value is None:
        return None
    number = real(value, "infinity")
    if not number > 0:
        raise Refused("infinity", f"is not a number > 0: {value!r:.40}")
    return number


READ: dict[str, Callable[[object], Any]] = {
    "solids": _solids, "tolerance": read_tolerance, "domain": read_domain,
    "degenerate": _degenerate, "infinity": _infinity,
}  # fmt: skip
"""The fields of a hello that are more than a word."""


def convention(text: str) -> dict[str, bool | None]:
    """Return, for each kind of touch, whether a convention keeps it as a pair; None for either.

    `closed` keeps all, `regularized` drops all, `any` does as it likes; `closed but tangent rim`
    and `regularized but start` name the kinds that go the other way, `closed but rim any tangent`
    after that those that may go either way.

    >>> convention("closed but rim")["rim"]
    False
    """
    base, _, others = text.partition(" but ")
    if text == "any":
        return dict.fromkeys(TOUCHES)
    if base not in ("closed", "regularized"):
        form = "any, closed or regularized [but KIND ... any KIND ...]"
        raise BadLine(f"convention is not {form}: {text!r:.60}")
    others, _, free = f" {others.replace(',', ' ')} ".partition(" any ")
    names = [*others.split(), *free.split()]
    for name in names:
        if name not in TOUCHES:
            known = ", ".join(TOUCHES)
            raise BadLine(f"convention names an unknown kind of touch: {name!r:.40} ({known})")
    keeps: dict[str, bool | None] = {
        kind: (base == "closed") != (kind in names) for kind in TOUCHES
    }
    return keeps | dict.fromkeys(free.split())


def read_reply(line: bytes, hello: Hello, most: float = inf) -> Reply:
    """Return the answer on a line, numbers rounded to the client's precision.

    Raises `BadLine` where the line is not of the form that the hello promised, and `TooMany` where
    only its pairs are too many. Whether the numbers make a well-formed list is for the judge.
    """
    if len(line) > LONG and most < inf and (flood := _more_pairs_than(int(most)).match(line)):
        raise TooMany(flood["id"].decode("utf-8", "replace"), int(most))
    message = decode(line)
    id = message.get("id")
    if not isinstance(id, str):
        raise _formless("id (a string)", hello, line)
    if "unsupported" in message:
        return Reply(id, unsupported=_reason(message["unsupported"], line))
    if "error" in message:
        return Reply(id, error=_reason(message["error"], line))
    if hello.answers == "intervals":
        pairs = _pairs(message, hello, line, most)
        if len(pairs) > most:
            raise TooMany(id, int(most))
        return Reply(id, intervals=pairs)
    if hello.answers == "any":
        if not isinstance(message.get("hit"), bool):
            raise _formless("hit (true or false)", hello, line)
        return Reply(id, hit=message["hit"])
    if "first" not in message:
        raise _formless("first (a number or null)", hello, line)
    value = message["first"]
    return Reply(id, first=None if value is None else _number(value, hello, line))


def _formless(missing: str, hello: Hello, line: bytes) -> BadLine:
    """Return what is wrong with a line that lacks something, and what it has to be."""
    right = f"the hello says {hello.answers}: reply {REPLIES[hello.answers]}"
    return BadLine(f"has no {missing}: {_shown(line)}; {right}")


@cache
def _more_pairs_than(most: int) -> re.Pattern[bytes]:
    """Return what matches the begin of a reply that goes on after so many pairs.

    To read all of a long line, to be told then that it is too long, takes a hundred times as long.
    """
    pairs = rb'\s*,\s*"intervals"\s*:\s*\['
    return re.compile(HEAD + pairs + rb"(?:[^\[\]]*\[[^\[\]]*\]){%d}\s*,\s*\[" % most)


def _reason(value: object, line: bytes) -> str:
    if not isinstance(value, str):
        raise BadLine(f"gives a reason that is not a string: {_shown(line)}")
    return cut(value)


def _number(value: object, hello: Hello, line: bytes) -> float:
    fmt = hello.format
    try:
        read = parse(value, hello.numbers, fmt)
        return read if fmt is BINARY64 else fmt.nearest(read)
    except (ValueError, OverflowError, RecursionError) as error:
        raise BadLine(f"has a bad number ({error}): {_shown(line)}") from None


def _pairs(message: dict[str, Any], hello: Hello, line: bytes, most: float) -> Pairs:
    """Return the pairs; of more than `most` only so many that this shows."""
    pairs = message.get("intervals")
    if not isinstance(pairs, list):
        raise _formless("intervals (a list of pairs)", hello, line)
    plain = hello.numbers == "decimal" and hello.precision == "binary64"
    read = []
    for pair in pairs if len(pairs) <= most else pairs[: int(most) + 1]:
        if not isinstance(pair, list) or len(pair) != 2:
            raise BadLine(f"has an interval that is not a pair of numbers: {_shown(line)}")
        a, b = pair
        if not (plain and type(a) is type(b) is float):  # those are what they are
            a, b = _number(a, hello, line), _number(b, hello, line)
        read.append((a, b))
    return tuple(read)


def first_end(pairs: Sequence[tuple[T, T]], from_inside: FromInside) -> tuple[int, int] | None:
    """Return which end of a list is the first hit, pair and side; None for a miss.

    From inside it is the enter, 0 (`zero`), the leave (`exit`; None if there is none), or a miss
    (`miss`).

    >>> first_end([(0.0, 2.0), (5.0, 6.0)], "exit")
    (0, 1)
    """
    if not pairs:
        return None
    enter, leave = pairs[0]
    if from_inside == "zero" or enter > 0:
        return 0, 0
    return (0, 1) if from_inside == "exit" and not isinf(leave) else None


def first(pairs: Sequence[tuple[T, T]], from_inside: FromInside) -> T | None:
    """Return the t of the first hit, or None for a miss."""
    end = first_end(pairs, from_inside)
    return None if end is None else pairs[end[0]][end[1]]


def hit(pairs: Sequence[tuple[float, float]]) -> bool:
    """Whether there is a hit at all; a touch is one.

    >>> hit([(2.0, 2.0)])
    True
    """
    return bool(pairs)


def serve(
    intersect: Intersect,
    hello: Hello,
    lines: Iterable[bytes] | None = None,
    out: BinaryIO | None = None,
) -> None:
    """Answer every line until the input ends. A line that cannot be answered gets an `error`.

    It ends too where nobody reads the answers any more.
    """
    lines = lines_of(sys.stdin.buffer) if lines is None else lines
    out = sys.stdout.buffer if out is None else out
    try:
        for line in lines:
            out.write(answer(line, intersect, hello))
            out.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), out.fileno())  # for what is buffered


def lines_of(stream: BinaryIO, most: int = LINE) -> Iterator[bytes]:
    """Yield the lines of a stream; of one with more than `most` bytes only the first of them.

    Of what is left out nothing is held. Such a line has one byte more than `most`.
    """
    while line := stream.readline(most + 1):
        yield line
        while len(line) > most and not line.endswith(b"\n"):
            line = stream.readline(most + 1)


def answer(line: bytes, intersect: Intersect, hello: Hello) -> bytes:
    """Return the line that answers a line, whatever it is, and whatever `intersect` does."""
    if len(line.rstrip(b"\n")) > LINE:
        long = f"the line has more than {LINE} bytes: {_shown(line)}"
        return encode({**_addressed(line), "error": long})
    try:
        message = decode(line)
    except BadLine as error:
        return encode({**_addressed(line), "error": f"the line {error}"})
    if "hello" in message:
        return write_hello(hello)
    id = message.get("id", "")
    if not isinstance(id, str):
        return encode({"error": f"the line has an id that is not a string: {_shown(line)}"})
    try:
        solid = read_solid(message.get("solid"), "solid", hello.numbers, hello.format)
        ray = read_ray(message.get("ray"), "ray", hello.numbers, hello.format)
        return _reply(id, tuple(intersect(solid, ray)), hello)
    except Refused as refusal:
        return encode({"id": id, "error": cut(str(refusal))})
    except Exception as error:  # a question that breaks the tracer is no reason to answer no other
        return encode({"id": id, "error": cut(f"{type(error).__name__}: {error}")})


def _addressed(line: bytes) -> dict[str, Any]:
    """Return the id that a line begins with, if it does, though the line cannot be read."""
    head = re.match(HEAD, line)
    return {"id": head["id"].decode("utf-8", "replace")} if head else {}


def _reply(id: str, pairs: Pairs, hello: Hello) -> bytes:
    if any(isnan(enter) or isnan(leave) for enter, leave in pairs):
        return encode({"id": id, "error": f"the answer holds NaN: {pairs!r:.200}"})
    if hello.answers == "first":
        return reply_first(id, first(pairs, hello.from_inside), hello)
    if hello.answers == "any":
        return reply_hit(id, hit(pairs))
    return reply_intervals(id, pairs, hello)
