"""The oracle against its witnesses: the loop over cases, and the count of what they say.

Each case is answered by the oracle once and judged by every witness asked. No output here.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import repeat
from time import perf_counter

from raycert.cases.model import Ray, Solid
from raycert.cases.workers import Workers
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness.testimony import Outcome, Testimony, Witness, load, show

CHUNK = 16
"""Cases that a worker takes at a time."""


@dataclass(frozen=True, slots=True)
class Query:
    """One case to check: an id to know it by, and what is asked."""

    id: str
    solid: Solid
    ray: Ray


@dataclass(frozen=True, slots=True)
class Hearing:
    """What every witness says of the oracle's answer to one case, and how long each took."""

    query: Query
    answer: str
    testimonies: tuple[tuple[str, Testimony, float], ...]

    @property
    def disagreed(self) -> bool:
        return any(testimony.outcome == "disagreed" for _, testimony, _ in self.testimonies)


def check(query: Query, names: Iterable[str], answer: Intervals | None = None) -> Hearing:
    """Return what the witnesses say of an answer, by default the oracle's."""
    if answer is None:
        answer = trace(query.solid, query.ray).intervals
    testimonies = []
    for name in names:
        witness = load(name)
        began = perf_counter()
        testimony = _ask(witness, query, answer)
        testimonies.append((name, testimony, perf_counter() - began))
    return Hearing(query, show(answer), tuple(testimonies))


def _ask(witness: Witness, query: Query, answer: Intervals) -> Testimony:
    """Return a witness's testimony; one that contradicts itself disagrees with any answer."""
    try:
        return witness(query.solid, query.ray, answer)
    except ArithmeticError as error:
        why = f"the witness contradicts itself: {type(error).__name__}: {error}"
        return Testimony("disagreed", "nothing", why)


def crosscheck(
    queries: Iterable[Query], names: Sequence[str], workers: int = 1
) -> Iterator[Hearing]:
    """Yield what the witnesses say of each case, in order; `workers` > 1 are processes."""
    if workers == 1:
        for query in queries:
            yield check(query, names)
        return
    with Workers(workers) as pool:
        yield from pool.map(check, queries, repeat(names), chunksize=CHUNK)


@dataclass(slots=True)
class Score:
    """How one witness fared: outcomes, seconds, the slowest case, and why it was undecided."""

    outcomes: Counter[Outcome] = field(default_factory=Counter)
    seconds: float = 0.0
    slowest: float = 0.0
    undecided: Counter[str] = field(default_factory=Counter)


@dataclass(slots=True)
class Summary:
    """The score of each witness, and the cases on which one disagreed."""

    scores: defaultdict[str, Score] = field(default_factory=lambda: defaultdict(Score))
    differing: list[Hearing] = field(default_factory=list)

    def add(self, hearing: Hearing) -> None:
        """Count one case."""
        for name, testimony, seconds in hearing.testimonies:
            score = self.scores[name]
            score.outcomes[testimony.outcome] += 1
            score.seconds += seconds
            score.slowest = max(score.slowest, seconds)
            if testimony.outcome == "undecided":
                score.undecided[testimony.why] += 1
        if hearing.disagreed:
            self.differing.append(hearing)
