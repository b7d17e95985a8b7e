"""What an interval list says to the one who asks for less: the first hit, or whether there is one.

The lists are sorted and disjoint, as the contract has them: a start inside, or on the boundary,
shows as a first interval that begins at 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isinf
from typing import TypeVar

from raycert.cases.protocol import FromInside

T = TypeVar("T", bound=float)


def first_end(pairs: Sequence[tuple[T, T]], from_inside: FromInside) -> tuple[int, int] | None:
    """Return which end of a list is the first hit, pair and side; None for a miss.

    From inside it is the enter, 0 (`zero`), the leave (`exit`; None if there is none), or a miss
    (`miss`).

    >>> first_end([(0.0, 2.0), (5.0, 6.0)], "exit")
    (0, 1)
    """
    if not pairs:
        return None
    enter, leave = pairs[0]
    if from_inside == "zero" or enter > 0:
        return 0, 0
    return (0, 1) if from_inside == "exit" and not isinf(leave) else None


def first(pairs: Sequence[tuple[T, T]], from_inside: FromInside) -> T | None:
    """Return the t of the first hit, or None for a miss."""
    end = first_end(pairs, from_inside)
    return None if end is None else pairs[end[0]][end[1]]


def hit(pairs: Sequence[tuple[float, float]]) -> bool:
    """Tell whether there is a hit at all; a touch is one.

    >>> hit([(2.0, 2.0)])
    True
    """
    return bool(pairs)
