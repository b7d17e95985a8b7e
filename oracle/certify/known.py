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
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any, Literal

from raycert.cases.files import BadFile, decode_toml
from raycert.cases.levels import LEVELS, Level, upto
from raycert.cases.model import SOLIDS, type_of
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, usual
from raycert.oracle.certify.verdict import Touches, by_solid

Kind = Literal["id", "family", "convention"]
KINDS: tuple[Kind, ...] = ("id", "family", "convention")
FIELDS = (*KINDS, "level", "reason", "link")


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
        more = f" and {len(bare) - 3} more" if len(bare) > 3 else ""
        return [f"expected failures without a link: {', '.join(bare[:3])}{more}"] if bare else []

    @cached_property
    def by_name(self) -> dict[tuple[Kind, str], Expectation]:
        return {(entry.kind, entry.name): entry for entry in self.entries}

    def about(self, row: GoldenRow) -> Expectation | None:
        """Return the entry about a row: the one for its id before the one for its family."""
        return self.by_name.get(("id", row.id)) or self.by_name.get(("family", row.family))


def read(text: str, file: str = "expectations") -> Expectations:
    """Return the expectations that a TOML text holds. Raises `BadFile`: file, entry and field."""
    try:
        form = decode_toml(text)
    except ValueError as error:
        raise BadFile(f"{file}: {error}") from None
    for name in form:
        if name != "expect":
            raise BadFile(f"{file}: unknown key {name!r:.40}; only [[expect]] is known")
    listed = form.get("expect", [])
    if not isinstance(listed, list):
        raise BadFile(f"{file}: expect is not a list of tables: write [[expect]]")
    entries: dict[tuple[Kind, str], Expectation] = {}
    for number, table in enumerate(listed, 1):
        fault = _fault(table)
        if fault is None:
            kind = next(kind for kind in KINDS if kind in table)
            key = kind, table[kind]
            if key not in entries:
                words = table["reason"], table["link"], table.get("level")
                entries[key] = Expectation(*key, *words)
                continue
            fault = f"{kind} {table[kind]!r} is entry {[*entries].index(key) + 1} too"
        raise BadFile(f"{file}: entry {number}: {fault}")
    return Expectations(tuple(entries.values()))


def _fault(table: Any) -> str | None:
    """Return what is wrong with an entry by itself; None if nothing is."""
    if not isinstance(table, dict):
        return "is not a table: write [[expect]]"
    for name, value in table.items():
        if name not in FIELDS:
            return f"unknown key {name!r:.40} ({', '.join(FIELDS)})"
        if not isinstance(value, str):
            return f"{name} is not a string"
    named = [kind for kind in KINDS if kind in table]
    if len(named) != 1:
        return f"has to have exactly one of {', '.join(KINDS)}"
    if table.get("convention", "sphere") not in SOLIDS:
        return f"convention is not a type of solid ({', '.join(SOLIDS)})"
    for name in ("reason", "link", *named):
        if name not in table:
            return f"{name} is missing"
        if name != "link" and not table[name].strip():
            return f"{name} is empty"
    if "level" in table and "convention" in table:
        return "level is for id and family; a convention has none"
    if table.get("level", LEVELS[0]) not in LEVELS:
        return f"level is not one of {', '.join(LEVELS)}: {table['level']!r:.40}"
    return None


HEAD = (
    "# Failures that `raycert certify --expect FILE` expects. Give each a true reason, and a link\n"
    "# to where it is being dealt with. The form: id, family or convention; level; reason; link.\n"
)


def write(expectations: Expectations) -> str:
    """Return the TOML text of expectations; reading it gives them back."""
    lines = [HEAD]
    for entry in expectations.entries:
        fields = {entry.kind: entry.name, "level": entry.level}
        fields |= {"reason": entry.reason, "link": entry.link}
        lines.append("\n[[expect]]\n")
        lines += [f"{name} = {_quoted(x)}\n" for name, x in fields.items() if x is not None]
    return "".join(lines)


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
    if not usual([grade]):
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
        if ("convention", name) not in known_by.by_name:
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
    def apart(self) -> set[str]:
        """Return the rows graded that the implementation is not for."""
        return {g.row.id for g in self.grades if g.place != "inside"}

    @cached_property
    def all(self) -> dict[str, GoldenRow]:
        """Return all rows that could have been asked."""
        return self.known | {g.row.id: g.row for g in self.grades}

    @cached_property
    def _about(self) -> dict[tuple[str, str], list[GoldenRow]]:
        """Return the rows that an entry of this kind and name is about."""
        about: dict[tuple[str, str], list[GoldenRow]] = {}
        for row in self.all.values():
            values = row.id, row.family, type_of(row.solid)
            for key in zip(KINDS, values, strict=True):
                about.setdefault(key, []).append(row)
        return about

    @cached_property
    def failing(self) -> dict[str, Level]:
        """Return the rows that fail, each with the lowest level."""
        levels = ((g.row.id, failed_level(g, self.level)) for g in self.grades)
        return {id: failed for id, failed in levels if failed}

    @cached_property
    def against(self) -> dict[str, str]:
        """Return the types of solid that go against the convention asked, and how they go."""
        touches = {group.name: Touches.of(group.grades) for group in by_solid(self.grades)}
        return {name: t.told for name, t in touches.items() if not t.follows(self.convention)}

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
            (met if ("convention", name) in expectations.by_name else new).append(text)
        return met, new + self._undecided()

    def _undecided(self) -> list[str]:
        """Return the types of solid whose rows do not tell of a level; they refuse a run too."""
        if not self.rows:
            return ["nothing was tested"]
        lines = []
        for group in by_solid(self.grades):
            tallies = ((level, group.tally(level)) for level in upto(self.level))
            if level := next((level for level, t in tallies if not t.passed + t.failed), None):
                lines.append(f"{group.name}: no row decides {level}")
        return lines

    def state(self, entry: Expectation) -> tuple[State, str]:
        about = self._about.get((entry.kind, entry.name), [])
        counted = [row for row in about if row.tier != "range" and row.id not in self.apart]
        whole = all(row.id in self.rows for row in counted)
        if entry.kind == "convention":
            if not about:
                return "unmatched", "no such solid is asked"
            if entry.name in self.against:
                return "met", ""
            return ("passes", f"is {self.convention}") if whole else ("idle", "")
        if not counted:
            why = "is of the range tier, or not what the target is for: part of no level"
            return "unmatched", why if about else f"no such {entry.kind} is asked"
        failed = [self.failing[row.id] for row in counted if row.id in self.failing]
        if any(entry.level in (None, level) for level in failed):
            return "met", ""
        if not whole or (entry.level and entry.level not in upto(self.level)):
            return "idle", ""
        if not failed:
            return "passes", f"passes {entry.level or self.level}"
        if not any(entry.covers(level) for level in failed):
            return "idle", ""  # worse than expected: that is among the new failures
        return "passes", f"passes {entry.level}, fails {min(failed, key=LEVELS.index)}"
