"""Frames: where an exact sketch is put.

A frame has three columns, square to one another and of one length, with whole components. So a
sketch keeps its exact numbers in any of them, and the parameters t of its ray do not change.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from raycert.cases.dice import Dice
from raycert.cases.vectors import plus, times

Number = int | Fraction
Exact = tuple[Number, Number, Number]


@dataclass(frozen=True, slots=True)
class Frame:
    """The images of x, y and z (`lateral`, `across`, `axis`), each `stretch` long, and of 0.

    `name` goes into slugs, `text` into sentences.
    """

    name: str
    text: str
    lateral: Exact
    across: Exact
    axis: Exact
    stretch: Number = 1
    shift: Exact = (0, 0, 0)

    def vector(self, vector: Exact) -> Exact:
        x, y, z = vector
        return plus(plus(times(x, self.lateral), times(y, self.across)), times(z, self.axis))

    def point(self, point: Exact) -> Exact:
        return plus(self.vector(point), self.shift)

    def scaled(self, factor: Number) -> Frame:
        return replace(
            self,
            lateral=times(factor, self.lateral),
            across=times(factor, self.across),
            axis=times(factor, self.axis),
            stretch=factor * self.stretch,
            shift=times(factor, self.shift),
        )

    def moved(self, shift: Exact) -> Frame:
        """Return this frame with the image of 0 at `shift`."""
        return replace(self, shift=shift)


X: Exact = (1, 0, 0)
Y: Exact = (0, 1, 0)
Z: Exact = (0, 0, 1)
UPRIGHT = Frame("", "", X, Y, Z)
ON_Z = Frame("on-z", "axis along +z", X, Y, Z)
ON_X = Frame("on-x", "axis along +x", Y, Z, X)
ON_Y = Frame("on-y", "axis along +y", Z, X, Y)
DOWN_Z = Frame("down-z", "axis along -z", Y, X, (0, 0, -1))
DOWN_X = Frame("down-x", "axis along -x", Z, Y, (-1, 0, 0))
DOWN_Y = Frame("down-y", "axis along -y", X, Z, (0, -1, 0))
ALIGNED = (ON_Z, ON_X, ON_Y, DOWN_Z, DOWN_X, DOWN_Y)
"""Along coordinate axes, right-handed."""

FIFTHS = Frame("fifths", "axis along (3, 0, 4)", (4, 0, -3), (0, 5, 0), (3, 0, 4), 5)
THIRTEENTHS = Frame("thirteenths", "axis along (0, 5, 12)", (13, 0, 0), (0, 12, -5), (0, 5, 12), 13)
THIRDS = Frame("thirds", "axis along (1, 2, 2)", (2, 1, -2), (2, -2, 1), (1, 2, 2), 3)
SEVENTHS = Frame("sevenths", "axis along (2, 3, 6)", (3, -6, 2), (6, 2, -3), (2, 3, 6), 7)
NINTHS = Frame("ninths", "axis along (1, 4, 8)", (8, -4, 1), (4, 7, -4), (1, 4, 8), 9)
ELEVENTHS = Frame("elevenths", "axis along (2, 6, 9)", (6, 7, -6), (9, -6, 2), (2, 6, 9), 11)
OBLIQUE = (FIFTHS, THIRTEENTHS, THIRDS, SEVENTHS, NINTHS, ELEVENTHS)
"""From Pythagorean triples and quadruples: oblique, and exact."""


def frames_for(name: str, aligned: int = 1, oblique: int = 1) -> tuple[Frame, ...]:
    """Return some frames of each kind, drawn by `name`: the same for the same name always."""
    dice = Dice(name)
    return (*_draw(dice, ALIGNED, aligned), *_draw(dice, OBLIQUE, oblique))


def _draw(dice: Dice, frames: tuple[Frame, ...], count: int) -> tuple[Frame, ...]:
    start = dice.integer(0, len(frames) - 1)
    return (frames[start:] + frames[:start])[:count]
