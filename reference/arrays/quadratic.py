"""Problem 1 in many lanes: where |y + t v| <= r, as `raycert.reference.quadratic` does it in one.

What misses leaves first: the roots are taken only in the lanes that hit. `Line` has what the
direction alone gives, `Start` what the start alone gives, so either can be shared.

`textbook_chord` is the formula of schoolbooks, b^2 - a c, to see what it loses: the difference of
two squares that are large where the start is far away. At a distance of D radii only u D^2 of it is
right, and from D = 1e8 on nothing is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from raycert.reference.arrays.lists import Lists
from raycert.reference.arrays.vectors import (
    Array,
    Mask,
    Vectors,
    Whole,
    cross,
    dot,
    norm,
    rough,
    take,
    take_all,
)

BEYOND = 1 + 2.0**-40
"""By how much a miss must be a miss in rough numbers, whose error is some 2^-49."""
ROUGHEST, FINEST = 2.0**200, 2.0**-200
"""Outside of these the squares of rough numbers might not be normal numbers."""


@dataclass(frozen=True)
class Line:
    """A direction across an axis, or the direction itself for a sphere."""

    v: Vectors

    @cached_property
    def vv(self) -> Array:
        return dot(self.v, self.v)

    @cached_property
    def length(self) -> Array:
        return norm(self.v)

    @cached_property
    def rough(self) -> Array:
        return rough(self.v)


@dataclass(frozen=True)
class Start:
    """A start relative to an axis or a center, and the radius in the same unit."""

    y: Vectors
    r: Array

    @cached_property
    def length(self) -> Array:
        return norm(self.y)

    def only(self, lanes: Whole) -> Start:
        """Return the start in some lanes; a length that all share is not made again."""
        if self.r.size == 1 and all(c is None or c.size == 1 for c in self.y):
            return self
        return Start(take_all(self.y, lanes), take(self.r, lanes))


def chord(start: Start, line: Line, lanes: int, misses: bool, first: bool) -> Lists:
    """Return the interval of t >= 0 for which |y + t v| <= r: the table of Problem 1 (m).

    With `misses`, rough numbers say first which lanes miss. With `first` the leaves are NaN: only
    their signs are made, where the row needs them.
    """
    near = _near(start, line, lanes) if misses else np.arange(lanes)
    v = take_all(line.v, near)
    some = start.only(near)
    vv, length = take(line.vv, near), take(line.length, near)
    reach, offset = some.r * length, norm(cross(v, some.y))
    along = np.broadcast_to(vv == 0, near.shape)
    hit = np.broadcast_to(reach >= offset, near.shape) & ~along
    at = np.flatnonzero(hit)
    vv, reach, offset = take(vv, at), take(reach, at), take(offset, at)
    pairs = _through(near[at], some.only(at), take_all(v, at), vv, (reach, offset), first)
    if along.any():
        inside = near[along & np.broadcast_to(some.length <= some.r, near.shape)]
        whole = inside, np.zeros(inside.size), np.full(inside.size, np.inf)
        lane, enter, leave = (np.concatenate(both) for both in zip(pairs, whole, strict=True))
        order = np.argsort(lane)
        pairs = lane[order], enter[order], leave[order]
    return Lists(*pairs, lanes)


def _near(start: Start, line: Line, lanes: int) -> Whole:
    """Return the lanes that do not miss by much."""
    reach, offset = start.r * line.rough, rough(cross(line.v, start.y))
    away = (offset > reach * BEYOND) & (offset > FINEST) & (offset < ROUGHEST)
    return np.flatnonzero(np.broadcast_to(~away, lanes))


def _through(
    lane: Whole, start: Start, v: Vectors, vv: Array, sizes: tuple[Array, Array], first: bool
) -> tuple[Whole, Array, Array]:
    """Return the rows behind, from-inside and through, for lanes that meet the circle."""
    reach, offset = sizes
    half = np.sqrt((reach - offset) * (reach + offset))
    c = (start.length - start.r) * (start.length + start.r)
    b = dot(v, start.y)
    t1, t2 = roots(vv, b, c, half, first)
    t1, t2 = (np.broadcast_to(t, lane.shape) for t in (t1, t2))
    keep: Mask = ~(t2 < 0)
    enter = t1[keep]
    leave = np.full(enter.size, np.nan) if first else t2[keep]
    return lane[keep], np.where(enter < 0, 0.0, enter), leave


def roots(a: Array, b: Array, c: Array, half: Array, first: bool = False) -> tuple[Array, Array]:
    """Return t1 <= t2, the roots of Problem 1 (f), as `raycert.reference.quadratic.roots` does.

    With `first`, t2 only has the right sign.
    """
    ahead = b > 0
    stable = 2 * half > abs(b)
    k = np.where(ahead, -b - half, -b + half)
    near, ratio = k / a, c / k
    enter = np.where(stable, np.where(ratio < near, ratio, near), (-b - half) / a)
    if first:
        sign = np.where(stable, ratio, -1.0)
        return np.where(ahead, near, enter), np.where(ahead, sign, 1.0)
    leave = np.where(stable, np.where(ratio > near, ratio, near), (-b + half) / a)
    return np.where(ahead, near, enter), np.where(ahead, leave, near)


def textbook_chord(start: Start, line: Line, lanes: int, *_: bool) -> Lists:
    """Return the same by the schoolbook's formula, which takes no shortcut."""
    a, b = line.vv, dot(line.v, start.y)
    c = dot(start.y, start.y) - start.r * start.r
    disc = b * b - a * c
    root = np.sqrt(disc)
    along = a == 0
    enter = np.where(along, 0.0, (-b - root) / a)
    leave = np.where(along, np.inf, (-b + root) / a)
    hit = np.where(along, c <= 0, (disc >= 0) & (leave >= 0))
    lane = np.arange(lanes)
    enter, leave = (np.broadcast_to(x, lane.shape) for x in (np.maximum(enter, 0.0), leave))
    return Lists(lane, enter, leave, lanes).where(np.broadcast_to(hit, lane.shape))
