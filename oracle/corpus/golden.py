"""From cases to golden rows: the exact answer in every form that a row holds; write and check.

Everything is computed anew from the families; nothing is read back but to be compared.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from raycert.cases.case import Case, Family, KnownEnd
from raycert.cases.corpus import MANIFEST, encode_rows, manifest, write_whole
from raycert.cases.files import read_file
from raycert.cases.formats import FORMATS, Format
from raycert.cases.interrupts import held
from raycert.cases.model import Ray, Solid, Tree
from raycert.cases.row import End, GoldenRow, Span
from raycert.oracle.exact.condition import condition
from raycert.oracle.exact.faces import place, touch
from raycert.oracle.exact.intervals import Interval, Intervals
from raycert.oracle.exact.surd import INFINITY, Surd, decimal, enclose, fraction
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.decisive import decisive
from raycert.oracle.judge.levels import MEASURES, Judge
from raycert.oracle.witness.crosscheck import Query, check

Progress = Callable[[str], None]
USUAL = ("definition", "enclosure")
RELEASE = (*USUAL, "symbols", "meshes")
"""The witnesses that a row has to get past before it is written, and those for a release."""


class Contradiction(ArithmeticError):
    """A case on whose answer the oracle is alone: something is wrong, so nothing is written."""


def golden_row(family: Family, case: Case, fmt: Format, witnesses: Sequence[str] = ()) -> GoldenRow:
    """Return the golden row of a case.

    Raises `Contradiction` where the answer known by construction, or a witness, differs.
    """
    answer = trace(case.solid, case.ray)
    id = f"{family.name}/{case.slug}"
    if case.known is not None and known(case.known) != answer.intervals:
        raise Contradiction(f"{id}: known {case.known}, the oracle finds {show(answer.intervals)}")
    for name, verdict, _ in check(Query(id, case.solid, case.ray), witnesses).testimonies:
        if verdict.outcome == "disagreed":
            raise Contradiction(f"{id}: {name} finds {verdict.found}: {verdict.why}")
    judge = Judge(case.solid, case.ray, fmt, case.tier)
    return GoldenRow(
        id=id, why=case.why, flags=case.flags, tier=case.tier, source=case.source,
        solid=case.solid, ray=case.ray, rows=answer.rows,
        condition=condition(answer.intervals, case.solid, case.ray), decisive=decisive(judge),
        intervals=tuple(span(i, case.solid, case.ray, fmt) for i in answer.intervals),
        expected=judge.expected,
        accept={level: judge.accept(level) for level in MEASURES},
    )  # fmt: skip


def span(interval: Interval, solid: Solid, ray: Ray, fmt: Format) -> Span:
    enter, leave = (end(t, solid, ray, fmt) for t in interval)
    return Span(enter, leave, None if isinstance(solid, Tree) else touch(interval, solid, ray))


def end(t: Surd, solid: Solid, ray: Ray, fmt: Format) -> End:
    at, rounded, value = place(t, solid, ray), enclose(t, fmt), t.rational()
    irrational = t.finite and value is None
    return End(
        polynomial=t.polynomial() if irrational else None, root=t.root() if irrational else None,
        fraction=None if value is None else value.as_integer_ratio(), nearest=rounded.nearest,
        down=rounded.down, up=rounded.up, digits=decimal(t), faces=at.faces, kind=at.kind,
    )  # fmt: skip


def known(pairs: tuple[tuple[KnownEnd, KnownEnd], ...]) -> Intervals:
    """Return an interval list from the endpoints that a construction gives."""
    return tuple((_known_end(a), _known_end(b)) for a, b in pairs)


def _known_end(t: KnownEnd) -> Surd:
    return INFINITY if t is None else fraction(*Fraction(t).as_integer_ratio())


def show(intervals: Intervals) -> str:
    """Return an interval list for people: 20 digits."""
    return "[" + ", ".join(f"[{decimal(a, 20)}, {decimal(b, 20)}]" for a, b in intervals) + "]"


@dataclass(frozen=True, slots=True)
class Drift:
    """A difference between the files on disk and what the oracle writes today."""

    file: str
    what: str


def golden_files(
    families: tuple[Family, ...], progress: Progress, witnesses: Sequence[str] = ()
) -> Iterator[tuple[str, bytes]]:
    """Yield (relative name, bytes) of every golden file; `progress` is told each row's id."""
    for precision, fmt in FORMATS.items():
        for family in families:
            rows = []
            for case in family.cases(fmt):
                rows.append(golden_row(family, case, fmt, witnesses))
                progress(rows[-1].id)
            if rows:  # what was found in one format may have none in the other
                yield f"{precision}/{family.name}.jsonl", encode_rows(rows, fmt)


def write(
    folder: Path, families: tuple[Family, ...], progress: Progress, witnesses: Sequence[str] = USUAL
) -> dict[str, bytes]:
    """Write every golden file and the manifest; nothing is touched before all rows are made."""
    files = dict(golden_files(families, progress, witnesses))
    with held():
        for name, data in files.items():
            write_whole(folder / name, data)
        for stale in set(folder.glob("*/*.jsonl")) - {folder / name for name in files}:
            stale.unlink()
        write_whole(folder / MANIFEST, manifest(files))
    return files


def compare(folder: Path, families: tuple[Family, ...], progress: Progress) -> list[Drift]:
    """Return every difference between the files on disk and the rows as computed now."""
    files = dict(golden_files(families, progress))
    drifts = [drift for name, data in files.items() for drift in _compare(folder, name, data)]
    stale = sorted(set(folder.glob("*/*.jsonl")) - {folder / name for name in files})
    drifts += [Drift(str(path.relative_to(folder)), "is of no family") for path in stale]
    return drifts + list(_compare(folder, MANIFEST, manifest(files)))


def _compare(folder: Path, name: str, data: bytes) -> Iterator[Drift]:
    path = folder / name
    if not path.exists():
        yield Drift(name, "is missing")
        return
    found = read_file(path, regular=True)
    if found == data:
        return
    lines, wanted = found.split(b"\n"), data.split(b"\n")
    for number, (old, new) in enumerate(zip(lines, wanted, strict=False), 1):
        if old != new:
            yield Drift(name, f"line {number} differs: {_head(old)} on disk, {_head(new)} computed")
    if len(lines) != len(wanted):
        yield Drift(name, f"has {len(lines) - 1} lines, {len(wanted) - 1} are computed")


def _head(line: bytes) -> str:
    return repr(line[:60].decode("ascii", "replace")) if line else "nothing"
