"""Known failures: a TOML file of what a run is expected to fail on, with a reason and a link each.

    [[expect]]
    family = "needle"          # or id = "far-deep/across-1e9", or convention = "sphere"
    level = "stable"           # the lowest level that fails; left out: any up to the one asked
    reason = "the textbook discriminant; to be replaced"
    link = "https://example.org/issues/12"

A `family` stands for all its rows that fail, a `convention` for a type of solid whose touches go
another way than asked. An expected failure that passes, and an entry that is about nothing in the
corpus, are failures of the run: such a file has to be mended.

A row fails on the lowest level it fails, of those up to the one asked. An entry is `met` by such a
failure, `idle` where the run could not tell (the row is outside the part that was asked, or the
level is above the one asked), else it is wrong: what it is about passes, or is not there.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any, Literal

from raycert.cases.levels import LEVELS, Level, upto
from raycert.cases.model import SOLIDS, type_of
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, usual
from raycert.oracle.certify.verdict import Touches, by_solid

Kind = Literal["id", "family", "convention"]
KINDS: tuple[Kind, ...] = ("id", "family", "convention")
FIELDS = (*KINDS, "level", "reason", "link")


class BadExpectations(ValueError):
    """A file that cannot be used; the text names the file, the entry and the field."""


@dataclass(frozen=True, slots=True)
class Expectation:
    """One entry: what is expected to fail, from which level on (None: the one asked), and why."""

    kind: Kind
    name: str
    reason: str
    link: str = ""
    level: Level | None = None

    def __str__(self) -> str:
        return f"{self.kind} {self.name}" if self.kind != "id" else self.name

    def covers(self, failed: Level) -> bool:
        """Whether a failure from this level on is no worse than expected."""
        return self.level is None or LEVELS.index(failed) >= LEVELS.index(self.level)


@dataclass(frozen=True)
class Expectations:
    """The entries of a file, in its order; no two are about the same."""

    entries: tuple[Expectation, ...] = ()

    @property
    def warnings(self) -> list[str]:
        """Return what is not wrong and not good either."""
        bare = [str(entry) for entry in self.entries if not entry.link.strip()]
        if not bare:
            return []
        more = f" and {len(bare) - 3} more" if len(bare) > 3 else ""
        return [f"expected failures without a link: {', '.join(bare[:3])}{more}"]

    def of(self, kind: Kind) -> dict[str, Expectation]:
        return self._by_kind[kind]

    @cached_property
    def _by_kind(self) -> dict[Kind, dict[str, Expectation]]:
        return {kind: {e.name: e for e in self.entries if e.kind == kind} for kind in KINDS}

    def about(self, row: GoldenRow) -> Expectation | None:
        """Return the entry about a row: the one for its id before the one for its family."""
        return self.of("id").get(row.id) or self.of("family").get(row.family)


def read(text: str, file: str = "expectations") -> Expectations:
    """Return the expectations that a TOML text holds. Raises `BadExpectations`."""
    try:
        form = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise BadExpectations(f"{file}: is not TOML: {error or 'nested too deep'}") from None
    for name in form:
        if name != "expect":
            raise BadExpectations(f"{file}: unknown key {name!r:.40}; only [[expect]] is known")
    listed = form.get("expect", [])
    if not isinstance(listed, list):
        raise BadExpectations(f"{file}: expect is not a list of tables: write [[expect]]")
    entries: list[Expectation] = []
    for number, table in enumerate(listed, 1):
        where = f"{file}: entry {number}"
        entry = _entry(table, where)
        for earlier, other in enumerate(entries, 1):
            if (other.kind, other.name) == (entry.kind, entry.name):
                raise BadExpectations(
                    f"{where}: {entry.kind} {entry.name!r} is entry {earlier} too"
                )
        entries.append(entry)
    return Expectations(tuple(entries))


def _entry(table: object, where: str) -> Expectation:
    if not isinstance(table, dict):
        raise BadExpectations(f"{where}: is not a table: write [[expect]]")
    for name, value in table.items():
        if name not in FIELDS:
            raise BadExpectations(f"{where}: unknown key {name!r:.40} ({', '.join(FIELDS)})")
        if not isinstance(value, str):
            raise BadExpectations(f"{where}: {name} is not a string: {value!r:.40}")
    named = [kind for kind in KINDS if kind in table]
    if len(named) != 1:
        raise BadExpectations(f"{where}: has to have exactly one of {', '.join(KINDS)}")
    kind = named[0]
    if kind == "convention" and table[kind] not in SOLIDS:
        known = ", ".join(SOLIDS)
        raise BadExpectations(f"{where}: convention is not a type of solid ({known})")
    for name, may_be_empty in (("reason", False), ("link", True), (kind, False)):
        if name not in table:
            raise BadExpectations(f"{where}: {name} is missing")
        if not may_be_empty and not table[name].strip():
            raise BadExpectations(f"{where}: {name} is empty")
    return Expectation(
        kind, table[kind], table["reason"], table["link"], _level(table, kind, where)
    )


def _level(table: dict[str, Any], kind: Kind, where: str) -> Level | None:
    if "level" not in table:
        return None
    if kind == "convention":
        raise BadExpectations(f"{where}: level is for id and family; a convention has none")
    for level in LEVELS:
        if table["level"] == level:
            return level
    raise BadExpectations(
        f"{where}: level is not one of {', '.join(LEVELS)}: {table['level']!r:.40}"
    )


HEAD = (
    "# Failures that `raycert certify --expect FILE` expects. Give each a true reason, and a link\n"
    "# to where it is being dealt with. The form: id, family or convention; level; reason; link.\n"
)


def write(expectations: Expectations) -> str:
    """Return the TOML text of expectations; reading it gives them back."""
    return HEAD + "".join(_written(entry) for entry in expectations.entries)


def _written(entry: Expectation) -> str:
    fields: Iterable[tuple[str, str | None]] = (
        (entry.kind, entry.name),
        ("level", entry.level),
        ("reason", entry.reason),
        ("link", entry.link),
    )
    lines = (f"{name} = {_quoted(text)}\n" for name, text in fields if text is not None)
    return "\n[[expect]]\n" + "".join(lines)


def _quoted(text: str) -> str:
    r"""Return a TOML basic string. JSON's escapes are TOML's; only DEL is bare in JSON.

    >>> print(_quoted('a "b" \\ \x7f'))
    "a \"b\" \\ \u007f"
    """
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


State = Literal["met", "idle", "passes", "unmatched"]


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
        """Whether the run failed as expected and in no other way."""
        return not (self.unexpected_passes or self.unmatched or self.new)

    def as_json(self, file: str) -> dict[str, Any]:
        return {"file": file, **{name: list(entries) for name, entries in asdict(self).items()}}


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
    states = [(entry, *run.state(entry)) for entry in expectations.entries]
    passes, unmatched = (
        tuple(f"{entry}: {why}" for entry, state, why in states if state == wrong)
        for wrong in ("passes", "unmatched")
    )
    return Matched(tuple(met), passes, unmatched, tuple(new))


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
    kept = [e for e in (old or Expectations()).entries if run.state(e)[0] in ("met", "idle")]
    known_by = Expectations(tuple(kept))
    for id, failed in run.failing.items():
        entry = known_by.about(run.rows[id])
        if entry is None or not entry.covers(failed):
            kept = [e for e in kept if (e.kind, e.name) != ("id", id)]
            kept.append(Expectation("id", id, reason, level=failed))
    for name in run.against:
        if name not in known_by.of("convention"):
            kept.append(Expectation("convention", name, reason))
    return Expectations(tuple(kept))


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
        return {g.row.id: g.row for g in usual(self.grades)}

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
        levels = ((g.row.id, failed_level(g, self.level)) for g in self.grades)
        return {id: failed for id, failed in levels if failed}

    @cached_property
    def against(self) -> dict[str, str]:
        """Return the types of solid that go against the convention asked, and how they go."""
        touches = {group.name: Touches.of(group.grades) for group in by_solid(self.grades)}
        return {name: t.name for name, t in touches.items() if not t.follows(self.convention)}

    def failures(self, expectations: Expectations) -> tuple[list[str], list[str]]:
        """Return the failures that meet an entry, and those that do not."""
        met, new = list[str](), list[str]()
        for id, failed in self.failing.items():
            entry = expectations.about(self.rows[id])
            if entry is None:
                new.append(id)
            elif entry.covers(failed):
                met.append(id)
            else:
                new.append(f"{id}: fails {failed}, expected to fail from {entry.level} on")
        for name, way in self.against.items():
            text = f"{name}: convention is {way}, not {self.convention}"
            (met if name in expectations.of("convention") else new).append(text)
        return met, new + self._undecided()

    def _undecided(self) -> list[str]:
        """Return the types of solid whose rows do not tell of a level; they refuse a run too."""
        if not self.rows:
            return ["nothing was tested"]
        lines = []
        for group in by_solid(self.grades):
            for level in upto(self.level):
                tally = group.tally(level)
                if not tally.passed and not tally.failed:
                    lines.append(f"{group.name}: no row decides {level}")
                    break
        return lines

    def state(self, entry: Expectation) -> tuple[State, str]:
        if entry.kind == "convention":
            return self._state_of_convention(entry)
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
        if not any(entry.covers(level) for level in failed):
            return "idle", ""  # worse than expected: that is among the new failures
        return "passes", f"passes {entry.level}, fails {min(failed, key=LEVELS.index)}"

    def _state_of_convention(self, entry: Expectation) -> tuple[State, str]:
        if entry.name in self.against:
            return "met", ""
        about = [row for row in self.all.values() if type_of(row.solid) == entry.name]
        if not about:
            return "unmatched", "no such solid is asked"
        whole = all(row.id in self.rows or row.tier == "range" for row in about)
        return ("passes", f"is {self.convention}") if whole else ("idle", "")
