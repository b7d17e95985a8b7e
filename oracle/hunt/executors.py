"""Where units are done: here, in processes of this machine, or elsewhere, through one interface.

An executor gives every unit's result at least once: one whose worker was lost is done again, up to
ATTEMPTS times. The ledger counts each once.
"""

from __future__ import annotations

import signal
from collections import deque
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Protocol

from raycert.oracle.hunt.unit import Done, Unit

Work = Callable[[Unit], Done]
ATTEMPTS = 4


class Lost(Exception):
    """A unit's workers died again and again, or there is none; the text says what was seen."""


class Executor(Protocol):
    """Somewhere to do units."""

    @property
    def places(self) -> int:
        """Return how many units can be under way at a time."""

    def submit(self, unit: Unit) -> None:
        """Begin a unit, or let it wait."""

    def finished(self, seconds: float) -> list[Done]:
        """Return results that have come, waiting so long for the first. Raises `Lost`.

        An exception of the work itself is raised here.
        """

    def close(self) -> None:
        """End; what is under way is dropped."""


class Here:
    """Units done one after the other, in this process, when their results are asked for."""

    places = 1

    def __init__(self, work: Work) -> None:
        """Take the work that does a unit."""
        self._work = work
        self._waiting: deque[Unit] = deque()

    def submit(self, unit: Unit) -> None:
        """Let a unit wait."""
        self._waiting.append(unit)

    def finished(self, seconds: float) -> list[Done]:
        """Do the next unit, however long that takes."""
        return [self._work(self._waiting.popleft())] if self._waiting else []

    def close(self) -> None:
        """Drop what waits."""
        self._waiting.clear()


class Processes:
    """Units done in processes of this machine; a pool that lost a process is replaced."""

    def __init__(self, work: Work, count: int) -> None:
        """Start so many processes for the work, which has to be importable there."""
        self.places = count
        self._work = work
        self._pool = self._new()
        self._units: dict[Future[Done], Unit] = {}
        self._losses = 0

    def _new(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(self.places, get_context("spawn"), _leave_interrupts)

    def submit(self, unit: Unit) -> None:
        """Give a unit to the pool."""
        try:
            self._units[self._pool.submit(self._work, unit)] = unit
        except BrokenProcessPool:
            self._again([unit])

    def finished(self, seconds: float) -> list[Done]:
        """Return what has come; units of a broken pool are begun again."""
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
        self._pool = self._new()
        for unit in sorted(waiting, key=lambda unit: unit.number):
            self.submit(unit)

    def close(self) -> None:
        """Stop the processes, at once."""
        for process in list((self._pool._processes or {}).values()):
            process.terminate()
        self._pool.shutdown(wait=True, cancel_futures=True)


def _leave_interrupts() -> None:
    """Leave Ctrl-C to the process that waits for the results."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
