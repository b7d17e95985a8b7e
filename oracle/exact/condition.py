"""Condition numbers of endpoints: how far a relative error in the inputs moves the answer.

An endpoint t solves F(x, t) = 0 for the numbers x of ray and leaf. If each x_i moves by at most
e |x_i|, then t moves, to first order, by at most kappa e |t| with the componentwise relative
condition number

    kappa = sum_i |x_i dF/dx_i| / (|dF/dt| |t|).

All of it lies in the field of t, so kappa is exact and its ceil(log2) is decided in integers.

With y = u - p, w = q - p, W = |w|^2, P = y + t v and rho = W P - (P.w) w, for the infinite cylinder
F = |P|^2 W - (P.w)^2 - r^2 W:

    dF/du = 2 rho            dF/dv = 2 t rho          dF/dt = 2 v.rho
    dF/dq = 2 |P|^2 w - 2 (P.w) P - 2 r^2 w           dF/dr = -2 r W
    dF/dp = -dF/du - dF/dq

for the sphere F = |P|^2 - r^2 with P = u - center + t v, and for a plane F = P.n.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    leaves,
)
from raycert.cases.vectors import dot, minus
from raycert.oracle.exact.faces import on_faces
from raycert.oracle.exact.grid import Grid, IntVector, normal
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, exponent, fraction, sign_1


@dataclass(frozen=True, slots=True)
class Element:
    """a + b sqrt(d) in one fixed quadratic field."""

    a: int
    b: int
    d: int

    def __add__(self, other: Element) -> Element:
        return Element(self.a + other.a, self.b + other.b, self.d)

    def __mul__(self, other: Element | int) -> Element:
        if isinstance(other, int):
            return Element(self.a * other, self.b * other, self.d)
        return Element(
            self.a * other.a + self.b * other.b * self.d,
            self.a * other.b + self.b * other.a,
            self.d,
        )

    def __neg__(self) -> Element:
        return Element(-self.a, -self.b, self.d)

    def __sub__(self, other: Element) -> Element:
        return self + -other

    def sign(self) -> int:
        return sign_1(self.a, self.b, self.d)

    def __abs__(self) -> Element:
        return -self if self.sign() < 0 else self

    def __truediv__(self, other: Element) -> Surd:
        """Return the quotient as a number; other != 0, and d is no square unless b = 0."""
        top = self * Element(other.a, -other.b, other.d)
        bottom = other.a * other.a - other.b * other.b * other.d
        flip = 1 if bottom > 0 else -1
        return Surd(flip * top.a, flip * top.b, self.d, flip * bottom)


Elements = tuple[Element, Element, Element]


def inner(a: Elements, b: IntVector) -> Element:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@dataclass(frozen=True, slots=True)
class At:
    """The ray at one endpoint t = top / z, in the grid's units: f(t) = u + (top / z) v."""

    grid: Grid
    top: Element
    z: int

    @classmethod
    def of(cls, t: Surd, grid: Grid) -> At:
        """Return the place of a finite endpoint."""
        shift = grid.length - grid.speed
        up, down = 1 << max(shift, 0), 1 << max(-shift, 0)
        value = t.rational()
        if value is None:
            return cls(grid, Element(t.x * up, t.y * up, t.d), t.z * down)
        return cls(grid, Element(value.numerator * up, 0, 0), value.denominator * down)

    def constant(self, n: int) -> Element:
        return Element(n, 0, self.top.d)

    def from_point(self, x: IntVector) -> Elements:
        """Return z (f(t) - x)."""
        away = zip(minus(self.grid.u, x), self.grid.v, strict=True)
        a, b, c = (self.constant(y * self.z) + self.top * v for y, v in away)
        return (a, b, c)

    def ray_terms(self, gradient: Elements) -> Iterator[Element]:
        """Yield |u_i dF/du_i| and |v_i dF/dv_i|, times z: dF/dv = t dF/du."""
        for u, v, g in zip(self.grid.u, self.grid.v, gradient, strict=True):
            yield abs(g * u) * self.z
            yield abs(self.top * g * v)

    def kappa(self, gradient: Elements, others: Iterator[Element]) -> Surd:
        """Return the condition number from dF/du and the terms of the leaf's own numbers."""
        total = sum((*self.ray_terms(gradient), *others), self.constant(0))
        slope = abs(self.top * inner(gradient, self.grid.v))
        return total / slope if slope.sign() else INFINITY


def _products(x: IntVector, gradient: Elements) -> Iterator[Element]:
    return (abs(g * n) for n, g in zip(x, gradient, strict=True))


def _wall(leaf: InfiniteCylinder | Cylinder, at: At) -> Surd:
    """Return kappa on the infinite cylinder; everything halved and times z^2."""
    grid, z = at.grid, at.z
    p, q, r = grid.point(leaf.p), grid.point(leaf.q), grid.scalar(leaf.radius)
    w = minus(q, p)
    square = dot(w, w)
    x = at.from_point(p)
    axial = inner(x, w)
    rho = (x[0] * square - axial * w[0], x[1] * square - axial * w[1], x[2] * square - axial * w[2])
    bulk = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - at.constant(r * r * z * z)
    dq = (bulk * w[0] - axial * x[0], bulk * w[1] - axial * x[1], bulk * w[2] - axial * x[2])
    dp = (-(rho[0] * z + dq[0]), -(rho[1] * z + dq[1]), -(rho[2] * z + dq[2]))
    dr = at.constant(r * r * square * z * z)
    return at.kappa(rho, iter((*_products(q, dq), *_products(p, dp), dr)))


def _ball(leaf: Sphere, at: At) -> Surd:
    """Return kappa on a sphere; everything halved and times z^2."""
    center, r = at.grid.point(leaf.center), at.grid.scalar(leaf.radius)
    x = at.from_point(center)
    dr = at.constant(r * r * at.z * at.z)
    return at.kappa(x, iter((*(t * at.z for t in _products(center, x)), dr)))


def _plane(at: At, n: IntVector, others: Iterator[Element]) -> Surd:
    """Return kappa on a plane with normal n; everything times z."""
    return at.kappa((at.constant(n[0]), at.constant(n[1]), at.constant(n[2])), others)


def _half_space(leaf: HalfSpace, at: At) -> Surd:
    point, n = at.grid.point(leaf.point), normal(leaf.normal)
    x = at.from_point(point)
    shift = (abs(at.constant(a * b * at.z)) for a, b in zip(point, n, strict=True))
    return _plane(at, n, iter((*shift, *_products(n, x))))


def _cap(leaf: Slab | Cylinder, at: At, base: IntVector, far: IntVector) -> Surd:
    """Return kappa on the cap through `base`: F = (f(t) - base).(far - base)."""
    n = minus(far, base)
    x = at.from_point(base)
    back = tuple(-(e + at.constant(m * at.z)) for e, m in zip(x, n, strict=True))
    return _plane(at, n, iter((*_products(far, x), *_products(base, (back[0], back[1], back[2])))))


def face_kappa(leaf: Leaf, face: str, at: At) -> Surd:
    """Return the condition number of an endpoint on one face of a leaf; infinite if double."""
    match leaf:
        case HalfSpace():
            return _half_space(leaf, at)
        case Sphere():
            return _ball(leaf, at)
        case InfiniteCylinder():
            return _wall(leaf, at)
    p, q = at.grid.point(leaf.p), at.grid.point(leaf.q)
    if face == "cap_p":
        return _cap(leaf, at, p, q)
    if face == "cap_q":
        return _cap(leaf, at, q, p)
    assert isinstance(leaf, Cylinder)
    return _wall(leaf, at)


def kappa(t: Surd, solid: Solid, ray: Ray) -> Surd:
    """Return the condition number of an endpoint of the exact list, the worst of its faces.

    Infinite on a double root and for t = 0. An endpoint on no face (t = 0 inside, infinity) is
    given exactly, whatever the inputs: 0.
    """
    worst = ZERO
    if not t.finite:
        return worst
    grid = Grid.of(solid, ray)
    at = At.of(t, grid)
    for _, leaf in leaves(solid):
        for surface in on_faces(leaf, t, grid):
            worst = max(worst, face_kappa(leaf, surface.face, at))
    return worst


def ceil_log2(v: Surd) -> int:
    """Return the least integer n with v <= 2^n, v finite and > 0."""
    n = exponent(v) - 3
    while v > fraction(1 << max(n, 0), 1 << max(-n, 0)):
        n += 1
    return n


def condition(intervals: Intervals, solid: Solid, ray: Ray) -> int | None:
    """Return ceil(log2) of the worst condition number of the endpoints with 0 < t < infinity.

    None where there is none, or where it is infinite.
    """
    ends = [t for interval in intervals for t in interval if t.finite and t.sign()]
    worst = max((kappa(t, solid, ray) for t in ends), default=INFINITY)
    return ceil_log2(worst) if worst.finite and worst.sign() else None
