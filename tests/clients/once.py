"""Starts well while FILE is missing, which it makes; crashes at question 3, then at each start."""

import pathlib
import sys
from typing import Any

from wire import place, reply, say, serve

FILE = pathlib.Path(sys.argv[1])
if FILE.exists():
    sys.exit("licence used up")
FILE.touch()


def handle(question: dict[str, Any]) -> None:
    if place(question) == 3:
        sys.exit(1)
    say(reply(question))


serve(handle)
