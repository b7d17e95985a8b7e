"""Endpoints as enclosures that carry their polynomial: order by the one, equality by the other.

Two enclosures that do not overlap are in order. Two that do are one number only if their
polynomials have a common root and both stand for it, which is decided in fractions; else they are
`Blurred`, and have to be computed again, more precisely.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cmp_to_key
from typing import Any

Box = Any
"""An interval of mpmath's context `iv`."""
Polynomial = tuple[Fraction, ...]
"""Coefficients from the highest power down, the first not zero."""


class Blurred(ArithmeticError):
    """Two numbers that are not equal, and whose enclosures overlap at this precision."""


@dataclass(frozen=True, slots=True, eq=False)
class End:
    """The `root`-th root of `polynomial`, which lies in `box`."""

    box: Box
    polynomial: Polynomial
    root: int


MaybeEnd = End | None
"""An end of an interval; None is infinity."""
Pair = tuple[End, MaybeEnd]


def compare(one: MaybeEnd, two: MaybeEnd) -> int:
    """Return the sign of one - two, infinity being equal to itself. Raises `Blurred`."""
    if one is None or two is None:
        return (one is None) - (two is None)
    if one.box < two.box:
        return -1
    if one.box > two.box:
        return 1
    if same(one, two):
        return 0
    raise Blurred


def sign(box: Box, exact: Fraction) -> int:
    """Return the sign of a number in `box`, zero only where `exact` is. Raises `Blurred`.

    `exact` is a positive multiple of the number; where the two have opposite signs, the formula and
    its polynomial differ, which raises a plain `ArithmeticError`.
    """
    if exact == 0:
        return 0
    if not (box > 0 or box < 0):
        raise Blurred
    if (box > 0) != (exact > 0):
        raise ArithmeticError(f"{box} is an enclosure of a number of the other sign")
    return 1 if box > 0 else -1


def same(one: End, two: End) -> bool:
    """Tell whether two ends are one number, by the greatest common divisor of the polynomials."""
    common = _gcd(one.polynomial, two.polynomial)
    if len(common) == 1:
        return False
    if len(common) == 2:
        rational = -common[1] / common[0]
        return _is(one, rational) and _is(two, rational)
    a, b, c = common
    return one.root == two.root or b * b == 4 * a * c


def _is(end: End, root: Fraction) -> bool:
    """Tell whether an end is this root of its polynomial."""
    if len(end.polynomial) == 2:
        return True
    other = -end.polynomial[1] / end.polynomial[0] - root
    return root == other or end.root == int(root > other)


def _gcd(one: Polynomial, two: Polynomial) -> Polynomial:
    """Return a greatest common divisor, by Euclid."""
    while two:
        one, two = two, _remainder(one, two)
    return one


def _remainder(one: Polynomial, two: Polynomial) -> Polynomial:
    """Return the remainder of one by two; () is zero."""
    rest = list(one)
    while len(rest) >= len(two):
        factor = rest[0] / two[0]
        for i, coefficient in enumerate(two):
            rest[i] -= factor * coefficient
        rest.pop(0)
    while rest and rest[0] == 0:
        rest.pop(0)
    return tuple(rest)


def distinct(ends: Iterable[End]) -> list[End]:
    """Return the ends in order, one for each number. Raises `Blurred`."""
    found: list[End] = []
    for end in sorted(ends, key=cmp_to_key(compare)):
        if not found or compare(found[-1], end):
            found.append(end)
    return found
