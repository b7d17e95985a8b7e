"""From the grades of a run to its certificate: levels per solid type, conventions, worst cases.

A level is granted to a solid type if every row that decides it passes; never as a percentage. Rows
of the `range` tier are part of no level: they give the window of scales in which a level holds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import takewhile
from math import frexp

from raycert.cases.domain import within
from raycert.cases.levels import LEVELS, Level, upto
from raycert.cases.model import leaves, lengths, type_of
from raycert.cases.protocol import TOUCHES, convention
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import MEASURED, Grade, inside, usual
from raycert.oracle.exact.surd import sign


@dataclass(frozen=True, slots=True)
class Tally:
    """How the rows of one solid type, or one family, fared on one level.

    The refused ones are part of the failed ones.
    """

    passed: int
    failed: int
    refused: int
    not_decisive: int

    @property
    def granted(self) -> bool:
        """Whether the level is granted: something was tested, and nothing failed."""
        return self.passed > 0 and not self.failed

    @classmethod
    def of(cls, grades: Iterable[Grade], level: Level) -> Tally:
        """Count the rows that levels are about."""
        rows = usual(grades)
        failing = [g for g in rows if g.fault(level)]
        counted = sum(g.counts(level) for g in rows)
        refused = sum(g.refused for g in failing)
        return cls(counted - len(failing), len(failing), refused, len(rows) - counted)


@dataclass(frozen=True, slots=True)
class Touches:
    """For each kind of touch: how many of the lattice's were kept as pairs, of how many."""

    kept: dict[str, tuple[int, int]]

    @classmethod
    def of(cls, grades: Sequence[Grade]) -> Touches:
        kept = {}
        for kind in TOUCHES:
            met = [g for g in inside(grades) if any(span.touch == kind for span in g.row.intervals)]
            graded = [g.keeps_touch for g in met if g.keeps_touch is not None]
            if graded:
                kept[kind] = (sum(graded), len(graded))
        return cls(kept)

    @property
    def name(self) -> str:
        """Return the narrowest convention that the answers follow, as it can be declared."""
        if not self.kept:
            return "not tested"
        mixed, kept, dropped = list[str](), list[str](), list[str]()
        for kind, (n, of) in self.kept.items():
            (mixed if 0 < n < of else kept if n else dropped).append(kind)
        if not kept and not dropped:
            return "any"
        few, base = (dropped, "closed") if len(dropped) <= len(kept) else (kept, "regularized")
        but = " ".join((*few, *(["any", *mixed] if mixed else [])))
        return f"{base} but {but}" if but else base

    @property
    def told(self) -> str:
        """Return the convention, and how many were kept of the kinds that go either way."""
        mixed = [f"{k} {n} of {of} kept" for k, (n, of) in self.kept.items() if 0 < n < of]
        return self.name + (f" ({', '.join(mixed)})" if mixed else "")

    def follows(self, wanted: str) -> bool:
        """Whether the answers follow a convention, on every kind that was tested."""
        keeps = convention(wanted)
        return all(
            keeps[kind] is None or n == (of if keeps[kind] else 0)
            for kind, (n, of) in self.kept.items()
        )


USUAL = 64
"""Lengths within 2^+-64 are usual; a range row of usual lengths is there for its direction."""


def window(grades: Iterable[Grade], level: Level, which: int) -> list[int] | None:
    """Return [low, high]: 2^low..2^high is the widest range of scales in which a level holds.

    Of lengths (which = 0) or of directions (1); None without such rows.
    """
    rows = [(scales(g.row), not g.fault(level)) for g in inside(grades) if g.row.tier == "range"]
    along = [(s[which], ok) for s, ok in rows if (abs(s[0]) <= USUAL) == bool(which)]
    if not along:
        return None
    bad_low = max((s for s, ok in along if not ok and s < 0), default=-10000)
    bad_high = min((s for s, ok in along if not ok and s >= 0), default=10000)
    held = [0, *(s for s, ok in along if ok and bad_low < s < bad_high)]
    return [min(held), max(held)]


def scales(row: GoldenRow) -> tuple[int, int]:
    """Return the binary exponents of the largest length and the largest part of the direction."""
    numbers = [x for _, leaf in leaves(row.solid) for x in lengths(leaf)]
    return _exponent((*numbers, *row.ray.origin)), _exponent(row.ray.direction)


def _exponent(numbers: Iterable[float]) -> int:
    largest = max(map(abs, numbers), default=0.0)
    return frexp(largest)[1] if largest else 0


@dataclass(frozen=True, slots=True)
class Group:
    """The grades of one solid type, or of one family within it."""

    name: str
    grades: tuple[Grade, ...]

    def tally(self, level: Level) -> Tally:
        return Tally.of(self.grades, level)

    def granted(self) -> Level | None:
        """Return the highest level granted, with all the levels below it, or None."""
        held = list(takewhile(lambda level: self.tally(level).granted, LEVELS))
        return held[-1] if held else None

    def worst(self) -> Grade:
        """Return the grade to look at first: the lowest level failed, then k, then ulps.

        One inside the domain, if there are any.
        """
        grades = inside(self.grades) or self.grades
        return grades[gravest(grades)]


def gravest(grades: Sequence[Grade]) -> int:
    """Return the place of the first of the gravest.

    Graver is a lower level failed, then more k, by the strict measure before the squared one, then
    more ulps. The gravest is measured. Of the others it is only shown that they are not graver:
    those that look worst come first, so that for most a single step of k tells.
    """
    order = sorted(range(len(grades)), key=lambda i: _promise(grades[i]), reverse=True)
    worst = order[0]
    for i in order[1:]:
        more = graver(grades[i], grades[worst])
        if more > 0 or (not more and i < worst):
            worst = i
    return worst


def _promise(grade: Grade) -> tuple[int, int]:
    return -lowest_failed(grade), grade.bracket("strict").guess


def lowest_failed(grade: Grade) -> int:
    """Return the place of the lowest level that a grade fails; 4 where it fails none."""
    return next((i for i, level in enumerate(LEVELS) if grade.fault(level)), len(LEVELS))


def graver(one: Grade, other: Grade) -> int:
    """Return 1 if one is graver than the other, -1 if it is less so, 0 if neither.

    The other is measured; of the one no more is than tells them apart.
    """
    if more := lowest_failed(other) - lowest_failed(one):
        return sign(more)
    for measure in MEASURED:
        step, bracket = other.bracket(measure).least, one.bracket(measure)
        if bracket.within(step - 1):
            return -1
        if not bracket.within(step):
            return 1
    return (one.ulps > other.ulps) - (one.ulps < other.ulps)


def by_solid(grades: Iterable[Grade]) -> list[Group]:
    """Return the grades by the type of their solid, a tree's by that of its root."""
    return _groups(grades, lambda g: type_of(g.row.solid))


def by_family(grades: Iterable[Grade]) -> list[Group]:
    return _groups(grades, lambda g: g.row.family)


def _groups(grades: Iterable[Grade], name: Callable[[Grade], str]) -> list[Group]:
    found: dict[str, list[Grade]] = {}
    for grade in grades:
        found.setdefault(name(grade), []).append(grade)
    return [Group(key, tuple(group)) for key, group in found.items()]


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether what was asked is granted; `reasons` say why not."""

    granted: bool
    reasons: tuple[str, ...]


def verdict(grades: Sequence[Grade], level: Level, wanted: str, domain: str = "") -> Verdict:
    """Return the verdict on a run: every solid type tested reaches the level and the convention.

    `domain` are the words of the one that is declared.
    """
    if not any(g.counts(level) for g in usual(grades)):
        return Verdict(False, ("nothing was tested",))
    reasons = []
    for group in by_solid(grades):
        if lowest := next((low for low in upto(level) if not group.tally(low).granted), None):
            reasons.append(_refusal(group, lowest, domain))
        touches = Touches.of(group.grades)
        if not touches.follows(wanted):
            reasons.append(f"{group.name}: convention is {touches.told}, not {wanted}")
    return Verdict(not reasons, tuple(reasons))


def _refusal(group: Group, level: Level, domain: str) -> str:
    tally, granted = group.tally(level), group.granted()
    asked = within(level, domain)
    if not tally.failed:
        return f"{group.name}: no row decides {asked}"
    families = by_family(g for g in usual(group.grades) if g.fault(level))
    names = ", ".join(f"{f.name} ({len(f.grades)})" for f in families[:6])
    more = f" and {len(families) - 6} more" if len(families) > 6 else ""
    of = tally.passed + tally.failed
    held = f"granted {granted}; " if granted else ""
    refused = f", {tally.refused} of them refused" if tally.refused else ""
    fails = f"fails on {tally.failed} of {of} rows{refused}"
    return f"{group.name}: {held}{asked}{',' if domain else ''} {fails}, in {names}{more}"
