"""A set of rays is asked: by name and seed always the same, on every machine.

Each set has four solids, with as many rays each: a batch needs many rays of one solid. They are
sketched in exact numbers as the samples of sweeps are, and rounded to doubles once.

`arrays` has five of them for hundreds of thousands of rays at one solid, drawn by NumPy; about a
third of its rays hit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from raycert.cases.dice import Dice
from raycert.cases.draw import Draw
from raycert.cases.families.frames import ALIGNED, Exact, Frame, Number, X, Y, Z
from raycert.cases.families.sketch import (
    Ball,
    Body,
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
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, InfiniteCylinder, Leaf, Sphere
from raycert.oracle.measure.sweeps import (
    Sample,
    before,
    frame_of,
    heading,
    on_circle,
    point_of,
    real,
)
from raycert.oracle.measure.way import Case

if TYPE_CHECKING:
    import numpy as np

    from raycert.oracle.batch.lanes import Floats

SOLIDS = 4
Rays = Callable[[int], Sample]
"""From the number of a ray to its sample; all of one solid."""


def _can(draw: Draw) -> tuple[Body, Frame]:
    return cylinder(real(draw, 0.2, 2), real(draw, 1, 4)), _place(draw)


def _place(draw: Draw) -> Frame:
    """Return an oblique frame somewhere near the origin."""
    return frame_of(draw, oblique=True).moved(
        (real(draw, -1, 1), real(draw, -1, 1), real(draw, -1, 1))
    )


def _aimed(draw: Draw, body: Body, place: Frame, back: Number) -> Sample:
    """Return a ray from a distance at the body or a little beside it."""
    target, direction = point_of(draw, body, 1.25, -0.2, 1.2), heading(draw)
    return Sample(body, before(target, direction, back), direction, place)


def _random(draw: Draw, number: int) -> Rays:
    """Return rays from a few lengths away; one in five or so misses."""
    body, place = _can(draw)
    size = body.radius + body.q[2]
    return lambda i: _aimed(draw, body, place, real(draw, 0.5, 3) * size)


def _far(draw: Draw, number: int) -> Rays:
    body, place = _can(draw)
    return lambda i: _aimed(draw, body, place, body.radius * ten(2 + i % 7))


def _thin(draw: Draw, number: int) -> Rays:
    body, place = cylinder(ten(-3 - 2 * number), 1), _place(draw)
    return lambda i: _aimed(draw, body, place, real(draw, 0.5, 3))


def _tilted(draw: Draw, number: int) -> Rays:
    tilt = ten(-2 - 2 * number)
    body, place = cylinder(real(draw, 0.5, 2), real(draw, 2, 4) / tilt), _place(draw)

    def ray(i: int) -> Sample:
        (c, s), out, lean = _spoke(draw), body.radius * real(draw, 0.9, 1.5), real(draw, -1.5, 1.5)
        start = (c * out, s * out, real(draw, -0.2, 0.3) * body.q[2])
        across: Exact = (-c - lean * s, lean * c - s, 0)
        climb = (0, 0, real(draw, 0.5, 2))
        return Sample(body, start, plus(climb, across, tilt), place)

    return ray


def _spoke(draw: Draw) -> tuple[Fraction, Fraction]:
    c, s = on_circle(draw)
    return draw.sign() * c, s


def _tangent(draw: Draw, number: int) -> Rays:
    """Return rays past the axis at r (1 +- 10^-k), and at r; one in two starts there."""
    body, place = _can(draw)

    def ray(i: int) -> Sample:
        (c, s), kind = _spoke(draw), (i + i // 4) % 4
        gap = ten(-3 - i // 4 % 13) * (-1, 1, -1, 0)[kind]
        out, level = body.radius * (1 + gap), real(draw, 0.2, 0.8) * body.q[2]
        direction = (-s, c, real(draw, -0.3, 0.3) if gap else 0)
        back = 0 if kind > 1 else real(draw, 1, 5)
        return Sample(body, before((c * out, s * out, level), direction, back), direction, place)

    return ray


def _rim(draw: Draw, number: int) -> Rays:
    body, place = _can(draw)

    def ray(i: int) -> Sample:
        (c, s), gap = _spoke(draw), ten(-3 - i % 13)
        out = body.radius * (1 + real(draw, -1, 1) * gap)
        level = (draw.whole(0, 1) + real(draw, -1, 1) * gap) * body.q[2]
        direction, back = heading(draw), real(draw, 0.5, 3) * body.q[2]
        return Sample(body, before((c * out, s * out, level), direction, back), direction, place)

    return ray


def _scaled(k: Fraction) -> Callable[[Draw, int], Rays]:
    def scaled(draw: Draw, number: int) -> Rays:
        """Return random rays, every other direction scaled too."""
        ray = _random(draw, number)

        def larger(i: int) -> Sample:
            one = ray(i)
            direction = one.direction if i % 2 else times(1 / k, one.direction)
            return replace(one, direction=direction, frame=one.frame.scaled(k))

        return larger

    return scaled


def _boolean(draw: Draw, number: int) -> Rays:
    body, place = _can(draw)
    radius, height = body.radius, body.q[2]
    center, far = point_of(draw, body), point_of(draw, body)
    other = rod(far, plus(far, heading(draw), height), real(draw, 0.2, 2))
    ball, slab = Ball(center, radius), layer((0, 0, height * two(-2)), (0, 0, height * two(-1)))
    half = below(center, heading(draw))
    tube = pipe(center, plus(center, heading(draw)), radius * two(-1))
    tree = (
        less(body, ball),
        any_of(body, other, ball),
        all_of(ball, slab, half),
        less(any_of(body, ball), tube, all_of(slab, half)),
    )[number]
    return lambda i: replace(_aimed(draw, body, place, real(draw, 1, 9)), shape=tree)


def _ties(draw: Draw, number: int) -> Rays:
    """Return rays along a coordinate axis past that of the cylinder at y = 2^-j.

    The origin is at x in [6, 8), a multiple of 2^-50, and r in (1, 2) an odd one of 2^-51, half a
    unit of t = x - r + y^2 / 2r + ... in [4, 7): so x - r is a tie, and t just above it. The tie
    itself is made to round down, to even: who does not see that it is none is wrong.
    """
    half = draw.whole(0, 2**50 - 1)
    body = rod((0, 0, -4), (0, 0, 4), 1 + (2 * half + 1) * two(-51))

    def ray(i: int) -> Sample:
        x = 6 + (2 * draw.whole(0, 2**50 - 1) + (half + 1) % 2) * two(-50)
        start = (-x, two(-TIES[i % len(TIES)]), real(draw, -3, 3))
        return Sample(body, start, X, ALIGNED[number % 3])

    return ray


def _aligned(draw: Draw, number: int) -> Rays:
    """Return rays of full precision, many of whose coordinates are the solid's own."""
    p = (real(draw, -1, 1), real(draw, -1, 1), real(draw, -1, 1))
    body = rod(p, plus(p, Z, real(draw, 1, 2)), Fraction(7, 10))

    def coordinate(own: Fraction) -> Fraction:
        return draw.pick((own, real(draw, -4, 4), own + real(draw, -1, 1)))

    def ray(i: int) -> Sample:
        start = (coordinate(p[0]), coordinate(p[1]), coordinate(p[2]))
        return Sample(body, start, times(draw.pick((1, -1, 2, 3)), draw.pick((X, Y, Z))))

    return ray


def _touching(draw: Draw, number: int) -> Rays:
    """Return rays in coordinate directions, square to the axis, in a tangent plane of the wall."""
    height, radius = draw.whole(1, 4), draw.whole(1, 4)
    shift = (draw.whole(-4, 4), draw.whole(-4, 4), draw.whole(-4, 4))
    body, place = cylinder(radius, height), draw.pick(ALIGNED).moved(shift)

    def ray(i: int) -> Sample:
        start = (radius, -draw.whole(0, 4), draw.whole(0, height))
        return Sample(body, start, (0, draw.whole(1, 3), 0), place)

    return ray


TIES = (30, 40, 60, 80, 120, 200, 300, 500)
SETS: dict[str, tuple[str, Callable[[Draw, int], Rays]]] = {
    "random": ("random rays at capped cylinders", _random),
    "far": ("starts 1e2 to 1e8 radii away", _far),
    "thin": ("radius over height 1e-3 to 1e-9", _thin),
    "tilted": ("1e-2 to 1e-8 rad off a long axis", _tilted),
    "tangent": ("within 1e-3 to 1e-15 r of tangency", _tangent),
    "rim": ("within 1e-3 to 1e-15 r of the rim", _rim),
    "tiny": ("scenes 2^-500 times as large", _scaled(two(-500))),
    "huge": ("scenes 2^500 times as large", _scaled(two(500))),
    "boolean": ("trees of all solids", _boolean),
    "ties": ("constructed to be hard to round", _ties),
    "axis-aligned": ("rays along the coordinate axes", _aligned),
    "touching": ("rays in tangent planes, small integers", _touching),
}
"""What the rays of a set are, and how they are drawn: from the number of the solid on."""


def rays_of(name: str, rays: int, seed: int = 1) -> list[Case]:
    """Return so many cases of a set, rounded up to a multiple of its four solids.

    Of each solid, fewer rays are the first of more.
    """
    draws = (Draw(Dice(f"bench {name} {seed} {n}"), BINARY64) for n in range(SOLIDS))
    each = [SETS[name][1](own, n) for n, own in enumerate(draws)]
    return [ray(i).posed() for ray in each for i in range(-(-rays // SOLIDS))]


# Arrays of rays.

ARRAYS = ("random", "far", "thin", "tilted", "axis-aligned")
LEAVES = ("infinite_cylinder", "cylinder", "sphere")


@dataclass(frozen=True, slots=True)
class Many:
    """A solid, and rays aimed at it."""

    solid: Leaf
    origins: Floats
    directions: Floats


def arrays(solid: str, name: str, count: int, seed: int) -> Many:
    """Return rays of a set against a solid of the named type."""
    import numpy as np

    dice = np.random.default_rng([seed, ARRAYS.index(name), LEAVES.index(solid)])
    p, q = dice.uniform(-1, 1, (2, 3))
    if name == "axis-aligned":
        q = p + np.array([0.0, 0.0, dice.uniform(1, 2)])
    leaf = _leaf(solid, p, q, 1e-9 if name == "thin" else 0.7)
    if name == "tilted":
        return Many(leaf, *_arrays_tilted(p, q, count, dice))
    if name == "axis-aligned":
        return Many(leaf, *_arrays_aligned(p, count, dice))
    reach = 1e8 if name == "far" else 8
    u = dice.uniform(-reach, reach, (count, 3))
    # At a cube of two radii each way about a point of the axis: a quarter to a half hit.
    share = 0.0 if solid == "sphere" else dice.uniform(0, 1, (count, 1))
    target = p + (q - p) * share + 2 * leaf.radius * dice.uniform(-1, 1, u.shape)
    return Many(leaf, u, target - u)


def _leaf(solid: str, p: Any, q: Any, r: float) -> Sphere | Cylinder | InfiniteCylinder:
    a, b = ((float(x), float(y), float(z)) for x, y, z in (p, q))
    if solid == "sphere":
        return Sphere(a, r)
    return (Cylinder if solid == "cylinder" else InfiniteCylinder)(a, b, r)


def _arrays_tilted(p: Any, q: Any, n: int, dice: np.random.Generator) -> tuple[Floats, Floats]:
    """Return rays at 1e-1 to 1e-8 to the axis."""
    tilt = 10.0 ** dice.uniform(-8, -1, (n, 1))
    v = (q - p) * dice.choice([-1.0, 1.0], (n, 1)) + tilt * dice.uniform(-1, 1, (n, 3))
    return p + dice.uniform(-1, 1, (n, 3)) - dice.uniform(0, 4, (n, 1)) * v, v


def _arrays_aligned(p: Any, n: int, dice: np.random.Generator) -> tuple[Floats, Floats]:
    """Return rays along the axes; many coordinates are the solid's own."""
    import numpy as np

    u = dice.uniform(-4, 4, (n, 3))
    u = np.where(dice.random((n, 3)) < 1 / 3, p, u)
    u = np.where(dice.random((n, 3)) < 1 / 3, p + dice.uniform(-1, 1, (n, 3)), u)
    return u, np.eye(3)[dice.integers(3, size=n)] * dice.choice([1.0, -1.0, 2.0, 3.0], (n, 1))
