"""Faults of the reply: its form, and what is remembered of the questions before."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from math import inf, nextafter

from raycert.cases.model import Ray, Solid
from raycert.oracle.zoo.fault import Fault, Intersect, fault
from raycert.oracle.zoo.tracer import BASE, NAN, Pairs, Tell


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
