"""The same solid with every face moved, inward or outward: the two lists that sandwich an answer.

A face moves at the ray's parameter t by delta(t) = k u s(t) + tolerance, where u = 2^-precision,
the tolerance is a length and a part of the face's own size (the radius of a curved one, the
thickness that a plane bounds; a half-space has none), and s(t) = s0 + s1 t is the size of the
numbers that meet there:

    half_space                s0 = N(u) + N(point) + N(u - point)        s1 = 2 N(v)
    sphere                    s0 = N(u) + N(center) + r                  s1 = N(v)
    slab and both cylinders   s0 = N(u) + N(p) + N(q) + r + N(u - p)     s1 = 2 N(v)

with N the norm rounded up (`norm_up`). With d the distance from axis or center, sigma = 1 outward
and -1 inward, and slack(t) = 0 (`strict`) or (k/4) u s(t)^2 (`squared`):

    curved face   d^2 <= (r + sigma delta)^2 + sigma slack,   r + sigma delta >= 0
    plane         c + b t <= sigma delta sqrt(S)              S the squared length of its normal

Both are conditions of degree 2 in t, so the endpoints of the moved lists are exact like any other.
A difference moves its first part one way and the others the other way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import isqrt
from typing import Literal, NamedTuple

from raycert.cases.domain import EXACT, Tolerance
from raycert.cases.formats import Format
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    leaves,
    points,
    radius,
)
from raycert.cases.vectors import minus, norm_up
from raycert.oracle.exact.grid import Grid
from raycert.oracle.exact.intervals import EVERYTHING, NOTHING, Intervals, clip, intersection
from raycert.oracle.exact.leaf import Plane, Quadric, ball, capped, caps, half_space, wall
from raycert.oracle.exact.surd import INFINITY, ZERO, sign_1
from raycert.oracle.exact.trace import combine

Measure = Literal["strict", "squared"]
Move = Callable[[Leaf], "Shift"]
Stay = tuple[type[Leaf], ...]
REFINE = 128
"""Grid bits below the inputs, whose unit N divides by at most 2^64 and k u by 2^58."""


@dataclass(frozen=True, slots=True)
class Step:
    """k = significand 2^exponent with two significant bits: 1/16, 3/32, 1/8, 3/16, 1/4, ..."""

    significand: int
    exponent: int

    @classmethod
    def at(cls, i: int) -> Step:
        """Return the i-th step, from 1/16 up."""
        return cls(2 + i % 2, i // 2 - 5)

    def __float__(self) -> float:
        """Return k, exactly."""
        return self.significand * 2.0**self.exponent

    def times(self, n: int, shift: int) -> int:
        """Return k n 2^-shift, an integer on a refined grid."""
        left = self.exponent - shift
        product = self.significand * n
        assert left >= 0 or not product & ((1 << -left) - 1), "the grid is too coarse for this k"
        return product << left if left >= 0 else product >> -left


LAST_STEP = 2 * (54 + 5)
"""k = 2^55: k u s(t) exceeds every distance in the scene, so it accepts a list or no k does."""


@dataclass(frozen=True, slots=True)
class Shift:
    """delta(t) = d0 + d1 t, and slack(t) = g0 + g1 t + g2 t^2, in grid units, all >= 0.

    To delta, `wall` is added for a curved face, and `cap` for a plane.
    """

    d0: int
    d1: int = 0
    g0: int = 0
    g1: int = 0
    g2: int = 0
    wall: int = 0
    cap: int = 0


def size(leaf: Leaf, grid: Grid) -> tuple[int, int]:
    """Return (s0, s1), the size of the numbers that meet on a leaf."""
    u, speed = grid.u, norm_up(grid.v)
    places, r = [grid.point(place) for place in points(leaf)], radius(leaf)
    meeting = norm_up(u) + sum(map(norm_up, places)) + (grid.scalar(r) if r else 0)
    if isinstance(leaf, Sphere):
        return meeting, speed
    return meeting + norm_up(minus(u, places[0])), 2 * speed


def own_sizes(leaf: Leaf, grid: Grid) -> tuple[int, int]:
    """Return the radius of a leaf and its thickness N(q - p); 0 for what it has not."""
    match leaf:
        case HalfSpace():
            return 0, 0
        case Sphere() | InfiniteCylinder():
            return grid.scalar(leaf.radius), 0
    thickness = norm_up(minus(grid.point(leaf.q), grid.point(leaf.p)))
    return 0 if isinstance(leaf, Slab) else grid.scalar(leaf.radius), thickness


def thinness(leaf: Leaf, grid: Grid) -> int:
    """Return 8c: the smaller of a leaf's radius and its thickness; 0 for a half-space."""
    radius, thickness = own_sizes(leaf, grid)
    return min(radius, thickness) if isinstance(leaf, Cylinder) else max(radius, thickness)


def below_zero(a: int, b: int, c: int, grid: Grid) -> Intervals:
    """Return the t >= 0 with a t^2 + b t + c <= 0: at most two intervals."""
    if not a:
        return half_line(b, 0, c, 0, 0, grid)
    disc = b * b - 4 * a * c
    if disc < 0 or (disc == 0 and a < 0):
        return NOTHING if a > 0 else EVERYTHING
    roots = grid.surd(-b, -1, disc, 2 * a), grid.surd(-b, 1, disc, 2 * a)
    low, high = min(roots), max(roots)
    if a > 0:
        return clip(low, high)
    if low.sign() < 0:
        return clip(high, INFINITY)
    return ((ZERO, low), (high, INFINITY))


def half_line(b0: int, b1: int, c0: int, c1: int, d: int, grid: Grid) -> Intervals:
    """Return the t >= 0 with (c0 + c1 sqrt(d)) + (b0 + b1 sqrt(d)) t <= 0.

    The end is t = -(c0 + c1 sqrt(d)) (b0 - b1 sqrt(d)) / (b0^2 - b1^2 d).
    """
    root = isqrt(d)
    if root * root == d:
        b0, b1, c0, c1, d = b0 + b1 * root, 0, c0 + c1 * root, 0, 0
    slope = sign_1(b0, b1, d)
    if not slope:
        return EVERYTHING if sign_1(c0, c1, d) <= 0 else NOTHING
    end = grid.surd(c1 * b1 * d - c0 * b0, c0 * b1 - c1 * b0, d, b0 * b0 - b1 * b1 * d)
    return clip(ZERO, end) if slope > 0 else clip(end, INFINITY)


def moved_wall(face: Quadric, radius: int, move: Shift, sigma: int, grid: Grid) -> Intervals:
    """Return the t >= 0 within a curved face moved by sigma delta."""
    d0 = move.d0 + move.wall
    a = face.a - face.scale * (move.d1 * move.d1 + sigma * move.g2)
    b = 2 * face.b - face.scale * (2 * (sigma * radius + d0) * move.d1 + sigma * move.g1)
    c = face.c - face.scale * (d0 * (2 * sigma * radius + d0) + sigma * move.g0)
    within = below_zero(a, b, c, grid)
    if sigma > 0:
        return within
    return intersection((within, half_line(move.d1, 0, d0 - radius, 0, 0, grid)))


def moved_plane(face: Plane, move: Shift, sigma: int, grid: Grid) -> Intervals:
    """Return the t >= 0 within a plane moved by sigma delta."""
    d0 = move.d0 + move.cap
    return half_line(face.b, -sigma * move.d1, face.c, -sigma * d0, face.square, grid)


class Faces(NamedTuple):
    """The faces of a leaf as conditions on t, and its radius: what does not depend on the move."""

    radius: int
    each: tuple[Quadric | Plane, ...]


def faces(leaf: Leaf, grid: Grid) -> Faces:
    """Return the faces of a leaf, the curved one first."""
    match leaf:
        case HalfSpace():
            return Faces(0, (half_space(leaf, grid),))
        case Sphere():
            return Faces(grid.scalar(leaf.radius), (ball(leaf, grid),))
        case InfiniteCylinder():
            return Faces(grid.scalar(leaf.radius), (wall(leaf, grid),))
        case Slab():
            return Faces(0, caps(leaf, grid))
    return Faces(grid.scalar(leaf.radius), capped(leaf, grid))


def moved_faces(of: Faces, move: Shift, sigma: int, grid: Grid) -> Intervals:
    """Return the list of a leaf whose faces moved by sigma delta."""
    return intersection(
        moved_plane(face, move, sigma, grid)
        if isinstance(face, Plane)
        else moved_wall(face, of.radius, move, sigma, grid)
        for face in of.each
    )


def moved_leaf(leaf: Leaf, move: Shift, sigma: int, grid: Grid) -> Intervals:
    return moved_faces(faces(leaf, grid), move, sigma, grid)


@dataclass(frozen=True)
class Movable:
    """A solid, a ray and a precision, ready to be moved; what does not depend on k, made once."""

    solid: Solid
    ray: Ray
    format: Format
    tolerance: Tolerance = EXACT

    @cached_property
    def grid(self) -> Grid:
        _, bottom = self.tolerance.relative.as_integer_ratio()
        refine = REFINE + bottom.bit_length() - 1
        return Grid.of(self.solid, self.ray, refine, (self.tolerance.absolute,))

    @cached_property
    def sizes(self) -> dict[Leaf, tuple[int, int]]:
        return {leaf: size(leaf, self.grid) for _, leaf in leaves(self.solid)}

    @cached_property
    def faces(self) -> dict[Leaf, Faces]:
        return {leaf: faces(leaf, self.grid) for _, leaf in leaves(self.solid)}

    def shift(self, leaf: Leaf, k: Step, measure: Measure) -> Shift:
        s0, s1 = self.sizes[leaf]
        bits = self.format.precision
        squares = (s0 * s0, 2 * s0 * s1, s1 * s1) if measure == "squared" else (0, 0, 0)
        slack = (k.times(s, bits + 2) for s in squares)
        allowed, *parts = self._allowed(leaf)
        return Shift(k.times(s0, bits) + allowed, k.times(s1, bits), *slack, *parts)

    def _allowed(self, leaf: Leaf) -> tuple[int, int, int]:
        """Return the declared tolerance: a length, and its parts for a curved face and a plane."""
        top, bottom = self.tolerance.relative.as_integer_ratio()
        radius, thickness = own_sizes(leaf, self.grid) if top else (0, 0)
        length = self.grid.scalar(self.tolerance.absolute)
        return length, radius * top // bottom, thickness * top // bottom

    def tolerance_is_fine(self) -> bool:
        """Whether the declared tolerance is at most each leaf's c; half-spaces have none."""
        solid = [leaf for _, leaf in leaves(self.solid) if not isinstance(leaf, HalfSpace)]
        allowed = {leaf: self._allowed(leaf) for leaf in solid}
        return all(a + max(b, c) <= self.constant(x).d0 for x, (a, b, c) in allowed.items())

    def constant(self, leaf: Leaf) -> Shift:
        """Return the move by c: 1/8 of the smaller of radius and thickness, 0 for a half-space."""
        return Shift(thinness(leaf, self.grid) >> 3)

    def by_k(self, k: Step, measure: Measure, sigma: int, still: Stay = ()) -> Intervals:
        """Return the outer (sigma = 1) or inner (sigma = -1) list of k; `still` leaves stay."""

        def move(leaf: Leaf) -> Shift:
            return Shift(0) if isinstance(leaf, still) else self.shift(leaf, k, measure)

        return self._moved(self.solid, sigma, move)

    def by_constant(self, sigma: int) -> Intervals:
        """Return the list with every face moved by its leaf's own c."""
        return self._moved(self.solid, sigma, self.constant)

    def _moved(self, solid: Solid, sigma: int, move: Move) -> Intervals:
        if not isinstance(solid, Tree):
            return moved_faces(self.faces[solid], move(solid), sigma, self.grid)
        away = -sigma if isinstance(solid, Difference) else sigma
        lists = [self._moved(part, away if i else sigma, move) for i, part in enumerate(solid.of)]
        return combine(solid, lists)
