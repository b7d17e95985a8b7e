"""Sets of t >= 0 as bits, over a finite partition into points and the open gaps between them.

With points 0 = x_0 < x_1 < ... < x_{n-1}, bit 2i is the point x_i and bit 2i + 1 the gap after it;
the last gap has no end. A set of cells is an integer, so the Booleans are those of integers and the
closure is one shift each way: a point belongs to the closure of a gap on either side of it.
"""

from __future__ import annotations

from collections.abc import Callable

from raycert.cases.model import Difference, Intersection, Leaf, Solid, Union

Run = tuple[int, int | None]
"""The indices of the first and the last point of a run of cells; None: it never ends."""


def span(first: int, last: int | None, points: int) -> int:
    """Return the cells of [x_first, x_last], or of [x_first, infinity)."""
    end = 2 * points if last is None else 2 * last + 1
    return (1 << end) - (1 << 2 * first)


def gaps(points: int) -> int:
    """Return all the gaps."""
    return sum(2 << 2 * i for i in range(points))


def closed(cells: int, points: int) -> int:
    """Return the closure within t >= 0."""
    inside = cells & gaps(points)
    return cells | inside >> 1 | inside << 1 & (1 << 2 * points) - 1


def combine(solid: Solid, cells: Callable[[Leaf], int], points: int) -> int:
    """Return the cells of a solid from those of its leaves; every node of the tree is closed."""
    match solid:
        case Union() | Intersection() | Difference():
            first, *others = (combine(part, cells, points) for part in solid.of)
            for other in others:
                match solid:
                    case Union():
                        first |= other
                    case Intersection():
                        first &= other
                    case Difference():
                        first &= ~other
            return closed(first, points)
    return cells(solid)


def runs(cells: int, points: int) -> list[Run]:
    """Return the maximal runs of a closed set, in order.

    Raises `ArithmeticError` for a set that is not closed: a witness that finds one is mistaken.

    >>> runs(span(0, 1, 4) | span(2, 2, 4) | span(3, None, 4), 4)
    [(0, 1), (2, 2), (3, None)]
    """
    if closed(cells, points) != cells:
        raise ArithmeticError(f"{cells:b} over {points} points is not closed")
    found: list[Run] = []
    start = None
    for cell in range(2 * points + 1):
        if cells >> cell & 1:
            start = cell if start is None else start
        elif start is not None:
            found.append((start // 2, None if cell == 2 * points else (cell - 1) // 2))
            start = None
    return found
