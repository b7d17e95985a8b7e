"""Answers, but for planted faults: `faulty.py KIND=EVERY ...`, on questions 0 mod EVERY, but 0."""

import sys
import time
from typing import Any

from wire import place, reply, say, serve

FAULTS = {kind: int(every) for kind, every in (word.split("=") for word in sys.argv[1:])}


def handle(question: dict[str, Any]) -> None:
    n = place(question)
    for kind, every in FAULTS.items():
        if n and n % every == 0:
            fail(kind, question)
            return
    say(reply(question))


def fail(kind: str, question: dict[str, Any]) -> None:
    if kind == "crash":
        print("Segmentation fault (planted)", file=sys.stderr, flush=True)
        sys.exit(3)
    elif kind == "hang":
        time.sleep(3600)
    elif kind == "wrong-id":
        say(reply(question) | {"id": "something"})
    elif kind == "chatter":
        print("hit!", flush=True)
        say(reply(question))
    elif kind == "after":
        print(f"{reply(question)}".replace("'", '"') + "\ntraced one more", flush=True)
    elif kind == "dies-after":
        say(reply(question))
        sys.exit(4)
    elif kind == "half":
        print('{"id": "', end="", flush=True)
        sys.exit(0)
    elif kind == "no-newline":
        print("1" * 20, end="", flush=True)
        time.sleep(3600)
    else:
        raise SystemExit(f"no such fault: {kind}")


serve(handle)
