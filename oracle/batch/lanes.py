"""The lanes of a block in NumPy: in the units of a leaf's plan, and what becomes of each.

Lanes that a rung has decided are left out of the next, so that a miss costs little. `chunks` takes
the same steps in the same order, compiled.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.arithmetic import Singles
from raycert.oracle.batch.constants import ALL, BALL, WALL, LeafPlan
from raycert.oracle.batch.decide import (
    LEAST,
    MOST,
    joined,
    screen_ball,
    screen_half_space,
    screen_slab,
    screen_wall,
    solve_ball,
    solve_half_space,
    solve_slab,
    solve_wall,
)

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
        state, rung = np.full(n, UNSURE, np.uint8), np.zeros(n, np.uint8)
        return cls(state, rung, np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n))

    @classmethod
    def of(cls, ends: Any, rung: int) -> Outcomes:
        """Return what `decide` returns, decided on a rung."""
        state = np.asarray(ends[0]).astype(np.uint8)
        return cls(state, np.full(len(state), rung, np.uint8), *ends[1:])

    @property
    def ends(self) -> tuple[Floats, Floats, Floats, Floats, Floats]:
        """Return the state and the pair as `decide` does."""
        state = self.state.astype(np.float64)
        return state, self.enter, self.leave, self.before, self.after

    def put(self, at: Any, other: Outcomes) -> None:
        for name in self.__slots__:
            getattr(self, name)[at] = getattr(other, name)

    def mark(self, at: Any, state: Any, rung: int, leave: Any = 0.0) -> None:
        """Write of some lanes that they miss, or hit from 0 to `leave`, exactly."""
        self.state[at], self.rung[at] = state, rung
        self.enter[at], self.leave[at] = 0.0, leave
        self.before[at] = self.after[at] = KNOWN


@dataclass(frozen=True, slots=True)
class Lanes:
    """Scaled rays: rows 0 to 2 the origin, 3 to 5 the direction; t is `back` times the scaled t.

    `in_range`: all of the ray is in the range of `formulas`, and scaling it was exact.
    """

    rows: Floats
    back: Floats
    in_range: Mask

    @classmethod
    def of(cls, plan: LeafPlan, rays: Floats) -> Lanes:
        """Return rays, given as six rows, in the units of a plan."""
        rows, back = rays, np.full(rays.shape[1], 1.0 / plan.stretch)
        if plan.stretch != 1.0:
            rows = rays.copy()
            rows[:3] *= plan.stretch
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
        in_range = inside.all(axis=0) & (back >= LEAST) & (back < MOST)
        return cls(rows, back, in_range)

    def take(self, at: NDArray[np.intp]) -> Lanes:
        return Lanes(self.rows.take(at, axis=1), self.back[at], self.in_range[at])

    def ray(
        self, plan: LeafPlan, keep: tuple[bool, ...] = ALL
    ) -> tuple[Singles, Singles, list[Singles]]:
        """Return u, v and the points of a leaf, with 0 for the coordinates that are not kept."""
        u, v, p, q = (
            tuple(x if k else 0.0 * x for x, k in zip(a, keep, strict=True))
            for a in (self.rows[:3], self.rows[3:], *plan.points)
        )
        return u, v, [p, q]


PART = 8192
"""So many lanes at a time stay in a processor's cache."""
CURVED = {BALL: (screen_ball, solve_ball), WALL: (screen_wall, solve_wall)}
FLAT = {1: (screen_half_space, solve_half_space), 2: (screen_slab, solve_slab)}
Face = tuple[Callable[..., Any], Callable[..., Any], tuple[bool, ...]]


def faces(plan: LeafPlan) -> list[Face]:
    """Return both rungs of the curved face and of the planes, and the coordinates that matter."""
    curved, flat = CURVED.get(plan.kind), FLAT.get(plan.planes)
    return [(*rungs, keep) for rungs, keep in ((curved, plan.keep), (flat, ALL)) if rungs]


def leaf_block(plan: LeafPlan, rays: Floats) -> Outcomes:
    """Return what both rungs decide of a block of rays, given as six rows."""
    outcomes = Outcomes.unsure(rays.shape[1])
    if not plan.reason:
        for i in range(0, rays.shape[1], PART):
            _part(plan, rays[:, i : i + PART], i, outcomes)
    return outcomes


def _part(plan: LeafPlan, rays: Floats, begin: int, outcomes: Outcomes) -> None:
    lanes = Lanes.of(plan, rays)
    (at,) = np.nonzero(lanes.in_range)
    if len(at) < len(lanes.in_range):
        lanes = lanes.take(at)
    at += begin
    for screen, _, keep in faces(plan):
        state = screen(*lanes.ray(plan, keep), plan.numbers)
        unsure = state == UNSURE
        (done,), (left,) = np.nonzero(~unsure), np.nonzero(unsure)
        sure = state[done]
        outcomes.mark(at[done], sure, FLOAT, np.where(sure == HIT, np.inf, 0.0))
        at, lanes = at[left], lanes.take(left)
    if len(at):
        rungs = [(solve, lanes.ray(plan, keep)) for _, solve, keep in faces(plan)]
        lists = [solve(*ray, plan.numbers, lanes.back) for solve, ray in rungs]
        outcomes.put(at, Outcomes.of(reduce(joined, lists), PAIR))
