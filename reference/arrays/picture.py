"""What is seen of each pixel: depth, normal, thickness, count, or the lists themselves.

    depth      the distance along the ray to its first hit; NaN where there is none
    normal     the outward unit normal at the first hit; NaN where there is none, or no face (t = 0)
    thickness  the total length inside, which only interval lists give; infinite if endless
    count      the number of intervals

The lists are made by the tracer and are its bits; what is derived from them here is for the eye.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from raycert.cases.model import Union
from raycert.reference.arrays.bundle import Bundle, Part
from raycert.reference.arrays.items import Show
from raycert.reference.arrays.lists import Lists, Padded, padded
from raycert.reference.arrays.normals import normals
from raycert.reference.arrays.plan import Plan
from raycert.reference.arrays.solids import solve
from raycert.reference.arrays.tracer import joined
from raycert.reference.arrays.vectors import Array, Vectors, present, take


@dataclass(frozen=True, slots=True)
class Picture:
    """The values of every pixel, (height, width) or (height, width, 3), and how many rays hit."""

    values: Array
    hits: int


def picture(plan: Plan, show: Show) -> Picture:
    """Return what a plan's scene looks like."""
    width, height = plan.size
    deep = (3,) if show == "normal" else ()
    values = np.full((width * height, *deep), np.nan)
    hits = 0
    with np.errstate(all="ignore"):
        for i, tile in enumerate(plan.tiles):
            seen, hit = _tile(plan, plan.bundle(i), show)
            values[tile.pixels(width)] = seen
            hits += hit
    return Picture(values.reshape(height, width, *deep), hits)


def lists(plan: Plan) -> Padded:
    """Return the interval list of every pixel, row by row of the picture."""
    with np.errstate(all="ignore"):
        blocks = [solve(plan.root, plan.bundle(i)) for i in range(len(plan.tiles))]
    width, height = plan.size
    pixel = np.concatenate([tile.pixels(width) for tile in plan.tiles])
    found = joined(blocks)
    lane = pixel[found.lane]
    order = np.argsort(lane, kind="stable")
    return padded(Lists(lane[order], found.enter[order], found.leave[order], width * height))


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
    found = solve(plan.root, rays)
    count = found.counts()
    hits = int(np.count_nonzero(count))
    if show == "count":
        return count.astype(float), hits
    inside = (found.leave - found.enter) * take(speed, found.lane)
    total = np.bincount(found.lane, inside, rays.lanes)
    return np.where(count > 0, total, np.nan), hits


def _length(v: Vectors) -> Array:
    squares = [c * c for c in present(v)]
    return np.sqrt(np.sum(np.broadcast_arrays(*squares), axis=0)) if squares else np.zeros(1)
