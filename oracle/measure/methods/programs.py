"""The oracle, the reference tracer and clients as methods: called here, in batches, or spoken to.

The reference is found by the name of its module, as any target is. A client is asked through the
harness, which outlives its crashes; its time is that of a dialogue that has begun, from the first
question to the last answer: what it costs over the pipe.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from itertools import count
from time import perf_counter
from typing import Any

from raycert.cases.formats import BINARY64
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Reply
from raycert.oracle.client.dialogue import Dialogue, Limits, Question, Target, Unusable, fresh_ids
from raycert.oracle.client.process import Broken
from raycert.oracle.client.replay import run
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import trace
from raycert.oracle.measure.methods.method import (
    Answered,
    Case,
    Method,
    Solve,
    answered,
    one_by_one,
)

AHEAD = 256
"""The rays that a client is priced at, so that what a first answer waits for does not count."""


def exact(solid: Solid, ray: Ray) -> tuple[tuple[float, float], ...]:
    """Return the oracle's list, both ends of each pair correctly rounded."""
    return expected(trace(solid, ray).intervals, BINARY64)[1]


def called(name: str) -> Solve:
    """Return the `solve` of a function `module:function`, called directly."""
    module, _, function = name.partition(":")

    @cache
    def made() -> Solve:
        return one_by_one(getattr(import_module(module), function))

    return lambda cases: made()(cases)


def oracle_batch(cases: Sequence[Case]) -> list[Answered]:
    """Return the batch oracle's lists."""
    batches = import_module("raycert.oracle.measure.methods.vector.batches")
    trace_batch = import_module("raycert.oracle.batch.trace").trace_batch

    def solve(group: list[Case]) -> list[Answered]:
        found = trace_batch(group[0].solid, *batches.rays(group))
        return [answered(found.pairs(i)) for i in range(len(group))]

    answers: list[Answered] = batches.scattered(cases, lambda solid: solid, solve)
    return answers


def reference_batch(cases: Sequence[Case]) -> list[Answered]:
    """Return the reference tracer's lists, in lanes."""
    batches = import_module("raycert.oracle.measure.methods.vector.batches")
    intersect = import_module("raycert.reference.arrays.tracer").intersect

    def solve(group: list[Case]) -> list[Answered]:
        found = intersect(group[0].solid, *batches.rays(group))
        return [answered(found.pairs(i)) for i in range(len(group))]

    answers: list[Answered] = batches.scattered(cases, lambda solid: solid, solve)
    return answers


def batch_seconds(name: str) -> Callable[[Sequence[Case]], float]:
    """Return what times `module:function(solid, origins, directions)` over arrays."""
    module, _, function = name.partition(":")

    def timed(cases: Sequence[Case]) -> float:
        call: Any = getattr(import_module(module), function)
        measure: float = import_module("raycert.oracle.measure.methods.vector.timing").seconds(
            call
        )(cases)
        return measure

    return timed


def client(name: str, target: Target) -> Method:
    """Return a client as a method. Raises `Unusable` if it cannot start, or gives no lists."""
    began = target.open(Limits(), fresh_ids())
    began.kill()
    hello = began.hello
    if hello.answers != "intervals":
        raise Unusable(
            f"{name!r} answers {hello.answers!r}, one number or none. Errors of lists are compared "
            "here, and only a client that answers intervals gives them."
        )

    def solve(cases: Sequence[Case]) -> list[Answered]:
        try:
            outcomes = run(target, questions(cases)).outcomes
        except OverflowError:  # numbers that bit patterns of the client's precision cannot hold
            return [None] * len(cases)
        return [_list(outcome) for outcome in outcomes.values()]

    return Method(
        name,
        f"is the client {hello.name}, {hello.precision}",
        solve,
        frozenset(hello.solids),
        "client",
        lanes=AHEAD,
        timed=lambda cases: _seconds(target, cases),
    )


def questions(cases: Sequence[Case]) -> list[Question]:
    """Return the cases as the harness asks them."""
    return [Question(str(i), *case) for i, case in zip(count(), cases, strict=False)]


def _list(outcome: object) -> Answered:
    pairs = outcome.intervals if isinstance(outcome, Reply) else None
    return None if pairs is None else answered(pairs)


def _seconds(target: Target, cases: Sequence[Case]) -> float:
    """Return how long a client that has said hello takes; with its restarts, if it breaks off."""
    limits, asked = Limits(), questions(cases)
    dialogue = target.open(limits, fresh_ids())
    began = perf_counter()
    try:
        _converse(dialogue, asked, limits.window)
    except Broken:
        run(target, asked, limits)
    except OverflowError:
        return perf_counter() - began
    finally:
        dialogue.kill()
    return perf_counter() - began


def _converse(dialogue: Dialogue, asked: list[Question], window: int) -> None:
    at = 0
    while at < len(asked) or dialogue.owed:
        room = window - dialogue.owed
        if room > 0 and at < len(asked):
            dialogue.ask(asked[at : at + room])
            at += room
        for _ in dialogue.answers():
            pass
