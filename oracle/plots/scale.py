"""The axis of a sweep: where its steps stand, what is written there, which of them have marks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from raycert.oracle.measure.stress.sweeps import Sweep


@dataclass(frozen=True, slots=True)
class Scale:
    """Where the steps of a sweep stand: at their powers, and 0 a gap beyond the last."""

    sweep: Sweep
    steps: tuple[Fraction, ...]

    def at(self, x: Fraction) -> float:
        """Return the place of a step."""
        if x:
            return float(self.sweep.power(x))
        powers = [self.sweep.power(step) for step in self.steps if step]
        return min(powers) - max((max(powers) - min(powers)) / 12, 1)

    @property
    def width(self) -> float:
        """Return the signed width, from the first step to the last."""
        return self.at(self.steps[-1]) - self.at(self.steps[0]) or 1.0

    @property
    def limits(self) -> tuple[float, float]:
        """Return the limits of the axis: the first step is on the left."""
        margin = self.width / 30
        return self.at(self.steps[0]) - margin, self.at(self.steps[-1]) + margin

    def ticks(self) -> Iterator[tuple[float, str]]:
        """Yield a few places with what stands there."""
        powers = [self.sweep.power(x) for x in self.steps if x]
        low, high = min(powers), max(powers)
        every = next(n for n in (1, 2, 4, 5, 10, 20, 250, 500, 1000) if (high - low) / n <= 5)
        for power in range(-(-low // every) * every, high + 1, every):
            yield power, "1" if not power else f"${self.sweep.base}^{{{power}}}$"
        if not self.steps[-1]:
            yield self.at(self.steps[-1]), "0"


def spaced(places: Sequence[float], wanted: Sequence[bool], least: float) -> list[int]:
    """Return the numbers of the wanted places that keep the least distance from one another."""
    kept: list[int] = []
    for i, wants in enumerate(wanted):
        if wants and (not kept or abs(places[i] - places[kept[-1]]) >= least):
            kept.append(i)
    return kept
