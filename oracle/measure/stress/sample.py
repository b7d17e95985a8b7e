"""A sample: one ray and solid of a sweep, kept as an exact sketch, so that it can be made anew.

What was drawn is the same at every step of a sweep; only the parameter moves. A sketch is rounded
to doubles once, when it is posed, and that posed problem is the question: rounding it is no error
of any method.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from raycert.cases.draw import Draw
from raycert.cases.families.frames import ALIGNED, OBLIQUE, UPRIGHT, Exact, Frame, Number
from raycert.cases.families.sketch import Pen, Shape, plus, times
from raycert.cases.formats import BINARY64
from raycert.cases.model import Ray, Solid

Posed = tuple[Solid, Ray]
POINTS = 1000
"""The steps in which `share` draws."""


@dataclass(frozen=True, slots=True)
class Sample:
    """A shape and a ray in exact numbers, and the frame that they stand in."""

    shape: Shape
    origin: Exact
    direction: Exact
    frame: Frame = UPRIGHT

    def posed(self) -> Posed:
        """Return the question in doubles. Raises `Refused` where rounding leaves no solid."""
        pen = Pen(BINARY64)
        solid = pen.solid(self.shape, self.frame)
        origin = pen.vector(self.frame.point(self.origin))
        return solid, Ray(origin, pen.vector(self.frame.vector(self.direction)))


def real(draw: Draw, low: float, high: float) -> Fraction:
    """Return a double between low and high, all its bits random."""
    return Fraction(draw.dice.real(BINARY64, low, high))


def frame(draw: Draw, oblique: bool) -> Frame:
    """Return a frame along the coordinate axes, or an oblique one."""
    return draw.pick(OBLIQUE if oblique else ALIGNED)


def root(number: Number) -> Fraction:
    """Return a fraction within 2^-60, relatively, of the square root of a number >= 0 of any size.

    In integers, so that it is the same on every machine.
    """
    exact = Fraction(number)
    bits = exact.numerator.bit_length() - exact.denominator.bit_length()
    shift = 64 - bits // 2
    scaled = exact * Fraction(4) ** shift
    return isqrt(scaled.numerator // scaled.denominator) / Fraction(2) ** shift


def disc(draw: Draw, reach: float) -> tuple[Fraction, Fraction]:
    """Return a point of the disc of radius `reach`."""
    while True:
        a, b = real(draw, -reach, reach), real(draw, -reach, reach)
        if a * a + b * b <= Fraction(reach) ** 2:
            return a, b


def heading(draw: Draw) -> Exact:
    """Return a direction about as long as 1, with a good part across the axis."""
    while True:
        a, b, c = (real(draw, -1, 1) for _ in range(3))
        across = a * a + b * b
        if Fraction(1, 4) <= across and across + c * c <= 1:
            length = root(across + c * c)
            return (a / length, b / length, c / length)


def before(target: Exact, direction: Exact, distance: Number) -> Exact:
    """Return the start `distance` directions before a point."""
    return plus(target, times(-distance, direction))
