"""Booleans of rounded interval lists, all lanes at once, where the rounding decides the order.

Lists are events, sorted by lane and t: +1 where a pair enters, -1 where it leaves. Rounding to
nearest is monotone, so that different rounded endpoints are in the order of the exact ones; a lane
in which two are equal is not decided here, nor one with a pair of no length, so that no rule of
closure is ever asked. Exceptions are 0, which is exactly the start, and infinity.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from raycert.cases.model import Difference, Intersection, Tree, Union
from raycert.oracle.batch.lanes import Floats, Mask


@dataclass(frozen=True, slots=True)
class Lists:
    """The pairs of all lanes in order, the lane of each, and which lanes are not decided."""

    lane: NDArray[np.intp]
    enter: Floats
    leave: Floats
    open: Mask


def combine(tree: Tree, parts: list[Lists]) -> Lists:
    """Return the lists of a Boolean from those of its parts."""
    if len(parts) == 1:
        return parts[0]  # as every one of the operations has it
    lane = np.concatenate([part.lane for part in parts for _ in range(2)])
    t = np.concatenate([side for part in parts for side in (part.enter, part.leave)])
    step = np.concatenate([np.full(len(part.lane), s) for part in parts for s in (1, -1)])
    first = np.concatenate([np.full(2 * len(part.lane), i == 0) for i, part in enumerate(parts)])
    undecided = np.logical_or.reduce([part.open for part in parts])
    order = np.lexsort((t, lane))
    lane, t, step, first = lane[order], t[order], step[order], first[order]
    same = (lane[1:] == lane[:-1]) & (t[1:] == t[:-1])
    undecided[lane[1:][same & (t[1:] > 0) & np.isfinite(t[1:])]] = True
    undecided[lane[(t == 0) & (step < 0)]] = True
    inside = _inside(tree, len(parts), np.cumsum(step * first), np.cumsum(step * ~first))
    last = np.append(~same, True) if len(t) else np.zeros(0, bool)
    lane, t, inside = lane[last], t[last], inside[last]
    before = np.append(False, inside[:-1])[: len(inside)]
    enters, leaves = inside & ~before, before & ~inside
    return Lists(lane[enters], t[enters], t[leaves], undecided)


def _inside(tree: Tree, parts: int, first: NDArray[np.intp], others: NDArray[np.intp]) -> Mask:
    """Tell after which events a lane is inside: a part's pairs are disjoint, and count 0 or 1."""
    inside: Mask
    match tree:
        case Union():
            inside = first + others > 0
        case Intersection():
            inside = first + others == parts
        case Difference():
            inside = (first > 0) & (others == 0)
    return inside
