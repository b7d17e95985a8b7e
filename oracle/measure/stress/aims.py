"""The sweeps of distance, aspect, tilt and scale: where a sample's ray starts, and where it goes.

Each function takes the draw of a sample, its number and the parameter. Numbers alternate between
frames along the coordinate axes, where rounding leaves the sketch as it is, and oblique ones.
"""

from __future__ import annotations

from fractions import Fraction

from raycert.cases.draw import Draw
from raycert.cases.families.frames import Exact
from raycert.cases.families.sketch import Body, pipe, rod, times
from raycert.oracle.measure.stress.sample import Sample, before, disc, frame, heading, real, root

FAR_UP = 4096
LAST_OBLIQUE_TILT = Fraction(1, 10**15)
"""Less than that cannot be told from parallel in an oblique frame."""


def drum(draw: Draw) -> tuple[Body, Fraction, Exact]:
    """Return a cylinder about as high as wide, its radius, and a point deep inside."""
    radius, height = real(draw, 0.5, 1), real(draw, 2, 4)
    a, b = disc(draw, 0.875)
    share = real(draw, 0.25, 0.75)
    return rod((0, 0, 0), (0, 0, height), radius), radius, (a * radius, b * radius, share * height)


def far(draw: Draw, number: int, x: Fraction) -> Sample:
    """Start x radii before a point inside; half of the rays along a coordinate axis."""
    body, radius, target = drum(draw)
    place, direction = frame(draw, bool(number % 2)), heading(draw)
    if not number % 2:
        direction = (1, 0, 0)
    return Sample(body, before(target, direction, x * radius), direction, place)


def displaced(draw: Draw, number: int, x: Fraction) -> Sample:
    """Ray and cylinder near each other, x radii from the coordinate origin."""
    body, radius, target = drum(draw)
    place, direction, back = frame(draw, bool(number % 2)), heading(draw), real(draw, 2, 4)
    away = times(x * radius * place.stretch, place.vector(heading(draw)))
    return Sample(body, before(target, direction, back * radius), direction, place.moved(away))


def thin(draw: Draw, number: int, x: Fraction) -> Sample:
    """Meet a needle or a disk, x = r/h, from about its own size, or its smaller one."""
    radius, height = min(x, Fraction(1)), min(1 / x, Fraction(1))
    a, b = disc(draw, 0.875)
    target = (a * radius, b * radius, real(draw, 0.125, 0.875) * height)
    place, back, (d, e, f) = frame(draw, bool(number % 2)), real(draw, 2, 4), heading(draw)
    near = number % 4 < 2
    direction: Exact = (d * radius, e * radius, f * height) if near else (d, e, f)
    if number % 4 == 2:
        direction = (1, 0, 0) if x < 1 else (0, 0, 1)
    body = rod((0, 0, 0), (0, 0, height), radius)
    return Sample(body, before(target, direction, back), direction, place)


def _tilt(draw: Draw, number: int, x: Fraction, height: int) -> Sample:
    """Start `height` radii up the axis: outside the wall and going in, or inside and going out.

    Three in four starts are about x radii from the wall, and meet it within a radius of their way.
    """
    radius, beside, gap = real(draw, 0.5, 1), real(draw, -0.875, 0.875), real(draw, 0.001, 0.125)
    if number % 8 > 1:
        gap *= x
    place = frame(draw, bool(number % 2) and x >= LAST_OBLIQUE_TILT)
    lean, z = real(draw, -0.25, 0.25), real(draw, -1, 1) + draw.sign() * height
    half = root(1 - beside * beside)
    start = -half - gap if number % 4 < 2 else half - gap
    origin = (start * radius, beside * radius, z * radius)
    body = pipe((0, 0, 0), (0, 0, real(draw, 2, 4)), radius)
    return Sample(body, origin, (x, x * lean, draw.sign()), place)


def tilt_wall(draw: Draw, number: int, x: Fraction) -> Sample:
    """Start near the wall and near p, x radians from parallel to the axis."""
    return _tilt(draw, number, x, 0)


def tilt_axis(draw: Draw, number: int, x: Fraction) -> Sample:
    """Start 4096 radii up the axis, else the same."""
    return _tilt(draw, number, x, FAR_UP)


def _plain(draw: Draw, number: int) -> Sample:
    """Return a plain scene; every fourth start is inside."""
    body, radius, target = drum(draw)
    place, direction = frame(draw, bool(number % 2)), heading(draw)
    back = 0 if number % 4 == 3 else real(draw, 2, 4)
    return Sample(body, before(target, direction, back * radius), direction, place)


def speed(draw: Draw, number: int, x: Fraction) -> Sample:
    """Return a plain scene, the direction x times as long."""
    plain = _plain(draw, number)
    return Sample(plain.shape, plain.origin, times(x, plain.direction), plain.frame)


def scale(draw: Draw, number: int, x: Fraction) -> Sample:
    """Return a plain scene, every length x times as long, that of the direction too."""
    plain = _plain(draw, number)
    return Sample(plain.shape, plain.origin, plain.direction, plain.frame.scaled(x))
