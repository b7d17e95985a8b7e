"""Signals that ask a run to end, taken in one way by every command, and what ends with it.

SIGTERM, SIGHUP and SIGQUIT mean what SIGINT means: a `KeyboardInterrupt` in the main thread, once.
A second one soon after changes nothing; a third ends the process where it stands.

    taken          what a command runs in; a signal that was ignored before stays ignored
    held           a signal waits until here is left: something is being written, started, ended
    interruptible  a part of what is held that a signal may cut, since what it knew is kept
    AT_LAST        what is called before the process ends, also where it ends at once

In a library nothing is `taken`: signals are the host's, and `held` is without effect.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Literal, NoReturn

Mode = Literal["open", "held", "interruptible"]

NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT")
SIGNALS = tuple(signal.Signals[name] for name in NAMES if hasattr(signal, name))
PATIENCE = 1.0
"""Seconds after the first signal in which a second one is the same wish."""
AT_LAST: list[Callable[[], None]] = []


class _State:
    """What has come so far; only the main thread changes it."""

    def __init__(self, alone: bool = False) -> None:
        self.alone = alone
        self.mode: Mode = "open"
        self.count = 0
        self.first: int = signal.SIGINT
        self.when = 0.0
        self.waits = False


_state = _State()


def status() -> int:
    """Return the exit status of a process that a signal has ended, as shells have it."""
    return 128 + _state.first


def alone() -> bool:
    """Whether this process is a command of raycert and nothing else."""
    return _state.alone


@contextmanager
def taken(alone: bool = False) -> Iterator[None]:
    """Take the signals, in the main thread.

    Where the process is `alone`, a command and nothing else, AT_LAST is called at the end, and from
    there on the signals are ignored: what is left is to exit with the status that there is.
    Otherwise the handlers are again as before.
    """
    global _state
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {each: signal.getsignal(each) for each in SIGNALS}
    ours = {each: old for each, old in before.items() if old not in (signal.SIG_IGN, None)}
    _state = _State(alone)
    for each in ours:
        signal.signal(each, _take)
    try:
        yield
    finally:
        _state.mode = "held"
        for call in AT_LAST if alone else ():
            call()
        for each, old in ours.items():
            signal.signal(each, signal.SIG_IGN if alone else old)
        _state = _State()


def _take(number: int, _: FrameType | None) -> None:
    _state.count += 1
    if _state.count > 2:
        _end_at_once(number)
    if _state.count == 1:
        _state.first, _state.when = number, time.monotonic()
    late = time.monotonic() - _state.when > PATIENCE
    if _state.mode == "held":
        _state.waits = _state.waits or _state.count == 1
    elif _state.count == 1 or (_state.mode == "interruptible" and late):
        raise KeyboardInterrupt


def _end_at_once(number: int) -> NoReturn:
    for call in AT_LAST:
        call()
    if sys.stderr is not None and sys.stderr.isatty():
        os.write(2, b"\x1b[?25h")  # a progress bar has hidden the cursor
    os._exit(128 + number)


@contextmanager
def held() -> Iterator[None]:
    """Let signals wait; the one that came is raised at the end, where all went well."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before, _state.mode = _state.mode, "held"
    try:
        yield
    finally:
        _state.mode = before
    _raise_waiting()


@contextmanager
def interruptible() -> Iterator[None]:
    """Let signals be raised in what is held; one that has waited is raised at once."""
    if _state.mode == "open" or threading.current_thread() is not threading.main_thread():
        yield
        return
    before, _state.mode = _state.mode, "interruptible"
    try:
        _raise_waiting()
        yield
    finally:
        _state.mode = before


def _raise_waiting() -> None:
    if _state.waits and _state.mode != "held":
        _state.waits = False
        raise KeyboardInterrupt
