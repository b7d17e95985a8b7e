"""Where units are done: here, in processes of this machine, or elsewhere, through one interface.

An executor gives every unit's result at least once: one whose worker was lost is done again, up to
ATTEMPTS times. The ledger counts each once.

A Dask cluster needs the extra `cluster`. A unit's key is made of its hunt and number, so what the
scheduler moves from a worker that died to another is the same task. A task that the scheduler gives
up, because worker after worker died with it, is submitted again under a new key. TARGET has to be
runnable on every worker, where raycert has to be installed too.
"""

from __future__ import annotations

import signal
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Any, Protocol
from uuid import uuid4

from raycert.oracle.hunt.unit import Haul, Unit

Work = Callable[[Unit], Haul]
ATTEMPTS = 4
POLL = 0.01
CONNECT = 10.0
"""Seconds to reach the scheduler of a cluster, and for a first worker to be there."""


class Lost(Exception):
    """A unit's workers died again and again, or there is none; the text says what was seen."""


class Executor(Protocol):
    """Somewhere to do units."""

    @property
    def places(self) -> int:
        """Return how many units can be under way at a time."""

    def submit(self, unit: Unit) -> None:
        """Begin a unit, or let it wait."""

    def finished(self, seconds: float) -> list[Haul]:
        """Return results that have come, waiting so long for the first. Raises `Lost`.

        An exception of the work itself is raised here.
        """

    def close(self) -> None:
        """End; what is under way is dropped."""


class Here:
    """Units done one after the other, in this process, when their results are asked for."""

    places = 1

    def __init__(self, work: Work) -> None:
        self._work = work
        self._waiting: deque[Unit] = deque()

    def submit(self, unit: Unit) -> None:
        self._waiting.append(unit)

    def finished(self, seconds: float) -> list[Haul]:
        return [self._work(self._waiting.popleft())] if self._waiting else []

    def close(self) -> None:
        self._waiting.clear()


class Processes:
    """Units done in processes of this machine; a pool that lost a process is replaced."""

    def __init__(self, work: Work, count: int) -> None:
        """Start so many processes for the work, which has to be importable there."""
        self.places = count
        self._work, self._losses = work, 0
        self._units: dict[Future[Haul], Unit] = {}
        self._open()

    def _open(self) -> None:
        ignore = signal.signal, (signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for who waits
        self._pool = ProcessPoolExecutor(self.places, get_context("spawn"), *ignore)

    def submit(self, unit: Unit) -> None:
        try:
            self._units[self._pool.submit(self._work, unit)] = unit
        except BrokenProcessPool:
            self._again([unit])

    def finished(self, seconds: float) -> list[Haul]:
        done, _ = wait(self._units, seconds, FIRST_COMPLETED)
        results, lost = [], []
        for future in done:
            unit = self._units.pop(future)
            if isinstance(future.exception(), BrokenProcessPool):
                lost.append(unit)
            else:
                results.append(future.result())
        if lost:
            self._again(lost)
        return results

    def _again(self, units: list[Unit]) -> None:
        self._losses += 1
        if self._losses > ATTEMPTS:
            raise Lost(f"{self._losses} times a worker process ended in the middle of its work")
        waiting = [*units, *self._units.values()]
        self._units.clear()
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._open()
        for unit in sorted(waiting, key=lambda unit: unit.number):
            self.submit(unit)

    def close(self) -> None:
        for process in list((self._pool._processes or {}).values()):
            process.terminate()
        self._pool.shutdown(wait=True, cancel_futures=True)


class Cluster:
    """Units done by the workers of a Dask scheduler."""

    def __init__(self, work: Work, address: str) -> None:
        """Connect to a scheduler. Raises `Lost` if it cannot be reached or has no worker."""
        try:
            import distributed
        except ImportError:
            raise Lost('--scheduler needs Dask: pip install "raycert[cluster]"') from None
        self._work, self._name = work, uuid4().hex[:8]
        try:
            connect: Any = distributed.Client
            self._client = connect(address, timeout=CONNECT, set_as_default=False)
            self._client.wait_for_workers(1, timeout=CONNECT)
        except (OSError, TimeoutError, ValueError) as error:
            raise Lost(f"no Dask worker at {address!r}: {error}") from None
        self._tasks: dict[int, tuple[Any, Unit, int]] = {}

    @property
    def places(self) -> int:
        """Return how many workers there are now; at least 1, for more may come."""
        return max(len(self._client.scheduler_info(n_workers=-1)["workers"]), 1)

    def submit(self, unit: Unit, attempt: int = 1) -> None:
        key = f"raycert-hunt-{self._name}-{unit.number}-{attempt}"
        future = self._client.submit(self._work, unit, key=key, pure=False)
        self._tasks[unit.number] = future, unit, attempt

    def finished(self, seconds: float) -> list[Haul]:
        self._wait(seconds)
        results = []
        for future, unit, attempt in list(self._tasks.values()):
            if future.status == "finished":
                del self._tasks[unit.number]
                results.append(future.result())
            elif future.status in ("error", "cancelled", "lost"):
                self._again(future, unit, attempt)
        return results

    def _wait(self, seconds: float) -> None:
        """Wait until a task is no longer pending. Raises `Lost` with the scheduler."""
        end = time.monotonic() + seconds
        while all(future.status == "pending" for future, _, _ in self._tasks.values()):
            if self._client.status not in ("running", "connecting"):
                raise Lost(f"the connection to the scheduler was lost: {self._client.status}")
            if time.monotonic() > end:
                return
            time.sleep(POLL)

    def _again(self, future: Any, unit: Unit, attempt: int) -> None:
        """Submit a unit whose worker was lost again; what the work itself raised is raised here."""
        error = future.exception() if future.status == "error" else None
        if error is not None and type(error).__name__ != "KilledWorker":
            raise error
        if attempt == ATTEMPTS:
            raise Lost(f"unit {unit.number} was lost {ATTEMPTS} times: {error or future.status}")
        self.submit(unit, attempt + 1)

    def close(self) -> None:
        """Cancel what is under way, and leave the cluster running."""
        for future, _, _ in self._tasks.values():
            future.cancel()
        self._client.close()
