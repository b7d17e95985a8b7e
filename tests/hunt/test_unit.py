"""A unit is the same wherever and however often it is done, and keeps its budget."""

import time
from dataclasses import replace
from math import inf

import pytest

from raycert.cases.model import types
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.hunt.look import Criterion
from raycert.oracle.hunt.pursuit import work
from raycert.oracle.hunt.unit import EACH, Job, Unit, coarse
from shared.hunted_targets import spec

FAULTY = Job(InProcess("callable", spec("padded-radius")), golden=None)
SOUND = Job(InProcess("callable", "raycert.reference.tracer:intersect"))


@pytest.mark.parametrize("number", [0, 1], ids=["directed", "drawn"])
def test_a_unit_done_again_gives_the_same(number):
    unit = Unit(number, 120)
    first = work(FAULTY, unit)
    assert first == work(FAULTY, unit)
    assert first.failures
    assert first.worst.k > 64
    assert 0 < first.tried <= 120
    assert work(FAULTY, Unit(number + 3, 120)).failures != first.failures


def test_each_coarse_cause_is_kept_a_few_times():
    failures = work(FAULTY, Unit(0, 400)).failures
    keys = [coarse(suspect) for suspect in failures]
    assert 1 < max(keys.count(key) for key in keys) <= EACH


@pytest.mark.parametrize("number", [0, 1], ids=["directed", "drawn"])
def test_the_time_ends_a_unit(number):
    began = time.monotonic()
    done = work(replace(SOUND, golden=None), Unit(number, 10**6, 2.0))
    assert done.cut
    assert done.tried > 0
    assert time.monotonic() - began < 20


@pytest.mark.parametrize("number", [0, 1], ids=["directed", "drawn"])
def test_only_what_is_wanted_is_asked(number):
    job = replace(FAULTY, solids=("sphere",))
    failures = work(job, Unit(number, 400)).failures
    assert {kind for suspect in failures for kind in types(suspect.probe.solid)} == {"sphere"}


def test_only_trees_without_a_leaf_is_nothing_to_ask():
    assert work(replace(SOUND, solids=("union",)), Unit(0, 100)).tried == 0


def test_the_range_is_asked_only_if_it_is_wanted():
    job = Job(InProcess("callable", spec("overflow")), golden=None)
    assert not work(job, Unit(0, 300)).failures
    assert work(replace(job, criterion=Criterion(far=True)), Unit(0, 300)).failures


def test_the_reference_is_stable_in_a_few():
    for number in (0, 1):
        done = work(SOUND, Unit(number, 300))
        assert not done.failures
        assert done.worst.k < inf


def test_examples_are_kept_and_tried_first(tmp_path):
    job = Job(InProcess("callable", spec("always-all")), golden=None, seed=1)
    assert work(job, Unit(1, 400)).failures[0].before, "the first probe drawn is no failure"
    kept = replace(job, seed=0, examples=tmp_path / "examples")
    assert work(kept, Unit(1, 400)).failures
    assert any((tmp_path / "examples").iterdir())
    again = work(replace(kept, seed=1), Unit(1, 400))
    assert not again.failures[0].before, "a kept example is the first"
