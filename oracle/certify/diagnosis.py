"""What the answers of a run have in common: the likely faults, and where they belie the hello.

Whose answers are these? The failing ones are compared with those of the zoo and with signatures,
for each solid and level, and the fewest that explain the most are told; see `cover` for when a
fault is named. Contradictions of the hello stand beside the verdict, which they do not change.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isinf
from typing import Any, TypeVar

from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.levels import Level
from raycert.cases.protocol import FROM_INSIDE, FromInside, Hello
from raycert.oracle.certify.alike import Kind, Manner, agrees, fails, kind
from raycert.oracle.certify.cover import LEAST, Explanation, Failures, cover, needed, shares
from raycert.oracle.certify.grading import Grade, usual
from raycert.oracle.certify.signatures import Signature, signatures
from raycert.oracle.certify.verdict import Touches, by_solid
from raycert.oracle.judge.answer import Claim, First, Listed
from raycert.oracle.zoo.inhabitants import CATALOGUE
from raycert.oracle.zoo.matrix import Outcome
from raycert.oracle.zoo.tracer import Fault, concerns

SEARCHED = 24
"""Failures that every fault is tried on; others are for those that explain one of these."""
SHOWN = 96
"""Failures that the faults are chosen by; what is chosen is counted on all."""
EARLY = 400
"""Rows, the first ones asked, of which a fault that remembers has to explain one."""
PASSING = 96
"""Rows that pass on which a fault is tried that explains failures."""


def diagnose(grades: Sequence[Grade]) -> list[dict[str, Any]]:
    """Return the likely faults for each type of solid and level, as the certificate has them.

    What fails `stable` alone is explained, as far as it goes, by the faults that were named for
    `sound`, on whatever solid, and by those that are sound.
    """
    past, counted = Past(grades), by_solid(usual(grades))
    found = together([Trial(g.name, "sound", g.grades, past) for g in counted])
    named = {cause["fault"] for told in found for cause in told["explained"]}
    fine = [[g for g in group.grades if not g.fault("sound")] for group in counted]
    trials = zip(counted, fine, strict=True)
    return found + together([Trial(g.name, "stable", f, past, named) for g, f in trials])


def together(trials: Sequence[Trial]) -> list[dict[str, Any]]:
    """Return what explains each; of faults that do so alike, the one that explains most in all."""
    some = [trial for trial in trials if len(trial.failing) >= LEAST]
    everywhere = Counter[str]()
    for trial in some:
        everywhere.update({s.name: len(s.rows) for s in trial.suspects})
    return [trial.likely(everywhere) for trial in some]


@dataclass
class Past:
    """All that was asked, for the faults that depend on what was asked before."""

    grades: Sequence[Grade]
    known: dict[str, dict[str, Outcome]] = field(default_factory=dict)

    @cached_property
    def order(self) -> list[Grade]:
        """The grades in the order in which the rows are asked."""
        return sorted(self.grades, key=lambda g: g.row.tier == "range")

    @cached_property
    def manner(self) -> Manner:
        return Manner(next((g.said for g in self.grades if g.said is not None), Listed(())))

    def answers(self, fault: Fault) -> dict[str, Outcome]:
        """Return what a fault answers to each row; to none if it explains nothing early."""
        if fault.name not in self.known:
            tracer, early, rest = fault.make(), self.order[:EARLY], self.order[EARLY:]
            known = {g.row.id: Outcome.of(tracer, g.row, g.judge.format) for g in early}
            if any(self.explains(g, known[g.row.id]) for g in early if g.faults):
                known |= {g.row.id: Outcome.of(tracer, g.row, g.judge.format) for g in rest}
            else:
                known = {}
            self.known[fault.name] = known
        return self.known[fault.name]

    def explains(self, grade: Grade, outcome: Outcome) -> bool:
        claim = self.manner.claim(outcome.answer)
        return agrees(grade, claim) and fails(claim, grade, "stable")


@dataclass
class Trial:
    """The rows of one type of solid that count for a level, and who may have failed them."""

    solid: str
    level: Level
    grades: Sequence[Grade]
    past: Past
    named: Set[str] = frozenset()

    @cached_property
    def failing(self) -> list[Grade]:
        return [g for g in self.grades if g.fault(self.level)]

    @cached_property
    def passing(self) -> list[Grade]:
        return [g for g in self.grades if g.counts(self.level) and not g.fault(self.level)]

    @cached_property
    def shown(self) -> Sequence[Grade]:
        return spread(self.failing, SHOWN)

    @cached_property
    def searched(self) -> Sequence[Grade]:
        """One failure of each family before a second of any: a fault is at home in few."""
        seen, order = Counter[str](), list[tuple[int, int, Grade]]()
        for g in self.shown:
            order.append((seen[g.row.family], len(order), g))
            seen[g.row.family] += 1
        return [g for *_, g in sorted(order, key=lambda x: x[:2])[:SEARCHED]]

    def likely(self, everywhere: Mapping[str, int]) -> dict[str, Any]:
        """Return what explains the failures, and how many nothing does."""
        chosen = cover(self.suspects, self.failures, everywhere)
        found = shares(needed([self.whole(suspect) for suspect in chosen]))
        causes = [
            {
                "fault": suspect.name,
                "does": suspect.does,
                "origin": suspect.origin,
                "rows": len(rows),
                "first": self.failing[min(rows)].row.id,
            }
            for suspect, rows in found
        ]
        counts = {"solid": self.solid, "level": self.level, "failures": len(self.failing)}
        rest = len(self.failing) - sum(len(rows) for _, rows in found)
        return {**counts, "explained": causes, "unexplained": rest}

    def whole(self, suspect: Explanation) -> Explanation:
        """Return a suspect with all failures that it explains, not of those shown alone."""
        known = self.shown is self.failing
        rows = suspect.rows if known else self.explained(suspect.explains, self.failing)
        return replace(suspect, rows=rows)

    @staticmethod
    def explained(explains: Callable[[Grade], bool], grades: Sequence[Grade]) -> frozenset[int]:
        return frozenset(i for i, g in enumerate(grades) if explains(g))

    @cached_property
    def part(self) -> float:
        """The part of the failures that is shown; of the rows that pass as many are counted."""
        return len(self.shown) / len(self.failing)

    @cached_property
    def failures(self) -> Failures:
        wants, seen = (
            [bool(g.row.expected) for g in self.shown],
            sum(bool(g.row.expected) for g in self.passing),
        )
        kinds = [kind(g.said) for g in self.shown]
        return Failures(kinds, wants, self.part * len(self.passing), self.part * seen)

    @cached_property
    def suspects(self) -> list[Explanation]:
        """Return the faults and the signatures that explain at least a few of the failures."""
        found = [self.signature(signature) for signature in signatures(self.shown)]
        faults = (self.fault(f) for f in CATALOGUE if concerns(f, self.solid))
        return [s for s in (*faults, *found) if s and len(s.rows) >= LEAST]

    def signature(self, signed: Signature) -> Explanation:
        rows = self.explained(signed.holds, self.shown)
        words = (signed.name, signed.does, signed.origin)
        return Explanation(*words, signed.holds, rows, signed.telling, signed.alone)

    def fault(self, fault: Fault) -> Explanation | None:
        """Return a fault as a suspect; None if it explains too little to be looked at."""
        if fault.stateful and not self.past.answers(fault):
            return None
        answer = self.answers(fault)
        explains = self.explains(fault, answer)
        if not any(map(explains, self.searched)):
            return None
        if len(rows := self.explained(explains, self.shown)) < LEAST:
            return None
        said = ((i, g, answer(g)) for i, g in enumerate(self.shown))
        failed = {i: self.kind(fault, claim) for i, g, claim in said if fails(claim, g, self.level)}
        some = spread(self.passing, PASSING)
        passed = Counter(
            self.kind(fault, claim) for g in some if fails(claim := answer(g), g, self.level)
        )
        scale = self.part * len(self.passing) / max(len(some), 1)
        against = {k: n * scale for k, n in passed.items()}
        first = fault.name in self.named or self.by_place(fault)
        words = (fault.name, fault.does, fault.origin)
        return Explanation(*words, explains, rows, first=first, failed=failed, passed=against)

    def answers(self, fault: Fault) -> Callable[[Grade], Claim | None]:
        """Return what a fault answers, in the subject's way."""
        tracer, known = fault.make(), self.past.answers(fault) if fault.stateful else {}

        def answer(g: Grade) -> Claim | None:
            if g.row.id not in known:
                known[g.row.id] = Outcome.of(tracer, g.row, g.judge.format)
            return self.past.manner.claim(known[g.row.id].answer)

        return answer

    def explains(
        self, fault: Fault, answer: Callable[[Grade], Claim | None]
    ) -> Callable[[Grade], bool]:
        """Return whether a fault explains how a row fails: it answers alike, and is wrong there.

        One that is sound is known by where it fails: another formula errs as much, not alike.
        """
        if self.by_place(fault):
            return lambda g: (
                kind(g.said) == kind(claim := answer(g))
                and fails(claim, g, "stable")
                and not fails(claim, g, "sound")
            )
        return lambda g: agrees(g, claim := answer(g)) and fails(claim, g, self.level)

    def kind(self, fault: Fault, claim: Claim | None) -> Kind:
        return "place" if self.by_place(fault) else kind(claim)

    def by_place(self, fault: Fault) -> bool:
        return self.level == "stable" and fault.granted == "sound"


T = TypeVar("T")


def spread(items: Sequence[T], count: int) -> Sequence[T]:
    """Return at most so many, from all over.

    >>> spread([1, 2, 3, 4, 5], 3)
    [1, 2, 4]
    """
    step = len(items) / count
    return items if step <= 1 else [items[int(i * step)] for i in range(count)]


FEW = 8
"""Fewer rows than these show no habit."""


def contradictions(hello: Hello, grades: Sequence[Grade]) -> list[str]:
    """Return what the hello says and the answers do not bear out, a sentence each."""
    return [
        *_convention(hello, grades),
        *_unsupported(grades),
        *_from_inside(hello, grades),
        *_precision(hello, grades),
    ]


def _convention(hello: Hello, grades: Sequence[Grade]) -> Iterator[str]:
    for group in by_solid(grades):
        touches = Touches.of(group.grades)
        if not touches.follows(hello.convention):
            yield f"{group.name}: the hello says {hello.convention}, the answers are {touches.told}"


def _unsupported(grades: Sequence[Grade]) -> Iterator[str]:
    """Yield solids that are declared, and not one of which is answered."""
    for group in by_solid(grades):
        faults = [g.faults.get("sound", "") for g in group.grades]
        if all(text.startswith("unsupported: ") for text in faults):
            yield (
                f"{group.name}: the hello declares it, and all {len(faults)} answers are "
                f"{faults[0]!r:.100}; leave it out of `solids`, and it is listed as not tested"
            )


def _from_inside(hello: Hello, grades: Sequence[Grade]) -> Iterator[str]:
    """Yield a mode that the starts inside do not fit, where another one does."""
    starts = [g for g in grades if isinstance(g.said, First) and g.row.accept["sound"].inner]
    inside = [g for g in starts if g.row.accept["sound"].inner[0][0] == 0]
    if len(inside) < FEW or 2 * _fits(inside, hello.from_inside) > len(inside):
        return
    best = max(FROM_INSIDE, key=lambda mode: _fits(inside, mode))
    if 10 * _fits(inside, best) >= 9 * len(inside):
        yield (
            f"the hello says from_inside {hello.from_inside!r}, and {_fits(inside, best)} of "
            f"{len(inside)} answers from inside are those of {best!r}"
        )


def _fits(grades: Sequence[Grade], mode: FromInside) -> int:
    """Return how many answers are those of a mode; of what is negative or NaN no mode is."""
    firsts = [
        (g.said, g.row.accept["sound"])
        for g in grades
        if isinstance(g.said, First) and not g.said.malformed(g.judge)
    ]
    return sum(replace(said, from_inside=mode).fault(accept) is None for said, accept in firsts)


def _precision(hello: Hello, grades: Sequence[Grade]) -> Iterator[str]:
    """Yield answers that are all binary32 numbers, where hardly a right one would be."""
    if hello.format is not BINARY64:
        return
    telling = [x for g in grades for x, t in _numbers(g) if not _is_single(t)]
    if len(telling) >= FEW and all(map(_is_single, telling)):
        yield (
            "the hello says binary64, and every number in the answers is a binary32 number: they "
            "are rounded to single precision somewhere, or `precision` has to be binary32"
        )


def _numbers(grade: Grade) -> Iterator[tuple[float, float]]:
    """Yield each finite number that was answered with the one that was expected."""
    if isinstance(grade.said, Listed) and len(grade.said.pairs) == len(grade.row.expected):
        for pair, wanted in zip(grade.said.pairs, grade.row.expected, strict=True):
            yield from ((x, t) for x, t in zip(pair, wanted, strict=True) if not isinf(x))


def _is_single(x: float) -> bool:
    return x == BINARY32.nearest(x)
