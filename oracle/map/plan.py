"""What the cells of a map are: the case with some inputs moved, each to a number of the format.

In ulps an input moves along the grid of the format, number by number, through 0 and to the next
power of two as the grid goes; from 0 itself it moves in steps of 2^-precision, since the smallest
numbers tell nothing. In units and relatively it moves to the number nearest to the exact place.
Where both axes move an input, their moves add.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import inf, ldexp
from typing import Literal

from raycert.cases.formats import Format
from raycert.cases.model import Refused
from raycert.oracle.exact.rounding import enclose
from raycert.oracle.exact.surd import fraction
from raycert.oracle.map.inputs import Case, Direction, Inputs

Unit = Literal["ulps", "units", "relative"]
UNITS: tuple[Unit, ...] = ("ulps", "units", "relative")
At = tuple[int, int]
"""The place of a cell, counted from the case in the middle: to the right, and up."""


@dataclass(frozen=True)
class Plan:
    """The cells: `half` of them on each side of the case, `step` apart, in both directions."""

    inputs: Inputs
    x: Direction
    y: Direction
    unit: Unit
    step: Fraction
    half: int

    @classmethod
    def of(
        cls,
        inputs: Inputs,
        axes: tuple[Direction, Direction],
        unit: Unit,
        span: Fraction,
        most: int,
    ) -> Plan:
        """Return the plan that reaches `span` on each side with about `most` cells on an axis.

        In ulps all steps are whole: where the span has more numbers than cells, every second or
        third, ..., number is a cell. Raises `Refused` for what cannot be moved so.
        """
        if span <= 0:
            raise Refused("span", "is not positive")
        _check(inputs, axes, unit, span)
        half = max(most // 2, 1)
        if unit == "ulps":
            step = max(-(-int(span) // half), 1)
            return cls(inputs, *axes, unit, Fraction(step), max(int(span) // step, 1))
        return cls(inputs, *axes, unit, span / half, half)

    @property
    def places(self) -> list[At]:
        """Return the places of all cells, from the middle outward in squares."""
        line = range(-self.half, self.half + 1)
        square = [(i, j) for j in line for i in line]
        return sorted(square, key=lambda at: (max(abs(at[0]), abs(at[1])), at[1], at[0]))

    @cached_property
    def paths(self) -> tuple[str, ...]:
        """Return the paths that are moved, in the order of the axes."""
        return tuple(dict.fromkeys(path for path, _ in (*self.x.terms, *self.y.terms)))

    def values(self, at: At) -> dict[str, float]:
        """Return the inputs of a cell that are moved; one beyond the format is infinite."""
        moves = dict.fromkeys(self.paths, Fraction(0))
        for direction, count in zip((self.x, self.y), at, strict=True):
            for path, weight in direction.terms:
                moves[path] += weight * count * self.step
        fmt = self.inputs.format
        return {path: moved(self.inputs[path], by, self.unit, fmt) for path, by in moves.items()}

    def case(self, at: At) -> Case:
        """Return the case of a cell. Raises `Refused` where it is none."""
        return self.inputs.case(self.values(at))


def _check(inputs: Inputs, axes: tuple[Direction, Direction], unit: Unit, span: Fraction) -> None:
    """Refuse what moves nothing, or not by whole steps."""
    if axes[0] == axes[1]:
        raise Refused("y", "is the same direction as x")
    if unit == "ulps" and span.denominator != 1:
        raise Refused("span", f"is not a whole number of ulps: {float(span)!r}")
    for path, weight in (*axes[0].terms, *axes[1].terms):
        if unit == "ulps" and weight.denominator != 1:
            raise Refused(path, "has a weight that is not whole; ulps are counted")
        if unit == "relative" and not inputs[path]:
            raise Refused(path, "is 0 and has no relative change; choose ulps or units")


def moved(x: float, by: Fraction, unit: Unit, fmt: Format) -> float:
    """Return a number of the format moved by so many ulps or units, or by a share of itself."""
    if unit == "ulps":
        return on_grid(x, int(by), fmt)
    exact = Fraction(x) + (by if unit == "units" else by * Fraction(x))
    return enclose(fraction(exact.numerator, exact.denominator), fmt).nearest


def on_grid(x: float, steps: int, fmt: Format) -> float:
    """Return the number so many places above x on the grid; infinite beyond its ends.

    >>> from raycert.cases.formats import BINARY64
    >>> on_grid(1.0, 1, BINARY64) == 1 + 2**-52, on_grid(1.0, -1, BINARY64) == 1 - 2**-53
    (True, True)
    """
    if not x:
        return ldexp(float(steps), -fmt.precision)
    place = _ordinal(x, fmt) + steps
    if abs(place) >= _ordinal(inf, fmt):
        return inf if place > 0 else -inf
    size: float = struct.unpack(fmt.pack, abs(place).to_bytes(fmt.digits // 2, "big"))[0]
    return size if place >= 0 else -size


def _ordinal(x: float, fmt: Format) -> int:
    place = int.from_bytes(struct.pack(fmt.pack, abs(x)), "big")
    return -place if x < 0 else place
