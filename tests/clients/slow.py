"""Reads slowly: 20 ms a question."""

import time
from typing import Any

from wire import reply, say, serve


def handle(question: dict[str, Any]) -> None:
    time.sleep(0.02)
    say(reply(question))


serve(handle)
