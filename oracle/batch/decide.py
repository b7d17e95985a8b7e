"""What becomes of a lane, without branches: for arrays in `lanes`, and compiled in `chunks`.

States are 0.0 for a miss, 1.0 for one pair, 2.0 for not decided. An endpoint comes with its `side`:
1.0 or -1.0 where the exact endpoint certainly is above or below the rounded one, 0.0 where that is
not known.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from raycert.oracle.batch.arithmetic import Number, Singles, Triple, choose, larger, size
from raycert.oracle.batch.formulas import (
    Bounded2,
    U,
    away,
    cross_bound,
    cross_plain,
    divisor,
    ends,
    plane,
    plane_plain,
    ratio,
    start_plain,
)

LEAST, MOST = 2.0**-1021, 2.0**1023
"""Endpoints outside are left to the integers: scaling back could round."""
NEAR, FAR = 2.0**-900, 2.0**900
"""And scaled ones outside: their bounds, or the products that divide, could leave the range."""
Ends = tuple[Number, Number, Number, Number, Number]
"""State, enter, leave, and the sides of both."""


def behind_ball(v: Singles, y: Singles, cap: Number) -> Any:
    """Tell whether a sphere is certainly behind: B > 0, C > 0; y rounded."""
    b, eb, c, ec = start_plain(v, 0.0, y, (2.0 * U) * size(y), cap)
    return (b > eb) & (c > ec)


def behind_wall(a: Singles, ea: Number, y: Singles, n: Singles, wm: Number, cap: Number) -> Any:
    """Tell whether a cylinder is certainly behind: B > 0, C > 0; y and n rounded."""
    g, eg = cross_plain(y, n), cross_bound(U, size(y), wm)
    b, eb, c, ec = start_plain(a, ea, g, eg, cap)
    return (b > eb) & (c > ec)


def settled(t: Bounded2, back: Number) -> tuple[Number, Any, Number]:
    """Return an endpoint rounded, whether it certainly is, and its side."""
    below, above = ends(t)
    value = below * back
    rest = (t[0][0] - below) + t[0][1]
    side = choose(rest > t[1], 1.0, choose(rest < -t[1], -1.0, 0.0))
    fits = (below > NEAR) & (below < FAR) & (value >= LEAST) & (value < MOST)
    return value, (below == above) & fits, side


def curved(terms: Any, root_w: Any, back: Number, speed: Number) -> Ends:
    """Return what is certain of a curved face, from A, B, C, G and their bounds.

    `speed` is the size of the direction; where it is 0 the ray keeps its distance for ever.
    """
    a, b, c, gap = terms
    outside, inside = c[0][0] > c[1], c[0][0] < -c[1]
    missed = (gap[0][0] < -gap[1]) | (outside & ((b[0][0] > b[1]) | (speed == 0.0)))
    forever = inside & (speed == 0.0)
    real = (gap[0][0] > gap[1]) & (inside | (outside & (b[0][0] < -b[1])))
    q = away(b, divisor(gap, root_w))
    far, near = ratio(q, a), ratio(c, q)
    back_root = inside & (b[0][0] >= 0.0)
    high = choose(back_root, -near[0][0], far[0][0])
    low = choose(back_root, -near[0][1], far[0][1])
    leave, sure, after = settled(((high, low), choose(back_root, near[1], far[1])), back)
    enter, known, before = settled(near, back)
    hit = forever | (real & sure & (inside | known))
    state, leave = choose(missed, 0.0, choose(hit, 1.0, 2.0)), choose(forever, np.inf, leave)
    return state, choose(outside, enter, 0.0), leave, choose(outside, before, 0.0), after


def passed_half_space(y: Singles, v: Singles, n: Singles, nm: Number) -> Number:
    """Return the state that float64 is certain of, 1.0 where a half-space is never left."""
    c, ec, b, eb = plane_plain(y, v, n, nm)
    whole = choose((c < -ec) & (b < -eb), 1.0, 2.0)
    return choose((c > ec) & (b > eb), 0.0, whole)


def passed_slab(y: Singles, x: Singles, v: Singles, n: Singles, nm: Number) -> Any:
    """Tell whether a slab is certainly behind; y from the point q, x from p, both rounded."""
    c, ec, b, eb = plane_plain(y, v, n, nm)
    d, ed, _, _ = plane_plain(x, v, n, nm)
    return ((c > ec) & (b > eb)) | ((d < -ed) & (b < -eb))


def half_space(y: Triple, v: Singles, n: Triple, nm: Number, back: Number) -> Ends:
    """Return what is certain of a half-space: from 0 to c / -b, or from there for ever."""
    c, b = plane(y, v, n, nm)
    up, down = b[0][0] > b[1], b[0][0] < -b[1]
    s = choose(b[0][0] < 0.0, -1.0, 1.0)
    height, climb = (-s * c[0][0], -s * c[0][1]), (s * b[0][0], s * b[0][1])
    value, sure, side = settled(ratio((height, c[1]), (climb, b[1])), back)
    outside, inside = c[0][0] > c[1], c[0][0] < -c[1]
    still = abs(v[0] * n[0][0]) + abs(v[1] * n[1][0]) + abs(v[2] * n[2][0]) == 0.0
    forever = (down | still) & inside
    hit = forever | (((up & inside) | (down & outside)) & sure)
    state = choose((up | still) & outside, 0.0, choose(hit, 1.0, 2.0))
    enter = choose(down & outside, value, 0.0)
    return state, enter, choose(up, value, np.inf), choose(down, side, 0.0), choose(up, side, 0.0)


def slab(y: Triple, x: Triple, v: Singles, n: Triple, nm: Number, back: Number) -> Ends:
    """Return what is certain of a slab; y from the point q, x from p.

    The ray enters through one plane, `height` before it, and leaves through the other, `depth`
    before that, both over the speed |b|. A product of doubles in range is 0 only where it is
    exactly: so a ray along the planes of a slab square to a coordinate axis is known.
    """
    c, b = plane(y, v, n, nm)
    d, _ = plane(x, v, n, nm)
    moves = (b[0][0] > b[1]) | (b[0][0] < -b[1])
    up = b[0][0] > 0.0
    s = choose(up, 1.0, -1.0)
    height = (-s * choose(up, d[0][0], c[0][0]), -s * choose(up, d[0][1], c[0][1]))
    depth = (-s * choose(up, c[0][0], d[0][0]), -s * choose(up, c[0][1], d[0][1]))
    eh, ed = choose(up, d[1], c[1]), choose(up, c[1], d[1])
    climb = (s * b[0][0], s * b[0][1]), b[1]
    enter, known, before = settled(ratio((height, eh), climb), back)
    leave, sure, after = settled(ratio((depth, ed), climb), back)
    within, ahead = height[0] < -eh, height[0] > eh
    still = abs(v[0] * n[0][0]) + abs(v[1] * n[1][0]) + abs(v[2] * n[2][0]) == 0.0
    forever = still & (c[0][0] < -c[1]) & (d[0][0] > d[1])
    missed = (moves & (depth[0] < -ed)) | (still & ((c[0][0] > c[1]) | (d[0][0] < -d[1])))
    hit = forever | (moves & (depth[0] > ed) & sure & (within | (ahead & known)))
    state, leave = choose(missed, 0.0, choose(hit, 1.0, 2.0)), choose(forever, np.inf, leave)
    within = within | forever
    return state, choose(within, 0.0, enter), leave, choose(within, 0.0, before), after


def joined(one: Ends, two: Ends) -> Ends:
    """Return what is certain of the intersection of two lists of at most one pair.

    Rounding is monotone: the larger of two rounded numbers is the larger one rounded, and different
    ones decide. What is 0 is exactly 0.
    """
    late, early = two[1] > one[1], two[2] < one[2]
    enter, leave = larger(one[1], two[1]), choose(early, two[2], one[2])
    known = (one[0] == 1.0) & (two[0] == 1.0)
    hit = known & ((enter < leave) | ((enter == 0.0) & (leave == 0.0)))
    missed = (one[0] == 0.0) | (two[0] == 0.0) | (known & (enter > leave))
    state = choose(missed, 0.0, choose(hit, 1.0, 2.0))
    before = choose((two[1] == one[1]) & (two[3] != one[3]), 0.0, one[3])
    after = choose((two[2] == one[2]) & (two[4] != one[4]), 0.0, one[4])
    return state, enter, leave, choose(late, two[3], before), choose(early, two[4], after)
