"""Known failures: a TOML file of what a run is expected to fail on, with a reason and a link each.

    [[expect]]
    family = "needle"          # or id = "far-deep/across-1e9", or convention = "sphere"
    level = "stable"           # the lowest level that fails; left out: any up to the one asked
    reason = "the textbook discriminant; to be replaced"
    link = "https://example.org/issues/12"

A `family` stands for all its rows that fail, a `convention` for a type of solid whose touches go
another way than asked. An expected failure that passes, and an entry that is about nothing in the
corpus, are failures of the run (expected.py): such a file has to be mended.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal

from raycert.cases.levels import LEVELS, Level
from raycert.cases.model import SOLIDS

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


@dataclass(frozen=True, slots=True)
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
        """Return the entries of a kind by name."""
        return {entry.name: entry for entry in self.entries if entry.kind == kind}


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
