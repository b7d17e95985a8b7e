"""Faults in lists: in their algebra, in the form of the reply, and in what is remembered."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count
from math import inf, nextafter

from raycert.cases.model import Difference, Ray, Solid, Tree, parts
from raycert.oracle.zoo.tracer import (
    BASE,
    NAN,
    Combine,
    Fault,
    Intersect,
    Pair,
    Pairs,
    Tell,
    common,
    cut,
    fault,
    merged,
    pierced,
    share,
    subtract,
    unite,
)


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


def _odd(lists: Sequence[Pairs]) -> Pairs:
    """Return the t in an odd number of the lists, by counting surfaces."""
    ends = sorted(t for pairs in lists for pair in pairs for t in pair)
    return merged(list(zip(ends[::2], ends[1::2], strict=True)))


def _first_advances(lists: Sequence[Pairs]) -> Pairs:
    left = lists[0]
    for pairs in lists[1:]:
        left = [piece for i, pair in enumerate(left) for piece in common([pair], pairs[i : i + 1])]
    return left


def _one_piece(which: int) -> Combine:
    """Return the difference that keeps one of the two pieces beside a hole."""

    def piece(pair: Pair, hole: Pair) -> Pairs:
        pieces = cut(pair, hole)
        return pieces if len(pieces) < 2 else [pieces[which]]

    return lambda lists: merged(pierced(lists, piece))


def _with_its_end(pair: Pair, hole: Pair) -> Pairs:
    """Return what is beside a hole, an end that the hole shares as a point."""
    (a, b), (c, d) = pair, hole
    return ([(a, min(b, c))] if a <= c else []) + ([(max(a, d), b)] if d <= b else [])


def _both_ways(lists: Sequence[Pairs]) -> Pairs:
    rest = unite(lists[1:])
    return unite([subtract([lists[0], rest]), subtract([rest, lists[0]])])


def _from_the_right(lists: Sequence[Pairs]) -> Pairs:
    right = lists[-1]
    for pairs in reversed(lists[:-1]):
        right = subtract([pairs, right])
    return right


def _first(solid: Solid) -> Solid:
    return _first(solid.of[0]) if isinstance(solid, Tree) else solid


def _flat(solid: Solid, ray: Ray) -> tuple[Solid, Ray]:
    return (type(solid)(tuple(map(_first, solid.of))) if isinstance(solid, Tree) else solid), ray


def _turned(solid: Solid) -> Solid:
    """Return a solid with the parts of its differences from the last to the first."""
    of = tuple(map(_turned, parts(solid)))
    if isinstance(solid, Tree):
        return type(solid)(of[::-1] if isinstance(solid, Difference) else of)
    return solid


def miss(answer: Pairs) -> Tell:
    """Return the step that answers a miss otherwise."""
    return lambda solid, ray, pairs: pairs or answer


def told(change: Callable[[Pairs], Pairs]) -> Tell:
    """Return the step that changes an answer without a look at the question."""
    return lambda solid, ray, pairs: change(pairs)


def _after(t: float, steps: int) -> float:
    for _ in range(steps):
        t = nextafter(t, inf)
    return t


def _split(pairs: Pairs) -> Pairs:
    middle = [(a, (a + b) / 2, b) for a, b in pairs if b < inf]
    halves = [p for a, m, b in middle if a < m for p in ((a, m), (_after(m, 1), b))]
    return halves + [(a, b) for a, b in pairs if b == inf or not a < (a + b) / 2]


def _sliver(pairs: Pairs) -> Pairs:
    return [p for a, b in pairs for p in ((a, b), (_after(b, 2), _after(b, 3))) if p[0] < inf]


def _echo() -> Intersect:
    """Return a tracer that repeats its last answer to every seventh question."""
    number, last = count(1), [Pairs()]

    def answer(solid: Solid, ray: Ray) -> Pairs:
        if next(number) % 7:
            last[0] = BASE(solid, ray)
        return last[0]

    return answer


def _late() -> Intersect:
    """Return a tracer that answers each question with the answer to the one before."""
    answers = [Pairs()]

    def answer(solid: Solid, ray: Ray) -> Pairs:
        answers.append(BASE(solid, ray))
        return answers.pop(0)

    return answer


def _cache() -> Intersect:
    """Return a tracer that keeps the last hit of a solid, whatever the ray."""
    hits: dict[Solid, Pairs] = {}

    def answer(solid: Solid, ray: Ray) -> Pairs:
        if not hits.get(solid):
            hits.clear()
            hits[solid] = BASE(solid, ray)
        return hits[solid]

    return answer


def _wearing() -> Intersect:
    """Return a tracer that stops in the middle of every hundredth question."""
    number = count(1)

    def answer(solid: Solid, ray: Ray) -> Pairs:
        if next(number) % 100:
            return BASE(solid, ray)
        raise MemoryError("pool exhausted")

    return answer


def stateful(name: str, does: str, origin: str, home: str, make: Callable[[], Intersect]) -> Fault:
    """Return a fault that depends on what was asked before."""
    return Fault(name, does, origin, home, "unrepeated", make, stateful=True)


FAULTS: tuple[Fault, ...] = (
    fault("union-unmerged", "puts the lists of a union one after the other",
          "mantidproject/mantid #32971; a student's slip", "csg-union", "malformed",
          unite=lambda lists: [pair for pairs in lists for pair in pairs]),
    fault("union-in-order", "merges an interval of a union only with the one before it",
          "Geant4 report #723: the order of operands", "csg-order", "malformed", unite=_in_order),
    fault("union-tolerant", "joins intervals of a union less than 1e-6 apart",
          "mantid trac 1186: 25 tolerances", "csg-gap", "wrong end", unite=_within(1e-6)),
    fault("union-first", "answers the first part of a union that is hit",
          "first hits for intervals", "csg-union", "missed",
          unite=lambda lists: min((x for x in lists if x), default=[])),
    fault("union-hull", "answers a union from its first enter to its last leave",
          "a student's slip: one interval for all", "csg-union", "wrong end",
          unite=lambda lists: [(x[0][0], x[-1][1]) for x in [unite(lists)] if x]),
    fault("even-odd", "takes for inside what lies behind an odd number of surfaces",
          "moveit/geometric_shapes a627e6f; crossing counts", "csg-union", "count", unite=_odd),
    fault("first-advances", "advances only the first list of an intersection",
          "the Haskell package csg; Geant4 report #723", "csg-deep", "missed",
          share=_first_advances),
    fault("first-with-first", "intersects only the first intervals of two lists",
          "a student's slip", "csg-deep", "missed",
          share=lambda lists: share([pairs[:1] for pairs in lists])),
    fault("second-piece", "drops what lies after a hole", "a student's slip", "csg-difference",
          "missed", subtract=_one_piece(0)),
    fault("first-piece", "drops what lies before a hole", "a student's slip", "csg-difference",
          "missed", subtract=_one_piece(1)),
    fault("first-hole", "subtracts only the second part", "a student's slip", "csg-many",
          "wrong end", subtract=lambda lists: subtract(lists[:2])),
    fault("both-ways", "takes the symmetric difference", "a student's slip: xor", "csg-difference",
          "wrong end", subtract=_both_ways),
    fault("from-the-right", "reads A - B - C as A - (B - C)", "a student's slip", "csg-many",
          "wrong end", subtract=_from_the_right),
    fault("last-less-first", "subtracts from the last part", "a student's slip", "csg-difference",
          "missed", read=lambda solid, ray: (_turned(solid), ray)),
    fault("difference-open", "leaves two intervals where a hole is a point",
          "a difference that is not closed", "csg-difference", "malformed",
          subtract=lambda lists: pierced(lists, cut)),
    fault("phantom-points", "keeps the shared ends of a difference as points",
          "POV-Ray/povray #209", "csg-start-near", "phantom",
          subtract=lambda lists: merged(pierced(lists, _with_its_end))),
    fault("flat", "reads a tree within a tree as its first part", "a student's slip: no recursion",
          "csg-deep", "wrong end", read=_flat),
    fault("first-only", "answers the first interval only", "the habit of returning one hit",
          "csg-tube", "missed", tell=lambda solid, ray, pairs: pairs[:1]),
    fault("last-only", "answers the last interval only", "a loop that overwrites its result",
          "csg-tube", "missed", tell=lambda solid, ray, pairs: pairs[-1:]),
    fault("always-empty", "never sees anything", "a stub; NVIDIA PhysX #487 turned round",
          "table-through", "missed", tell=told(lambda pairs: [])),
    fault("always-all", "is always inside", "a stub", "table-miss", "phantom",
          tell=told(lambda pairs: [(0.0, inf)])),
    fault("swapped", "answers (leave, enter)", "a student's slip", "start-inside", "malformed",
          tell=told(lambda pairs: [(b, a) for a, b in pairs])),
    fault("points", "answers each hit as a pair of its own", "the habit of lists of hits",
          "table-through", "missed",
          tell=told(lambda pairs: [(t, t) for pair in pairs for t in pair])),
    fault("miss-nan", "answers a miss by NaN", "aardvark-platform/aardvark.base #123",
          "half-space-rows", "malformed", tell=miss(NAN)),
    fault("miss-minus-infinity", "answers a miss by -infinity", "the habit of a sentinel",
          "table-miss", "malformed", tell=miss([(-inf, -inf)])),
    fault("miss-infinity", "answers a miss by (infinity, infinity)", "the habit of a sentinel",
          "table-miss", "malformed", tell=miss([(inf, inf)])),
    fault("miss-minus-one", "answers a miss by -1", "VecGeom ba71e216", "table-miss", "malformed",
          tell=miss([(-1.0, -1.0)])),
    fault("miss-zero", "answers a miss by (0, 0)", "memory that was never set", "table-miss",
          "phantom", tell=miss([(0.0, 0.0)])),
    fault("sliver", "adds a sliver beside each interval, some ulps behind it",
          "openmc-dev/openmc #2618: steps of 1e-16", "random-cylinder", "count",
          tell=told(_sliver)),
    fault("split", "breaks an interval in two at its middle", "BRL-CAD/brlcad 878f52244a",
          "random-cylinder", "count", tell=told(_split)),
    fault("twice", "answers each interval twice", "mikedh/trimesh #2317", "random-cylinder",
          "malformed", tell=told(lambda pairs: [p for p in pairs for _ in range(2)])),
    fault("unsorted", "answers the last interval first", "a list built at its head", "csg-tube",
          "malformed", tell=told(lambda pairs: pairs[::-1])),
    stateful("echo", "repeats its last answer at every seventh question", "a reply read too late",
             "random-cylinder", _echo),
    stateful("late", "answers each question with the answer to the one before",
             "a reply read too late", "random-cylinder", _late),
    stateful("cache", "keeps the last hit of a solid for another ray",
             "raysect/source: next_intersection", "start-near-surface", _cache),
    stateful("hundredth", "stops at every hundredth question", "a pool that is never emptied",
             "needle", _wearing),
)  # fmt: skip
