"""Solids and points for scenarios, from dice, by + - * / and square roots only.

Those are correctly rounded everywhere, so that a seed gives the same numbers on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Ray, Vector


def real(dice: Dice, low: float = -1.0, high: float = 1.0) -> float:
    """Return a number between two."""
    return dice.real(BINARY64, low, high)


def plus(a: Vector, *terms: tuple[float, Vector]) -> Vector:
    """Return a + k b + ..."""
    x, y, z = a
    for k, b in terms:
        x, y, z = x + k * b[0], y + k * b[1], z + k * b[2]
    return (x, y, z)


def times(k: float, a: Vector) -> Vector:
    """Return k a."""
    return (k * a[0], k * a[1], k * a[2])


def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def unit(a: Vector) -> Vector:
    """Return a / |a|."""
    return times(1 / sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]), a)


def heading(dice: Dice) -> Vector:
    """Return a direction, none preferred."""
    while True:
        a = dice.vector(BINARY64)
        if 0.01 < a[0] * a[0] + a[1] * a[1] + a[2] * a[2] < 1:
            return unit(a)


def spoke(dice: Dice) -> tuple[float, float]:
    """Return a direction of the plane."""
    while True:
        x, y = real(dice), real(dice)
        if 0.01 < x * x + y * y < 1:
            length = sqrt(x * x + y * y)
            return x / length, y / length


@dataclass(frozen=True)
class Can:
    """A capped cylinder, and a frame of its own: n along the axis, e and f across."""

    solid: Cylinder
    n: Vector
    e: Vector
    f: Vector
    height: float

    @classmethod
    def of(cls, dice: Dice, radius: float, height: float) -> Can:
        """Return one somewhere near the origin, any way up."""
        p, n = dice.vector(BINARY64, -1, 1), heading(dice)
        e = unit(cross(n, (0.0, 0.0, 1.0) if abs(n[2]) < 0.7 else (1.0, 0.0, 0.0)))
        solid = Cylinder(p, plus(p, (height, n)), radius)
        return cls(solid, n, e, cross(n, e), height)

    def point(self, rise: float, across: float, way: tuple[float, float]) -> Vector:
        """Return the point at a share of the height, so many radii from the axis, some way."""
        r = across * self.solid.radius
        return plus(self.solid.p, (rise * self.height, self.n), (r, self.outward(way)))

    def outward(self, way: tuple[float, float]) -> Vector:
        """Return the direction across the axis that a way names."""
        return plus((0.0, 0.0, 0.0), (way[0], self.e), (way[1], self.f))


def towards(start: Vector, target: Vector, pace: float) -> Ray:
    """Return the ray that is at the target at t = 1 / pace."""
    return Ray(start, times(pace, plus(target, (-1.0, start))))
