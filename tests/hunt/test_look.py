"""The cheap look says what the grade says, on every kind of answer; and what is no failure."""

from dataclasses import replace
from math import inf

import pytest

from raycert.cases.domain import Domain
from raycert.cases.levels import LEVELS
from raycert.cases.model import HalfSpace, Ray, Sphere, Union
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.certify.grading import grade
from raycert.oracle.client.process import Failure
from raycert.oracle.hunt.look import Criterion, Looker, Observation
from raycert.oracle.zoo.inhabitants import BY_NAME
from raycert.oracle.zoo.matrix import Outcome
from raycert.oracle.zoo.tracer import BASE
from shared.corpus import golden

ROWS = [row for row in golden().rows if row.tier in ("generic", "stiff")][::97]
HELLO = Hello("test")
TOUCHING = Probe(Sphere((0, 0, 0), 1), Ray((-3, 1, 0), (1, 0, 0)))
BALL = Probe(Sphere((0, 0, 0), 1), Ray((-3, 0, 0), (1, 0, 0)))
FAULTS = ("no-clip", "tolerant-disc", "small-disc", "far-clip", "six-digits", "split", "expanded")


def answers(tracer, row):
    pairs = Outcome.of(tracer, row, HELLO.format).answer
    return Reply("", intervals=pairs) if pairs is not None else Reply("", error="none")


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("name", FAULTS)
def test_a_look_agrees_with_the_grade(name, level):
    looker, tracer = Looker(HELLO, Criterion(level, far=True)), BY_NAME[name].make()
    upto = LEVELS[: LEVELS.index(level) + 1]
    for row in ROWS:
        reply = answers(tracer, row)
        graded = grade(row, reply, HELLO)
        wanted = next((one for one in upto if graded.fault(one)), None)
        fault = looker(Probe(row.solid, row.ray), reply).flaw
        assert (fault and fault.level) == wanted, row.id


def test_a_sound_tracer_shows_nothing_and_its_k_is_small():
    looker = Looker(HELLO, Criterion())
    for row in ROWS:
        seen = looker(Probe(row.solid, row.ray), answers(BASE, row))
        assert seen.flaw is None
        assert seen.k <= 64


def test_a_failure_of_the_process_is_a_failure_of_the_case():
    seen = Looker(HELLO, Criterion())(BALL, Failure("hang", "silent for 5 s"))
    assert (seen.flaw.kind, seen.k) == ("hang", inf)
    seen = Looker(HELLO, Criterion())(BALL, Reply("", error="ValueError: x"))
    assert seen.flaw.kind == "error"


def test_a_dropped_touch_counts_only_against_a_convention_that_is_asked_for():
    dropped = Reply("", intervals=())
    assert Looker(HELLO, Criterion())(TOUCHING, dropped).flaw is None
    assert Looker(HELLO, Criterion(convention="regularized"))(TOUCHING, dropped).flaw is None
    fault = Looker(HELLO, Criterion(convention="closed"))(TOUCHING, dropped).flaw
    assert (fault.level, fault.kind) == ("convention", "touch dropped")
    kept = Reply("", intervals=((3.0, 3.0),))
    fault = Looker(HELLO, Criterion(convention="regularized"))(TOUCHING, kept).flaw
    assert fault.kind == "touch kept"


@pytest.mark.parametrize(
    ("answers_", "reply", "kind"),
    [
        ("first", Reply("", first=None), "missed"),
        ("first", Reply("", first=3.0), "wrong end"),
        ("first", Reply("", first=2.0), None),
        ("any", Reply("", hit=False), "missed"),
        ("any", Reply("", hit=True), None),
    ],
)
def test_first_hits_and_yes_or_no_are_looked_at_too(answers_, reply, kind):
    fault = Looker(Hello("test", answers=answers_), Criterion())(BALL, reply).flaw
    assert (fault and fault.kind) == kind


def test_where_nothing_has_a_size_a_touch_is_a_convention_too():
    nothing = Ray((0, 0, 0), (1, 0, 0))
    for solid in (Sphere((0, 0, 0), 0), HalfSpace((0, 0, 0), (0, 0, 1))):
        for probe in (Probe(solid, nothing), Probe(Union((solid, solid)), nothing)):
            assert Looker(HELLO, Criterion())(probe, Reply("", intervals=())).flaw is None


def test_only_declared_and_wanted_types_are_asked():
    union = Probe(Union((BALL.solid, HalfSpace((0, 0, 0), (0, 0, 1)))), BALL.ray)
    assert Looker(HELLO, Criterion()).wants(union)
    assert not Looker(Hello("test", solids=("sphere", "union")), Criterion()).wants(union)
    assert not Looker(HELLO, Criterion(), ("sphere", "union")).wants(union)
    assert Looker(HELLO, Criterion(), ("sphere",)).wants(BALL)
    resting = BALL._replace(ray=Ray((0, 0, 0), (0, 0, 0)))
    bold = replace(HELLO, degenerate=("zero_direction",))
    assert not Looker(HELLO, Criterion()).wants(resting)
    assert Looker(bold, Criterion()).wants(resting)
    assert not Looker(replace(HELLO, domain=Domain(size=(None, 1e-9))), Criterion()).wants(BALL)


def test_right_is_cheap_and_costs_no_k():
    assert Looker(HELLO, Criterion())(BALL, Reply("", intervals=((2.0, 4.0),))) == Observation()
