"""One row, one outcome: which levels it passes, and how far the answer is from the exact one.

Levels are decided by the row's own lists, as any reader could; the measured errors come from the
exact judge. A failure to answer fails every level.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import inf
from typing import Literal

from raycert.cases.accept import Accept, Numbers
from raycert.cases.degenerate import degenerate
from raycert.cases.domain import quantities
from raycert.cases.levels import LEVELS, Level
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Hello, Reply, convention
from raycert.cases.row import GoldenRow, Span
from raycert.oracle.client.dialogue import silence
from raycert.oracle.client.process import Failure
from raycert.oracle.judge.answer import Claim, Listed, claim
from raycert.oracle.judge.backward import Bracket
from raycert.oracle.judge.decisive import decisive
from raycert.oracle.judge.levels import MEASURES, Enclosures, Judge
from raycert.oracle.judge.moved import LAST_STEP, Measure

MEASURED: tuple[Measure, ...] = ("strict", "squared")
"""The measures, from strict to lax."""
Fare = Literal["right", "refused", "wrong"]
Place = Literal["inside", "outside", "degenerate"]


@dataclass(frozen=True)
class Grade:
    """What came of one row. `faults` names, for each level it fails, the reason.

    `beside` does so for the levels that the row does not decide: reported, and not counted. `said`
    is None where there was no answer; `refused` tells that this was said. `place` is where the row
    lies: only those inside the declared domain count for a level, a convention or a window.

    The errors are measured when they are asked for: `strict` and `squared` are the backward errors
    k, `ulps` the forward error; infinite where the answer is none, or has another number of pairs.
    """

    row: GoldenRow
    said: Claim | None
    faults: Mapping[str, str]
    judge: Judge
    decides: tuple[str, ...] = ()
    beside: Mapping[str, str] = field(default_factory=dict)
    place: Place = "inside"
    refused: bool = False

    @property
    def answer(self) -> Numbers | None:
        """Return the interval list that was answered; None if there is none."""
        return self.said.pairs if isinstance(self.said, Listed) else None

    @cached_property
    def _brackets(self) -> dict[Measure, Bracket]:
        if self.said is None:
            return {measure: Bracket.at(LAST_STEP + 1) for measure in MEASURED}
        return {measure: self.said.bracket(self.judge, measure) for measure in MEASURED}

    def bracket(self, measure: Measure) -> Bracket:
        """Return the least step of k that accepts the answer, as far as it is known by now."""
        found = self._brackets[measure]
        if measure == "squared":  # which allows whatever the strict one does
            found.at_most(self._brackets["strict"].high)
        return found

    @property
    def strict(self) -> float:
        return self.bracket("strict").k

    @property
    def squared(self) -> float:
        return self.bracket("squared").k

    @cached_property
    def ulps(self) -> float:
        return inf if self.said is None else self.said.forward_error(self.judge)

    def measure(self) -> tuple[float, float, float]:
        """Return all errors."""
        return self.strict, self.squared, self.ulps

    def take(self, steps: Mapping[Measure, int], ulps: float) -> None:
        """Take errors that were measured elsewhere."""
        self.__dict__["_brackets"] = {m: Bracket.at(step) for m, step in steps.items()}
        self.__dict__["ulps"] = ulps

    def fault(self, level: Level) -> str | None:
        """Return why the row fails a level, or None. A row not decisive can only be malformed."""
        return self.faults.get(level)

    def counts(self, level: Level) -> bool:
        """Whether the row decides a level, or fails whatever it decides."""
        return level in self.decides or level in self.faults

    def fare(self, level: Level) -> Fare:
        """Return how the row fared on a level, whether it decides it or not."""
        if self.refused:
            return "refused"
        return "wrong" if level in self.faults or level in self.beside else "right"

    def accept(self, level: Level) -> Accept:
        return accept(self.row, self.judge, level)

    @property
    def keeps_touch(self) -> bool | None:
        """Whether a touch was kept as a pair; None where the row has none to grade."""
        touched = any(span.touch for span in self.row.intervals)
        if self.row.tier != "lattice" or not touched or self.said is None:
            return None
        return self.said.keeps_touch(self.row.expected)


def inside(grades: Iterable[Grade]) -> list[Grade]:
    """Return the grades of the rows that the implementation is for."""
    return [g for g in grades if g.place == "inside"]


def counting(grades: Iterable[Grade], *places: Place) -> list[Grade]:
    """Return the grades of these places; those of the range tier are part of no level."""
    return [g for g in grades if g.place in places and g.row.tier != "range"]


def usual(grades: Iterable[Grade]) -> list[Grade]:
    """Return the grades that levels are about."""
    return counting(grades, "inside")


def grade(row: GoldenRow, outcome: Reply | Failure, hello: Hello) -> Grade:
    judge = Judge(row.solid, row.ray, hello.format, row.tier, hello.tolerance)
    quiet, place = silence(outcome), place_of(row.solid, row.ray, hello)
    said = None if isinstance(outcome, Failure) or quiet else claim(outcome, hello)
    whole = ": ".join(quiet or ()) if said is None else said.malformed(judge)
    if whole is not None:
        refused = isinstance(outcome, Reply) and said is None
        silent: dict[str, str] = dict.fromkeys(LEVELS, whole)
        return Grade(row, said, silent, judge, row.decisive, {}, place, refused)
    assert said is not None
    faults: dict[str, str] = {}
    beside: dict[str, str] = {}
    decides = decisive(judge) if judge.tolerance else row.decisive
    for level in LEVELS:
        fault = _level_fault(level, row, said, judge, hello)
        if level not in decides:
            beside |= {level: fault} if fault else {}
        elif fault or faults:  # what fails a level fails those above it
            faults[level] = fault or next(reversed(faults.values()))
    return Grade(row, said, faults, judge, decides, beside, place)


def undeclared(solid: Solid, ray: Ray, hello: Hello) -> tuple[str, ...]:
    """Return the kinds of degenerate input that a case is of, and that are not declared."""
    kinds = degenerate(solid, ray)
    return tuple(kind for kind in kinds if kind not in hello.degenerate)


def place_of(solid: Solid, ray: Ray, hello: Hello) -> Place:
    """Return where a case lies for what an implementation declares."""
    if undeclared(solid, ray, hello):
        return "degenerate"
    if hello.domain and not hello.domain.holds(quantities(solid, ray)):
        return "outside"
    return "inside"


def _level_fault(
    level: Level, row: GoldenRow, said: Claim, judge: Judge, hello: Hello
) -> str | None:
    if level in MEASURES:
        return said.fault(accept(row, judge, level))
    wanted, around = by_convention(row, judge, hello, said)
    return said.is_faithful(wanted, around) if level == "faithful" else said.is_expected(wanted)


def accept(row: GoldenRow, judge: Judge, level: Level) -> Accept:
    """Return the lists that decide `sound` or `stable`, those of the judge's tolerance if any."""
    return judge.accept(level) if judge.tolerance else row.accept[level]


def by_convention(
    row: GoldenRow, judge: Judge, hello: Hello, said: Claim | None
) -> tuple[Numbers, Enclosures]:
    """Return the expected list, and the numbers around its ends.

    The touches that the declared convention drops are left out, and of those that it leaves open
    those that were not answered.
    """
    if len(row.expected) != len(row.intervals):
        return row.expected, judge.enclosures
    keeps = convention(hello.convention)
    spans = zip(row.expected, row.intervals, strict=True)
    left = [(pair, span) for pair, span in spans if _kept(span, keeps, said)]
    enclosures = (tuple((end.down, end.up) for end in (s.enter, s.leave)) for _, s in left)
    return tuple(pair for pair, _ in left), tuple(enclosures)  # type: ignore[arg-type]


def _kept(span: Span, keeps: Mapping[str, bool | None], said: Claim | None) -> bool:
    kept = True if span.touch is None else keeps[span.touch]
    if kept is None:
        return said is not None and said.meets(span.enter.down, span.leave.up)
    return kept
