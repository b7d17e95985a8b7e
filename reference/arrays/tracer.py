"""Rays in, interval lists out: for arrays of rays, in blocks, so that memory is bounded."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from raycert.cases.model import Solid
from raycert.reference.arrays.bundle import Bundle, Switches, number
from raycert.reference.arrays.lists import Lists, Padded, padded
from raycert.reference.arrays.solids import solve
from raycert.reference.arrays.vectors import Array

BLOCK = 4096
"""Rays at a time: the arrays of one step then fit in a cache."""
QUICK = Switches(scaling=True, axis=True, shared=True, caps=False, lists=False, misses=True)
"""The shortcuts that need no camera and no bounds on the rays."""


def intersect(
    solid: Solid, origins: Array, directions: Array, switches: Switches = QUICK
) -> Padded:
    """Return for each ray, a row of both arrays, what `raycert.reference.tracer.intersect` returns.

    >>> from raycert.cases.model import Sphere
    >>> starts, ways = np.array([[-3.0, 0, 0], [0, 5, 0]]), np.array([[1.0, 0, 0], [0, 1, 0]])
    >>> answer = intersect(Sphere((0, 0, 0), 1), starts, ways)
    >>> answer.pairs(0), answer.pairs(1)
    ([(2.0, 4.0)], [])
    """
    return padded(joined(list(_blocks(solid, origins, directions, switches))))


def _blocks(solid: Solid, origins: Array, directions: Array, switches: Switches) -> Iterator[Lists]:
    part = number(solid)
    for i in range(0, len(origins), BLOCK):
        u, v = (np.ascontiguousarray(a[i : i + BLOCK].T, float) for a in (origins, directions))
        bundle = Bundle((u[0], u[1], u[2]), (v[0], v[1], v[2]), u.shape[1], switches)
        with np.errstate(all="ignore"):
            yield solve(part, bundle)


def joined(blocks: list[Lists]) -> Lists:
    """Return the lists of blocks of lanes, one block after the other."""
    if not blocks:
        return Lists(np.empty(0, np.int64), np.empty(0), np.empty(0), 0)
    starts = np.cumsum([0, *(block.lanes for block in blocks)])
    lane = np.concatenate([b.lane + s for b, s in zip(blocks, starts, strict=False)])
    enter = np.concatenate([block.enter for block in blocks])
    leave = np.concatenate([block.leave for block in blocks])
    return Lists(lane, enter, leave, int(starts[-1]))
