"""From a found case to a case of a corpus: checked by every witness, named, and kept.

A corpus is a folder: `adopted/` has the inputs (cases.families.adopted), `golden/` the rows made of
them. In a checkout that is `cases/`, whose golden files hold the families of the catalogue too.
Rows are made before anything is written, and the files of other families stay as they are.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from raycert.cases.case import Case, Family, Tier
from raycert.cases.corpus import (
    GOLDEN,
    MANIFEST,
    decode_rows,
    golden_file,
    manifest,
    read_manifest,
    write_whole,
)
from raycert.cases.families.adopted import (
    REASON,
    Adopted,
    cases_of,
    encode,
    families,
    read,
    slug_of,
)
from raycert.cases.families.catalog import FAMILIES
from raycert.cases.files import read_file
from raycert.cases.flags import FLAGS
from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.interrupts import held
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Ray, Solid, leaves, type_of
from raycert.cases.numbers import Probe, is_usual, numbers
from raycert.cases.row import GoldenRow
from raycert.oracle.corpus.golden import Contradiction, golden_files
from raycert.oracle.corpus.lock import locked
from raycert.oracle.exact.condition import condition
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness.crosscheck import Hearing, Query, check
from raycert.oracle.witness.testimony import WITNESSES, Missing, load

CORPUS = GOLDEN.parent
"""The corpus of a checkout."""
SLUG = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
MODAL = re.compile(r"\b(should|must|can|could|may|might|shall|will|would|ought|cannot)\b", re.I)
LONGEST_WHY, LONGEST_SLUG = 110, 60


class Unfit(ValueError):
    """A case, or what is said of it, that no corpus takes; the text says why."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A case to adopt: what is asked, in which format it was found, and what is said of it."""

    solid: Solid
    ray: Ray
    format: Format
    why: str
    source: str = "oracle"
    flags: tuple[str, ...] = ()
    tier: Tier | None = None

    @property
    def probe(self) -> Probe:
        return Probe(self.solid, self.ray)


@dataclass(frozen=True, slots=True)
class Adoption:
    """A case that was adopted: its id, its precisions, and the files that were written."""

    id: str
    precisions: tuple[str, ...]
    files: tuple[Path, ...]


def installed() -> tuple[str, ...]:
    names = []
    for name in WITNESSES:
        try:
            load(name)
        except Missing:
            continue
        names.append(name)
    return tuple(names)


def examine(candidate: Candidate, witnesses: Sequence[str]) -> Hearing:
    """Return what witnesses say of a case. Raises `Contradiction` where one finds another list."""
    checked = check(Query("found", candidate.solid, candidate.ray), witnesses)
    for name, verdict, _ in checked.testimonies:
        if verdict.outcome == "disagreed":
            found = f"{name} finds {verdict.found}, the oracle {checked.answer}"
            raise Contradiction(f"{found}: {verdict.why}")
    return checked


def adopt(corpus: Path, name: str, candidate: Candidate, slug: str | None = None) -> Adoption:
    """Keep a case in a family of a corpus, as inputs and as golden rows.

    Raises `Unfit` and `BadFile`; then nothing is written.
    """
    _fit(name, candidate)
    with locked(corpus / "golden"):
        return _adopt(corpus, name, candidate, slug)


def _adopt(corpus: Path, name: str, candidate: Candidate, slug: str | None) -> Adoption:
    source = corpus / "adopted" / f"{name}.jsonl"
    entries = read(source)
    golden = corpus / "golden"
    files = _files(golden)
    _new(candidate, files)
    if any(isinstance(e, Adopted) and e.case.why == candidate.why for e in entries):
        raise Unfit("--why: another case of the family says the same; say what this one shows")
    precisions = _precisions(candidate)
    taken = {slug_of(entry) for entry in entries}
    slug, own = _slug(candidate, slug, taken), candidate.tier or tier(candidate)
    said = candidate.why, candidate.solid, candidate.ray, own, candidate.flags, candidate.source
    case = Case(slug, *said)
    entries = (*entries, Adopted(case, precisions))
    family = Family(name, REASON, lambda fmt: cases_of(entries, fmt))
    made = dict(golden_files((family,), lambda _: None))
    with held():
        write_whole(source, encode(entries))
        for file, data in made.items():
            write_whole(golden / file, data)
        write_whole(golden / MANIFEST, manifest(files | made))
    return Adoption(f"{name}/{case.slug}", precisions, (source, *(golden / file for file in made)))


def sources(corpus: Path) -> tuple[Family, ...]:
    """Return the families of a corpus: the catalogue's too for that of the checkout."""
    own = families(corpus / "adopted")
    if corpus.resolve() != CORPUS.resolve():
        return own
    names = {family.name for family in own}
    return (*(family for family in FAMILIES if family.name not in names), *own)


def tier(candidate: Candidate) -> Tier:
    """Return the tier of a case; stiff is a touch, and what takes half of the digits or more."""
    if not is_usual(candidate.probe, candidate.format):
        return "range"
    if is_lattice(candidate.solid, candidate.ray):
        return "lattice"
    intervals = trace(candidate.solid, candidate.ray).intervals
    size = condition(intervals, candidate.solid, candidate.ray)
    touches = any(enter == leave for enter, leave in intervals)
    hard = touches or (size is not None and size >= candidate.format.precision // 2)
    return "stiff" if hard else "generic"


def _fit(name: str, candidate: Candidate) -> None:
    """Refuse a name, a sentence, a source or a flag that no family of a corpus has."""
    _spelled("--family", name)
    adopted = {family.name for family in families(CORPUS / "adopted")}
    if name in {family.name for family in FAMILIES} - adopted:
        raise Unfit(f"--family: {name} is made by the catalogue; choose another name")
    why = candidate.why
    if len(why) > LONGEST_WHY or not re.fullmatch(r"[A-Z0-9][ -~]*[^.]\.", why):
        raise Unfit(
            f"--why: say one fact, as a sentence of at most {LONGEST_WHY} ASCII characters that "
            "begins with a capital and ends with a period"
        )
    if word := MODAL.search(why):
        raise Unfit(f"--why: say what is, without {word[0]!r}")
    if (
        not re.fullmatch(r"[!-~][ -~]{1,118}", candidate.source)
        or candidate.source == "construction"
    ):
        raise Unfit("--source: name a public report; 'construction' is for lists known beforehand")
    if unknown := [flag for flag in candidate.flags if flag not in FLAGS]:
        raise Unfit(f"--flag: not in the legend: {', '.join(unknown)}; see: raycert list --flags")
    lattice = is_lattice(candidate.solid, candidate.ray)
    if candidate.tier not in (None, "range") and (candidate.tier == "lattice") != lattice:
        where = "on" if lattice else "off"
        raise Unfit(f"--tier: the case is {where} the lattice, so it is not {candidate.tier}")


def _files(golden: Path) -> dict[str, bytes]:
    """Return the golden files of a corpus, none where there is no manifest."""
    if not (golden / MANIFEST).exists():
        return {}
    entries = read_manifest(golden)["files"].items()
    return {file: golden_file(golden, file, entry) for file, entry in entries}


def _new(candidate: Candidate, files: dict[str, bytes]) -> None:
    """Refuse a case that the corpus asks already."""
    asked = _inputs(candidate)
    for file, data in files.items():
        if file.partition("/")[0] != candidate.format.name:
            continue
        lines = b"\n".join(line for line in data.splitlines() if asked in line)
        for row in decode_rows(lines, candidate.format, file):
            raise Unfit(f"{row.id} asks the same")


def _inputs(candidate: Candidate) -> bytes:
    form = {"solid": write_solid(candidate.solid, "hex"), "ray": write_ray(candidate.ray, "hex")}
    return json.dumps(form, separators=(",", ":"))[1:-1].encode()


def _precisions(candidate: Candidate) -> tuple[str, ...]:
    """Return the formats in which to ask: the one it was found in, and those that fit as well."""
    probe, own = candidate.probe, candidate.format

    def fits(fmt: Format) -> bool:
        held = all(map(fmt.holds, numbers(probe)))
        return held and is_usual(probe, fmt) == is_usual(probe, own)

    return tuple(name for name, fmt in FORMATS.items() if fmt is own or fits(fmt))


def _slug(candidate: Candidate, wanted: str | None, taken: set[str]) -> str:
    if wanted is not None:
        _spelled("--slug", wanted)
    slug = wanted or slug_for(candidate)
    if slug in taken and wanted is None:
        slug += f"-{hashlib.sha256(_inputs(candidate)).hexdigest()[:8]}"
    if slug in taken:
        raise Unfit(f"--slug: {slug} is taken, and no slug is used again; give another")
    return slug


def _spelled(option: str, slug: str) -> None:
    if not SLUG.fullmatch(slug) or len(slug) > LONGEST_SLUG:
        raise Unfit(f"{option}: {slug!r:.40} is not lower-case words joined by -")


def slug_for(candidate: Candidate) -> str:
    """Return a slug in words of what a case shows: its flags or rows, and its solid."""
    kinds = dict.fromkeys(type_of(leaf) for _, leaf in leaves(candidate.solid))
    solid = type_of(candidate.solid)
    if solid not in kinds:
        solid = "-".join((solid, *kinds))
    answer = trace(candidate.solid, candidate.ray)
    rows = [row.lower() for row in answer.rows if re.fullmatch(r"[A-Za-z-]+", row)]
    count = {0: "no-pair", 1: "pair"}.get(len(answer.intervals), f"{len(answer.intervals)}-pairs")
    what = candidate.flags or tuple(dict.fromkeys(rows))[:4] or (count,)
    words = "-".join((*what, solid)).replace("_", "-")
    return words if len(words) <= LONGEST_SLUG else words[:LONGEST_SLUG].rpartition("-")[0]


def from_row(row: GoldenRow, fmt: Format, why: str) -> Candidate:
    source = "oracle" if row.source == "construction" else row.source
    return Candidate(row.solid, row.ray, fmt, why, source, row.flags)


def rows_in(path: Path, fmt: Format) -> list[tuple[GoldenRow, Format]]:
    """Return the golden rows of a file, or of all files of a directory, with their formats.

    The format of a file is told by its folder; else it is `fmt`. Raises `BadFile`.
    """
    found = []
    for file in sorted(path.glob("*/*.jsonl")) if path.is_dir() else [path]:
        own = FORMATS.get(file.parent.name, fmt)
        data = read_file(file, regular=path.is_dir())
        found += [(row, own) for row in decode_rows(data, own, str(file))]
    return found
