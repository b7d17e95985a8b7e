"""The adopted cases: found by a search, or reported, and kept as data; a family for each file.

`adopted/<family>.jsonl` has a case a line: its inputs, why it is asked, and in which precisions.
The answers are the oracle's, in the golden files. A file is read when its family is asked for its
cases, so that a bad one stops nobody else. A slug is never used again: a case that is taken out
leaves `{"slug": ..., "retired": why}`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from raycert.cases.case import TIERS, Case, Family
from raycert.cases.files import BadFile, read_as, read_file
from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import Fields, Json, read_ray, read_solid, write_ray, write_solid
from raycert.cases.model import Refused

FOLDER = Path(__file__).parents[1] / "adopted"
REASON = "Cases that implementations were found to answer wrong, kept as they were found."
FIELDS = {"slug", "why", "flags", "tier", "source", "precisions", "solid", "ray"}


@dataclass(frozen=True, slots=True)
class Adopted:
    """A case and the precisions in which it is asked."""

    case: Case
    precisions: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Retired:
    """A slug that no case may have again, and why."""

    slug: str
    why: str


Entry = Adopted | Retired


def families(folder: Path = FOLDER) -> tuple[Family, ...]:
    """Return a family for each file of a folder, by name."""
    return tuple(family(path.stem, path) for path in sorted(folder.glob("*.jsonl")))


def family(name: str, path: Path) -> Family:
    return Family(name, REASON, lambda fmt: list(cases_of(read(path), fmt)))


def cases_of(entries: Iterable[Entry], fmt: Format) -> Iterator[Case]:
    for entry in entries:
        if isinstance(entry, Adopted) and fmt.name in entry.precisions:
            yield entry.case


def slug_of(entry: Entry) -> str:
    return entry.slug if isinstance(entry, Retired) else entry.case.slug


def read(path: Path) -> tuple[Entry, ...]:
    """Return the entries of a file, none if there is no such file. Raises `BadFile`."""
    entries: list[Entry] = []
    seen: set[str] = set()
    data = read_file(path, regular=True) if path.exists() else b""
    for number, line in enumerate(data.splitlines(), 1):
        entry = read_as(f"{path}:{number}", line, read_entry)
        if slug_of(entry) in seen:
            raise BadFile(f"{path}:{number}: the slug {slug_of(entry)} occurs twice")
        seen.add(slug_of(entry))
        entries.append(entry)
    return tuple(entries)


def encode(entries: Iterable[Entry]) -> bytes:
    lines = (json.dumps(write_entry(entry), separators=(",", ":")) + "\n" for entry in entries)
    return "".join(lines).encode("ascii")


def read_entry(form: object) -> Entry:
    get = Fields(form, "case")
    if set(get.form) == {"slug", "retired"}:
        return Retired(_text(get, "slug"), _text(get, "retired"))
    if set(get.form) != FIELDS:
        raise Refused("case", f"has not the fields {', '.join(sorted(FIELDS))}")
    precisions, tier = get.some_of("precisions", FORMATS), get.one_of("tier", TIERS)
    if not precisions:
        raise Refused("case.precisions", "is empty")
    narrowest = min((FORMATS[name] for name in precisions), key=lambda fmt: fmt.precision)
    solid = read_solid(get.form["solid"], "solid", "hex", narrowest)
    ray = read_ray(get.form["ray"], "ray", "hex", narrowest)
    slug, why, source = (_text(get, name) for name in ("slug", "why", "source"))
    return Adopted(Case(slug, why, solid, ray, tier, get.many("flags", str), source), precisions)


def write_entry(entry: Entry) -> Json:
    if isinstance(entry, Retired):
        return {"slug": entry.slug, "retired": entry.why}
    case = entry.case
    return {
        "slug": case.slug,
        "why": case.why,
        "flags": list(case.flags),
        "tier": case.tier,
        "source": case.source,
        "precisions": list(entry.precisions),
        "solid": write_solid(case.solid, "hex"),
        "ray": write_ray(case.ray, "hex"),
    }


def _text(get: Fields, name: str) -> str:
    text: str = get(name, str)
    if not text:
        raise Refused(f"case.{name}", "is not a text")
    return text


FAMILIES = families()
