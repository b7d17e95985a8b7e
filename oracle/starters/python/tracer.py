"""A client of raycert: reads a case a line, answers each with a line, flushed, in order.

Python's json reads and writes every double exactly, so numbers are plain decimals.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable
from math import frexp, hypot, inf, ldexp, sqrt
from typing import Any

Vector = tuple[float, float, float]
Pair = tuple[float, float]
Pairs = list[Pair]
Ray = tuple[Vector, Vector]
"""(u, v): origin and direction. The ray is u + t v, t >= 0."""
Solid = dict[str, Any]
"""As it came: a dict with its type and fields, every vector a tuple of three floats."""

# ---- your tracer: replace from here -----------------------------------------------------------
# What you declare, and the function `intersect`. Leave out the solids you do not have.

HELLO = {
    "hello": 1,
    "name": "reference tracer, in Python",
    "version": "1",
    "solids": [
        *("half_space", "sphere", "infinite_cylinder", "slab", "cylinder"),
        *("union", "intersection", "difference"),
    ],
    "precision": "binary64",
    "convention": "closed",
    "numbers": "decimal",
}


def intersect(solid: Solid, ray: Ray) -> Pairs:
    """Return the intervals of t >= 0 for which the ray is in the solid, sorted and disjoint."""
    match solid:
        case {"type": "half_space", "point": point, "normal": normal}:
            return half_space(point, normal, ray)
        case {"type": "sphere", "center": center, "radius": radius}:
            return sphere(center, radius, ray)
        case {"type": "infinite_cylinder", "p": p, "q": q, "radius": radius}:
            return axial(p, q, radius, ray, wall=True, caps=False)
        case {"type": "slab", "p": p, "q": q}:
            return axial(p, q, 0.0, ray, wall=False, caps=True)
        case {"type": "cylinder", "p": p, "q": q, "radius": radius}:
            return axial(p, q, radius, ray, wall=True, caps=True)
        case {"type": "union", "of": of}:
            return union(*(intersect(part, ray) for part in of))
        case {"type": "intersection", "of": of}:
            return intersection(*(intersect(part, ray) for part in of))
        case {"type": "difference", "of": [first, *others]}:
            return difference(intersect(first, ray), *(intersect(part, ray) for part in others))
    raise ValueError(f"no such solid: {solid['type']}")


def half_space(point: Vector, normal: Vector, ray: Ray) -> Pairs:
    """Return where (x - point) . normal <= 0."""
    n, _ = scaled(normal)
    v, ve = scaled(ray[1])
    y, ye = displacement(point, ray[0])
    up, vn = dot(y, n), dot(v, n)
    if vn == 0 or (vn > 0) == (up > 0):
        return [(0.0, inf)] if up <= 0 else []  # it never comes to the plane
    t = times(-up / vn, ye - ve)
    return [(0.0, t)] if vn > 0 else [(t, inf)]


def sphere(center: Vector, radius: float, ray: Ray) -> Pairs:
    """Return where the distance from the center is at most the radius."""
    v, ve = scaled(ray[1])
    y, ye = displacement(center, ray[0])
    e = max(ye, exponent(radius))
    return unscale(chord(shift(y, ye - e), v, ldexp(radius, -e)), e - ve)


def axial(p: Vector, q: Vector, radius: float, ray: Ray, *, wall: bool, caps: bool) -> Pairs:
    """Return where the ray is within the wall around pq, between the caps, or both.

    Lengths from p and q are scaled by one power of two, v by another, w = q - p by a third: no
    product overflows, and t only has to be scaled back.
    """
    v, ve = scaled(ray[1])
    y, ye = displacement(p, ray[0])
    z, ze = displacement(q, ray[0])
    w, _ = displacement(p, q)
    e = max(ye, ze, exponent(radius))
    y, z, r = shift(y, ye - e), shift(z, ze - e), ldexp(radius, -e)
    if not wall:
        return unscale(slab(y, z, v, w), e - ve)
    # Crossed with w, which is not normalised: r is multiplied by |w| instead. So a direction
    # parallel to the axis gives exactly zero, whichever way the axis points.
    pairs = chord(cross(y, w), cross(v, w), r * norm(w))
    return unscale(intersection(pairs, slab(y, z, v, w)) if caps else pairs, e - ve)


def slab(y: Vector, z: Vector, v: Vector, w: Vector) -> Pairs:
    """Return where the ray is between the planes through p and q square to pq."""
    up, uq, vn = -dot(y, w), -dot(z, w), -dot(v, w)
    if vn == 0:
        return [(0.0, inf)] if up <= 0 <= uq else []
    tp, tq = -up / vn, -uq / vn
    if uq < 0:
        return pair(tq, tp) if vn > 0 else []  # starts beyond q
    if up > 0:
        return pair(tp, tq) if vn < 0 else []  # starts before p
    return [(0.0, tp if vn > 0 else tq)]


def chord(y: Vector, v: Vector, r: float) -> Pairs:
    """Return the interval of t >= 0 for which |y + t v| <= r."""
    vv = dot(v, v)
    if vv == 0:
        return [(0.0, inf)] if norm(y) <= r else []
    reach, offset = r * norm(v), norm(cross(v, y))
    if reach < offset:
        return []
    # The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a tangency.
    half = sqrt((reach - offset) * (reach + offset))
    # Likewise |y|^2 - r^2 near the wall; a start with norm(y) = r gives t = 0 itself.
    start = (norm(y) - r) * (norm(y) + r)
    t1, t2 = roots(vv, dot(v, y), start, half)
    return pair(0.0 if t1 < 0 else t1, t2)


def roots(a: float, b: float, c: float, half: float) -> Pair:
    """Return t1 <= t2, the roots (-b - half) / a and (-b + half) / a, with a > 0.

    The root whose numerator cancels is c / k instead, k the numerator of the other. Only where
    2 half > |b| does it cancel much; elsewhere c / k is the worse one. Near a tangent start that
    can even carry it past the other root, and is stopped there.
    """
    if b > 0:
        k = -b - half
        return k / a, max(k / a, c / k) if 2 * half > b else (-b + half) / a
    k = -b + half
    return min(k / a, c / k) if 2 * half > -b else (-b - half) / a, k / a


def pair(enter: float, leave: float) -> Pairs:
    """Return the list of the one interval, empty if it would end before it begins."""
    return [(enter, leave)] if enter <= leave else []


def union(*lists: Iterable[Pair]) -> Pairs:
    """Return the t in any of the lists. Intervals that touch merge."""
    merged: Pairs = []
    for enter, leave in sorted(interval for pairs in lists for interval in pairs):
        if merged and enter <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(merged[-1][1], leave))
        else:
            merged.append((enter, leave))
    return merged


def intersection(first: Iterable[Pair], *others: Iterable[Pair]) -> Pairs:
    """Return the t in all of the lists."""
    common = list(first)
    for other in others:
        common = [
            piece for a, b in common for c, d in other for piece in pair(max(a, c), min(b, d))
        ]
    return common


def difference(first: Iterable[Pair], *others: Iterable[Pair]) -> Pairs:
    """Return the closure of the t in the first list and in none of the others."""
    left = list(first)
    for c, d in union(*others):
        before = [(a, min(b, c)) for a, b in left if a < c]
        after = [(max(a, d), b) for a, b in left if d < b]
        left = before + after
    return union(left)  # sorted, and closed again where a single point was cut out


def dot(a: Vector, b: Vector) -> float:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b: exactly zero for parallel vectors, as equal products round alike."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a: Vector) -> float:
    """Return |a|: within an ulp, exact along a coordinate axis."""
    return hypot(*a)


def exponent(*numbers: float) -> int:
    """Return the e for which the largest magnitude is in [1/2, 1) 2^e; for zero, below all."""
    largest = max(map(abs, numbers))
    return frexp(largest)[1] if largest else -1200


def shift(a: Vector, e: int) -> Vector:
    """Return a 2^e, which must not overflow."""
    return (ldexp(a[0], e), ldexp(a[1], e), ldexp(a[2], e))


def scaled(a: Vector) -> tuple[Vector, int]:
    """Return (m, e) with a = m 2^e and the largest component of m in [1/2, 1)."""
    e = exponent(*a)
    return shift(a, -e), e


def displacement(start: Vector, end: Vector) -> tuple[Vector, int]:
    """Return end - start, scaled. One that overflows is taken again between the halves."""
    difference = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    if inf in map(abs, difference):
        half, e = displacement(shift(start, -1), shift(end, -1))
        return half, e + 1
    return scaled(difference)


def unscale(pairs: Pairs, e: int) -> Pairs:
    """Return the pairs with every t multiplied by 2^e."""
    return [(times(enter, e), times(leave, e)) for enter, leave in pairs]


def times(t: float, e: int) -> float:
    """Return t 2^e for t >= 0: infinite if that overflows, and never -0."""
    try:
        return ldexp(t, e) + 0.0
    except OverflowError:
        return inf


# ---- to here ----------------------------------------------------------------------------------


class Unsupported(Exception):
    """A solid of a type that this client does not know."""


VECTORS = {
    "half_space": ("point", "normal"),
    "sphere": ("center",),
    "infinite_cylinder": ("p", "q"),
    "slab": ("p", "q"),
    "cylinder": ("p", "q"),
}
ROUND = ("sphere", "infinite_cylinder", "cylinder")
TREES = ("union", "intersection", "difference")


def real(value: object) -> float:
    """Return a number of the line. They are floats already: see `parse_int` below."""
    if not isinstance(value, float) or not abs(value) < inf:
        raise ValueError(f"not a finite number: {value!r:.40}")
    return value


def vector(value: list[object]) -> Vector:
    """Return three numbers of the line."""
    x, y, z = map(real, value)
    return x, y, z


def read_solid(form: dict[str, Any]) -> Solid:
    """Return the solid that is asked about. What is missing in it raises."""
    kind = form["type"]
    if kind in TREES:
        if not form["of"]:
            raise ValueError(f"{kind} of nothing")
        return {"type": kind, "of": [read_solid(part) for part in form["of"]]}
    if kind not in VECTORS:
        raise Unsupported(f"solid type {kind!r:.40}")
    solid = {"type": kind} | {name: vector(form[name]) for name in VECTORS[kind]}
    return solid | {"radius": real(form["radius"])} if kind in ROUND else solid


def answer(line: bytes) -> dict[str, Any]:
    """Return the reply to one line. A case that cannot be answered is no reason to stop."""
    reply: dict[str, Any] = {}
    try:
        form = json.loads(line, parse_int=float)
        if "hello" in form:
            return HELLO
        reply["id"] = form["id"]
        solid, ray = read_solid(form["solid"]), form["ray"]
        pairs = intersect(solid, (vector(ray["origin"]), vector(ray["direction"])))
        reply["intervals"] = [[t if t < inf else None for t in pair] for pair in pairs]
    except Unsupported as what:
        reply["unsupported"] = str(what)
    except Exception as error:  # whatever it was, the next case may be answered
        reply["error"] = f"{type(error).__name__}: {error}"
    return reply


if __name__ == "__main__":
    for line in sys.stdin.buffer:
        print(json.dumps(answer(line)), flush=True)
