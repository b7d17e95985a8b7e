"""Rays and solids as JSON objects, both ways, and the line that asks about them.

Reading refuses every malformed object with `Refused`, whose path leads to the field:
`solid.of[1].radius`. Reals are spelled as `raycert.cases.formats` says.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from functools import cache
from json.encoder import encode_basestring_ascii
from types import UnionType
from typing import Any, Self, TypeVar

from raycert.cases.formats import BINARY64, Format, Spelling, parse, spell
from raycert.cases.model import (
    SOLIDS,
    TYPE_NAMES,
    VECTORS,
    Ray,
    Refused,
    Solid,
    Tree,
    Vector,
    real,
    type_of,
)

Json = dict[str, Any]
T = TypeVar("T")
DEEPEST = 200


def write_ray(ray: Ray, spelling: Spelling = "decimal", fmt: Format = BINARY64) -> Json:
    return {name: [spell(x, spelling, fmt) for x in getattr(ray, name)] for name in Ray.__slots__}


def write_solid(solid: Solid, spelling: Spelling = "decimal", fmt: Format = BINARY64) -> Json:
    """Return the solid as a JSON object, fields in the order of its declaration."""
    form: Json = {"type": type_of(solid)}
    for field in fields(solid):
        value = getattr(solid, field.name)
        if field.name == "of":
            form["of"] = [write_solid(part, spelling, fmt) for part in value]
        elif field.name in VECTORS:
            form[field.name] = [spell(x, spelling, fmt) for x in value]
        else:
            form[field.name] = spell(value, spelling, fmt)
    return form


def read_ray(
    form: object, path: str = "ray", spelling: Spelling = "decimal", fmt: Format = BINARY64
) -> Ray:
    """Return the ray that a JSON object describes, or refuse it."""
    read = _reader(spelling, fmt)
    values = fields_of(form, path, Ray.__slots__)
    try:
        return Ray(**{name: read(name, values[name]) for name in Ray.__slots__})
    except Refused as refusal:
        raise refusal.under(path) from None


def read_solid(
    form: object, path: str = "solid", spelling: Spelling = "decimal", fmt: Format = BINARY64
) -> Solid:
    """Return the solid that a JSON object describes, or refuse it."""
    if path.count(".of[") > DEEPEST:
        raise Refused(path, f"is nested more than {DEEPEST} deep")
    kind = type_in(form, path, SOLIDS)
    read, names = _reader(spelling, fmt), [field.name for field in fields(SOLIDS[kind])]
    values = fields_of(form, path, names, ("type",))
    if "of" in names:
        parts = values["of"]
        if not isinstance(parts, list) or not parts:
            raise Refused(f"{path}.of", "is not a list of one or more solids")
        children = [
            read_solid(part, f"{path}.of[{i}]", spelling, fmt) for i, part in enumerate(parts)
        ]
        return SOLIDS[kind](of=tuple(children))  # type: ignore[call-arg]
    try:
        return SOLIDS[kind](**{name: read(name, values[name]) for name in names})
    except Refused as refusal:
        raise refusal.under(path) from None


def type_in(form: object, path: str, types: Iterable[str]) -> str:
    """Return the type that an object says it is, one of `types`, or refuse it."""
    if not isinstance(form, Mapping):
        raise Refused(path, f"is not an object: {form!r:.40}")
    kind = form.get("type")
    if not isinstance(kind, str) or kind not in types:
        raise Refused(f"{path}.type", _none_of(kind, types))
    return kind


def fields_of(
    form: object, path: str, needed: Sequence[str], besides: Sequence[str] = ()
) -> Mapping[str, Any]:
    """Return an object with all of the needed fields and no unknown one, or refuse it."""
    if not isinstance(form, Mapping):
        raise Refused(path, f"is not an object: {form!r:.40}")
    known, prefix = (*needed, *besides), f"{path}." if path else ""
    for name in form:
        if name not in known:
            reason = f"is not a field here (fields: {', '.join(known)})"
            raise Refused(f"{prefix}{name}", reason)
    for name in needed:
        if name not in form:
            raise Refused(f"{prefix}{name}", "is missing")
    return form


def _none_of(value: object, words: Iterable[object]) -> str:
    known = ", ".join("null" if word is None else str(word) for word in words)
    return f"is not one of {known}: {value!r:.40}"


class Fields:
    """The fields of a JSON object, each refused if it is missing or of another type."""

    def __init__(self, form: object, path: str) -> None:
        if not isinstance(form, dict):
            raise Refused(path, "is not an object")
        self.form: Json = form
        self.path = path

    def __call__(self, name: str, kind: type | UnionType) -> Any:
        if name not in self.form:
            raise Refused(f"{self.path}.{name}", "is missing")
        value = self.form[name]
        if not isinstance(value, kind) or isinstance(value, bool):
            raise Refused(f"{self.path}.{name}", f"is not a {getattr(kind, '__name__', kind)}")
        if isinstance(value, str) and not value.isprintable():  # NUL, half a surrogate pair, ...
            raise Refused(f"{self.path}.{name}", f"has characters that do not print: {value!r:.40}")
        return value

    def one_of(self, name: str, words: tuple[T, ...]) -> T:
        """Return a field that is one of some words, or null if that is among them."""
        value: T = self(name, str | None)
        if value not in words:
            raise Refused(f"{self.path}.{name}", _none_of(value, words))
        return value

    def some_of(self, name: str, words: Iterable[str]) -> tuple[str, ...]:
        """Return a list of some of these words."""
        values = self.many(name, str)
        if wrong := [value for value in values if value not in words]:
            raise Refused(f"{self.path}.{name}", _none_of(wrong[0], words))
        return values

    def inside(self, name: str) -> Self:
        """Return the fields of a field that is an object."""
        return type(self)(self(name, dict), f"{self.path}.{name}")

    def many(self, name: str, kind: type[T]) -> tuple[T, ...]:
        """Return the items of a list, all of one type."""
        items = self(name, list)
        if not all(isinstance(x, kind) and not isinstance(x, bool) for x in items):
            raise Refused(f"{self.path}.{name}", f"is not a list of {kind.__name__}")
        if kind is str and not "".join(items).isprintable():
            raise Refused(f"{self.path}.{name}", "has characters that do not print")
        return tuple(items)

    def each(self, name: str) -> Iterator[Self]:
        """Yield the fields of each object in a list."""
        for i, item in enumerate(self(name, list)):
            yield type(self)(item, f"{self.path}.{name}[{i}]")


def _reader(spelling: Spelling, fmt: Format) -> Callable[[str, object], Any]:
    """Return the function that turns a field's spelled numbers into numbers."""

    def number(value: object, path: str) -> float:
        if spelling != "decimal":
            try:
                value = parse(value, spelling, fmt)
            except (ValueError, OverflowError) as error:
                raise Refused(path, str(error)) from None
        read = real(value, path)
        if fmt is not BINARY64 and not fmt.holds(read):
            raise Refused(path, f"is not a {fmt.name} number: {read!r}")
        return read

    def read(name: str, value: object) -> object:
        if name not in VECTORS or not isinstance(value, list):
            return number(value, name) if name == "radius" else value
        return tuple(number(item, f"{name}[{i}]") for i, item in enumerate(value))

    return read


WriteNumber = Callable[[float], str]
WriteVector = Callable[[Vector], str]
_OBJECTS = {
    kind: (f'{{"type":"{name}"', tuple((field.name, f',"{field.name}":') for field in fields(kind)))
    for kind, name in TYPE_NAMES.items()
}
"""How the object of each type begins; its fields, each with what stands before its value."""


def question(id: str, solid: Solid, ray: Ray, spelling: Spelling, fmt: Format = BINARY64) -> bytes:
    """Return the line that asks one case, newline included.

    To the byte what `json` would write of the forms, several times as fast: a run asks thousands.
    """
    number, vector = _writers(spelling, fmt)
    text = (
        f'{{"id":{encode_basestring_ascii(id)},"solid":{_solid_text(solid, number, vector)},'
        f'"ray":{{"origin":{vector(ray.origin)},"direction":{vector(ray.direction)}}}}}\n'
    )
    return text.encode("ascii")


@cache
def _writers(spelling: Spelling, fmt: Format) -> tuple[WriteNumber, WriteVector]:
    """Return what spells a number, and three in a list."""
    if spelling == "decimal":
        return float.__repr__, "[%r,%r,%r]".__mod__
    if spelling == "hex":
        return lambda x: f'"{x.hex()}"', _hex_vector
    three, n = struct.Struct(f">3{fmt.pack[1:]}").pack, fmt.digits

    def bits(vector: Vector) -> str:
        digits = three(*vector).hex()
        return f'["{digits[:n]}","{digits[n : 2 * n]}","{digits[2 * n :]}"]'

    return lambda x: f'"{fmt.bits(x)}"', bits


def _hex_vector(vector: Vector) -> str:
    x, y, z = vector
    return f'["{x.hex()}","{y.hex()}","{z.hex()}"]'


def _solid_text(solid: Solid, number: WriteNumber, vector: WriteVector) -> str:
    text, names = _OBJECTS[type(solid)]
    if isinstance(solid, Tree):
        parts = ",".join([_solid_text(part, number, vector) for part in solid.of])
        return f'{text},"of":[{parts}]}}'
    for name, before in names:
        value = getattr(solid, name)
        text += before + (number(value) if name == "radius" else vector(value))
    return text + "}"
