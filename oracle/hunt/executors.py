"""Where units are done: here, in processes of this machine, or elsewhere, through one interface.

An executor gives every unit's result at least once: one whose worker was lost is done again, up to
ATTEMPTS times. The ledger counts each once. Results that have come are given before anything that
is wrong is raised.

A Dask cluster needs the extra `cluster`. A unit's key is made of its hunt and number, so what the
scheduler moves from a worker that died to another is the same task. A task that the scheduler gives
up, because worker after worker died with it, is submitted again under a new key. TARGET has to be
runnable on every worker, where the same raycert has to be installed too.

Dask itself waits long for a scheduler or a worker that is gone: a heart beats beside it, and after
SILENCE seconds without a sign of life of any worker the cluster is lost.
"""

from __future__ import annotations

import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import version
from pickle import PickleError
from typing import Any, Protocol
from uuid import uuid4

from raycert.cases.hints import lacking
from raycert.cases.workers import Workers
from raycert.oracle.hunt.unit import Haul, Unit

Work = Callable[[Unit], Haul]
ATTEMPTS = 4
POLL = 0.01
CONNECT = 10.0
"""Seconds to reach the scheduler of a cluster, and for a first worker to be there."""
BEAT, SILENCE = 1.0, 12.0
"""Seconds between two beats of the heart, and without a sign of life until a cluster is lost."""
GATHER = 5.0
"""Seconds for a result that a worker has to come here, and for a connection to close."""


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
        self._work, self._losses = work, Counter[int]()
        self._units: dict[Future[Haul], Unit] = {}
        self._pool = Workers(count)

    def submit(self, unit: Unit) -> None:
        try:
            self._units[self._pool.submit(self._work, unit)] = unit
        except BrokenProcessPool:
            self._again([unit])

    def finished(self, seconds: float) -> list[Haul]:
        done, _ = wait(self._units, seconds, FIRST_COMPLETED)
        if good := [future for future in done if future.exception() is None]:
            for future in good:
                del self._units[future]
            return [future.result() for future in good]
        for future in done:
            if not isinstance(future.exception(), BrokenProcessPool):
                future.result()
        if done:
            self._again()
        return []

    def _again(self, waiting: Sequence[Unit] = ()) -> None:
        """Begin what was under way again, in new processes, and what waits as well."""
        under_way = list(self._units.values())
        self._losses.update(unit.number for unit in under_way)
        losses = max(self._losses.values(), default=0)
        if losses > ATTEMPTS:
            raise Lost(f"{losses} times a worker process ended in the middle of the same work")
        self._units.clear()
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._pool = Workers(self.places)
        for unit in sorted((*waiting, *under_way), key=lambda unit: unit.number):
            self.submit(unit)

    def close(self) -> None:
        self._pool.end()


@dataclass(frozen=True, slots=True)
class Sent:
    """Work for a worker whose raycert is the one that sent it: others may find something else."""

    work: Work
    version: str

    def __call__(self, unit: Unit) -> Haul:
        if (own := version("raycert")) != self.version:
            raise Lost(f"a worker has raycert {own}, and here is {self.version}")
        return self.work(unit)


class Heart:
    """Asks a scheduler for its workers, again and again, in a thread of its own.

    A worker is heard of when the scheduler says that it has heard of it anew.
    """

    def __init__(self, client: Any) -> None:
        self._client, self._seen = client, dict[str, float]()
        self._heard, self._ended = time.monotonic(), threading.Event()
        self._note(client.scheduler_info(n_workers=-1))
        threading.Thread(target=self._beat, name="raycert-heart", daemon=True).start()

    def _beat(self) -> None:
        while not self._ended.is_set():
            with suppress(Exception):  # who does not answer is silent, and that is told by the time
                self._note(self._client.scheduler_info(n_workers=-1))
            self._ended.wait(BEAT)

    def _note(self, scheduler: Any) -> None:
        workers = scheduler.get("workers", {})
        seen = {address: worker["last_seen"] for address, worker in workers.items()}
        if seen.items() - self._seen.items():
            self._heard = time.monotonic()
        self._seen, self.workers = seen, len(seen)

    def check(self) -> None:
        """Raise `Lost` if no worker was heard of for too long."""
        silent, status = time.monotonic() - self._heard, self._client.status
        if status not in ("running", "connecting"):
            raise Lost(f"the connection to the scheduler was lost ({status})")
        if silent > SILENCE:
            whose = "the scheduler does not answer" if self.workers else "no worker is left"
            raise Lost(f"{whose}: no sign of life of a worker for {silent:.0f} s")

    def stop(self) -> None:
        self._ended.set()


class Cluster:
    """Units done by the workers of a Dask scheduler."""

    def __init__(self, work: Work, address: str) -> None:
        """Connect to a scheduler. Raises `Lost` if it cannot be reached or has no worker."""
        try:
            import distributed
        except ImportError:
            raise Lost(lacking("--scheduler", "cluster", "distributed")) from None
        self._work, self._name = Sent(work, version("raycert")), uuid4().hex[:8]
        self._client: Any = None
        try:
            connect: Any = distributed.Client
            self._client = connect(address, timeout=CONNECT, set_as_default=False)
            self._client.wait_for_workers(1, timeout=CONNECT)
        except Exception as error:  # of whatever answers there, or does not
            self._disconnect()
            raise Lost(f"no Dask worker at {address!r}: {error or type(error).__name__}") from None
        self._heart = Heart(self._client)
        self._tasks: dict[int, tuple[Any, Unit, int]] = {}

    @property
    def places(self) -> int:
        """Return how many workers there are now; at least 1, for more may come."""
        return max(self._heart.workers, 1)

    def submit(self, unit: Unit, attempt: int = 1) -> None:
        """Begin a unit. Raises `Lost`."""
        self._heart.check()
        key = f"raycert-hunt-{self._name}-{unit.number}-{attempt}"
        try:
            future = self._client.submit(self._work, unit, key=key, pure=False)
        except Exception as error:
            raise Lost(f"the scheduler takes no work: {error}") from None
        self._tasks[unit.number] = future, unit, attempt

    def finished(self, seconds: float) -> list[Haul]:
        """Return results that have come; only without any is raised what is wrong."""
        end = time.monotonic() + seconds
        while not (results := self._results()):
            self._heart.check()
            if self._client.status == "running":
                self._again()
            if time.monotonic() > end:
                break
            time.sleep(POLL)
        return results

    def _results(self) -> list[Haul]:
        """Return the results that are there; one that was lost on its way is done again by Dask."""
        results: list[Haul] = []
        for future, unit, _ in list(self._tasks.values()):
            if future.status == "finished":
                try:
                    results.append(future.result(timeout=GATHER))
                    del self._tasks[unit.number]
                except (TimeoutError, CancelledError):
                    continue
                except Exception as error:
                    if future.status == "finished" and not results:
                        _raise(error)
        return results

    def _again(self) -> None:
        """Submit units whose workers were lost again. Raises what the work itself raised."""
        for future, unit, attempt in list(self._tasks.values()):
            if future.status not in ("error", "cancelled", "lost"):
                continue
            error = future.exception(timeout=GATHER) if future.status == "error" else None
            _raise(error)
            if attempt == ATTEMPTS:
                what = f"unit {unit.number} was lost {ATTEMPTS} times"
                raise Lost(f"{what}: {error or future.status}")
            self.submit(unit, attempt + 1)

    def close(self) -> None:
        """Drop what is under way, and leave the cluster running."""
        self._heart.stop()
        self._disconnect()

    def _disconnect(self) -> None:
        with suppress(Exception):  # a scheduler that is gone hears no good-bye
            self._client.close(timeout=GATHER)


def _raise(error: BaseException | None) -> None:
    """Raise what the work raised, unless its worker was killed; `Lost` where it was not read."""
    if isinstance(error, ImportError | PickleError) or "deserializ" in str(error):
        raise Lost(f"the cluster has another raycert, or none: {error}")
    if error is not None and type(error).__name__ != "KilledWorker":
        raise error
