"""A real Dask cluster of two workers, one of which is killed in the middle of its work.

Nothing is lost, nothing is counted twice, and the hunt finds what it finds here.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pytest

from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.hunt import executors
from raycert.oracle.hunt.executors import Cluster, Here, Lost
from raycert.oracle.hunt.pursuit import work
from raycert.oracle.hunt.search import Budget, hunt
from raycert.oracle.hunt.unit import Haul, Job, Ledger, Unit, Worst
from shared.hunted_targets import spec

pytest.importorskip("distributed", reason='needs pip install "raycert[cluster]"')
pytestmark = pytest.mark.filterwarnings("default")  # those of Dask are its own

START = {
    "scheduler": (
        "import asyncio, sys\n"
        "from distributed import Scheduler\n"
        "async def main():\n"
        "    s = await Scheduler(host='127.0.0.1', port=0, dashboard=False)\n"
        "    print(s.address, flush=True)\n"
        "    await s.finished()\n"
        "asyncio.run(main())\n"
    ),
    "worker": (
        "import asyncio, sys\n"
        "from distributed import Worker\n"
        "async def main():\n"
        "    w = await Worker(sys.argv[1], nthreads=1, dashboard=False)\n"
        "    print(w.address, flush=True)\n"
        "    await w.finished()\n"
        "asyncio.run(main())\n"
    ),
}


def start(kind: str, *words: str) -> subprocess.Popen[str]:
    """Start a process of the cluster, which says its address."""
    command = [sys.executable, "-c", START[kind], *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    return subprocess.Popen(command, text=True, **pipes)


class Started(NamedTuple):
    """A cluster: the address of the scheduler, the workers, the scheduler."""

    address: str
    workers: list[subprocess.Popen[str]]
    scheduler: subprocess.Popen[str]


@pytest.fixture
def cluster() -> Iterator[Started]:
    """Yield a cluster of two workers."""
    scheduler = start("scheduler")
    address = scheduler.stdout.readline().strip()
    workers = [start("worker", address) for _ in range(2)]
    for worker in workers:
        worker.stdout.readline()
    yield Started(address, workers, scheduler)
    for process in (*workers, scheduler):
        process.kill()
        process.wait()
        process.stdout.close()


def slow(folder: str, unit: Unit) -> Haul:
    """Take a while, and leave a mark each time the unit is begun."""
    with open(Path(folder) / f"{unit.number}", "a") as file:
        file.write(f"{os.getpid()}\n")
    time.sleep(0.4)
    return Haul(unit.number, unit.cases, Worst(), ())


def test_a_worker_that_dies_loses_nothing_and_nothing_counts_twice(cluster, tmp_path):
    address, workers, _ = cluster
    executor, ledger = Cluster(partial(slow, str(tmp_path)), address), Ledger()
    units, killed = [Unit(number, 10 + number) for number in range(12)], False
    assert executor.places == 2
    for unit in units:
        executor.submit(unit)
    while len(ledger.results) < len(units):
        for result in executor.finished(10.0):
            assert ledger.add(result)
        if ledger.results and not killed:
            time.sleep(0.2)  # both workers are in the middle of a unit
            workers[0].send_signal(signal.SIGKILL)
            killed = True
    executor.close()
    assert killed
    begun = {unit.number: (tmp_path / f"{unit.number}").read_text().split() for unit in units}
    assert any(len(pids) > 1 for pids in begun.values()), "no unit was begun again"
    assert sorted(ledger.results) == list(range(12))
    assert ledger.tried == sum(unit.cases for unit in units)


def test_a_hunt_on_a_cluster_that_loses_a_worker_finds_what_it_finds_here(cluster):
    address, workers, _ = cluster
    job = Job(InProcess("callable", spec("padded-radius")), golden=None)
    budget = Budget(cases=180, unit=60, most=2)
    alone = hunt(job, budget, Here(partial(work, job)))

    class Unlucky(Cluster):
        def finished(self, seconds):
            workers[1].send_signal(signal.SIGKILL)
            return super().finished(seconds)

    shared = hunt(job, budget, Unlucky(partial(work, job), address))
    assert alone.findings
    assert list(shared.findings) == list(alone.findings)
    for cause, finding in shared.findings.items():
        assert finding.probe == alone.findings[cause].probe


@pytest.fixture
def hasty(monkeypatch):
    """A heart that is not as patient as it is for people."""
    monkeypatch.setattr(executors, "BEAT", 0.1)
    monkeypatch.setattr(executors, "SILENCE", 1.5)
    monkeypatch.setattr(executors, "CONNECT", 5.0)
    monkeypatch.setattr(executors, "GATHER", 0.5)


def loss(executor: Cluster) -> str:
    """Return how an executor says that its cluster is lost."""
    with pytest.raises(Lost) as said:
        executor.finished(10.0)
    return str(said.value)


def test_a_cluster_that_is_lost_is_said(cluster, hasty, tmp_path):
    work = partial(slow, str(tmp_path))
    executor = Cluster(work, cluster.address)
    cluster.scheduler.send_signal(signal.SIGSTOP)
    assert "the scheduler does not answer" in loss(executor)
    executor.close()
    cluster.scheduler.send_signal(signal.SIGCONT)
    executor = Cluster(work, cluster.address)
    for worker in cluster.workers:
        worker.kill()
    executor.submit(Unit(1))
    deadline = time.monotonic() + 20
    while executor._heart.workers and time.monotonic() < deadline:
        time.sleep(0.05)  # a loaded scheduler takes a while to miss them
    assert "no worker is left" in loss(executor)
    executor.close()


def test_a_scheduler_that_is_killed_is_said(cluster, hasty, tmp_path):
    executor = Cluster(partial(slow, str(tmp_path)), cluster.address)
    executor.submit(Unit(0))
    cluster.scheduler.kill()
    assert "scheduler" in loss(executor)
    with pytest.raises(Lost):
        executor.submit(Unit(1))
    assert executor.places
    executor.close()


def test_a_cluster_that_is_not_there_is_said(monkeypatch):
    monkeypatch.setattr(executors, "CONNECT", 0.5)
    with pytest.raises(Lost, match=r"127\.0\.0\.1:9"):
        executors.Cluster(partial(slow, "."), "tcp://127.0.0.1:9")


def wrong(unit: Unit) -> Haul:
    raise ValueError("a fault of ours")


def test_a_fault_of_the_work_is_raised_and_another_version_is_said(cluster, monkeypatch):
    executor = Cluster(wrong, cluster.address)
    executor.submit(Unit(0))
    with pytest.raises(ValueError, match="ours"):
        executor.finished(60.0)
    executor.close()
    monkeypatch.setattr(executors, "version", lambda _: "0.0.1")
    executor = Cluster(wrong, cluster.address)
    executor.submit(Unit(0))
    with pytest.raises(Lost, match=r"and here is 0\.0\.1"):
        executor.finished(60.0)
    executor.close()
