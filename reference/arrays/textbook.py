"""Problem 1 as schoolbooks have it: b^2 - a c in plain doubles. To see what it loses.

The discriminant is the difference of two squares that are large where the start is far away: at a
distance of D radii only u D^2 of it is right, and from D = 1e8 on nothing is.
"""

from __future__ import annotations

import numpy as np

from raycert.reference.arrays.lists import Lists
from raycert.reference.arrays.quadratic import How, Line, Start
from raycert.reference.arrays.vectors import dot


def textbook_chord(start: Start, line: Line, how: How, lanes: int) -> Lists:
    """Return the interval of t >= 0 for which |y + t v| <= r, by the schoolbook's formula.

    It takes no shortcut, whatever `how` allows.
    """
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
