"""What SymPy derives from the definitions: each condition along the ray, a polynomial in t.

The distance to an axis is found by minimisation, as in the seed's 1 (a), and not written down.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

from sympy import Expr, Integer, Poly, cancel, diff, expand, solve, symbols, together


@dataclass(frozen=True, slots=True)
class Vec:
    """A vector of three expressions."""

    x: Any
    y: Any
    z: Any

    def __add__(self, other: Vec) -> Vec:
        """Return the sum."""
        return Vec(self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other: Vec) -> Vec:
        """Return the difference."""
        return Vec(self.x - other.x, self.y - other.y, self.z - other.z)

    def __neg__(self) -> Vec:
        """Return the negative."""
        return Vec(-self.x, -self.y, -self.z)

    def __rmul__(self, factor: Any) -> Vec:
        """Return a multiple."""
        return Vec(factor * self.x, factor * self.y, factor * self.z)

    def __matmul__(self, other: Vec) -> Any:
        """Return the scalar product."""
        return self.x * other.x + self.y * other.y + self.z * other.z

    def __xor__(self, other: Vec) -> Vec:
        """Return the vector product."""
        return Vec(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )

    @property
    def parts(self) -> tuple[Any, Any, Any]:
        """Return the three expressions."""
        return self.x, self.y, self.z

    @classmethod
    def named(cls, name: str) -> Vec:
        """Return a vector of three symbols."""
        return cls(*symbols(f"{name}1:4", real=True))


T, S_AXIS, RADIUS = symbols("t s r", real=True)


def distance_squared(x: Vec, p: Vec, w: Vec) -> Expr:
    """Return the least squared distance of x from a point p + s w of the line, by minimisation."""
    away = p + S_AXIS * w - x
    square = away @ away
    (nearest,) = solve(diff(square, S_AXIS), S_AXIS)
    return together(square.subs(S_AXIS, nearest))


@cache
def rod() -> Poly:
    """Return |w|^2 (d^2 - r^2) along the ray, in t: derived, not written down."""
    y, v, w = (Vec.named(name) for name in "yvw")
    origin = Vec(*(Integer(0),) * 3)
    condition = (w @ w) * (distance_squared(y + T * v, origin, w) - RADIUS**2)
    return Poly(cancel(condition), T)


@cache
def globe() -> Poly:
    """Return |x - center|^2 - r^2 along the ray, in t, with y for u - center."""
    x = Vec.named("y") + T * Vec.named("v")
    return Poly(expand(x @ x - RADIUS**2), T)


@cache
def plane() -> Poly:
    """Return (x - point) . w along the ray, in t, with y for u - point."""
    return Poly(expand((Vec.named("y") + T * Vec.named("v")) @ Vec.named("w")), T)
