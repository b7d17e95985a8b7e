"""The rational rung: lanes that only an exact zero decides, and endpoints that are exact ties.

A sign that double-double leaves open is tested for 0 exactly; a rounding that it leaves open for
being exactly the midpoint: the residual of the face at the midpoint, in exact sums of doubles. The
tests answer "certainly 0" or "not known"; so lanes with few significant bits, and scenes along the
axes with all of theirs, are decided here, and never a wrong one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.oracle.batch.arithmetic import Number, Triple, heads
from raycert.oracle.batch.decide import FAR, LEAST, MOST, NEAR, joined, settled
from raycert.oracle.batch.expansions import dot_terms, paired, vanishes
from raycert.oracle.batch.formulas import Bounded2, away, ball, divisor, ends, plane, ratio, wall
from raycert.oracle.batch.frame import Frame, constants, on_plane, taken
from raycert.oracle.batch.lanes import HIT, KNOWN, MISS, RATIONAL, Floats, Found, Lanes, Mask
from raycert.oracle.batch.plan import PLANES, Plan
from raycert.oracle.batch.vector import ALL, offset, tilted

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
    value, sure, side = settled(t, back)
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


def solve_curved(plan: Plan, lanes: Lanes) -> Found:
    """Return what exact zeros decide of the curved face."""
    frame = Frame(plan, lanes)
    if tilted(plan):
        terms = wall(frame.y, frame.v, plan.w, plan.size, plan.rr, plan.cap)
    else:
        terms = ball(frame.y, frame.v, plan.rr)
    found = Found.unsure(len(lanes.held))
    still, start = frame.still(), signs(terms[2], frame.at_start)
    found.mark(still & (start == 1), MISS, RATIONAL)
    found.mark(still & ((start == 0) | (start == -1)), HIT, RATIONAL, np.inf)
    moving = ~still & (terms[0][0][0] > terms[0][1])
    turn, real = signs(terms[1], frame.square_on), signs(terms[3], frame.touching)
    found.mark(moving & ((real == -1) | ((start == 1) & (turn == 1))), MISS, RATIONAL)
    found.mark(moving & (start == 0) & ((turn == 0) | (turn == 1)), HIT, RATIONAL)
    _crossings(plan, lanes, frame, terms, (moving & (real == 1), start, turn), found)
    _touches(lanes, frame, terms, moving & (real == 0) & (start == 1) & (turn == -1), found)
    return found


def _crossings(
    plan: Plan, lanes: Lanes, frame: Frame, terms: Any, known: Any, found: Found
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


def _touches(lanes: Lanes, frame: Frame, terms: Any, at: Mask, found: Found) -> None:
    """Write the lanes with D = 0 and the double root -B / A ahead."""
    if not at.any():
        return
    a, b, _, _ = terms
    touch = settle(ratio(absolute(b), a), lanes.back, frame.on_face, np.inf)
    _hit(found, at, touch, touch)


def nothing(n: int) -> End:
    """Return 0 as an endpoint, exactly."""
    return np.zeros(n), np.ones(n, bool), np.full(n, KNOWN)


def absolute(x: Bounded2) -> Bounded2:
    """Return |x|, but for a sign that is not certain."""
    s = np.copysign(1.0, x[0][0])
    return (s * x[0][0], s * x[0][1]), x[1]


def _hit(found: Found, where: Mask, enter: End, leave: End) -> None:
    """Write a pair to the lanes where both of its endpoints are certain."""
    at = where & enter[1] & leave[1]
    found.mark(at, HIT, RATIONAL)
    found.enter[at], found.leave[at] = enter[0][at], leave[0][at]
    found.before[at], found.after[at] = enter[2][at], leave[2][at]


def solve_planes(plan: Plan, lanes: Lanes) -> Found:
    """Return what exact zeros decide of a half-space or slab."""
    w = constants(plan, len(lanes.held))
    at_q = offset(lanes, plan.second, ALL)
    at_p = offset(lanes, plan.first, ALL) if plan.planes == 2 else at_q
    (c, b), (d, _) = (plane(y, lanes.v, plan.w, plan.size) for y in (at_q, at_p))
    climb = signs(b, lambda: vanishes(dot_terms(paired(lanes.v), w)))
    over = signs(c, lambda: vanishes(dot_terms(at_q, w)))
    above = signs(d, lambda: vanishes(dot_terms(at_p, w)))
    under = np.where(above == OPEN, OPEN, -above if plan.planes == 2 else -1)
    found = Found.unsure(len(climb))
    found.mark((climb == 0) & ((over == 1) | (under == 1)), MISS, RATIONAL)
    found.mark((climb == 0) & (over <= 0) & (under <= 0), HIT, RATIONAL, np.inf)
    speed_, back = absolute(b), lanes.back

    def met(y: Triple, height: Bounded2) -> End:
        def on(at: NDArray[np.intp], high: Floats, low: Floats) -> Mask:
            v = heads(taken(paired(lanes.v), at))
            return on_plane(taken(y, at), v, taken(w, at), high, low)

        return settle(ratio(absolute(height), speed_), back, on, np.inf)

    q, p = met(at_q, c), met(at_p, d)
    if plan.planes == 1:
        p = np.full(len(back), np.inf), np.ones(len(back), bool), np.full(len(back), KNOWN)
    _passed(found, climb == 1, (under, p), (over, q), False)
    _passed(found, climb == -1, (over, q), (under, p), plan.planes == 1)
    return found


def _passed(found: Found, moving: Mask, first: Any, last: Any, endless: bool) -> None:
    """Write the lanes that enter through one plane and leave through another, or never."""
    (behind, enter), (ahead, leave) = first, last
    found.mark(moving & (ahead == 1), MISS, RATIONAL)
    zero = nothing(len(behind))
    stop = tuple(np.where(ahead == 0, x, y) for x, y in zip(zero, leave, strict=True))
    stop = leave if endless else stop
    going = moving & (ahead <= 0)
    _hit(found, going & (behind <= 0), zero, stop)
    _hit(found, going & (behind == 1), enter, stop)


def rational(plan: Plan, lanes: Lanes) -> Found:
    """Return what the rational rung decides of a leaf's lanes."""
    if plan.kind == PLANES:
        return solve_planes(plan, lanes)
    found = solve_curved(plan, lanes)
    if plan.planes:
        return Found.of(joined(found.ends, solve_planes(plan, lanes).ends), RATIONAL)
    return found
