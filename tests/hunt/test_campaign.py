"""A handful of the zoo's faults, found within a count and made small: the whole is a command."""

import pytest

from raycert.oracle.hunt.search import Budget
from raycert.oracle.zoo.inhabitants import BY_NAME
from shared.hunt_campaign import UNIT, form, line, longest, trial

QUICK = ("no-clip", "tolerant-disc", "small-disc", "expanded", "tangents-dropped", "overflow")


@pytest.mark.parametrize("name", QUICK)
def test_a_fault_is_found_and_its_case_is_small(name):
    tried = trial(BY_NAME[name], Budget(cases=6 * UNIT, most=1, unit=UNIT))
    assert tried.finding, name
    assert tried.is_small, tried.finding.probe
    assert longest(tried.finding.probe) <= 12
    assert name in line(tried)
    assert form(tried)["found"]
