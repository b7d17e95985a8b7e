"""What a student may hand in: `submission.py KIND`, a way to fail beside a wrong answer."""

import os
import pathlib
import signal
import sys
import time
from typing import Any

from wire import HELLO, reply, say, serve

KIND = sys.argv[1]
if KIND == "dies":
    sys.exit("no such module: vectors")
if KIND == "silent":
    time.sleep(60)
if KIND == "another":
    HELLO["version"] = str(time.time_ns())
if KIND == "lingers":
    pathlib.Path(sys.argv[2]).write_text(str(os.getpid()))


def handle(question: dict[str, Any]) -> None:
    if KIND == "kills":
        os.kill(os.getppid(), signal.SIGKILL)
    if KIND in ("kills", "hangs", "lingers"):
        time.sleep(60)
    if KIND == "crashes":
        os.abort()
    say(reply(question))


serve(handle)
