"""What decides a lane, each with its bound: in float64, and the same in double-double.

With a ray y + t v in the frame of the solid, y = u - p:

    a, g    sphere: v, y        cylinder: v x w, y x w
    A, B, C = a.a, a.g, g.g - R, R = r^2 |w|^2 (sphere: r^2):    |g + t a|^2 <= R
    G       sphere: r^2 A - |y x v|^2        cylinder: r^2 A - (y.a)^2
    D       B^2 - A C = |w|^2 G  (sphere: G), by Lagrange's identity

G has no cancellation that the distance of the origin makes. Roots are -(B +- sqrt D) / A: with
q = |B| + sqrt D, which does not cancel, they are q / A (`far`) and C / q (`near`) but for signs.
A plane is c + b t <= 0 with c = y.n, b = v.n. No branches here: arrays and compiled lanes both.

Every rounding error is bounded, for doubles and for pairs of them by the same functions.
With `unit` = u = 2^-53 they bound a formula in float64, with `unit` = u^2 the same formula in
double-double. The constants are those of the worse of the two:

    cross   a part is a difference of two products of numbers at most a and b. In double-double,
            9 u^2 of 2 a b (`arithmetic.cross`). In float64 two products and a difference, 2 u, and
            the parts themselves rounded once, u each: 4 u of 2 a b.                CROSS = 20 > 18
    dot     three products and two sums: 12 u^2 of 3 a b in double-double; in float64 3 u, and one
            u for a rounded part: 4 u of 3 a b.                                     DOT = 40 > 36
    less    x - y, with products of one rounding more each: 3.1 u^2 for the difference, 5 for a
            product, 1 for a constant of the plan, or 3 u.                          LESS = 12 > 9.1
    root    6 u^2, or one u.                                                        ROOT = 8
    over    16 u^2, or one u.                                                       OVER = 18

A size passed here is a leading double: the number itself exceeds it by a factor of 1 + u at most.
The bounds are sums and products of numbers >= 0 in float64, with fewer than 100 roundings, each of
a factor 1 +- u: that, and that 1 / (x - e) exceeds 1 / x, is what `SLACK` is for. `SMALL` is
a precondition: what is divided by exceeds its error 2^10 times, so 1 / (x - e) <= 1.001 / x.

Preconditions, held by `constants` for the solid and `Lanes.of` for the ray: a number that enters is
0 or between 2^-100 and 2^100 (for planes 2^-400 and 2^400). Then all are multiples of 2^-152; a
form of degree 2 in lengths, 2 in the direction and 2 in the axis is one of 2^-912, so that no
product underflows, nor its error; and none exceeds 2^610. A plane's numbers are multiples of 2^-452
and 2^-152, its forms of 2^-604.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from raycert.oracle.batch.arithmetic import (
    Number,
    Pair,
    Singles,
    Triple,
    add,
    choose,
    cross,
    cross_scaled,
    div,
    dot,
    dot_scaled,
    dot_single,
    heads,
    mul,
    root,
    size,
    sub,
)

U = 2.0**-53
UU = 2.0**-106
CROSS, DOT, LESS, ROOT, OVER = 20.0, 40.0, 12.0, 8.0, 18.0
SLACK = 1.125
SMALL = 2.0**-10


def cross_bound(unit: float, a: Number, b: Number) -> Number:
    """Return the error of a part of a cross product of exact vectors of sizes a and b."""
    return (CROSS * unit) * a * b


def dot_bound(unit: float, a: Number, ea: Number, b: Number, eb: Number) -> Number:
    """Return the error of a dot product of vectors of sizes a and b, parts within ea and eb."""
    return 3.0 * (a * eb + ea * (b + eb)) + (DOT * unit) * a * b


def square_bound(unit: float, a: Number, ea: Number) -> Number:
    """Return the error of the square of a vector of size a, parts within ea."""
    return 3.0 * ea * (2.0 * a + ea) + (DOT * unit) * a * a


def less_bound(unit: float, x: Number, ex: Number, y: Number, ey: Number) -> Number:
    """Return the error of x - y, x and y >= 0 products within ex and ey before they round."""
    return ex + ey + (LESS * unit) * (x + y)


def root_bound(unit: float, x: Number, s: Number, ex: Number) -> Number:
    """Return the error of s = sqrt(x): |sqrt(x) - sqrt(x')| <= |x - x'| / sqrt(x)."""
    return ex / s + (ROOT * unit) * s


def over_bound(unit: float, t: Number, ex: Number, y: Number, ey: Number) -> Number:
    """Return the error of t = x / y: (ex + |t| ey) / (|y| - ey), and its own rounding."""
    return (ex + abs(t) * ey) / y + (OVER * unit) * abs(t)


Bounded = tuple[Number, Number]
"""A float64 and the bound on its error."""
Bounded2 = tuple[Pair, Number]
"""A pair and the bound on its error."""


def cross_plain(a: Singles, b: Singles) -> Singles:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot_plain(a: Singles, b: Singles) -> Number:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def gap_ball(y: Singles, ym: Number, v: Singles, vm: Number, rr: Number) -> tuple[Any, ...]:
    """Return (G, its bound) in float64 of a sphere; y, rounded, and v with their sizes."""
    k = cross_plain(y, v)
    ek, km = cross_bound(U, ym, vm), size(k)
    aa, kk = dot_plain(v, v), dot_plain(k, k)
    bound = less_bound(U, rr * aa, rr * square_bound(U, vm, 0.0), kk, square_bound(U, km, ek))
    return rr * aa - kk, bound * SLACK


def gap_wall(
    y: Singles, ym: Number, a: Singles, am: Number, ea: Number, rr: Number
) -> tuple[Any, ...]:
    """Return (G, its bound) in float64 of a cylinder; y rounded, a within ea, and their sizes."""
    aa, det = dot_plain(a, a), abs(dot_plain(y, a))
    ed = dot_bound(U, ym, 0.0, am, ea)
    bound = less_bound(U, rr * aa, rr * square_bound(U, am, ea), det * det, ed * (2.0 * det + ed))
    return rr * aa - det * det, bound * SLACK


def start_plain(
    a: Singles, am: Number, ea: Number, g: Singles, gm: Number, eg: Number, cap: Number
) -> tuple[Any, ...]:
    """Return (B, its bound, C, its bound) in float64 from a, g, sizes and bounds; `cap` is R."""
    gg = dot_plain(g, g)
    return (
        dot_plain(a, g),
        dot_bound(U, am, ea, gm, eg) * SLACK,
        gg - cap,
        less_bound(U, gg, square_bound(U, gm, eg), cap, 0.0) * SLACK,
    )


def plane_plain(y: Singles, v: Singles, n: Singles, nm: float) -> tuple[Any, ...]:
    """Return (c, its bound, b, its bound) in float64 of a plane, y and n rounded."""
    ym, vm = size(y), size(v)
    return (
        dot_plain(y, n),
        dot_bound(U, ym, 0.0, nm, 0.0) * SLACK,
        dot_plain(v, n),
        dot_bound(U, vm, 0.0, nm, 0.0) * SLACK,
    )


def square(a: Triple, ea: Number) -> Bounded2:
    """Return a.a of a vector of parts within ea."""
    return dot(a, a), square_bound(UU, size(heads(a)), ea)


def excess(rr: Pair, aa: Bounded2, qq: Bounded2) -> Bounded2:
    first = mul(aa[0], rr)
    bound = less_bound(UU, first[0], rr[0] * aa[1], qq[0][0], qq[1])
    return sub(first, qq[0]), bound * SLACK


def ball(y: Triple, v: Singles, rr: Pair) -> tuple[Any, ...]:
    """Return (A, B, C, G) of a sphere, each a pair and its bound."""
    vm, ym = size(v), size(heads(y))
    aa = dot_single(v, v), square_bound(UU, vm, 0.0)
    gap = excess(rr, aa, square(cross_scaled(y, v), cross_bound(UU, ym, vm)))
    b = dot_scaled(y, v), dot_bound(UU, vm, 0.0, ym, 0.0) * SLACK
    return aa, b, constant((dot(y, y), square_bound(UU, ym, 0.0)), rr), gap


def wall(y: Triple, v: Singles, w: Triple, wm: float, rr: Pair, cap: Pair) -> tuple[Any, ...]:
    """Return (A, B, C, G) of a cylinder, each a pair and its bound; `cap` is R."""
    ym = size(heads(y))
    a, ea = cross_scaled(w, v), cross_bound(UU, wm, size(v))
    g, eg = cross(w, y), cross_bound(UU, wm, ym)
    am, gm = size(heads(a)), size(heads(g))
    aa = square(a, ea)
    det, ed = dot(y, a), dot_bound(UU, ym, 0.0, am, ea)
    gap = excess(rr, aa, (mul(det, det), ed * (2.0 * abs(det[0]) + ed)))
    b = dot(a, g), dot_bound(UU, am, ea, gm, eg) * SLACK
    return aa, b, constant(square(g, eg), cap), gap


def constant(gg: Bounded2, cap: Pair) -> Bounded2:
    """Return C = g.g - R."""
    return sub(gg[0], cap), less_bound(UU, gg[0][0], gg[1], cap[0], 0.0) * SLACK


def divisor(gap: Bounded2, root_w: Pair) -> Bounded2:
    """Return sqrt(D) = sqrt(|w|^2) sqrt(G), G > 0 certainly."""
    s = root(gap[0])
    es = root_bound(UU, gap[0][0], s[0], gap[1])
    return mul(s, root_w), (es + (ROOT * UU) * s[0]) * root_w[0]


def away(b: Bounded2, z: Bounded2) -> Bounded2:
    """Return q = |B| + sqrt(D): the sign is that of B's leading double, certain or not.

    With s that sign, q stands for s B + sqrt(D), whatever the true sign: the roots of the module's
    text are identities in s.
    """
    s = choose(b[0][0] < 0.0, -1.0, 1.0)
    q = add((s * b[0][0], s * b[0][1]), z[0])
    return q, b[1] + z[1] + (ROOT * UU) * q[0]


def ratio(x: Bounded2, y: Bounded2) -> Bounded2:
    """Return x / y, y > 0 certainly; no bound is given (NaN) where y is not `SMALL`'s."""
    t = div(x[0], y[0])
    bound = over_bound(UU, t[0], x[1], y[0][0], y[1]) * SLACK
    return t, choose(y[1] <= SMALL * y[0][0], bound, np.nan)


def plane(y: Triple, v: Singles, n: Triple, nm: float) -> tuple[Any, ...]:
    """Return (c, b) of a plane, each a pair and its bound."""
    c = dot(y, n), dot_bound(UU, size(heads(y)), 0.0, nm, 0.0) * SLACK
    return c, (dot_scaled(n, v), dot_bound(UU, size(v), 0.0, nm, 0.0) * SLACK)


def ends(t: Bounded2) -> tuple[Number, Number]:
    """Return two doubles between which t rounds to nearest: where they are equal, to it.

    The bound takes up u |l| <= u^2 |h| for the sum of l and it; what follows rounds monotonously.
    """
    (h, low), bound = t
    margin = bound + (2.0 * UU) * abs(h)
    return h + (low - margin), h + (low + margin)
