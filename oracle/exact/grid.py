"""A scene in integers: every length a multiple of one power of two, every direction of another.

Binary64 numbers are dyadic, so the coarsest such grid exists; `refine` makes it finer by so many
bits. With lengths in units of 2^L and the direction in units of 2^T, the ray's parameter is in
units of 2^(L - T): `surd` puts that power back, so that endpoints stand for themselves.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from raycert.cases.model import Ray, Solid, Vector, leaves, lengths
from raycert.oracle.exact.surd import Surd

IntVector = tuple[int, int, int]


def dyadics(numbers: Iterable[float], refine: int = 0) -> tuple[int, dict[float, int]]:
    """Return the least n >= 0 for which 2^n makes every number an integer, and those integers.

    With `refine`, n is that much larger.

    >>> dyadics((0.75, 2.0))
    (2, {0.75: 3, 2.0: 8})
    """
    ratios = {x: x.as_integer_ratio() for x in numbers}
    bits = max([ratio[1] for ratio in ratios.values()]).bit_length() + refine
    return bits - 1, {x: n << bits - d.bit_length() for x, (n, d) in ratios.items()}


class Grid(NamedTuple):
    """Units of 2^-length for lengths, 2^-speed for the direction; u and v are the ray in them.

    `integers` has each length of the scene in the grid's unit, so that what serves several faces
    is converted once.
    """

    length: int
    speed: int
    u: IntVector
    v: IntVector
    integers: dict[float, int]

    @classmethod
    def of(cls, solid: Solid, ray: Ray, refine: int = 0, also: Iterable[float] = ()) -> Grid:
        """Return the coarsest grid that holds the scene and the lengths `also`, made finer."""
        numbers = [*ray.origin, *also]
        for _, leaf in leaves(solid):
            numbers += lengths(leaf)
        length, integers = dyadics(numbers, refine)
        speed, parts = dyadics(ray.direction, refine)
        (a, b, c), (d, e, f) = ray.origin, ray.direction
        u, v = (integers[a], integers[b], integers[c]), (parts[d], parts[e], parts[f])
        return cls(length, speed, u, v, integers)

    def point(self, x: Vector) -> IntVector:
        """Return a point of the scene in the grid's units."""
        return (self.integers[x[0]], self.integers[x[1]], self.integers[x[2]])

    def scalar(self, x: float) -> int:
        """Return a length of the scene in the grid's units."""
        return self.integers[x]

    def surd(self, x: int, y: int, d: int, z: int) -> Surd:
        """Return (x + y sqrt(d)) / z in the grid's unit of t, as a number; z != 0."""
        if z < 0:
            x, y, z = -x, -y, -z
        shift = self.speed - self.length
        return Surd(x << shift, y << shift, d, z) if shift > 0 else Surd(x, y, d, z << -shift)

    def parameter(self, t: float) -> tuple[int, int]:
        """Return t, finite, as a fraction in the grid's unit of t."""
        n, m = t.as_integer_ratio()
        shift = self.length - self.speed
        return (n << shift, m) if shift > 0 else (n, m << -shift)

    def ratio(self, numerator: int, denominator: int) -> Surd:
        """Return numerator / denominator in the grid's unit of t, as a number."""
        return self.surd(numerator, 0, 0, denominator)


def normal(v: Vector) -> IntVector:
    """Return v in integers, in a unit of its own: only the direction of a normal matters."""
    _, parts = dyadics(v)
    return (parts[v[0]], parts[v[1]], parts[v[2]])
