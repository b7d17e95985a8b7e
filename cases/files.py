"""Files that somebody gives, read: of bounded size, as strict JSON or TOML; a fault names the file.

Whatever is read from disk or from a pipe of the user's goes through here, so that what is refused
is refused everywhere alike: a BOM, what is no UTF-8, a key that occurs twice, an object nested
without end, more than `MOST` bytes. What the JSON means is for the function that it is read with;
the faults that it finds are told as those of the file.
"""

from __future__ import annotations

import json
import tomllib
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

T = TypeVar("T")
MOST = 1 << 26
"""The most bytes of a file: its JSON may take forty times as many of memory."""
DEEPEST = 500
"""How deep JSON may be nested: more than the deepest tree of solids, less than Python's stack."""
LONGEST = 1000
"""How many digits an integer may have: no number of either format has so many."""
TOO_DEEP = f"is nested more than {DEEPEST} deep"
BOM = b"\xef\xbb\xbf"


class BadFile(ValueError):
    """A file that cannot be used: the text names it, the place in it, and what is wrong."""


def read_file(path: Path, *, regular: bool = False) -> bytes:
    """Return the bytes of a file. Raises `BadFile`.

    What a person names may be a pipe, and is waited for; of a folder only regular files are read
    (`regular`), since nobody may ever write to a FIFO that lies there.
    """
    try:
        if regular and path.exists() and not path.is_file():
            raise BadFile(f"{path}: is not a regular file; take it away")
        with path.open("rb") as file:
            return read_all(path, file)
    except OSError as error:
        raise BadFile(f"{path}: {error.strerror}") from None


def read_all(name: object, file: BinaryIO) -> bytes:
    """Return what is left of an open file. Raises `BadFile`."""
    data = file.read(MOST + 1)
    if len(data) > MOST:
        raise BadFile(f"{name}: has more than {MOST >> 20} MiB; no file of raycert's is so large")
    return data


def read_text(path: Path) -> str:
    """Return the text of a file in UTF-8. Raises `BadFile`."""
    try:
        return decode_text(read_file(path))
    except BadFile:
        raise
    except ValueError as error:
        raise BadFile(f"{path}: {error}") from None


def read_as(name: object, data: bytes, read: Callable[[object], T]) -> T:
    """Return what `read` makes of JSON. Raises `BadFile`, whose text begins with `name`."""
    try:
        return read(decode_json(data))
    except RecursionError:
        raise BadFile(f"{name}: {TOO_DEEP}") from None
    except ValueError as error:
        raise BadFile(f"{name}: {error}") from None


def read_toml(path: Path) -> dict[str, Any]:
    """Return what a TOML file says. Raises `BadFile`."""
    text = read_text(path)
    try:
        return decode_toml(text)
    except ValueError as error:
        raise BadFile(f"{path}: {error}") from None


def decode_text(data: bytes) -> str:
    """Return a text in UTF-8. Raises `ValueError`."""
    if data.startswith(BOM):
        raise ValueError("begins with a byte order mark; save it as UTF-8 without one")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = 1 + data.count(b"\n", 0, error.start)
        raise ValueError(f"is not UTF-8: byte 0x{data[error.start]:02x} in line {line}") from None


def decode_json(data: bytes | str) -> Any:
    """Return what JSON says: UTF-8, no key twice, not too deep. Raises `ValueError`."""
    text = data if isinstance(data, str) else decode_text(data)
    if not text.strip():
        raise ValueError("is not JSON: it is empty")
    try:
        form = json.loads(text, object_pairs_hook=_once, parse_int=_integer)
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno}"
        raise ValueError(f"is not JSON: {error.msg} ({place})") from None
    except RecursionError:
        raise ValueError(TOO_DEEP) from None
    if not is_shallow(form):
        raise ValueError(TOO_DEEP)
    return form


def decode_toml(text: str) -> dict[str, Any]:
    """Return what TOML says, not too deep. Raises `ValueError`."""
    try:
        form = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"is not TOML: {error}") from None
    except RecursionError:
        raise ValueError(TOO_DEEP) from None
    except ValueError:  # of Python, which reads no such decimal
        raise ValueError("holds an integer of thousands of digits") from None
    if not is_shallow(form):
        raise ValueError(TOO_DEEP)
    return form


def _integer(text: str) -> int:
    if len(text) > LONGEST:
        raise ValueError(f"an integer of {len(text)} digits is beyond every number here")
    return int(text)


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    form = dict(pairs)
    if len(form) < len(pairs):
        twice = Counter(name for name, _ in pairs).most_common(1)[0][0]
        raise ValueError(f"the key {twice!r:.40} occurs twice in one object")
    return form


def is_shallow(form: object) -> bool:
    """Whether a form is nested at most `DEEPEST` deep."""
    level: list[object] = [form]
    for _ in range(DEEPEST):
        level = [part for outer in level for part in _parts(outer)]
        if not level:
            return True
    return False


def _parts(form: object) -> Iterable[object]:
    if isinstance(form, Mapping):
        return form.values()
    return form if isinstance(form, list) else ()
