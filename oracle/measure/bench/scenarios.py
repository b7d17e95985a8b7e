"""The rays that all methods answer, by scenario: always the same for a seed, on every machine.

    random    rays from a few lengths away at a capped cylinder; one in three or so misses
    far       the same from 1e2 to 1e8 radii away
    thin      radius over height from 1e-3 to 1e-9
    tilted    1e-2 to 1e-8 rad off the axis, from near the wall, of a cylinder as long as it takes
    tangent   past the axis at r (1 +- 10^-k), k to 15, and at r; one in two starts there
    rim       at the rim, 10^-k radii beside it
    tiny      random, the scene 2^-500 times as large; in one half the direction too
    huge      random, 2^500 times as large
    boolean   random rays at four trees of all solids
    ties      t within 2^-2j of the middle between two doubles: constructed to be hard to round

Each scenario has four solids, with as many rays each: a batch needs many rays of one solid.
"""

from __future__ import annotations

from collections.abc import Callable

from raycert.cases.dice import Dice
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
)
from raycert.oracle.measure.bench.shapes import (
    Can,
    cross,
    heading,
    plus,
    real,
    spoke,
    times,
    towards,
)
from raycert.oracle.measure.methods.method import Case

SOLIDS = 4
Draw = Callable[[Dice, int], list[Case]]
"""From dice and a number of rays to the cases of the n-th solid."""


def ten(k: int) -> float:
    """Return 10^-k, correctly rounded."""
    return 1.0 / float(10**k) if k >= 0 else float(10**-k)


def _can(dice: Dice) -> Can:
    return Can.of(dice, real(dice, 0.2, 2), real(dice, 1, 4))


def _aimed(dice: Dice, can: Can, reach: float) -> Ray:
    """Return a ray from `reach` radii and heights away at the can or beside it."""
    target = can.point(real(dice, -0.2, 1.2), real(dice, 0, 1.3), spoke(dice))
    start = plus(target, (reach * (can.solid.radius + can.height), heading(dice)))
    return towards(start, target, real(dice, 0.3, 3))


def _random(dice: Dice, number: int, rays: int) -> list[Case]:
    can = _can(dice)
    return [Case(can.solid, _aimed(dice, can, real(dice, 0.5, 3))) for _ in range(rays)]


def _far(dice: Dice, number: int, rays: int) -> list[Case]:
    can, found = _can(dice), []
    for i in range(rays):
        target = can.point(real(dice, -0.2, 1.2), real(dice, 0, 1.3), spoke(dice))
        way, away = heading(dice), can.solid.radius * ten(-2 - i % 7)
        found.append(
            Case(can.solid, Ray(plus(target, (-away, way)), times(real(dice, 0.3, 3), way)))
        )
    return found


def _thin(dice: Dice, number: int, rays: int) -> list[Case]:
    can, found = Can.of(dice, ten(3 + 2 * number), 1.0), []
    for _ in range(rays):
        target = can.point(real(dice, -0.2, 1.2), real(dice, 0, 1.3), spoke(dice))
        start = plus(target, (real(dice, 0.5, 3), heading(dice)))
        found.append(Case(can.solid, towards(start, target, real(dice, 0.3, 3))))
    return found


def _tilted(dice: Dice, number: int, rays: int) -> list[Case]:
    tilt = ten(2 + 2 * number)
    can, found = Can.of(dice, real(dice, 0.5, 2), real(dice, 2, 4) / tilt), []
    for _ in range(rays):
        way = spoke(dice)
        start = can.point(real(dice, -0.2, 0.3), real(dice, 0.9, 1.5), way)
        inward = plus(
            (0.0, 0.0, 0.0), (-1.0, can.outward(way)), (real(dice, 0, 3), can.outward(spoke(dice)))
        )
        slope = tilt * real(dice, 0.5, 2)
        found.append(Case(can.solid, Ray(start, plus(can.n, (slope, inward)))))
    return found


def _tangent(dice: Dice, number: int, rays: int) -> list[Case]:
    can, found = _can(dice), []
    for i in range(rays):
        away, kind = can.outward(spoke(dice)), (i + i // 4) % 4
        gap = ten(3 + i // 4 % 13) * (-1, 1, -1, 0)[kind]
        along = plus(cross(can.n, away), (real(dice, -0.3, 0.3) if gap else 0.0, can.n))
        middle = plus(can.solid.p, (real(dice, 0.2, 0.8) * can.height, can.n))
        nearest = plus(middle, (can.solid.radius * (1 + gap), away))
        back = 0.0 if kind > 1 else real(dice, 1, 5)
        found.append(Case(can.solid, Ray(plus(nearest, (-back, along)), along)))
    return found


def _rim(dice: Dice, number: int, rays: int) -> list[Case]:
    can, found = _can(dice), []
    for i in range(rays):
        gap, low = ten(3 + i % 13), dice.integer(0, 1)
        across, rise = real(dice, -1, 1) * gap, real(dice, -1, 1) * gap
        target = can.point(low + rise, 1 + across, spoke(dice))
        start = plus(target, (real(dice, 0.5, 3) * can.height, heading(dice)))
        found.append(Case(can.solid, towards(start, target, real(dice, 0.3, 3))))
    return found


def _scaled(k: float) -> Callable[[Dice, int, int], list[Case]]:
    def draw(dice: Dice, number: int, rays: int) -> list[Case]:
        found = []
        for i, (solid, ray) in enumerate(_random(dice, number, rays)):
            assert isinstance(solid, Cylinder)
            larger = Cylinder(times(k, solid.p), times(k, solid.q), k * solid.radius)
            pace = k if i % 2 else 1.0
            found.append(Case(larger, Ray(times(k, ray.origin), times(pace, ray.direction))))
        return found

    return draw


def _boolean(dice: Dice, number: int, rays: int) -> list[Case]:
    can, other = _can(dice), _can(dice)
    center = can.point(0.5, 0.5, spoke(dice))
    ball = Sphere(center, can.solid.radius)
    slab = Slab(can.point(0.3, 0.0, (1.0, 0.0)), can.point(0.6, 0.0, (1.0, 0.0)))
    half = HalfSpace(center, heading(dice))
    rod = InfiniteCylinder(center, plus(center, (1.0, heading(dice))), 0.5 * can.solid.radius)
    tree: Solid = (
        Difference((can.solid, ball)),
        Union((can.solid, other.solid, ball)),
        Intersection((ball, slab, half)),
        Difference((Union((can.solid, ball)), rod, Intersection((slab, half)))),
    )[number]
    return [Case(tree, _aimed(dice, can, real(dice, 0.5, 3))) for _ in range(rays)]


def _ties(dice: Dice, number: int, rays: int) -> list[Case]:
    """Return rays along a coordinate axis past that of the cylinder at y = 2^-j.

    The origin is at x in [6, 8), a multiple of 2^-50, and r in (1, 2) an odd one of 2^-51, half a
    unit of t = x - r + y^2 / 2r + ... in [4, 7): so x - r is a tie, and t just above it. The tie
    itself is made to round down, to even: who does not see that it is none is wrong.
    """
    turn, half = number % 3, dice.integer(0, 2**50 - 1)
    radius = 1 + (2 * half + 1) * 2.0**-51

    def turned(x: float, y: float, z: float) -> Vector:
        a = (x, y, z)
        return (a[turn], a[(turn + 1) % 3], a[(turn + 2) % 3])

    solid, found = Cylinder(turned(0, 0, -4), turned(0, 0, 4), radius), []
    for i in range(rays):
        x = 6 + (2 * dice.integer(0, 2**50 - 1) + (half + 1) % 2) * 2.0**-50
        y = 2.0 ** -TIES[i % len(TIES)]
        start = turned(-x, y, real(dice, -3, 3))
        found.append(Case(solid, Ray(start, turned(1, 0, 0))))
    return found


TIES = (30, 40, 60, 80, 120, 200, 300, 500)
SCENARIOS: dict[str, Callable[[Dice, int, int], list[Case]]] = {
    "random": _random,
    "far": _far,
    "thin": _thin,
    "tilted": _tilted,
    "tangent": _tangent,
    "rim": _rim,
    "tiny": _scaled(2.0**-500),
    "huge": _scaled(2.0**500),
    "boolean": _boolean,
    "ties": _ties,
}


def scenario(name: str, rays: int, seed: int = 1) -> list[Case]:
    """Return so many cases of a scenario, rounded up to a multiple of its four solids.

    Of each solid, fewer rays are the first of more.
    """
    each = -(-rays // SOLIDS)
    dice = (Dice(f"bench {name} {seed} {n}") for n in range(SOLIDS))
    return [case for n, own in enumerate(dice) for case in SCENARIOS[name](own, n, each)]
