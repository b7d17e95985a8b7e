"""The lanes of a block in NumPy: in the units of a leaf's plan, and what becomes of each.

`screen_*` is the float64 rung, `solve_*` the double-double one. Lanes that a rung has decided are
left out of the next, so that a miss costs little. `chunks` takes the same steps in the same order,
compiled.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.arithmetic import Singles, Triple, size, two_sum
from raycert.oracle.batch.decide import (
    LEAST,
    MOST,
    behind_ball,
    behind_wall,
    curved,
    half_space,
    joined,
    passed_half_space,
    passed_slab,
    slab,
)
from raycert.oracle.batch.formulas import ball, gap_ball, gap_wall, wall
from raycert.oracle.batch.leaf import CAPPED_WALL, PLANES, WALL, LeafPlan

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
Codes = NDArray[np.uint8]

MISS, HIT, UNSURE = range(3)
"""States: no pair; one pair; not decided on the rungs tried so far."""
FLOAT, PAIR, RATIONAL, INTEGER = range(4)
"""Rungs, from the cheapest."""
RUNGS = ("float64", "double-double", "rational", "integer")
KNOWN = 2.0
"""The side of an endpoint that the rounded number is exactly."""
SPEED = 2.0**64
"""A direction whose largest part is within 2^-64 and 2^64, or 0, stays as it is."""


@dataclass(frozen=True, slots=True)
class Outcomes:
    """Of a leaf, for each lane: the state, the rung that gave it, and the pair of a hit.

    `before` and `after` are the sides of enter and leave, as in `decide`, and `KNOWN` where the
    exact endpoint is the number itself.
    """

    state: Codes
    rung: Codes
    enter: Floats
    leave: Floats
    before: Floats
    after: Floats

    @classmethod
    def unsure(cls, n: int) -> Outcomes:
        """Return n lanes of which nothing is known."""
        state, rung = np.full(n, UNSURE, np.uint8), np.zeros(n, np.uint8)
        return cls(state, rung, np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n))

    @classmethod
    def of(cls, ends: Any, rung: int) -> Outcomes:
        """Return what `decide` returns, as found on a rung."""
        state = np.asarray(ends[0]).astype(np.uint8)
        return cls(state, np.full(len(state), rung, np.uint8), *ends[1:])

    @property
    def ends(self) -> tuple[Floats, Floats, Floats, Floats, Floats]:
        """Return the state and the pair as `decide` does."""
        state = self.state.astype(np.float64)
        return state, self.enter, self.leave, self.before, self.after

    def put(self, at: Any, other: Outcomes) -> None:
        """Write what another has found of some lanes."""
        for name in self.__slots__:
            getattr(self, name)[at] = getattr(other, name)

    def mark(self, at: Any, state: int, rung: int, leave: float = 0.0) -> None:
        """Write of some lanes that they miss, or hit from 0 to `leave`, exactly."""
        self.state[at], self.rung[at] = state, rung
        self.enter[at], self.leave[at] = 0.0, leave
        self.before[at] = self.after[at] = KNOWN


@dataclass(frozen=True, slots=True)
class Lanes:
    """Scaled rays: rows 0 to 2 the origin, 3 to 5 the direction; t is `back` times the scaled t.

    `held`: all of the ray is in the range of `formulas`, and scaling it was exact.
    """

    rows: Floats
    back: Any
    held: Mask

    @classmethod
    def of(cls, plan: LeafPlan, rays: Floats) -> Lanes:
        """Return rays, given as six rows, in the units of a plan."""
        rows = rays if plan.stretch == 1.0 else rays.copy()
        back: Any = np.ones(rays.shape[1])
        if plan.stretch != 1.0:
            rows[:3] *= plan.stretch
            back /= plan.stretch
        fastest = np.max(np.abs(rays[3:]), axis=0)
        odd = (fastest > SPEED) | ((fastest < 1.0 / SPEED) & (fastest > 0))
        if odd.any():
            rows = rows.copy() if rows is rays else rows
            power = np.clip(np.frexp(fastest)[1] - 1, -1000, 1000)
            factor = np.where(odd, np.ldexp(1.0, -power), 1.0)
            rows[3:] *= factor
            back *= factor
        sizes = np.abs(rows)
        inside = ((sizes >= plan.low) & (sizes <= plan.high)) | (rays == 0)
        held = inside.all(axis=0) & (back >= LEAST) & (back < MOST)
        return cls(rows, back, held)

    def take(self, at: NDArray[np.intp]) -> Lanes:
        """Return the lanes with these numbers."""
        return Lanes(self.rows.take(at, axis=1), self.back[at], self.held[at])

    @property
    def v(self) -> tuple[Floats, Floats, Floats]:
        """Return the direction."""
        return self.rows[3], self.rows[4], self.rows[5]


ALL = (True, True, True)
PART = 8192
"""So many lanes at a time stay in a processor's cache."""


def heads(lanes: Lanes, point: tuple[float, float, float], keep: tuple[bool, ...]) -> Singles:
    """Return u - point rounded, with 0 for the coordinates that are not kept."""
    zero = None if all(keep) else np.zeros(lanes.rows.shape[1])
    x, y, z = (lanes.rows[i] - point[i] if keep[i] else zero for i in range(3))
    return x, y, z


def offset(lanes: Lanes, point: tuple[float, float, float], keep: tuple[bool, ...]) -> Triple:
    """Return u - point exactly, with 0 for the coordinates that are not kept."""
    zero = None if all(keep) else np.zeros(lanes.rows.shape[1])
    x, y, z = (two_sum(lanes.rows[i], -point[i]) if keep[i] else (zero, zero) for i in range(3))
    return x, y, z


def speed(lanes: Lanes, keep: tuple[bool, ...]) -> Singles:
    """Return the direction, with 0 for the coordinates that are not kept."""
    x, y, z = (a if kept else np.zeros_like(a) for a, kept in zip(lanes.v, keep, strict=True))
    return x, y, z


def tilted(plan: LeafPlan) -> bool:
    """Tell whether the curved face has an axis."""
    return plan.kind in (WALL, CAPPED_WALL)


def axis(plan: LeafPlan) -> Singles:
    """Return the leading doubles of the axis or normal."""
    return plan.w[0][0], plan.w[1][0], plan.w[2][0]


def screen_curved(plan: LeafPlan, lanes: Lanes) -> Mask:
    """Return the lanes that certainly miss the curved face: D < 0, or B > 0 and C > 0."""
    y, v = heads(lanes, plan.first, plan.keep), speed(lanes, plan.keep)
    if tilted(plan):
        a, ea, gap, bound = gap_wall(y, v, axis(plan), plan.size, plan.rr[0])
    else:
        gap, bound = gap_ball(y, v, plan.rr[0])
    missed: Mask = gap < -bound
    (at,) = np.nonzero(~missed)
    y = (y[0][at], y[1][at], y[2][at])
    if tilted(plan):
        a = (a[0][at], a[1][at], a[2][at])
        missed[at] = behind_wall(a, ea[at], y, axis(plan), plan.size, plan.cap[0])
    else:
        missed[at] = behind_ball((v[0][at], v[1][at], v[2][at]), y, plan.cap[0])
    return missed


def solve_curved(plan: LeafPlan, lanes: Lanes) -> Outcomes:
    """Return what pairs of doubles decide of the curved face."""
    y, v = offset(lanes, plan.first, plan.keep), speed(lanes, plan.keep)
    if tilted(plan):
        terms = wall(y, v, plan.w, plan.size, plan.rr, plan.cap)
    else:
        terms = ball(y, v, plan.rr)
    return Outcomes.of(curved(terms, plan.root_w, lanes.back, size(v)), PAIR)


def screen_planes(plan: LeafPlan, lanes: Lanes) -> tuple[Mask, Mask]:
    """Return the lanes that certainly miss, and those that are inside and never leave."""
    y, n = heads(lanes, plan.second, ALL), axis(plan)
    if plan.planes == 1:
        state = passed_half_space(y, lanes.v, n, plan.size)
        return state == MISS, state == HIT
    missed = passed_slab(y, heads(lanes, plan.first, ALL), lanes.v, n, plan.size)
    return missed, np.zeros_like(missed)


def solve_planes(plan: LeafPlan, lanes: Lanes) -> Outcomes:
    """Return what pairs of doubles decide of a half-space or slab."""
    y = offset(lanes, plan.second, ALL)
    if plan.planes == 1:
        return Outcomes.of(half_space(y, lanes.v, plan.w, plan.size, lanes.back), PAIR)
    x = offset(lanes, plan.first, ALL)
    return Outcomes.of(slab(y, x, lanes.v, plan.w, plan.size, lanes.back), PAIR)


def leaf_block(plan: LeafPlan, rays: Floats) -> Outcomes:
    """Return what both rungs decide of a block of rays, given as six rows."""
    found = Outcomes.unsure(rays.shape[1])
    if not plan.reason:
        for i in range(0, rays.shape[1], PART):
            _part(plan, rays[:, i : i + PART], i, found)
    return found


def _part(plan: LeafPlan, rays: Floats, begin: int, found: Outcomes) -> None:
    lanes = Lanes.of(plan, rays)
    (at,) = np.nonzero(lanes.held)
    if len(at) < len(lanes.held):
        lanes = lanes.take(at)
    at += begin
    if plan.kind != PLANES:
        missed = screen_curved(plan, lanes)
        found.mark(at[missed], MISS, FLOAT)
        at, lanes = _left(at, lanes, missed)
    if plan.planes:
        missed, whole = screen_planes(plan, lanes)
        found.mark(at[missed], MISS, FLOAT)
        found.mark(at[whole], HIT, FLOAT, np.inf)
        at, lanes = _left(at, lanes, missed | whole)
    if len(at):
        found.put(at, _solve(plan, lanes))


def _left(at: NDArray[np.intp], lanes: Lanes, done: Mask) -> tuple[NDArray[np.intp], Lanes]:
    """Return the lanes that are not done."""
    (left,) = np.nonzero(~done)
    return at[left], lanes.take(left)


def _solve(plan: LeafPlan, lanes: Lanes) -> Outcomes:
    if plan.kind == PLANES:
        return solve_planes(plan, lanes)
    found = solve_curved(plan, lanes)
    if plan.planes:
        return Outcomes.of(joined(found.ends, solve_planes(plan, lanes).ends), PAIR)
    return found
