"""Where |y + t v|^2 <= rr: one quadratic, solved in six ways, over any arithmetic.

With y from the axis or center to the start of the ray, both vectors square to the axis (barred),
A = v.v, B = v.y, C = y.y - rr:

    textbook      D = B^2 - A C                            t = (-B -+ sqrt D) / A
    seed          D = rr A - |v x y|^2                     as printed in 1 (f)
    q-root        the same D, and t = C / q, q / A         q = -(B +- sqrt D); D is not of this C
    determinant   D = rr A - (y . (v x n))^2               y not barred, n along the axis
    shift         from the closest approach to p in space, then the textbook
    frame         D = (r |v| - |v x y|)(r |v| + |v x y|)   in coordinates across the axis

The first five are what is published; none scales anything. Each returns pairs of the whole line.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from math import inf, sqrt
from typing import Any

from raycert.oracle.zoo.tracer import LINE

Number = Any
Vector = tuple[Number, Number, Number]
Found = list[tuple[Number, Number]]
Curve = Callable[["Arithmetic", Vector, Vector, Number], Found]


@dataclass(frozen=True)
class Arithmetic:
    """Numbers to compute with; `tell` rounds one to a double, `setting` holds while computing."""

    number: Callable[[float], Number] = float
    root: Callable[[Number], Number] = sqrt
    tell: Callable[[Number], float] = float
    setting: Callable[[], AbstractContextManager[Any]] = nullcontext
    infinity: Number = inf


DOUBLES = Arithmetic()


def dot(a: Vector, b: Vector) -> Number:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def minus(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def along(a: Vector, t: Number, b: Vector) -> Vector:
    """Return a + t b."""
    return (a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2])


def ends(ar: Arithmetic, a: Number, b: Number, disc: Number) -> Found:
    """Return (-b -+ sqrt D) / a, nothing for D < 0."""
    if disc < 0:
        return []
    half = ar.root(disc)
    return [((-b - half) / a, (-b + half) / a)]


def textbook(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    """Solve by B^2 - A C."""
    a, b, c = dot(v, v), dot(v, y), dot(y, y) - rr
    if a == 0:
        return LINE if c <= 0 else []
    return ends(ar, a, b, b * b - a * c)


def seed(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    """Solve by the seed's formula of Problem 1 (f)."""
    a, b, vy = dot(v, v), dot(v, y), cross(v, y)
    if a == 0:
        return LINE if rr >= dot(y, y) else []
    return ends(ar, a, b, rr * a - dot(vy, vy))


def q_root(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    """Solve by C / q and q / A, with the seed's D."""
    a, b, c, vy = dot(v, v), dot(v, y), dot(y, y) - rr, cross(v, y)
    if a == 0:
        return LINE if c <= 0 else []
    disc = rr * a - dot(vy, vy)
    if disc < 0:
        return []
    half = ar.root(disc)
    q = -(b + half) if b > 0 else half - b
    if q == 0:
        return [(q, q)]
    return [(q / a, c / q)] if b > 0 else [(c / q, q / a)]


def frame(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    """Solve by the product of r |v| -+ |v x y|, which does not cancel."""
    a, vy = dot(v, v), cross(v, y)
    if a == 0:
        return LINE if dot(y, y) <= rr else []
    reach, offset = ar.root(rr * a), ar.root(dot(vy, vy))
    return ends(ar, a, dot(v, y), (reach - offset) * (reach + offset))
