"""Witness by definition: which points are in the solid, and which gaps between them.

The exact roots of all leaves cut t >= 0 into points and gaps. Membership of every root and of a
rational point in every gap is decided straight from the definition of each leaf, at the point
f(t) itself, and the interval list is read off. It shares the number type and the integer grid
with the oracle, and neither its formulas, nor its rows, nor its algebra.

With y = u - p and w = q - p the distance is by projection: d^2 = |x-p|^2 - ((x-p).w)^2 / |w|^2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
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
    leaves,
)
from raycert.cases.vectors import dot, minus
from raycert.oracle.exact.grid import Grid, IntVector, normal
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, fraction, sign_1
from raycert.oracle.witness.cells import combine, runs
from raycert.oracle.witness.verdict import Verdict, lengths_differ, show

Number = tuple[int, int]
"""a + b sqrt(d), with the d of the endpoint at hand."""
Inside = Callable[[Surd], bool]


def witness(solid: Solid, ray: Ray, answer: Intervals) -> Verdict:
    """Agree with the answer that is exactly the list read off; never undecided."""
    found = solve(solid, ray)
    if found == answer:
        return Verdict("agreed", show(found), "every point and gap belongs as the answer says")
    if len(found) != len(answer):
        return Verdict("disagreed", show(found), lengths_differ(len(found), len(answer)))
    which = next(i for i, pair in enumerate(found) if pair != answer[i])
    return Verdict("disagreed", show(found), f"interval {which} is another")


def solve(solid: Solid, ray: Ray) -> Intervals:
    """Return the interval list, read off the points and gaps that belong to the solid."""
    grid = Grid.of(solid, ray)
    points = _distinct(t for _, leaf in leaves(solid) for t in _roots(leaf, grid))
    samples = list(_samples(points))

    def cells(leaf: Leaf) -> int:
        inside = _definition(leaf, grid)
        return sum(1 << i for i, t in enumerate(samples) if inside(t))

    found = runs(combine(solid, cells, len(points)), len(points))
    ends = [grid.surd(t.x, t.y, t.d, t.z) for t in points]
    return tuple((ends[a], INFINITY if b is None else ends[b]) for a, b in found)


def _distinct(roots: Iterator[Surd]) -> list[Surd]:
    """Return 0 and the positive roots, in order, each once."""
    points = [ZERO]
    for t in sorted(t for t in roots if t > ZERO):
        if t != points[-1]:
            points.append(t)
    return points


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
    v = grid.v
    match leaf:
        case HalfSpace():
            n = normal(leaf.normal)
            yield 0, dot(v, n), dot(minus(grid.u, grid.point(leaf.point)), n)
            return
        case Sphere():
            y, r = minus(grid.u, grid.point(leaf.center)), grid.scalar(leaf.radius)
            yield dot(v, v), 2 * dot(v, y), dot(y, y) - r * r
            return
    p = grid.point(leaf.p)
    w, y = minus(grid.point(leaf.q), p), minus(grid.u, p)
    vw, yw, ww = dot(v, w), dot(y, w), dot(w, w)
    if isinstance(leaf, Slab | Cylinder):
        yield 0, vw, yw
        yield 0, vw, yw - ww
    if isinstance(leaf, InfiniteCylinder | Cylinder):
        r = grid.scalar(leaf.radius)
        yield (
            ww * dot(v, v) - vw * vw,
            2 * (ww * dot(v, y) - vw * yw),
            ww * (dot(y, y) - r * r) - yw * yw,
        )


def _definition(leaf: Leaf, grid: Grid) -> Inside:
    """Return the test whether f(t) is in the leaf, t in the grid's unit."""
    match leaf:
        case HalfSpace():
            return _in_half_space(grid, grid.point(leaf.point), normal(leaf.normal))
        case Sphere():
            return _in_sphere(grid, grid.point(leaf.center), grid.scalar(leaf.radius))
    p = grid.point(leaf.p)
    w = minus(grid.point(leaf.q), p)
    if isinstance(leaf, Slab):
        return _in_slab(grid, p, w)
    within = _in_rod(grid, p, w, grid.scalar(leaf.radius))
    if isinstance(leaf, InfiniteCylinder):
        return within
    between_caps = _in_slab(grid, p, w)
    return lambda t: between_caps(t) and within(t)


def _in_half_space(grid: Grid, point: IntVector, n: IntVector) -> Inside:
    def inside(t: Surd) -> bool:
        """(x - point) . normal <= 0."""
        height = _along(_from(grid, point, t), n)
        return sign_1(*height, t.d) <= 0

    return inside


def _in_sphere(grid: Grid, center: IntVector, r: int) -> Inside:
    def inside(t: Surd) -> bool:
        """|x - center|^2 <= r^2."""
        a, b = _square(_from(grid, center, t), t.d)
        return sign_1(a - (r * t.z) ** 2, b, t.d) <= 0

    return inside


def _in_slab(grid: Grid, p: IntVector, w: IntVector) -> Inside:
    def inside(t: Surd) -> bool:
        """0 <= (x - p) . w <= w . w."""
        a, b = _along(_from(grid, p, t), w)
        return sign_1(a, b, t.d) >= 0 >= sign_1(a - dot(w, w) * t.z, b, t.d)

    return inside


def _in_rod(grid: Grid, p: IntVector, w: IntVector, r: int) -> Inside:
    ww = dot(w, w)

    def inside(t: Surd) -> bool:
        """|x - p|^2 - ((x - p) . w)^2 / |w|^2 <= r^2."""
        x = _from(grid, p, t)
        a, b = _square(x, t.d)
        e, f = _along(x, w)
        squared = (e * e + f * f * t.d, 2 * e * f)
        return sign_1(ww * (a - (r * t.z) ** 2) - squared[0], ww * b - squared[1], t.d) <= 0

    return inside


def _from(grid: Grid, point: IntVector, t: Surd) -> tuple[IntVector, IntVector]:
    """Return z (f(t) - point) as a vector of numbers: its rational and its irrational part."""
    (a, b, c), (i, j, k) = minus(grid.u, point), grid.v
    x, y, z = t.x, t.y, t.z
    return (a * z + i * x, b * z + j * x, c * z + k * x), (i * y, j * y, k * y)


def _along(x: tuple[IntVector, IntVector], n: IntVector) -> Number:
    return dot(x[0], n), dot(x[1], n)


def _square(x: tuple[IntVector, IntVector], d: int) -> Number:
    return dot(x[0], x[0]) + dot(x[1], x[1]) * d, 2 * dot(x[0], x[1])
