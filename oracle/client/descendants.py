"""Whom a client has started, also where they have left its process group and its session.

Every client has a mark of its own in its environment, which its descendants inherit. On Linux they
are found by it, whoever started them and whoever is their parent now, and nobody else is: a process
of the user's has no such mark. One that wiped its environment and lost its parent is found only
where raycert is the whole process, a command: there such orphans become our children, in sessions
that are not ours, and end with the command. On other systems only the group ends.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import select
import signal
import sys
import time
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

from raycert.cases import interrupts
from raycert.oracle.client import apart

VARIABLE = "RAYCERT_CLIENT"
OWN = secrets.token_hex(8)
"""What the marks of this process begin with."""
GROUPS: dict[str, int] = {}
"""The process groups of clients that run, by their marks."""
WAIT = 0.5
"""Seconds for all that were killed to be gone."""
PR_SET_CHILD_SUBREAPER = 36
_numbers = count()
_used = False
_adopts = False


def environment() -> tuple[str, dict[str, str]]:
    """Return a new mark, and the environment that has it beside the marks that are ours."""
    global _used
    _used = True
    if interrupts.alone():
        _adopt()
    mark = f"{OWN}.{next(_numbers)};"
    return mark, {**apart.environment(), VARIABLE: os.environ.get(VARIABLE, "") + mark}


def _adopt() -> None:
    """Become the parent of descendants that lose theirs."""
    global _adopts
    if sys.platform == "linux" and not _adopts:
        import ctypes

        with contextlib.suppress(OSError, AttributeError):
            _adopts = ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) == 0


def end(mark: str) -> None:
    """End the group of a mark and all that have it."""
    kill_group(mark)
    _kill(lambda place: _is_marked(place, mark))


def end_all() -> None:
    """End all that clients of this process have started."""
    if _used:
        for mark in list(GROUPS):
            kill_group(mark)
        _kill(lambda place: _is_marked(place, OWN) or (_adopts and _is_orphan(place)))


def kill_group(mark: str) -> None:
    """Kill the group of a mark, once."""
    if group := GROUPS.pop(mark, None):
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(group, signal.SIGKILL)


def _kill(wanted: Callable[[Path], bool]) -> None:
    """Kill until nobody is left: who is killed may have started another meanwhile."""
    deadline = time.monotonic() + WAIT
    while sys.platform == "linux" and time.monotonic() < deadline:
        found = list(_found(wanted))
        for process in found:
            with contextlib.suppress(OSError):
                signal.pidfd_send_signal(process, signal.SIGKILL)
        for process in found:
            with contextlib.suppress(OSError):
                select.select([process], [], [], max(0.0, deadline - time.monotonic()))
                os.waitid(os.P_PIDFD, process, os.WEXITED | os.WNOHANG)
            os.close(process)
        if not found:
            return


def _found(wanted: Callable[[Path], bool]) -> Iterator[int]:
    """Yield open descriptors of the processes that are wanted."""
    for place in Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            if place.name.isdigit() and wanted(place):
                process = os.pidfd_open(int(place.name))
                if wanted(place):  # still, and so it is the one that the descriptor is of
                    yield process
                else:
                    os.close(process)


def _is_marked(place: Path, mark: str) -> bool:
    key, value = f"{VARIABLE}=".encode(), mark.encode()
    words = (place / "environ").read_bytes().split(b"\0")
    return any(word.startswith(key) and value in word for word in words)


def _is_orphan(place: Path) -> bool:
    """Whether a process that lives is a child of ours in a session that is not ours."""
    state, parent, _, session = (place / "stat").read_bytes().rpartition(b")")[2].split()[:4]
    return int(parent) == os.getpid() and int(session) != os.getsid(0) and state != b"Z"


interrupts.AT_LAST.append(end_all)
