"""A case as numbers: the same shape with other numbers, neighbours on the grid of the format.

Numbers stand in a fixed order: the fields of the leaves from left to right, then the origin, then
the direction. On the line of ordinals neighbours of the format are neighbours, and everything
nearer to 0 than the usual is 0.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from itertools import islice
from math import frexp, ldexp
from typing import Any, NamedTuple

from raycert.cases.formats import Format
from raycert.cases.model import FIELDS, Leaf, Ray, Refused, Solid, Tree, leaves


class Probe(NamedTuple):
    """A solid and the ray that asks about it."""

    solid: Solid
    ray: Ray


def numbers(probe: Probe) -> tuple[float, ...]:
    """Return all numbers of a probe, in their order."""
    found: list[float] = []
    for _, leaf in leaves(probe.solid):
        found += leaf_numbers(leaf)
    return (*found, *probe.ray.origin, *probe.ray.direction)


def leaf_numbers(leaf: Leaf) -> list[float]:
    """Return the numbers of a leaf, in the order of its fields."""
    found: list[float] = []
    for name in FIELDS[type(leaf)]:
        value = getattr(leaf, name)
        found += value if isinstance(value, tuple) else (value,)
    return found


def with_numbers(probe: Probe, values: Sequence[float]) -> Probe | None:
    """Return the probe of the same shape with these numbers; None where they make no solid."""
    rest = iter(values)
    try:
        solid = _solid(probe.solid, rest)
        return Probe(solid, Ray(_three(rest), _three(rest)))
    except Refused:
        return None


def _solid(solid: Solid, rest: Iterator[float]) -> Solid:
    if isinstance(solid, Tree):
        return type(solid)(tuple(_solid(part, rest) for part in solid.of))
    values: dict[str, Any] = {
        name: _three(rest) if isinstance(getattr(solid, name), tuple) else next(rest)
        for name in FIELDS[type(solid)]
    }
    return type(solid)(**values)


def _three(rest: Iterator[float]) -> tuple[float, float, float]:
    x, y, z = islice(rest, 3)
    return (x, y, z)


def with_number(probe: Probe, slot: int, value: float) -> Probe | None:
    """Return the probe with one number replaced; None where that makes no solid."""
    values = list(numbers(probe))
    values[slot] = value
    return with_numbers(probe, values)


def usual(fmt: Format) -> int:
    """Return the n for which numbers of a usual size lie between 2^-n and 2^n."""
    return 150 if fmt.precision == 53 else 30


def is_usual(probe: Probe, fmt: Format) -> bool:
    """Whether no number is so large or small that a sound formula over- or underflows."""
    most = usual(fmt)
    return all(not x or abs(frexp(x)[1]) <= most for x in numbers(probe))


def ordinal(x: float, fmt: Format) -> int:
    """Return the place of a number on the line of ordinals."""
    place = max(_bits(abs(x), fmt) - _bits(ldexp(1.0, -usual(fmt)), fmt) + 1, 0)
    return -place if x < 0 else place


def at(place: int, fmt: Format) -> float:
    """Return the number at a place of the line of ordinals."""
    if not place:
        return 0.0
    bits = abs(place) - 1 + _bits(ldexp(1.0, -usual(fmt)), fmt)
    x: float = struct.unpack(fmt.pack, bits.to_bytes(fmt.digits // 2, "big"))[0]
    return -x if place < 0 else x


def _bits(x: float, fmt: Format) -> int:
    return int.from_bytes(struct.pack(fmt.pack, x), "big")


def near(x: float, steps: int, fmt: Format) -> float:
    """Return the number so many steps above; the first of 0 is of the precision, not the least."""
    if not x:
        return ldexp(float(steps), -fmt.precision)
    return at(ordinal(x, fmt) + steps, fmt)


def between(one: Probe, other: Probe, part: int, of: int, fmt: Format) -> Probe | None:
    """Return the probe part / of of the way between two of the same shape, by ordinals."""
    mixed = []
    for a, b in zip(numbers(one), numbers(other), strict=True):
        low, high = ordinal(a, fmt), ordinal(b, fmt)
        mixed.append(at(low + (high - low) * part // of, fmt) if a != b else a)
    return with_numbers(one, mixed)


def rounded(probe: Probe, fmt: Format) -> Probe | None:
    """Return the probe in numbers of the format, -0 as 0; None where that makes no solid."""
    return with_numbers(probe, [fmt.nearest(x) + 0.0 for x in numbers(probe)])
