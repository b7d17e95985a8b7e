"""A leaf prepared: its constants in pairs of doubles, scaled by powers of two, exact or bounded.

Lengths are scaled so that the radius (else the largest coordinate) is about 1, the axis or normal
so that its largest part is. A circle about a coordinate axis is the sphere's formula without that
coordinate, `keep`: no axis enters. Of a solid that the scaled doubles do not hold exactly, or that
leaves the range of `formulas`, no lane is fast: `reason` says why.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
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
    points,
)
from raycert.cases.model import radius as radius_of

PLANES, BALL, WALL = range(3)
"""The kinds of a leaf's curved face: none; a sphere or aligned cylinder; a tilted one."""
ALL = (True, True, True)
GRID = 152
"""What enters a curved face is a multiple of 2^-152, between 2^-100 and 2^100, or 0."""
CURVED_RANGE, PLANE_RANGE = (2.0**-100, 2.0**100), (2.0**-400, 2.0**400)
UNUSED = HalfSpace((0, 0, 0), (0, 0, 1))
"""Whose constants a plan has that no lane looks at."""
Pair = tuple[float, float]
Place = tuple[float, ...]


class OutOfRange(ValueError):
    """A constant that the fast rungs cannot hold: the text says which."""


@dataclass(frozen=True, slots=True)
class LeafPlan:
    """The constants of a leaf. Vectors are in the scaled units; `w` and scalars are hi + lo.

    `points` are those of the planes, w the outward normal at the second; a half-space has one point
    twice, a sphere its center. `rr` is r^2, `cap` r^2 |w|^2, `exact` where that is all of it,
    `root_w` |w|. `stretch` is the power of two that lengths are multiplied by.
    """

    kind: int
    planes: int
    stretch: float
    low: float
    high: float
    keep: tuple[bool, ...]
    points: tuple[Place, Place]
    w: tuple[Pair, ...]
    size: float
    radius: float
    rr: Pair
    cap: Pair
    root_w: Pair
    exact: bool
    reason: str = ""

    @property
    def numbers(self) -> tuple[tuple[Pair, ...], float, Pair, Pair, Pair]:
        """Return the `k` of the formulas in `decide`."""
        return self.w, self.size, self.rr, self.cap, self.root_w

    @property
    def constants(self) -> NDArray[np.float64]:
        """Return the numbers in a row, as compiled lanes read them: see `chunks.fields`."""
        parts = [*self.points[0], *self.points[1]]
        parts += [x[0] for x in self.w] + [x[1] for x in self.w]
        parts += [self.size, *self.rr, *self.cap, *self.root_w]
        parts += [self.stretch, self.low, self.high, *map(float, self.keep)]
        return np.array(parts)


def plan(leaf: Leaf) -> LeafPlan:
    """Return the plan of a leaf, with a reason where no lane of it can be fast."""
    try:
        return _plan(leaf)
    except OutOfRange as error:
        return replace(_plan(UNUSED), reason=str(error))


def _plan(leaf: Leaf) -> LeafPlan:
    axis, w = _axis(leaf)
    round_ = isinstance(leaf, InfiniteCylinder | Cylinder)
    tilted = round_ and sum(map(bool, axis)) > 1
    kind = PLANES if isinstance(leaf, HalfSpace | Slab) else WALL if tilted else BALL
    limits = CURVED_RANGE if kind else PLANE_RANGE
    ends = points(leaf)[0], points(leaf)[-1]
    stretch = ldexp(1.0, -_unit(radius_of(leaf), (*ends[0], *ends[1])))

    def scaled(name: str, *numbers: float) -> Place:
        if any(x and not limits[0] <= abs(x * stretch) <= limits[1] for x in numbers):
            raise OutOfRange(f"{name} is out of range beside the radius")
        return tuple(x * stretch for x in numbers)

    (radius,) = scaled("the radius", radius_of(leaf))
    square = sum((x * x for x in axis), Fraction(0)) if tilted else Fraction(1)
    rr = Fraction(radius) ** 2
    cap = _pair(rr * square)
    return LeafPlan(
        kind,
        {HalfSpace: 1, Slab: 2, Cylinder: 2}.get(type(leaf), 0),
        stretch,
        *limits,
        keep=tuple(not x for x in axis) if round_ and not tilted else ALL,
        points=(scaled("p", *ends[0]), scaled("q", *ends[1])),
        w=w,
        size=max(abs(x[0]) for x in w),
        radius=radius,
        rr=_pair(rr),
        cap=cap,
        root_w=_root(square),
        exact=sum(map(Fraction, cap)) == rr * square,
    )


def _axis(leaf: Leaf) -> tuple[tuple[Fraction, ...], tuple[Pair, ...]]:
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
    pairs = tuple(map(_pair, exact))
    for x, pair in zip(exact, pairs, strict=True):
        if sum(map(Fraction, pair)) != x or (x * 2**GRID).denominator != 1:
            raise OutOfRange("the axis has parts of too different sizes")
    return exact, pairs


def _unit(radius: float, places: Place) -> int:
    """Return the exponent of the unit of length: the radius, else the largest coordinate."""
    most = radius or max(map(abs, places))
    return min(max(frexp(most)[1] - 1, -1000), 1000) if most else 0


def _pair(x: Fraction) -> Pair:
    """Return the nearest double and the nearest double to the rest."""
    try:
        high = float(x)
    except OverflowError:
        high = inf
    if high == inf:
        raise OutOfRange("a constant overflows")
    return high, float(x - Fraction(high))


def _root(x: Fraction) -> Pair:
    """Return sqrt(x) as a pair within u^2, x between 1 and 12."""
    return _pair(Fraction(isqrt(x.numerator * x.denominator << 400), x.denominator << 200))
