"""Rays of a block in the units of a plan, and what becomes of a lane: its state and its rung."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.decide import LEAST, MOST
from raycert.oracle.batch.plan import Plan

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
class Found:
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
    def unsure(cls, n: int) -> Found:
        """Return n lanes of which nothing is known."""
        state, rung = np.full(n, UNSURE, np.uint8), np.zeros(n, np.uint8)
        return cls(state, rung, np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n))

    @classmethod
    def of(cls, ends: Any, rung: int) -> Found:
        """Return what `decide` returns, as found on a rung."""
        state = np.asarray(ends[0]).astype(np.uint8)
        return cls(state, np.full(len(state), rung, np.uint8), *ends[1:])

    @property
    def ends(self) -> tuple[Floats, Floats, Floats, Floats, Floats]:
        """Return the state and the pair as `decide` does."""
        state = self.state.astype(np.float64)
        return state, self.enter, self.leave, self.before, self.after

    def put(self, at: Any, other: Found) -> None:
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

    `held`: all of the ray is in the range of `bounds`, and scaling it was exact.
    """

    rows: Floats
    back: Any
    held: Mask

    @classmethod
    def of(cls, plan: Plan, rays: Floats) -> Lanes:
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
