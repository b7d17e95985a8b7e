"""The bounds on every rounding error, for doubles and for pairs of them by the same formulas.

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

Preconditions, held by `plan` for the solid and `scaling` for the ray: every number that enters is 0
or between 2^-100 and 2^100 (for planes 2^-400 and 2^400). Then all are multiples of 2^-152; a form
of degree 2 in lengths, 2 in the direction and 2 in the axis is one of 2^-912, so that no product
underflows, nor its error; and none exceeds 2^610. A plane's numbers are multiples of 2^-452
and 2^-152, its forms of 2^-604.
"""

from __future__ import annotations

from typing import Any

Number = Any

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
