"""What is done to degenerate inputs is told in words, of the client that does it only."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import grade
from raycert.oracle.certify.habits import habits
from raycert.oracle.client.process import Failure
from shared.corpus import golden

ROWS = [row for row in golden().rows if row.family == "zero-direction"][::4]
HELLO = Hello("x")


def right(row: GoldenRow) -> Reply:
    return Reply(row.id, intervals=row.expected)


def told(say: Callable[[GoldenRow], Reply | Failure], hello: Hello = HELLO) -> str:
    return "; ".join(habits([grade(row, say(row), hello) for row in ROWS]))


NAN = Reply("", intervals=((math.nan, math.nan),))


@pytest.mark.parametrize(
    ("outcome", "says"),
    [
        (NAN, "with a direction of zero: it always answers NaN (part of no level"),
        (Reply("", intervals=()), "mostly misses what it starts in"),
        (Reply("", error="no direction"), "always ends in error: no direction"),
        (Failure("crash", "SIGFPE"), "always ends in crash: SIGFPE"),
    ],
)
def test_a_habit_is_told(outcome: Reply | Failure, says: str) -> None:
    text = told(lambda row: outcome)
    assert says in text or says.replace("mostly", "always") in text
    assert text.startswith(("sphere, cylinder", "cylinder"))


def test_who_is_right_has_none() -> None:
    assert told(right) == ""


def test_what_is_declared_is_part_of_a_level() -> None:
    text = told(lambda row: NAN, Hello("x", degenerate=("zero_direction",)))
    assert "answers NaN" in text
    assert "no level" not in text


def test_failures_of_all_sorts_are_no_habit() -> None:
    outcomes = NAN, Reply("", error="a"), Reply("", error="b"), Reply("", error="c")
    spheres = [row for row in golden().rows if row.family == "zero-direction"]
    spheres = [row for row in spheres if "sphere" in row.id][:8]
    turns = {row.id: outcomes[n % 4] for n, row in enumerate(spheres)}
    assert habits([grade(row, turns[row.id], HELLO) for row in spheres]) == []


def test_what_is_done_to_all_inputs_is_no_habit_of_degenerate_ones() -> None:
    plain = [row for row in golden().rows if row.family == "table-through"][:20]
    refused = Reply("", error="no cylinders")
    grades = [grade(row, refused, HELLO) for row in (*ROWS, *plain)]
    assert not [text for text in habits(grades) if text.startswith("cylinder")]
