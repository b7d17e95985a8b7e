"""Results are counted once, and given out in the order of their numbers."""

from raycert.oracle.hunt.unit import Haul, Ledger, Worst


def done(number, tried=10):
    return Haul(number, tried, Worst(), ())


def test_a_result_that_comes_twice_counts_once():
    ledger = Ledger()
    assert ledger.add(done(0))
    assert not ledger.add(done(0))
    assert ledger.tried == 10
    assert [r.number for r in ledger.in_order()] == [0]
    assert list(ledger.in_order()) == []


def test_early_results_wait_for_the_ones_before():
    ledger = Ledger()
    for number in (2, 1):
        ledger.add(done(number))
        assert list(ledger.in_order()) == []
    ledger.add(done(0))
    assert [r.number for r in ledger.in_order()] == [0, 1, 2]


def test_the_rest_is_given_out_at_the_end():
    ledger = Ledger()
    for number in (0, 3, 5):
        ledger.add(done(number))
    assert [r.number for r in ledger.in_order()] == [0]
    assert [r.number for r in ledger.rest()] == [3, 5]
    assert list(ledger.rest()) == []
