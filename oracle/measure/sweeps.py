"""The sweeps: one parameter each, by decades, and the rays of every step.

The rays of a step depend on the seed, the sweep and the step only, and are the same on every
machine. All steps of a sweep draw the same numbers; only the parameter moves. Numbers alternate
between frames along the coordinate axes, where rounding leaves the sketch as it is, and oblique
ones.

A sample is kept as an exact sketch, so that it can be made anew. It is rounded to doubles once,
when it is posed, and that posed problem is the question: rounding it is no error of any way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from math import isqrt
from typing import Literal

from raycert.cases.dice import Dice
from raycert.cases.draw import Draw
from raycert.cases.families.frames import (
    ALIGNED,
    FIFTHS,
    OBLIQUE,
    SEVENTHS,
    THIRDS,
    UPRIGHT,
    Exact,
    Frame,
    Number,
)
from raycert.cases.families.scale import START, half_unit
from raycert.cases.families.sketch import (
    Body,
    Pen,
    Shape,
    all_of,
    any_of,
    below,
    cylinder,
    layer,
    less,
    pipe,
    plus,
    rod,
    ten,
    times,
    two,
)
from raycert.cases.families.touch import CONTACTS
from raycert.cases.formats import BINARY64
from raycert.cases.model import Ray, Refused
from raycert.oracle.measure.errors import Referee
from raycert.oracle.measure.way import Case

Make = Callable[[Draw, int, Fraction], "Sample"]
"""From what a sample is drawn from, its number and the parameter."""
FAR_UP = 4096
LAST_OBLIQUE_TILT = Fraction(1, 10**15)
"""Less than that cannot be told from parallel in an oblique frame."""
LAST_BIT = 52
"""1 + 2^-52 is the double after 1; the last step of a gap is half of that."""
ROOM = two(-44)
"""The least gap that a Pythagorean contact in an oblique frame can hold exactly."""
ONE = Fraction(1)


@dataclass(frozen=True, slots=True)
class Sample:
    """A shape and a ray in exact numbers, and the frame that they stand in."""

    shape: Shape
    origin: Exact
    direction: Exact
    frame: Frame = UPRIGHT

    def posed(self) -> Case:
        """Return the question in doubles. Raises `Refused` where rounding leaves no solid."""
        pen = Pen(BINARY64)
        solid, origin = pen.solid(self.shape, self.frame), self.frame.point(self.origin)
        direction = pen.vector(self.frame.vector(self.direction))
        return Case(solid, Ray(pen.vector(origin), direction))

    def referee(self) -> Referee | None:
        """Return the referee of the question; None where rounding leaves no solid."""
        try:
            return Referee.of(self.posed())
        except Refused:
            return None


# What is drawn.


def draw(seed: int, name: str, number: int) -> Draw:
    """Return what a sample is drawn from: the same for every step."""
    return Draw(Dice(f"stress {seed} {name} {number}"), BINARY64)


def real(draw: Draw, low: float, high: float) -> Fraction:
    """Return a double between low and high, all its bits random."""
    return Fraction(draw.dice.real(BINARY64, low, high))


def frame_of(draw: Draw, oblique: bool) -> Frame:
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


def on_circle(draw: Draw) -> tuple[Fraction, Fraction]:
    """Return x > 0 and y of a point of the circle of radius 1, within 2^-60 of it."""
    y = real(draw, -0.875, 0.875)
    return root(1 - y * y), y


def point_of(
    draw: Draw, body: Body, reach: float = 0.875, low: float = 0.25, high: float = 0.75
) -> Exact:
    """Return a point up to `reach` radii from the axis, at a share of the height from z = 0."""
    a, b = disc(draw, reach)
    return (a * body.radius, b * body.radius, real(draw, low, high) * body.q[2])


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


# Distance, aspect, tilt and scale.


def drum(draw: Draw) -> tuple[Body, Exact]:
    """Return a cylinder about as high as wide, and a point deep inside."""
    body = cylinder(real(draw, 0.5, 1), real(draw, 2, 4))
    return body, point_of(draw, body)


def far(draw: Draw, number: int, x: Fraction) -> Sample:
    """Start x radii before a point inside; half of the rays along a coordinate axis."""
    body, target = drum(draw)
    place, direction = frame_of(draw, bool(number % 2)), heading(draw)
    if not number % 2:
        direction = (1, 0, 0)
    return Sample(body, before(target, direction, x * body.radius), direction, place)


def displaced(draw: Draw, number: int, x: Fraction) -> Sample:
    """Ray and cylinder near each other, x radii from the coordinate origin."""
    body, target = drum(draw)
    place, direction, back = frame_of(draw, bool(number % 2)), heading(draw), real(draw, 2, 4)
    away = times(x * body.radius * place.stretch, place.vector(heading(draw)))
    return Sample(body, before(target, direction, back * body.radius), direction, place.moved(away))


def thin(draw: Draw, number: int, x: Fraction) -> Sample:
    """Meet a needle or a disk, x = r/h, from about its own size, or its smaller one."""
    radius, height = min(x, ONE), min(1 / x, ONE)
    body = cylinder(radius, height)
    target = point_of(draw, body, low=0.125, high=0.875)
    place, back, (d, e, f) = frame_of(draw, bool(number % 2)), real(draw, 2, 4), heading(draw)
    near = number % 4 < 2
    direction: Exact = (d * radius, e * radius, f * height) if near else (d, e, f)
    if number % 4 == 2:
        direction = (1, 0, 0) if x < 1 else (0, 0, 1)
    return Sample(body, before(target, direction, back), direction, place)


def tilt(draw: Draw, number: int, x: Fraction, height: int = 0) -> Sample:
    """Start x radians from parallel, `height` radii up the axis: outside going in, or the reverse.

    Three in four starts are about x radii from the wall, and meet it within a radius of their way.
    """
    radius, beside, gap = real(draw, 0.5, 1), real(draw, -0.875, 0.875), real(draw, 0.001, 0.125)
    if number % 8 > 1:
        gap *= x
    place = frame_of(draw, bool(number % 2) and x >= LAST_OBLIQUE_TILT)
    lean, z = real(draw, -0.25, 0.25), real(draw, -1, 1) + draw.sign() * height
    half = root(1 - beside * beside)
    start = -half - gap if number % 4 < 2 else half - gap
    origin = (start * radius, beside * radius, z * radius)
    body = pipe((0, 0, 0), (0, 0, real(draw, 2, 4)), radius)
    return Sample(body, origin, (x, x * lean, draw.sign()), place)


def _plain(draw: Draw, number: int) -> Sample:
    """Return a plain scene; every fourth start is inside."""
    body, target = drum(draw)
    place, direction = frame_of(draw, bool(number % 2)), heading(draw)
    back = 0 if number % 4 == 3 else real(draw, 2, 4)
    return Sample(body, before(target, direction, back * body.radius), direction, place)


def speed(draw: Draw, number: int, x: Fraction) -> Sample:
    """Return a plain scene, the direction x times as long."""
    plain = _plain(draw, number)
    return replace(plain, direction=times(x, plain.direction))


def scale(draw: Draw, number: int, x: Fraction) -> Sample:
    """Return a plain scene, every length x times as long, that of the direction too."""
    plain = _plain(draw, number)
    return replace(plain, frame=plain.frame.scaled(x))


# Small gaps: to tangency, between faces, from the surface, and beside a tie.


def _rod(radius: Fraction | int) -> Body:
    return rod((0, 0, -8 * radius), (0, 0, 8 * radius), radius)


def _passing(draw: Draw, number: int, radius: Fraction, offset: Fraction) -> Sample:
    """Return a ray that passes the axis of `_rod` at `offset`, along a coordinate axis."""
    z, climb = draw.whole(-2, 2), draw.whole(-2, 2)
    place = frame_of(draw, oblique=False)
    origin: Exact = (-draw.whole(1, 9), offset, z)
    return Sample(_rod(radius), origin, (1, 0, climb if number % 4 else 0), place)


def _skew(draw: Draw, x: Fraction, sign: int) -> Sample:
    """Return a ray past a Pythagorean point moved in or out by the share x, exactly."""
    a, b, radius = draw.pick(CONTACTS)
    place, climb = draw.pick((FIFTHS, THIRDS, SEVENTHS)), draw.whole(-3, 3)
    contact, direction = times(1 + sign * x, (a, b, 0)), (b, -a, climb)
    origin = before(contact, direction, draw.whole(1, 3))
    return Sample(_rod(radius), origin, direction, place)


def gap(draw: Draw, number: int, x: Fraction, sign: int) -> Sample:
    """Return a chord at (1 - x) r from the axis, or a miss at (1 + x) r.

    The latter is at r / (1 - x) where 1 + x is no double.
    """
    if number % 2 and x >= ROOM:
        return _skew(draw, x, sign)
    if sign < 0:
        return _passing(draw, number, ONE, 1 - x)
    if 1 + x == Fraction(float(1 + x)):
        return _passing(draw, number, ONE, 1 + x)
    return _passing(draw, number, 1 - x, ONE)


def start(draw: Draw, number: int, x: Fraction) -> Sample:
    """Start x r from the wall, inside or outside: at large, or leaning from the tangent a little.

    Half of the places are exact, on a coordinate axis; the others are rounded to the doubles around
    the circle, and half of those lean by about x: the start is where the ray touches, or almost.
    """
    sign, turn, climb = draw.sign(), draw.sign(), draw.whole(-1, 1)
    share, general = 1 + sign * x, heading(draw)
    lean = draw.whole(-2, 2) * x if number % 4 == 3 else draw.sign() * two(-draw.whole(4, 50))
    tangent = number % 8 not in (0, 2, 4)
    if number % 4 < 2:
        direction: Exact = (lean, turn, climb) if tangent else general
        return Sample(_rod(1), (share, 0, draw.whole(-2, 2)), direction, frame_of(draw, False))
    (c, y), radius, place = on_circle(draw), real(draw, 0.5, 1), frame_of(draw, True)
    origin = (c * share * radius, y * share * radius, real(draw, -2, 2))
    along: Exact = (c * lean - y * turn, y * lean + c * turn, climb)
    return Sample(_rod(radius), origin, along if tangent else general, place)


def faces(draw: Draw, number: int, x: Fraction) -> Sample:
    """Meet a Boolean with two faces x apart, on a slant.

    Stacked cylinders, a shell of two radii, and the overlap of a half-space and a slab.
    """
    place, slant = frame_of(draw, bool(number % 2)), real(draw, -0.25, 0.25)
    y, back = real(draw, -0.25, 0.25), real(draw, 1, 3)
    shapes: tuple[Shape, ...] = (
        any_of(rod((0, 0, -2), (0, 0, 0), 1), rod((0, 0, x), (0, 0, 2), 1)),
        less(rod((0, 0, -2), (0, 0, 2), 1), rod((0, 0, -4), (0, 0, 4), 1 - x)),
        all_of(below((0, 0, x), (0, 0, 1)), layer((0, 0, 0), (0, 0, 2))),
    )
    direction: Exact = (1, slant, slant) if number % 3 == 1 else (slant, slant, 1)
    return Sample(shapes[number % 3], before((0, y, 0), direction, back), direction, place)


def hard(draw: Draw, number: int, x: Fraction) -> Sample:
    """Return ends that lie about x beside a tie of two doubles: y^2 / 2r, y = 2^-j, x = 2^-2j.

    Along a coordinate axis of a tube whose radius is an odd number of half units above 1.
    """
    radius = 1 + (2 * draw.whole(0, 1 << 40) + 1) * Fraction(half_unit(BINARY64))
    y = two(-((x.denominator.bit_length() - 1) // 2))
    body = (pipe if number % 2 else rod)((0, 0, 0), (0, 0, 2), radius)
    return Sample(body, (-START, y, 1), (1, 0, 0), UPRIGHT)


# The sweeps.


@dataclass(frozen=True)
class Sweep:
    """One parameter: its steps in the order of the axis, and the sample of a step.

    `mild` is the step where nothing is stiff: ranges are read from there, both ways. `base` is
    that of the steps' powers; 0 may follow them. `weight` multiplies the samples, where a failure
    is rare. `rounding`: only the correctly rounded list is of interest, not its backward error.
    """

    name: str
    title: str
    axis: str
    steps: tuple[Fraction, ...]
    mild: Fraction
    make: Make
    base: Literal[2, 10] = 10
    weight: int = 1
    rounding: bool = False

    def text(self, x: Fraction) -> str:
        """Return a step as people write it: 1e-7, 2^-53, 0.

        >>> SWEEPS["far"].text(ten(6)), SWEEPS["speed"].text(two(-50))
        ('1e6', '2^-50')
        """
        if not x:
            return "0"
        power = self.power(x)
        return f"1e{power}" if self.base == 10 else "1" if not power else f"2^{power}"

    def power(self, x: Fraction) -> int:
        """Return the exponent of a step that is not 0."""
        large = x if x >= 1 else 1 / x
        size = (
            len(str(large.numerator)) - 1 if self.base == 10 else large.numerator.bit_length() - 1
        )
        return size if x >= 1 else -size

    def samples(self, x: Fraction, seed: int, count: int) -> list[Sample]:
        """Return the samples of a step: `count` times the weight."""
        return [self.make(draw(seed, self.name, i), i, x) for i in range(count * self.weight)]

    def coarse(self, every: int) -> tuple[Fraction, ...]:
        """Return each `every`-th step from the mild one, and the ends."""
        middle = self.steps.index(self.mild)
        last = len(self.steps) - 1
        kept = (i for i in range(len(self.steps)) if (i - middle) % every == 0 or i in (0, last))
        return tuple(self.steps[i] for i in kept)


_GAPS = tuple(map(two, (*range(0, -LAST_BIT, -4), -50, -51, -52, -53)))
_TO_ZERO = (*_GAPS, Fraction(0))
_RANGE = tuple(map(two, range(-1000, 1001, 50)))
_TILTS = tuple(map(ten, range(0, -18, -1)))
SWEEPS = {
    sweep.name: sweep
    for sweep in (
        Sweep("far", "start far from the solid", "distance of the start / radius",
              tuple(map(ten, range(17))), ONE, far),
        Sweep("displaced", "scene far from the coordinate origin",
              "distance from the origin / radius", tuple(map(ten, range(16))), ONE, displaced),
        Sweep("thin", "needle and disk", "radius / height",
              tuple(map(ten, range(-15, 16))), ONE, thin),
        Sweep("tilt-wall", "almost parallel, from near the wall", "angle to the axis, rad",
              _TILTS, ONE, tilt, weight=2),
        Sweep("tilt-axis", "almost parallel, from far up the axis", "angle to the axis, rad",
              _TILTS, ONE, partial(tilt, height=FAR_UP), weight=2),
        Sweep("gap-inside", "almost tangent, inside", "gap to tangency / radius",
              _GAPS, ONE, partial(gap, sign=-1), 2),
        Sweep("gap-outside", "almost tangent, outside", "gap to tangency / radius",
              _GAPS, ONE, partial(gap, sign=1), 2),
        Sweep("start", "start near the wall", "distance from the wall / radius",
              _TO_ZERO, ONE, start, 2, weight=8),
        Sweep("faces", "Boolean faces close together", "distance between the faces",
              _TO_ZERO, ONE, faces, 2),
        Sweep("speed", "short and long directions", "length of the direction",
              _RANGE, ONE, speed, 2),
        Sweep("scale", "small and large scenes", "size of the scene", _RANGE, ONE, scale, 2),
        Sweep("hard", "hard to round", "distance from a tie of two doubles",
              tuple(map(two, (-20, -40, -80, -120, -160, -240, -320, -480, -640, -800, -1000))),
              two(-20), hard, 2, rounding=True),
    )
}  # fmt: skip
