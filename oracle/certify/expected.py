"""A run beside what was expected of it. Pure: grades in, lists of what differs out.

A row fails on the lowest level it fails, of those up to the one asked. An entry is `met` by such a
failure, `idle` where the run could not tell (the row is outside the part that was asked, or the
level is above the one asked), else it is wrong: what it is about passes, or is not there.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from raycert.cases.levels import LEVELS, Level, upto
from raycert.cases.model import type_of
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.expectations import Expectation, Expectations
from raycert.oracle.certify.grading import Grade
from raycert.oracle.certify.verdict import Touches, by_solid

Found = Literal["met", "idle", "passes", "unmatched"]


@dataclass(frozen=True, slots=True)
class Matched:
    """Each a list of row ids, or of sentences that begin with what they are about.

    `expected` are failures, and met an entry; `new` ones met none. `accepted` is no certificate.
    """

    expected: tuple[str, ...] = ()
    unexpected_passes: tuple[str, ...] = ()
    unmatched: tuple[str, ...] = ()
    new: tuple[str, ...] = ()

    @property
    def accepted(self) -> bool:
        """Tell whether the run failed as expected and in no other way."""
        return not (self.unexpected_passes or self.unmatched or self.new)

    def as_json(self, file: str) -> dict[str, Any]:
        """Return this as a part of the certificate."""
        return {
            "file": file,
            "expected": list(self.expected),
            "unexpected_passes": list(self.unexpected_passes),
            "unmatched": list(self.unmatched),
            "new": list(self.new),
        }


def failed_level(grade: Grade, asked: Level) -> Level | None:
    """Return the lowest level that a row fails, of those up to the one asked; None if none."""
    if grade.row.tier == "range":
        return None
    return next((level for level in upto(asked) if grade.fault(level)), None)


def match(
    expectations: Expectations,
    grades: Sequence[Grade],
    level: Level,
    convention: str,
    known: Iterable[GoldenRow] = (),
) -> Matched:
    """Return how a run compares with what was expected of it.

    `known` are the rows that could have been asked, those outside the selection too; an entry
    about one of them is not unmatched. Without it they are those of `grades`.
    """
    run = _Run(grades, level, convention, {row.id: row for row in known})
    met, new = run.failures(expectations)
    found = [(entry, *run.found(entry)) for entry in expectations.entries]
    said = {
        kind: tuple(f"{entry}: {why}" for entry, state, why in found if state == kind)
        for kind in ("passes", "unmatched")
    }
    return Matched(tuple(met), said["passes"], said["unmatched"], tuple(new))


def record(
    grades: Sequence[Grade],
    level: Level,
    convention: str,
    corpus: str,
    old: Expectations | None = None,
    known: Iterable[GoldenRow] = (),
) -> Expectations:
    """Return the expectations that accept a run: what holds of the old ones, and its failures.

    `corpus` is the corpus's version, for the reasons. Old entries keep their reasons and links.
    """
    run = _Run(grades, level, convention, {row.id: row for row in known})
    reason = f"known failure, recorded by certify --write-expectations on corpus {corpus}"
    kept = [e for e in (old or Expectations()).entries if run.found(e)[0] in ("met", "idle")]
    about = _About.of(Expectations(tuple(kept)))
    for id, failed in run.failing.items():
        entry = about.row(run.rows[id])
        if entry is None or not _covers(entry, failed):
            kept = [e for e in kept if (e.kind, e.name) != ("id", id)]
            kept.append(Expectation("id", id, reason, level=failed))
    for name in run.against:
        if name not in about.conventions:
            kept.append(Expectation("convention", name, reason))
    return Expectations(tuple(kept))


@dataclass(frozen=True, slots=True)
class _About:
    """The entries by what they are about."""

    ids: dict[str, Expectation]
    families: dict[str, Expectation]
    conventions: dict[str, Expectation]

    @classmethod
    def of(cls, expectations: Expectations) -> _About:
        of = expectations.of
        return cls(of("id"), of("family"), of("convention"))

    def row(self, row: GoldenRow) -> Expectation | None:
        """Return the entry about a row: the one for its id before the one for its family."""
        return self.ids.get(row.id) or self.families.get(row.family)


def _covers(entry: Expectation, failed: Level) -> bool:
    """Tell whether a failure from this level on is no worse than expected."""
    return entry.level is None or LEVELS.index(failed) >= LEVELS.index(entry.level)


@dataclass(frozen=True)
class _Run:
    """The grades of a run, and the rows that it could have asked."""

    grades: Sequence[Grade]
    level: Level
    convention: str
    known: dict[str, GoldenRow]

    @cached_property
    def rows(self) -> dict[str, GoldenRow]:
        """Return the rows graded that are part of a level."""
        return {g.row.id: g.row for g in self.grades if g.row.tier != "range"}

    @cached_property
    def all(self) -> dict[str, GoldenRow]:
        """Return all rows that could have been asked."""
        return self.known | {g.row.id: g.row for g in self.grades}

    @cached_property
    def _named(self) -> dict[str, dict[str, list[GoldenRow]]]:
        families: dict[str, list[GoldenRow]] = {}
        for row in self.all.values():
            families.setdefault(row.family, []).append(row)
        return {"id": {id: [row] for id, row in self.all.items()}, "family": families}

    @cached_property
    def failing(self) -> dict[str, Level]:
        """Return the rows that fail, each with the lowest level."""
        found = ((g.row.id, failed_level(g, self.level)) for g in self.grades)
        return {id: failed for id, failed in found if failed}

    @cached_property
    def against(self) -> dict[str, str]:
        """Return the types of solid that go against the convention asked, and how they go."""
        touches = {group.name: Touches.of(group.grades) for group in by_solid(self.grades)}
        return {name: t.name for name, t in touches.items() if not t.follows(self.convention)}

    def failures(self, expectations: Expectations) -> tuple[list[str], list[str]]:
        """Return the failures that meet an entry, and those that do not."""
        about, met, new = _About.of(expectations), list[str](), list[str]()
        for id, failed in self.failing.items():
            entry = about.row(self.rows[id])
            if entry is None:
                new.append(id)
            elif _covers(entry, failed):
                met.append(id)
            else:
                new.append(f"{id}: fails {failed}, expected to fail from {entry.level} on")
        for name, way in self.against.items():
            text = f"{name}: convention is {way}, not {self.convention}"
            (met if name in about.conventions else new).append(text)
        return met, new + self._undecided()

    def _undecided(self) -> list[str]:
        """Return the types of solid whose rows do not tell of a level; they refuse a run too."""
        if not self.rows:
            return ["nothing was tested"]
        found = []
        for group in by_solid(self.grades):
            for level in upto(self.level):
                tally = group.tally(level)
                if not tally.passed and not tally.failed:
                    found.append(f"{group.name}: no row decides {level}")
                    break
        return found

    def found(self, entry: Expectation) -> tuple[Found, str]:
        """Return what the run says of an entry, and why."""
        if entry.kind == "convention":
            return self._found_convention(entry)
        about = self._named[entry.kind].get(entry.name, [])
        counted = [row for row in about if row.tier != "range"]
        if not counted:
            tier = "is of the range tier, and part of no level"
            return "unmatched", tier if about else f"no such {entry.kind} is asked"
        failed = [self.failing[row.id] for row in counted if row.id in self.failing]
        if any(entry.level in (None, level) for level in failed):
            return "met", ""
        if entry.level and LEVELS.index(entry.level) > LEVELS.index(self.level):
            return "idle", ""
        if not all(row.id in self.rows for row in counted):
            return "idle", ""
        if not failed:
            return "passes", f"passes {entry.level or self.level}"
        if not any(_covers(entry, level) for level in failed):
            return "idle", ""  # worse than expected: that is among the new failures
        return "passes", f"passes {entry.level}, fails {min(failed, key=LEVELS.index)}"

    def _found_convention(self, entry: Expectation) -> tuple[Found, str]:
        if entry.name in self.against:
            return "met", ""
        about = [row for row in self.all.values() if type_of(row.solid) == entry.name]
        if not about:
            return "unmatched", "no such solid is asked"
        whole = all(row.id in self.rows or row.tier == "range" for row in about)
        return ("passes", f"is {self.convention}") if whole else ("idle", "")
