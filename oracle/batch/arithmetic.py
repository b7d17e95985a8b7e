"""Double-double arithmetic without branches: the same text runs on NumPy arrays and compiled lanes.

A pair (h, l) stands for h + l, with |l| <= u |h|, u = 2^-53; a triple is three pairs. `two_sum` and
`two_prod` are exact, with round to nearest and no under- or overflow; all else has a bound, in
units of u^2, which its docstring derives. So has no product anything but the one rounding that is
written: contraction of a * b + c must be off (`engines` looks). What is exact may be computed in
another way, and gives the same bits: the compiled engine has its own `two_prod`, by fma, and its
own `larger` and `choose`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

Number = Any
"""A float, or an array of them: one per lane."""
Pair = tuple[Number, Number]
Singles = tuple[Number, ...]
"""A vector: three numbers."""
Triple = tuple[Pair, ...]
"""A vector of three pairs."""

SPLITTER = 134217729.0
"""2^27 + 1 [Dekker 1971]."""


def two_sum(a: Number, b: Number) -> Pair:
    """Return a + b exactly [Knuth]."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def fast_two_sum(a: Number, b: Number) -> Pair:
    """Return a + b exactly, |a| >= |b| or a = 0 [Dekker]."""
    s = a + b
    return s, b - (s - a)


def two_prod(a: Number, b: Number) -> Pair:
    """Return a b exactly [Dekker, Veltkamp]; |a|, |b| < 2^990 and the error above 2^-1074."""
    p = a * b
    t = SPLITTER * a
    ah = t - (t - a)
    al = a - ah
    t = SPLITTER * b
    bh = t - (t - b)
    bl = b - bh
    return p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)


def larger(a: Number, b: Number) -> Number:
    """Return the larger of two numbers, neither NaN."""
    return np.maximum(a, b)


def choose(where: Any, a: Number, b: Number) -> Number:
    """Return a where that is so, else b."""
    return np.where(where, a, b)


def scale(a: Pair, b: Number) -> Pair:
    """Return a b, b a double, within 3 u^2 |a b|.

    l b rounds by u^2, its sum with the product's error by u (u + u) [DWTimesFP3 but for fma].
    """
    p, e = two_prod(a[0], b)
    return fast_two_sum(p, e + a[1] * b)


def mul(a: Pair, b: Pair) -> Pair:
    """Return a b within 5 u^2 |a b| [Joldes, Muller, Popescu 2017, algorithm 10; Muller, Rideau].

    al bl is left out, u^2; ah bl and al bh round by u^2 / 2 each, their sum and the last one more.
    """
    p, e = two_prod(a[0], b[0])
    return fast_two_sum(p, e + (a[0] * b[1] + a[1] * b[0]))


def add(a: Pair, b: Pair) -> Pair:
    """Return a + b within 3.1 u^2 (|a| + |b|), whatever cancels.

    al + bl rounds by u (u |a| + u |b|); its sum with the error of ah + bh by u times twice that.
    """
    s, e = two_sum(a[0], b[0])
    return two_sum(s, e + (a[1] + b[1]))


def sub(a: Pair, b: Pair) -> Pair:
    """Return a - b within 3.1 u^2 (|a| + |b|)."""
    s, e = two_sum(a[0], -b[0])
    return two_sum(s, e + (a[1] - b[1]))


def root(a: Pair) -> Pair:
    """Return the square root of a > 0 within 6 u^2 of it.

    One Newton step from s = sqrt(h): the rest a - s^2, at most 3 u a, rounds three times, by
    9 u^2 a in all, so 4.5 u^2 of the root; the step leaves out rest^2 / 8 s^3, 9/8 u^2.
    """
    s = np.sqrt(a[0])
    p, e = two_prod(s, s)
    rest = ((a[0] - p) - e) + a[1]
    return fast_two_sum(s, rest / (2.0 * s))


def div(a: Pair, b: Pair) -> Pair:
    """Return a / b within 16 u^2 of it [Joldes, Muller, Popescu 2017, algorithm 17: 15]."""
    t = a[0] / b[0]
    r = scale(b, t)
    return fast_two_sum(t, ((a[0] - r[0]) + (a[1] - r[1])) / b[0])


def dot(a: Triple, b: Triple) -> Pair:
    """Return a . b within 12 u^2 (|a1 b1| + |a2 b2| + |a3 b3|): a product, two sums."""
    return add(add(mul(a[0], b[0]), mul(a[1], b[1])), mul(a[2], b[2]))


def dot_scaled(a: Triple, b: Singles) -> Pair:
    """Return a . b, b in doubles, within 10 u^2 of the sum of its parts' sizes."""
    return add(add(scale(a[0], b[0]), scale(a[1], b[1])), scale(a[2], b[2]))


def dot_single(a: Singles, b: Singles) -> Pair:
    """Return a . b of doubles within 7 u^2 of the sum of its parts' sizes."""
    return add(add(two_prod(a[0], b[0]), two_prod(a[1], b[1])), two_prod(a[2], b[2]))


def cross(a: Triple, b: Triple) -> Triple:
    """Return a x b, each part within 9 u^2 of the sum of its two products' sizes."""
    return (
        sub(mul(a[1], b[2]), mul(a[2], b[1])),
        sub(mul(a[2], b[0]), mul(a[0], b[2])),
        sub(mul(a[0], b[1]), mul(a[1], b[0])),
    )


def cross_scaled(a: Triple, b: Singles) -> Triple:
    """Return a x b, b in doubles, each part within 7 u^2 of the sum of its products' sizes."""
    return (
        sub(scale(a[1], b[2]), scale(a[2], b[1])),
        sub(scale(a[2], b[0]), scale(a[0], b[2])),
        sub(scale(a[0], b[1]), scale(a[1], b[0])),
    )


def heads(a: Triple) -> Singles:
    """Return the leading doubles."""
    return a[0][0], a[1][0], a[2][0]


def minus(u: Singles, p: Singles) -> Singles:
    """Return u - p, rounded."""
    return u[0] - p[0], u[1] - p[1], u[2] - p[2]


def offset(u: Singles, p: Singles) -> Triple:
    """Return u - p exactly."""
    return two_sum(u[0], -p[0]), two_sum(u[1], -p[1]), two_sum(u[2], -p[2])


def size(a: Singles) -> Number:
    """Return the largest absolute part."""
    return larger(larger(abs(a[0]), abs(a[1])), abs(a[2]))


def probe(x: Any) -> Any:
    """Return what an engine makes of [1 + 2^-30, 2^-53, 2^-1074, 3, 1e300, 1 + 2^-52]."""
    one, half, least, three, large, next_ = x[0], x[1], x[2], x[3], x[4], x[5]
    p, e = two_prod(one, one)
    s, r = two_sum(1.0 + 0.0 * one, half)
    third = div((three, 0.0 * three), (next_, 0.0 * next_))
    product = mul(third, (next_, 0.0 * next_))
    two = root((three, 0.0 * three))
    square = mul(two, two)
    return (
        p,
        e,
        one * one - (1.0 + 2.0**-29),
        s,
        r,
        (1.0 + half) - 1.0,
        (next_ + half) - 1.0,
        (-1.0 - half) + 1.0,
        least * 1.0,
        (least * 2.0**600) * 2.0**-600,
        large * large,
        two_prod(large, 1.0 / large)[1] * 2.0**60,
        (product[0] - three) + product[1],
        (square[0] - three) + square[1],
        np.float64(np.float32(next_)) - 1.0,
        np.float64(np.float32(1.0 + 2.0**-24 + 0.0 * one)),
    )
