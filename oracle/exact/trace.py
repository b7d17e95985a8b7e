"""The whole answer: the interval list of a solid along a ray, and the rows that gave it.

The case table is followed row by row: each decision names the row taken and the signs that
decided it, as they were found. Booleans combine the lists of their parts.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
)
from raycert.cases.table import (
    HALF_SPACE,
    PROBLEM_1,
    PROBLEM_2,
    PROBLEM_3,
    Row,
    Signs,
    comparison_names,
)
from raycert.oracle.exact.grid import Grid
from raycert.oracle.exact.intervals import (
    NOTHING,
    Intervals,
    intersection,
    subtract,
    union,
)
from raycert.oracle.exact.leaf import (
    Plane,
    Quadric,
    ball,
    capped,
    caps,
    half_space,
    plane_signs,
    wall,
)
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, sign

ENDS = {"0": ZERO, "inf": INFINITY}


class Decision(NamedTuple):
    """A row of the case table that was taken: where in the tree, and the signs that decided."""

    path: str
    row: Row
    signs: Signs

    @property
    def names(self) -> tuple[str, ...]:
        """Return the row's name and the comparisons of Problem 3, with the path in a tree."""
        prefix = f"{self.path}:" if self.path else ""
        return tuple(prefix + n for n in (self.row.name, *comparison_names(dict(self.signs))))


class Answer(NamedTuple):
    """The exact interval list, and the decisions that led to it, in the order they were made."""

    intervals: Intervals
    decisions: tuple[Decision, ...]

    @property
    def rows(self) -> tuple[str, ...]:
        return tuple(name for decision in self.decisions for name in decision.names)


def trace(solid: Solid, ray: Ray) -> Answer:
    """Return the exact answer for any ray and solid of the model; never refuses one.

    >>> from raycert.cases.model import Cylinder, Ray
    >>> answer = trace(Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 0, 1), (1, 0, 0)))
    >>> [(enter.rational(), leave.rational()) for enter, leave in answer.intervals]
    [(Fraction(2, 1), Fraction(4, 1))]
    >>> answer.rows
    ('through', 'AE', 'meet', 'a>c', 'b<d', 'm<n')
    """
    decisions: list[Decision] = []
    intervals = _solve(solid, Grid.of(solid, ray), "", decisions)
    return Answer(intervals, tuple(decisions))


def _solve(solid: Solid, grid: Grid, path: str, decisions: list[Decision]) -> Intervals:
    if not isinstance(solid, Tree):
        return solve_leaf(solid, grid, path, decisions)
    lists = [
        _solve(part, grid, f"{path}.of[{i}]" if path else f"of[{i}]", decisions)
        for i, part in enumerate(solid.of)
    ]
    return combine(solid, lists)


def combine(tree: Tree, lists: list[Intervals]) -> Intervals:
    """Return the list of a Boolean from those of its parts, one or more."""
    match tree:
        case Union():
            return union(lists)
        case Intersection():
            return intersection(lists)
        case Difference():
            return subtract(lists[0], union(lists[1:]))


def solve_leaf(leaf: Leaf, grid: Grid, path: str, decisions: list[Decision]) -> Intervals:
    """Return the list of one leaf, and add the rows it takes to `decisions`."""
    match leaf:
        case HalfSpace():
            return _half_space(half_space(leaf, grid), grid, path, decisions)
        case Sphere():
            return _round(ball(leaf, grid), grid, path, decisions)
        case InfiniteCylinder():
            return _round(wall(leaf, grid), grid, path, decisions)
        case Slab():
            return _slab(*caps(leaf, grid), grid, path, decisions)
        case Cylinder():
            face, at_p, at_q = capped(leaf, grid)
            one = _round(face, grid, path, decisions)
            two = _slab(at_p, at_q, grid, path, decisions)
            return _both(one, two, path, decisions)


def _round(face: Quadric, grid: Grid, path: str, decisions: list[Decision]) -> Intervals:
    """Problem 1: the infinite cylinder. A sphere takes the same rows with v, y for the barred."""
    disc = face.disc
    roots: tuple[Surd, Surd] | None = None

    def signs(quantity: str) -> int:
        nonlocal roots
        match quantity:
            case "vv":
                return sign(face.a)
            case "inside":
                return -sign(face.c)
            case "disc":
                return sign(disc)
        roots = roots or face.roots(grid, disc)
        return roots[quantity == "t2"].sign()

    row, known = PROBLEM_1.decide(signs)
    decisions.append(Decision(path, row, known))
    return _emitted(row, lambda end: (roots or face.roots(grid, disc))[end == "t2"])


def _half_space(plane: Plane, grid: Grid, path: str, decisions: list[Decision]) -> Intervals:
    """Problem 2 (c): one plane."""
    signs = {"up": sign(plane.c), "vn": sign(plane.b)}
    row, known = HALF_SPACE.decide(signs.__getitem__)
    decisions.append(Decision(path, row, known))
    return _emitted(row, lambda _: plane.crossing(grid))


def _slab(
    p_plane: Plane, q_plane: Plane, grid: Grid, path: str, decisions: list[Decision]
) -> Intervals:
    """Problem 2: the slab between the two planes."""
    row, known = PROBLEM_2.decide(plane_signs(p_plane, q_plane).__getitem__)
    decisions.append(Decision(path, row, known))
    return _emitted(row, lambda end: (p_plane if end == "tp" else q_plane).crossing(grid))


def _emitted(row: Row, crossing: Callable[[str], Surd]) -> Intervals:
    """Return the pairs of a row, `{(0, tp)}` or none, with what `crossing` finds for tp."""
    if row.pairs == "{}":
        return NOTHING
    enter, leave = (
        ENDS[end] if end in ENDS else crossing(end) for end in row.pairs[2:-2].split(", ")
    )
    return ((enter, leave),)


def _both(one: Intervals, two: Intervals, path: str, decisions: list[Decision]) -> Intervals:
    """Problem 3: the intersection of at most one pair with at most one pair."""
    signs = {"pairs_1": len(one), "pairs_2": len(two)}
    common: Intervals = NOTHING
    if one and two:
        (a, b), (c, d) = one[0], two[0]
        signs["a-c"], signs["b-d"] = a.compare(c), b.compare(d)
        m = a if signs["a-c"] > 0 else c
        n = b if signs["b-d"] < 0 else d
        signs["m-n"] = m.compare(n)
        common = ((m, n),)
    row, _ = PROBLEM_3.decide(signs.__getitem__)
    decisions.append(Decision(path, row, tuple(signs.items())))
    return common if row.name == "meet" else NOTHING
