"""The line of a question, spelled straight into text: a corpus is some thousands of them.

To the byte what `json` would write of the forms of `raycert.cases.forms`, several times as fast.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import fields
from functools import cache
from json.encoder import encode_basestring_ascii

from raycert.cases.formats import BINARY64, Format, Spelling
from raycert.cases.model import TYPE_NAMES, Difference, Intersection, Ray, Solid, Union, Vector

WriteNumber = Callable[[float], str]
WriteVector = Callable[[Vector], str]
TREES = (Union, Intersection, Difference)
FIELDS = {
    kind: (
        f'{{"type":"{name}"',
        tuple((field.name, f',"{field.name}":') for field in fields(kind)),
    )
    for kind, name in TYPE_NAMES.items()
}
"""How the object of each type begins; its fields, each with what stands before its value."""


def question(id: str, solid: Solid, ray: Ray, spelling: Spelling, fmt: Format = BINARY64) -> bytes:
    """Return the line that asks one case, newline included."""
    number, vector = _writers(spelling, fmt)
    text = (
        f'{{"id":{encode_basestring_ascii(id)},"solid":{_solid(solid, number, vector)},'
        f'"ray":{{"origin":{vector(ray.origin)},"direction":{vector(ray.direction)}}}}}\n'
    )
    return text.encode("ascii")


@cache
def _writers(spelling: Spelling, fmt: Format) -> tuple[WriteNumber, WriteVector]:
    """Return what spells a number, and three in a list."""
    if spelling == "decimal":
        return float.__repr__, "[%r,%r,%r]".__mod__
    if spelling == "hex":
        return lambda x: f'"{x.hex()}"', _hex
    three, n = struct.Struct(f">3{fmt.pack[1:]}").pack, fmt.digits

    def bits(vector: Vector) -> str:
        digits = three(*vector).hex()
        return f'["{digits[:n]}","{digits[n : 2 * n]}","{digits[2 * n :]}"]'

    return lambda x: f'"{fmt.bits(x)}"', bits


def _hex(vector: Vector) -> str:
    x, y, z = vector
    return f'["{x.hex()}","{y.hex()}","{z.hex()}"]'


def _solid(solid: Solid, number: WriteNumber, vector: WriteVector) -> str:
    text, names = FIELDS[type(solid)]
    if isinstance(solid, TREES):
        parts = ",".join([_solid(part, number, vector) for part in solid.of])
        return f'{text},"of":[{parts}]}}'
    for name, before in names:
        value = getattr(solid, name)
        text += before + (number(value) if name == "radius" else vector(value))
    return text + "}"
