"""Processes that linger, and whether they live."""

from __future__ import annotations

import os
import time
from concurrent.futures import wait
from pathlib import Path

from raycert.cases.workers import Workers


def alive(pid: int) -> bool:
    """Whether a process runs; one that is dead and not yet reaped does not."""
    try:
        os.kill(pid, 0)
        state = Path(f"/proc/{pid}/stat")
        return not state.exists() or state.read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False


def gone(pids: list[int]) -> bool:
    """Whether none of the processes runs in the end."""
    deadline = time.monotonic() + 5
    while any(map(alive, pids)) and time.monotonic() < deadline:
        time.sleep(0.01)
    return not any(map(alive, pids))


def linger(folder: str) -> int:
    """Tell the folder who works, and do not end."""
    (Path(folder) / str(os.getpid())).touch()
    time.sleep(60)
    return os.getpid()


def wait_for_two(folder: str) -> None:
    """Wait for two workers that linger."""
    with Workers(2) as pool:
        wait([pool.submit(linger, folder) for _ in range(2)])
