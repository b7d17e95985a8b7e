"""The exact numbers of lanes, and which forms of them certainly vanish.

Every test is "certainly 0" or "not known": parts that are no single double are not looked into.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.arithmetic import Number, Pair, Singles, Triple, heads, size, two_prod
from raycert.oracle.batch.expansions import (
    cross_singles,
    dot_terms,
    paired,
    products,
    single,
    square_terms,
    vanishes,
)
from raycert.oracle.batch.lanes import Floats, Lanes, Mask
from raycert.oracle.batch.plan import Plan
from raycert.oracle.batch.vector import offset, speed, tilted


class Frame:
    """The exact numbers of a curved face's lanes, for the tests."""

    def __init__(self, plan: Plan, lanes: Lanes) -> None:
        """Take the lanes in the plan's units."""
        self.plan = plan
        self.y = offset(lanes, plan.first, plan.keep)
        self.v = speed(lanes, plan.keep)
        self.w = constants(plan, len(lanes.held))

    def still(self) -> Mask:
        """Tell where the ray certainly runs along the axis, or stands still: A = 0."""
        if not tilted(self.plan):
            return np.asarray(size(self.v) == 0)
        a, whole = cross_singles(paired(self.v), self.w)
        zero: Mask = whole & (size(heads(a)) == 0)
        return zero

    def on_face(self, at: NDArray[np.intp], high: Floats, low: Floats) -> Mask:
        """Tell of which lanes the point at t is certainly on the face."""
        point, whole = along(taken(self.y, at), heads(taken(paired(self.v), at)), high, low)
        if not tilted(self.plan):
            r = np.full_like(high, self.plan.radius)
            p, e = two_prod(r, r)
            return whole & vanishes([*square_terms(x for x, _ in point), -p, -e])
        g, held = cross_singles(point, taken(self.w, at))
        cap = [np.full_like(high, -x) for x in self.plan.cap]
        return whole & held & self.plan.exact & vanishes([*square_terms(x for x, _ in g), *cap])

    def at_start(self) -> Mask:
        """Tell where C = 0."""
        zero = np.zeros_like(self.v[0])
        return self.on_face(np.arange(len(zero)), zero, zero)

    def touching(self) -> Mask:
        """Tell where G = 0. A direction along a coordinate axis is taken as a unit vector."""
        count = sum((x != 0).astype(int) for x in self.v)
        x, y, z = (np.where(count == 1, np.sign(part), part) for part in self.v)
        v = paired((x, y, z))
        if tilted(self.plan):
            a, whole = cross_singles(v, self.w)
            det, held = single(dot_terms(self.y, a))
            k = [det]
        else:
            a, whole = v, np.ones_like(self.v[0], bool)
            parts, held = cross_singles(self.y, v)
            k = [x for x, _ in parts]
        aa, known = single(square_terms(x for x, _ in a))
        rr = tuple(np.full_like(aa, x) for x in self.plan.rr)
        terms = [*products((rr[0], rr[1]), (-aa, 0.0 * aa)), *square_terms(k)]
        return whole & held & known & self.plan.exact & vanishes(terms)

    def square_on(self) -> Mask:
        """Tell where B = 0."""
        if not tilted(self.plan):
            return vanishes(dot_terms(self.y, paired(self.v)))
        a, whole = cross_singles(paired(self.v), self.w)
        g, held = cross_singles(self.y, self.w)
        return whole & held & vanishes(dot_terms(a, g))


def along(y: Triple, v: Singles, high: Number, low: Number) -> tuple[Triple, Mask]:
    """Return y + t v, and where each part of it is one double."""
    parts: list[Pair] = []
    whole = np.ones(np.shape(high), bool)
    for i in range(3):
        value, held = single([*y[i], *products((high, low), (v[i], 0.0 * v[i]))])
        parts.append((value, 0.0 * value))
        whole &= held
    return (parts[0], parts[1], parts[2]), whole


def on_plane(y: Triple, v: Singles, w: Triple, high: Number, low: Number) -> Mask:
    """Tell where the point at t is certainly on a plane; where w has no part, none is looked at."""
    point, whole = along(masked(y, w), heads(masked(paired(v), w)), high, low)
    return whole & vanishes(dot_terms(point, w))


def taken(a: Triple, at: NDArray[np.intp]) -> Triple:
    """Return the lanes with these numbers."""
    x, y, z = ((high[at], low[at]) for high, low in a)
    return x, y, z


def masked(a: Triple, w: Triple) -> Triple:
    """Return a with 0 for the parts where w has none."""
    x, y, z = (
        (np.where(part[0] == 0, 0.0, high), np.where(part[0] == 0, 0.0, low))
        for (high, low), part in zip(a, w, strict=True)
    )
    return x, y, z


def constants(plan: Plan, n: int) -> Triple:
    """Return the axis or normal for each of n lanes."""
    x, y, z = ((np.full(n, high), np.full(n, low)) for high, low in plan.w)
    return x, y, z
