"""The process that code of others runs in: questions in, answers out, through pipes of its own.

In:  the kind and place of the code on the command line; then, on standard input, batches: 4 bytes
     that give the length, and the questions as batch.py writes them.
Out: lines of JSON. The first is {"hello": ...} or {"unusable": why}; every other one is a list of
     answers in the order of the questions. They are sent when a batch is done, or 5 ms after the
     last that were sent, so that neither a line for each nor a long silence costs anything.

An answer is what is promised, a list of pairs, a first hit or a truth value, or else an object
with the one key `error`, `unsupported` or `bad`. What comes out is JSON, as it comes from a process
whose memory code of others may have spoiled. The code sees an empty standard
input, and what it prints goes to standard error.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterable
from typing import BinaryIO

from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Reply, write_hello
from raycert.oracle.client.batch import read_batch
from raycert.oracle.client.library import load_library
from raycert.oracle.client.loaded import CannotLoad, Loaded, load_callable
from raycert.oracle.client.process import Failure

FLUSH = 0.005
LONGEST = 1 << 18
"""A line is ended once it has so many characters; one answer more goes into it."""
Kinds = dict[str, Callable[[str], Loaded]]
KINDS: Kinds = {"callable": load_callable, "library": load_library}


def main(kind: str, spec: str) -> None:
    """Serve until the input ends."""
    questions, answers = _private_pipes()
    try:
        loaded = KINDS[kind](spec)
    except CannotLoad as error:
        _send(answers, json.dumps({"unusable": str(error)}))
        return
    _send(answers, write_hello(loaded.hello).decode().rstrip("\n"))
    while head := questions.read(4):
        batch = questions.read(int.from_bytes(head, "big"))
        _answer(read_batch(batch), loaded, answers)


def _private_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Take standard input and output away from the code, and return them."""
    questions, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb", buffering=0)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    return questions, answers


def _answer(batch: Iterable[tuple[Solid, Ray]], loaded: Loaded, answers: BinaryIO) -> None:
    """Answer a batch of questions."""
    said: list[str] = []
    length = 0
    sent = time.monotonic()
    for solid, ray in batch:
        text = _write(loaded(solid, ray))
        said.append(text)
        length += len(text)
        if time.monotonic() - sent > FLUSH or length > LONGEST:
            _send(answers, f"[{','.join(said)}]")
            said, length, sent = [], 0, time.monotonic()
    if said:
        _send(answers, f"[{','.join(said)}]")


def _write(outcome: Reply | Failure) -> str:
    if isinstance(outcome, Failure):
        return json.dumps({"bad": outcome.detail})
    if outcome.intervals is not None:
        return json.dumps(outcome.intervals)
    for name in ("error", "unsupported"):
        if (text := getattr(outcome, name)) is not None:
            return json.dumps({name: text})
    return json.dumps(outcome.first if outcome.hit is None else outcome.hit)


def _send(answers: BinaryIO, line: str) -> None:
    rest = memoryview(line.encode("ascii") + b"\n")
    while rest:
        rest = rest[answers.write(rest) :]


if __name__ == "__main__":
    main(*sys.argv[1:3])
