"""What the planted clients share: the loop over lines, and a trivial answer.

A client finds out which question it is asked by the x of the ray's origin.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import Any

HELLO = {"hello": 1, "name": "planted", "version": "1"}


def say(message: object, flush: bool = True) -> None:
    """Write one line."""
    sys.stdout.write(json.dumps(message) + "\n")
    if flush:
        sys.stdout.flush()


def place(question: dict[str, Any]) -> int:
    """Return the number that the test has hidden in the question."""
    return int(question["ray"]["origin"][0])


def reply(question: dict[str, Any]) -> dict[str, Any]:
    """Return an answer that names the question: [[n, n + 1]]."""
    n = place(question)
    return {"id": question["id"], "intervals": [[n, n + 1]]}


def serve(handle: Callable[[dict[str, Any]], None], flush: bool = True) -> None:
    """Answer the hello, and pass every question on."""
    for line in sys.stdin:
        message = json.loads(line)
        if "hello" in message:
            say(HELLO, flush)
        else:
            handle(message)
