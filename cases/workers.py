"""Processes of ours that work side by side, for one that waits for them."""

from __future__ import annotations

import atexit
import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context, parent_process, resource_tracker
from types import FrameType
from typing import Any, ParamSpec, TypeVar

from raycert.cases.interrupts import AT_LAST, SIGNALS, held

Parameters = ParamSpec("Parameters")
_ending = threading.Lock()
Result = TypeVar("Result")


class Workers(ProcessPoolExecutor):
    """So many processes of this machine, for work that can be imported there.

    A terminal sends its signals to them too, but they are for who waits: workers ignore them. They
    end with this process, however it ends. Leaving the context drops what is under way. Each calls
    `first`, with the arguments, before all work.
    """

    def __init__(
        self, count: int, first: Callable[..., object] | None = None, *arguments: object
    ) -> None:
        with _blocked():
            if os.name == "posix":  # its helper would not survive SIGHUP
                resource_tracker.ensure_running()
            begin = partial(_begin, first, *arguments)
            super().__init__(count, get_context("spawn"), begin)

    def submit(
        self,
        fn: Callable[Parameters, Result],
        /,
        *args: Parameters.args,
        **kwargs: Parameters.kwargs,
    ) -> Future[Result]:
        """Submit a call; the process that it may start is not interrupted while it starts."""
        with _blocked():
            return super().submit(fn, *args, **kwargs)

    def end(self) -> None:
        """End the processes, and those that they started, whatever they do."""
        for process in list((self._processes or {}).values()):
            process.terminate()
        self.shutdown(wait=True, cancel_futures=True)

    def __exit__(self, *_: Any) -> None:
        with held():
            self.end()


@contextmanager
def _blocked() -> Iterator[None]:
    """Block the signals for what is started here, until it unblocks them itself."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin(first: Callable[..., object] | None = None, *arguments: object) -> None:
    """Begin a worker: deaf to a terminal, ended by its parent's word or death."""
    for each in SIGNALS:  # the parent's word may wait already: to ignore it even for now drops it
        signal.signal(each, _end_worker if each == signal.SIGTERM else signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    if first:
        first(*arguments)


def _end_worker(number: int, _: FrameType | None = None) -> None:
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # a second one would cut this short
    _ending.acquire()  # for good: the parent's word and its death may come together
    for call in AT_LAST:
        call()
    atexit._run_exitfuncs()  # temporary folders
    os._exit(128 + number)


def _end_with_parent() -> None:
    parent = parent_process()
    assert parent is not None
    parent.join()
    _end_worker(signal.SIGTERM)
