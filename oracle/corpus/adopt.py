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
    BadCorpus,
    decode_rows,
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
from raycert.cases.flags import FLAGS
from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Ray, Refused, Solid, leaves, type_of
from raycert.cases.numbers import Probe, is_usual, numbers
from raycert.cases.row import GoldenRow
from raycert.oracle.corpus.golden import Contradiction, golden_files
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
class Found:
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
        """Return the case as numbers."""
        return Probe(self.solid, self.ray)


@dataclass(frozen=True, slots=True)
class Kept:
    """A case that was adopted: its id, its precisions, and the files that were written."""

    id: str
    precisions: tuple[str, ...]
    files: tuple[Path, ...]


def installed() -> tuple[str, ...]:
    """Return the names of the witnesses whose libraries are there."""
    names = []
    for name in WITNESSES:
        try:
            load(name)
        except Missing:
            continue
        names.append(name)
    return tuple(names)


def examine(found: Found, witnesses: Sequence[str]) -> Hearing:
    """Return what witnesses say of a case. Raises `Contradiction` where one finds another list."""
    checked = check(Query("found", found.solid, found.ray), witnesses)
    for name, verdict, _ in checked.testimonies:
        if verdict.outcome == "disagreed":
            raise Contradiction(
                f"{name} finds {verdict.found}, the oracle {checked.answer}: {verdict.why}"
            )
    return checked


def adopt(corpus: Path, name: str, found: Found, slug: str | None = None) -> Kept:
    """Keep a case in a family of a corpus, as inputs and as golden rows.

    Raises `Unfit`, `BadAdopted` and `BadCorpus`; then nothing is written.
    """
    _fit(name, found)
    source = corpus / "adopted" / f"{name}.jsonl"
    entries = read(source)
    golden = corpus / "golden"
    files = _files(golden)
    _new(found, files)
    if any(isinstance(e, Adopted) and e.case.why == found.why for e in entries):
        raise Unfit("--why: another case of the family says the same; say what this one shows")
    precisions = _precisions(found)
    taken = {slug_of(entry) for entry in entries}
    case = Case(
        slug=_slug(found, slug, taken),
        why=found.why,
        solid=found.solid,
        ray=found.ray,
        tier=found.tier or tier(found),
        flags=found.flags,
        source=found.source,
    )
    entries = (*entries, Adopted(case, precisions))
    family = Family(name, REASON, lambda fmt: cases_of(entries, fmt))
    made = dict(golden_files((family,), lambda _: None))
    write_whole(source, encode(entries))
    for file, data in made.items():
        write_whole(golden / file, data)
    write_whole(golden / MANIFEST, manifest(files | made))
    return Kept(f"{name}/{case.slug}", precisions, (source, *(golden / file for file in made)))


def sources(corpus: Path) -> tuple[Family, ...]:
    """Return the families of a corpus: the catalogue's too for that of the checkout."""
    own = families(corpus / "adopted")
    if corpus.resolve() != CORPUS.resolve():
        return own
    names = {family.name for family in own}
    return (*(family for family in FAMILIES if family.name not in names), *own)


def tier(found: Found) -> Tier:
    """Return the tier of a case; stiff is a touch, and what takes half of the digits or more."""
    if not is_usual(found.probe, found.format):
        return "range"
    if is_lattice(found.solid, found.ray):
        return "lattice"
    intervals = trace(found.solid, found.ray).intervals
    size = condition(intervals, found.solid, found.ray)
    touches = any(enter == leave for enter, leave in intervals)
    hard = touches or (size is not None and size >= found.format.precision // 2)
    return "stiff" if hard else "generic"


def _fit(name: str, found: Found) -> None:
    """Refuse a name, a sentence, a source or a flag that no family of a corpus has."""
    if not SLUG.fullmatch(name) or len(name) > LONGEST_SLUG:
        raise Unfit(f"--family: {name!r:.40} is not lower-case words joined by -")
    adopted = {family.name for family in families(CORPUS / "adopted")}
    if name in {family.name for family in FAMILIES} - adopted:
        raise Unfit(f"--family: {name} is made by the catalogue; choose another name")
    why = found.why
    if len(why) > LONGEST_WHY or not re.fullmatch(r"[A-Z0-9][ -~]*[^.]\.", why):
        raise Unfit(
            f"--why: say one fact, as a sentence of at most {LONGEST_WHY} ASCII characters that "
            "begins with a capital and ends with a period"
        )
    if word := MODAL.search(why):
        raise Unfit(f"--why: say what is, without {word[0]!r}")
    if not re.fullmatch(r"[!-~][ -~]{1,118}", found.source) or found.source == "construction":
        raise Unfit("--source: name a public report; 'construction' is for lists known beforehand")
    if unknown := [flag for flag in found.flags if flag not in FLAGS]:
        raise Unfit(f"--flag: not in the legend: {', '.join(unknown)}; see: raycert list --flags")
    lattice = is_lattice(found.solid, found.ray)
    if found.tier not in (None, "range") and (found.tier == "lattice") != lattice:
        where = "on" if lattice else "off"
        raise Unfit(f"--tier: the case is {where} the lattice, so it is not {found.tier}")


def _files(golden: Path) -> dict[str, bytes]:
    """Return the golden files of a corpus, none where there is no manifest."""
    if not (golden / MANIFEST).exists():
        return {}
    files = {}
    for file, entry in read_manifest(golden)["files"].items():
        data = (golden / file).read_bytes() if (golden / file).is_file() else b""
        if hashlib.sha256(data).hexdigest() != entry["sha256"]:
            raise BadCorpus(f"{golden / file} is not as in the manifest; see: raycert golden check")
        files[file] = data
    return files


def _new(found: Found, files: dict[str, bytes]) -> None:
    """Refuse a case that the corpus asks already."""
    asked = _inputs(found)
    for file, data in files.items():
        if file.partition("/")[0] != found.format.name:
            continue
        lines = b"\n".join(line for line in data.splitlines() if asked in line)
        for row in decode_rows(lines, found.format, file):
            raise Unfit(f"{row.id} asks the same")


def _inputs(found: Found) -> bytes:
    """Return the case as a golden row spells it."""
    form = {"solid": write_solid(found.solid, "hex"), "ray": write_ray(found.ray, "hex")}
    return json.dumps(form, separators=(",", ":"))[1:-1].encode()


def _precisions(found: Found) -> tuple[str, ...]:
    """Return the formats in which to ask: the one it was found in, and those that fit as well."""

    def fits(fmt: Format) -> bool:
        held = all(fmt.holds(x) for x in numbers(found.probe))
        return held and is_usual(found.probe, fmt) == is_usual(found.probe, found.format)

    return tuple(name for name, fmt in FORMATS.items() if fmt is found.format or fits(fmt))


def _slug(found: Found, wanted: str | None, taken: set[str]) -> str:
    if wanted is not None:
        if not SLUG.fullmatch(wanted) or len(wanted) > LONGEST_SLUG:
            raise Unfit(f"--slug: {wanted!r:.40} is not lower-case words joined by -")
        if wanted in taken:
            raise Unfit(f"--slug: {wanted} is taken, and no slug is used again")
        return wanted
    slug = shown(found)
    if slug in taken:
        slug += f"-{hashlib.sha256(_inputs(found)).hexdigest()[:8]}"
    if slug in taken:
        raise Unfit(f"--slug: {slug} is taken, and no slug is used again; give one")
    return slug


def shown(found: Found) -> str:
    """Return a slug in words of what a case shows: its flags or rows, and its solid."""
    kinds = dict.fromkeys(type_of(leaf) for _, leaf in leaves(found.solid))
    solid = type_of(found.solid)
    if solid not in kinds:
        solid = "-".join((solid, *kinds))
    answer = trace(found.solid, found.ray)
    rows = [row.lower() for row in answer.rows if re.fullmatch(r"[A-Za-z-]+", row)]
    count = {0: "no-pair", 1: "pair"}.get(len(answer.intervals), f"{len(answer.intervals)}-pairs")
    what = found.flags or tuple(dict.fromkeys(rows))[:4] or (count,)
    words = "-".join((*what, solid)).replace("_", "-")
    return words if len(words) <= LONGEST_SLUG else words[:LONGEST_SLUG].rpartition("-")[0]


def from_row(row: GoldenRow, fmt: Format, why: str) -> Found:
    """Return the case of a golden row, such as one that a hunt wrote."""
    source = "oracle" if row.source == "construction" else row.source
    return Found(row.solid, row.ray, fmt, why, source, row.flags)


def rows_in(path: Path, fmt: Format) -> list[tuple[GoldenRow, Format]]:
    """Return the golden rows of a file, or of all files of a directory, with their formats.

    The format of a file is told by its folder; else it is `fmt`. Raises `BadCorpus`.
    """
    found = []
    for file in sorted(path.glob("*/*.jsonl")) if path.is_dir() else [path]:
        own = FORMATS.get(file.parent.name, fmt)
        try:
            found += [(row, own) for row in decode_rows(file.read_bytes(), own, str(file))]
        except Refused as error:
            raise BadCorpus(f"{file}: {error}") from None
    return found
