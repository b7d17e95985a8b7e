"""Problem 1: where |y + t v| <= r, in doubles.

For the infinite cylinder y and v are the barred vectors of cases/README.md; for the sphere they are
u - center and v themselves. The criterion r|v| < |v x y| and the table serve both.
"""

from __future__ import annotations

from math import inf, sqrt

from raycert.cases.model import Vector
from raycert.reference.intervals import Pairs
from raycert.reference.vectors import cross, dot, norm


def chord(y: Vector, v: Vector, r: float) -> Pairs:
    """Return the interval of t >= 0 for which |y + t v| <= r: the table of Problem 1 (m).

    The arguments are scaled: no component much above 1.
    """
    vv = dot(v, v)
    if vv == 0:
        return [(0.0, inf)] if norm(y) <= r else []  # along-inside, along-outside
    reach, offset = r * norm(v), norm(cross(v, y))
    if reach < offset:
        return []  # miss
    # The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a tangency.
    half = sqrt((reach - offset) * (reach + offset))
    # Likewise |y|^2 - r^2 near the wall; a start with norm(y) = r gives t = 0 itself.
    start = (norm(y) - r) * (norm(y) + r)
    t1, t2 = roots(vv, dot(v, y), start, half)
    if t2 < 0:
        return []  # behind
    if t1 < 0:
        return [(0.0, t2)]  # from-inside
    return [(t1, t2)]  # through


def roots(a: float, b: float, c: float, half: float) -> tuple[float, float]:
    """Return t1 <= t2, the roots (-b - half) / a and (-b + half) / a, with a > 0.

    The formulas of Problem 1 (f) are used as they stand, but for the root whose numerator
    cancels: that one is c / k, with k the numerator of the other. Only where 2 half > |b| does it
    cancel much; elsewhere c / k is the worse one, for c and half do not share their rounding.
    Near a tangent start that can even carry c / k past the other root, and is stopped there.
    """
    if b > 0:
        k = -b - half
        return k / a, max(k / a, c / k) if 2 * half > b else (-b + half) / a
    k = -b + half
    return min(k / a, c / k) if 2 * half > -b else (-b - half) / a, k / a
