"""Rounded interval lists, all lanes at once: their Booleans, and their rounding to binary32.

Lists are events, sorted by lane and t: +1 where a pair enters, -1 where it leaves. Rounding to
nearest is monotone, so that different rounded endpoints are in the order of the exact ones; a lane
in which two are equal is not decided here, nor one with a pair of no length, so that no rule of
closure is ever asked. Exceptions are 0, which is exactly the start, and infinity.

Nothing is rounded twice: a double that is no midpoint of two binary32 rounds to binary32 as
everything does that rounds to it. A midpoint is moved to the neighbour on the side where the exact
endpoint lies; where that side is not known, the lane is not decided.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from raycert.cases.model import Difference, Intersection, Tree, Union
from raycert.oracle.batch.lanes import HIT, KNOWN, UNSURE, Floats, Mask, Outcomes


@dataclass(frozen=True, slots=True)
class Lists:
    """The pairs of all lanes in order, the lane of each, and which lanes are not decided."""

    lane: NDArray[np.intp]
    enter: Floats
    leave: Floats
    open: Mask


def combine(tree: Tree, parts: list[Lists]) -> Lists:
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
    """Return after which events a lane is inside: a part's pairs are disjoint, and count 0 or 1."""
    inside: dict[type[Tree], Mask] = {
        Union: first + others > 0,
        Intersection: first + others == parts,
        Difference: (first > 0) & (others == 0),
    }
    return inside[type(tree)]


def set_aside(answer: Outcomes) -> None:
    """Make an answer round to binary32 as the exact endpoints do, or not decided."""
    hit = answer.state == HIT
    for value, side in ((answer.enter, answer.before), (answer.leave, answer.after)):
        value[:], clear = aside(value, side)
        answer.state[hit & ~clear] = UNSURE


def aside(value: Floats, side: Floats) -> tuple[Floats, Mask]:
    """Return values that round to binary32 as endpoints of that side do, and which they are."""
    down, up = np.nextafter(value, -np.inf), np.nextafter(value, np.inf)
    left, right = np.float64(np.float32(down)), np.float64(np.float32(up))
    middle = (left != right) & (0.5 * (left + right) == value)
    moved = np.where(middle & (side == 1), up, np.where(middle & (side == -1), down, value))
    clear = (np.isfinite(right) & (~middle | (side != 0))) | (side == KNOWN)
    return moved, clear | (value == 0) | np.isinf(value)


def narrowed(
    lane: NDArray[np.intp], enter: Floats, leave: Floats
) -> tuple[NDArray[np.intp], Floats, Floats]:
    """Return the lists rounded to binary32, pairs that touch then joined."""
    enter, leave = enter.astype(np.float32).astype(float), leave.astype(np.float32).astype(float)
    apart = (lane[1:] != lane[:-1]) | (enter[1:] > leave[:-1])
    starts, stops = np.append(True, apart)[: len(lane)], np.append(apart, True)[: len(lane)]
    return lane[starts], enter[starts], leave[stops]
