"""Our processes kept apart from the files of their user.

Python puts the current directory before all else where a module is run by its name, and so in the
processes that `multiprocessing` spawns: a `json.py` or `raycert.py` there would be taken for the
module that we mean. Only what has to be in place before anything else is imported is used here.
"""

from __future__ import annotations

import os
import sys

SAFE = "PYTHONSAFEPATH"
OURS = "raycert"
"""The value of SAFE that we set: a client gets the environment without it."""


def keep_apart() -> None:
    """Take the current directory from the path, of this process and of those that it spawns."""
    os.environ.setdefault(SAFE, OURS)
    if not sys.flags.safe_path:
        try:
            if sys.path[0] == os.getcwd():
                del sys.path[0]
        except OSError:  # the directory is gone, so Python has not put it there
            pass


def ours(module: str, *words: str) -> tuple[str, ...]:
    """Return the command that runs a module of ours, whatever the current directory holds."""
    return sys.executable, "-P", "-m", module, *words


def environment() -> dict[str, str]:
    """Return the environment as the user has it: their programs find what lies beside them."""
    return {name: value for name, value in os.environ.items() if (name, value) != (SAFE, OURS)}
