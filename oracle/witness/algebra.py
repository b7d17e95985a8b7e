"""What the witnesses share: vectors over any numbers, and sets of t >= 0 as bits.

The bits stand for a finite partition into points and the open gaps between them. With points
0 = x_0 < x_1 < ... < x_{n-1}, bit 2i is the point x_i and bit 2i + 1 the gap after it; the last gap
has no end. A set of cells is an integer, so the Booleans are those of integers and the closure is
one shift each way: a point belongs to the closure of a gap on either side of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import and_, or_
from typing import Any, Self, TypeVar

from raycert.cases.model import Difference, Leaf, Solid, Union, Vector, parts

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Vec:
    """Three numbers of one kind: fractions, enclosures, expressions. `@` is a . b, `^` a x b."""

    x: Any
    y: Any
    z: Any

    @classmethod
    def of(cls, vector: Vector, number: Callable[[float], Any]) -> Self:
        """Return a vector of the model in numbers of a kind."""
        return cls(*map(number, vector))

    def __add__(self, other: Vec) -> Vec:
        return Vec(self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other: Vec) -> Vec:
        return Vec(self.x - other.x, self.y - other.y, self.z - other.z)

    def __neg__(self) -> Vec:
        return Vec(-self.x, -self.y, -self.z)

    def __rmul__(self, factor: Any) -> Vec:
        return Vec(factor * self.x, factor * self.y, factor * self.z)

    def __truediv__(self, divisor: Any) -> Vec:
        return Vec(self.x / divisor, self.y / divisor, self.z / divisor)

    def __matmul__(self, other: Vec) -> Any:
        return self.x * other.x + self.y * other.y + self.z * other.z

    def __xor__(self, other: Vec) -> Vec:
        return Vec(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )

    @property
    def parts(self) -> tuple[Any, Any, Any]:
        return self.x, self.y, self.z


def span(first: int, last: int | None, points: int) -> int:
    """Return the cells of [x_first, x_last], or of [x_first, infinity)."""
    end = 2 * points if last is None else 2 * last + 1
    return (1 << end) - (1 << 2 * first)


def gaps(points: int) -> int:
    return sum(2 << 2 * i for i in range(points))


def closed(cells: int, points: int) -> int:
    """Return the closure within t >= 0."""
    inside = cells & gaps(points)
    return cells | inside >> 1 | inside << 1 & (1 << 2 * points) - 1


def combine(solid: Solid, cells: Callable[[Leaf], int], points: int) -> int:
    """Return the cells of a solid from those of its leaves; every node of the tree is closed."""
    if not parts(solid):
        return cells(solid)  # type: ignore[arg-type]
    first, *others = (combine(part, cells, points) for part in parts(solid))
    if isinstance(solid, Difference):
        return closed(first & ~reduce(or_, others, 0), points)
    return closed(reduce(or_ if isinstance(solid, Union) else and_, others, first), points)


def runs(cells: int, points: Sequence[T]) -> list[tuple[T, T | None]]:
    """Return the maximal runs of a closed set, in order: first and last point, None for no end.

    Raises `ArithmeticError` for a set that is not closed: a witness that finds one is mistaken.

    >>> runs(span(0, 1, 4) | span(2, 2, 4) | span(3, None, 4), "abcd")
    [('a', 'b'), ('c', 'c'), ('d', None)]
    """
    if closed(cells, len(points)) != cells:
        raise ArithmeticError(f"{cells:b} over {len(points)} points is not closed")
    found: list[tuple[T, T | None]] = []
    for i, point in enumerate(points):
        if cells >> 2 * i & 1:
            if not (i and cells >> 2 * i - 1 & 1):
                found.append((point, point))
            ends = not cells >> 2 * i + 1 & 1
            found[-1] = (found[-1][0], point if ends else None)
    return found
