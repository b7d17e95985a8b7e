"""A golden row: a case with its exact answer, and its one JSON form.

Every real is a hex-float string, infinity is "inf", keys stand in a fixed order. Reading refuses
with `Refused`, naming the field, whatever writing would not give back.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isnan
from typing import Any

from raycert.cases.accept import Accept, Numbers
from raycert.cases.case import TIERS, Tier
from raycert.cases.formats import Format, parse, spell
from raycert.cases.forms import Fields, Json, read_ray, read_solid, write_ray, write_solid
from raycert.cases.levels import LEVELS
from raycert.cases.model import Ray, Refused, Solid
from raycert.cases.protocol import TOUCHES

ROUNDED = ("nearest", "down", "up")
ID = re.compile("[a-z0-9]+(-[a-z0-9]+)*/[a-z0-9]+(-[a-z0-9]+)*")
ENDS = ("crossing", "tangent", "rim", "start", "end")
"""What an endpoint may be."""
ACCEPTED = ("sound", "stable")
"""The levels that a row holds lists of numbers for."""


@dataclass(frozen=True, slots=True)
class End:
    """An exact endpoint: the `root`-th root of `polynomial`, or a fraction, or infinity.

    `polynomial` is primitive, coefficients from the highest power down, the leading one positive.
    All of `polynomial`, `root`, `fraction` are None for infinity.
    """

    polynomial: tuple[int, ...] | None
    root: int | None
    fraction: tuple[int, int] | None
    nearest: float
    down: float
    up: float
    digits: str
    faces: tuple[str, ...]
    kind: str


@dataclass(frozen=True, slots=True)
class Span:
    """An exact interval; `touch` is None or the kind of touch."""

    enter: End
    leave: End
    touch: str | None


@dataclass(frozen=True, slots=True)
class GoldenRow:
    """One line of a golden file. `accept` maps `sound` and `stable` to their lists."""

    id: str
    why: str
    flags: tuple[str, ...]
    tier: Tier
    source: str
    solid: Solid
    ray: Ray
    rows: tuple[str, ...]
    condition: int | None
    decisive: tuple[str, ...]
    intervals: tuple[Span, ...]
    expected: Numbers
    accept: dict[str, Accept]

    @property
    def family(self) -> str:
        return self.id.partition("/")[0]


def write_row(row: GoldenRow, fmt: Format) -> Json:
    form: Json = _written(row, fmt)
    return form


def _written(value: object, fmt: Format) -> Any:
    """Return a value of a row as JSON: a record is an object of its fields, in their order."""
    match value:
        case float():
            return real(value)
        case tuple():
            return [_written(item, fmt) for item in value]
        case dict():
            return {name: _written(item, fmt) for name, item in value.items()}
        case Ray():
            return write_ray(value, "hex", fmt)
        case End():
            return _write_end(value)
        case GoldenRow() | Span() | Accept():
            return {name: _written(getattr(value, name), fmt) for name in value.__slots__}
    return write_solid(value, "hex", fmt) if isinstance(value, Solid) else value


def _write_end(end: End) -> Json:
    form: Json
    if end.polynomial:
        form = {"polynomial": [str(c) for c in end.polynomial], "root": end.root}
    elif end.fraction:
        form = {"fraction": "{}/{}".format(*end.fraction)}
    else:
        form = {"inf": True}
    rounded = {name: real(getattr(end, name)) for name in ROUNDED}
    return form | rounded | {"digits": end.digits, "faces": list(end.faces), "kind": end.kind}


def real(number: float) -> str:
    return str(spell(number, "hex") or "inf")


def read_row(form: object, fmt: Format) -> GoldenRow:
    """Return the row that a JSON object describes, or refuse it."""
    row = row_of(form, fmt)
    assert isinstance(form, dict)
    for name, value in (form | write_row(row, fmt)).items():
        if form[name] != value or name not in GoldenRow.__slots__:
            raise Refused(f"row.{name}", "is not as a row is written")
    return row


def row_of(form: object, fmt: Format) -> GoldenRow:
    """Return what is read of a row, or refuse it; nobody has looked at what is not read."""
    get = _Record(form, "row")
    id, accept = get("id", str), get.inside("accept")
    if not ID.fullmatch(id):
        raise Refused("row.id", f"is not FAMILY/SLUG in lower case: {id!r:.40}")
    return GoldenRow(
        id=id, why=get("why", str), flags=get.many("flags", str), tier=get.one_of("tier", TIERS),
        source=get("source", str), solid=read_solid(get("solid", dict), "solid", "hex", fmt),
        ray=read_ray(get("ray", dict), "ray", "hex", fmt), rows=get.many("rows", str),
        condition=get("condition", int | None), decisive=get.some_of("decisive", LEVELS),
        intervals=tuple(map(_read_span, get.each("intervals"))), expected=get.numbers("expected"),
        accept={level: _read_accept(accept.inside(level)) for level in ACCEPTED},
    )  # fmt: skip


class _Record(Fields):
    """The fields of a row, or of an object in it."""

    def numbers(self, name: str) -> Numbers:
        """Return a list of pairs of numbers."""
        pairs = self(name, list)
        if not all(isinstance(pair, list) and len(pair) == 2 for pair in pairs):
            raise Refused(f"{self.path}.{name}", "is not a list of pairs")
        return tuple((self.number(name, a), self.number(name, b)) for a, b in pairs)

    def number(self, name: str, text: object) -> float:
        """Return the number that a text in a field spells."""
        try:
            number = parse(text, "hex")
        except (ValueError, OverflowError) as error:
            raise Refused(f"{self.path}.{name}", str(error)) from None
        if isnan(number):
            raise Refused(f"{self.path}.{name}", "is NaN")
        return number


def _read_span(get: _Record) -> Span:
    enter, leave = (_read_end(get.inside(name)) for name in ("enter", "leave"))
    return Span(enter, leave, get.one_of("touch", (None, *TOUCHES)))


def _read_end(get: _Record) -> End:
    polynomial = fraction = root = None
    try:
        if "polynomial" in get.form:
            polynomial = tuple(map(int, get.many("polynomial", str)))
            root = get("root", int)
            if root not in (0, 1) or len(polynomial) != 3 or polynomial[0] < 1:
                raise Refused(get.path, "is not root 0 or 1 of a polynomial of degree 2")
        elif "fraction" in get.form:
            top, bottom = get("fraction", str).split("/")
            fraction = (int(top), int(bottom))
            if fraction[1] < 1:
                raise Refused(f"{get.path}.fraction", f"has no positive denominator: {bottom:.40}")
    except ValueError as error:
        raise error if isinstance(error, Refused) else Refused(get.path, str(error)) from None
    nearest, down, up = (get.number(name, get(name, str)) for name in ROUNDED)
    written = get("digits", str), get.many("faces", str), get.one_of("kind", ENDS)
    return End(polynomial, root, fraction, nearest, down, up, *written)


def _read_accept(get: _Record) -> Accept:
    accept = Accept(get.numbers("inner"), get.numbers("outer"), get.many("most", int))
    if len(accept.most) != len(accept.outer):
        raise Refused(f"{get.path}.most", "has not one number for each pair of outer")
    return accept
