"""Steps in the units of the question: no scaling, a normalised axis, coefficients of a quadratic.

Faults with an absolute threshold are planted on these.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from raycert.cases.model import Ray, Solid, Tree, Vector
from raycert.oracle.zoo.lists import LINE, Pairs
from raycert.oracle.zoo.numbers import dot, minus, norm, root, times
from raycert.oracle.zoo.tracer import Sight, Tracer

Chord = Callable[[Vector, Vector, float], Pairs]


def unscaled(*_: float) -> int:
    """Return the exponent 0: nothing is scaled."""
    return 0


def unit(w: Vector) -> Vector:
    """Return w / |w|."""
    return times(1 / norm(w), w)


def projected(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the wall: y and v less their parts along the axis."""
    n = unit(s.w)
    y, v = minus(s.y, times(dot(s.y, n), n)), minus(s.v, times(dot(s.v, n), n))
    return self.chord(y, v, s.r)


PLAIN: dict[str, Any] = {"scale": unscaled, "wall": projected}
"""The steps of a tracer whose numbers are those of the question."""


def roots(a: float, b: float, c: float) -> Pairs:
    """Return where a t^2 + 2 b t + c <= 0, by the discriminant b^2 - a c."""
    if a == 0:
        return LINE if c <= 0 else []
    disc = b * b - a * c
    if disc < 0:
        return []
    half = root(disc)
    return [((-b - half) / a, (-b + half) / a)]


def coefficients(y: Vector, v: Vector, r: float) -> tuple[float, float, float]:
    """Return v.v, v.y and y.y - r^2."""
    return dot(v, v), dot(v, y), dot(y, y) - r * r


def discriminant(y: Vector, v: Vector, r: float) -> Pairs:
    """Return where |y + t v| <= r, by the textbook."""
    return roots(*coefficients(y, v, r))


def quadratic(solve: Callable[[float, float, float], Pairs]) -> Chord:
    """Return the chord that a way to solve a t^2 + 2 b t + c = 0, with a > 0, gives."""

    def chord(y: Vector, v: Vector, r: float) -> Pairs:
        a, b, c = coefficients(y, v, r)
        if a == 0:
            return LINE if c <= 0 else []
        return solve(a, b, c)

    return chord


def each_leaf(change: Callable[[Any], Any]) -> Callable[[Solid, Ray], tuple[Solid, Ray]]:
    """Return the step that reads every leaf of a solid otherwise."""

    def changed(solid: Solid) -> Solid:
        if isinstance(solid, Tree):
            return replace(solid, of=tuple(changed(part) for part in solid.of))
        read: Solid = change(solid)
        return read

    return lambda solid, ray: (changed(solid), ray)
