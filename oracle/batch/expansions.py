"""Sums of doubles tested for zero, exactly: what the rational rung decides by.

An expansion is a list of arrays whose exact sum is meant. Nothing here rounds what it decides on:
`two_sum` and `two_prod` are exact in the range that `bounds` states.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from raycert.oracle.batch.arithmetic import Number, Pair, Singles, Triple, two_prod, two_sum
from raycert.oracle.batch.lanes import Mask

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
    """Tell where a sum is 0."""
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
    """Return a . b exactly."""
    return [0.0 * a[0][0], *(term for i in range(3) for term in products(a[i], b[i]))]


def cross_singles(a: Triple, b: Triple) -> tuple[Triple, Mask]:
    """Return a x b, and where each part of it is one double."""
    parts: list[Pair] = []
    whole = np.ones(np.shape(a[0][0]), bool)
    for j, k in ((1, 2), (2, 0), (0, 1)):
        minus = (-a[k][0], -a[k][1])
        value, held = single([0.0 * a[0][0], *products(a[j], b[k]), *products(minus, b[j])])
        parts.append((value, 0.0 * value))
        whole &= held
    return (parts[0], parts[1], parts[2]), whole


def square_terms(a: Iterable[Number]) -> Terms:
    """Return the sum of the squares of doubles exactly."""
    return [term for x in a for term in two_prod(x, x)]


def paired(v: Singles) -> Triple:
    """Return doubles as pairs."""
    return (v[0], 0.0 * v[0]), (v[1], 0.0 * v[1]), (v[2], 0.0 * v[2])
