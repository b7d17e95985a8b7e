"""Rays and solids for the tests of the batch oracle, and its one law: the scalar oracle's lists."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from raycert.cases.formats import BINARY64, Format
from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Leaf, Slab, Solid, Sphere
from raycert.oracle.batch.blocks import Batch, scalar, trace_batch

Floats = NDArray[np.float64]
Make = Callable[[np.random.Generator], tuple[list[Leaf], Floats, Floats]]


def wrong(
    solid: Solid, u: Floats, v: Floats, fmt: Format = BINARY64, engine: str = "numpy"
) -> tuple[list[int], Batch]:
    """Return the lanes that are not the scalar oracle's, and the batch."""
    found = trace_batch(solid, u, v, fmt, engine)
    solve = scalar(solid, fmt)
    bad = [i for i in range(len(u)) if found.pairs(i) != solve(u[i].tolist(), v[i].tolist())]
    return bad, found


def leaves_of(p: Floats, q: Floats, r: float) -> list[Leaf]:
    """Return a leaf of each type."""
    a, b = tuple(p.tolist()), tuple(q.tolist())
    n = tuple((q - p).tolist())
    return [
        HalfSpace(a, n),
        Sphere(a, r),
        Slab(a, b),
        InfiniteCylinder(a, b, r),
        Cylinder(a, b, r),
    ]


def free(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return leaves and rays of random bits."""
    p, q = dice.uniform(-4, 4, (2, 3))
    u = dice.uniform(-6, 6, (n, 3))
    return leaves_of(p, q, 1.7), u, dice.uniform(-1, 1, (n, 3)) + (p - u) / 6


def far(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return rays from far away, aimed."""
    p, q = dice.uniform(-4, 4, (2, 3))
    u = dice.uniform(-1, 1, (n, 3)) * 10.0 ** dice.uniform(2, 12, (n, 1))
    return leaves_of(p, q, 1.7), u, (p + q) / 2 + dice.uniform(-2, 2, (n, 3)) - u


def thin(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return a needle, hit within a few of its radii."""
    p, q = dice.uniform(-4, 4, (2, 3))
    u = dice.uniform(-6, 6, (n, 3))
    hit = p + (q - p) * dice.uniform(0, 1, (n, 1)) + dice.uniform(-2e-9, 2e-9, (n, 3))
    return leaves_of(p, q, 1e-9), u, hit - u


def tilted(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return rays nearly along the axis, and some exactly."""
    p, q = dice.uniform(-4, 4, (2, 3))
    tilt = np.where(dice.random((n, 1)) < 0.9, 10.0 ** dice.uniform(-17, -1, (n, 1)), 0.0)
    v = (q - p) * dice.choice([-1.0, 1.0], (n, 1)) + tilt * dice.uniform(-1, 1, (n, 3))
    return leaves_of(p, q, 1.7), p + dice.uniform(-2, 2, (n, 3)) - v, v


def lattice(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return small integers: touches, rims, starts on faces, rays in walls, and no direction."""
    p, q = dice.integers(-2, 3, (2, 3)).astype(float)
    q = p + np.array([0.0, 0.0, 2.0]) if (p == q).all() else q
    u = dice.integers(-4, 5, (n, 3)).astype(float)
    v = dice.integers(-2, 3, (n, 3)).astype(float)
    return leaves_of(p, q, float(dice.integers(0, 4))), u, v


def aligned(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return a scene along the axes with numbers of full precision, many of them shared."""
    k = int(dice.integers(3))
    p = dice.uniform(-4, 4, 3)
    q = p + dice.uniform(0.5, 2) * np.eye(3)[k]
    u = np.where(dice.random((n, 3)) < 0.4, p, dice.uniform(-4, 4, (n, 3)))
    u = np.where(dice.random((n, 3)) < 0.2, q, u)
    v = np.eye(3)[dice.integers(3, size=n)] * dice.choice([1.0, -1.0, 0.25, 3.0], (n, 1))
    return leaves_of(p, q, 1.7), u, v


def grazing(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return rays that pass a sphere and a cylinder at a distance of 1 +- 2^-10 to 2^-60 radii."""
    p, q = dice.uniform(-4, 4, (2, 3))
    v = dice.uniform(-1, 1, (n, 3))
    side = np.cross(v, q - p)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    gap = 1.7 * (1 + dice.choice([-1.0, 1.0], (n, 1)) * 2.0 ** -dice.uniform(10, 60, (n, 1)))
    return leaves_of(p, q, 1.7), p + side * gap - v * dice.uniform(0, 3, (n, 1)), v


def on_the_surface(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return rays that start on the sphere and near the wall, as nearly as doubles can."""
    p, q = dice.uniform(-4, 4, (2, 3))
    out = dice.normal(size=(n, 3))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    return leaves_of(p, q, 1.7), p + 1.7 * out, dice.uniform(-1, 1, (n, 3))


def extreme(dice: np.random.Generator, n: int) -> tuple[list[Leaf], Floats, Floats]:
    """Return scenes of 2^-1000 to 2^1000, and directions likewise."""
    leaves, u, v = free(dice, n)
    del leaves
    scale = 2.0 ** float(dice.integers(-1000, 1000))
    p, q = dice.uniform(-4, 4, (2, 3)) * scale
    with np.errstate(all="ignore"):
        u, v = u * scale, v * 2.0 ** dice.integers(-1000, 1000, (n, 1)).astype(float)
    return leaves_of(p, q, 1.7 * scale), u, v


FAMILIES = (
    free,
    far,
    thin,
    tilted,
    lattice,
    aligned,
    grazing,
    on_the_surface,
    extreme,
)

WHOLE = ((3, 4, 0, 5), (1, 2, 2, 3), (2, 3, 6, 7), (4, 4, 7, 9), (0, 5, 12, 13), (8, 15, 0, 17))
"""Points with whole distances from 0."""


def head_and_rest(x: Fraction) -> tuple[float, float]:
    """Return two doubles whose sum is x exactly."""
    high = float(x)
    low = float(x - Fraction(high))
    assert Fraction(high) + Fraction(low) == x
    return high, low


def beside_ties(dice: np.random.Generator, flat: bool) -> tuple[Leaf, Floats, Floats]:
    """Return a sphere or half-space, and a ray that meets it at the middle of two doubles or near.

    The ray's offset from the center is X - t v with 103 bits, its double nearest and the rest: a
    whole X on the sphere, t = (2^53 + odd) / 2^53, v of 47 bits. Then it is moved by 0 to 3 units
    of 2^-101, so that the root misses the middle by about as much.
    """
    x, y, z, r = WHOLE[dice.integers(len(WHOLE))]
    signs = dice.choice([-1, 1], 3)
    point = [int(s) * part for s, part in zip(signs, dice.permutation((x, y, z)), strict=True)]
    t = Fraction(2**53 + 1 + 2 * int(dice.integers(2**52)), 2**53)
    v = [Fraction(int(dice.integers(-(2**47), 2**47)) | 1, 2**47) for _ in range(3)]
    far = int(dice.integers(0, 4))
    moved = [Fraction(int(k), 2**101) for k in dice.integers(-far, far + 1, 3)]
    parts = [
        head_and_rest((0 if flat else a) - t * b + c)
        for a, b, c in zip(point, v, moved, strict=True)
    ]
    center = (-parts[0][1], -parts[1][1], -parts[2][1])
    normal = dice.uniform(-1, 1, 3).tolist()
    solid = HalfSpace(center, tuple(normal)) if flat else Sphere(center, float(r))
    u = np.array([[part[0] for part in parts]])
    return solid, u, np.array([[float(part) for part in v]])
