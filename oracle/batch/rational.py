"""The rational rung: ties, zeros and touches that exact sums of doubles decide.

An expansion is a list of arrays whose exact sum is meant. Nothing here rounds what it decides on:
`two_sum` and `two_prod` are exact in the range that `formulas` states. Every test is "certainly 0"
or "not known": parts that are no single double are not looked into.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.arithmetic import (
    Number,
    Pair,
    Singles,
    Triple,
    heads,
    offset,
    size,
    two_prod,
    two_sum,
)
from raycert.oracle.batch.constants import PLANES, WALL, LeafPlan
from raycert.oracle.batch.decide import FAR, LEAST, MOST, NEAR, joined, rounded
from raycert.oracle.batch.formulas import Bounded2, away, ball, divisor, ends, plane, ratio, wall
from raycert.oracle.batch.lanes import HIT, KNOWN, MISS, RATIONAL, Floats, Lanes, Mask, Outcomes

Terms = list[Number]


def grown(terms: Terms) -> Terms:
    """Return an expansion of the same sum whose parts do not overlap [Shewchuk 1997, theorem 10].

    It is 0 exactly where all of its parts are.
    """
    parts: Terms = []
    for term in terms:
        rest = term
        for i, part in enumerate(parts):
            rest, parts[i] = two_sum(rest, part)
        parts.append(rest)
    return parts


def vanishes(terms: Terms) -> Mask:
    zero: Mask = np.logical_and.reduce([part == 0 for part in grown(terms)])
    return zero


def single(terms: Terms) -> tuple[Number, Mask]:
    """Return a sum as one double, and where that is all of it."""
    parts = grown(terms)
    total = sum(parts[1:], parts[0])
    return total, vanishes([*parts, -total])


def products(a: Pair, b: Pair) -> Terms:
    """Return a b exactly, leaving out what is 0 in every lane."""
    terms: Terms = []
    for x in a:
        for y in b:
            if np.any(x) and np.any(y):
                terms += two_prod(x, y)
    return terms


def dot_terms(a: Triple, b: Triple) -> Terms:
    return [0.0 * a[0][0], *(term for i in range(3) for term in products(a[i], b[i]))]


def singles(sums: Iterable[Terms]) -> tuple[Triple, Mask]:
    """Return three sums as one double each, and where that is all of them."""
    values, whole = zip(*map(single, sums), strict=True)
    return paired(values), np.logical_and.reduce(whole)


def cross_singles(a: Triple, b: Triple) -> tuple[Triple, Mask]:
    """Return a x b, and where each part of it is one double."""
    minus = [(-high, -low) for high, low in a]
    return singles(
        [0.0 * a[0][0], *products(a[j], b[k]), *products(minus[k], b[j])]
        for j, k in ((1, 2), (2, 0), (0, 1))
    )


def square_terms(a: Iterable[Number]) -> Terms:
    return [term for x in a for term in two_prod(x, x)]


def paired(v: Singles) -> Triple:
    return tuple((x, 0.0 * x) for x in v)


class Zeros:
    """The exact numbers of a curved face's lanes, for the tests."""

    def __init__(self, plan: LeafPlan, lanes: Lanes) -> None:
        u, self.v, points = lanes.ray(plan, plan.keep)
        self.y = offset(u, points[0])
        self.plan, self.tilted = plan, plan.kind == WALL
        self.w = constants(plan, len(lanes.back))

    def still(self) -> Mask:
        """Where the ray certainly runs along the axis, or stands still: A = 0."""
        if not self.tilted:
            return np.asarray(size(self.v) == 0)
        a, whole = cross_singles(paired(self.v), self.w)
        zero: Mask = whole & (size(heads(a)) == 0)
        return zero

    def on_face(self, at: NDArray[np.intp], high: Floats, low: Floats) -> Mask:
        """Of which lanes the point at t is certainly on the face."""
        point, whole = along(some(self.y, at), heads(some(paired(self.v), at)), high, low)
        if not self.tilted:
            r = np.full_like(high, self.plan.radius)
            p, e = two_prod(r, r)
            return whole & vanishes([*square_terms(x for x, _ in point), -p, -e])
        g, also = cross_singles(point, some(self.w, at))
        cap = [np.full_like(high, -x) for x in self.plan.cap]
        return whole & also & self.plan.exact & vanishes([*square_terms(x for x, _ in g), *cap])

    def at_start(self) -> Mask:
        """Where C = 0."""
        zero = np.zeros_like(self.v[0])
        return self.on_face(np.arange(len(zero)), zero, zero)

    def touching(self) -> Mask:
        """Where G = 0. A direction along a coordinate axis is taken as a unit vector."""
        count = sum((x != 0).astype(int) for x in self.v)
        x, y, z = (np.where(count == 1, np.sign(part), part) for part in self.v)
        v = paired((x, y, z))
        if self.tilted:
            a, whole = cross_singles(v, self.w)
            det, also = single(dot_terms(self.y, a))
            k = [det]
        else:
            a, whole = v, np.ones_like(self.v[0], bool)
            parts, also = cross_singles(self.y, v)
            k = [x for x, _ in parts]
        aa, known = single(square_terms(x for x, _ in a))
        rr = tuple(np.full_like(aa, x) for x in self.plan.rr)
        terms = [*products((rr[0], rr[1]), (-aa, 0.0 * aa)), *square_terms(k)]
        return whole & also & known & self.plan.exact & vanishes(terms)

    def square_on(self) -> Mask:
        """Where B = 0."""
        if not self.tilted:
            return vanishes(dot_terms(self.y, paired(self.v)))
        a, whole = cross_singles(paired(self.v), self.w)
        g, also = cross_singles(self.y, self.w)
        return whole & also & vanishes(dot_terms(a, g))


def along(y: Triple, v: Singles, high: Number, low: Number) -> tuple[Triple, Mask]:
    """Return y + t v, and where each part of it is one double."""
    speeds = zip(y, paired(v), strict=True)
    return singles([*start, *products((high, low), speed)] for start, speed in speeds)


def on_plane(y: Triple, v: Singles, w: Triple, high: Number, low: Number) -> Mask:
    """Where the point at t is certainly on a plane; where w has no part, none is looked at."""
    point, whole = along(masked(y, w), heads(masked(paired(v), w)), high, low)
    return whole & vanishes(dot_terms(point, w))


def some(a: Triple, at: NDArray[np.intp]) -> Triple:
    return tuple((high[at], low[at]) for high, low in a)


def masked(a: Triple, w: Triple) -> Triple:
    """Return a with 0 for the parts where w has none."""
    free = [(np.where(part[0] == 0, 0.0, 1.0), pair) for part, pair in zip(w, a, strict=True)]
    return tuple((high * keep, low * keep) for keep, (high, low) in free)


def constants(plan: LeafPlan, n: int) -> Triple:
    return tuple((np.full(n, high), np.full(n, low)) for high, low in plan.w)


OPEN = 2
"""A sign that is not known."""
End = tuple[Floats, Any, Any]
"""Endpoints rounded, where they certainly are, and their sides."""
Test = Callable[[NDArray[np.intp], Floats, Floats], Mask]
"""Of the lanes with these numbers, where is the point at t = high + low certainly on the face?"""


def signs(x: Bounded2, zero: Callable[[], Mask]) -> Any:
    """Return the signs of bounded pairs: 1, -1, 0 where the test finds it, else `OPEN`."""
    sign = np.where(x[0][0] > x[1], 1, np.where(x[0][0] < -x[1], -1, OPEN))
    if (sign == OPEN).any():
        sign = np.where((sign == OPEN) & zero(), 0, sign)
    return sign


def settle(t: Bounded2, back: Floats, test: Test, apart: Number) -> End:
    """Return endpoints rounded, which certainly are, and their sides: also ties the test finds.

    The face is met at the midpoint, and at t, at most one spacing of doubles away. The other
    root is further from t than `apart`: if that is more than two spacings, t is the midpoint.
    Its two neighbours' sum rounds as IEEE 754 rounds the tie. So it is for t and the double next
    to it, where that may be a midpoint of binary32.
    """
    value, sure, side = rounded(t, back)
    below, above = ends(t)
    half = 0.5 * (above - below)
    value = np.where(sure, value, (below + half) * back)
    fits = (below > NEAR) & (below < FAR) & (value >= LEAST) & (value < MOST)
    tied = ~sure & (np.nextafter(below, np.inf) == above) & (apart > 4.0 * half) & fits
    tied = _tested(tied, test, below, half)
    side = np.where(tied, np.sign((below - (below + half)) + half), side)
    met = sure & (side == 0) & (apart > 2.0**-50 * below)
    return value, sure | tied, np.where(_tested(met, test, below, 0.0 * below), KNOWN, side)


def _tested(where: Mask, test: Test, high: Floats, low: Floats) -> Mask:
    """Return which of the lanes where it is asked pass a test."""
    (at,) = np.nonzero(where)
    passed = np.zeros_like(where)
    if len(at):
        passed[at] = test(at, high[at], low[at])
    return passed


def solve_curved(plan: LeafPlan, lanes: Lanes) -> Outcomes:
    frame = Zeros(plan, lanes)
    if frame.tilted:
        terms = wall(frame.y, frame.v, plan.w, plan.size, plan.rr, plan.cap)
    else:
        terms = ball(frame.y, frame.v, plan.rr)
    found = Outcomes.unsure(len(lanes.back))
    still, start = frame.still(), signs(terms[2], frame.at_start)
    found.mark(still & (start == 1), MISS, RATIONAL)
    found.mark(still & ((start == 0) | (start == -1)), HIT, RATIONAL, np.inf)
    moving = ~still & (terms[0][0][0] > terms[0][1])
    turn, real = signs(terms[1], frame.square_on), signs(terms[3], frame.touching)
    found.mark(moving & ((real == -1) | ((start == 1) & (turn == 1))), MISS, RATIONAL)
    found.mark(moving & (start == 0) & ((turn == 0) | (turn == 1)), HIT, RATIONAL)
    _crossings(plan, lanes, frame, terms, (moving & (real == 1), start, turn), found)
    double = moving & (real == 0) & (start == 1) & (turn == -1)
    if double.any():  # D = 0, and the root -B / A ahead
        ahead = ratio(absolute(terms[1]), terms[0])
        touch = settle(ahead, lanes.back, frame.on_face, np.inf)
        _hit(found, double, touch, touch)
    return found


def _crossings(
    plan: LeafPlan, lanes: Lanes, frame: Zeros, terms: Any, known: Any, found: Outcomes
) -> None:
    """Write the lanes with A > 0 and D > 0 that have a root ahead."""
    (a, b, c, gap), (real, start, turn), back = terms, known, lanes.back
    if not real.any():
        return
    z = divisor(gap, plan.root_w)
    q = away(b, z)
    far, near = ratio(q, a), ratio(c, q)
    apart = np.where(z[1] < 0.25 * z[0][0], z[0][0] / a[0][0], 0.0)
    other = (-near[0][0], -near[0][1]), near[1]
    first = settle(near, back, frame.on_face, apart)
    last = settle(far, back, frame.on_face, apart)
    early = settle(other, back, frame.on_face, apart)
    (turn_size, bound), zero = absolute(b), nothing(len(back))
    chord = ratio(((2.0 * turn_size[0], 2.0 * turn_size[1]), 2.0 * bound), a)
    _hit(found, real & (start == 1) & (turn == -1), first, last)
    _hit(found, real & (start == -1) & (b[0][0] < 0), zero, last)
    _hit(found, real & (start == -1) & (b[0][0] >= 0), zero, early)
    at_0 = real & (start == 0) & (turn == -1)
    _hit(found, at_0, zero, settle(chord, back, frame.on_face, np.inf))


def nothing(n: int) -> End:
    """Return 0 as an endpoint, exactly."""
    return np.zeros(n), np.ones(n, bool), np.full(n, KNOWN)


def absolute(x: Bounded2) -> Bounded2:
    """Return |x|, but for a sign that is not certain."""
    s = np.copysign(1.0, x[0][0])
    return (s * x[0][0], s * x[0][1]), x[1]


def _hit(found: Outcomes, where: Mask, enter: End, leave: End) -> None:
    """Write a pair to the lanes where both of its endpoints are certain."""
    at = where & enter[1] & leave[1]
    found.mark(at, HIT, RATIONAL)
    found.enter[at], found.leave[at] = enter[0][at], leave[0][at]
    found.before[at], found.after[at] = enter[2][at], leave[2][at]


def solve_planes(plan: LeafPlan, lanes: Lanes) -> Outcomes:
    w = constants(plan, len(lanes.back))
    u, v, (p, q) = lanes.ray(plan)
    at_p, at_q = offset(u, p), offset(u, q)
    (c, b), (d, _) = (plane(y, v, plan.w, plan.size) for y in (at_q, at_p))
    climb = signs(b, lambda: vanishes(dot_terms(paired(v), w)))
    over = signs(c, lambda: vanishes(dot_terms(at_q, w)))
    above = signs(d, lambda: vanishes(dot_terms(at_p, w)))
    under = np.where(above == OPEN, OPEN, -above if plan.planes == 2 else -1)
    found = Outcomes.unsure(len(climb))
    found.mark((climb == 0) & ((over == 1) | (under == 1)), MISS, RATIONAL)
    found.mark((climb == 0) & (over <= 0) & (under <= 0), HIT, RATIONAL, np.inf)
    climbing, back = absolute(b), lanes.back

    def met(y: Triple, height: Bounded2) -> End:
        def on(at: NDArray[np.intp], high: Floats, low: Floats) -> Mask:
            start, way = some(y, at), heads(some(paired(v), at))
            return on_plane(start, way, some(w, at), high, low)

        return settle(ratio(absolute(height), climbing), back, on, np.inf)

    at_second, at_first = met(at_q, c), met(at_p, d)
    if plan.planes == 1:
        at_first = np.full(len(back), np.inf), *nothing(len(back))[1:]
    _passed(found, climb == 1, (under, at_first), (over, at_second), False)
    _passed(found, climb == -1, (over, at_second), (under, at_first), plan.planes == 1)
    return found


def _passed(found: Outcomes, moving: Mask, first: Any, last: Any, endless: bool) -> None:
    """Write the lanes that enter through one plane and leave through another, or never."""
    (behind, enter), (ahead, leave) = first, last
    found.mark(moving & (ahead == 1), MISS, RATIONAL)
    zero = nothing(len(behind))
    stop = tuple(np.where(ahead == 0, x, y) for x, y in zip(zero, leave, strict=True))
    stop = leave if endless else stop
    going = moving & (ahead <= 0)
    _hit(found, going & (behind <= 0), zero, stop)
    _hit(found, going & (behind == 1), enter, stop)


def rational(plan: LeafPlan, lanes: Lanes) -> Outcomes:
    if plan.kind == PLANES:
        return solve_planes(plan, lanes)
    found = solve_curved(plan, lanes)
    if plan.planes:
        return Outcomes.of(joined(found.ends, solve_planes(plan, lanes).ends), RATIONAL)
    return found
