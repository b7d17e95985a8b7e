"""Faults in the algebra of lists: unions, intersections, differences, and trees of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from raycert.cases.model import Difference, Ray, Solid, Tree
from raycert.oracle.zoo.fault import Fault, fault
from raycert.oracle.zoo.lists import Pairs, common, cut, merged, share, subtract, unite
from raycert.oracle.zoo.tracer import Combine


def _within(gap: float) -> Combine:
    def joined(lists: Sequence[Pairs]) -> Pairs:
        found: Pairs = []
        for a, b in unite(lists):
            if found and a - found[-1][1] <= gap:
                found[-1] = (found[-1][0], b)
            else:
                found.append((a, b))
        return found

    return joined


def _in_order(lists: Sequence[Pairs]) -> Pairs:
    """Merge each pair with the one before it only, as the operands come."""
    found: Pairs = []
    for a, b in (pair for pairs in lists for pair in pairs):
        if found and found[-1][0] <= a <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], b))
        else:
            found.append((a, b))
    return sorted(found)


def _hull(pairs: Pairs) -> Pairs:
    return [(pairs[0][0], pairs[-1][1])] if pairs else []


def _odd(lists: Sequence[Pairs]) -> Pairs:
    """Return the t in an odd number of the lists, by counting surfaces."""
    ends = sorted(t for pairs in lists for pair in pairs for t in pair)
    return merged(list(zip(ends[::2], ends[1::2], strict=True)))


def _first_advances(lists: Sequence[Pairs]) -> Pairs:
    left = lists[0]
    for pairs in lists[1:]:
        left = [piece for i, pair in enumerate(left) for piece in common([pair], pairs[i : i + 1])]
    return left


def _by_pieces(lists: Sequence[Pairs], *, before: bool = True, after: bool = True) -> Pairs:
    """Return the difference with what lies before each hole, or after it, left out."""
    left = list(lists[0])
    for hole in unite(lists[1:]):
        new: Pairs = []
        for pair in left:
            pieces = cut(pair, hole)
            split = len(pieces) == 2
            new += [p for i, p in enumerate(pieces) if not split or (after if i else before)]
        left = new
    return merged(left)


def _with_points(lists: Sequence[Pairs]) -> Pairs:
    """Return the difference with the ends that a hole shares kept as points."""
    left = list(lists[0])
    for c, d in unite(lists[1:]):
        new: Pairs = []
        for a, b in left:
            new += [(a, min(b, c))] if a <= c else []
            new += [(max(a, d), b)] if d <= b else []
        left = new
    return merged(left)


def _unmerged(lists: Sequence[Pairs]) -> Pairs:
    left = list(lists[0])
    for hole in unite(lists[1:]):
        left = [piece for pair in left for piece in cut(pair, hole)]
    return left


def _both_ways(lists: Sequence[Pairs]) -> Pairs:
    rest = unite(lists[1:])
    return unite([subtract([lists[0], rest]), subtract([rest, lists[0]])])


def _from_the_right(lists: Sequence[Pairs]) -> Pairs:
    right = lists[-1]
    for pairs in reversed(lists[:-1]):
        right = subtract([pairs, right])
    return right


def _flat(solid: Solid, ray: Ray) -> tuple[Solid, Ray]:
    """Read a tree within a tree as its first part."""

    def first(part: Solid) -> Solid:
        return first(part.of[0]) if isinstance(part, Tree) else part

    return (
        replace(solid, of=tuple(map(first, solid.of))) if isinstance(solid, Tree) else solid
    ), ray


def _sorted_parts(solid: Solid, ray: Ray) -> tuple[Solid, Ray]:
    """Read the parts of a difference from the last to the first."""

    def turned(part: Solid) -> Solid:
        if not isinstance(part, Tree):
            return part
        of = tuple(map(turned, part.of))
        return replace(part, of=of[::-1] if isinstance(part, Difference) else of)

    return turned(solid), ray


FAULTS: tuple[Fault, ...] = (
    fault(
        "union-unmerged", "puts the lists of a union one after the other",
        "mantid #32971; a student's slip", "csg-union", "malformed",
        unite=lambda lists: [pair for pairs in lists for pair in pairs],
    ),
    fault(
        "union-in-order", "merges an interval of a union only with the one before it",
        "failures M7: raysect", "csg-order", "malformed", unite=_in_order,
    ),
    fault(
        "union-tolerant", "joins intervals of a union less than 1e-6 apart",
        "mantid trac 1186: 25 tolerances", "csg-gap", "wrong end", unite=_within(1e-6),
    ),
    fault(
        "union-first", "answers the first part of a union that is hit", "first hits for intervals",
        "csg-union", "missed", unite=lambda lists: min((x for x in lists if x), default=[]),
    ),
    fault(
        "union-hull", "answers a union from its first enter to its last leave",
        "a student's slip: one interval for all", "csg-union", "wrong end",
        unite=lambda lists: _hull(unite(lists)),
    ),
    fault(
        "even-odd", "takes for inside what lies behind an odd number of surfaces",
        "moveit/geometric_shapes a627e6f; crossing counts", "csg-union", "count", unite=_odd,
    ),
    fault(
        "first-advances", "advances only the first list of an intersection",
        "the Haskell package csg; Geant4 #723", "csg-deep", "missed",
        share=_first_advances,
    ),
    fault(
        "first-with-first", "intersects only the first intervals of two lists",
        "a student's slip", "csg-deep", "missed",
        share=lambda lists: share([pairs[:1] for pairs in lists]),
    ),
    fault(
        "second-piece", "drops what lies after a hole", "a student's slip", "csg-difference",
        "missed", subtract=lambda lists: _by_pieces(lists, after=False),
    ),
    fault(
        "first-piece", "drops what lies before a hole", "a student's slip", "csg-difference",
        "missed", subtract=lambda lists: _by_pieces(lists, before=False),
    ),
    fault(
        "first-hole", "subtracts only the second part", "a student's slip", "csg-many", "wrong end",
        subtract=lambda lists: subtract(lists[:2]),
    ),
    fault(
        "both-ways", "takes the symmetric difference", "a student's slip: xor", "csg-difference",
        "wrong end", subtract=_both_ways,
    ),
    fault(
        "from-the-right", "reads A - B - C as A - (B - C)", "a student's slip", "csg-many",
        "wrong end", subtract=_from_the_right,
    ),
    fault(
        "last-less-first", "subtracts from the last part", "a student's slip",
        "csg-difference", "missed", read=_sorted_parts,
    ),
    fault(
        "difference-open", "leaves two intervals where a hole is a point",
        "a difference that is not closed", "csg-difference", "malformed", subtract=_unmerged,
    ),
    fault(
        "phantom-points", "keeps the shared ends of a difference as points",
        "failures M7: raysect, A - A", "csg-start-near", "phantom",
        subtract=_with_points,
    ),
    fault(
        "flat", "reads a tree within a tree as its first part", "a student's slip: no recursion",
        "csg-deep", "wrong end", read=_flat,
    ),
    fault(
        "first-only", "answers the first interval only", "the habit of returning one hit",
        "csg-tube", "missed", tell=lambda solid, ray, pairs: pairs[:1],
    ),
    fault(
        "last-only", "answers the last interval only", "a loop that overwrites its result",
        "csg-tube", "missed", tell=lambda solid, ray, pairs: pairs[-1:],
    ),
)  # fmt: skip
