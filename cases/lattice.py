"""The lattice: solids and rays on which every sound formula decides a touch exactly.

There, and only there, an answer tells the convention of the implementation (touches kept or
dropped) and not its rounding.
"""

from __future__ import annotations

import math
from itertools import combinations

from raycert.cases.model import (
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Tree,
    Vector,
    axis,
    leaves,
    points,
    radius,
)
from raycert.cases.vectors import dot, minus

REACH = 2**11
"""Coordinates differ by less than this; powers of two lie between 1/REACH and REACH."""


def is_lattice(solid: Solid, ray: Ray) -> bool:
    """Whether a leaf and a ray, or all leaves of a tree and a ray, lie on the lattice.

    Axes, normals and directions lie along coordinate axes; |w|, |direction|, |normal| and radius
    are powers of two; coordinates are integers whose differences stay below 2^11. The powers are
    bounded too, so that a step that over- or underflows is no matter of convention.

    A tree with an endless leaf that holds the ray in its face is off the lattice: a convention
    that drops that touch ends somewhere else, and both ends are right.
    """
    parts = [leaf for _, leaf in leaves(solid)]
    places = [ray.origin, *(point for leaf in parts for point in points(leaf))]
    if not (all(_is_whole(place) for place in places) and _are_near(places)):
        return False
    lengths = [radius(leaf, 1.0) for leaf in parts]
    vectors = [ray.direction, *(w for leaf in parts if (w := axis(leaf)) is not None)]
    along = [_length_along_an_axis(vector) for vector in vectors]
    if not all(_is_small_power_of_two(length) for length in lengths + along):
        return False
    return not (isinstance(solid, Tree) and any(_holds_in_a_face(x, ray) for x in parts))


def _holds_in_a_face(leaf: Leaf, ray: Ray) -> bool:
    """Whether an endless leaf of the lattice has the whole ray in its face."""
    match leaf:
        case HalfSpace(point, normal):
            return _is_level(ray, point, normal)
        case Slab(p, q):
            return any(_is_level(ray, end, minus(q, p)) for end in (p, q))
        case InfiniteCylinder(p, q, radius):
            y, w = minus(ray.origin, p), minus(q, p)
            a, b = (y[i] for i in range(3) if w[i] == 0)
            still = not any(ray.direction[i] for i in range(3) if w[i] == 0)
            return still and a * a + b * b == radius * radius
    return False


def _is_level(ray: Ray, point: Vector, normal: Vector) -> bool:
    """Whether a ray of the lattice lies in the plane through `point` square to `normal`."""
    return dot(ray.direction, normal) == dot(minus(ray.origin, point), normal) == 0


def _is_whole(point: Vector) -> bool:
    return all(x.is_integer() and abs(x) < 2**53 for x in point)


def _are_near(points: list[Vector]) -> bool:
    """Whether points with whole coordinates differ by less than REACH in each."""
    return all(
        abs(int(x) - int(y)) < REACH
        for one, other in combinations(points, 2)
        for x, y in zip(one, other, strict=True)
    )


def _length_along_an_axis(vector: Vector) -> float:
    """Return the length of a vector along a coordinate axis, and 0 for any other."""
    sizes = [abs(x) for x in vector if x != 0]
    return sizes[0] if len(sizes) == 1 else 0.0


def _is_small_power_of_two(length: float) -> bool:
    return math.frexp(length)[0] == 0.5 and 1 / REACH <= length <= REACH
