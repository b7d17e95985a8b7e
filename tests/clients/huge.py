"""Answers question 3 with a line of 100 MB, all others well."""

import sys
from typing import Any

from wire import place, reply, say, serve


def handle(question: dict[str, Any]) -> None:
    if place(question) == 3:
        for _ in range(100):
            sys.stdout.write("0" * 1_000_000)
        sys.stdout.write("\n")
        sys.stdout.flush()
    else:
        say(reply(question))


serve(handle)
