"""A folder that one process at a time changes: read, change and write, and nobody in between.

The lock is the system's, on the folder itself: no file is left behind, and what ends, however it
ends, holds nothing. Without `flock`, which is to say on Windows, nobody waits.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from errno import ETIMEDOUT
from pathlib import Path

PATIENCE = 60.0
"""Seconds to wait for who has the folder: it takes a few, unless it was stopped."""
POLL = 0.02


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Have a folder, which is made if need be, to oneself. Raises `TimeoutError` after PATIENCE."""
    if os.name != "posix":
        yield
        return
    handle = _hold(folder)
    try:
        yield
    finally:
        os.close(handle)


def _hold(folder: Path) -> int:
    """Return the handle of the folder, which holds the lock until it is closed."""
    import fcntl

    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        folder.mkdir(parents=True, exist_ok=True)
        handle = os.open(folder, os.O_RDONLY)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(os.fstat(handle), folder.stat()):  # it may have been made anew
                return handle
        except (BlockingIOError, FileNotFoundError):
            pass
        os.close(handle)
        time.sleep(POLL)
    what = f"another process has been writing here for {PATIENCE:g} s"
    raise TimeoutError(ETIMEDOUT, what, str(folder))
