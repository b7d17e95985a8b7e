"""Signals are taken once, wait where they have to, and are ignored where they were."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from raycert.cases import interrupts
from raycert.cases.interrupts import SIGNALS, held, interruptible, status, taken

pytestmark = pytest.mark.skipif(os.name != "posix", reason="other signals")


@contextmanager
def cut() -> Iterator[None]:
    """Hold that what is done here is interrupted."""
    with pytest.raises(KeyboardInterrupt):
        yield


@pytest.mark.parametrize("number", SIGNALS)
def test_each_interrupts_once_and_is_the_status(number: signal.Signals) -> None:
    before = [signal.getsignal(each) for each in SIGNALS]
    with taken():
        with cut():
            signal.raise_signal(number)
        signal.raise_signal(signal.SIGINT)
        assert status() == 128 + number
    assert [signal.getsignal(each) for each in SIGNALS] == before


def test_what_is_ignored_stays_ignored() -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with taken():
            signal.raise_signal(signal.SIGHUP)
            with cut():
                signal.raise_signal(signal.SIGTERM)
    finally:
        signal.signal(signal.SIGHUP, before)


def test_a_signal_waits_while_it_is_held() -> None:
    done = []
    with taken(), cut(), held():
        signal.raise_signal(signal.SIGTERM)
        with held():
            done.append("inner")
        done.append("outer")
    assert done == ["inner", "outer"]


def test_what_is_held_may_be_cut_where_it_says_so() -> None:
    with taken(), held():
        with cut(), interruptible():
            signal.raise_signal(signal.SIGTERM)
        with interruptible():
            signal.raise_signal(signal.SIGTERM)  # so soon it is the same wish


def test_a_signal_that_waited_cuts_the_next_such_part_before_it_begins() -> None:
    began = False
    with taken(), held():
        signal.raise_signal(signal.SIGTERM)
        with cut(), interruptible():
            began = True
    assert not began


def test_a_second_wish_is_another_one_after_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    with taken(), held():
        with cut(), interruptible():
            signal.raise_signal(signal.SIGINT)
        with interruptible():
            monkeypatch.setattr(interrupts, "PATIENCE", 0.0)
            with cut():
                signal.raise_signal(signal.SIGINT)


def test_a_third_ends_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    ends: list[object] = []

    def end(number: int) -> None:
        ends.append(number)
        raise SystemExit

    monkeypatch.setattr(interrupts, "AT_LAST", [lambda: ends.append("last")])
    monkeypatch.setattr(os, "_exit", end)
    with taken(), cut(), held():  # cut at the end, for here it goes on
        signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGTERM)
        with pytest.raises(SystemExit):
            signal.raise_signal(signal.SIGHUP)
    assert ends == ["last", 128 + signal.SIGHUP]


def test_other_threads_hold_nothing() -> None:
    inside, over = threading.Event(), threading.Event()

    def work() -> None:
        with taken(), held(), interruptible(), held():
            inside.set()
            over.wait(5)

    with taken():
        thread = threading.Thread(target=work)
        thread.start()
        inside.wait(5)
        with cut():
            signal.raise_signal(signal.SIGINT)
        over.set()
        thread.join()


def test_in_a_library_the_signals_are_the_hosts() -> None:
    with cut(), held():
        signal.raise_signal(signal.SIGINT)
        pytest.fail("it waited")
