"""Draws for fresh cases: steps of the ladders, shapes with a line through them, and shots at them.

Everything is drawn in exact numbers, as the golden sketches are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

from raycert.cases.case import Case
from raycert.cases.dice import Dice
from raycert.cases.families.frames import ALIGNED, OBLIQUE, Exact, Frame, Number
from raycert.cases.families.shots import Shot, decades
from raycert.cases.families.sketch import (
    MISS,
    Pairs,
    Shape,
    ball,
    below,
    layer,
    near,
    pair,
    pipe,
    plus,
    rod,
    ten,
    times,
    two,
)
from raycert.cases.formats import Format

T = TypeVar("T")
CHORDS = ((3, 4, 5), (4, 3, 5), (5, 12, 13), (15, 8, 17), (24, 7, 25), (20, 21, 29), (0, 3, 3))
"""How far off the axis, half a chord, the radius."""


@dataclass(frozen=True, slots=True)
class Draw:
    """The dice of one case, and the format it is for."""

    dice: Dice
    fmt: Format

    def whole(self, low: int, high: int) -> int:
        """Return an integer of low..high."""
        return self.dice.integer(low, high)

    def pick(self, items: Sequence[T]) -> T:
        """Return one of the items."""
        return items[self.whole(0, len(items) - 1)]

    def sign(self) -> int:
        """Return 1 or -1."""
        return self.pick((1, -1))

    def large(self) -> Fraction:
        """Return a number of 10 to 10^13, or to 10^6 in binary32."""
        return self.whole(10, 99) * ten(self.pick(decades(self.fmt)) - 1)

    def small(self) -> Fraction:
        """Return a number of the format, of 1/10 to 1e-13, or to 1e-7 in binary32."""
        return near(self.fmt, self.whole(10, 99) * ten(-self.pick(decades(self.fmt)) - 2))

    def gap(self) -> Fraction:
        """Return 2^-k that 1 - 2^-k and 32 + 2^-k can hold."""
        return two(-self.whole(2, self.fmt.precision - 6))

    def frame(self) -> Frame:
        """Return a frame along the coordinate axes, or an oblique one."""
        return self.pick(self.pick((ALIGNED, OBLIQUE)))


@dataclass(frozen=True, slots=True)
class Aim:
    """A shape, a line through `target`, and the t it stays in the shape, counted from there."""

    noun: str
    shape: Shape
    target: Exact
    direction: Exact
    stay: tuple[Number, Number | None] = (-1, 1)


def any_aim(draw: Draw) -> Aim:
    """Return a leaf of any type, a cylinder more often, and a line through it."""
    y, half, radius = draw.pick(CHORDS)
    y, climb = y * draw.sign(), draw.whole(-radius, radius)
    low, high = (0, 0, -2 * radius), (0, 0, 2 * radius)
    match draw.whole(0, 7):
        case 0 | 1 | 2:
            return Aim("a cylinder", rod(low, high, radius), (0, y, 0), (half, 0, climb))
        case 3 | 4:
            return Aim("an infinite cylinder", pipe(low, high, radius), (0, y, 0), (half, 0, climb))
        case 5 | 6:
            return Aim("a sphere", ball(radius), (0, y, 0), (half, 0, 0))
    slant: Exact = (draw.whole(-9, 9), draw.whole(-9, 9), -radius)
    if draw.whole(0, 1):
        return Aim("a slab", layer((0, 0, -radius), (0, 0, radius)), (y, half, 0), slant)
    normal: Exact = (0, 0, draw.whole(1, 9))
    return Aim("a half-space", below((0, 0, 0), normal), (y, half, 0), slant, (0, None))


def shot(
    draw: Draw,
    what: str,
    aim: Aim,
    back: Number,
    flags: tuple[str, ...],
    *,
    frame: Frame | None = None,
    speed: Fraction = Fraction(1),
) -> Case:
    """Return the ray that starts `back` steps before its target, with its known answer."""
    return Shot(
        "",
        f"A ray {what} {aim.noun}",
        aim.shape,
        plus(aim.target, aim.direction, -back),
        times(speed, aim.direction),
        _ahead(aim, back, speed),
        flags=flags,
    ).case(draw.fmt, frame or draw.frame())


def _ahead(aim: Aim, back: Number, speed: Number) -> Pairs:
    enter, leave = ((None if t is None else (t + back) / Fraction(speed)) for t in aim.stay)
    if leave is not None and leave < 0:
        return MISS
    return pair(max(enter or Fraction(0), Fraction(0)), leave)
