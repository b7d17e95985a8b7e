"""Easy cases, their answers written by hand: solids along the axes, rays that nobody gets wrong.

No answer depends on a convention, most directions have not length 1, and neighbours differ, so
that the usual misreadings of a question (smoke.py) show. Nothing is computed here.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

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
    types,
)
from raycert.cases.protocol import Hello, Pairs
from raycert.oracle.client.dialogue import Question

INF = math.inf


@dataclass(frozen=True, slots=True)
class Easy:
    """A question with its truth, and the truths for half and for twice of each radius.

    The last two are None where the question is not for telling radius from diameter.
    """

    slug: str
    solid: Solid
    ray: Ray
    truth: Pairs
    halved: Pairs | None = None
    doubled: Pairs | None = None

    @property
    def question(self) -> Question:
        """Return the question alone."""
        return Question(f"smoke/{self.slug}", self.solid, self.ray)

    @property
    def speed(self) -> float:
        """Return |direction|."""
        return math.hypot(*self.ray.direction)


def easy(hello: Hello) -> tuple[Easy, ...]:
    """Return the easy cases whose solids, parts included, are all declared."""
    return tuple(case for case in EASY if types(case.solid) <= set(hello.solids))


def _cylinder(x: float, radius: float) -> Cylinder:
    return Cylinder((x, 0, -1), (x, 0, 1), radius)


TANK = Cylinder((0, 0, 0), (0, 0, 4), 2)
PIPE = InfiniteCylinder((0, 0, 0), (0, 0, 1), 3)
LAYER = Slab((0, 0, 0), (0, 0, 4))
WALL = HalfSpace((2, 0, 0), (4, 0, 0))
BALL = Sphere((1, 2, 3), 2)
ACROSS = Ray((-6, 0, 0), (2, 0, 0))

EASY: tuple[Easy, ...] = (
    Easy(
        "cylinder-through",
        TANK,
        Ray((-6, 0, 1), (2, 0, 0)),
        ((2, 4),),
        ((2.5, 3.5),),
        ((1, 5),),
    ),
    Easy("cylinder-along-the-axis", TANK, Ray((0.5, 0, -2), (0, 0, 4)), ((0.5, 1.5),)),
    Easy("cylinder-miss", TANK, Ray((-6, 5, 1), (2, 0, 0)), ()),
    Easy(
        "cylinder-from-inside",
        TANK,
        Ray((0, 0, 1), (0, 4, 0)),
        ((0, 0.5),),
        ((0, 0.25),),
        ((0, 1),),
    ),
    Easy(
        "cylinder-parallel-outside",
        TANK,
        Ray((3, 0, -2), (0, 0, 2)),
        (),
        (),
        ((1, 3),),
    ),
    Easy(
        "cylinder-cap-to-side",
        TANK,
        Ray((-1, 0, -2), (3, 0, 4)),
        ((0.5, 1),),
        ((0.5, 2 / 3),),
        ((0.5, 1.5),),
    ),
    Easy("cylinder-behind", TANK, Ray((6, 0, 1), (2, 0, 0)), ()),
    Easy(
        "cylinder-diagonal",
        TANK,
        Ray((-6, -8, 2), (3, 4, 0)),
        ((1.6, 2.4),),
        ((1.8, 2.2),),
        ((1.2, 2.8),),
    ),
    Easy(
        "cylinder-other-axis",
        Cylinder((0, -1, 0), (0, 3, 0), 3),
        Ray((0, 1, -9), (0, 0, 3)),
        ((2, 4),),
        ((2.5, 3.5),),
        ((1, 5),),
    ),
    Easy(
        "cylinder-off-centre",
        Cylinder((1, 1, 1), (5, 1, 1), 1),
        Ray((-3, 1, 1), (8, 0, 0)),
        ((0.5, 1),),
    ),
    Easy(
        "cylinder-farther",
        TANK,
        Ray((-20, 0, 3), (4, 0, 0)),
        ((4.5, 5.5),),
        ((4.75, 5.25),),
        ((4, 6),),
    ),
    Easy("cylinder-inside-along", TANK, Ray((0, 0, 1), (0, 0, 2)), ((0, 1.5),)),
    Easy(
        "infinite-cylinder-through",
        PIPE,
        Ray((-9, 0, 7), (3, 0, 0)),
        ((2, 4),),
        ((2.5, 3.5),),
        ((1, 5),),
    ),
    Easy("infinite-cylinder-inside-along", PIPE, Ray((1, 0, 0), (0, 0, 2)), ((0, INF),)),
    Easy(
        "infinite-cylinder-oblique",
        PIPE,
        Ray((0, -15, 0), (0, 6, 8)),
        ((2, 3),),
        ((2.25, 2.75),),
        ((1.5, 3.5),),
    ),
    Easy("infinite-cylinder-behind", PIPE, Ray((9, 0, 0), (4, 0, 0)), ()),
    Easy(
        "infinite-cylinder-from-inside",
        PIPE,
        Ray((1, 0, 5), (4, 0, 0)),
        ((0, 0.5),),
        ((0, 0.125),),
        ((0, 1.25),),
    ),
    Easy("slab-through", LAYER, Ray((0, 0, -6), (0, 0, 4)), ((1.5, 2.5),)),
    Easy("slab-inside-along", LAYER, Ray((1, 1, 1), (5, 0, 0)), ((0, INF),)),
    Easy("slab-oblique", LAYER, Ray((0, 0, -4), (3, 0, 4)), ((1, 2),)),
    Easy("slab-behind", LAYER, Ray((0, 0, 6), (0, 0, 2)), ()),
    Easy("slab-from-inside", LAYER, Ray((0, 0, 2), (0, 6, 8)), ((0, 0.25),)),
    Easy("half-space-into", WALL, Ray((6, 0, 0), (-8, 0, 0)), ((0.5, INF),)),
    Easy("half-space-out-of", WALL, Ray((0, 0, 0), (4, 0, 0)), ((0, 0.5),)),
    Easy("half-space-along-outside", WALL, Ray((6, 0, 0), (0, 3, 4)), ()),
    Easy("half-space-oblique", WALL, Ray((17, 0, 0), (-6, 8, 0)), ((2.5, INF),)),
    Easy(
        "sphere-through",
        BALL,
        Ray((-7, 2, 3), (4, 0, 0)),
        ((1.5, 2.5),),
        ((1.75, 2.25),),
        ((1, 3),),
    ),
    Easy(
        "sphere-from-centre",
        BALL,
        Ray((1, 2, 3), (0, 0, 8)),
        ((0, 0.25),),
        ((0, 0.125),),
        ((0, 0.5),),
    ),
    Easy("sphere-miss", BALL, Ray((1, 10, 3), (0, 2, 0)), ()),
    Easy(
        "sphere-oblique",
        BALL,
        Ray((1, -4, -5), (0, 3, 4)),
        ((1.6, 2.4),),
        ((1.8, 2.2),),
        ((1.2, 2.8),),
    ),
    Easy(
        "union-of-cylinders",
        Union((_cylinder(0, 1), _cylinder(6, 1))),
        ACROSS,
        ((2.5, 3.5), (5.5, 6.5)),
        ((2.75, 3.25), (5.75, 6.25)),
        ((2, 4), (5, 7)),
    ),
    Easy(
        "union-of-spheres",
        Union((Sphere((0, 0, 0), 1), Sphere((6, 0, 0), 1))),
        ACROSS,
        ((2.5, 3.5), (5.5, 6.5)),
        ((2.75, 3.25), (5.75, 6.25)),
        ((2, 4), (5, 7)),
    ),
    Easy(
        "intersection-of-cylinders",
        Intersection((_cylinder(0, 2), _cylinder(1, 2))),
        ACROSS,
        ((2.5, 4),),
        ((3, 3.5),),
        ((1.5, 5),),
    ),
    Easy(
        "difference-of-cylinders",
        Difference((_cylinder(0, 2), _cylinder(0, 1))),
        ACROSS,
        ((2, 2.5), (3.5, 4)),
        ((2.5, 2.75), (3.25, 3.5)),
        ((1, 2), (4, 5)),
    ),
)
