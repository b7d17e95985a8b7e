"""Deterministic numbers for families: the same on every machine, Python and library version."""

from __future__ import annotations

from fractions import Fraction

from raycert.cases.formats import Format

MASK = (1 << 64) - 1


class Dice:
    """SplitMix64 (Steele, Lea, Flood 2014), seeded by a name."""

    def __init__(self, name: str) -> None:
        """Start from the 64-bit FNV-1a hash of `name`."""
        state = 0xCBF29CE484222325
        for byte in name.encode():
            state = ((state ^ byte) * 0x100000001B3) & MASK
        self.state = state

    def bits(self, count: int = 64) -> int:
        """Return the next `count` <= 64 random bits."""
        self.state = (self.state + 0x9E3779B97F4A7C15) & MASK
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        return (z ^ (z >> 31)) >> (64 - count)

    def integer(self, low: int, high: int) -> int:
        """Return an integer of low..high, both included."""
        return low + self.bits() % (high - low + 1)

    def real(self, fmt: Format, low: float = -1.0, high: float = 1.0) -> float:
        """Return a number of the format between low and high, all its bits random."""
        share = Fraction(self.bits(fmt.precision), 1 << fmt.precision)
        exact = Fraction(low) + (Fraction(high) - Fraction(low)) * share
        return fmt.nearest(float(exact))

    def vector(
        self, fmt: Format, low: float = -1.0, high: float = 1.0
    ) -> tuple[float, float, float]:
        return (self.real(fmt, low, high), self.real(fmt, low, high), self.real(fmt, low, high))
