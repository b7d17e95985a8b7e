"""Kills who asks it: `killer.py FILE SIGNAL START`, a signal's name and a number.

In its start of that number it answers the first question, sends the signal to its parent, a moment
later again, and is then deaf to everything, the end of its input included. Each start adds its own
process id to FILE, and that of a child that leaves the session and wipes its environment.
"""

import os
import pathlib
import signal
import subprocess
import sys
import time
from typing import Any

from wire import reply, say, serve

FILE, NAME, START = pathlib.Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
with FILE.open("a") as file:
    child = subprocess.Popen(["/bin/sleep", "60"], start_new_session=True, env={})
    file.write(f"{os.getpid()} {child.pid}\n")
STARTED = len(FILE.read_text().splitlines())
asker = os.getppid()


def handle(question: dict[str, Any]) -> None:
    say(reply(question))
    if STARTED == START:
        time.sleep(0.1)  # the answer is read meanwhile
        os.kill(asker, signal.Signals[NAME])
        time.sleep(0.05)
        os.kill(asker, signal.Signals[NAME])
        time.sleep(60)


serve(handle)
