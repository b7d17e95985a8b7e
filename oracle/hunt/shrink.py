"""From a failing probe to the simplest found that fails in the same way. Deterministic.

Every step asks for the simpler probes next to the best one, and takes the simplest that fails with
the same level and kind: first fewer parts, then small whole numbers drawn anew, then the probe as
a whole, its vectors, its numbers one by one; again, until nothing is simpler.

The cost of a probe: how many leaves and nodes its solid has; how many types of face are in it; then
its numbers, each by its significant bits, three for each, by its power of two, twice if that is
below 1, and by its sign: 0 costs nothing, 1 less than 2, 2 less than 1/2 or 3, and a number of all
bits a hundred times as much. Whole probes are compared, so axes along coordinates, for their zeros,
and points at the origin are simple by themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from math import copysign, frexp, hypot, ldexp

from raycert.cases.dice import Dice
from raycert.cases.formats import Format
from raycert.cases.model import (
    FIELDS,
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Vector,
    leaves,
    nodes,
)
from raycert.cases.numbers import Probe, numbers, with_number, with_numbers
from raycert.cases.vectors import along, dot, plus, times
from raycert.oracle.hunt.moves import (
    ZERO,
    axis_of,
    hastened,
    of_format,
    pick,
    scaled,
    shifted,
    turned,
)

Fails = Callable[[Sequence[Probe]], Sequence[bool]]
DRAWS = 320
"""Scenes of small numbers that are tried for each shape."""
MOST = 6000
"""Cases that one shrink may ask."""
AT_ONCE = 24
"""Cases that are asked together: the simplest first, and often one of the first fails."""
Cost = tuple[int, int, int, int]
FACES: dict[type[Solid], int] = {HalfSpace: 0, Sphere: 1, Slab: 1, InfiniteCylinder: 2, Cylinder: 3}
BITS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40)
GRIDS = (0, -1, -2, -4, -8, -16, -24, -32, -40)
ANCHORS = ("p", "q", "center", "point")
SMALL = (0.0, 0.0, 0.0, 1.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0)


class Shrinker:
    """A shrink under way; `best` is a failing case at any time, so it can be broken off."""

    def __init__(self, probe: Probe, fails: Fails, fmt: Format, most: int = MOST) -> None:
        """Take a failing probe. `fails` tells of each of some probes whether it fails so too."""
        self.best, self.asked = probe, 0
        self._fails, self._fmt, self._most = fails, fmt, most
        self._known: set[Probe] = {probe}
        self._drawn: set[tuple[type, ...]] = set()

    def run(self, is_known: Callable[[Probe], bool] = lambda _: False) -> Probe:
        while self.asked < self._most and self._pass(is_known):
            pass
        return self.best

    def _pass(self, is_known: Callable[[Probe], bool]) -> bool:
        before = self.best
        while self._to(fewer_parts(self.best)):
            pass
        self._draw()
        if is_known(self.best):
            return False
        while self._to(as_wholes(self.best, self._fmt)):
            pass
        while self._to(by_vectors(self.best)):
            pass
        for slot in range(len(numbers(self.best))):
            while self._to(by_number(self.best, slot)):
                pass
        return self.best != before

    def _draw(self) -> None:
        shape = tuple(map(type, nodes(self.best.solid)))
        if shape not in self._drawn:
            self._drawn.add(shape)
            dice = Dice(f"small {[kind.__name__ for kind in shape]}")
            self._to(small(self.best, dice) for _ in range(DRAWS))

    def _to(self, candidates: Iterable[Probe | None]) -> bool:
        """Go to the simplest candidate that fails, if one is simpler than the best."""
        limit = cost(self.best)
        new = {s: cost(s) for s in of_format(candidates, self._fmt) if s not in self._known}
        simpler = sorted((s for s in new if new[s] < limit), key=lambda s: new[s])
        simpler = simpler[: max(self._most - self.asked, 0)]
        if not simpler:
            return False
        self._known.update(simpler)
        for start in range(0, len(simpler), AT_ONCE):
            some = simpler[start : start + AT_ONCE]
            self.asked += len(some)
            for probe, failed in zip(some, self._fails(some), strict=True):
                if failed:
                    self.best = probe
                    return True
        return False


def cost(probe: Probe) -> Cost:
    kinds = [type(node) for node in nodes(probe.solid)]
    faces = [FACES[kind] for kind in kinds if kind in FACES]
    return len(faces), len(kinds), sum(faces), sum(map(number_cost, numbers(probe)))


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
    yield from _placed(probe)
    yield from _sized(probe)
    yield from _aligned(probe)
    values = numbers(probe)
    for grid in GRIDS:
        yield with_numbers(probe, [on_grid(x, grid) for x in values])
    for bits in BITS:
        yield with_numbers(probe, [to_bits(x, bits) for x in values])
    for i, j, k in ((1, 2, 0), (2, 0, 1), (1, 0, 2)):
        yield turned(probe, lambda v, i=i, j=j, k=k: (v[i], v[j], v[k]))  # type: ignore[misc]
    for x, y, z in ((-1, 1, 1), (1, -1, 1), (1, 1, -1)):
        yield turned(probe, lambda v, x=x, y=y, z=z: (x * v[0], y * v[1], z * v[2]))  # type: ignore[misc]


def _placed(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe with one of its points at the origin, and the ray started elsewhere."""
    ray = probe.ray
    places = [getattr(leaf, name, ZERO) for _, leaf in leaves(probe.solid) for name in ANCHORS]
    for place in dict.fromkeys((*places, ray.origin)):
        yield shifted(probe, times(-1.0, place))
        yield Probe(probe.solid, Ray(place, ray.direction))
    for t in (-1.0, 1.0, 0.5, 2.0, 4.0, -2.0, 8.0):
        yield Probe(probe.solid, Ray(along(ray.origin, t, ray.direction), ray.direction))


def _sized(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe with a length or the direction of about 1, by a power of 2 or exactly."""
    sizes = [abs(x) for x in numbers(probe)[:-3]]
    for scale, lengths in ((scaled, sizes), (hastened, map(abs, probe.ray.direction))):
        exact = [x for x in lengths if x]
        for x in dict.fromkeys((*exact, *(ldexp(0.5, frexp(x)[1]) for x in exact))):
            yield scale(probe, 1 / x) if 1e-300 < x < 1e300 else None


def _aligned(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe turned so that an axis, or the direction, lies along z."""
    axes = [axis_of(leaf) for _, leaf in leaves(probe.solid)]
    for w in (*axes, probe.ray.direction):
        length = hypot(*w)
        if w[0] or w[1]:
            yield turned(probe, _to_z(w[0] / length, w[1] / length, w[2] / length))


def _to_z(x: float, y: float, z: float) -> Callable[[Vector], Vector]:
    """Return the rotation about an axis of the xy plane that takes a unit vector to z."""
    if z < 0:  # to -z: the rotation to z loses all digits near -z
        x, y, z = -x, -y, -z
    k = 1 / (1 + z)
    rows = ((1 - k * x * x, -k * x * y, -x), (-k * x * y, 1 - k * y * y, -y), (x, y, z))
    return lambda v: (dot(rows[0], v), dot(rows[1], v), dot(rows[2], v))


def by_vectors(probe: Probe) -> Iterator[Probe | None]:
    """Yield the probe with one vector along an axis, short, or 0; or an end near the other."""
    units = ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    for start in _vectors(probe):
        values = numbers(probe)
        x, y, z = values[start : start + 3]
        others = [*units, ZERO, (x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z)]
        if start >= 3:
            a, b, c = values[start - 3 : start]
            others += [plus((a, b, c), unit) for unit in units]
        for new in others:
            yield with_numbers(probe, [*values[:start], *new, *values[start + 3 :]])


def _vectors(probe: Probe) -> Iterator[int]:
    """Yield where each vector of a probe begins among its numbers."""
    start = 0
    for _, leaf in leaves(probe.solid):
        for name in FIELDS[type(leaf)]:
            wide = isinstance(getattr(leaf, name), tuple)
            if wide:
                yield start
            start += 3 if wide else 1
    yield from (start, start + 3)


def by_number(probe: Probe, slot: int) -> Iterator[Probe | None]:
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
    coordinates = {start + i for start in _vectors(probe) for i in range(3)}
    for slot in sorted(set(range(len(values))) - coordinates):
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
