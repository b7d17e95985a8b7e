"""Processes of a Dask cluster, forked from one that has loaded Dask: each starts in no time."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

FORKS = get_context("forkserver")
FORKS.set_forkserver_preload(["distributed", "raycert.oracle.hunt.pursuit"])
PATIENCE = 60.0


def start(kind: Callable[..., object], *words: str) -> tuple[BaseProcess, str]:
    """Start a process of the cluster; return it and its address."""
    said, says = FORKS.Pipe(duplex=False)
    process = FORKS.Process(target=kind, args=(says, *words), daemon=True)
    process.start()
    says.close()
    with said:
        assert said.poll(PATIENCE)
        return process, said.recv()


def scheduler(says: Connection) -> None:
    from distributed import Scheduler

    _serve(says, lambda: Scheduler(host="127.0.0.1", port=0, dashboard=False))


def worker(says: Connection, address: str) -> None:
    from distributed import Worker

    _serve(says, lambda: Worker(address, nthreads=1, dashboard=False))


def _serve(says: Connection, make: Callable[[], object]) -> None:
    async def main() -> None:
        server = await make()
        says.send(server.address)
        await server.finished()

    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    asyncio.run(main())
