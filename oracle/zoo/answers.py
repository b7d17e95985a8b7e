"""Faults of the answer itself: its form, and what it remembers of the answers before."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from math import inf, nextafter

from raycert.cases.model import Ray, Solid
from raycert.oracle.zoo.fault import Fault, Intersect, fault
from raycert.oracle.zoo.lists import NAN, Pairs
from raycert.oracle.zoo.tracer import BASE

Tell = Callable[[Solid, Ray, Pairs], Pairs]


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


@dataclass
class Echo:
    """Repeats its last answer to every question of some number."""

    every: int
    number: count[int] = field(default_factory=lambda: count(1))
    last: Pairs = field(default_factory=list)

    def __call__(self, solid: Solid, ray: Ray) -> Pairs:
        """Return the answer, or the one before."""
        if next(self.number) % self.every:
            self.last = BASE(solid, ray)
        return self.last


@dataclass
class Late:
    """Answers each question with the answer to the one before."""

    last: Pairs = field(default_factory=list)

    def __call__(self, solid: Solid, ray: Ray) -> Pairs:
        """Return the answer before."""
        late, self.last = self.last, BASE(solid, ray)
        return late


@dataclass
class Cache:
    """Keeps the last hit of a solid, whatever the ray."""

    solid: Solid | None = None
    hit: Pairs = field(default_factory=list)

    def __call__(self, solid: Solid, ray: Ray) -> Pairs:
        """Return the answer for the solid as it was last met."""
        if solid != self.solid or not self.hit:
            self.solid, self.hit = solid, BASE(solid, ray)
        return self.hit


@dataclass
class Wearing:
    """Stops in the middle of every question of some number."""

    every: int
    number: count[int] = field(default_factory=lambda: count(1))

    def __call__(self, solid: Solid, ray: Ray) -> Pairs:
        """Return the answer, or raise."""
        if next(self.number) % self.every:
            return BASE(solid, ray)
        raise MemoryError("pool exhausted")


def stateful(name: str, does: str, origin: str, home: str, make: Callable[[], Intersect]) -> Fault:
    """Return a fault that depends on what was asked before."""
    return Fault(name, does, origin, home, "unrepeated", make, stateful=True)


FAULTS: tuple[Fault, ...] = (
    fault(
        "always-empty", "never sees anything", "a stub; PhysX #487 turned round",
        "table-through", "missed", tell=told(lambda pairs: []),
    ),
    fault(
        "always-all", "is always inside", "a stub", "table-miss", "phantom",
        tell=told(lambda pairs: [(0.0, inf)]),
    ),
    fault(
        "swapped", "answers (leave, enter)", "a student's slip", "start-inside", "malformed",
        tell=told(lambda pairs: [(b, a) for a, b in pairs]),
    ),
    fault(
        "points", "answers each hit as a pair of its own", "the habit of lists of hits",
        "table-through", "missed",
        tell=told(lambda pairs: [(t, t) for pair in pairs for t in pair]),
    ),
    fault(
        "miss-nan", "answers a miss by NaN", "aardvark-platform/aardvark.base #123",
        "half-space-rows", "malformed", tell=miss(NAN),
    ),
    fault(
        "miss-minus-infinity", "answers a miss by -infinity", "the habit of a sentinel",
        "table-miss", "malformed", tell=miss([(-inf, -inf)]),
    ),
    fault(
        "miss-infinity", "answers a miss by (infinity, infinity)", "the habit of a sentinel",
        "table-miss", "malformed", tell=miss([(inf, inf)]),
    ),
    fault(
        "miss-minus-one", "answers a miss by -1", "VecGeom ba71e216", "table-miss", "malformed",
        tell=miss([(-1.0, -1.0)]),
    ),
    fault(
        "miss-zero", "answers a miss by (0, 0)", "memory that was never set", "table-miss",
        "phantom", tell=miss([(0.0, 0.0)]),
    ),
    fault(
        "sliver", "adds a sliver beside each interval, some ulps behind it",
        "openmc #2618: steps of 1e-16", "random-cylinder", "count", tell=told(_sliver),
    ),
    fault(
        "split", "breaks an interval in two at its middle", "BRL-CAD 878f52244a",
        "random-cylinder", "count", tell=told(_split),
    ),
    fault(
        "twice", "answers each interval twice", "trimesh #2317", "random-cylinder", "malformed",
        tell=told(lambda pairs: [p for p in pairs for _ in range(2)]),
    ),
    fault(
        "unsorted", "answers the last interval first", "a list built at its head", "csg-tube",
        "malformed", tell=told(lambda pairs: pairs[::-1]),
    ),
    stateful(
        "echo", "repeats its last answer at every seventh question", "a reply read too late",
        "random-cylinder", lambda: Echo(7),
    ),
    stateful(
        "late", "answers each question with the answer to the one before",
        "a reply read too late", "random-cylinder", Late,
    ),
    stateful(
        "cache", "keeps the last hit of a solid for another ray", "raysect's cached hit",
        "start-near-surface", Cache,
    ),
    stateful(
        "hundredth", "stops at every hundredth question", "a pool that is never emptied", "needle",
        lambda: Wearing(100),
    ),
)  # fmt: skip
