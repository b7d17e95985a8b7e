"""Hard numbers, and scenes made of picks from them: the pool of `draw` and of `strategies`.

A recipe is plain data without constraints, so that whoever draws it can draw and shrink each part
by itself. Here parts meet: leaves take points, axes and radii from one pool, and the ray is aimed
in a frame of a leaf. Whatever the format has room for is exact; the rest is rounded to it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import frexp, ldexp, sqrt
from typing import Any

from raycert.cases.formats import BINARY64, Format
from raycert.cases.model import (
    SOLIDS,
    HalfSpace,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Vector,
    leaves,
)
from raycert.cases.vectors import cross, dot

TREES = tuple(name for name, kind in SOLIDS.items() if issubclass(kind, Tree))
LEAVES = tuple(name for name in SOLIDS if name not in TREES)
Axis = tuple[Vector, Vector]
"""A point and a direction other than 0."""
UNITS: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
STILL: Vector = (0.0, 0.0, 0.0)
LENGTHS = (1.0, -1.0, 2.0, 4.0, -0.5)
DIRECTIONS: tuple[Vector, ...] = (
    *((x, 0.0, 0.0) for x in LENGTHS),
    *((0.0, x, 0.0) for x in LENGTHS),
    *((0.0, 0.0, x) for x in LENGTHS),
    *((3.0, 4.0, 0.0), (0.0, -4.0, 3.0), (4.0, 0.0, -3.0), (1.0, -2.0, 2.0)),
    *((1.0, 1.0, 0.0), (0.0, 1.0, -1.0), (1.0, 0.0, 2.0), (1.0, 1.0, 1.0)),
)
"""Along the axes, of whole length, and simple."""
RADII = (1.0, 2.0, 1.0, 0.5, 0.0, 5.0, 1.0, 3.0)
ALONG = (0.5, 1.0, 0.0, -1.0, 2.0)
AWAY = (1.0, 1.0, 0.0, -1.0, 1.0, 0.5)
"""Where on a leaf a ray aims, in units of the leaf: along its axis, and away from it."""
TURNS: tuple[Vector, ...] = (
    *((1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0), (1.0, 0.0, 1.0), (1.0, -1.0, 2.0)),
    *((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 0.0, 2.0), (0.0, 1.0, 1.0), (0.0, -1.0, 2.0)),
    *((0.0, 1.0, 0.0), (0.0, -1.0, 0.0)),
)
"""How a ray runs there: away from the axis, along it, around it."""
BACK = (2.0, 4.0, 0.0, 8.0, 1.0, 0.5, -1.0)
SPEEDS = (1.0, 1.0, 1.0, 2.0, 0.5, 8.0, 0.125)
NESTED = ((2.0, 1.0), (5.0, 3.0), (3.0, 0.5), (1.0, 0), (0, 1), (1, 1), (1.0, 2.0))
"""Radii about one axis or center; whole numbers are picks."""
PICKS = (0, 0, 0, 0, 1, 1, 2, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11)
MOVED = (*[None] * 84, *((i, up) for i in range(6) for up in (True, False)))
"""Which number of a ray is replaced by a neighbour, above or below: in one case of eight, one."""


def neighbour(number: float, up: bool, fmt: Format = BINARY64) -> float:
    """Return the next number of the format above or below; of 0 it is 2^-precision, not subnormal.

    >>> neighbour(1.0, False) == 1 - 2.0**-53, neighbour(-1.0, False) == -1 - 2.0**-52
    (True, True)
    """
    share, exponent = frexp(number)
    toward_zero = abs(share) == 0.5 and (number > 0) != up
    ulp = ldexp(1.0, exponent - fmt.precision - toward_zero)
    return number + (ulp if up else -ulp)


@dataclass(frozen=True, slots=True)
class Pool:
    """What the parts of a scene may share. A pick is an index into it, or a value of its own."""

    points: tuple[Vector, ...]
    axes: tuple[Axis, ...]
    radii: tuple[float, ...]
    fmt: Format

    @classmethod
    def of(
        cls, points: Iterable[Vector], axes: Iterable[Axis], radii: Iterable[float], fmt: Format
    ) -> Pool:
        """Return a pool of these, of what continues them, and of their neighbours."""
        points, radii, lines = list(points), list(radii), list[Axis]()
        for p, w in axes:
            q = _sum(fmt, (1, p), (1, w))
            lines += [(p, w), (q, w), (q, _sum(fmt, (-1, w))), (p, _sum(fmt, (2, w)))]
            lines += [(_sum(fmt, (1, p), (3, w)), w), (points[0], w)]
            points += [p, q, (p[0], p[1], neighbour(p[2], True, fmt))]
        radii += [*radii, *(abs(neighbour(radii[0], up, fmt)) for up in (True, False))]
        return cls(tuple(points), tuple(lines), tuple(radii), fmt)

    def point(self, pick: int | Vector) -> Vector:
        return self.points[pick % len(self.points)] if isinstance(pick, int) else pick

    def axis(self, pick: int | Axis) -> Axis:
        return self.axes[pick % len(self.axes)] if isinstance(pick, int) else pick

    def radius(self, pick: int | float) -> float:
        """Return the radius picked; a float is one of its own."""
        return self.radii[pick % len(self.radii)] if isinstance(pick, int) else pick


@dataclass(frozen=True, slots=True)
class LeafRecipe:
    """A leaf; what its type does not need is ignored."""

    kind: str
    axis: int | Axis = 0
    point: int | Vector = 0
    radius: int | float = 0

    def count(self) -> int:
        return 1


@dataclass(frozen=True, slots=True)
class TreeRecipe:
    """A Boolean of one part or more."""

    kind: str
    of: list[Recipe]

    def count(self) -> int:
        return sum(part.count() for part in self.of)


Recipe = LeafRecipe | TreeRecipe


@dataclass(frozen=True, slots=True)
class Spot:
    """A point of a leaf, in one of its frames: so far `along` its axis and `away` from it."""

    leaf: int
    frame: int
    along: float
    away: float


@dataclass(frozen=True, slots=True)
class Aim:
    """A ray.

    It passes through a `spot` of a leaf, and runs by `turn` in a frame of the leaf: away from the
    axis, along it, around it; or on to the spot `toward`, of a leaf counted from the next one. It
    starts `back` from there, in units of its direction. A `free` one is a start and a direction
    instead. `moved` says which of its six numbers is replaced by a neighbour, above or below.
    """

    spot: Spot
    turn: Vector
    toward: Spot | None
    back: float
    speed: float
    free: tuple[int | Vector, Vector] | None
    moved: tuple[int, bool] | None


def alike(leaf: LeafRecipe, pick: int, radii: tuple[int | float, int | float]) -> list[Recipe]:
    """Return two leaves of a type: about the same center or axis, or with the second elsewhere."""
    if leaf.kind in ("sphere", "cylinder", "infinite_cylinder") and pick % 2 == 0:
        return [replace(leaf, radius=radius) for radius in radii]
    return [leaf, replace(leaf, axis=pick, point=pick)]


def make_leaf(recipe: LeafRecipe, pool: Pool) -> Leaf:
    make: Any = SOLIDS[recipe.kind]
    if make is Sphere:
        return Sphere(pool.point(recipe.point), pool.radius(recipe.radius))
    p, w = pool.axis(recipe.axis)
    if make is HalfSpace:
        return HalfSpace(p, w)
    q = _sum(pool.fmt, (1, p), (1, w))
    if q == p:  # w was lost in rounding
        q = _sum(pool.fmt, (1, p), (1, UNITS[2]))
    leaf: Leaf = make(p, q) if make is Slab else make(p, q, pool.radius(recipe.radius))
    return leaf


def make_solid(recipe: Recipe, pool: Pool) -> Solid:
    if isinstance(recipe, LeafRecipe):
        return make_leaf(recipe, pool)
    make: Any = SOLIDS[recipe.kind]
    tree: Solid = make(tuple(make_solid(part, pool) for part in recipe.of))
    return tree


def make_ray(solids: Iterable[Solid], aim: Aim, pool: Pool) -> Ray:
    if aim.free:
        origin, direction = pool.point(aim.free[0]), aim.free[1]
    else:
        every = [leaf for solid in solids for _, leaf in leaves(solid)]
        place, direction = _aimed(every, aim.spot, aim.turn, pool.fmt)
        if aim.toward:
            other = replace(aim.toward, leaf=aim.spot.leaf + 1 + aim.toward.leaf)
            end, _ = _aimed(every, other, aim.turn, pool.fmt)
            direction = _sum(pool.fmt, (1, end), (-1, place)) if end != place else direction
        origin = _sum(pool.fmt, (1, place), (-aim.back, direction))
    numbers = [*origin, *_sum(pool.fmt, (aim.speed, direction))]
    if aim.moved:
        i, up = aim.moved
        numbers[i] = neighbour(numbers[i], up, pool.fmt)
    a, b, c, d, e, f = numbers
    return Ray((a, b, c), (d, e, f))


def _aimed(every: list[Leaf], spot: Spot, turn: Vector, fmt: Format) -> tuple[Vector, Vector]:
    """Return a spot in space, and a direction by its frame."""
    leaf = every[spot.leaf % len(every)]
    place, w, reach, radius = _frame(leaf, spot.frame, fmt)
    e = _across(w, spot.frame // len(UNITS))
    away = spot.away * radius / sqrt(dot(e, e))
    target = _sum(fmt, (1, place), (spot.along * reach, w), (away, e))
    return target, _sum(fmt, (turn[0], e), (turn[1], w), (turn[2], cross(w, e)))


def _frame(leaf: Leaf, frame: int, fmt: Format) -> tuple[Vector, Vector, float, float]:
    """Return a point of a leaf, a direction, how far to go along it, and how far away from it."""
    match leaf:
        case HalfSpace():
            return leaf.point, leaf.normal, 0.0, 1.0
        case Sphere():
            return leaf.center, UNITS[frame % len(UNITS)], 0.0, leaf.radius
    radius = 1.0 if isinstance(leaf, Slab) else leaf.radius
    return leaf.p, _sum(fmt, (1, leaf.q), (-1, leaf.p)), 1.0, radius


def _across(w: Vector, turn: int) -> Vector:
    """Return one of the directions square to w, exactly so for a short w; whole ones if possible.

    >>> [_across((0.0, 0.0, 2.0), turn) for turn in (0, 1, 4)]
    [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (3.0, 4.0, 0.0)]
    """
    a, b, c = w
    square = [unit for unit, x in zip(UNITS, w, strict=True) if not x]
    if len(square) == 2:
        (d, e, f), (g, h, i) = square
        square += [*square, (3 * d + 4 * g, 3 * e + 4 * h, 3 * f + 4 * i)]
    else:
        square += [v for v in ((b, -a, 0.0), (0.0, c, -b)) if any(v)]
    return square[turn % len(square)]


def _sum(fmt: Format, *terms: tuple[float, Vector]) -> Vector:
    """Return a sum of multiples of vectors, in numbers of the format."""
    x = y = z = 0.0
    for factor, v in terms:  # `sum` rounds in another way from Python 3.12 on
        x, y, z = x + factor * v[0], y + factor * v[1], z + factor * v[2]
    return (fmt.nearest(x), fmt.nearest(y), fmt.nearest(z))
