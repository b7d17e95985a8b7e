"""From a failing case to the simplest found that fails in the same way. Deterministic.

Every step asks for the simpler cases next to the best one, and takes the simplest that fails with
the same level and kind: first fewer parts, then small whole numbers drawn anew, then the probe as
a whole, its vectors, its numbers one by one; again, until nothing is simpler.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from raycert.cases.dice import Dice
from raycert.cases.formats import Format
from raycert.cases.model import nodes
from raycert.cases.numbers import Probe, numbers
from raycert.oracle.hunt.placed import kept
from raycert.oracle.hunt.simple import as_wholes, by_number, by_vectors, cost, fewer_parts, small

Fails = Callable[[Sequence[Probe]], Sequence[bool]]
DRAWS = 320
"""Scenes of small numbers that are tried for each shape."""
MOST = 6000
"""Cases that one shrink may ask."""
AT_ONCE = 24
"""Cases that are asked together: the simplest first, and often one of the first fails."""


class Shrinker:
    """A shrink under way; `best` is a failing case at any time, so it can be broken off."""

    def __init__(self, probe: Probe, fails: Fails, fmt: Format, most: int = MOST) -> None:
        """Take a failing probe. `fails` tells of each of some probes whether it fails so too."""
        self.best, self.asked = probe, 0
        self._fails, self._fmt, self._most = fails, fmt, most
        self._known: set[Probe] = {probe}
        self._drawn: set[tuple[type, ...]] = set()

    def run(self, is_known: Callable[[Probe], bool] = lambda _: False) -> Probe:
        """Return the simplest found; end early at a case whose cause is known."""
        while self.asked < self._most and self._pass(is_known):
            pass
        return self.best

    def _pass(self, is_known: Callable[[Probe], bool]) -> bool:
        before = self.best
        while self._to(fewer_parts(self.best)):
            pass
        self._draw()
        if is_known(self.best):
            return False
        while self._to(as_wholes(self.best, self._fmt)):
            pass
        while self._to(by_vectors(self.best)):
            pass
        for slot in range(len(numbers(self.best))):
            while self._to(by_number(self.best, slot)):
                pass
        return self.best != before

    def _draw(self) -> None:
        shape = tuple(map(type, nodes(self.best.solid)))
        if shape not in self._drawn:
            self._drawn.add(shape)
            dice = Dice(f"small {[kind.__name__ for kind in shape]}")
            self._to(small(self.best, dice) for _ in range(DRAWS))

    def _to(self, candidates: Iterable[Probe | None]) -> bool:
        """Go to the simplest candidate that fails, if one is simpler than the best."""
        limit = cost(self.best)
        new = {s: cost(s) for s in kept(candidates, self._fmt) if s not in self._known}
        simpler = sorted((s for s in new if new[s] < limit), key=lambda s: new[s])
        simpler = simpler[: max(self._most - self.asked, 0)]
        if not simpler:
            return False
        self._known.update(simpler)
        for start in range(0, len(simpler), AT_ONCE):
            some = simpler[start : start + AT_ONCE]
            self.asked += len(some)
            for probe, failed in zip(some, self._fails(some), strict=True):
                if failed:
                    self.best = probe
                    return True
        return False
