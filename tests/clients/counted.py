"""Ends without a word at the 10th question since its start, whichever that is."""

import itertools
import sys
from typing import Any

from wire import reply, say, serve

COUNT = itertools.count(1)


def handle(question: dict[str, Any]) -> None:
    if next(COUNT) == 10:
        sys.exit(0)
    say(reply(question))


serve(handle)
