"""Executors do every unit, and a lost worker's again; nothing is lost, nothing counted twice."""

from functools import partial

import pytest

from raycert.oracle.hunt.executors import ATTEMPTS, Here, Lost, Processes
from raycert.oracle.hunt.unit import Ledger, Unit
from shared.hunted_work import deadly, deadly_once, easy, wrong


def collected(executor, count):
    ledger, waiting = Ledger(), [Unit(number, 10 + number) for number in range(count)]
    under_way = 0
    try:
        while len(ledger.results) < count:
            while waiting and under_way < executor.places:
                executor.submit(waiting.pop(0))
                under_way += 1
            for result in executor.finished(5.0):
                assert ledger.add(result)
                under_way -= 1
    finally:
        executor.close()
    return ledger


@pytest.mark.parametrize("make", [Here, lambda work: Processes(work, 2)], ids=["here", "processes"])
def test_every_unit_is_done_once(make):
    ledger = collected(make(easy), 8)
    assert sorted(ledger.results) == list(range(8))
    assert ledger.tried == sum(10 + number for number in range(8))


def test_what_a_killed_process_was_at_is_done_again(tmp_path):
    ledger = collected(Processes(partial(deadly_once, str(tmp_path)), 2), 8)
    assert (tmp_path / "died").exists()
    assert sorted(ledger.results) == list(range(8))
    assert ledger.tried == sum(10 + number for number in range(8))


def test_work_that_always_kills_is_given_up():
    with pytest.raises(Lost, match=str(ATTEMPTS + 1)):
        collected(Processes(deadly, 1), 1)


@pytest.mark.parametrize("make", [Here, lambda work: Processes(work, 1)], ids=["here", "processes"])
def test_a_fault_of_the_work_is_raised(make):
    with pytest.raises(ValueError, match="ours"):
        collected(make(wrong), 1)
