"""The implementation's side of the line protocol: read cases, answer each, in order, flushed.

What an implementation brings is one function, `intersect(solid, ray) -> pairs of floats`. Where
its hello promises the first hit or a truth value, that is what the list says of it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from math import isnan
from typing import BinaryIO

from raycert.cases.forms import read_ray, read_solid
from raycert.cases.hits import first, hit
from raycert.cases.model import Ray, Refused, Solid
from raycert.cases.protocol import (
    BadLine,
    Hello,
    Pairs,
    decode,
    encode,
    reply_first,
    reply_hit,
    reply_intervals,
    write_hello,
)

Intersect = Callable[[Solid, Ray], Iterable[tuple[float, float]]]


def serve(
    intersect: Intersect,
    hello: Hello,
    lines: Iterable[bytes] | None = None,
    out: BinaryIO | None = None,
) -> None:
    """Answer every line until the input ends. A line that cannot be answered gets an `error`."""
    lines = sys.stdin.buffer if lines is None else lines
    out = sys.stdout.buffer if out is None else out
    for line in lines:
        out.write(answer(line, intersect, hello))
        out.flush()


def answer(line: bytes, intersect: Intersect, hello: Hello) -> bytes:
    """Return the line that answers one line."""
    try:
        message = decode(line)
    except BadLine as error:
        return encode({"error": f"the line {error}"})
    if "hello" in message:
        return write_hello(hello)
    id = message.get("id", "")
    try:
        solid = read_solid(message.get("solid"), "solid", hello.numbers, hello.format)
        ray = read_ray(message.get("ray"), "ray", hello.numbers, hello.format)
        return _reply(id, tuple(intersect(solid, ray)), hello)
    except Refused as refusal:
        return encode({"id": id, "error": str(refusal)})


def _reply(id: str, pairs: Pairs, hello: Hello) -> bytes:
    """Return the line that answers in the form that the hello promises."""
    if any(isnan(enter) or isnan(leave) for enter, leave in pairs):
        return encode({"id": id, "error": f"the answer holds NaN: {pairs!r:.200}"})
    if hello.answers == "first":
        return reply_first(id, first(pairs, hello.from_inside), hello)
    if hello.answers == "any":
        return reply_hit(id, hit(pairs))
    return reply_intervals(id, pairs, hello)
