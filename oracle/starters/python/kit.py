"""What most adapters need between raycert and a library: take what yours asks for.

The pieces and their order, for a library that knows a cylinder about z, centred, and segments:

    frame, local, turned   its coordinates: p at the origin, the axis along z
    shifted                the origin in the middle of the axis, for half heights
    unit, rescaled         its direction and |v|, and t = s / |v| of distances s along it
    far_end                its segment, past the solid: a fraction f of it is s = f length
    paired                 its crossings, with its test of a point, as intervals
    clipped                its intervals of a whole line, from 0 on

Nothing here has a tolerance, and what it rounds is as little as a few roundings of the input.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import pairwise
from math import frexp, hypot, inf, ldexp
from typing import NamedTuple

Vector = tuple[float, float, float]
Pair = tuple[float, float]


class Frame(NamedTuple):
    """Coordinates in which p is the origin and q is (0, 0, height)."""

    p: Vector
    x: Vector
    y: Vector
    z: Vector
    height: float


def frame(p: Vector, q: Vector) -> Frame:
    """Return the frame of an axis: of one along a coordinate axis it is exact."""
    (a, b, c), height = unit((q[0] - p[0], q[1] - p[1], q[2] - p[2]))
    s = -1.0 if c < 0 else 1.0
    k = -1 / (s + c)
    x = (1 + s * a * a * k, s * a * b * k, -s * a)
    return Frame(p, x, (a * b * k, s + b * b * k, -b), (a, b, c), height)


def local(f: Frame, point: Vector) -> Vector:
    """Return a point in the coordinates of the frame: from p first, then turned."""
    return turned(f, (point[0] - f.p[0], point[1] - f.p[1], point[2] - f.p[2]))


def turned(f: Frame, v: Vector) -> Vector:
    """Return a direction in the coordinates of the frame."""
    x, y, z = (a[0] * v[0] + a[1] * v[1] + a[2] * v[2] for a in (f.x, f.y, f.z))
    return (x, y, z)


def shifted(f: Frame, point: Vector) -> Vector:
    """Return a local point seen from the middle of the axis; the half height is f.height / 2."""
    return (point[0], point[1], point[2] - f.height / 2)


def unit(v: Vector) -> tuple[Vector, float]:
    """Return v / |v| and |v|; for the zero direction, which has no unit, itself and 0."""
    length = hypot(*v)
    return ((v[0] / length, v[1] / length, v[2] / length) if length else v), length


def far_end(start: Vector, d: Vector, size: float) -> tuple[Vector, float]:
    """Return the end of a segment from start along the unit d, and its length.

    It ends beyond a solid within `size` of the origin. The length is a power of two: no fraction
    of it rounds.
    """
    length = ldexp(2.0, frexp(hypot(*start) + size)[1])
    return (start[0] + length * d[0], start[1] + length * d[1], start[2] + length * d[2]), length


def paired(crossings: Iterable[float], far: float, inside: Callable[[float], bool]) -> list[Pair]:
    """Return the intervals within [0, far] that crossings bound, in any order, doubled or not.

    Crossings that bound nothing do no harm: those of all the planes and walls of a solid will do.
    Whether the ray is inside between two is asked of two points there, as one may be where it
    grazes; before the first and after the last of the start and the far end too. What is inside up
    to `far` is endless; a crossing that is inside, with nothing inside on either side, is a touch.
    `inside` has to take what is within a rounding of the boundary for inside, or a chord that
    grazes falls apart.
    """
    ends = sorted({c + 0.0 for c in crossings if 0 <= c < far})
    knots = sorted({0.0, *ends, far})
    found: list[Pair] = []
    before = False
    for a, b in pairwise(knots):
        now = all(inside(a + part * (b - a)) for part in (0.375, 0.625))
        now = now and (a > 0 or inside(a)) and (b < far or inside(b))
        if now and before:
            a, _ = found.pop()
        if now:
            found.append((a, b if b < far else inf))
        elif not before and a in ends and inside(a):
            found.append((a, a))
        before = now
    return found


def clipped(pairs: Iterable[Pair]) -> list[Pair]:
    """Return the part with t >= 0 of intervals of a whole line."""
    return [(a if a > 0 else 0.0, b) for a, b in pairs if b >= 0]


def rescaled(pairs: Iterable[Pair], length: float) -> list[Pair]:
    """Return distances along a unit direction as the t of a direction of this length."""
    return [(a / length, b / length) for a, b in pairs]
