"""From cases to arrays and back: the lanes of one shape together, trees by the algebra of lists."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raycert.cases.model import Difference, Intersection, Leaf, Solid, Tree, Union, leaves
from raycert.oracle.measure.methods.method import Answered, Case, answered
from raycert.oracle.measure.methods.vector.kernel import KINDS, Lanes
from raycert.oracle.zoo.tracer import Pairs, share, subtract, unite

Shape = tuple[object, ...]
COMBINE = {Union: unite, Intersection: share, Difference: subtract}


def shape(solid: Solid) -> Shape:
    """Return the types of a solid and its parts: what lanes have to share."""
    parts = solid.of if isinstance(solid, Tree) else ()
    return type(solid), *map(shape, parts)


def grouped(
    cases: Sequence[Case], key: Callable[[Solid], object]
) -> list[tuple[list[int], list[Case]]]:
    """Return the cases with equal keys together, each with its place."""
    groups: dict[object, list[int]] = {}
    for i, case in enumerate(cases):
        groups.setdefault(key(case.solid), []).append(i)
    return [(at, [cases[i] for i in at]) for at in groups.values()]


def scattered(
    cases: Sequence[Case],
    key: Callable[[Solid], object],
    solve: Callable[[list[Case]], list[Answered]],
) -> list[Answered]:
    """Return the answers in the order of the cases, solved group by group."""
    found: list[Answered] = [None] * len(cases)
    for at, group in grouped(cases, key):
        for i, answer in zip(at, solve(group), strict=True):
            found[i] = answer
    return found


def textbook(kind: str) -> Callable[[Sequence[Case]], list[Answered]]:
    """Return the `solve` of the textbook formula in arrays of a kind."""

    def solve(cases: Sequence[Case]) -> list[Answered]:
        return scattered(cases, shape, lambda group: _group(group, kind))

    return solve


def rays(cases: Sequence[Case]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return origins and directions, a row each."""
    return (
        np.array([case.ray.origin for case in cases]),
        np.array([case.ray.direction for case in cases]),
    )


def _group(cases: list[Case], kind: str) -> list[Answered]:
    lanes = Lanes(KINDS[kind], *rays(cases))
    columns: list[list[Leaf]] = [
        list(column)
        for column in zip(
            *([leaf for _, leaf in leaves(case.solid)] for case in cases), strict=True
        )
    ]
    spans = [tuple(x.tolist() for x in lanes.spans(column)) for column in columns]
    lists = [[_pairs(enter[i], leave[i]) for enter, leave in spans] for i in range(len(cases))]
    return [_answer(case.solid, parts) for case, parts in zip(cases, lists, strict=True)]


def _answer(solid: Solid, parts: list[Pairs]) -> Answered:
    if any(answered(pairs) is None for pairs in parts):
        return None
    return answered(_node(solid, iter(parts)))


def _pairs(enter: float, leave: float) -> Pairs:
    """Return a span as a list; NaN is kept, and is a failure."""
    return [] if enter > leave else [(enter, leave)]


def _node(solid: Solid, parts: Any) -> Pairs:
    if not isinstance(solid, Tree):
        found: Pairs = next(parts)
        return found
    return COMBINE[type(solid)]([_node(part, parts) for part in solid.of])


def padded(enter: Any, leave: Any, counts: Any) -> list[Answered]:
    """Return the lists of lanes from rows of pairs."""
    rows = zip(enter.tolist(), leave.tolist(), counts.tolist(), strict=True)
    return [answered(zip(a[:n], b[:n], strict=True)) for a, b, n in rows]
