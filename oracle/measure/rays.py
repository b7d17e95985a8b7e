"""A set of rays is asked: by name and seed always the same, on every machine.

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
    axis-aligned  of full precision, along the axes; many coordinates are the solid's own
    touching  small integers throughout: each ray touches, at halves and thirds

Each set has four solids, with as many rays each: a batch needs many rays of one solid. Numbers are
made by + - * / and square roots only, which are correctly rounded everywhere.

`arrays` has five of them for hundreds of thousands of rays at one solid, drawn by NumPy; about a
third of its rays hit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt
from typing import TYPE_CHECKING, Any

from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
)
from raycert.cases.vectors import along, cross, dot, minus, times
from raycert.oracle.measure.way import Case

if TYPE_CHECKING:
    import numpy as np

    from raycert.oracle.batch.lanes import Floats

SOLIDS = 4
ORIGIN: Vector = (0.0, 0.0, 0.0)
Draw = Callable[[Dice, int, int], list[Case]]
"""From dice, the number of the solid, and a number of rays to cases."""


# Points and solids.


def ten(k: int) -> float:
    """Return 10^-k, correctly rounded."""
    return 1.0 / float(10**k) if k >= 0 else float(10**-k)


def real(dice: Dice, low: float = -1.0, high: float = 1.0) -> float:
    """Return a number between two."""
    return dice.real(BINARY64, low, high)


def unit(a: Vector) -> Vector:
    """Return a / |a|, by a square root: `hypot` is not the same on every machine."""
    return times(1 / sqrt(dot(a, a)), a)


def heading(dice: Dice) -> Vector:
    """Return a direction, none preferred."""
    while True:
        a = dice.vector(BINARY64)
        if 0.01 < dot(a, a) < 1:
            return unit(a)


def spoke(dice: Dice) -> tuple[float, float]:
    """Return a direction of the plane."""
    while True:
        x, y = real(dice), real(dice)
        if 0.01 < x * x + y * y < 1:
            length = sqrt(x * x + y * y)
            return x / length, y / length


@dataclass(frozen=True)
class Can:
    """A capped cylinder, and a frame of its own: n along the axis, e and f across."""

    solid: Cylinder
    n: Vector
    e: Vector
    f: Vector
    height: float

    @classmethod
    def of(cls, dice: Dice, radius: float, height: float) -> Can:
        """Return one somewhere near the origin, any way up."""
        p, n = dice.vector(BINARY64, -1, 1), heading(dice)
        e = unit(cross(n, (0.0, 0.0, 1.0) if abs(n[2]) < 0.7 else (1.0, 0.0, 0.0)))
        return cls(Cylinder(p, along(p, height, n), radius), n, e, cross(n, e), height)

    def point(self, rise: float, across: float, way: tuple[float, float]) -> Vector:
        """Return the point at a share of the height, so many radii from the axis, some way."""
        level = along(self.solid.p, rise * self.height, self.n)
        return along(level, across * self.solid.radius, self.outward(way))

    def outward(self, way: tuple[float, float]) -> Vector:
        """Return the direction across the axis that a way names."""
        return along(along(ORIGIN, way[0], self.e), way[1], self.f)

    def beside(self, dice: Dice) -> Vector:
        """Return a point in the solid or a little beside it."""
        return self.point(real(dice, -0.2, 1.2), real(dice, 0, 1.3), spoke(dice))


def towards(start: Vector, target: Vector, pace: float) -> Ray:
    """Return the ray that is at the target at t = 1 / pace."""
    return Ray(start, times(pace, minus(target, start)))


# The sets.


def _can(dice: Dice) -> Can:
    return Can.of(dice, real(dice, 0.2, 2), real(dice, 1, 4))


def _aimed(dice: Dice, can: Can, reach: float) -> Ray:
    """Return a ray from `reach` radii and heights away at the can or beside it."""
    target = can.beside(dice)
    start = along(target, reach * (can.solid.radius + can.height), heading(dice))
    return towards(start, target, real(dice, 0.3, 3))


def _random(dice: Dice, number: int, rays: int) -> list[Case]:
    can = _can(dice)
    return [Case(can.solid, _aimed(dice, can, real(dice, 0.5, 3))) for _ in range(rays)]


def _far(dice: Dice, number: int, rays: int) -> list[Case]:
    can = _can(dice)

    def ray(i: int) -> Ray:
        target, way, away = can.beside(dice), heading(dice), can.solid.radius * ten(-2 - i % 7)
        return Ray(along(target, -away, way), times(real(dice, 0.3, 3), way))

    return [Case(can.solid, ray(i)) for i in range(rays)]


def _thin(dice: Dice, number: int, rays: int) -> list[Case]:
    can = Can.of(dice, ten(3 + 2 * number), 1.0)

    def ray() -> Ray:
        target = can.beside(dice)
        start = along(target, real(dice, 0.5, 3), heading(dice))
        return towards(start, target, real(dice, 0.3, 3))

    return [Case(can.solid, ray()) for _ in range(rays)]


def _tilted(dice: Dice, number: int, rays: int) -> list[Case]:
    tilt = ten(2 + 2 * number)
    can = Can.of(dice, real(dice, 0.5, 2), real(dice, 2, 4) / tilt)

    def ray() -> Ray:
        way = spoke(dice)
        start = can.point(real(dice, -0.2, 0.3), real(dice, 0.9, 1.5), way)
        inward = along(ORIGIN, -1.0, can.outward(way))
        inward = along(inward, real(dice, 0, 3), can.outward(spoke(dice)))
        return Ray(start, along(can.n, tilt * real(dice, 0.5, 2), inward))

    return [Case(can.solid, ray()) for _ in range(rays)]


def _tangent(dice: Dice, number: int, rays: int) -> list[Case]:
    can = _can(dice)

    def ray(i: int) -> Ray:
        away, kind = can.outward(spoke(dice)), (i + i // 4) % 4
        gap = ten(3 + i // 4 % 13) * (-1, 1, -1, 0)[kind]
        way = along(cross(can.n, away), real(dice, -0.3, 0.3) if gap else 0.0, can.n)
        middle = along(can.solid.p, real(dice, 0.2, 0.8) * can.height, can.n)
        nearest = along(middle, can.solid.radius * (1 + gap), away)
        return Ray(along(nearest, -(0.0 if kind > 1 else real(dice, 1, 5)), way), way)

    return [Case(can.solid, ray(i)) for i in range(rays)]


def _rim(dice: Dice, number: int, rays: int) -> list[Case]:
    can = _can(dice)

    def ray(i: int) -> Ray:
        gap, low = ten(3 + i % 13), dice.integer(0, 1)
        across, rise = real(dice, -1, 1) * gap, real(dice, -1, 1) * gap
        target = can.point(low + rise, 1 + across, spoke(dice))
        start = along(target, real(dice, 0.5, 3) * can.height, heading(dice))
        return towards(start, target, real(dice, 0.3, 3))

    return [Case(can.solid, ray(i)) for i in range(rays)]


def _scaled(k: float) -> Draw:
    def draw(dice: Dice, number: int, rays: int) -> list[Case]:
        cases = []
        for i, (solid, ray) in enumerate(_random(dice, number, rays)):
            assert isinstance(solid, Cylinder)
            larger = Cylinder(times(k, solid.p), times(k, solid.q), k * solid.radius)
            pace = k if i % 2 else 1.0
            cases.append(Case(larger, Ray(times(k, ray.origin), times(pace, ray.direction))))
        return cases

    return draw


def _boolean(dice: Dice, number: int, rays: int) -> list[Case]:
    can, other = _can(dice), _can(dice)
    center = can.point(0.5, 0.5, spoke(dice))
    ball = Sphere(center, can.solid.radius)
    slab = Slab(can.point(0.3, 0.0, (1.0, 0.0)), can.point(0.6, 0.0, (1.0, 0.0)))
    half = HalfSpace(center, heading(dice))
    rod = InfiniteCylinder(center, along(center, 1.0, heading(dice)), 0.5 * can.solid.radius)
    tree: Solid = (
        Difference((can.solid, ball)),
        Union((can.solid, other.solid, ball)),
        Intersection((ball, slab, half)),
        Difference((Union((can.solid, ball)), rod, Intersection((slab, half)))),
    )[number]
    return [Case(tree, _aimed(dice, can, real(dice, 0.5, 3))) for _ in range(rays)]


def _turned(turn: int, x: float, y: float, z: float) -> Vector:
    a = (x, y, z)
    return (a[turn], a[(turn + 1) % 3], a[(turn + 2) % 3])


def _ties(dice: Dice, number: int, rays: int) -> list[Case]:
    """Return rays along a coordinate axis past that of the cylinder at y = 2^-j.

    The origin is at x in [6, 8), a multiple of 2^-50, and r in (1, 2) an odd one of 2^-51, half a
    unit of t = x - r + y^2 / 2r + ... in [4, 7): so x - r is a tie, and t just above it. The tie
    itself is made to round down, to even: who does not see that it is none is wrong.
    """
    turn, half = number % 3, dice.integer(0, 2**50 - 1)
    radius = 1 + (2 * half + 1) * 2.0**-51
    solid = Cylinder(_turned(turn, 0, 0, -4), _turned(turn, 0, 0, 4), radius)

    def ray(i: int) -> Ray:
        x = 6 + (2 * dice.integer(0, 2**50 - 1) + (half + 1) % 2) * 2.0**-50
        y = 2.0 ** -TIES[i % len(TIES)]
        return Ray(_turned(turn, -x, y, real(dice, -3, 3)), _turned(turn, 1, 0, 0))

    return [Case(solid, ray(i)) for i in range(rays)]


def _aligned(dice: Dice, number: int, rays: int) -> list[Case]:
    p, height = dice.vector(BINARY64, -1, 1), real(dice, 1, 2)
    solid = Cylinder(p, (p[0], p[1], p[2] + height), 0.7)

    def coordinate(own: float) -> float:
        return (own, real(dice, -4, 4), own + real(dice, -1, 1))[dice.integer(0, 2)]

    def ray() -> Ray:
        start = (coordinate(p[0]), coordinate(p[1]), coordinate(p[2]))
        pace = (1.0, -1.0, 2.0, 3.0)[dice.integer(0, 3)]
        return Ray(start, _turned(dice.integer(0, 2), pace, 0, 0))

    return [Case(solid, ray()) for _ in range(rays)]


def _touching(dice: Dice, number: int, rays: int) -> list[Case]:
    """Return rays in coordinate directions, square to the axis, in a tangent plane of the wall."""
    turn, height, radius = (dice.integer(*span) for span in ((0, 2), (1, 4), (1, 4)))
    p = (float(dice.integer(-4, 4)), float(dice.integer(-4, 4)), float(dice.integer(-4, 4)))
    solid = Cylinder(p, along(p, 1.0, _turned(turn, height, 0, 0)), float(radius))

    def ray() -> Ray:
        rise, back, pace = dice.integer(0, height), dice.integer(0, 4), dice.integer(1, 3)
        start = along(p, 1.0, _turned(turn, rise, radius, -back))
        return Ray(start, _turned(turn, 0.0, 0.0, pace))

    return [Case(solid, ray()) for _ in range(rays)]


TIES = (30, 40, 60, 80, 120, 200, 300, 500)
SETS: dict[str, Draw] = {
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
    "axis-aligned": _aligned,
    "touching": _touching,
}


def rays_of(name: str, rays: int, seed: int = 1) -> list[Case]:
    """Return so many cases of a set, rounded up to a multiple of its four solids.

    Of each solid, fewer rays are the first of more.
    """
    each = -(-rays // SOLIDS)
    dice = (Dice(f"bench {name} {seed} {n}") for n in range(SOLIDS))
    return [case for n, own in enumerate(dice) for case in SETS[name](own, n, each)]


# Arrays of rays.

ARRAYS = ("random", "far", "thin", "tilted", "axis-aligned")
LEAVES = ("infinite_cylinder", "cylinder", "sphere")


@dataclass(frozen=True, slots=True)
class Rays:
    """A solid, and rays aimed at it."""

    solid: Leaf
    origins: Floats
    directions: Floats


def arrays(solid: str, name: str, count: int, seed: int) -> Rays:
    """Return rays of a set against a solid of the named type."""
    import numpy as np

    dice = np.random.default_rng([seed, ARRAYS.index(name), LEAVES.index(solid)])
    p, q = dice.uniform(-1, 1, (2, 3))
    if name == "axis-aligned":
        q = p + np.array([0.0, 0.0, dice.uniform(1, 2)])
    leaf = _leaf(solid, p, q, 1e-9 if name == "thin" else 0.7)
    if name == "tilted":
        return Rays(leaf, *_arrays_tilted(p, q, count, dice))
    if name == "axis-aligned":
        return Rays(leaf, *_arrays_aligned(p, count, dice))
    reach = 1e8 if name == "far" else 8
    u = dice.uniform(-reach, reach, (count, 3))
    # At a cube of two radii each way about a point of the axis: a quarter to a half hit.
    share = 0.0 if solid == "sphere" else dice.uniform(0, 1, (count, 1))
    target = p + (q - p) * share + 2 * leaf.radius * dice.uniform(-1, 1, u.shape)
    return Rays(leaf, u, target - u)


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
