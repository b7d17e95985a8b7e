"""Random rays of the scenarios that the figures name: a solid, origins and directions, by seed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from raycert.cases.model import Cylinder, InfiniteCylinder, Leaf, Sphere
from raycert.oracle.batch.lanes import Floats

SCENARIOS = ("random", "far", "thin", "tilted", "axis-aligned")
SOLIDS = ("infinite_cylinder", "cylinder", "sphere")


@dataclass(frozen=True, slots=True)
class Rays:
    """A solid, and rays aimed at it."""

    solid: Leaf
    origins: Floats
    directions: Floats


def rays(solid: str, scenario: str, count: int, seed: int) -> Rays:
    """Return rays of a scenario against a solid of the named type."""
    dice = np.random.default_rng([seed, SCENARIOS.index(scenario), SOLIDS.index(solid)])
    return _MAKE[scenario](solid, count, dice)


def solid_of(solid: str, p: Floats, q: Floats, r: float) -> Leaf:
    """Return a solid of the named type between two points."""
    a, b = (float(p[0]), float(p[1]), float(p[2])), (float(q[0]), float(q[1]), float(q[2]))
    match solid:
        case "sphere":
            return Sphere(a, r)
        case "cylinder":
            return Cylinder(a, b, r)
    return InfiniteCylinder(a, b, r)


def _aimed(
    solid: str, p: Floats, q: Floats, r: float, u: Floats, dice: np.random.Generator
) -> Rays:
    """Return rays from u to a cube of two radii each way about a point of the axis, or the center.

    So some hit and some miss: a quarter to a half hit.
    """
    share = 0.0 if solid == "sphere" else dice.uniform(0, 1, (len(u), 1))
    target = p + (q - p) * share + 2 * r * dice.uniform(-1, 1, u.shape)
    return Rays(solid_of(solid, p, q, r), u, target - u)


def _random(solid: str, n: int, dice: np.random.Generator) -> Rays:
    p, q = dice.uniform(-1, 1, (2, 3))
    return _aimed(solid, p, q, 0.7, dice.uniform(-8, 8, (n, 3)), dice)


def _far(solid: str, n: int, dice: np.random.Generator) -> Rays:
    p, q = dice.uniform(-1, 1, (2, 3))
    return _aimed(solid, p, q, 0.7, dice.uniform(-1e8, 1e8, (n, 3)), dice)


def _thin(solid: str, n: int, dice: np.random.Generator) -> Rays:
    p, q = dice.uniform(-1, 1, (2, 3))
    return _aimed(solid, p, q, 1e-9, dice.uniform(-8, 8, (n, 3)), dice)


def _tilted(solid: str, n: int, dice: np.random.Generator) -> Rays:
    """Return rays at 1e-1 to 1e-8 to the axis."""
    p, q = dice.uniform(-1, 1, (2, 3))
    tilt = 10.0 ** dice.uniform(-8, -1, (n, 1))
    v = (q - p) * dice.choice([-1.0, 1.0], (n, 1)) + tilt * dice.uniform(-1, 1, (n, 3))
    u = p + dice.uniform(-1, 1, (n, 3)) - dice.uniform(0, 4, (n, 1)) * v
    return Rays(solid_of(solid, p, q, 0.7), u, v)


def _aligned(solid: str, n: int, dice: np.random.Generator) -> Rays:
    """Return rays along the axes, of full precision; many coordinates are the solid's own."""
    p = dice.uniform(-1, 1, 3)
    q = p + np.array([0.0, 0.0, dice.uniform(1, 2)])
    u = dice.uniform(-4, 4, (n, 3))
    u = np.where(dice.random((n, 3)) < 1 / 3, p, u)
    near = p + dice.uniform(-1, 1, (n, 3))
    u = np.where(dice.random((n, 3)) < 1 / 3, near, u)
    v = np.eye(3)[dice.integers(3, size=n)] * dice.choice([1.0, -1.0, 2.0, 3.0], (n, 1))
    return Rays(solid_of(solid, p, q, 0.7), u, v)


_MAKE: dict[str, Callable[[str, int, np.random.Generator], Rays]] = {
    "random": _random,
    "far": _far,
    "thin": _thin,
    "tilted": _tilted,
    "axis-aligned": _aligned,
}
