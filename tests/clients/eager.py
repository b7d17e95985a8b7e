"""Answers a question before it is asked for: in pairs, the later one first."""

import sys
from typing import Any

from wire import HELLO, reply, say


def main() -> None:
    import json
    import select

    held: list[dict[str, Any]] = []
    while line := sys.stdin.buffer.raw.readline():  # type: ignore[attr-defined]
        message = json.loads(line)
        if "hello" in message:
            say(HELLO)
            continue
        held.insert(0, message)
        if len(held) == 2 or not select.select([sys.stdin], [], [], 0.02)[0]:
            for question in held:
                say(reply(question))
            held = []


main()
