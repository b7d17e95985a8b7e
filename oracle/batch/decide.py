"""What becomes of a lane, without branches: for arrays in `lanes`, and compiled in `chunks`.

States are 0.0 for a miss, 1.0 for one pair, 2.0 for not decided. An endpoint comes with its `side`:
1.0 or -1.0 where the exact endpoint certainly is above or below the rounded one, 0.0 where that is
not known.

`screen_*` is the float64 rung of a face and gives a state, `solve_*` the double-double one. Both
take a ray u + t v, the two points of the leaf, and its numbers `k`: the axis or normal w, its size,
r^2, r^2 |w|^2 and |w|, as `constants` prepares them.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from raycert.oracle.batch.arithmetic import (
    Number,
    Singles,
    choose,
    heads,
    larger,
    minus,
    offset,
    size,
)
from raycert.oracle.batch.formulas import (
    Bounded2,
    U,
    away,
    ball,
    cross_bound,
    cross_plain,
    divisor,
    ends,
    gap_ball,
    gap_wall,
    plane,
    plane_plain,
    ratio,
    start_plain,
    wall,
)

LEAST, MOST = 2.0**-1021, 2.0**1023
"""Endpoints outside are left to the integers: scaling back could round."""
NEAR, FAR = 2.0**-900, 2.0**900
"""And scaled ones outside: their bounds, or the products that divide, could leave the range."""
Ends = tuple[Number, Number, Number, Number, Number]
"""State, enter, leave, and the sides of both."""


def screen_ball(u: Singles, v: Singles, points: Any, k: Any) -> Any:
    """Return 0.0 where a sphere is missed or behind: G < 0, or B > 0 and C > 0; else 2.0."""
    _, _, rr, cap, _ = k
    y = minus(u, points[0])
    ym, vm = size(y), size(v)
    gap, bound = gap_ball(y, ym, v, vm, rr[0])
    b, eb, c, ec = start_plain(v, vm, 0.0, y, ym, (2.0 * U) * ym, cap[0])
    return choose((gap < -bound) | ((b > eb) & (c > ec)), 0.0, 2.0)


def screen_wall(u: Singles, v: Singles, points: Any, k: Any) -> Any:
    """Return the same of a cylinder; y and the axis are rounded."""
    w, wm, rr, cap, _ = k
    y, axis = minus(u, points[0]), heads(w)
    a, g, ym = cross_plain(v, axis), cross_plain(y, axis), size(y)
    am, ea, eg = size(a), cross_bound(U, size(v), wm), cross_bound(U, ym, wm)
    gap, bound = gap_wall(y, ym, a, am, ea, rr[0])
    b, eb, c, ec = start_plain(a, am, ea, g, size(g), eg, cap[0])
    return choose((gap < -bound) | ((b > eb) & (c > ec)), 0.0, 2.0)


def screen_half_space(u: Singles, v: Singles, points: Any, k: Any) -> Any:
    """Return 0.0 where a half-space is missed, 1.0 where it is never left, else 2.0."""
    c, ec, b, eb = plane_plain(minus(u, points[0]), v, heads(k[0]), k[1])
    whole = choose((c < -ec) & (b < -eb), 1.0, 2.0)
    return choose((c > ec) & (b > eb), 0.0, whole)


def screen_slab(u: Singles, v: Singles, points: Any, k: Any) -> Any:
    """Return 0.0 where a slab is behind, else 2.0."""
    p, q = points
    d, ed, _, _ = plane_plain(minus(u, p), v, heads(k[0]), k[1])
    c, ec, b, eb = plane_plain(minus(u, q), v, heads(k[0]), k[1])
    return choose(((c > ec) & (b > eb)) | ((d < -ed) & (b < -eb)), 0.0, 2.0)


def rounded(t: Bounded2, back: Number) -> tuple[Number, Any, Number]:
    """Return an endpoint rounded, whether it certainly is, and its side."""
    below, above = ends(t)
    value = below * back
    rest = (t[0][0] - below) + t[0][1]
    side = choose(rest > t[1], 1.0, choose(rest < -t[1], -1.0, 0.0))
    fits = (below > NEAR) & (below < FAR) & (value >= LEAST) & (value < MOST)
    return value, (below == above) & fits, side


def _curved(terms: Any, root_w: Any, back: Number, speed: Number) -> Ends:
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
    leave, sure, after = rounded(((high, low), choose(back_root, near[1], far[1])), back)
    enter, known, before = rounded(near, back)
    hit = forever | (real & sure & (inside | known))
    state, leave = choose(missed, 0.0, choose(hit, 1.0, 2.0)), choose(forever, np.inf, leave)
    return state, choose(outside, enter, 0.0), leave, choose(outside, before, 0.0), after


def solve_ball(u: Singles, v: Singles, points: Any, k: Any, back: Number) -> Ends:
    return _curved(ball(offset(u, points[0]), v, k[2]), k[4], back, size(v))


def solve_wall(u: Singles, v: Singles, points: Any, k: Any, back: Number) -> Ends:
    w, wm, rr, cap, root_w = k
    return _curved(wall(offset(u, points[0]), v, w, wm, rr, cap), root_w, back, size(v))


def solve_half_space(u: Singles, v: Singles, points: Any, k: Any, back: Number) -> Ends:
    """Return what is certain of a half-space: from 0 to c / -b, or from there for ever."""
    n = k[0]
    c, b = plane(offset(u, points[0]), v, n, k[1])
    up, down = b[0][0] > b[1], b[0][0] < -b[1]
    s = choose(b[0][0] < 0.0, -1.0, 1.0)
    height, climb = (-s * c[0][0], -s * c[0][1]), (s * b[0][0], s * b[0][1])
    value, sure, side = rounded(ratio((height, c[1]), (climb, b[1])), back)
    outside, inside = c[0][0] > c[1], c[0][0] < -c[1]
    still = abs(v[0] * n[0][0]) + abs(v[1] * n[1][0]) + abs(v[2] * n[2][0]) == 0.0
    forever = (down | still) & inside
    hit = forever | (((up & inside) | (down & outside)) & sure)
    state = choose((up | still) & outside, 0.0, choose(hit, 1.0, 2.0))
    enter = choose(down & outside, value, 0.0)
    return state, enter, choose(up, value, np.inf), choose(down, side, 0.0), choose(up, side, 0.0)


def solve_slab(u: Singles, v: Singles, points: Any, k: Any, back: Number) -> Ends:
    """Return what is certain of a slab.

    The ray enters through one plane, `height` before it, and leaves through the other, `depth`
    before that, both over the speed |b|. A product of doubles in range is 0 only where it is
    exactly: so a ray along the planes of a slab square to a coordinate axis is known.
    """
    p, q = points
    n = k[0]
    c, b = plane(offset(u, q), v, n, k[1])
    d, _ = plane(offset(u, p), v, n, k[1])
    moves = (b[0][0] > b[1]) | (b[0][0] < -b[1])
    up = b[0][0] > 0.0
    s = choose(up, 1.0, -1.0)
    height = (-s * choose(up, d[0][0], c[0][0]), -s * choose(up, d[0][1], c[0][1]))
    depth = (-s * choose(up, c[0][0], d[0][0]), -s * choose(up, c[0][1], d[0][1]))
    eh, ed = choose(up, d[1], c[1]), choose(up, c[1], d[1])
    climb = (s * b[0][0], s * b[0][1]), b[1]
    enter, known, before = rounded(ratio((height, eh), climb), back)
    leave, sure, after = rounded(ratio((depth, ed), climb), back)
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
