"""Units done on a Dask cluster. Needs the extra `cluster`.

A unit's key is made of its hunt and number, so what the scheduler moves from a worker that died to
another is the same task. A task that the scheduler gives up, because worker after worker died with
it, is submitted again under a new key. TARGET has to be runnable on every worker, where raycert has
to be installed too.
"""

from __future__ import annotations

import time
from typing import Any
from uuid import uuid4

from raycert.oracle.hunt.executors import ATTEMPTS, Lost, Work
from raycert.oracle.hunt.unit import Done, Unit

POLL = 0.01
CONNECT = 10.0
"""Seconds to reach the scheduler, and for a first worker to be there."""


class Cluster:
    """The workers of a scheduler."""

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
        """Give a unit to the cluster."""
        key = f"raycert-hunt-{self._name}-{unit.number}-{attempt}"
        future = self._client.submit(self._work, unit, key=key, pure=False)
        self._tasks[unit.number] = future, unit, attempt

    def finished(self, seconds: float) -> list[Done]:
        """Return what has come; what the cluster gave up is submitted again."""
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
