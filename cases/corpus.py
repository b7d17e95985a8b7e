"""The golden corpus on disk: one file of rows per family and precision, and a manifest of all.

`golden/<precision>/<family>.jsonl` holds one row a line, ASCII. `golden/manifest.json` has each
file's row count and SHA-256, the format's and the corpus's version. Files are written only whole.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raycert.cases.formats import FORMATS, Format
from raycert.cases.model import Refused
from raycert.cases.row import GoldenRow, read_row, write_row

FORMAT_VERSION = 1
CORPUS_VERSION = "2026.1"
GOLDEN = Path(__file__).parent / "golden"
MANIFEST = "manifest.json"


class BadCorpus(ValueError):
    """A golden directory that cannot be used; the text names the file and line."""


@dataclass(frozen=True, slots=True)
class Corpus:
    """The rows of one precision, in the order of the files, and what identifies them."""

    rows: tuple[GoldenRow, ...]
    precision: str
    version: str
    sha256: str

    @property
    def format(self) -> Format:
        return FORMATS[self.precision]

    def row(self, id: str) -> GoldenRow | None:
        return next((row for row in self.rows if row.id == id), None)


def encode_rows(rows: Iterable[GoldenRow], fmt: Format) -> bytes:
    lines = (json.dumps(write_row(row, fmt), separators=(",", ":")) + "\n" for row in rows)
    return "".join(lines).encode("ascii")


def decode_rows(data: bytes, fmt: Format, name: str) -> Iterator[GoldenRow]:
    """Yield the rows of a golden file. Raises `BadCorpus` naming the line that is none."""
    for number, line in enumerate(data.splitlines(), 1):
        try:
            yield read_row(json.loads(line), fmt)
        except (ValueError, Refused, RecursionError) as error:
            raise BadCorpus(f"{name}:{number}: {error}") from None


def manifest(files: dict[str, bytes]) -> bytes:
    """Return the bytes of the manifest of these files, by relative name."""
    entries = {
        name: {"rows": data.count(b"\n"), "sha256": hashlib.sha256(data).hexdigest()}
        for name, data in sorted(files.items())
    }
    form = {"format": FORMAT_VERSION, "corpus": CORPUS_VERSION, "files": entries}
    return (json.dumps(form, indent=1) + "\n").encode("ascii")


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return the manifest of a golden directory. Raises `BadCorpus` where there is none."""
    path = folder / MANIFEST
    try:
        form = json.loads(path.read_bytes())
        version, files = form["format"], form["files"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise BadCorpus(f"{path}: {error}; write one with: raycert golden write") from None
    if version != FORMAT_VERSION or not isinstance(files, dict):
        raise BadCorpus(f"{path}: format {version!r} is not {FORMAT_VERSION}")
    return dict(form)


def read_corpus(precision: str = "binary64", folder: Path = GOLDEN) -> Corpus:
    """Return the rows of one precision, each file checked against the manifest.

    Raises `BadCorpus` for a file that is missing, altered, or holds what is no row.
    """
    form = read_manifest(folder)
    rows: list[GoldenRow] = []
    seen: set[str] = set()
    for name, entry in form["files"].items():
        if not name.startswith(f"{precision}/"):
            continue
        data = _checked(folder / name, entry)
        for row in decode_rows(data, FORMATS[precision], name):
            if row.id in seen:
                raise BadCorpus(f"{name}: the id {row.id} occurs twice")
            seen.add(row.id)
            rows.append(row)
    digest = hashlib.sha256((folder / MANIFEST).read_bytes()).hexdigest()
    return Corpus(tuple(rows), precision, str(form.get("corpus", "")), digest)


def _checked(path: Path, entry: object) -> bytes:
    try:
        data = path.read_bytes()
    except OSError as error:
        raise BadCorpus(f"{path}: {error.strerror}") from None
    digest = hashlib.sha256(data).hexdigest()
    if not isinstance(entry, dict) or entry.get("sha256") != digest:
        raise BadCorpus(f"{path}: SHA-256 differs from the manifest's: {digest}")
    return data


def write_whole(path: Path, data: bytes) -> None:
    """Write a file so that it is there either as before or whole; its mode stays.

    What is no regular file, a device, a FIFO, a link, is written through and stays what it is.
    """
    if path.is_symlink() or (path.exists() and not path.is_file()):
        path.write_bytes(data)
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    mode = path.stat().st_mode & 0o7777 if path.exists() else 0o644
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, mode)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
