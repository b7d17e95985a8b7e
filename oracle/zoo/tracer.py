"""The base tracer of the zoo, plain doubles, every step replaceable; and what a fault of it is.

The base is sound, stable and closed.

Symbols: the ray is u + t v, the axis runs from p to q, w = q - p (for a half-space, its normal);
y = u - p (u - center, u - point) and z = u - q. Each leaf gives intervals of the whole line of t,
which `ahead` cuts off at 0. A fault is `replace(BASE, step=...)`.

A number is a double, a `Single` or a `Fraction`. It is called a float throughout: all three add,
multiply and compare alike, and only `root` and `shift` look which one they have.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from math import frexp, inf, isqrt, ldexp, nan, sqrt
from typing import Any, Literal, NamedTuple, cast

from raycert.cases.formats import BINARY32
from raycert.cases.levels import Level
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
    map_leaves,
    parts,
    points,
    radius,
)
from raycert.cases.vectors import cross, dot, minus, times

Pair = tuple[float, float]
Pairs = list[Pair]
LINE: Pairs = [(-inf, inf)]
NAN: Pairs = [(nan, nan)]
Combine = Callable[[Sequence[Pairs]], Pairs]
Chord = Callable[[Vector, Vector, float], Pairs]
Read = Callable[[Solid, Ray], tuple[Solid, Ray]]
Tell = Callable[[Solid, Ray, Pairs], Pairs]


class Single(float):
    """A binary32 number: every operation is rounded to binary32.

    Rounding the binary64 result once more is right for + - * / and sqrt, as 53 >= 2 * 24 + 2.
    """

    __slots__ = ()

    def __add__(self, other: float) -> Single:
        return single(float.__add__(self, other))

    def __sub__(self, other: float) -> Single:
        return single(float.__sub__(self, other))

    def __mul__(self, other: float) -> Single:
        return single(float.__mul__(self, other))

    def __truediv__(self, other: float) -> Single:
        return single(float.__truediv__(self, other))

    def __neg__(self) -> Single:
        return Single(float.__neg__(self))


BITS = 240
"""The bits of a root that a fraction gets."""


def norm(a: Vector) -> float:
    return root(dot(a, a))


def root(x: float) -> float:
    """Return the square root: of a double or a `Single` rounded right, of a fraction to BITS."""
    if type(x) is float:
        return sqrt(x)
    if isinstance(x, Single):
        return single(sqrt(x))
    f = Fraction(x)
    up = max(2 * BITS - f.numerator.bit_length() + f.denominator.bit_length(), 0) // 2
    return cast(float, Fraction(isqrt((f.numerator << 2 * up) // f.denominator), 1 << up))


def shift(x: float, e: int) -> float:
    """Return x 2^e as a number of the same kind; a double that overflows is infinite."""
    if not e or not x:
        return x
    if type(x) is not float and isinstance(x, Fraction):
        return cast(float, x * Fraction(2) ** e)
    try:
        moved = ldexp(x, e)
    except OverflowError:
        moved = inf if x > 0 else -inf
    return moved if type(x) is float else type(x)(moved)


def shifted(a: Vector, e: int) -> Vector:
    if not e:
        return a
    if type(a[0]) is float and -1022 <= e <= 1022:  # the factor is exact: one rounding, as in shift
        k = ldexp(1.0, e)
        return (a[0] * k, a[1] * k, a[2] * k)
    return (shift(a[0], e), shift(a[1], e), shift(a[2], e))


def exponent(*numbers: float) -> int:
    """Return the e for which the largest magnitude is in [1/2, 1) 2^e; 0 for zeros."""
    largest = max(map(abs, numbers))
    return frexp(largest)[1] if largest else 0


def fraction(x: float) -> float:
    return cast(float, Fraction(x))


def single(x: float) -> Single:
    return Single(BINARY32.nearest(x))


def common(first: Pairs, second: Pairs) -> Pairs:
    """Return the t in both lists; NaN where one has it."""
    if len(first) == len(second) == 1:
        (a, b), (c, d) = first[0], second[0]
        if a != a or c != c:
            return NAN
        enter, leave = (a if a > c else c), (b if b < d else d)
        return [(enter, leave)] if enter <= leave else []
    pieces = [(max(a, c), min(b, d)) for a, b in first for c, d in second]
    return [(a, b) for a, b in pieces if a <= b]


def share(lists: Sequence[Pairs]) -> Pairs:
    return reduce(common, lists)


def merged(pairs: Pairs) -> Pairs:
    """Return the list of intervals in any order, sorted, and joined where they touch."""
    joined: Pairs = []
    for a, b in sorted(pairs):
        if joined and a <= joined[-1][1]:
            joined[-1] = (joined[-1][0], max(joined[-1][1], b))
        else:
            joined.append((a, b))
    return joined


def unite(lists: Sequence[Pairs]) -> Pairs:
    return merged([pair for pairs in lists for pair in pairs])


def subtract(lists: Sequence[Pairs]) -> Pairs:
    """Return the closure of the t in the first list and in no other."""
    return merged(pierced(lists, cut))


def pierced(lists: Sequence[Pairs], cut: Callable[[Pair, Pair], Pairs]) -> Pairs:
    """Return what is left of the first list, each of its pairs cut by each hole in turn."""
    left = lists[0]
    for hole in unite(lists[1:]):
        left = [piece for pair in left for piece in cut(pair, hole)]
    return left


def cut(pair: Pair, hole: Pair) -> Pairs:
    """Return the closures of what is before a hole and of what is after it."""
    (a, b), (c, d) = pair, hole
    before = [(a, min(b, c))] if a < c else []
    return before + ([(max(a, d), b)] if d < b else [])


class Sight(NamedTuple):
    """A leaf as a ray meets it. Lengths u, y, z, r are scaled together, v and w each alone."""

    u: Vector
    y: Vector
    z: Vector
    v: Vector
    w: Vector
    r: float
    e: int
    """t = (the t of the scaled numbers) 2^e."""


def chord(y: Vector, v: Vector, r: float) -> Pairs:
    """Return where |y + t v| <= r, from the closest approach."""
    speed, offset, reach = norm(v), norm(cross(v, y)), r * norm(v)
    if speed == 0:
        return LINE if norm(y) <= r else []
    if reach < offset:
        return []
    half, middle = root((reach - offset) * (reach + offset)), -dot(v, y)
    a = dot(v, v)
    return [((middle - half) / a, (middle + half) / a)]


def plane(height: float, climb: float) -> Pairs:
    """Return where height + t climb <= 0."""
    if climb == 0:
        return LINE if height <= 0 else []
    t = -height / climb
    return [(-inf, t)] if climb > 0 else [(t, inf)]


def crossed(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the wall: y and v crossed with w, and r |w| for r."""
    return self.chord(cross(s.y, s.w), cross(s.v, s.w), s.r * norm(s.w))


def ball(self: Tracer, s: Sight) -> Pairs:
    return self.chord(s.y, s.v, s.r)


def caps(self: Tracer, s: Sight) -> tuple[Pairs, Pairs]:
    """Return where the ray is above the plane through p, and where below the one through q."""
    climb = dot(s.v, s.w)
    return self.plane(-dot(s.y, s.w), -climb), self.plane(dot(s.z, s.w), climb)


def can(self: Tracer, s: Sight) -> Pairs:
    return self.share([self.wall(self, s), *self.caps(self, s)])


def below(self: Tracer, s: Sight) -> Pairs:
    return self.plane(dot(s.y, s.w), dot(s.v, s.w))


def ahead(pairs: Pairs) -> Pairs:
    """Return what lies at t >= 0."""
    return common(pairs, [(0.0, inf)])


def identity(x: float) -> float:
    return x


@dataclass(frozen=True)
class Tracer:
    """The steps, in the order in which they are taken; calling it answers a question."""

    read: Read = lambda solid, ray: (solid, ray)
    number: Callable[[float], float] = identity
    scale: Callable[..., int] = exponent
    chord: Chord = chord
    plane: Callable[[float, float], Pairs] = plane
    wall: Callable[[Tracer, Sight], Pairs] = crossed
    ball: Callable[[Tracer, Sight], Pairs] = ball
    caps: Callable[[Tracer, Sight], tuple[Pairs, Pairs]] = caps
    can: Callable[[Tracer, Sight], Pairs] = can
    below: Callable[[Tracer, Sight], Pairs] = below
    ahead: Callable[[Pairs], Pairs] = ahead
    unite: Combine = unite
    share: Combine = share
    subtract: Combine = subtract
    tell: Tell = lambda solid, ray, pairs: pairs

    def __call__(self, solid: Solid, ray: Ray) -> Pairs:
        solid, ray = self.read(solid, ray)
        return self.tell(solid, ray, self.node(solid, ray))

    def node(self, solid: Solid, ray: Ray) -> Pairs:
        """Return the list of a solid or of a part of it."""
        lists = [self.node(part, ray) for part in parts(solid)]
        match solid:
            case Union():
                return self.unite(lists)
            case Intersection():
                return self.share(lists)
            case Difference():
                return self.subtract(lists)
        s, line = self.leaf(solid, ray)
        return self.ahead([(shift(a, s.e), shift(b, s.e)) for a, b in line])

    def leaf(self, leaf: Leaf, ray: Ray) -> tuple[Sight, Pairs]:
        """Return a leaf as the ray meets it, and its intervals of the scaled line."""
        s = self.sight(ray, leaf)
        match leaf:
            case HalfSpace():
                return s, self.below(self, s)
            case Sphere():
                return s, self.ball(self, s)
            case InfiniteCylinder():
                return s, self.wall(self, s)
            case Slab():
                return s, self.share(self.caps(self, s))
            case Cylinder():
                return s, self.can(self, s)

    def sight(self, ray: Ray, leaf: Leaf) -> Sight:
        """Return the leaf scaled: p and q are one where it has one point, w is q - p or its own."""
        (p, *others), length = points(leaf), radius(leaf)
        q = others[0] if others else p
        e = self.scale(*ray.origin, *p, *q, length)
        u = shifted(self.vector(ray.origin), -e)
        p, q = shifted(self.vector(p), -e), shifted(self.vector(q), -e)
        y, z, r = minus(u, p), minus(u, q), shift(self.number(length), -e)
        v = self.vector(ray.direction)
        w = self.vector(leaf.normal) if isinstance(leaf, HalfSpace) else minus(q, p)
        small, ve, we = self.scale(*y, *z, r), self.scale(*v), self.scale(*w)
        u, y, z, r = shifted(u, -small), shifted(y, -small), shifted(z, -small), shift(r, -small)
        return Sight(u, y, z, shifted(v, -ve), shifted(w, -we), r, e + small - ve)

    def vector(self, a: Vector) -> Vector:
        if self.number is identity:
            return a
        return (self.number(a[0]), self.number(a[1]), self.number(a[2]))


Step = Callable[[Tracer, Sight], Pairs]
"""What a tracer makes of a leaf, or of a part of it."""

BASE = Tracer()
"""The tracer that every fault is planted in."""

# Steps in the units of the question: no scaling, a normalised axis, coefficients of a quadratic.
# Faults with an absolute threshold are planted on these.


def unscaled(*_: float) -> int:
    return 0


def unit(w: Vector) -> Vector:
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
    return dot(v, v), dot(v, y), dot(y, y) - r * r


def discriminant(y: Vector, v: Vector, r: float) -> Pairs:
    """Return where |y + t v| <= r, by the textbook."""
    return roots(*coefficients(y, v, r))


def quadratic(solve: Callable[[float, float, float], Pairs]) -> Chord:
    """Return the chord that a way to solve a t^2 + 2 b t + c = 0, with a > 0, gives."""

    def solved(y: Vector, v: Vector, r: float) -> Pairs:
        a, b, c = coefficients(y, v, r)
        return solve(a, b, c) if a else LINE if c <= 0 else []

    return solved


def each_leaf(change: Callable[[Any], Leaf]) -> Read:
    """Return the step that reads every leaf of a solid otherwise."""
    return lambda solid, ray: (map_leaves(change, solid), ray)


Intersect = Callable[[Solid, Ray], Pairs]
Kind = Literal[
    "crash", "malformed", "missed", "phantom", "wrong end", "count", "touch dropped", "unrepeated"
]
"""How an answer is refused; see `matrix.kind` for what each means."""


@dataclass(frozen=True)
class Fault:
    """A planted fault: `does` completes "a tracer that ...".

    `home` is the family made for it, `kind` the way most of its answers there are refused.
    `granted` is the highest level that its answers are still granted, `make` gives a new tracer;
    a `stateful` one answers by what it was asked before.
    """

    name: str
    does: str
    origin: str
    home: str
    kind: Kind
    make: Callable[[], Intersect]
    granted: Level | None = None
    stateful: bool = False


STEPS = {
    "half_space": {"below", "plane"},
    "sphere": {"ball", "chord"},
    "infinite_cylinder": {"wall", "chord"},
    "slab": {"caps", "plane", "share"},
    "cylinder": {"can", "wall", "chord", "caps", "plane", "share"},
}
"""The steps that are taken for each leaf, but for those that are taken for all."""
ALWAYS = {"read", "number", "ahead", "tell"}


def concerns(fault: Fault, solid: str) -> bool:
    """Whether a fault is in a step taken for a type of solid. Scaling alone is no fault."""
    tracer = fault.make()
    if solid not in STEPS or not isinstance(tracer, Tracer):
        return True
    return any(getattr(tracer, s) is not getattr(BASE, s) for s in STEPS[solid] | ALWAYS)


def fault(
    name: str,
    does: str,
    origin: str,
    home: str,
    kind: Kind,
    granted: Level | None = None,
    **steps: Any,
) -> Fault:
    tracer = replace(BASE, **steps)
    return Fault(name, does, origin, home, kind, lambda: tracer, granted)
