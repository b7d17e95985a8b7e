"""The pipe is timed over the very lines that a client is asked, and only where it answers all."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from raycert.cases.model import Cylinder, Ray
from raycert.oracle.client.dialogue import Question
from raycert.oracle.measure.pipe import PipeTiming, asked, time_pipe
from shared.corpus import golden

CLIENTS = Path(__file__).parents[1] / "clients"
TRIVIAL = [sys.executable, str(CLIENTS / "trivial.py")]
QUESTIONS = [Question(row.id, row.solid, row.ray) for row in golden().rows[::20]]


def test_the_lines_are_a_hello_and_the_questions() -> None:
    hello, *lines = map(json.loads, asked(TRIVIAL, QUESTIONS[:9]).splitlines())
    assert hello == {"hello": 1}
    assert [line["ray"]["origin"] for line in lines] == [
        list(question.ray.origin) for question in QUESTIONS[:9]
    ]


def test_a_client_is_timed_both_ways() -> None:
    timing = time_pipe(TRIVIAL, QUESTIONS, repeats=2)
    assert timing.bare > 0
    assert timing.piped > 0
    assert PipeTiming(2.0, 3.0).ratio == 1.5


def test_a_client_that_fails_is_not_timed() -> None:
    can = Cylinder((0, 0, 0), (0, 0, 1), 1)
    counted = [Question(str(n), can, Ray((n, 0, 0), (0, 0, 1))) for n in range(6)]
    faulty = [sys.executable, str(CLIENTS / "raw.py"), "no-id"]
    with pytest.raises(ValueError, match="fails on some"):
        time_pipe(faulty, counted, repeats=1)
