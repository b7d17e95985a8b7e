"""A scene in integers: every length a multiple of one power of two, every direction of another.

Binary64 numbers are dyadic, so the coarsest such grid exists; `refine` makes it finer by so many
bits. With lengths in units of 2^L and the direction in units of 2^T, the ray's parameter is in
units of 2^(L - T): `surd` puts that power back, so that endpoints stand for themselves.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from cases.model import HalfSpace, Leaf, Ray, Slab, Solid, Sphere, Vector, leaves
from oracle.surd import Surd

IntVector = tuple[int, int, int]


def dot(a: IntVector, b: IntVector) -> int:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: IntVector, b: IntVector) -> IntVector:
    """Return a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def sub(a: IntVector, b: IntVector) -> IntVector:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def fraction_bits(numbers: Iterable[float]) -> int:
    """Return the least n >= 0 for which every number is a multiple of 2^-n."""
    return max(x.as_integer_ratio()[1].bit_length() - 1 for x in numbers)


def integer(x: float, bits: int) -> int:
    """Return x * 2^bits, an integer."""
    numerator, denominator = x.as_integer_ratio()
    return numerator << bits - denominator.bit_length() + 1


def integers(v: Vector, bits: int) -> IntVector:
    """Return v * 2^bits, in integers."""
    return (integer(v[0], bits), integer(v[1], bits), integer(v[2], bits))


def lengths(leaf: Leaf) -> tuple[float, ...]:
    """Return the numbers of a leaf that are lengths; a half-space's normal is none."""
    match leaf:
        case HalfSpace():
            return leaf.point
        case Sphere():
            return (*leaf.center, leaf.radius)
        case Slab():
            return (*leaf.p, *leaf.q)
    return (*leaf.p, *leaf.q, leaf.radius)


@dataclass(frozen=True, slots=True)
class Grid:
    """Units of 2^-length for lengths, 2^-speed for the direction; u and v are the ray in them."""

    length: int
    speed: int
    u: IntVector
    v: IntVector

    @classmethod
    def of(cls, solid: Solid, ray: Ray, refine: int = 0, also: Iterable[float] = ()) -> Grid:
        """Return the coarsest grid that holds the scene and the lengths `also`, made finer."""
        numbers = [x for _, leaf in leaves(solid) for x in lengths(leaf)]
        length = fraction_bits((*numbers, *ray.origin, *also)) + refine
        speed = fraction_bits(ray.direction) + refine
        return cls(length, speed, integers(ray.origin, length), integers(ray.direction, speed))

    def point(self, x: Vector) -> IntVector:
        """Return a point in the grid's units."""
        return integers(x, self.length)

    def scalar(self, x: float) -> int:
        """Return a length in the grid's units."""
        return integer(x, self.length)

    def surd(self, x: int, y: int, d: int, z: int) -> Surd:
        """Return (x + y sqrt(d)) / z in the grid's unit of t, as a number; z != 0."""
        if z < 0:
            x, y, z = -x, -y, -z
        shift = self.speed - self.length
        return Surd(x << shift, y << shift, d, z) if shift > 0 else Surd(x, y, d, z << -shift)

    def ratio(self, numerator: int, denominator: int) -> Surd:
        """Return numerator / denominator in the grid's unit of t, as a number."""
        return self.surd(numerator, 0, 0, denominator)


def normal(v: Vector) -> IntVector:
    """Return v in integers, in a unit of its own: only the direction of a normal matters."""
    return integers(v, fraction_bits(v))
