"""Workers leave signals to who waits for them, and end with it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from raycert.cases import workers
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


def test_a_worker_ends_once_whatever_tells_it_to(monkeypatch: pytest.MonkeyPatch) -> None:
    """The parent's word is being obeyed when its death is noticed: that must not cut it short."""
    first, done = threading.Event(), []

    def last() -> None:
        first.set()
        time.sleep(0.05)
        done.append("ended")

    monkeypatch.setattr(workers, "AT_LAST", [last])
    monkeypatch.setattr(workers.atexit, "_run_exitfuncs", lambda: None)
    monkeypatch.setattr(workers, "_ending", threading.Lock())
    monkeypatch.setattr(os, "_exit", lambda _: done.append("exit"))
    threads = [threading.Thread(target=workers._end_worker, args=(15,), daemon=True) for _ in "12"]
    threads[0].start()
    first.wait(5)
    threads[1].start()
    threads[0].join(5)
    assert done == ["ended", "exit"]


def test_they_end_with_a_parent_that_is_killed(tmp_path: Path) -> None:
    code = f"from shared.processes import wait_for_two; wait_for_two({str(tmp_path)!r})"
    parent = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
    pids = begun(tmp_path, 2)
    parent.kill()
    parent.wait()
    assert len(pids) == 2
    assert gone(pids)


def test_a_worker_that_is_ended_while_it_starts_ends(tmp_path: Path) -> None:
    """Its signal waits until it can be heeded: ignored for a moment, it would be gone."""
    pool = Workers(1)
    pool.submit(linger, str(tmp_path))
    began = time.monotonic()
    pool.end()
    assert time.monotonic() - began < 30
