"""The batch oracle: `trace_batch`, exactly the scalar oracle's rounded lists, lane for lane.

A leaf's lanes are screened in float64, solved in double-double, then in exact zeros; trees
combine what is rounded. A lane that is still open, of a leaf or of the tree, is given to the
scalar oracle. All of it in blocks, so that memory is bounded by the answer and one block.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from raycert.cases.accept import Numbers
from raycert.cases.formats import BINARY32, BINARY64, Format
from raycert.cases.model import Leaf, Ray, Refused, Solid, Tree, leaves
from raycert.oracle.batch.booleans import Lists, combine, narrowed, set_aside
from raycert.oracle.batch.constants import LeafPlan, plan
from raycert.oracle.batch.engines import Engine, engine_of
from raycert.oracle.batch.lanes import HIT, INTEGER, RUNGS, UNSURE, Codes, Floats, Lanes, Outcomes
from raycert.oracle.batch.rational import rational
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import trace

BLOCK = 65536
Counts = NDArray[np.intp]
Columns = tuple[Counts, Floats, Floats]
"""Pairs of many lanes: the lane of each, or their number in each; enter; leave."""


@dataclass(frozen=True, slots=True)
class Batch:
    """The lists of all lanes: lane i has the pairs from `offsets[i]` to `offsets[i + 1]`.

    `rungs` counts, by rung, the lanes that it decided: `leaves` each lane of each leaf, `lanes`
    each ray by the highest rung that it needed. `engine` is the one that ran; `reason` says why a
    fast one did not, or why a leaf has no fast lane.
    """

    offsets: Counts
    enter: Floats
    leave: Floats
    leaves: dict[str, int]
    lanes: dict[str, int]
    engine: str
    reason: str = ""

    @property
    def counts(self) -> Counts:
        return np.diff(self.offsets)

    @property
    def rungs(self) -> dict[str, dict[str, int]]:
        return {"leaves": self.leaves, "lanes": self.lanes}

    def pairs(self, lane: int) -> Numbers:
        at = slice(self.offsets[lane], self.offsets[lane + 1])
        enter, leave = self.enter[at].tolist(), self.leave[at].tolist()
        return tuple(zip(enter, leave, strict=True))

    def padded(self, width: int | None = None) -> tuple[Floats, Floats]:
        """Return enter and leave as arrays (lanes, width), NaN where a lane has no such pair."""
        counts = self.counts
        width = int(counts.max(initial=0)) if width is None else width
        at = self.offsets[:-1, None] + np.arange(width)
        there = np.arange(width) < counts[:, None]
        result = np.full((2, *there.shape), np.nan)
        result[0][there], result[1][there] = self.enter[at[there]], self.leave[at[there]]
        return result[0], result[1]


def trace_batch(
    solid: Solid,
    origins: ArrayLike,
    directions: ArrayLike,
    fmt: Format = BINARY64,
    engine: str = "auto",
    block: int = BLOCK,
) -> Batch:
    """Return for each ray exactly `expected(trace(solid, ray).intervals, fmt)[1]`.

    `origins` and `directions` have shape (n, 3); what is not finite is refused with `Refused`.
    `engine` is `numpy`, `numba` (`ValueError` without it), or `auto`: numba if it is there. Memory
    is bounded by the answer and what `block` rays need. For a handful of rays the scalar oracle
    is as fast.

    >>> from raycert.cases.model import Sphere
    >>> u, v = [(-3, 0, 0), (0, 2, 0)], [(1, 0, 0), (1, 0, 0)]
    >>> found = trace_batch(Sphere((0, 0, 0), 1), u, v, engine="numpy")
    >>> found.pairs(0), found.pairs(1)
    (((2.0, 4.0),), ())
    """
    u, v = _vectors(origins, "origins"), _vectors(directions, "directions")
    if len(u) != len(v):
        raise Refused("directions", f"has {len(v)} rows, not {len(u)} as origins has")
    chosen = engine_of(engine)
    tracer = Blocks(solid, fmt, chosen)
    with np.errstate(all="ignore"):
        parts = [tracer.block(u[i : i + block], v[i : i + block]) for i in range(0, len(u), block)]
    none = [(np.zeros(1, np.intp), np.zeros(0), np.zeros(0))]  # offsets begin with 0
    counts, enter, leave = map(np.concatenate, zip(*none, *parts, strict=True))
    reasons = [chosen.reason, *(leaf.reason for leaf in tracer.plans.values())]
    return Batch(
        np.cumsum(counts),
        enter,
        leave,
        dict(zip(RUNGS, tracer.leaf_rungs.tolist(), strict=True)),
        dict(zip(RUNGS, tracer.lane_rungs.tolist(), strict=True)),
        chosen.name,
        "; ".join(dict.fromkeys(filter(None, reasons))),
    )


def _vectors(rows: ArrayLike, name: str) -> Floats:
    array = np.asarray(rows, np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise Refused(name, f"has shape {array.shape}, not (n, 3)")
    if not np.isfinite(array).all():
        raise Refused(name, "is not finite everywhere")
    return array


class Blocks:
    """A solid prepared for blocks of rays, each leaf once, and the counts of the rungs."""

    def __init__(self, solid: Solid, fmt: Format, engine: Engine) -> None:
        self.solid, self.fmt, self.engine = solid, fmt, engine
        self.plans: dict[Leaf, LeafPlan] = {leaf: plan(leaf) for _, leaf in leaves(solid)}
        self.leaf_rungs = np.zeros(len(RUNGS), np.intp)
        self.lane_rungs = np.zeros(len(RUNGS), np.intp)

    def block(self, u: Floats, v: Floats) -> Columns:
        """Return the number of pairs of each lane, and all pairs in order."""
        rays = np.empty((6, len(u)))
        rays[:3], rays[3:] = u.T, v.T
        lists, top = self._solve(self.solid, rays)
        pairs = lists.lane, lists.enter, lists.leave
        (left,) = np.nonzero(lists.open)
        if len(left):
            top = top.copy()
            top[left] = INTEGER
            sure = ~lists.open[lists.lane]
            pairs = lists.lane[sure], lists.enter[sure], lists.leave[sure]
        self.lane_rungs += tally(top)
        if self.fmt is BINARY32:
            pairs = narrowed(*pairs)
        if len(left):
            pairs = self._with_integers(u, v, left, pairs)
        return np.bincount(pairs[0], minlength=len(u)), *pairs[1:]

    def _solve(self, solid: Solid, rays: Floats) -> tuple[Lists, Codes]:
        """Return the lists of all lanes, and the highest rung that each took."""
        if isinstance(solid, Tree):
            parts = [self._solve(part, rays) for part in solid.of]
            top = np.maximum.reduce([rungs for _, rungs in parts])
            return combine(solid, [lists for lists, _ in parts]), top
        answer = self._leaf(self.plans[solid], rays)
        self.leaf_rungs += tally(answer.rung)
        (lane,) = np.nonzero(answer.state == HIT)
        lists = Lists(lane, answer.enter[lane], answer.leave[lane], answer.state == UNSURE)
        return lists, answer.rung

    def _leaf(self, leaf: LeafPlan, rays: Floats) -> Outcomes:
        """Return what the fast rungs decide; the rung of an open lane is `INTEGER`."""
        apart = set_aside if self.fmt is BINARY32 else lambda answer: None
        answer = self.engine.leaf_block(leaf, rays)
        apart(answer)
        (at,) = np.nonzero(answer.state == UNSURE)
        if len(at) and not leaf.reason and self.engine.trusted:
            lanes = Lanes.of(leaf, rays.take(at, axis=1))
            more = rational(leaf, lanes)
            apart(more)
            more.state[~lanes.in_range] = UNSURE
            answer.put(at, more)
        answer.rung[answer.state == UNSURE] = INTEGER
        return answer

    def _with_integers(self, u: Floats, v: Floats, left: Counts, sure: Columns) -> Columns:
        """Return all pairs in order of the lanes, those of open lanes from the scalar oracle."""
        solve = scalar(self.solid, self.fmt)
        more = [(i, *pair) for i in left.tolist() for pair in solve(u[i].tolist(), v[i].tolist())]
        columns = np.array(more, float).reshape(-1, 3).T
        lane = np.concatenate([sure[0], columns[0].astype(np.intp)])
        order = np.argsort(lane, kind="stable")
        enter, leave = (np.concatenate([sure[i], columns[i]])[order] for i in (1, 2))
        return lane[order], enter, leave


def tally(rungs: Codes) -> Counts:
    return np.array([np.count_nonzero(rungs == i) for i in range(len(RUNGS))])


def scalar(solid: Solid, fmt: Format) -> Callable[[list[float], list[float]], Numbers]:
    """Return the scalar oracle's answer as a function of a ray's origin and direction."""

    def solve(u: list[float], v: list[float]) -> Numbers:
        return expected(trace(solid, Ray((u[0], u[1], u[2]), (v[0], v[1], v[2]))).intervals, fmt)[1]

    return solve
