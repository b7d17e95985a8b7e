"""Rays in, interval lists out: what `raycert.reference.tracer` does, for many rays at a time.

A `Part` is a node of the solid with its place in the plan's tables. A `Bundle` is the rays of a
tile: it remembers what several parts ask of it, and hands on what all rays of a scene share. What
depends on the direction alone (`Course`) and on the start alone (`Meeting`) is kept apart, so that
a bundle can hand either on, from part to part and from tile to tile. `Switches` say which shortcuts
are taken; none of them changes a bit of an answer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import reduce
from itertools import count
from typing import NamedTuple, TypeVar

import numpy as np

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
    parts,
    points,
    radius,
)
from raycert.reference.arrays import vectors as vec
from raycert.reference.arrays.lists import (
    Lists,
    Padded,
    difference,
    intersection,
    nothing,
    padded,
    union,
)
from raycert.reference.arrays.quadratic import Line, Start, chord
from raycert.reference.arrays.vectors import Array, Mask, Vectors, Whole, dot, take_all
from raycert.reference.vectors import displacement, exponent, norm, scaled

T = TypeVar("T")
Chord = Callable[[Start, Line, int, bool, bool], Lists]
Memory = dict[object, object]


@dataclass(frozen=True, slots=True)
class Switches:
    """What the leaf routines do and leave out; the plan's items of the same names say why."""

    scaling: bool = True
    axis: bool = False
    shared: bool = False
    caps: bool = True
    lists: bool = True
    misses: bool = False
    first: bool = False
    chord: Chord = chord


PLAIN = Switches()
"""Nothing left out."""


@dataclass(frozen=True)
class Part:
    """A node: `index` is its column in the tables `seen` and `between` of a bundle."""

    solid: Solid
    parts: tuple[Part, ...]
    index: int


def number(solid: Solid, numbers: Iterator[int] | None = None) -> Part:
    """Return the tree with its nodes numbered, the root first."""
    numbers = numbers or count()
    index = next(numbers)
    return Part(solid, tuple(number(part, numbers) for part in parts(solid)), index)


def walk(part: Part) -> Iterator[Part]:
    yield part
    for child in part.parts:
        yield from walk(child)


@dataclass(frozen=True)
class Bundle:
    """Rays: origin and direction, each for all lanes at once or lane by lane.

    `memory` outlives the bundle: it is for what depends on a vector that all rays of the scene
    share. `here` is for what parts of this bundle share, `lists` has the list of each.
    `seen` tells which parts the rays may meet, `between` which cylinders only between the caps.
    """

    origin: Vectors
    direction: Vectors
    lanes: int
    switches: Switches = PLAIN
    memory: Memory = field(default_factory=dict)
    one_origin: bool = False
    one_direction: bool = False
    seen: Mask | None = None
    between: Mask | None = None
    here: Memory = field(default_factory=dict)
    lists: dict[int, Lists] = field(default_factory=dict)

    def only(self, lanes: Whole) -> Bundle:
        u, v = take_all(self.origin, lanes), take_all(self.direction, lanes)
        return replace(self, origin=u, direction=v, lanes=lanes.size, here={}, lists={})

    def of_origin(self, key: object, make: Callable[[], T]) -> T:
        """Return what depends on the origins alone: made once where they are all the same."""
        return self._remembered(self.one_origin, ("origin", key), make)

    def of_direction(self, key: object, make: Callable[[], T]) -> T:
        """Return what depends on the directions alone: likewise."""
        return self._remembered(self.one_direction, ("direction", key), make)

    def _remembered(self, one: bool, key: object, make: Callable[[], T]) -> T:
        if not (one or self.switches.shared):
            return make()
        memory = self.memory if one else self.here
        if key not in memory:
            memory[key] = make()
        return memory[key]  # type: ignore[return-value]

    def sees(self, part: Part) -> bool:
        return self.seen is None or bool(self.seen[part.index])


UNSCALED = np.zeros(1, np.int64)
"""The exponent of what was not scaled."""


class Course(NamedTuple):
    """The direction, scaled, and across an axis (a sphere has none)."""

    v: Vectors
    e: Whole
    line: Line


class Meeting(NamedTuple):
    """The start from each point of a leaf, scaled; and from the first across the axis."""

    y: list[Vectors]
    e: Whole
    start: Start


def _direction(rays: Bundle) -> tuple[Vectors, Whole]:
    if not rays.switches.scaling:
        return rays.direction, UNSCALED
    return rays.of_direction("scaled", lambda: vec.scaled(rays.direction))


def _from(point: Vector, rays: Bundle) -> tuple[Vectors, Whole]:
    """Return the origins from a point, scaled."""
    if not rays.switches.scaling:
        return vec.difference(point, rays.origin, rays.switches.axis), UNSCALED
    return vec.displacement(point, rays.origin, rays.switches.axis)


def _length(x: float, e: Whole) -> Array:
    length: Array = np.ldexp(np.array([x]), -e)
    return length


def course(w: Vector | None, rays: Bundle) -> Course:
    """Return the direction across an axis; w is the scaled axis, None for a sphere."""

    def make() -> Course:
        v, e = _direction(rays)
        across = v if w is None else vec.cross(v, vec.constant(w, rays.switches.axis))
        return Course(v, e, Line(across))

    return rays.of_direction(w, make)


def meeting(
    solid: Sphere | InfiniteCylinder | Slab | Cylinder, w: Vector | None, rays: Bundle
) -> Meeting:
    """Return the start relative to an axis, or to a sphere's center, where w is None."""

    def make() -> Meeting:
        starts, e = [_from(point, rays) for point in points(solid)], UNSCALED
        if rays.switches.scaling:
            e = reduce(np.maximum, [np.array(exponent(radius(solid))), *(ye for _, ye in starts)])
            starts = [(vec.shift(y, ye - e), e) for y, ye in starts]
        y, r = [y for y, _ in starts], _length(radius(solid), e)
        if w is None:
            return Meeting(y, e, Start(y[0], r))
        across = vec.cross(y[0], vec.constant(w, rays.switches.axis))
        return Meeting(y, e, Start(across, r * norm(w)))

    return rays.of_origin(solid, make)


def cylinder(
    solid: InfiniteCylinder | Cylinder, rays: Bundle, capped: bool, first: bool = False
) -> Lists:
    """Problems 1 and 3. Where caps are of no use the slab is left out."""
    w, _ = displacement(solid.p, solid.q)
    there, way = meeting(solid, w, rays), course(w, rays)
    endless = isinstance(solid, InfiniteCylinder)
    compare = capped or (endless and rays.switches.caps)
    misses = rays.switches.misses
    pairs = rays.switches.chord(there.start, way.line, rays.lanes, misses, first and not compare)
    if compare:
        enter, leave, keep = _planes(pairs.lane, there, way.v, w, rays, endless)
        enter, leave = np.maximum(pairs.enter, enter), np.minimum(pairs.leave, leave)
        pairs = Lists(pairs.lane, enter, leave, pairs.lanes).where(keep & (enter <= leave))
    return unscale(pairs, there.e - way.e, rays.switches.scaling)


def slab(solid: Slab, rays: Bundle) -> Lists:
    """Problem 2 (g)."""
    w, _ = displacement(solid.p, solid.q)
    there = meeting(solid, w, rays)
    v, e = _direction(rays)
    lanes = np.arange(rays.lanes)
    enter, leave, keep = _planes(lanes, there, v, w, rays)
    pairs = Lists(lanes, enter, leave, rays.lanes).where(keep)
    return unscale(pairs, there.e - e, rays.switches.scaling)


def _planes(
    lanes: Whole, there: Meeting, v: Vectors, w: Vector, rays: Bundle, endless: bool = False
) -> tuple[Array, Array, Mask]:
    """Return the row of Problem 2 in some lanes: enter, leave, and whether there is a pair.

    `endless`: the planes are nowhere, and no number is used.
    """
    n = vec.constant(w, rays.switches.axis)
    up, uq = (-dot(take_all(y, lanes), n) for y in there.y)
    vn = -dot(take_all(v, lanes), n)
    tp, tq = -up / vn, -uq / vn
    forth, past_q = vn > 0, uq < 0
    past_p = ~past_q & (up > 0)
    enter = np.where(past_q, tq, np.where(past_p, tp, 0.0))
    leave = np.where(past_q, tp, np.where(past_p, tq, np.where(forth, tp, tq)))
    keep = np.where(past_q, forth & (tq <= tp), np.where(past_p, (vn < 0) & (tp <= tq), True))
    level = (vn == 0) | endless
    keep = np.where(level, ((up <= 0) & (uq >= 0)) | endless, keep)
    enter, leave = np.where(level, 0.0, enter), np.where(level, np.inf, leave)
    return _wide(enter, lanes), _wide(leave, lanes), np.broadcast_to(keep, lanes.shape)


def half_space(solid: HalfSpace, rays: Bundle) -> Lists:
    """Problem 2 (c)."""
    n = vec.constant(scaled(solid.normal)[0], rays.switches.axis)
    v, ve = _direction(rays)
    y, ye = rays.of_origin(solid, lambda: _from(solid.point, rays))
    up, vn = dot(y, n), dot(v, n)
    t = -up / vn
    t = (np.ldexp(t, ye - ve) if rays.switches.scaling else t) + 0.0
    along = (vn == 0) | ((vn > 0) == (up > 0))
    keep = np.broadcast_to(~along | (up <= 0), rays.lanes)
    out = ~along & (vn > 0)
    lanes = np.arange(rays.lanes)
    enter, leave = np.where(along | out, 0.0, t), np.where(out, t, np.inf)
    return Lists(lanes, _wide(enter, lanes), _wide(leave, lanes), rays.lanes).where(keep)


def sphere(solid: Sphere, rays: Bundle, first: bool = False) -> Lists:
    """Return where the distance from the center is at most the radius."""
    there, way, misses = meeting(solid, None, rays), course(None, rays), rays.switches.misses
    pairs = rays.switches.chord(there.start, way.line, rays.lanes, misses, first)
    return unscale(pairs, there.e - way.e, rays.switches.scaling)


def unscale(pairs: Lists, e: Whole, scaling: bool) -> Lists:
    """Return the pairs with every t multiplied by 2^e: infinite if that overflows, never -0."""
    enter, leave = pairs.enter, pairs.leave
    if scaling:
        e = e if e.size == 1 else e[pairs.lane]
        enter, leave = np.ldexp(enter, e), np.ldexp(leave, e)
    return Lists(pairs.lane, enter + 0.0, leave + 0.0, pairs.lanes)


def _wide(a: Array, lanes: Whole) -> Array:
    return np.broadcast_to(a, lanes.shape)


def solve(part: Part, rays: Bundle, first: bool = False) -> Lists:
    """Return the intervals of t >= 0 for which each ray is in a solid.

    With `first`, the leaves of a primitive need not be there. The bundle remembers the lists.
    """
    if not rays.sees(part):
        return nothing(rays.lanes)
    lists = _tree(part, rays) if part.parts else _leaf(part, rays, first)
    rays.lists[part.index] = lists
    return lists


def _leaf(part: Part, rays: Bundle, first: bool) -> Lists:
    match part.solid:
        case HalfSpace() as solid:
            return half_space(solid, rays)
        case Sphere() as solid:
            return sphere(solid, rays, first)
        case Slab() as solid:
            return slab(solid, rays)
        case Cylinder() as solid:
            between = rays.between is not None and bool(rays.between[part.index])
            return cylinder(solid, rays, not between, first)
        case InfiniteCylinder() as solid:
            return cylinder(solid, rays, False, first)
    raise TypeError(part.solid)


def _tree(part: Part, rays: Bundle) -> Lists:
    """Combine the lists of the parts; where one list is the answer, nothing is compared."""
    short = not rays.switches.lists
    keep = isinstance(part.solid, Intersection)
    lists: list[Lists] = []
    for i, child in enumerate(part.parts):
        one = solve(child, rays)
        if one.lane.size or not short:
            lists.append(one)
        elif keep or (i == 0 and isinstance(part.solid, Difference)):
            return one
    if not lists:
        return nothing(rays.lanes)
    if short and len(lists) == 1:
        return lists[0]
    match part.solid:
        case Union():
            return union(lists)
        case Intersection():
            return intersection(lists)
    return difference(lists[0], union(lists[1:])) if len(lists) > 1 else union(lists)


BLOCK = 4096
"""Rays at a time: the arrays of one step then fit in a cache."""
QUICK = Switches(scaling=True, axis=True, shared=True, caps=False, lists=False, misses=True)
"""The shortcuts that need no camera and no bounds on the rays."""


def intersect(
    solid: Solid, origins: Array, directions: Array, switches: Switches = QUICK
) -> Padded:
    """Return for each ray, a row of both arrays, what `raycert.reference.tracer.intersect` returns.

    >>> from raycert.cases.model import Sphere
    >>> starts, ways = np.array([[-3.0, 0, 0], [0, 5, 0]]), np.array([[1.0, 0, 0], [0, 1, 0]])
    >>> answer = intersect(Sphere((0, 0, 0), 1), starts, ways)
    >>> answer.pairs(0), answer.pairs(1)
    ([(2.0, 4.0)], [])
    """
    return padded(joined(list(_blocks(solid, origins, directions, switches))))


def _blocks(solid: Solid, origins: Array, directions: Array, switches: Switches) -> Iterator[Lists]:
    part = number(solid)
    for i in range(0, len(origins), BLOCK):
        u, v = (np.ascontiguousarray(a[i : i + BLOCK].T, float) for a in (origins, directions))
        bundle = Bundle(tuple(u), tuple(v), u.shape[1], switches)
        with np.errstate(all="ignore"):
            yield solve(part, bundle)


def joined(blocks: list[Lists]) -> Lists:
    """Return the lists of blocks of lanes, one block after the other."""
    if not blocks:
        return nothing(0)
    starts = np.cumsum([0, *(block.lanes for block in blocks)])
    lane = np.concatenate([b.lane + s for b, s in zip(blocks, starts, strict=False)])
    enter, leave = (np.concatenate([block[i] for block in blocks]) for i in (1, 2))
    return Lists(lane, enter, leave, int(starts[-1]))
