"""Begins badly: `hello.py KIND`."""

import sys
import time

from wire import HELLO, say

kind = sys.argv[1]
if kind == "dies":
    print("no such scene: room.xml", file=sys.stderr)
    sys.exit(7)
elif kind == "banner":
    print("My Tracer 2.1")
    say(HELLO)
elif kind == "silent":
    time.sleep(3600)
elif kind == "slow":
    time.sleep(float(sys.argv[2]))
    sys.stdin.readline()
    say(HELLO)
elif kind == "nameless":
    say({"hello": 1})
elif kind == "deep":
    print('{"hello": 1, "name": "x", "precision": ' + "[" * int(sys.argv[2]), end="")
    print("]" * int(sys.argv[2]) + "}")
elif kind == "long":
    say(HELLO | {"name": "x" * 500_000})
elif kind == "segfault":
    import os
    import signal

    os.kill(os.getpid(), signal.SIGSEGV)
