"""Starts a child that holds its pipes for an hour, writes the child's id to FILE; answers well.

`family.py FILE dies` ends at question 3 and leaves the child behind; with `escapes` as well, the
child is in a session of its own, where no signal to the group finds it, and with `wiped` it has no
environment.
"""

import pathlib
import subprocess
import sys
from typing import Any

from wire import place, reply, say, serve

CHILD = subprocess.Popen(
    [sys.executable, "-c", "import time; time.sleep(3600)"],
    start_new_session="escapes" in sys.argv,
    env={} if "wiped" in sys.argv else None,
)
with pathlib.Path(sys.argv[1]).open("a") as file:
    file.write(f"{CHILD.pid}\n")


def handle(question: dict[str, Any]) -> None:
    if "dies" in sys.argv and place(question) == 3:
        sys.exit(5)
    say(reply(question))


serve(handle)
