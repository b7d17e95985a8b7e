"""The oracle against its witnesses: the loop over cases, and the count of what they say.

Each case is answered by the oracle once and judged by every witness asked. No output here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from itertools import islice
from multiprocessing import get_context
from time import perf_counter

from raycert.cases.model import Ray, Solid
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness.verdict import Outcome, Verdict, Witness, load, show

CHUNK = 16
"""Cases that a worker takes at a time."""


@dataclass(frozen=True, slots=True)
class Question:
    """One case to check: an id to know it by, and what is asked."""

    id: str
    solid: Solid
    ray: Ray


@dataclass(frozen=True, slots=True)
class Checked:
    """What every witness says of the oracle's answer to one case, and how long each took."""

    question: Question
    answer: str
    verdicts: tuple[tuple[str, Verdict, float], ...]

    @property
    def disagreed(self) -> bool:
        """Tell whether a witness found another list."""
        return any(verdict.outcome == "disagreed" for _, verdict, _ in self.verdicts)


def check(question: Question, names: Iterable[str], answer: Intervals | None = None) -> Checked:
    """Return what the witnesses say of an answer, by default the oracle's."""
    if answer is None:
        answer = trace(question.solid, question.ray).intervals
    verdicts = []
    for name in names:
        witness = load(name)
        began = perf_counter()
        verdict = _ask(witness, question, answer)
        verdicts.append((name, verdict, perf_counter() - began))
    return Checked(question, show(answer), tuple(verdicts))


def _ask(witness: Witness, question: Question, answer: Intervals) -> Verdict:
    """Return a witness's verdict; one that contradicts itself disagrees with any answer."""
    try:
        return witness(question.solid, question.ray, answer)
    except ArithmeticError as error:
        why = f"the witness contradicts itself: {type(error).__name__}: {error}"
        return Verdict("disagreed", "nothing", why)


def crosscheck(
    questions: Iterable[Question], names: Sequence[str], workers: int = 1
) -> Iterator[Checked]:
    """Yield what the witnesses say of each case, in order; `workers` > 1 are processes."""
    if workers == 1:
        for question in questions:
            yield check(question, names)
        return
    pool = ProcessPoolExecutor(workers, mp_context=get_context("spawn"))
    try:
        for future in [pool.submit(_check_all, chunk, names) for chunk in _chunks(questions)]:
            yield from future.result()
    finally:
        pool.shutdown(cancel_futures=True)


def _chunks(questions: Iterable[Question]) -> Iterator[tuple[Question, ...]]:
    rest = iter(questions)
    for first in rest:
        yield (first, *islice(rest, CHUNK - 1))


def _check_all(questions: tuple[Question, ...], names: Sequence[str]) -> list[Checked]:
    return [check(question, names) for question in questions]


@dataclass(slots=True)
class Tally:
    """How one witness fared: outcomes, seconds, the slowest case, and why it was undecided."""

    witness: str
    outcomes: Counter[Outcome] = field(default_factory=Counter)
    seconds: float = 0.0
    slowest: float = 0.0
    undecided: Counter[str] = field(default_factory=Counter)

    @property
    def count(self) -> int:
        """Return how many cases the witness judged."""
        return self.outcomes.total()

    def add(self, verdict: Verdict, seconds: float) -> None:
        """Count one verdict."""
        self.outcomes[verdict.outcome] += 1
        self.seconds += seconds
        self.slowest = max(self.slowest, seconds)
        if verdict.outcome == "undecided":
            self.undecided[verdict.why] += 1


@dataclass(slots=True)
class Summary:
    """The tally of each witness, and the cases on which one disagreed."""

    tallies: dict[str, Tally]
    differing: list[Checked] = field(default_factory=list)

    @classmethod
    def over(cls, names: Iterable[str]) -> Summary:
        """Return an empty summary of these witnesses."""
        return cls({name: Tally(name) for name in names})

    def add(self, checked: Checked) -> None:
        """Count one case."""
        for name, verdict, seconds in checked.verdicts:
            self.tallies[name].add(verdict, seconds)
        if checked.disagreed:
            self.differing.append(checked)
