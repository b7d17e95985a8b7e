"""From one case to others: to harder ones, the moves of the directed search; and to simpler ones.

A move takes a probe and dice, and returns probes of numbers of the format, in any number. Most are
ladders: steps that grow by powers of two, since nobody knows at which size a formula gives way.
`walk` looks for a place where the exact answer changes its form, a double root, a rim, faces
that coincide, and returns what lies on both sides of it, ever nearer. First come the changes that
moves and the shrinker are made of: the same probe elsewhere, in another size, turned.

The shrinker goes from a failing probe to the simplest found that fails in the same way. Every step
asks for the simpler probes next to the best one, and takes the simplest that fails: first fewer
parts, then small whole numbers drawn anew, then the probe as a whole, its vectors, its numbers one
by one; again, until nothing is simpler. It is deterministic.

The cost of a probe: how many leaves and nodes its solid has; how many types of face are in it; then
its numbers, each by its significant bits, three for each, by its power of two, twice if that is
below 1, and by its sign: 0 costs nothing, 1 less than 2, 2 less than 1/2 or 3, and a number of all
bits a hundred times as much. Whole probes are compared, so axes along coordinates, for their zeros,
and points at the origin are simple by themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from math import copysign, frexp, hypot, isinf, ldexp
from typing import Any, TypeVar

from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64, Format
from raycert.cases.model import (
    FIELDS,
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Leaf,
    Ray,
    Refused,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
    Vector,
    axis,
    leaves,
    map_leaves,
    nodes,
)
from raycert.cases.numbers import (
    Probe,
    at,
    is_usual,
    near,
    numbers,
    ordinal,
    rounded,
    with_number,
    with_numbers,
)
from raycert.cases.vectors import along, dot, minus, plus, times
from raycert.oracle.exact.surd import nearest
from raycert.oracle.exact.trace import trace

T = TypeVar("T")
Move = Callable[[Probe, Dice, Format], list[Probe]]
Form = tuple[tuple[str, ...], int]
ZERO: Vector = (0.0, 0.0, 0.0)


def of_format(probes: Iterable[Probe | None], fmt: Format) -> list[Probe]:
    """Return the probes there are, in numbers of the format."""
    exact = [rounded(probe, fmt) for probe in probes if probe is not None]
    return [probe for probe in exact if probe is not None]


def axis_of(leaf: Leaf) -> Vector:
    w = axis(leaf)
    return w if w and any(w) else (0.0, 0.0, 1.0)


def changed(
    probe: Probe,
    point: Callable[[Vector], Vector] = lambda x: x,
    radius: Callable[[float], float] = lambda x: x,
    normal: Callable[[Vector], Vector] = lambda x: x,
    direction: Callable[[Vector], Vector] = lambda x: x,
) -> Probe | None:
    """Return the probe with every point, radius, ... changed; None where that makes no solid."""

    def leaf(old: Leaf) -> Leaf:
        values = {name: changes.get(name, point)(getattr(old, name)) for name in FIELDS[type(old)]}
        return type(old)(**values)

    changes: dict[str, Callable[[Any], Any]] = {"radius": radius, "normal": normal}
    try:
        ray = Ray(point(probe.ray.origin), direction(probe.ray.direction))
        return Probe(map_leaves(leaf, probe.solid), ray)
    except Refused:
        return None


def shifted(probe: Probe, step: Vector) -> Probe | None:
    return changed(probe, lambda x: plus(x, step))


def scaled(probe: Probe, factor: float) -> Probe | None:
    """Return the probe with all lengths times a factor; the direction keeps its own."""
    return changed(probe, lambda x: times(factor, x), lambda r: r * factor)


def hastened(probe: Probe, factor: float) -> Probe | None:
    return changed(probe, direction=lambda v: times(factor, v))


def turned(probe: Probe, turn: Callable[[Vector], Vector]) -> Probe | None:
    return changed(probe, turn, normal=turn, direction=turn)


def pick(dice: Dice, items: Sequence[T]) -> T:
    return items[dice.integer(0, len(items) - 1)]


def form(probe: Probe) -> Form:
    """Return the form of the exact answer: the rows taken, with comparisons, and how many pairs."""
    answer = trace(probe.solid, probe.ray)
    return answer.rows, len(answer.intervals)


def walk(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Move one number until the answer changes its form; return both sides, ever nearer."""
    values = numbers(probe)
    slot = dice.integer(0, len(values) - 1)
    x = values[slot]
    far = pick(dice, (0.0, -x, 2 * x, x + 1, x - 1, x / 2, pick(dice, values)))
    goal = with_number(probe, slot, fmt.nearest(far))
    if goal is None or form(goal) == form(probe):
        return of_format([goal], fmt)
    low, high, path = ordinal(x, fmt), ordinal(fmt.nearest(far), fmt), [goal]
    first = form(probe)
    while abs(high - low) > 1:
        middle = (low + high) // 2
        step = with_number(probe, slot, at(middle, fmt))
        if step is None or not is_usual(step, fmt):
            break
        path.append(step)
        if form(step) == first:
            low = middle
        else:
            high = middle
    return path[:2] + path[2:-4:5] + path[-4:]


def nudge(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Move single numbers by a few steps of the format."""
    values, others = numbers(probe), list[Probe | None]()
    for _ in range(6):
        slot = dice.integer(0, len(values) - 1)
        steps = pick(dice, (1, -1, 1, -1, 2, -2, 3, -5, 16, -1024))
        others.append(with_number(probe, slot, near(values[slot], steps, fmt)))
    return of_format(others, fmt)


def simplify(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make numbers 0, whole, or equal: what random numbers never are."""
    values = numbers(probe)
    others = [with_numbers(probe, [float(round(x)) for x in values])]
    for _ in range(6):
        slot = dice.integer(0, len(values) - 1)
        x = pick(dice, (0.0, 1.0, -1.0, float(round(values[slot])), pick(dice, values)))
        others.append(with_number(probe, slot, x))
    return of_format(others, fmt)


def retreat(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Start farther back, farther on, inside, behind."""
    ray = probe.ray
    backs = (0.5, 1.0, -1.0, 3.0, ldexp(1.0, dice.integer(4, 45)), -ldexp(1.0, dice.integer(2, 30)))
    rays = [Ray(along(ray.origin, -back, ray.direction), ray.direction) for back in backs]
    return of_format([Probe(probe.solid, other) for other in rays], fmt)


def settle(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Start on a face, and a little beside it."""
    ends = [end for pair in trace(probe.solid, probe.ray).intervals for end in pair if end.finite]
    others = []
    for end in ends[:3]:
        t = nearest(end, BINARY64)
        t = 0.0 if isinf(t) else t
        for beside in (0.0, ldexp(1.0, -dice.integer(4, 50)), -ldexp(1.0, -dice.integer(4, 50))):
            origin = along(probe.ray.origin, t + beside, probe.ray.direction)
            others.append(Probe(probe.solid, Ray(origin, probe.ray.direction)))
    return of_format(others, fmt)


def turn(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Run along an axis, almost so, across it, the other way, or not at all."""
    solid, ray = probe
    w = axis_of(pick(dice, [leaf for _, leaf in leaves(solid)]))
    lean = ldexp(1.0, -dice.integer(2, 50))
    across = pick(dice, ((-w[1], w[0], 0.0), (0.0, -w[2], w[1]), (w[2], 0.0, -w[0])))
    others = [w, along(w, lean, across), across, along(across, lean, w), times(-1.0, ray.direction)]
    others.append(pick(dice, (ZERO, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0))))
    return of_format([Probe(solid, Ray(ray.origin, direction)) for direction in others], fmt)


def rescale(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make the probe, the direction, or one radius much larger or smaller; move it far away."""
    most = 40 if fmt.precision == 53 else 12
    n, size = dice.integer(3, most), pick(dice, (1, -1))
    factor, away = ldexp(1.0, size * n), ldexp(1.0, dice.integer(2, most))
    step = (away, -away, away / 2)
    others = [scaled(probe, factor), hastened(probe, factor), shifted(probe, step)]
    return of_format([*others, _thinner(probe, dice, factor)], fmt)


def overflow(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make all so large or small that a formula over- or underflows: cases of the range tier."""
    most = fmt.overflow - 30
    n = pick(dice, (dice.integer(most // 4, most), -dice.integer(most // 4, -fmt.least - 8)))
    factor = ldexp(1.0, n)
    return of_format([scaled(probe, factor), hastened(probe, factor)], fmt)


def build(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make Booleans of a solid with itself, beside itself, and with what shares a face with it."""
    solid, ray = probe
    every = [leaf for _, leaf in leaves(solid)]
    leaf = pick(dice, every)
    w = axis_of(leaf)
    beside = shifted(probe, w)
    base: Vector | None = getattr(leaf, "point", getattr(leaf, "q", None))
    other: Solid = HalfSpace(base, w) if base else Sphere(ray.origin, 1.0)
    parts = [solid, beside.solid if beside else solid, other]
    one, two = pick(dice, parts), pick(dice, parts)
    any_tree = pick(dice, TREES)((one, two))
    trees: list[Solid] = [any_tree, Difference((solid, other)), Union((solid, parts[1], other))]
    return of_format([Probe(tree, ray) for tree in trees], fmt) if len(every) <= 4 else []


def on_lattice(dice: Dice) -> Probe:
    """Return a leaf and a ray of the lattice, drawn anew: touches of every kind are common."""
    p, origin = _whole(dice), _whole(dice)
    w, radius = _along(dice), float(dice.integer(1, 2))
    q = plus(p, w)
    flat: list[Leaf] = [HalfSpace(p, w), Sphere(p, radius), Slab(p, q)]
    choice = [*flat, InfiniteCylinder(p, q, radius), Cylinder(p, q, radius)]
    return Probe(pick(dice, choice), Ray(origin, _along(dice)))


def _whole(dice: Dice) -> Vector:
    return tuple(float(dice.integer(-2, 2)) for _ in range(3))  # type: ignore[return-value]


def _along(dice: Dice) -> Vector:
    length = pick(dice, (1.0, -1.0, 2.0, -2.0))
    return pick(dice, ((length, 0.0, 0.0), (0.0, length, 0.0), (0.0, 0.0, length)))


TREES: tuple[type[Tree], ...] = (Union, Intersection, Difference)
MOVES: tuple[Move, ...] = (*[walk] * 3, nudge, simplify, retreat, settle, turn, rescale, build)


def _thinner(probe: Probe, dice: Dice, factor: float) -> Probe | None:
    """Return the probe with radii, or lengths along the axes, times a factor."""
    if dice.integer(0, 1):
        return changed(probe, radius=lambda r: r * factor)

    def longer(leaf: Leaf) -> Leaf:
        if isinstance(leaf, HalfSpace | Sphere):
            return leaf
        return replace(leaf, q=along(leaf.p, factor, minus(leaf.q, leaf.p)))

    try:
        return Probe(map_leaves(longer, probe.solid), probe.ray)
    except Refused:
        return None


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
        while self._to(Probe(solid, self.best.ray) for solid in fewer(self.best.solid)):
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


def fewer(solid: Solid) -> Iterator[Solid]:
    """Yield a tree's parts, the tree without one, and all with a part or a leaf made simpler."""
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
        for other in fewer(part):
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
    for name in (name for _, leaf in leaves(probe.solid) for name in FIELDS[type(leaf)]):
        if name != "radius":
            yield start
        start += 1 if name == "radius" else 3
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
