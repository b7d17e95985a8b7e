"""The textbook formula, all lanes at once, in whatever numbers of arrays there are.

As one would write it with NumPy: a unit axis, B^2 - A C, the slab by two quotients, clipping at 0.
Every lane has its own solid, of one type. A span is [enter, leave] in a lane, none where enter >
leave; NaN goes through to the end, and is a failure.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Leaf, Slab, Sphere
from raycert.oracle.batch import arithmetic
from raycert.oracle.measure.methods.vector.double_double import DoubleDouble

Array = Any
"""One number for each lane."""
Vector = tuple[Array, Array, Array]
Span = tuple[Array, Array]


@dataclass(frozen=True)
class Kind:
    """Numbers in arrays: from doubles and back, and what has no operator."""

    number: Callable[[NDArray[np.float64]], Array]
    tell: Callable[[Array], NDArray[np.float64]]
    root: Callable[[Array], Array]
    where: Callable[[Any, Array, Array], Array]


def _of(dtype: Any) -> Kind:
    return Kind(lambda x: x.astype(dtype), lambda x: x.astype(np.float64), np.sqrt, np.where)


def _where(mask: Any, a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    return DoubleDouble(np.where(mask, a.high, b.high), np.where(mask, a.low, b.low))


def _root(a: DoubleDouble) -> DoubleDouble:
    """Return the root; of 0 it is 0, where the step of Newton would divide by it."""
    high, low = arithmetic.root(a.pair)
    zero = a.high == 0
    return DoubleDouble(np.where(zero, 0.0, high), np.where(zero, 0.0, low))


def _told(a: DoubleDouble) -> NDArray[np.float64]:
    """Return the sum; an infinite high part has no low one."""
    return np.asarray(np.where(np.isinf(a.high), a.high, a.high + a.low))


KINDS: dict[str, Kind] = {
    "float32": _of(np.float32),
    "float64": _of(np.float64),
    "longdouble": _of(np.longdouble),
    "double-double": Kind(lambda x: DoubleDouble(x, np.zeros_like(x)), _told, _root, _where),
}


def dot(a: Vector, b: Vector) -> Array:
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


class Lanes:
    """The rays of all lanes, and the leaf that each meets, in numbers of a kind."""

    def __init__(self, kind: Kind, origins: Any, directions: Any) -> None:
        """Take rays in rows."""
        self.kind, lanes = kind, len(origins)
        self.u, self.v = self._vector(origins), self._vector(directions)
        self.zero = kind.number(np.zeros(lanes))
        self.end = kind.number(np.full(lanes, np.inf))

    def _vector(self, rows: Any) -> Vector:
        columns = np.ascontiguousarray(np.asarray(rows, float).T)
        number = self.kind.number
        with np.errstate(over="ignore"):
            return (number(columns[0]), number(columns[1]), number(columns[2]))

    def spans(self, leaves: list[Leaf]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the spans of t >= 0 of leaves of one type, one a lane, as doubles."""
        with np.errstate(all="ignore"):
            enter, leave = self._leaf(type(leaves[0]), leaves)
            enter = self.kind.where(enter < self.zero, self.zero, enter)
            return self.kind.tell(enter), self.kind.tell(leave)

    def _leaf(self, kind: type[Leaf], leaves: list[Any]) -> Span:
        if kind is HalfSpace:
            y = minus(self.u, self._vector([leaf.point for leaf in leaves]))
            return self._plane(y, self._vector([leaf.normal for leaf in leaves]))
        if kind is Sphere:
            y = minus(self.u, self._vector([leaf.center for leaf in leaves]))
            return self._curve(y, self.v, self._radius(leaves))
        p, q = ([getattr(leaf, name) for leaf in leaves] for name in "pq")
        y, z = minus(self.u, self._vector(p)), minus(self.u, self._vector(q))
        n = self._unit(minus(y, z))
        if kind is Slab:
            return self._slab(y, z, n)
        assert kind in (InfiniteCylinder, Cylinder)
        wall = self._curve(cross(y, n), cross(self.v, n), self._radius(leaves))
        return wall if kind is InfiniteCylinder else self._common(wall, self._slab(y, z, n))

    def _radius(self, leaves: list[Any]) -> Array:
        with np.errstate(over="ignore"):
            return self.kind.number(np.array([leaf.radius for leaf in leaves]))

    def _unit(self, w: Vector) -> Vector:
        length = self.kind.root(dot(w, w))
        return (w[0] / length, w[1] / length, w[2] / length)

    def _curve(self, y: Vector, v: Vector, r: Array) -> Span:
        """Return where |y + t v| <= r on the whole line, by the textbook."""
        where = self.kind.where
        a, b, c = dot(v, v), dot(v, y), dot(y, y) - r * r
        disc = b * b - a * c
        half = self.kind.root(disc)
        still, missed, out = ~((a > 0.0) | (a < 0.0)) & ~_nan(a, self.kind), disc < 0.0, c > 0.0
        enter, leave = (-b - half) / a, (-b + half) / a
        enter, leave = where(missed, self.end, enter), where(missed, -self.end, leave)
        enter = where(still, where(out, self.end, -self.end), enter)
        return enter, where(still, where(out, -self.end, self.end), leave)

    def _slab(self, y: Vector, z: Vector, n: Vector) -> Span:
        back = (-n[0], -n[1], -n[2])
        return self._common(self._plane(y, back), self._plane(z, n))

    def _plane(self, y: Vector, n: Vector) -> Span:
        """Return where (y + t v) . n <= 0 on the whole line."""
        where, height, climb = self.kind.where, dot(y, n), dot(self.v, n)
        t = -height / climb
        level = ~((climb > 0.0) | (climb < 0.0)) & ~_nan(climb, self.kind)
        enter, leave = where(climb < 0.0, t, -self.end), where(climb < 0.0, self.end, t)
        enter = where(level, where(height > 0.0, self.end, -self.end), enter)
        return enter, where(level, where(height > 0.0, -self.end, self.end), leave)

    def _common(self, one: Span, two: Span) -> Span:
        """Return what two spans share; what is compared with NaN stays NaN."""
        (a, b), (c, d) = one, two
        where = self.kind.where
        enter = where((a > c) | _nan(a, self.kind), a, c)
        return enter, where((b < d) | _nan(b, self.kind), b, d)


def _nan(a: Array, kind: Kind) -> Any:
    return np.isnan(kind.tell(a))
