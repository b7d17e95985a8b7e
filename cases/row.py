"""A golden row: a case with its exact answer, and its one JSON form.

Every real is a hex-float string, infinity is "inf", keys stand in a fixed order. Reading refuses
what is not such a row with `Refused`, naming the field.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from cases.accept import Accept, Numbers
from cases.case import TIERS, Tier
from cases.formats import Format, parse, spell
from cases.forms import Json, read_ray, read_solid, write_ray, write_solid
from cases.model import Ray, Refused, Solid

T = TypeVar("T")


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
        """Return the family's name."""
        return self.id.partition("/")[0]


def write_row(row: GoldenRow, fmt: Format) -> Json:
    """Return the row as a JSON object."""
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
    """Return the string that spells a real of a golden row."""
    return str(spell(number, "hex") or "inf")


def _write_numbers(pairs: Numbers) -> list[list[str]]:
    return [[real(a), real(b)] for a, b in pairs]


def read_row(form: object, fmt: Format) -> GoldenRow:
    """Return the row that a JSON object describes, or refuse it."""
    get = _Fields(form, "row")
    solid = read_solid(get("solid", dict), "solid", "hex", fmt)
    ray = read_ray(get("ray", dict), "ray", "hex", fmt)
    tier = get("tier", str)
    if tier not in TIERS:
        raise Refused("row.tier", f"is not one of {', '.join(TIERS)}: {tier!r:.40}")
    condition = get.form.get("condition")
    return GoldenRow(
        id=get("id", str),
        why=get("why", str),
        flags=tuple(get("flags", list)),
        tier=tier,
        source=get("source", str),
        solid=solid,
        ray=ray,
        rows=tuple(get("rows", list)),
        condition=condition,
        decisive=tuple(get("decisive", list)),
        intervals=get.each("intervals", _read_span),
        expected=_read_numbers(get("expected", list), "row.expected"),
        accept={
            level: _read_accept(accept, f"row.accept.{level}")
            for level, accept in get("accept", dict).items()
        },
    )


class _Fields:
    """The fields of a JSON object, each refused if it is missing or of another type."""

    def __init__(self, form: object, path: str) -> None:
        if not isinstance(form, dict):
            raise Refused(path, "is not an object")
        self.form = form
        self.path = path

    def __call__(self, name: str, kind: type) -> Any:
        """Return one field."""
        value = self.form.get(name)
        if not isinstance(value, kind):
            problem = "is missing" if name not in self.form else f"is not a {kind.__name__}"
            raise Refused(f"{self.path}.{name}", problem)
        return value

    def each(self, name: str, read: Callable[[_Fields], T]) -> tuple[T, ...]:
        """Return the items of a list of objects."""
        items = self(name, list)
        return tuple(read(_Fields(x, f"{self.path}.{name}[{i}]")) for i, x in enumerate(items))


def _read_span(get: _Fields) -> Span:
    enter, leave = (
        _read_end(_Fields(get(name, dict), f"{get.path}.{name}")) for name in ("enter", "leave")
    )
    return Span(enter, leave, get.form.get("touch"))


def _read_end(get: _Fields) -> End:
    try:
        polynomial = tuple(int(c) for c in get.form.get("polynomial", ())) or None
        fraction = get.form.get("fraction")
        top, bottom = fraction.split("/") if fraction else ("0", "0")
        return End(
            polynomial=polynomial,
            root=get.form.get("root"),
            fraction=(int(top), int(bottom)) if fraction else None,
            nearest=parse(get("nearest", str), "hex"),
            down=parse(get("down", str), "hex"),
            up=parse(get("up", str), "hex"),
            digits=get("digits", str),
            faces=tuple(get("faces", list)),
            kind=get("kind", str),
        )
    except (ValueError, AttributeError, TypeError) as error:
        raise error if isinstance(error, Refused) else Refused(get.path, str(error)) from None


def _read_accept(form: object, path: str) -> Accept:
    get = _Fields(form, path)
    return Accept(
        _read_numbers(get("inner", list), f"{path}.inner"),
        _read_numbers(get("outer", list), f"{path}.outer"),
        tuple(get("most", list)),
    )


def _read_numbers(pairs: list[Any], path: str) -> Numbers:
    try:
        return tuple((parse(a, "hex"), parse(b, "hex")) for a, b in pairs)
    except (ValueError, TypeError) as error:
        raise Refused(path, f"is not a list of pairs of hex floats ({error})") from None
