"""The implementation's side of the line protocol: read cases, answer each, in order, flushed.

What an implementation brings is one function, `intersect(solid, ray) -> pairs of floats`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from typing import BinaryIO

from cases.forms import read_ray, read_solid
from cases.model import Ray, Refused, Solid
from cases.protocol import BadLine, Hello, decode, encode, reply_intervals, write_hello

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
        return reply_intervals(id, intersect(solid, ray), hello)
    except Refused as refusal:
        return encode({"id": id, "error": str(refusal)})
