"""The lanes of a block in NumPy: `screen` is the float64 rung, `solve` the double-double one.

Lanes that a rung has decided are left out of the next, so that a miss costs little. `chunks` takes
the same steps in the same order, compiled.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.arithmetic import Singles, Triple, size, two_sum
from raycert.oracle.batch.decide import (
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
from raycert.oracle.batch.lanes import FLOAT, HIT, MISS, PAIR, Floats, Found, Lanes, Mask
from raycert.oracle.batch.plan import CAPPED_WALL, PLANES, WALL, Plan

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


def tilted(plan: Plan) -> bool:
    """Tell whether the curved face has an axis."""
    return plan.kind in (WALL, CAPPED_WALL)


def axis(plan: Plan) -> Singles:
    """Return the leading doubles of the axis or normal."""
    return plan.w[0][0], plan.w[1][0], plan.w[2][0]


def screen_curved(plan: Plan, lanes: Lanes) -> Mask:
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


def solve_curved(plan: Plan, lanes: Lanes) -> Found:
    """Return what pairs of doubles decide of the curved face."""
    y, v = offset(lanes, plan.first, plan.keep), speed(lanes, plan.keep)
    if tilted(plan):
        terms = wall(y, v, plan.w, plan.size, plan.rr, plan.cap)
    else:
        terms = ball(y, v, plan.rr)
    return Found.of(curved(terms, plan.root_w, lanes.back, size(v)), PAIR)


def screen_planes(plan: Plan, lanes: Lanes) -> tuple[Mask, Mask]:
    """Return the lanes that certainly miss, and those that are inside and never leave."""
    y, n = heads(lanes, plan.second, ALL), axis(plan)
    if plan.planes == 1:
        state = passed_half_space(y, lanes.v, n, plan.size)
        return state == MISS, state == HIT
    missed = passed_slab(y, heads(lanes, plan.first, ALL), lanes.v, n, plan.size)
    return missed, np.zeros_like(missed)


def solve_planes(plan: Plan, lanes: Lanes) -> Found:
    """Return what pairs of doubles decide of a half-space or slab."""
    y = offset(lanes, plan.second, ALL)
    if plan.planes == 1:
        return Found.of(half_space(y, lanes.v, plan.w, plan.size, lanes.back), PAIR)
    x = offset(lanes, plan.first, ALL)
    return Found.of(slab(y, x, lanes.v, plan.w, plan.size, lanes.back), PAIR)


def leaf_block(plan: Plan, rays: Floats) -> Found:
    """Return what both rungs decide of a block of rays, given as six rows."""
    found = Found.unsure(rays.shape[1])
    if not plan.reason:
        for i in range(0, rays.shape[1], PART):
            _part(plan, rays[:, i : i + PART], i, found)
    return found


def _part(plan: Plan, rays: Floats, begin: int, found: Found) -> None:
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


def _solve(plan: Plan, lanes: Lanes) -> Found:
    if plan.kind == PLANES:
        return solve_planes(plan, lanes)
    found = solve_curved(plan, lanes)
    if plan.planes:
        return Found.of(joined(found.ends, solve_planes(plan, lanes).ends), PAIR)
    return found
