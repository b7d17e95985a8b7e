"""Answers question 3 with the text that `raw.py KIND` names, {id} filled in; all others well."""

import sys
from typing import Any

from wire import place, reply, say, serve

TEXTS = {
    "not-json": "hit",
    "not-object": "[1]",
    "nan": '{{"id": "{id}", "intervals": [[NaN, 1]]}}',
    "flat": '{{"id": "{id}", "intervals": [2, 4]}}',
    "digits": '{{"id": "{id}", "intervals": [[' + "7" * 1_000_000 + ", 1]]}}",
    "deep": '{{"id": "{id}", "intervals": ' + "[" * 100_000 + "]" * 100_000 + "}}",
    "deep-reason": '{{"id": "{id}", "error": ' + "[" * 900 + "]" * 900 + "}}",
    "million": '{{"id": "{id}", "intervals": [' + "[0,1]," * 1_000_000 + "[0,1]]}}",
    "many": '{{"id": "{id}", "intervals": [' + "[0,1]," * 100_000 + "[0,1]]}}",
    "reason": '{{"id": "{id}", "error": "' + "x" * 900_000 + '"}}',
    "utf-8": '{{"id": "{id}", "intervals": [[\xff, 1]]}}',
    "long": '{{"id": "{id}", "intervals": []' + " " * 200 + "}}",
    "blank": "",
    "no-id": '{{"intervals": []}}',
}


def handle(question: dict[str, Any]) -> None:
    if place(question) == 3:
        text = TEXTS[sys.argv[1]].format(id=question["id"])
        sys.stdout.buffer.write(text.encode("latin-1") + b"\n")
        sys.stdout.flush()
    else:
        say(reply(question))


serve(handle)
