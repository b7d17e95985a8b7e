"""Writes 1 MB to standard error for each question, and answers it well."""

import sys
from typing import Any

from wire import reply, say, serve


def handle(question: dict[str, Any]) -> None:
    sys.stderr.write("debug " * 170_000)
    say(reply(question))


serve(handle)
