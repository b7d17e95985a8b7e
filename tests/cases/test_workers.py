"""Workers leave signals to who waits for them, and end with it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from raycert.cases.workers import Workers
from shared.processes import gone, linger

pytestmark = pytest.mark.skipif(os.name != "posix", reason="other signals")


def begun(folder: Path, count: int) -> list[int]:
    """Return the ids of so many workers, once they are at work."""
    deadline = time.monotonic() + 20
    while len(list(folder.iterdir())) < count and time.monotonic() < deadline:
        time.sleep(0.005)
    return [int(path.name) for path in folder.iterdir()]


def test_signals_are_not_for_them_and_leaving_ends_them(tmp_path: Path) -> None:
    with Workers(2) as pool:
        under_way = [pool.submit(linger, str(tmp_path)) for _ in range(2)]
        pids = begun(tmp_path, 2)
        assert len(pids) == 2
        for pid in pids:
            for number in (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT):
                os.kill(pid, number)
        assert not any(future.done() for future in under_way)
    assert gone(pids)


def test_they_end_with_a_parent_that_is_killed(tmp_path: Path) -> None:
    code = f"from shared.processes import wait_for_two; wait_for_two({str(tmp_path)!r})"
    parent = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
    pids = begun(tmp_path, 2)
    parent.kill()
    parent.wait()
    assert len(pids) == 2
    assert gone(pids)
