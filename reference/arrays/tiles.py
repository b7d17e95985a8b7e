"""The rays of a camera, tile by tile, and which tile cannot meet which part of the solid.

The rays are those of the formula of `raycert.cases.scene`, to the bit. A tile is a square of
pixels, so that its rays are near each other: what one of them misses, all of them mostly miss.

The promise of the tracer is the ground of the bounds, which hold for every ray of a tile, rounding
included: a t that it answers for a leaf lies in the leaf with its faces moved by k u s(t), k at
most 64, where s(t) is at most 8 S and S the sum of the sizes at hand (origin, box, the leaf's own
numbers). So a leaf whose box, grown by 2^-36 S, meets no ray of a tile, has an empty answer there:
64 u 8 S = 2^-44 S is a part in 256 of that. The bounds themselves are made in doubles, whose errors
are some 2^-48 S.

A tile's rays lie in the half-spaces n . (x - point) >= 0 through neighbouring corner rays, and
before the eye. A box is missed if it lies wholly behind one of these planes. Caps are not met where
the stretch of the ray in the infinite cylinder, t <= T, lies between them by as much: then the slab
holds all of [0, T], and the intersection is the chord itself.
"""

from __future__ import annotations

from math import hypot, inf
from typing import NamedTuple

import numpy as np

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Leaf,
    Slab,
    Solid,
    Sphere,
    Tree,
    Vector,
    leaves,
    points,
    radius,
)
from raycert.cases.scene import Frame, pixel_ray
from raycert.reference.arrays.vectors import Array, Mask, Vectors, Whole
from raycert.reference.vectors import displacement

SIDE = 64
"""Pixels along a side of a tile: 4096 lanes, whose arrays fit in a cache."""


class Tile(NamedTuple):
    """The pixels in columns [left, right) and rows [top, bottom)."""

    left: int
    right: int
    top: int
    bottom: int

    @property
    def lanes(self) -> int:
        return (self.right - self.left) * (self.bottom - self.top)

    def pixels(self, width: int) -> Whole:
        """Return the index of each pixel in the picture, row by row."""
        rows, columns = np.arange(self.top, self.bottom), np.arange(self.left, self.right)
        return (rows[:, None] * width + columns).ravel()

    def corners(self) -> list[tuple[int, int]]:
        """Return (column, row) of the outermost pixels, around the tile."""
        right, bottom = self.right - 1, self.bottom - 1
        return [(self.left, self.top), (right, self.top), (right, bottom), (self.left, bottom)]


def tiles(size: tuple[int, int], side: int) -> list[Tile]:
    width, height = size
    return [
        Tile(left, min(left + side, width), top, min(top + side, height))
        for top in range(0, height, side)
        for left in range(0, width, side)
    ]


def rays(frame: Frame, size: tuple[int, int], tile: Tile) -> tuple[Vectors, Vectors]:
    """Return origins and directions of a tile's pixels; what all share has length 1."""
    width, height = size
    columns, rows = np.arange(tile.left, tile.right), np.arange(tile.top, tile.bottom)
    a = (2 * columns + 1 - width) / height * frame.scale
    b = (height - 1 - 2 * rows) / height * frame.scale
    if frame.kind == "perspective":
        return _shared(frame.eye), _spread(frame.forward, frame, a, b)
    return _spread(frame.eye, frame, a, b), _shared(frame.forward)


def widened(a: Vectors, lanes: int) -> Vectors:
    return tuple(None if c is None else np.repeat(c, lanes // c.size) for c in a)


def _shared(a: Vector) -> Vectors:
    return tuple(np.array([c], float) for c in a)


def _spread(base: Vector, frame: Frame, a: Array, b: Array) -> Vectors:
    parts = zip(base, frame.right, frame.top, strict=True)
    return tuple((c + a[None, :] * r + b[:, None] * t).ravel() for c, r, t in parts)


DOUBT = 2.0**-36
"""The part of the sizes by which a bound has to hold."""
STRETCH = 1 + 2.0**-20
"""How far beyond the exact root a computed one may lie, at a tangent start: 2^-23 of it."""


class Box(NamedTuple):
    """Bounds along the coordinate axes, and the size of the largest leaf's numbers."""

    low: Array
    high: Array
    size: float


class Cones(NamedTuple):
    """For each tile: planes that all rays lie before, and the mean and spread of the rays."""

    normal: Array
    point: Array
    scale: Array
    origin: Array
    spread: Array
    direction: Array
    turn: Array


def box(solid: Solid) -> Box:
    """Return bounds of a solid; infinite where there is none along an axis."""
    size = max(_leaf_size(leaf) for _, leaf in leaves(solid))
    if not isinstance(solid, Tree):
        low, high = np.array([_extent(solid, i) for i in range(3)]).T
        return Box(low, high, size)
    some = solid.of[:1] if isinstance(solid, Difference) else solid.of
    lows, highs, _ = zip(*map(box, some), strict=True)
    if isinstance(solid, Intersection):
        return Box(np.max(lows, 0), np.min(highs, 0), size)
    return Box(np.min(lows, 0), np.max(highs, 0), size)


def _leaf_size(leaf: Leaf) -> float:
    return sum(hypot(*point) for point in points(leaf)) + radius(leaf)


def _extent(leaf: Leaf, i: int) -> tuple[float, float]:
    match leaf:
        case HalfSpace(point, normal):
            if any(normal[j] for j in range(3) if j != i):
                return -inf, inf
            return (-inf, point[i]) if normal[i] > 0 else (point[i], inf)
        case Sphere(center, radius):
            return center[i] - radius, center[i] + radius
        case Slab(p, q):
            if any(p[j] != q[j] for j in range(3) if j != i):
                return -inf, inf
            return min(p[i], q[i]), max(p[i], q[i])
        case InfiniteCylinder(p, q, radius):
            return (p[i] - radius, p[i] + radius) if p[i] == q[i] else (-inf, inf)
        case Cylinder(p, q, radius):
            w, _ = displacement(p, q)
            reach = radius * hypot(*(w[j] for j in range(3) if j != i)) / hypot(*w)
            return min(p[i], q[i]) - reach, max(p[i], q[i]) + reach


def cones(frame: Frame, size: tuple[int, int], tiles: list[Tile]) -> Cones:
    """Return what the corner rays of each tile bound."""
    corners = [[pixel_ray(frame, size, *at) for at in tile.corners()] for tile in tiles]
    o = np.array([[ray.origin for ray in four] for four in corners])
    v = np.array([[ray.direction for ray in four] for four in corners])
    forward, after = np.array(frame.forward), [1, 2, 3, 0]
    if frame.kind == "perspective":
        normal, scale = np.cross(v, v[:, after]), _norm(v) * _norm(v[:, after])
        inward = v.mean(1)[:, None]
    else:
        normal, scale = np.cross(o[:, after] - o, forward), _norm(o) + _norm(o[:, after])
        inward = o.mean(1)[:, None] - o
    normal = normal * np.where(np.sum(normal * inward, -1) < 0, -1.0, 1.0)[..., None]
    ahead = np.broadcast_to(forward, (len(tiles), 1, 3))
    origin, direction = o.mean(1), v.mean(1)
    return Cones(
        np.concatenate((normal, ahead), 1),
        np.concatenate((o, np.broadcast_to(np.array(frame.eye), ahead.shape)), 1),
        np.concatenate((scale, np.ones((len(tiles), 1))), 1),
        origin,
        _norm(o - origin[:, None]).max(1),
        direction,
        _norm(v - direction[:, None]).max(1),
    )


def _norm(a: Array) -> Array:
    length: Array = np.sqrt(np.sum(a * a, -1))
    return length


def meets(cone: Cones, box: Box) -> Mask:
    """Return for each tile whether a ray of it may meet what is in a box."""
    middle, half = (box.low + box.high) / 2, (box.high - box.low) / 2
    far = _norm(cone.origin) + cone.spread + float(_norm(middle) + _norm(half)) + box.size
    far = np.where(np.isnan(far), inf, far)[:, None]
    height = np.sum(cone.normal * (middle - cone.point), -1)
    height = height + np.sum(abs(cone.normal) * half, -1)
    room = DOUBT * far * (cone.scale + (far if cone.spread.any() else 0))
    missed: Mask = (height < -room).any(1)
    return ~missed


def between_caps(cone: Cones, leaf: Cylinder) -> Mask:
    """Return for each tile whether its rays are in the infinite cylinder only between the caps."""
    axis, _ = displacement(leaf.p, leaf.q)
    w, p, q = np.array(axis), np.array(leaf.p), np.array(leaf.q)
    length, speed = _norm(w), _norm(cone.direction) + cone.turn
    across = _norm(np.cross(cone.direction, w)) - cone.turn * length - DOUBT * speed * length
    away = _norm(np.cross(cone.origin - p, w)) + cone.spread * length + leaf.radius * length
    last = np.where(across > 0, away / np.where(across > 0, across, 1.0) * STRETCH, inf)
    slope, steep = cone.direction @ w, cone.turn * length
    low = (cone.origin - p) @ w - cone.spread * length + last * np.minimum(slope - steep, 0.0)
    high = (cone.origin - q) @ w + cone.spread * length + last * np.maximum(slope + steep, 0.0)
    sizes = _norm(cone.origin) + cone.spread + _leaf_size(leaf) + last * speed
    doubt = DOUBT * sizes * length
    inside: Mask = (low > doubt) & (high < -doubt)
    return inside


def tables(cone: Cones, solids: list[Solid]) -> tuple[Mask, Mask]:
    """Return two tables, a row for each tile, a column for each node.

    The first says which nodes the tile's rays may meet, the second which cylinders they meet
    between the caps only.
    """
    none = np.zeros(len(cone.origin), bool)
    between = [between_caps(cone, x) if isinstance(x, Cylinder) else none for x in solids]
    return np.stack([meets(cone, box(solid)) for solid in solids], 1), np.stack(between, 1)
