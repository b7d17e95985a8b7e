"""What a batch costs without the lists of Python around it: the seconds of the call alone.

The arrays are made before and the answers left as arrays, as anybody would who has many rays.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any

from raycert.cases.model import leaves
from raycert.oracle.measure.methods.method import Case
from raycert.oracle.measure.methods.vector.batches import grouped, rays, shape
from raycert.oracle.measure.methods.vector.kernel import KINDS, Lanes

Call = Callable[[Any, Any, Any], object]


def seconds(call: Call) -> Callable[[Sequence[Case]], float]:
    """Return what times `call(solid, origins, directions)` over the rays of each solid."""

    def timed(cases: Sequence[Case]) -> float:
        work = [(group[0].solid, *rays(group)) for _, group in grouped(cases, lambda s: s)]
        began = perf_counter()
        for solid, origins, directions in work:
            call(solid, origins, directions)
        return perf_counter() - began

    return timed


def textbook_seconds(kind: str) -> Callable[[Sequence[Case]], float]:
    """Return what times the textbook in arrays; a tree costs its leaves, and not its algebra."""

    def timed(cases: Sequence[Case]) -> float:
        work = []
        for _, group in grouped(cases, shape):
            each = ([leaf for _, leaf in leaves(case.solid)] for case in group)
            work.append((Lanes(KINDS[kind], *rays(group)), list(zip(*each, strict=True))))
        began = perf_counter()
        for lanes, columns in work:
            for column in columns:
                lanes.spans(list(column))
        return perf_counter() - began

    return timed
