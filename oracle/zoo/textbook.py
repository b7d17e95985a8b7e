"""The textbook tracer: the derivation's formulas as printed, in doubles. A subject, never a truth.

With n = w/|w|, vbar = v x n and ybar = y x n it solves t^2 vbar.vbar + 2 t vbar.ybar + ybar.ybar -
r^2 = 0 by the discriminant b^2 - a c, and the planes by -(u - p).n / v.n. Nothing is scaled and no
root is chosen: what cancels, cancels. A NaN on the way makes the whole answer [(nan, nan)].

In binary32 every operation is rounded to binary32, as a client of that precision would have it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import copysign, inf, isnan, nan

from raycert.cases.formats import BINARY64, Format
from raycert.cases.model import Ray, Solid, Vector
from raycert.cases.vectors import cross, dot
from raycert.oracle.zoo.tracer import (
    BASE,
    NAN,
    Combine,
    Pairs,
    Sight,
    Tracer,
    discriminant,
    norm,
    share,
    single,
    subtract,
    unite,
    unscaled,
)


def textbook(solid: Solid, ray: Ray, fmt: Format = BINARY64) -> tuple[tuple[float, float], ...]:
    """Return the textbook answer; never raises.

    >>> from raycert.cases.model import Cylinder
    >>> textbook(Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 0, 1), (1, 0, 0)))
    ((2.0, 4.0),)
    """
    tracer = TEXTBOOK if fmt is BINARY64 else replace(TEXTBOOK, number=single)
    return tuple(tracer(solid, ray))


def _over(a: float, b: float) -> float:
    """Return a / b as IEEE 754 has it, also for b = 0."""
    if b:
        return a / b
    return nan if not a or isnan(a) else copysign(inf, a) * copysign(1, b)


def _unit(a: Vector) -> Vector:
    length = norm(a)
    return (_over(a[0], length), _over(a[1], length), _over(a[2], length))


def _barred(self: Tracer, s: Sight) -> Pairs:
    n = _unit(s.w)
    return self.chord(cross(s.y, n), cross(s.v, n), s.r)


def _caps(self: Tracer, s: Sight) -> tuple[Pairs, Pairs]:
    n = _unit(s.w)
    climb = dot(s.v, n)
    return self.plane(-dot(s.y, n), -climb), self.plane(dot(s.z, n), climb)


def _unless_nan(combine: Combine) -> Combine:
    """Return an operation on lists that a NaN in any of them spoils."""

    def combined(lists: Sequence[Pairs]) -> Pairs:
        spoilt = any(isnan(t) for pairs in lists for pair in pairs for t in pair)
        return NAN if spoilt else combine(lists)

    return combined


def _in_doubles(solid: Solid, ray: Ray, pairs: Pairs) -> Pairs:
    return [(float(a) + 0.0, float(b) + 0.0) for a, b in pairs]


TEXTBOOK = replace(
    BASE,
    scale=unscaled,
    chord=discriminant,
    wall=_barred,
    caps=_caps,
    ahead=lambda pairs: _unless_nan(share)([[(0.0, inf)], pairs]),
    unite=_unless_nan(unite),
    share=_unless_nan(share),
    subtract=_unless_nan(subtract),
    tell=_in_doubles,
)
"""The base tracer with these steps."""
