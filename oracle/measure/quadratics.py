"""Where |y + t v|^2 <= rr: one quadratic, solved in six ways, over any arithmetic.

With y from the axis or center to the start of the ray, both vectors square to the axis (barred),
A = v.v, B = v.y, C = y.y - rr:

    textbook      D = B^2 - A C                            t = (-B -+ sqrt D) / A
    seed          D = rr A - |v x y|^2                     Problem 1 (f), as printed
    q-root        the same D, and t = C / q, q / A         q = -(B +- sqrt D); D is not of this C
    determinant   D = rr A - (y . (v x n))^2               y not barred, n along the axis
    shift         from the closest approach to p in space, then the textbook
    frame         D = (r |v| - |v x y|)(r |v| + |v x y|)   in coordinates across the axis

The first five are what is published; none scales anything. A curve returns pairs of the whole line.
A wall brings the cylinder to a curve: square to the unit axis, times |w| without a root, in a
frame, by a determinant, or after a shift in space. Trees are left to the algebra of lists.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from math import inf, sqrt
from typing import Any

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
)
from raycert.cases.vectors import along, cross, dot, minus
from raycert.oracle.measure.way import FAILURES, Answered, Case, answered
from raycert.oracle.zoo.tracer import LINE, common, share, subtract, unite

Number = Any
Vector = tuple[Number, Number, Number]
Found = list[tuple[Number, Number]]
Curve = Callable[["Arithmetic", Vector, Vector, Number], Found]
Wall = Callable[["Arithmetic", Curve, Vector, Vector, Vector, Number], Found]
COMBINE: dict[type[Tree], Callable[[list[Found]], Found]] = {
    Union: unite,
    Intersection: share,
    Difference: subtract,
}


@dataclass(frozen=True)
class Arithmetic:
    """Numbers to compute with; `tell` rounds one to a double, `setting` holds while computing."""

    number: Callable[[float], Number] = float
    root: Callable[[Number], Number] = sqrt
    tell: Callable[[Number], float] = float
    setting: Callable[[], AbstractContextManager[Any]] = nullcontext
    infinity: Number = inf


DOUBLES = Arithmetic()


# Curves.


def ends(ar: Arithmetic, a: Number, b: Number, disc: Number) -> Found:
    """Return (-b -+ sqrt D) / a, nothing for D < 0."""
    if disc < 0:
        return []
    half = ar.root(disc)
    return [((-b - half) / a, (-b + half) / a)]


def textbook(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    a, b, c = dot(v, v), dot(v, y), dot(y, y) - rr
    if a == 0:
        return LINE if c <= 0 else []
    return ends(ar, a, b, b * b - a * c)


def printed(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    a, b, vy = dot(v, v), dot(v, y), cross(v, y)
    if a == 0:
        return LINE if rr >= dot(y, y) else []
    return ends(ar, a, b, rr * a - dot(vy, vy))


def q_root(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    """Solve by C / q and q / A, with the D of Problem 1 (f)."""
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


# Walls.


def by_unit(ar: Arithmetic, w: Vector) -> Vector:
    """Return w / |w|, as Problem 1 has it."""
    length = ar.root(dot(w, w))
    return (w[0] / length, w[1] / length, w[2] / length)


def square(ar: Arithmetic, curve: Curve, y: Vector, v: Vector, w: Vector, r: Number) -> Found:
    """Return where the ray is in the wall: vectors crossed with the unit axis."""
    n = by_unit(ar, w)
    return curve(ar, cross(y, n), cross(v, n), r * r)


def rootless(ar: Arithmetic, curve: Curve, y: Vector, v: Vector, w: Vector, r: Number) -> Found:
    """Return the same with every length times |w|, so that the axis needs no root."""
    return curve(ar, cross(y, w), cross(v, w), r * r * dot(w, w))


def framed(ar: Arithmetic, curve: Curve, y: Vector, v: Vector, w: Vector, r: Number) -> Found:
    """Return the same in a frame whose third axis is that of the solid."""
    n, zero = by_unit(ar, w), ar.number(0.0)
    least = min(range(3), key=lambda i: abs(n[i]))
    unit = [zero, zero, zero]
    unit[least] = ar.number(1.0)
    e = by_unit(ar, cross(n, (unit[0], unit[1], unit[2])))
    f = cross(n, e)
    return curve(ar, (dot(y, e), dot(y, f), zero), (dot(v, e), dot(v, f), zero), r * r)


def determinant(ar: Arithmetic, curve: Curve, y: Vector, v: Vector, w: Vector, r: Number) -> Found:
    """Return the same with D = r^2 A - (y . (v x n))^2."""
    n = by_unit(ar, w)
    vn, yn = cross(v, n), cross(y, n)
    a, det = dot(vn, vn), dot(y, vn)
    if a == 0:
        return LINE if dot(yn, yn) <= r * r else []
    return ends(ar, a, dot(vn, yn), r * r * a - det * det)


def shifted(ar: Arithmetic, curve: Curve, y: Vector, v: Vector, w: Vector, r: Number) -> Found:
    """Return the same from the closest approach to p in space."""
    n = by_unit(ar, w)
    return _from_nearest(y, v, lambda near: curve(ar, cross(near, n), cross(v, n), r * r))


def shifted_ball(ar: Arithmetic, y: Vector, v: Vector, rr: Number) -> Found:
    """Return where the ray is in a ball, from the closest approach to its center."""
    return _from_nearest(y, v, lambda near: textbook(ar, near, v, rr))


def _from_nearest(y: Vector, v: Vector, solve: Callable[[Vector], Found]) -> Found:
    a = dot(v, v)
    if a == 0:
        return solve(y)
    t = -dot(v, y) / a
    return [(a + t, b + t) for a, b in solve(along(y, t, v))]


@dataclass(frozen=True)
class Formula:
    """How the wall of a cylinder and a ball are solved; called with cases, a `solve`."""

    curve: Curve
    wall: Wall = square
    ball: Curve | None = None
    arithmetic: Arithmetic = DOUBLES

    def __call__(self, cases: Sequence[Case]) -> list[Answered]:
        with self.arithmetic.setting():
            return [self.answer(case) for case in cases]

    def answer(self, case: Case) -> Answered:
        tell = self.arithmetic.tell
        try:
            return answered((tell(a), tell(b)) for a, b in self.node(case.solid, case.ray))
        except FAILURES:
            return None

    def node(self, solid: Solid, ray: Ray) -> Found:
        """Return the list of a solid or of a part of it, in numbers of the arithmetic."""
        if isinstance(solid, Tree):
            return COMBINE[type(solid)]([self.node(part, ray) for part in solid.of])
        ar = self.arithmetic
        line = self._leaf(solid, self._vector(ray.origin), self._vector(ray.direction))
        if any(a != a or b != b for a, b in line):
            raise ArithmeticError("NaN")
        return common(line, [(ar.number(0.0), ar.infinity)])

    def _leaf(self, solid: Solid, u: Vector, v: Vector) -> Found:
        ar = self.arithmetic
        match solid:
            case HalfSpace(point, normal):
                return self._plane(minus(u, self._vector(point)), v, self._vector(normal))
            case Sphere(center, radius):
                ball, r = self.ball or self.curve, ar.number(radius)
                return ball(ar, minus(u, self._vector(center)), v, r * r)
        assert isinstance(solid, Slab | InfiniteCylinder | Cylinder)
        p, q = self._vector(solid.p), self._vector(solid.q)
        y, w, parts = minus(u, p), minus(q, p), []
        if not isinstance(solid, Slab):
            parts.append(self.wall(ar, self.curve, y, v, w, ar.number(solid.radius)))
        if not isinstance(solid, InfiniteCylinder):
            back = (-w[0], -w[1], -w[2])
            parts += [self._plane(y, v, back), self._plane(minus(u, q), v, w)]
        return share(parts)

    def _plane(self, y: Vector, v: Vector, n: Vector) -> Found:
        """Return where (y + t v) . n <= 0; quotients need no unit normal."""
        height, climb, end = dot(y, n), dot(v, n), self.arithmetic.infinity
        if climb == 0:
            return [(-end, end)] if height <= 0 else []
        t = -height / climb
        return [(-end, t)] if climb > 0 else [(t, end)]

    def _vector(self, a: tuple[float, float, float]) -> Vector:
        number = self.arithmetic.number
        return (number(a[0]), number(a[1]), number(a[2]))
