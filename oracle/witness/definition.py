"""Witness by definition: which points are in the solid, and which gaps between them.

The exact roots of all leaves cut t >= 0 into points and gaps. Membership of every root and of a
rational point in every gap is decided straight from the definition of each leaf, at the point
f(t) itself, and the interval list is read off. It shares the number type and the integer grid
with the oracle, and neither its formulas, nor its rows, nor its algebra.

With y = u - p and w = q - p the distance is by projection: d^2 = |x-p|^2 - ((x-p).w)^2 / |w|^2.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from math import isqrt

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Vector,
    leaves,
)
from raycert.oracle.exact.grid import Grid, normal
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, fraction, sign_1
from raycert.oracle.witness.algebra import Vec, combine, runs
from raycert.oracle.witness.testimony import Testimony, compared, show_end

Number = tuple[int, int]
"""a + b sqrt(d), with the d of the endpoint at hand."""


def witness(solid: Solid, ray: Ray, answer: Intervals) -> Testimony:
    """Agree with the answer that is exactly the list read off; never undecided."""
    return compared(
        solve(solid, ray),
        answer,
        show_end,
        lambda mine, t: None if mine == t else "is another",
        "every point and gap belongs as the answer says",
    )


def solve(solid: Solid, ray: Ray) -> Intervals:
    """Return the interval list, read off the points and gaps that belong to the solid."""
    grid = Grid.of(solid, ray)
    roots = [t for _, leaf in leaves(solid) for t in _roots(leaf, grid)]
    points = [t for t, _ in groupby(sorted([ZERO, *(t for t in roots if t > ZERO)]))]
    samples = list(_samples(points))

    def cells(leaf: Leaf) -> int:
        return sum(1 << i for i, t in enumerate(samples) if _inside(leaf, grid, t))

    ends = [grid.surd(t.x, t.y, t.d, t.z) for t in points]
    found = runs(combine(solid, cells, len(points)), ends)
    return tuple((a, INFINITY if b is None else b) for a, b in found)


def _samples(points: list[Surd]) -> Iterator[Surd]:
    """Yield each point, and a rational in the gap after it."""
    for t, after in zip(points, [*points[1:], INFINITY], strict=True):
        yield t
        yield between(t, after)


def between(low: Surd, high: Surd) -> Surd:
    """Return a rational strictly between two numbers, 0 <= low < high; `high` may be infinite."""
    bits = 4
    while True:
        middle = fraction(_floor(low, bits) + 1, 1 << bits)
        if middle < high:
            return middle
        bits *= 2


def _floor(t: Surd, bits: int) -> int:
    """Return floor(t 2^bits)."""
    square = t.y * t.y * t.d << 2 * bits
    root = isqrt(square)
    if t.y < 0:
        root = -root - (root * root != square)
    return ((t.x << bits) + root) // t.z


def _roots(leaf: Leaf, grid: Grid) -> Iterator[Surd]:
    """Yield every t, in the grid's unit, at which the ray is on a face of the leaf."""
    for a, b, c in _faces(leaf, grid):
        square = b * b - 4 * a * c
        if a and square >= 0:
            yield Surd(-b, -1, square, 2 * a)
            yield Surd(-b, 1, square, 2 * a)
        elif not a and b:
            yield fraction(-c, b)


def _faces(leaf: Leaf, grid: Grid) -> Iterator[tuple[int, int, int]]:
    """Yield a, b, c of a t^2 + b t + c = 0 on each face; a >= 0."""
    u, v = Vec(*grid.u), Vec(*grid.v)
    match leaf:
        case HalfSpace():
            n = Vec(*normal(leaf.normal))
            yield 0, v @ n, (u - Vec(*grid.point(leaf.point))) @ n
            return
        case Sphere():
            y, r = u - Vec(*grid.point(leaf.center)), grid.scalar(leaf.radius)
            yield v @ v, 2 * (v @ y), y @ y - r * r
            return
    p = Vec(*grid.point(leaf.p))
    w, y = Vec(*grid.point(leaf.q)) - p, u - p
    vw, yw, ww = v @ w, y @ w, w @ w
    if isinstance(leaf, Slab | Cylinder):
        yield 0, vw, yw
        yield 0, vw, yw - ww
    if isinstance(leaf, InfiniteCylinder | Cylinder):
        r = grid.scalar(leaf.radius)
        yield (ww * (v @ v) - vw * vw, 2 * (ww * (v @ y) - vw * yw), ww * (y @ y - r * r) - yw * yw)


def _inside(leaf: Leaf, grid: Grid, t: Surd) -> bool:
    """Whether f(t) is in the leaf, by the leaf's definition; t in the grid's unit."""
    match leaf:
        case HalfSpace():  # (x - point) . normal <= 0
            x = _from(grid, leaf.point, t)
            return sign_1(*_along(x, Vec(*normal(leaf.normal))), t.d) <= 0
        case Sphere():  # |x - center|^2 <= r^2
            a, b = _square(_from(grid, leaf.center, t), t.d)
            return sign_1(a - (grid.scalar(leaf.radius) * t.z) ** 2, b, t.d) <= 0
    x, w = _from(grid, leaf.p, t), Vec(*grid.point(leaf.q)) - Vec(*grid.point(leaf.p))
    (e, f), ww = _along(x, w), w @ w
    if isinstance(leaf, Slab | Cylinder):  # 0 <= (x - p) . w <= w . w
        within = sign_1(e, f, t.d) >= 0 >= sign_1(e - ww * t.z, f, t.d)
        if isinstance(leaf, Slab) or not within:
            return within
    # |w|^2 (|x - p|^2 - r^2) <= ((x - p) . w)^2
    a, b = _square(x, t.d)
    a -= (grid.scalar(leaf.radius) * t.z) ** 2
    return sign_1(ww * a - e * e - f * f * t.d, ww * b - 2 * e * f, t.d) <= 0


def _from(grid: Grid, point: Vector, t: Surd) -> tuple[Vec, Vec]:
    """Return z (f(t) - point) as a vector of numbers: its rational and its irrational part."""
    v = Vec(*grid.v)
    return t.z * (Vec(*grid.u) - Vec(*grid.point(point))) + t.x * v, t.y * v


def _along(x: tuple[Vec, Vec], n: Vec) -> Number:
    return x[0] @ n, x[1] @ n


def _square(x: tuple[Vec, Vec], d: int) -> Number:
    return x[0] @ x[0] + (x[1] @ x[1]) * d, 2 * (x[0] @ x[1])
