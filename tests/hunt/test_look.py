"""The cheap look says what the grade says, on every kind of answer; and what is no failure."""

from math import inf

import pytest

from raycert.cases.corpus import read_corpus
from raycert.cases.levels import LEVELS
from raycert.cases.model import HalfSpace, Ray, Sphere, Union
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.certify.grading import grade
from raycert.oracle.client.process import Failure
from raycert.oracle.hunt.look import RIGHT, Asked, Looker
from raycert.oracle.zoo.inhabitants import BY_NAME
from raycert.oracle.zoo.matrix import Outcome
from raycert.oracle.zoo.tracer import BASE

ROWS = [row for row in read_corpus().rows if row.tier in ("generic", "stiff")][::97]
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
    looker, tracer = Looker(HELLO, Asked(level, far=True)), BY_NAME[name].make()
    upto = LEVELS[: LEVELS.index(level) + 1]
    for row in ROWS:
        reply = answers(tracer, row)
        graded = grade(row, reply, HELLO)
        wanted = next((one for one in upto if graded.fault(one)), None)
        fault = looker(Probe(row.solid, row.ray), reply).fault
        assert (fault and fault.level) == wanted, row.id


def test_a_sound_tracer_shows_nothing_and_its_k_is_small():
    looker = Looker(HELLO, Asked())
    for row in ROWS:
        seen = looker(Probe(row.solid, row.ray), answers(BASE, row))
        assert seen.fault is None
        assert seen.k <= 64


def test_a_failure_of_the_process_is_a_failure_of_the_case():
    seen = Looker(HELLO, Asked())(BALL, Failure("hang", "silent for 5 s"))
    assert (seen.fault.kind, seen.k) == ("hang", inf)
    seen = Looker(HELLO, Asked())(BALL, Reply("", error="ValueError: x"))
    assert seen.fault.kind == "error"


def test_a_dropped_touch_counts_only_against_a_convention_that_is_asked_for():
    dropped = Reply("", intervals=())
    assert Looker(HELLO, Asked())(TOUCHING, dropped).fault is None
    assert Looker(HELLO, Asked(convention="regularized"))(TOUCHING, dropped).fault is None
    fault = Looker(HELLO, Asked(convention="closed"))(TOUCHING, dropped).fault
    assert (fault.level, fault.kind) == ("convention", "touch dropped")
    kept = Reply("", intervals=((3.0, 3.0),))
    fault = Looker(HELLO, Asked(convention="regularized"))(TOUCHING, kept).fault
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
    fault = Looker(Hello("test", answers=answers_), Asked())(BALL, reply).fault
    assert (fault and fault.kind) == kind


def test_where_nothing_has_a_size_a_touch_is_a_convention_too():
    nothing = Ray((0, 0, 0), (1, 0, 0))
    for solid in (Sphere((0, 0, 0), 0), HalfSpace((0, 0, 0), (0, 0, 1))):
        for probe in (Probe(solid, nothing), Probe(Union((solid, solid)), nothing)):
            assert Looker(HELLO, Asked())(probe, Reply("", intervals=())).fault is None


def test_only_declared_and_wanted_types_are_asked():
    union = Probe(Union((BALL.solid, HalfSpace((0, 0, 0), (0, 0, 1)))), BALL.ray)
    assert Looker(HELLO, Asked()).wants(union)
    assert not Looker(Hello("test", solids=("sphere", "union")), Asked()).wants(union)
    assert not Looker(HELLO, Asked(), ("sphere", "union")).wants(union)
    assert Looker(HELLO, Asked(), ("sphere",)).wants(BALL)


def test_right_is_cheap_and_costs_no_k():
    assert Looker(HELLO, Asked())(BALL, Reply("", intervals=((2.0, 4.0),))) == RIGHT
