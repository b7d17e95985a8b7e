"""The loops of the compiled engine: a chunk of rays at a time, in rows of one flat buffer.

Each loop applies functions of `decide` to lanes side by side, without a branch, reads and writes
rows of the same buffer at constant distances: so a compiler makes vector code of it. Between the
float64 loops and the double-double ones the lanes that are left are moved together. The row of
constants is `Plan.constants`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from raycert.oracle.batch.arithmetic import choose, size, two_sum
from raycert.oracle.batch.decide import (
    LEAST,
    MOST,
    behind_ball,
    behind_wall,
    curved,
    half_space,
    joined,
    passed_half_space,
    passed_slab,
    slab,
)
from raycert.oracle.batch.formulas import ball, gap_ball, gap_wall, wall

WIDTH = 128
ROWS = 24
SPEED = 2.0**64
BACK, PASSED, FIRST, SECOND = 6 * WIDTH, 7 * WIDTH, 8 * WIDTH, 13 * WIDTH
"""Where in the buffer: origin and direction in six rows, then these; five rows for each list."""


def fields(k: Any) -> tuple[Any, ...]:
    """Return the constants: p, q, w, its size, r^2, r^2 |w|^2, |w|, and what is kept."""
    w = (k[6], k[9]), (k[7], k[10]), (k[8], k[11])
    rr, cap, root_w = (k[13], k[14]), (k[15], k[16]), (k[17], k[18])
    return (k[0], k[1], k[2]), (k[3], k[4], k[5]), w, k[12], rr, cap, root_w, (k[22], k[23], k[24])


def heads(b: Any, i: int, p: Any, keep: Any) -> Any:
    """Return u - p rounded, 0 where not kept."""
    return (
        (b[i] - p[0]) * keep[0],
        (b[WIDTH + i] - p[1]) * keep[1],
        (b[2 * WIDTH + i] - p[2]) * keep[2],
    )


def kept(a: Any, keep: float) -> Any:
    """Return a pair, or 0."""
    return a[0] * keep, a[1] * keep


def offset(b: Any, i: int, p: Any, keep: Any) -> Any:
    """Return u - p exactly, 0 where not kept."""
    return (
        kept(two_sum(b[i], -p[0]), keep[0]),
        kept(two_sum(b[WIDTH + i], -p[1]), keep[1]),
        kept(two_sum(b[2 * WIDTH + i], -p[2]), keep[2]),
    )


def speed(b: Any, i: int, keep: Any) -> Any:
    """Return the direction, 0 where not kept."""
    return b[3 * WIDTH + i] * keep[0], b[4 * WIDTH + i] * keep[1], b[5 * WIDTH + i] * keep[2]


def screen_ball(b: Any, k: Any, n: int) -> None:
    """Mark the lanes that certainly miss a sphere."""
    p, _, _, _, rr, cap, _, keep = fields(k)
    for i in range(n):
        y, v = heads(b, i, p, keep), speed(b, i, keep)
        gap, bound = gap_ball(y, v, rr[0])
        missed = (gap < -bound) | behind_ball(v, y, cap[0])
        b[PASSED + i] = choose(missed & (b[PASSED + i] == 2.0), 0.0, b[PASSED + i])


def screen_wall(b: Any, k: Any, n: int) -> None:
    """Mark the lanes that certainly miss a tilted cylinder."""
    p, _, w, wm, rr, cap, _, keep = fields(k)
    axis = (w[0][0], w[1][0], w[2][0])
    for i in range(n):
        y, v = heads(b, i, p, keep), speed(b, i, keep)
        a, ea, gap, bound = gap_wall(y, v, axis, wm, rr[0])
        missed = (gap < -bound) | behind_wall(a, ea, y, axis, wm, cap[0])
        b[PASSED + i] = choose(missed & (b[PASSED + i] == 2.0), 0.0, b[PASSED + i])


def screen_half_space(b: Any, k: Any, n: int) -> None:
    """Mark the lanes that certainly miss a half-space, or never leave it."""
    _, q, w, wm, _, _, _, _ = fields(k)
    normal, every = (w[0][0], w[1][0], w[2][0]), (1.0, 1.0, 1.0)
    for i in range(n):
        y, v = heads(b, i, q, every), speed(b, i, every)
        state = passed_half_space(y, v, normal, wm)
        b[PASSED + i] = choose(b[PASSED + i] == 2.0, state, b[PASSED + i])


def screen_slab(b: Any, k: Any, n: int) -> None:
    """Mark the lanes that certainly miss a slab."""
    p, q, w, wm, _, _, _, _ = fields(k)
    normal, every = (w[0][0], w[1][0], w[2][0]), (1.0, 1.0, 1.0)
    for i in range(n):
        v = speed(b, i, every)
        missed = passed_slab(heads(b, i, q, every), heads(b, i, p, every), v, normal, wm)
        b[PASSED + i] = choose(missed & (b[PASSED + i] == 2.0), 0.0, b[PASSED + i])


def write(b: Any, at: int, ends: Any) -> None:
    """Write a list's five numbers."""
    b[at], b[at + WIDTH], b[at + 2 * WIDTH] = ends[0], ends[1], ends[2]
    b[at + 3 * WIDTH], b[at + 4 * WIDTH] = ends[3], ends[4]


def read(b: Any, at: int) -> Any:
    """Return a list's five numbers."""
    return b[at], b[at + WIDTH], b[at + 2 * WIDTH], b[at + 3 * WIDTH], b[at + 4 * WIDTH]


def solve_ball(b: Any, k: Any, n: int) -> None:
    """Solve the lanes of a sphere."""
    p, _, _, _, rr, _, root_w, keep = fields(k)
    for i in range(n):
        v = speed(b, i, keep)
        terms = ball(offset(b, i, p, keep), v, rr)
        write(b, FIRST + i, curved(terms, root_w, b[BACK + i], size(v)))


def solve_wall(b: Any, k: Any, n: int) -> None:
    """Solve the lanes of a tilted cylinder."""
    p, _, w, wm, rr, cap, root_w, keep = fields(k)
    for i in range(n):
        v = speed(b, i, keep)
        terms = wall(offset(b, i, p, keep), v, w, wm, rr, cap)
        write(b, FIRST + i, curved(terms, root_w, b[BACK + i], size(v)))


def solve_half_space(b: Any, k: Any, n: int) -> None:
    """Solve the lanes of a half-space."""
    _, q, w, wm, _, _, _, _ = fields(k)
    every = (1.0, 1.0, 1.0)
    for i in range(n):
        found = half_space(offset(b, i, q, every), speed(b, i, every), w, wm, b[BACK + i])
        write(b, FIRST + i, found)


def solve_slab(b: Any, k: Any, n: int) -> None:
    """Solve the lanes of a slab, into the second list."""
    p, q, w, wm, _, _, _, _ = fields(k)
    every = (1.0, 1.0, 1.0)
    for i in range(n):
        y, x = offset(b, i, q, every), offset(b, i, p, every)
        write(b, SECOND + i, slab(y, x, speed(b, i, every), w, wm, b[BACK + i]))


def join(b: Any, n: int) -> None:
    """Intersect the two lists of each lane."""
    for i in range(n):
        write(b, FIRST + i, joined(read(b, FIRST + i), read(b, SECOND + i)))


def move_second(b: Any, n: int) -> None:
    """Take the second list of each lane as the first."""
    for i in range(n):
        write(b, FIRST + i, read(b, SECOND + i))


def held(b: Any, raw: Any, at: int, i: int, low: float, high: float) -> Any:
    """Tell whether a scaled number of the buffer is in range, or was 0 from the first."""
    x = abs(b[at * WIDTH + i])
    return ((x >= low) & (x <= high)) | (raw[at * WIDTH + i] == 0.0)


def odd(raw: Any, i: int) -> Any:
    """Tell whether a direction is so long or short that it is scaled."""
    fastest = abs(raw[3 * WIDTH + i])
    fastest = choose(abs(raw[4 * WIDTH + i]) > fastest, abs(raw[4 * WIDTH + i]), fastest)
    fastest = choose(abs(raw[5 * WIDTH + i]) > fastest, abs(raw[5 * WIDTH + i]), fastest)
    return (fastest > SPEED) | ((fastest < 1.0 / SPEED) & (fastest > 0.0))


def slowed(b: Any, raw: Any, i: int) -> None:
    """Scale a direction by the power of two that makes its largest part about 1."""
    x, y, z = raw[3 * WIDTH + i], raw[4 * WIDTH + i], raw[5 * WIDTH + i]
    power = math.frexp(max(abs(x), abs(y), abs(z)))[1] - 1
    factor = math.ldexp(1.0, -min(max(power, -1000), 1000))
    b[3 * WIDTH + i], b[4 * WIDTH + i], b[5 * WIDTH + i] = x * factor, y * factor, z * factor
    b[BACK + i] *= factor


def load(b: Any, raw: Any, rays: Any, begin: int, n: int, k: Any) -> None:
    """Take rays into the buffer, scaled, and unscaled into `raw`; mark those out of range."""
    stretch, low, high = k[19], k[20], k[21]
    for row in range(6):
        source, at, factor = rays[row], row * WIDTH, stretch if row < 3 else 1.0
        for i in range(n):
            raw[at + i] = source[begin + i]
        for i in range(n):
            b[at + i] = raw[at + i] * factor
    strange = 0
    for i in range(n):
        b[BACK + i] = 1.0 / stretch
        strange += choose(odd(raw, i), 1, 0)
    if strange:
        for i in range(n):
            if odd(raw, i):
                slowed(b, raw, i)
    for i in range(n):
        good = (b[BACK + i] >= LEAST) & (b[BACK + i] < MOST)
        good = good & held(b, raw, 0, i, low, high) & held(b, raw, 1, i, low, high)
        good = good & held(b, raw, 2, i, low, high) & held(b, raw, 3, i, low, high)
        good = good & held(b, raw, 4, i, low, high) & held(b, raw, 5, i, low, high)
        b[PASSED + i] = choose(good, 2.0, 3.0)


def screen(b: Any, k: Any, n: int, kind: int, planes: int) -> None:
    """Run the float64 rung of a kind: 0 no curved face, 1 a sphere, 2 a tilted cylinder."""
    if kind == 1:
        screen_ball(b, k, n)
    if kind == 2:
        screen_wall(b, k, n)
    if planes == 1:
        screen_half_space(b, k, n)
    if planes == 2:
        screen_slab(b, k, n)


def solve(b: Any, k: Any, n: int, kind: int, planes: int) -> None:
    """Run the double-double rung of a kind."""
    if kind == 1:
        solve_ball(b, k, n)
    if kind == 2:
        solve_wall(b, k, n)
    if planes == 1:
        solve_half_space(b, k, n)
    if planes == 2:
        solve_slab(b, k, n)
        if kind:
            join(b, n)
        else:
            move_second(b, n)


def run(rays: Any, k: Any, kind: int, planes: int, state: Any, rung: Any, ends: Any) -> None:
    """Write what the two fast rungs decide of rays given as six rows."""
    b, raw = np.zeros(ROWS * WIDTH), np.zeros(6 * WIDTH)
    lane = np.zeros(WIDTH, np.int64)
    for begin in range(0, rays.shape[1], WIDTH):
        n = min(WIDTH, rays.shape[1] - begin)
        load(b, raw, rays, begin, n, k)
        screen(b, k, n, kind, planes)
        left = 0
        for i in range(n):
            passed = b[PASSED + i]
            if passed < 2.0:
                state[begin + i] = int(passed)
                ends[0, begin + i] = 0.0
                ends[1, begin + i] = np.inf if passed == 1.0 else 0.0
                ends[2, begin + i] = ends[3, begin + i] = 2.0
            elif passed == 2.0:
                for row in range(7):
                    b[row * WIDTH + left] = b[row * WIDTH + i]
                lane[left] = begin + i
                left += 1
        solve(b, k, left, kind, planes)
        for i in range(left):
            state[lane[i]], rung[lane[i]] = int(b[FIRST + i]), 1
            for row in range(4):
                ends[row, lane[i]] = b[FIRST + (row + 1) * WIDTH + i]
