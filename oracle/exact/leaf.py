"""Each leaf as conditions on t, in integers.

A curved face is a t^2 + 2 b t + c <= 0, a plane c + b t <= 0.
With y = u - p, w = q - p and W = |w|^2, nothing is divided and nothing normalised:

    infinite cylinder   |(y + t v) x w|^2 - r^2 W <= 0
    sphere              |(u - center) + t v|^2 - r^2 <= 0
    cap at p            -(y + t v) . w <= 0                 (outward normal p - q)
    cap at q            (u - q + t v) . w <= 0
    half-space          (u - point + t v) . normal <= 0

The radius and the ends are read from the leaf in the units of a `Grid`.
"""

from __future__ import annotations

from typing import NamedTuple

from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Slab, Sphere
from raycert.cases.vectors import cross, dot, minus
from raycert.oracle.exact.grid import Grid, IntVector, normal
from raycert.oracle.exact.surd import Surd, sign


class Plane(NamedTuple):
    """c + b t <= 0; `square` is the squared length of the normal it was made with."""

    c: int
    b: int
    square: int

    def crossing(self, grid: Grid) -> Surd:
        """Return t = -c / b where the ray crosses the plane, b != 0."""
        return grid.surd(-self.c, 0, 0, self.b)


class Quadric(NamedTuple):
    """a t^2 + 2 b t + c <= 0 with a >= 0; `scale` is what the squared radius was multiplied by."""

    a: int
    b: int
    c: int
    scale: int

    @property
    def disc(self) -> int:
        """Return b^2 - a c.

        By Lagrange's identity this is W (r^2 |v x w|^2 - det(v, w, y)^2) for a cylinder, which is
        W^2 times the r^2 |vbar|^2 - |vbar x ybar|^2 of Problem 1.
        """
        return self.b * self.b - self.a * self.c

    def roots(self, grid: Grid, disc: int) -> tuple[Surd, Surd]:
        """Return the two roots in order, a > 0 and disc >= 0; equal where disc = 0."""
        return (grid.surd(-self.b, -1, disc, self.a), grid.surd(-self.b, 1, disc, self.a))


def half_space(solid: HalfSpace, grid: Grid) -> Plane:
    n = normal(solid.normal)
    return Plane(dot(minus(grid.u, grid.point(solid.point)), n), dot(grid.v, n), dot(n, n))


def caps(solid: Slab | Cylinder, grid: Grid) -> tuple[Plane, Plane]:
    y, w = _axis(solid, grid)
    return _caps(y, w, dot(w, w), grid)


def wall(solid: InfiniteCylinder | Cylinder, grid: Grid) -> Quadric:
    y, w = _axis(solid, grid)
    return _wall(y, w, dot(w, w), grid.scalar(solid.radius), grid)


def capped(solid: Cylinder, grid: Grid) -> tuple[Quadric, Plane, Plane]:
    """Return the conditions of the wall and of the planes through p and through q."""
    y, w = _axis(solid, grid)
    square = dot(w, w)
    return (_wall(y, w, square, grid.scalar(solid.radius), grid), *_caps(y, w, square, grid))


def _axis(solid: Slab | InfiniteCylinder | Cylinder, grid: Grid) -> tuple[IntVector, IntVector]:
    p = grid.point(solid.p)
    return minus(grid.u, p), minus(grid.point(solid.q), p)


def _caps(y: IntVector, w: IntVector, square: int, grid: Grid) -> tuple[Plane, Plane]:
    """Return both planes; (u - q).w = y.w - W."""
    yw, vw = dot(y, w), dot(grid.v, w)
    return Plane(-yw, -vw, square), Plane(yw - square, vw, square)


def _wall(y: IntVector, w: IntVector, square: int, r: int, grid: Grid) -> Quadric:
    vw, yw = cross(grid.v, w), cross(y, w)
    return Quadric(dot(vw, vw), dot(vw, yw), dot(yw, yw) - r * r * square, square)


def ball(solid: Sphere, grid: Grid) -> Quadric:
    m, r = minus(grid.u, grid.point(solid.center)), grid.scalar(solid.radius)
    return Quadric(dot(grid.v, grid.v), dot(m, grid.v), dot(m, m) - r * r, 1)


def plane_signs(p_plane: Plane, q_plane: Plane) -> dict[str, int]:
    """Return the signs of Problem 2: (u - p).n, (u - q).n and v.n with n along p - q."""
    return {"up": sign(p_plane.c), "uq": -sign(q_plane.c), "vn": sign(p_plane.b)}
