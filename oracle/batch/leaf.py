"""A leaf prepared: its constants in pairs of doubles, scaled by powers of two, exact or bounded.

Lengths are scaled so that the radius (else the largest coordinate) is about 1, the axis or normal
so that its largest part is. A circle about a coordinate axis is the sphere's formula without that
coordinate, `keep`: no axis enters. Of a solid that the scaled doubles do not hold exactly, or that
leaves the range of `formulas`, no lane is fast: `reason` says why.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import frexp, inf, isqrt, ldexp

import numpy as np
from numpy.typing import NDArray

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Slab,
    Sphere,
    Vector,
    points,
)
from raycert.cases.model import radius as radius_of

PLANES, BALL, WALL, CAPPED_BALL, CAPPED_WALL = range(5)
"""The kinds of lane: no curved face; a sphere or aligned cylinder; a tilted one; and with caps."""
GRID = 152
"""What enters a curved face is a multiple of 2^-152, between 2^-100 and 2^100, or 0."""
CURVED_RANGE, PLANE_RANGE = (2.0**-100, 2.0**100), (2.0**-400, 2.0**400)


Pairs = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]


class OutOfRange(ValueError):
    """A constant that the fast rungs cannot hold: the text says which."""


@dataclass(frozen=True, slots=True)
class LeafPlan:
    """The constants of a leaf. Vectors are in the scaled units; `w` and scalars are hi + lo.

    `first` and `second` are the points of the planes, w the outward normal at `second`; a
    half-space has only that one. `rr` is r^2, `cap` r^2 |w|^2, `exact` where that is all of it,
    `root_w` |w|. `stretch` is the power of two that lengths are multiplied by.
    """

    kind: int
    stretch: float
    low: float
    high: float
    keep: tuple[bool, bool, bool]
    first: Vector
    second: Vector
    w: Pairs
    size: float
    radius: float
    rr: tuple[float, float]
    cap: tuple[float, float]
    root_w: tuple[float, float]
    planes: int
    exact: bool = True
    reason: str = ""

    @property
    def constants(self) -> NDArray[np.float64]:
        """Return the numbers in a row, as compiled lanes read them: see `lane`."""
        parts = [*self.first, *self.second]
        parts += [x[0] for x in self.w] + [x[1] for x in self.w]
        parts += [self.size, *self.rr, *self.cap, *self.root_w]
        parts += [self.stretch, self.low, self.high, *map(float, self.keep)]
        return np.array(parts)


def plan(leaf: Leaf) -> LeafPlan:
    """Return the plan of a leaf, with a reason where no lane of it can be fast."""
    try:
        return _plan(leaf)
    except OutOfRange as error:
        zero, pair = (0.0, 0.0, 0.0), (0.0, 0.0)
        return LeafPlan(
            PLANES, 1.0, 1.0, 1.0, (True,) * 3, zero, zero, (pair,) * 3,
            1.0, 0.0, pair, pair, pair, 0, reason=str(error),
        )  # fmt: skip


def _plan(leaf: Leaf) -> LeafPlan:
    curved = isinstance(leaf, Sphere | InfiniteCylinder | Cylinder)
    low, high = CURVED_RANGE if curved else PLANE_RANGE
    first, second = _points(leaf)
    axis, w = _axis(leaf)
    radius = radius_of(leaf)
    stretch = ldexp(1.0, -_unit(radius, (*first, *second)))
    radius = _held("the radius", radius, stretch, low, high)
    square = sum((x * x for x in axis), Fraction(0)) if _tilted(leaf, axis) else Fraction(1)
    rr = Fraction(radius) ** 2
    cap = _pair(rr * square)
    return LeafPlan(
        kind=_kind(leaf, axis),
        stretch=stretch,
        low=low,
        high=high,
        keep=_keep(leaf, axis),
        first=_all_held("p", first, stretch, low, high),
        second=_all_held("q", second, stretch, low, high),
        w=w,
        size=max(abs(x[0]) for x in w),
        radius=radius,
        rr=_pair(rr),
        cap=cap,
        root_w=_root(square),
        planes={HalfSpace: 1, Slab: 2, Cylinder: 2}.get(type(leaf), 0),
        exact=sum(map(Fraction, cap)) == rr * square,
    )


def _kind(leaf: Leaf, axis: tuple[Fraction, ...]) -> int:
    match leaf:
        case HalfSpace() | Slab():
            return PLANES
        case Cylinder():
            return CAPPED_WALL if _tilted(leaf, axis) else CAPPED_BALL
    return WALL if _tilted(leaf, axis) else BALL


def _tilted(leaf: Leaf, axis: tuple[Fraction, ...]) -> bool:
    return isinstance(leaf, InfiniteCylinder | Cylinder) and sum(map(bool, axis)) > 1


def _keep(leaf: Leaf, axis: tuple[Fraction, ...]) -> tuple[bool, bool, bool]:
    """Return the coordinates that the curved face depends on."""
    if not isinstance(leaf, InfiniteCylinder | Cylinder) or _tilted(leaf, axis):
        return (True, True, True)
    return (not axis[0], not axis[1], not axis[2])


def _points(leaf: Leaf) -> tuple[Vector, Vector]:
    ends = points(leaf)
    return ends[0], ends[-1]


def _axis(leaf: Leaf) -> tuple[tuple[Fraction, ...], Pairs]:
    """Return the axis or normal, scaled: exactly, and as pairs that hold it exactly."""
    match leaf:
        case Sphere():
            raw = [Fraction(1), Fraction(0), Fraction(0)]
        case HalfSpace(_, normal):
            raw = [Fraction(x) for x in normal]
        case _:
            raw = [Fraction(b) - Fraction(a) for a, b in zip(leaf.p, leaf.q, strict=True)]
    most = max(map(abs, raw))
    power = most.denominator.bit_length() - most.numerator.bit_length()
    exact = tuple(x * Fraction(2) ** power for x in raw)
    pairs = tuple(_pair(x) for x in exact)
    for x, (high, low) in zip(exact, pairs, strict=True):
        if Fraction(high) + Fraction(low) != x or (x * 2**GRID).denominator != 1:
            raise OutOfRange("the axis has parts of too different sizes")
    return exact, (pairs[0], pairs[1], pairs[2])


def _unit(radius: float, points: tuple[float, ...]) -> int:
    """Return the exponent of the unit of length: the radius, else the largest coordinate."""
    most = radius or max(map(abs, points))
    return min(max(frexp(most)[1] - 1, -1000), 1000) if most else 0


def _held(name: str, x: float, stretch: float, low: float, high: float) -> float:
    scaled = x * stretch
    if x and not (low <= abs(scaled) <= high):
        raise OutOfRange(f"{name} is out of range beside the radius")
    return scaled


def _all_held(name: str, x: Vector, stretch: float, low: float, high: float) -> Vector:
    a, b, c = (_held(name, part, stretch, low, high) for part in x)
    return (a, b, c)


def _pair(x: Fraction) -> tuple[float, float]:
    """Return the nearest double and the nearest double to the rest."""
    try:
        high = float(x)
    except OverflowError:
        high = inf
    if high == inf:
        raise OutOfRange("a constant overflows")
    return high, float(x - Fraction(high))


def _root(x: Fraction) -> tuple[float, float]:
    """Return sqrt(x) as a pair within u^2, x between 1 and 12."""
    return _pair(Fraction(isqrt(x.numerator * x.denominator << 400), x.denominator << 200))
