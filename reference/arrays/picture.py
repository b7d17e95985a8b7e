"""What is seen of each pixel: depth, normal, thickness, count, or the lists themselves.

    depth      the distance along the ray to its first hit; NaN where there is none
    normal     the outward unit normal at the first hit; NaN where there is none, or no face (t = 0)
    thickness  the total length inside, which only interval lists give; infinite if endless
    count      the number of intervals

The lists are made by the tracer and are its bits; what is derived from them here is for the eye.

The algebra of lists changes no number, so the first enter of a tree is, bit by bit, an end of some
leaf's list there. That leaf's face is the one that is hit; of several the first. The normal is
turned against the ray, which is outward where a ray enters, also through the face of a hole.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Slab,
    Sphere,
    Union,
    Vector,
    axis,
)
from raycert.reference.arrays.lists import Lists, Padded, padded
from raycert.reference.arrays.plan import Plan, Show
from raycert.reference.arrays.tracer import (
    Bundle,
    Part,
    cylinder,
    half_space,
    joined,
    slab,
    solve,
    sphere,
    walk,
)
from raycert.reference.arrays.vectors import Array, Mask, Vectors, present, take


class Picture(NamedTuple):
    """The values of every pixel, (height, width) or (height, width, 3), and how many rays hit."""

    values: Array
    hits: int


@np.errstate(all="ignore")
def picture(plan: Plan, show: Show) -> Picture:
    width, height = plan.size
    deep = (3,) if show == "normal" else ()
    values = np.full((width * height, *deep), np.nan)
    hits = 0
    for i, tile in enumerate(plan.tiles):
        values[tile.pixels(width)], hit = _tile(plan, plan.bundle(i), show)
        hits += hit
    return Picture(values.reshape(height, width, *deep), hits)


@np.errstate(all="ignore")
def lists(plan: Plan) -> Padded:
    """Return the interval list of every pixel, row by row of the picture."""
    blocks = joined([solve(plan.root, plan.bundle(i)) for i in range(len(plan.tiles))])
    width, height = plan.size
    lane = np.concatenate([tile.pixels(width) for tile in plan.tiles])[blocks.lane]
    order = np.argsort(lane, kind="stable")
    return padded(Lists(lane[order], blocks.enter[order], blocks.leave[order], width * height))


def enters(part: Part, rays: Bundle) -> Array:
    """Return the first enter of each ray, NaN where it has none; of a union without its lists."""
    if not rays.sees(part):
        return np.full(rays.lanes, np.nan)
    if isinstance(part.solid, Union):
        first = np.full(rays.lanes, np.nan)
        for child in part.parts:
            if rays.sees(child):
                first = np.fmin(first, enters(child, rays))
        return first
    return solve(part, rays, first=True).first()


def _tile(plan: Plan, rays: Bundle, show: Show) -> tuple[Array, int]:
    """Return the values of a tile, and how many of its rays hit."""
    speed = _length(rays.direction)
    if show in ("depth", "normal"):
        root = plan.root
        t = enters(root, rays) if plan.switches.first else solve(root, rays).first()
        hits = int(np.count_nonzero(~np.isnan(t)))
        return (normals(root, rays, t) if show == "normal" else t * speed), hits
    pairs = solve(plan.root, rays)
    count = pairs.counts()
    hits = int(np.count_nonzero(count))
    if show == "count":
        return count.astype(float), hits
    inside = (pairs.leave - pairs.enter) * take(speed, pairs.lane)
    total = np.bincount(pairs.lane, inside, rays.lanes)
    return np.where(count > 0, total, np.nan), hits


def _length(v: Vectors) -> Array:
    squares = [c * c for c in present(v)]
    return np.sqrt(np.sum(np.broadcast_arrays(*squares), axis=0)) if squares else np.zeros(1)


def normals(root: Part, rays: Bundle, t: Array) -> Array:
    """Return the unit normal in each lane at its first hit t; NaN where there is no face.

    The lists of the leaves are those that the bundle remembers from finding t.
    """
    origin, direction = _rows(rays.origin, rays.lanes), _rows(rays.direction, rays.lanes)
    normal = np.full((rays.lanes, 3), np.nan)
    free = t > 0
    for part in walk(root):
        if part.parts or part.index not in rays.lists:
            continue
        lanes = np.flatnonzero(_ends_at(rays.lists[part.index], t) & free)
        if lanes.size:
            free[lanes] = False
            x = origin[lanes] + t[lanes, None] * direction[lanes]
            normal[lanes] = _at(part, rays.only(lanes), t[lanes], x)
    against: Mask = np.sum(normal * direction, axis=1) > 0
    normal[against] *= -1
    unit: Array = normal / np.sqrt(np.sum(normal * normal, axis=1))[:, None]
    return unit


def _at(part: Part, rays: Bundle, t: Array, x: Array) -> Array:
    """Return a normal of a leaf, of any length, at points that are the ends t of its lists."""
    normal = np.full(x.shape, np.nan)
    free = np.ones(t.size, bool)
    for pairs, along, center in _faces(part, rays):
        here = _ends_at(pairs, t) & free
        normal[here] = _normal(x[here], along, center)
        free &= ~here
    return normal


def _ends_at(pairs: Lists, t: Array) -> Mask:
    """Return for each lane whether an interval begins or ends at t."""
    there = np.zeros(pairs.lanes, bool)
    for ends in (pairs.enter, pairs.leave):
        there[pairs.lane[ends == t[pairs.lane]]] = True
    return there


def _faces(part: Part, rays: Bundle) -> Iterator[tuple[Lists, Vector | None, Vector | None]]:
    """Yield the list of each face of a leaf, with an axis (None: a ball), a center (None: flat)."""
    match part.solid:
        case HalfSpace() as leaf:
            yield half_space(leaf, rays), axis(leaf), None
        case Sphere(center, _) as leaf:
            yield sphere(leaf, rays), None, center
        case Slab() as leaf:
            yield slab(leaf, rays), axis(leaf), None
        case InfiniteCylinder() as leaf:
            yield cylinder(leaf, rays, capped=False), axis(leaf), leaf.p
        case Cylinder(p, q, radius) as leaf:
            yield cylinder(InfiniteCylinder(p, q, radius), rays, capped=False), axis(leaf), p
            yield slab(Slab(p, q), rays), axis(leaf), None


def _normal(x: Array, along: Vector | None, center: Vector | None) -> Array:
    if center is None:
        return np.broadcast_to(np.array(along), x.shape)
    y: Array = x - np.array(center)
    if along is None:
        return y
    w = np.array(along)
    across: Array = y - (y @ w / (w @ w))[:, None] * w
    return across


def _rows(a: Vectors, lanes: int) -> Array:
    columns = [np.zeros(1) if c is None else c for c in a]
    return np.stack([np.broadcast_to(c, lanes) for c in columns], axis=1)
