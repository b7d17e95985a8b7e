"""Starts well while FILE is missing, which it makes; crashes at question 3, then at each start.

`once.py FILE NAME`: then it is another, of that name.
"""

import pathlib
import sys
from typing import Any

from wire import HELLO, place, reply, say, serve

FILE = pathlib.Path(sys.argv[1])
if FILE.exists():
    if not sys.argv[2:]:
        sys.exit("licence used up")
    HELLO["name"] = sys.argv[2]
FILE.touch()


def handle(question: dict[str, Any]) -> None:
    if place(question) == 3:
        sys.exit(1)
    say(reply(question))


serve(handle)
