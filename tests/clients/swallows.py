"""Answers everything, and never flushes; `swallows.py late` flushes the hello."""

import sys

from wire import HELLO, reply, say, serve

sys.stdout = open(1, "w", buffering=1 << 16)  # noqa: SIM115 (whatever PYTHONUNBUFFERED says)
if sys.argv[1:] == ["late"]:
    sys.stdin.readline()
    say(HELLO)
serve(lambda question: say(reply(question), flush=False), flush=False)
