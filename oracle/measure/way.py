"""A way answers rays: its name, its precision, what it needs, and how it casts.

A way takes all cases at once, so that a batch may be a batch. For each it returns the list of
pairs as doubles, or None where it fails: an exception, NaN, a decision that it cannot take. No way
is ever the truth, the oracle's own included: answers are judged by `errors`.

A client is asked through the harness, which outlives its crashes. Its time is that of a dialogue
that has begun, from the first question to the last answer: what it costs over the pipe.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from math import isnan
from time import perf_counter
from typing import Any, NamedTuple

from raycert.cases.formats import BINARY64
from raycert.cases.model import SOLIDS, Ray, Solid, types
from raycert.cases.protocol import Reply
from raycert.oracle.client.dialogue import Limits, Question, Target, Unusable
from raycert.oracle.client.replay import Replay, greet, run
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import trace
from raycert.oracle.measure.clock import Timed


class Case(NamedTuple):
    """A question."""

    solid: Solid
    ray: Ray


Pairs = tuple[tuple[float, float], ...]
Answered = Pairs | None
Solve = Callable[[Sequence[Case]], list[Answered]]
Ready = Callable[[Sequence[Case]], Callable[[], Any]]
Intersect = Callable[[Solid, Ray], Iterable[tuple[float, float]]]
ALL = frozenset(SOLIDS)
PRECISIONS = ("float64", "float32", "longdouble", "double-double", "mpmath", "interval", "symbolic",
              "exact", "mesh", "client")  # fmt: skip
FAILURES = (ArithmeticError, ValueError, TypeError, RecursionError)
"""What a computation may raise that is a failure to answer, and no fault of ours."""
AHEAD = 256
"""The rays that a client is priced at, so that what a first answer waits for does not count."""


@dataclass(frozen=True)
class Way:
    """A way to answer; `does` completes "a method that ...".

    `precision` is one of PRECISIONS: what it computes in. `solids` are the types that it answers;
    a tree counts with all its types. `stress`: is it cheap enough for sweeps? `lanes` is the
    number of rays that one call is priced at: a batch has a price per call, which is no property
    of the rays. `ready` returns the call that is timed, made from the cases before the clock
    starts, where that is not `solve` itself. `needs` are the packages it loads.
    """

    name: str
    does: str
    solve: Solve
    solids: frozenset[str] = ALL
    precision: str = "float64"
    stress: bool = True
    lanes: int = 1
    ready: Ready | None = None
    needs: tuple[str, ...] = ()

    @property
    def batch(self) -> bool:
        """Whether it takes many rays in one call, and is priced so."""
        return self.lanes > 1 and self.precision != "client"

    def answers(self, solid: Solid) -> bool:
        return types(solid) <= self.solids

    def call(self, cases: Sequence[Case]) -> Callable[[], Any]:
        """Return what the clock runs for these cases."""
        return self.ready(cases) if self.ready else lambda: self.solve(cases)


def answered(pairs: Iterable[tuple[float, float]]) -> Answered:
    """Return pairs as an answer: without -0, and joined where they touch; None for a NaN."""
    joined: list[tuple[float, float]] = []
    for a, b in pairs:
        if isnan(a) or isnan(b):
            return None
        if joined and a <= joined[-1][1]:
            joined[-1] = (joined[-1][0], max(joined[-1][1], b + 0.0))
        else:
            joined.append((a + 0.0, b + 0.0))
    return tuple(joined)


def one_by_one(intersect: Intersect) -> Solve:
    """Return the `solve` of a function that answers one case; what it raises is a failure."""
    return lambda cases: [_try(intersect, case) for case in cases]


def _try(intersect: Intersect, case: Case) -> Answered:
    try:
        return answered(intersect(case.solid, case.ray))
    except FAILURES:
        return None


def exact(solid: Solid, ray: Ray) -> Pairs:
    """Return the oracle's list, both ends of each pair correctly rounded."""
    return expected(trace(solid, ray).intervals, BINARY64)[1]


def lazily(make: Callable[[], Solve]) -> Solve:
    """Return the `solve` that is made when it is first asked."""
    once = cache(make)
    return lambda cases: once()(cases)


def function(name: str) -> Callable[..., Any]:
    """Return the function `module:function`, its module loaded now."""
    module, _, own = name.partition(":")
    call: Callable[..., Any] = getattr(import_module(module), own)
    return call


def called(name: str) -> Solve:
    """Return the `solve` of a function `module:function`, called directly."""
    return lazily(lambda: one_by_one(function(name)))


def missing(names: Iterable[str]) -> list[str]:
    return [name for name in names if find_spec(name) is None]


def client(name: str, target: Target) -> Way:
    """Return a client as a way. Raises `Unusable` if it cannot start, or gives no lists."""
    hello = greet(target)
    if hello.answers != "intervals":
        raise Unusable(
            f"{name!r} answers {hello.answers!r}, one number or none. Errors of lists are compared "
            "here, and only a client that answers intervals gives them."
        )

    def solve(cases: Sequence[Case]) -> list[Answered]:
        try:
            outcomes = run(target, questions(cases), hello=hello).outcomes
        except OverflowError:  # numbers that bit patterns of the client's precision cannot hold
            return [None] * len(cases)
        return [_list(outcome) for outcome in outcomes.values()]

    return Way(
        name,
        f"is the client {hello.name}, {hello.precision}",
        solve,
        frozenset(hello.solids),
        "client",
        lanes=AHEAD,
        ready=lambda cases: lambda: _timed(target, cases),
    )


def questions(cases: Sequence[Case]) -> list[Question]:
    return [Question(str(i), *case) for i, case in enumerate(cases)]


def _list(outcome: object) -> Answered:
    pairs = outcome.intervals if isinstance(outcome, Reply) else None
    return None if pairs is None else answered(pairs)


def _timed(target: Target, cases: Sequence[Case]) -> Timed:
    """Return how long a client that has said hello takes; with its restarts, if it breaks off."""
    ticks: list[float] = []
    replay = Replay(target, questions(cases), Limits(), lambda _: ticks.append(perf_counter()))
    began = perf_counter()
    try:
        replay.all()
    except OverflowError:
        ticks.append(perf_counter())
    finally:
        replay.kill()
    return Timed(max(ticks, default=began) - began)
