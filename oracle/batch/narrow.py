"""From certainly rounded doubles to binary32, without rounding twice.

A double that is no midpoint of two binary32 rounds to binary32 as everything does that rounds to
it. A midpoint is moved to the neighbour on the side where the exact endpoint lies; where that side
is not known, the lane is not decided.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.lanes import HIT, KNOWN, UNSURE, Floats, Found, Mask


def set_aside(found: Found) -> None:
    """Make what is found round to binary32 as the exact endpoints do, or not decided."""
    hit = found.state == HIT
    for value, side in ((found.enter, found.before), (found.leave, found.after)):
        value[:], clear = aside(value, side)
        found.state[hit & ~clear] = UNSURE


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
