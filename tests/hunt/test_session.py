"""A session goes on after crashes and hangs, and pins each on its question."""

import sys
from pathlib import Path

import pytest

from raycert.cases.model import Ray, Sphere
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Reply
from raycert.oracle.client.dialogue import Command, Limits, Unusable
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import Changed
from raycert.oracle.hunt.unit import Clock, Session, TimeUp
from shared.places import CLIENTS

BALL = Sphere((0, 0, 0), 1)
PROBES = [Probe(BALL, Ray((float(x), 0, 0), (1, 0, 0))) for x in (-3, 7, -2, 5, 7, -4)]


def check(outcomes, kind):
    assert [isinstance(outcome, Failure) for outcome in outcomes] == [
        s.ray.origin[0] == 7 for s in PROBES
    ]
    assert {outcome.kind for outcome in outcomes if isinstance(outcome, Failure)} == {kind}
    assert outcomes[0].intervals == ((2.0, 4.0),)
    assert outcomes[5].intervals == ((3.0, 5.0),)


def test_a_crash_is_pinned_and_all_else_is_answered():
    session = Session(InProcess("callable", "shared.hunted_targets:crashing"), Limits())
    check(session.ask(PROBES), "crash")
    check(session.fresh(PROBES), "crash")
    session.close()


def test_a_hang_is_pinned_and_all_else_is_answered():
    session = Session(InProcess("callable", "shared.hunted_targets:hanging"), Limits(case=0.3))
    check(session.ask(PROBES), "hang")
    session.close()


def test_a_program_is_asked_in_the_same_way():
    session = Session(Command((sys.executable, "-m", "raycert.reference")), Limits())
    assert session.hello.name
    outcomes = session.ask(PROBES)
    assert all(isinstance(outcome, Reply) for outcome in outcomes)
    assert outcomes == session.ask(PROBES)
    session.close()


def test_the_time_is_kept():
    session = Session(
        InProcess("callable", "raycert.reference.tracer:intersect"), Limits(), Clock.of(-1)
    )
    with pytest.raises(TimeUp):
        session.ask(PROBES)
    session.close()


def test_what_cannot_be_run_says_so():
    with pytest.raises(Unusable):
        _ = Session(InProcess("callable", "no_such_module:x"), Limits()).hello


def test_a_target_that_becomes_another_ends_the_session(tmp_path: Path):
    used = tmp_path / "used"
    client = (sys.executable, str(CLIENTS / "once.py"), str(used), "another")
    session = Session(Command(client), Limits())
    assert session.hello.name == "planted"
    with pytest.raises(Changed, match="another"):
        session.fresh(PROBES)
    assert used.exists()
    session.close()
