"""The textbook formula in arrays of NumPy: all lanes at once, in whatever numbers there are.

As one would write it with NumPy: a unit axis, B^2 - A C, the slab by two quotients, clipping at 0.
Nothing is proved; far, thin and tangent rays come out wrong. In `Columns` every lane has its own
solid, of one type: a span is [enter, leave] in a lane, none where enter > leave, and NaN goes
through to the end, where it is a failure. `naive` has one solid, and is what the batch oracle's
price is measured in.

A batch is timed without the lists of Python around it: its arrays are made before, and its answers
are left as arrays, as anybody would who has many rays. A tree costs its leaves, not its algebra.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Slab,
    Solid,
    Sphere,
    Tree,
    leaves,
)
from raycert.cases.vectors import cross, dot, minus
from raycert.oracle.batch import arithmetic
from raycert.oracle.batch.lanes import Floats
from raycert.oracle.measure.quadratics import COMBINE
from raycert.oracle.measure.way import Answered, Case, answered, function
from raycert.oracle.zoo.tracer import Pairs

Array = Any
"""One number for each lane."""
Vector = tuple[Array, Array, Array]
Span = tuple[Array, Array]


def _lifted(operation: Callable[..., Any]) -> Callable[[Any, Any], DoubleDouble]:
    return lambda self, other: DoubleDouble(*operation(self.pair, other.pair))


class DoubleDouble:
    """A pair of arrays; what is not a pair is taken as doubles."""

    __slots__ = ("high", "low")

    def __init__(self, high: Array, low: Array = 0.0) -> None:
        self.high, self.low = high, low

    @property
    def pair(self) -> tuple[Array, Array]:
        return self.high, self.low

    __add__, __sub__ = _lifted(arithmetic.add), _lifted(arithmetic.sub)
    __mul__, __truediv__ = _lifted(arithmetic.mul), _lifted(arithmetic.div)

    def __neg__(self) -> DoubleDouble:
        return DoubleDouble(-self.high, -self.low)

    def __lt__(self, other: DoubleDouble | float) -> Array:
        high, low = other.pair if isinstance(other, DoubleDouble) else (other, 0.0)
        return (self.high < high) | ((self.high == high) & (self.low < low))

    def __gt__(self, other: DoubleDouble | float) -> Array:
        high, low = other.pair if isinstance(other, DoubleDouble) else (other, 0.0)
        return (self.high > high) | ((self.high == high) & (self.low > low))


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


def _sum(a: DoubleDouble) -> NDArray[np.float64]:
    """Return the sum; an infinite high part has no low one."""
    return np.asarray(np.where(np.isinf(a.high), a.high, a.high + a.low))


KINDS: dict[str, Kind] = {
    "float32": _of(np.float32),
    "float64": _of(np.float64),
    "longdouble": _of(np.longdouble),
    "double-double": Kind(lambda x: DoubleDouble(x, np.zeros_like(x)), _sum, _root, _where),
}


class Columns:
    """The rays of all lanes, and the leaf that each meets, in numbers of a kind."""

    def __init__(self, kind: Kind, origins: Any, directions: Any) -> None:
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


# From cases to arrays and back.


def shape(solid: Solid) -> tuple[object, ...]:
    """Return the types of a solid and its parts: what lanes have to share."""
    return type(solid), *map(shape, solid.of if isinstance(solid, Tree) else ())


def by_solid(solid: Solid) -> object:
    """Return the solid itself: what the lanes of a batch have to share."""
    return solid


def grouped(
    cases: Sequence[Case], key: Callable[[Solid], object]
) -> list[tuple[list[int], list[Case]]]:
    """Return the cases with equal keys together, each with its place."""
    groups: dict[object, list[int]] = {}
    for i, case in enumerate(cases):
        groups.setdefault(key(case.solid), []).append(i)
    return [(at, [cases[i] for i in at]) for at in groups.values()]


def scattered(
    cases: Sequence[Case],
    key: Callable[[Solid], object],
    solve: Callable[[list[Case]], list[Answered]],
) -> list[Answered]:
    """Return the answers in the order of the cases, solved group by group."""
    answers: list[Answered] = [None] * len(cases)
    for at, group in grouped(cases, key):
        for i, answer in zip(at, solve(group), strict=True):
            answers[i] = answer
    return answers


def _ready(calls: list[Callable[[], Any]]) -> Callable[[], None]:
    """Return one call of all, which leaves the answers as arrays."""

    def run() -> None:
        for call in calls:
            call()

    return run


def rows(cases: Sequence[Case]) -> tuple[Floats, Floats]:
    each = [case.ray for case in cases]
    return np.array([ray.origin for ray in each]), np.array([ray.direction for ray in each])


def basis(axis: Floats) -> Floats:
    """Return two unit rows across an axis, and its own: e, n x e, n."""
    n = axis / np.linalg.norm(axis)
    e = np.cross(n, np.eye(3)[np.argmin(abs(n))])
    e /= np.linalg.norm(e)
    return np.array([e, np.cross(n, e), n])


def _call(name: str, group: Sequence[Case]) -> Callable[[], Any]:
    return partial(function(name), group[0].solid, *rows(group))


def batch(name: str, cases: Sequence[Case]) -> list[Answered]:
    """Return the lists of `module:function(solid, origins, directions)`, solid by solid."""

    def solve(group: list[Case]) -> list[Answered]:
        lists = _call(name, group)()
        return [answered(lists.pairs(i)) for i in range(len(group))]

    return scattered(cases, by_solid, solve)


def ready_batch(name: str, cases: Sequence[Case]) -> Callable[[], None]:
    return _ready([_call(name, group) for _, group in grouped(cases, by_solid)])


def textbook(kind: str, cases: Sequence[Case]) -> list[Answered]:
    return scattered(cases, shape, lambda group: _lists(group, kind))


def ready_textbook(kind: str, cases: Sequence[Case]) -> Callable[[], None]:
    return _ready([_spans(group, kind) for _, group in grouped(cases, shape)])


def _spans(group: Sequence[Case], kind: str) -> Callable[[], list[tuple[Floats, Floats]]]:
    """Return the call for the spans of each leaf of the cases, which have one shape."""
    each = ([leaf for _, leaf in leaves(case.solid)] for case in group)
    columns = [list(column) for column in zip(*each, strict=True)]
    lanes = Columns(KINDS[kind], *rows(group))
    return lambda: [lanes.spans(column) for column in columns]


def _lists(group: list[Case], kind: str) -> list[Answered]:
    spans = [(enter.tolist(), leave.tolist()) for enter, leave in _spans(group, kind)()]
    lists = [[_pairs(enter[i], leave[i]) for enter, leave in spans] for i in range(len(group))]
    return [_answer(case.solid, parts) for case, parts in zip(group, lists, strict=True)]


def _answer(solid: Solid, parts: list[Pairs]) -> Answered:
    if any(answered(pairs) is None for pairs in parts):
        return None
    return answered(_node(solid, iter(parts)))


def _pairs(enter: float, leave: float) -> Pairs:
    """Return a span as a list; NaN is kept, and is a failure."""
    return [] if enter > leave else [(enter, leave)]


def _node(solid: Solid, parts: Iterator[Pairs]) -> Pairs:
    if isinstance(solid, Tree):
        return COMBINE[type(solid)]([_node(part, parts) for part in solid.of])
    return next(parts)


# One solid, many rays: what somebody writes who trusts doubles.


def naive(solid: Leaf, origins: Floats, directions: Floats) -> tuple[Floats, Floats]:
    """Return enter and leave of each ray, NaN where it misses: a sphere or a cylinder."""
    with np.errstate(all="ignore"):
        match solid:
            case Sphere(center, radius):
                enter, leave = _roots(directions, origins - np.array(center), radius)
            case InfiniteCylinder() | Cylinder():
                enter, leave = _cylinder(solid, origins, directions)
            case _:
                raise ValueError("naive: a sphere or a cylinder")
        missed = ~((leave >= 0) & (enter <= leave))
        enter, leave = np.maximum(enter, 0.0), leave.copy()
        enter[missed] = leave[missed] = np.nan
    return enter, leave


def _roots(v: Floats, y: Floats, radius: float) -> tuple[Floats, Floats]:
    a = np.einsum("ij,ij->i", v, v)
    b = np.einsum("ij,ij->i", v, y)
    c = np.einsum("ij,ij->i", y, y) - radius * radius
    root = np.sqrt(b * b - a * c)
    return (-b - root) / a, (-b + root) / a


def _cylinder(solid: InfiniteCylinder | Cylinder, u: Floats, v: Floats) -> tuple[Floats, Floats]:
    p, q = np.array(solid.p), np.array(solid.q)
    length = np.linalg.norm(q - p)
    n = (q - p) / length
    y = u - p
    climb, height = v @ n, y @ n
    across, offset = v - climb[:, None] * n, y - height[:, None] * n
    enter, leave = _roots(across, offset, solid.radius)
    if isinstance(solid, Cylinder):
        one, two = -height / climb, (length - height) / climb
        enter = np.maximum(enter, np.minimum(one, two))
        leave = np.minimum(leave, np.maximum(one, two))
    return enter, leave
