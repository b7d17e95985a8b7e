"""What simpler means, and the simpler cases next to one.

The cost of a case: how many leaves and nodes its solid has; how many types of face are in it; then
its numbers, each by its significant bits, three for each, by its power of two, twice if that is
below 1, and by its sign: 0 costs nothing, 1 less than 2, 2 less than 1/2 or 3, and a number of all
bits a hundred times as much. Whole cases are compared, so axes along coordinates, for their zeros,
and points at the origin are simple by themselves.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import copysign, frexp, hypot, ldexp
from typing import Any

from raycert.cases.dice import Dice
from raycert.cases.formats import Format
from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Ray,
    Refused,
    Slab,
    Solid,
    Sphere,
    Tree,
    Vector,
    leaves,
    nodes,
)
from raycert.cases.numbers import Probe, numbers, with_number, with_numbers
from raycert.oracle.hunt.moves import pick
from raycert.oracle.hunt.placed import axis_of, change, moved, plus, scaled

Cost = tuple[int, int, int, int]
FACES: dict[type[Solid], int] = {
    HalfSpace: 0,
    Sphere: 1,
    Slab: 1,
    InfiniteCylinder: 2,
    Cylinder: 3,
}
BITS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40)
GRIDS = (0, -1, -2, -4, -8, -16, -24, -32, -40)
SMALL = (0.0, 0.0, 0.0, 1.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0)


def cost(probe: Probe) -> Cost:
    """Return how far from simple a case is."""
    kinds = list(map(type, nodes(probe.solid)))
    faces = sum(FACES.get(kind, 0) for kind in kinds)
    count = sum(kind in FACES for kind in kinds)
    return count, len(kinds), faces, sum(map(number_cost, numbers(probe)))


def number_cost(x: float) -> int:
    """Return how far from simple a number is.

    >>> [number_cost(x) for x in (0.0, 1.0, -1.0, 2.0, 3.0, 0.5, 0.1)]
    [0, 3, 4, 4, 6, 5, 266]
    """
    if not x:
        return int(copysign(1, x) < 0)
    top, bottom = abs(x).as_integer_ratio()
    twos = (top & -top).bit_length() - 1
    digits = top.bit_length() - twos
    return 3 * digits + twos + 2 * (bottom.bit_length() - 1) + (x < 0)


def fewer_parts(probe: Probe) -> Iterator[Probe]:
    """Yield the probe with a tree replaced by a part, a part dropped, a leaf by a simpler one."""
    for solid in _fewer(probe.solid):
        yield Probe(solid, probe.ray)


def _fewer(solid: Solid) -> Iterator[Solid]:
    if isinstance(solid, Cylinder):
        yield Slab(solid.p, solid.q)
        yield InfiniteCylinder(solid.p, solid.q, solid.radius)
    if not isinstance(solid, Tree):
        return
    yield from solid.of
    for i, part in enumerate(solid.of):
        before, after = solid.of[:i], solid.of[i + 1 :]
        if before or after:
            yield type(solid)((*before, *after))
        for other in _fewer(part):
            yield type(solid)((*before, other, *after))


def as_wholes(probe: Probe, fmt: Format) -> Iterator[Probe | None]:
    """Yield the probe moved, scaled, turned and rounded as a whole."""
    yield from _placed(probe)
    yield from _sized(probe)
    yield from _aligned(probe)
    values = numbers(probe)
    for grid in GRIDS:
        yield with_numbers(probe, [on_grid(x, grid) for x in values])
    for bits in BITS:
        yield with_numbers(probe, [to_bits(x, bits) for x in values])
    for order in ((1, 2, 0), (2, 0, 1), (1, 0, 2)):
        yield _each_vector(probe, lambda v, order=order: (v[order[0]], v[order[1]], v[order[2]]))
    for flip in ((-1, 1, 1), (1, -1, 1), (1, 1, -1)):
        yield _each_vector(probe, lambda v, f=flip: (f[0] * v[0], f[1] * v[1], f[2] * v[2]))


def _placed(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe with one of its points at the origin, and the ray started elsewhere."""
    zero, ray = (0.0, 0.0, 0.0), probe.ray
    places = [getattr(leaf, name, zero) for _, leaf in leaves(probe.solid) for name in ANCHORS]
    for place in dict.fromkeys((*places, ray.origin)):
        yield moved(probe, plus(zero, place, -1.0))
        yield Probe(probe.solid, Ray(place, ray.direction))
    for t in (-1.0, 1.0, 0.5, 2.0, 4.0, -2.0, 8.0):
        yield Probe(probe.solid, Ray(plus(ray.origin, ray.direction, t), ray.direction))


ANCHORS = ("p", "q", "center", "point")


def _sized(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe with a length or the direction of about 1, by a power of 2 or exactly."""
    sizes = [abs(x) for x in numbers(Probe(probe.solid, probe.ray))[:-3] if x]
    for size in dict.fromkeys((*(s for s in sizes), *(ldexp(0.5, frexp(s)[1]) for s in sizes))):
        yield scaled(probe, 1 / size) if 1e-300 < size < 1e300 else None
    speeds = [abs(x) for x in probe.ray.direction if x]
    for speed in dict.fromkeys((*speeds, *(ldexp(0.5, frexp(s)[1]) for s in speeds))):
        yield scaled(probe, 1 / speed, of_direction=True) if 1e-300 < speed < 1e300 else None


def _aligned(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe turned so that an axis, or the direction, lies along z."""
    axes = [axis_of(leaf) for _, leaf in leaves(probe.solid)]
    for w in (*axes, probe.ray.direction):
        length = hypot(*w)
        if w[0] or w[1]:
            yield _each_vector(probe, _turn((w[0] / length, w[1] / length, w[2] / length)))


def _turn(n: Vector) -> Any:
    """Return the rotation about an axis of the xy plane that takes a unit vector to z."""
    x, y, z = n
    if z < 0:  # to -z: the rotation to z loses all digits near -z
        x, y, z = -x, -y, -z
    k = 1 / (1 + z)
    rows = ((1 - k * x * x, -k * x * y, -x), (-k * x * y, 1 - k * y * y, -y), (x, y, z))
    return lambda v: tuple(sum(a * b for a, b in zip(row, v, strict=True)) for row in rows)


def _each_vector(probe: Probe, turn: Any) -> Probe | None:
    def leaf(part: Any) -> Any:
        names = [name for name in (*ANCHORS, "normal") if hasattr(part, name)]
        return replace(part, **{name: turn(getattr(part, name)) for name in names})

    solid = change(probe.solid, leaf)
    try:
        ray = Ray(turn(probe.ray.origin), turn(probe.ray.direction))
    except Refused:
        return None
    return Probe(solid, ray) if solid else None


def by_vectors(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe with one vector along an axis, short, or 0; or an end near the other."""
    units = ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    for start in _vectors(probe):
        values = list(numbers(probe))
        old = values[start : start + 3]
        for new in (*units, (0.0, 0.0, 0.0), *(_only(old, i) for i in range(3))):
            yield with_numbers(probe, [*values[:start], *new, *values[start + 3 :]])
        if start >= 3:
            for unit in units:
                new = plus(tuple(values[start - 3 : start]), unit)  # type: ignore[arg-type]
                yield with_numbers(probe, [*values[:start], *new, *values[start + 3 :]])


def _only(v: list[float], i: int) -> tuple[float, ...]:
    return tuple(x if i == j else 0.0 for j, x in enumerate(v))


def _vectors(probe: Probe) -> Iterator[int]:
    """Yield where each vector of a probe begins among its numbers."""
    start = 0
    for _, leaf in leaves(probe.solid):
        for name in leaf.__slots__:
            wide = isinstance(getattr(leaf, name), tuple)
            if wide:
                yield start
            start += 3 if wide else 1
    yield from (start, start + 3)


def by_number(probe: Probe, slot: int) -> Iterator[Probe | None]:
    """Yield the probe with one number simpler."""
    x = numbers(probe)[slot]
    if not x:
        yield with_number(probe, slot, 0.0)
        return
    simpler = [0.0, 1.0, -1.0, 2.0, -x, float(round(x)), x / 2, *(to_bits(x, n) for n in BITS)]
    simpler += [x - 1 if x > 0 else x + 1, *(on_grid(x, grid) for grid in GRIDS)]
    half = frexp(x)[1] // 2
    simpler += [ldexp(x, -half), ldexp(x, -1 if half > 0 else 1), ldexp(x, -4 if half > 0 else 4)]
    limit = number_cost(x)
    for value in sorted({y for y in simpler if number_cost(y) < limit}, key=number_cost):
        yield with_number(probe, slot, value)


def small(probe: Probe, dice: Dice) -> Probe | None:
    """Return a probe of the same shape in small whole numbers, drawn anew.

    In some, one number is by a little beside a whole one, or much larger or smaller.
    """
    values = [pick(dice, SMALL) for _ in numbers(probe)]
    radii = set(range(len(values)))
    for start in _vectors(probe):
        radii -= {start, start + 1, start + 2}
    for slot in radii:
        values[slot] = pick(dice, (1.0, 1.0, 2.0))
    slot, n = dice.integer(0, len(values) - 1), dice.integer(4, 40)
    match dice.integer(0, 4):
        case 0 | 1:
            values[slot] += pick(dice, (1, -1)) * ldexp(1.0, -n)
        case 2:
            values[slot] = ldexp(values[slot], pick(dice, (n, -n)))
    return with_numbers(probe, values)


def to_bits(x: float, bits: int) -> float:
    """Return x to so many significant bits.

    >>> to_bits(0.7, 2), to_bits(-9.0, 3)
    (0.75, -8.0)
    """
    share, exponent = frexp(x)
    return ldexp(round(ldexp(share, bits)), exponent - bits)


def on_grid(x: float, exponent: int) -> float:
    """Return the multiple of 2^exponent next to x.

    >>> on_grid(0.7, -1), on_grid(0.7, 0)
    (0.5, 1.0)
    """
    return ldexp(float(round(ldexp(x, -exponent))), exponent) if abs(x) < 2.0**52 else x
