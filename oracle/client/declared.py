"""A target of which other things are declared than it says: fields of its hello, from a file.

The file is an object of fields as a hello has them, JSON or TOML, and holds for every start. What
it does not name is as the target says. Programs are then asked and read by what the file says; code
that is loaded answers as it declares itself, so that how it answers is not the file's to say.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raycert.cases.files import BadFile, read_as, read_file, read_toml
from raycert.cases.protocol import VERSION, BadLine, Hello
from raycert.oracle.client.dialogue import Dialogue, Limits, Target, Unusable
from raycert.oracle.client.inprocess import InProcess

OWN = ("answers", "precision", "numbers")
"""The fields by which answers are read, before anything is judged."""


@dataclass(frozen=True, slots=True)
class Declared:
    """A target with some fields of its hello replaced by those of a file."""

    target: Target
    fields: Mapping[str, Any]
    file: str

    def open(self, limits: Limits, ids: Iterator[str]) -> Dialogue:
        dialogue = self.target.open(limits, ids)
        try:
            dialogue.hello = self._declared(dialogue.hello)
        except BaseException:
            dialogue.kill()
            raise
        return dialogue

    def _declared(self, said: Hello) -> Hello:
        try:
            hello = said.but(dict(self.fields))
        except BadLine as error:
            raise Unusable(f"{self.file}: {error}") from None
        other = [name for name in OWN if getattr(hello, name) != getattr(said, name)]
        if other and isinstance(self.target, InProcess):
            raise Unusable(
                f"{self.file}: {other[0]} is for the code itself to declare: it says "
                f"{getattr(said, other[0])!r}. Give it a `hello` that says otherwise."
            )
        return hello


def read_declared(path: Path) -> dict[str, Any]:
    """Return the fields that a file gives; TOML by the suffix .toml. Raises `BadFile`."""
    if path.suffix != ".toml":
        return read_as(path, read_file(path), _fields)
    form = read_toml(path)
    try:
        return _fields(form)
    except BadLine as error:
        raise BadFile(f"{path}: {error}") from None


def _fields(form: object) -> dict[str, Any]:
    if not isinstance(form, dict):
        raise BadLine("is not an object of the fields of a hello")
    if form.get("hello", VERSION) != VERSION:
        raise BadLine(f"hello is not {VERSION}")
    fields = {name: value for name, value in form.items() if name != "hello"}
    Hello("x").but(fields)
    return fields
