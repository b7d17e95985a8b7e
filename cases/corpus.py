"""The golden corpus on disk: one file of rows per family and precision, and a manifest of all.

`golden/<precision>/<family>.jsonl` holds one row a line, ASCII. `golden/manifest.json` has each
file's row count and SHA-256, the format's and the corpus's version. Files are written only whole.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterable, Iterator, Set
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex
from typing import Any, NamedTuple

from raycert.cases.files import BadFile, read_as, read_file
from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import fields_of
from raycert.cases.model import SOLIDS, Refused, type_of
from raycert.cases.row import GoldenRow, read_row, row_of, write_row

FORMAT_VERSION = 1
CORPUS_VERSION = "2026.2"
GOLDEN = Path(__file__).parent / "golden"
MANIFEST = "manifest.json"
NAME = re.compile(rf"({'|'.join(FORMATS)})/[a-z0-9]+(-[a-z0-9]+)*\.jsonl")
VERSION = re.compile(r"[0-9]{4}\.[0-9]+")
WORDS = {"rows": "has {} rows", "sha256": "SHA-256 differs: it is {}"}
START = re.compile(
    rb'{"id":"([a-z0-9/-]+)","why":"(?:[^"\\]|\\.)*","flags":\[[^]]*\],"tier":"([a-z]+)",'
    rb'"source":"(?:[^"\\]|\\.)*","solid":{"type":"([a-z_]+)"'
)
"""How the line of a row begins: id, tier and type of the solid."""
TYPE = re.compile(rb'"type":"([a-z_]+)"')
_LINE = json.JSONEncoder(separators=(",", ":")).encode


class Heading(NamedTuple):
    """What a row is found by; `solid` is the type of its solid, of a tree the root's."""

    id: str
    tier: str
    solid: str

    @classmethod
    def of(cls, row: GoldenRow) -> Heading:
        return cls(row.id, row.tier, type_of(row.solid))

    @property
    def family(self) -> str:
        return self.id.partition("/")[0]


@dataclass(frozen=True, slots=True)
class Corpus:
    """The rows of one precision, in the order of the files, and what identifies them.

    Of rows that nobody needs only the heading may have been read.
    """

    rows: tuple[GoldenRow, ...]
    precision: str
    version: str
    sha256: str
    unread: tuple[Heading, ...] = ()

    @property
    def headings(self) -> tuple[Heading, ...]:
        """Return the headings of all rows, those that were read first."""
        return (*map(Heading.of, self.rows), *self.unread)

    @property
    def format(self) -> Format:
        return FORMATS[self.precision]

    def row(self, id: str) -> GoldenRow | None:
        return next((row for row in self.rows if row.id == id), None)


def encode_rows(rows: Iterable[GoldenRow], fmt: Format) -> bytes:
    lines = (_LINE(write_row(row, fmt)) + "\n" for row in rows)
    return "".join(lines).encode("ascii")


def decode_rows(data: bytes, fmt: Format, name: str) -> Iterator[GoldenRow]:
    """Yield the rows of a golden file. Raises `BadFile` naming the line that is none.

    A line is a row only as it is written, to the byte: no key twice, no other order, no digit more.
    """
    for number, line in enumerate(data.splitlines(), 1):
        yield _decode_row(line, fmt, f"{name}:{number}")


def _decode_row(line: bytes, fmt: Format, place: str, ours: bool = False) -> GoldenRow:
    """Return the row on a line. Of a line of `ours` the spelling is known: we have written it."""
    try:
        form = json.loads(line)
        row = row_of(form, fmt)
        if not ours and encode_rows((row,), fmt)[:-1] != line:
            read_row(form, fmt)
            raise ValueError("is not spelled as a row is written: keys, their order, spaces")
    except (ValueError, RecursionError) as error:
        raise BadFile(f"{place}: {error}") from None
    return row


def _heading(line: bytes, unwanted: Set[str]) -> Heading | None:
    """Return the heading of a row with a part of an unwanted type; None where it has to be read.

    In JSON a text has its quotation marks escaped, so that what looks like a type is one.
    """
    if not unwanted or unwanted.isdisjoint(map(bytes.decode, TYPE.findall(line))):
        return None
    start = START.match(line)
    return Heading(*map(bytes.decode, start.groups())) if start else None


def manifest(files: dict[str, bytes]) -> bytes:
    """Return the bytes of the manifest of these files, by relative name."""
    entries = {name: _entry(data) for name, data in sorted(files.items())}
    form = {"format": FORMAT_VERSION, "corpus": CORPUS_VERSION, "files": entries}
    return (json.dumps(form, indent=1) + "\n").encode("ascii")


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return the manifest of a golden directory. Raises `BadFile` where there is none."""
    path = folder / MANIFEST
    try:
        return read_as(path, read_file(path, regular=True), _manifest)
    except BadFile as error:
        raise BadFile(f"{error}; write one with: raycert golden write") from None


def _manifest(form: object) -> dict[str, Any]:
    """Return a form as it is if it is that of a manifest, or refuse it."""
    fields = fields_of(form, "", ("format", "corpus", "files"))
    version, corpus, files = (fields[name] for name in ("format", "corpus", "files"))
    if version is True or version != FORMAT_VERSION:
        raise Refused("format", f"is not {FORMAT_VERSION}: {version!r:.40}")
    if not isinstance(corpus, str) or not VERSION.fullmatch(corpus):
        raise Refused("corpus", f"is not a year and a number such as 2026.1: {corpus!r:.40}")
    if not isinstance(files, dict):
        raise Refused("files", "is not an object")
    for name, entry in files.items():
        if not NAME.fullmatch(name):
            raise Refused(f"files.{name}", "is not PRECISION/FAMILY.jsonl")
        fields_of(entry, f"files.{name}", ("rows", "sha256"))
    return dict(fields)


def golden_file(folder: Path, name: str, entry: dict[str, Any]) -> bytes:
    """Return a file of a golden directory. Raises `BadFile` if it is not what its entry says."""
    data = read_file(folder / name, regular=True)
    for what, found in _entry(data).items():
        if entry[what] != found or isinstance(entry[what], bool):
            said = WORDS[what].format(found)
            raise BadFile(f"{folder / name}: {said}, the manifest says {entry[what]!r:.80}")
    return data


def _entry(data: bytes) -> dict[str, Any]:
    return {"rows": data.count(b"\n"), "sha256": hashlib.sha256(data).hexdigest()}


def read_corpus(
    precision: str = "binary64", folder: Path = GOLDEN, solids: Iterable[str] = tuple(SOLIDS)
) -> Corpus:
    """Return the rows of one precision, each file checked against the manifest.

    Only rows whose solid is made of these types are read, and of the others the headings. Raises
    `BadFile` for a file that is missing, altered, or holds what is no row of its family.
    """
    form, unwanted = read_manifest(folder), SOLIDS.keys() - set(solids)
    rows: dict[str, GoldenRow | Heading] = {}
    for name, entry in form["files"].items():
        if not name.startswith(f"{precision}/"):
            continue
        path = folder / name
        for number, line in enumerate(golden_file(folder, name, entry).splitlines(), 1):
            heading = _heading(line, unwanted)
            place = f"{path}:{number}"
            row = heading or _decode_row(line, FORMATS[precision], place, folder == GOLDEN)
            if row.id in rows:
                raise BadFile(f"{path}: the id {row.id} occurs twice")
            if name != f"{precision}/{row.family}.jsonl":
                raise BadFile(f"{path}: the id {row.id} is of another family")
            rows[row.id] = row
    read = tuple(row for row in rows.values() if isinstance(row, GoldenRow))
    unread = tuple(row for row in rows.values() if isinstance(row, Heading))
    return Corpus(read, precision, form["corpus"], digest(folder), unread)


def digest(folder: Path) -> str:
    """Return the SHA-256 of a manifest, and so of every file. Raises `BadFile`."""
    return hashlib.sha256(read_file(folder / MANIFEST, regular=True)).hexdigest()


def write_whole(path: Path, data: bytes) -> None:
    """Write a file so that it is there either as before or whole; its mode stays.

    What is no regular file, a device, a FIFO, a link, is written through and stays what it is.
    """
    if path.is_symlink() or (path.exists() and not path.is_file()):
        path.write_bytes(data)
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    mode = path.stat().st_mode & 0o7777 if path.exists() else None
    temporary = path.with_name(f".{path.name[:40]}.{token_hex(8)}")  # as short as any name may be

    def create(name: str, flags: int) -> int:
        return os.open(name, flags, 0o666 if mode is None else mode)

    try:
        with open(temporary, "xb", opener=create) as file:
            file.write(data)
        if mode is not None:
            os.chmod(temporary, mode)
        os.replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def append_whole(path: Path, data: bytes) -> None:
    """Add lines to a file, whole or not at all, a blank line between them and what is there."""
    if not path.is_file():
        write_whole(path, data)
        return
    with path.open("a+b", buffering=0) as file:
        end = file.seek(0, os.SEEK_END)
        file.seek(max(end - 2, 0))
        last = file.read(2)
        breaks = 0 if not end or last == b"\n\n" else 1 if last.endswith(b"\n") else 2
        rest = memoryview(b"\n" * breaks + data)
        try:
            while rest:
                rest = rest[file.write(rest) :]
        except BaseException:
            file.truncate(end)
            raise
