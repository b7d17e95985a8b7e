"""The sweeps of small gaps: to tangency, between faces, from the surface, and beside a tie."""

from __future__ import annotations

from fractions import Fraction

from raycert.cases.draw import Draw
from raycert.cases.families.frames import FIFTHS, SEVENTHS, THIRDS, UPRIGHT, Exact
from raycert.cases.families.scale import START, half_unit
from raycert.cases.families.sketch import (
    Body,
    Shape,
    all_of,
    any_of,
    below,
    layer,
    less,
    pipe,
    rod,
    times,
    two,
)
from raycert.cases.families.touch import CONTACTS
from raycert.cases.formats import BINARY64
from raycert.oracle.measure.stress.sample import Sample, before, frame, heading, real, root

ROOM = two(-44)
"""The least gap that a Pythagorean contact in an oblique frame can hold exactly."""


def _rod(radius: Fraction | int) -> Body:
    return rod((0, 0, -8 * radius), (0, 0, 8 * radius), radius)


def _passing(draw: Draw, number: int, radius: Fraction, offset: Fraction) -> Sample:
    """Return a ray that passes the axis of `_rod` at `offset`, along a coordinate axis."""
    z, climb = draw.whole(-2, 2), draw.whole(-2, 2)
    place = frame(draw, oblique=False)
    origin: Exact = (-draw.whole(1, 9), offset, z)
    return Sample(_rod(radius), origin, (1, 0, climb if number % 4 else 0), place)


def _skew(draw: Draw, x: Fraction, sign: int) -> Sample:
    """Return a ray past a Pythagorean point moved in or out by the share x, exactly."""
    a, b, radius = draw.pick(CONTACTS)
    place, climb = draw.pick((FIFTHS, THIRDS, SEVENTHS)), draw.whole(-3, 3)
    contact, direction = times(1 + sign * x, (a, b, 0)), (b, -a, climb)
    origin = before(contact, direction, draw.whole(1, 3))
    return Sample(_rod(radius), origin, direction, place)


def _gap(draw: Draw, number: int, x: Fraction, sign: int) -> Sample:
    if number % 2 and x >= ROOM:
        return _skew(draw, x, sign)
    if sign < 0:
        return _passing(draw, number, Fraction(1), 1 - x)
    if 1 + x == Fraction(float(1 + x)):
        return _passing(draw, number, Fraction(1), 1 + x)
    return _passing(draw, number, 1 - x, Fraction(1))


def gap_inside(draw: Draw, number: int, x: Fraction) -> Sample:
    """Return a chord at (1 - x) r from the axis."""
    return _gap(draw, number, x, -1)


def gap_outside(draw: Draw, number: int, x: Fraction) -> Sample:
    """Return a miss at (1 + x) r from the axis: r / (1 - x) where 1 + x is no double."""
    return _gap(draw, number, x, 1)


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
        return Sample(_rod(1), (share, 0, draw.whole(-2, 2)), direction, frame(draw, False))
    y, radius = real(draw, -0.875, 0.875), real(draw, 0.5, 1)
    c, place = root(1 - y * y), frame(draw, True)
    origin = (c * share * radius, y * share * radius, real(draw, -2, 2))
    along: Exact = (c * lean - y * turn, y * lean + c * turn, climb)
    return Sample(_rod(radius), origin, along if tangent else general, place)


def faces(draw: Draw, number: int, x: Fraction) -> Sample:
    """Meet a Boolean with two faces x apart, on a slant.

    Stacked cylinders, a shell of two radii, and the overlap of a half-space and a slab.
    """
    place, slant = frame(draw, bool(number % 2)), real(draw, -0.25, 0.25)
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
