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

from raycert.oracle.batch.arithmetic import choose, size
from raycert.oracle.batch.decide import (
    LEAST,
    MOST,
    joined,
    screen_ball,
    screen_half_space,
    screen_slab,
    screen_wall,
    solve_ball,
    solve_half_space,
    solve_slab,
    solve_wall,
)

WIDTH = 128
ROWS = 24
SPEED = 2.0**64
BACK, PASSED, FIRST, SECOND = 6 * WIDTH, 7 * WIDTH, 8 * WIDTH, 13 * WIDTH
"""Where in the buffer: origin and direction in six rows, then these; five rows for each list."""
EVERY = (1.0, 1.0, 1.0)


def fields(k: Any) -> tuple[Any, ...]:
    """Return the two points, the numbers of the faces as `decide` has them, and what is kept."""
    w = (k[6], k[9]), (k[7], k[10]), (k[8], k[11])
    numbers = w, k[12], (k[13], k[14]), (k[15], k[16]), (k[17], k[18])
    return ((k[0], k[1], k[2]), (k[3], k[4], k[5])), numbers, (k[22], k[23], k[24])


def only(a: Any, keep: Any) -> Any:
    """Return a vector with 0 for the parts that are not kept."""
    return a[0] * keep[0], a[1] * keep[1], a[2] * keep[2]


def part(b: Any, i: int, keep: Any) -> Any:
    """Return three numbers, a row apart, of those that are kept."""
    return only((b[i], b[WIDTH + i], b[2 * WIDTH + i]), keep)


def screen_with(screen: Any, b: Any, k: Any, n: int, keep: Any) -> None:
    """Write what the float64 rung of a face is certain of to the lanes that are still open."""
    (p, q), numbers, _ = fields(k)
    points = only(p, keep), only(q, keep)
    for i in range(n):
        state = screen(part(b, i, keep), part(b, 3 * WIDTH + i, keep), points, numbers)
        b[PASSED + i] = choose(b[PASSED + i] == 2.0, state, b[PASSED + i])


def solve_with(solve: Any, b: Any, k: Any, n: int, keep: Any, at: int) -> None:
    """Write the list of each lane, as the double-double rung of a face has it."""
    (p, q), numbers, _ = fields(k)
    points = only(p, keep), only(q, keep)
    for i in range(n):
        u, v = part(b, i, keep), part(b, 3 * WIDTH + i, keep)
        write(b, at + i, solve(u, v, points, numbers, b[BACK + i]))


def write(b: Any, at: int, ends: Any) -> None:
    b[at], b[at + WIDTH], b[at + 2 * WIDTH] = ends[0], ends[1], ends[2]
    b[at + 3 * WIDTH], b[at + 4 * WIDTH] = ends[3], ends[4]


def read(b: Any, at: int) -> Any:
    return b[at], b[at + WIDTH], b[at + 2 * WIDTH], b[at + 3 * WIDTH], b[at + 4 * WIDTH]


def join(b: Any, n: int) -> None:
    for i in range(n):
        write(b, FIRST + i, joined(read(b, FIRST + i), read(b, SECOND + i)))


def inside(b: Any, raw: Any, at: int, i: int, low: float, high: float) -> Any:
    """Whether a scaled number of the buffer is in range, or was 0 from the first."""
    x = abs(b[at * WIDTH + i])
    return ((x >= low) & (x <= high)) | (raw[at * WIDTH + i] == 0.0)


def odd(raw: Any, i: int) -> Any:
    """Whether a direction is so long or short that it is scaled."""
    fastest = size(part(raw, 3 * WIDTH + i, EVERY))
    return (fastest > SPEED) | ((fastest < 1.0 / SPEED) & (fastest > 0.0))


def slow(b: Any, raw: Any, i: int) -> None:
    """Scale a direction by the power of two that makes its largest part about 1."""
    x, y, z = part(raw, 3 * WIDTH + i, EVERY)
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
    if strange:  # rare: the loop above stays one without branches
        for i in range(n):
            if odd(raw, i):
                slow(b, raw, i)
    for i in range(n):
        good = (b[BACK + i] >= LEAST) & (b[BACK + i] < MOST)
        good = good & inside(b, raw, 0, i, low, high) & inside(b, raw, 1, i, low, high)
        good = good & inside(b, raw, 2, i, low, high) & inside(b, raw, 3, i, low, high)
        good = good & inside(b, raw, 4, i, low, high) & inside(b, raw, 5, i, low, high)
        b[PASSED + i] = choose(good, 2.0, 3.0)  # 3.0: no rung looks at it, the integers do


def screen(b: Any, k: Any, n: int, kind: int, planes: int) -> None:
    if kind == 1:
        screen_with(screen_ball, b, k, n, fields(k)[2])
    if kind == 2:
        screen_with(screen_wall, b, k, n, EVERY)
    if planes == 1:
        screen_with(screen_half_space, b, k, n, EVERY)
    if planes == 2:
        screen_with(screen_slab, b, k, n, EVERY)


def solve(b: Any, k: Any, n: int, kind: int, planes: int) -> None:
    """Run the double-double rung: a curved face into the first list, planes into the second."""
    if kind == 1:
        solve_with(solve_ball, b, k, n, fields(k)[2], FIRST)
    if kind == 2:
        solve_with(solve_wall, b, k, n, EVERY, FIRST)
    if planes == 1:
        solve_with(solve_half_space, b, k, n, EVERY, SECOND)
    if planes == 2:
        solve_with(solve_slab, b, k, n, EVERY, SECOND)
    if kind and planes:
        join(b, n)


def run(rays: Any, k: Any, kind: int, planes: int, state: Any, rung: Any, ends: Any) -> None:
    """Write what the two fast rungs decide of rays given as six rows."""
    b, raw = np.zeros(ROWS * WIDTH), np.zeros(6 * WIDTH)
    lane = np.zeros(WIDTH, np.int64)
    answer = FIRST if kind else SECOND
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
            elif passed == 2.0:  # close ranks: lane i to place `left`, which is never beyond i
                for row in range(7):
                    b[row * WIDTH + left] = b[row * WIDTH + i]
                lane[left] = begin + i
                left += 1
        solve(b, k, left, kind, planes)
        for i in range(left):
            state[lane[i]], rung[lane[i]] = int(b[answer + i]), 1
            for row in range(4):
                ends[row, lane[i]] = b[answer + (row + 1) * WIDTH + i]
