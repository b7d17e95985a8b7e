"""A golden row: a case with its exact answer, and its one JSON form.

Every real is a hex-float string, infinity is "inf", keys stand in a fixed order. Reading refuses
with `Refused`, naming the field, whatever writing would not give back.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isnan
from types import UnionType
from typing import Any, TypeVar

from raycert.cases.accept import Accept, Numbers
from raycert.cases.case import TIERS, Tier
from raycert.cases.formats import Format, parse, spell
from raycert.cases.forms import Json, read_ray, read_solid, write_ray, write_solid
from raycert.cases.model import Ray, Refused, Solid

T = TypeVar("T")
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
    return {
        "id": row.id,
        "why": row.why,
        "flags": list(row.flags),
        "tier": row.tier,
        "source": row.source,
        "solid": write_solid(row.solid, "hex", fmt),
        "ray": write_ray(row.ray, "hex", fmt),
        "rows": list(row.rows),
        "condition": row.condition,
        "decisive": list(row.decisive),
        "intervals": [
            {"enter": _write_end(s.enter), "leave": _write_end(s.leave), "touch": s.touch}
            for s in row.intervals
        ],
        "expected": _write_numbers(row.expected),
        "accept": {
            level: {
                "inner": _write_numbers(accept.inner),
                "outer": _write_numbers(accept.outer),
                "most": list(accept.most),
            }
            for level, accept in row.accept.items()
        },
    }


def _write_end(end: End) -> Json:
    form: Json
    if end.polynomial:
        form = {"polynomial": [str(c) for c in end.polynomial], "root": end.root}
    elif end.fraction:
        form = {"fraction": "{}/{}".format(*end.fraction)}
    else:
        form = {"inf": True}
    return form | {
        "nearest": real(end.nearest),
        "down": real(end.down),
        "up": real(end.up),
        "digits": end.digits,
        "faces": list(end.faces),
        "kind": end.kind,
    }


def real(number: float) -> str:
    return str(spell(number, "hex") or "inf")


def _write_numbers(pairs: Numbers) -> list[list[str]]:
    return [[real(a), real(b)] for a, b in pairs]


def read_row(form: object, fmt: Format) -> GoldenRow:
    """Return the row that a JSON object describes, or refuse it."""
    get = _Fields(form, "row")
    tier = get("tier", str)
    if tier not in TIERS:
        raise Refused("row.tier", f"is not one of {', '.join(TIERS)}: {tier!r:.40}")
    accept = _Fields(get("accept", dict), "row.accept")
    row = GoldenRow(
        id=get("id", str),
        why=get("why", str),
        flags=get.many("flags", str),
        tier=tier,
        source=get("source", str),
        solid=read_solid(get("solid", dict), "solid", "hex", fmt),
        ray=read_ray(get("ray", dict), "ray", "hex", fmt),
        rows=get.many("rows", str),
        condition=get("condition", int | None),
        decisive=get.many("decisive", str),
        intervals=get.each("intervals", _read_span),
        expected=get.numbers("expected"),
        accept={level: _read_accept(accept.inside(level)) for level in ACCEPTED},
    )
    for name, value in (get.form | write_row(row, fmt)).items():
        if get.form[name] != value or name not in GoldenRow.__slots__:
            raise Refused(f"row.{name}", "is not as a row is written")
    return row


class _Fields:
    """The fields of a JSON object, each refused if it is missing or of another type."""

    def __init__(self, form: object, path: str) -> None:
        if not isinstance(form, dict):
            raise Refused(path, "is not an object")
        self.form = form
        self.path = path

    def __call__(self, name: str, kind: type | UnionType) -> Any:
        if name not in self.form:
            raise Refused(f"{self.path}.{name}", "is missing")
        value = self.form[name]
        if not isinstance(value, kind) or isinstance(value, bool):
            raise Refused(f"{self.path}.{name}", f"is not a {getattr(kind, '__name__', kind)}")
        return value

    def inside(self, name: str) -> _Fields:
        return _Fields(self(name, dict), f"{self.path}.{name}")

    def many(self, name: str, kind: type[T]) -> tuple[T, ...]:
        items = self(name, list)
        if not all(isinstance(x, kind) and not isinstance(x, bool) for x in items):
            raise Refused(f"{self.path}.{name}", f"is not a list of {kind.__name__}")
        return tuple(items)

    def each(self, name: str, read: Callable[[_Fields], T]) -> tuple[T, ...]:
        items = self(name, list)
        return tuple(read(_Fields(x, f"{self.path}.{name}[{i}]")) for i, x in enumerate(items))

    def real(self, name: str) -> float:
        return _number(self(name, str), f"{self.path}.{name}")

    def numbers(self, name: str) -> Numbers:
        path = f"{self.path}.{name}"
        pairs = self(name, list)
        if not all(isinstance(pair, list) and len(pair) == 2 for pair in pairs):
            raise Refused(path, "is not a list of pairs")
        return tuple((_number(a, path), _number(b, path)) for a, b in pairs)


def _number(text: object, path: str) -> float:
    try:
        number = parse(text, "hex")
    except (ValueError, OverflowError) as error:
        raise Refused(path, str(error)) from None
    if isnan(number):
        raise Refused(path, "is NaN")
    return number


def _read_span(get: _Fields) -> Span:
    enter, leave = (_read_end(get.inside(name)) for name in ("enter", "leave"))
    return Span(enter, leave, get("touch", str | None))


def _read_end(get: _Fields) -> End:
    polynomial = fraction = root = None
    try:
        if "polynomial" in get.form:
            polynomial = tuple(int(c) for c in get.many("polynomial", str))
            root = get("root", int)
            if root not in (0, 1):
                raise Refused(f"{get.path}.root", f"is not 0 or 1: {root}")
        elif "fraction" in get.form:
            top, bottom = get("fraction", str).split("/")
            fraction = (int(top), int(bottom))
    except ValueError as error:
        raise error if isinstance(error, Refused) else Refused(get.path, str(error)) from None
    return End(
        polynomial=polynomial,
        root=root,
        fraction=fraction,
        nearest=get.real("nearest"),
        down=get.real("down"),
        up=get.real("up"),
        digits=get("digits", str),
        faces=get.many("faces", str),
        kind=get("kind", str),
    )


def _read_accept(get: _Fields) -> Accept:
    accept = Accept(get.numbers("inner"), get.numbers("outer"), get.many("most", int))
    if len(accept.most) != len(accept.outer):
        raise Refused(f"{get.path}.most", "has not one number for each pair of outer")
    return accept
