"""The results of units: each counted once, given out in the order of their numbers.

A result may come twice, where a unit was done again because its worker seemed lost; it is the same
one, and the second is dropped. Results that come early wait for the ones before them, so that what
a hunt finds does not depend on who was faster.
"""

from __future__ import annotations

from collections.abc import Iterator

from raycert.oracle.hunt.unit import Done


class Ledger:
    """The results so far."""

    def __init__(self) -> None:
        """Begin at unit 0."""
        self.results: dict[int, Done] = {}
        self._next = 0

    def add(self, result: Done) -> bool:
        """Count a result; return whether it is new."""
        if result.number in self.results:
            return False
        self.results[result.number] = result
        return True

    def in_order(self) -> Iterator[Done]:
        """Yield the results whose turn it is, each once."""
        while self._next in self.results:
            self._next += 1
            yield self.results[self._next - 1]

    def rest(self) -> Iterator[Done]:
        """Yield the results that wait for one that will not come, in order."""
        for number in sorted(n for n in self.results if n >= self._next):
            self._next = number + 1
            yield self.results[number]

    @property
    def tried(self) -> int:
        """Return how many cases were tried."""
        return sum(result.tried for result in self.results.values())
