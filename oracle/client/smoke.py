"""Is it the adapter? Easy cases that are asked first, and what their answers say of the adapter.

The truths are written by hand, and no answer depends on a convention. `fallen` tells, for each type
of solid, which easy cases fail, and whether one misreading explains all their answers (misread.py).
`adapter_faults` blames the adapter where most cases fail in one way, or where a misreading is
named; it says nothing of a tracer that is merely wrong.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from raycert.cases.forms import write_ray, write_solid
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Point,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
    type_of,
    types,
)
from raycert.cases.protocol import Hello, Pairs, Reply, cut, first
from raycert.oracle.client.dialogue import Limits, Outcome, Question, silence
from raycert.oracle.client.misread import misreadings, says
from raycert.oracle.client.process import Failure
from raycert.oracle.judge.answer import Claim, claim

INF = math.inf


@dataclass(frozen=True, slots=True)
class Easy:
    """A question with its truth."""

    slug: str
    solid: Solid
    ray: Ray
    truth: Pairs

    @property
    def question(self) -> Question:
        return Question(f"smoke/{self.slug}", self.solid, self.ray)


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
DRUM = Cylinder((0, -1, 0), (0, 3, 0), 3)
BEAM = Cylinder((1, 1, 1), (5, 1, 1), 1)
ROD = Cylinder((1, 2, 3), (5, 6, 5), 3)
POST = Cylinder((4, 0, 1), (4, 3, 5), 2)
RAIL = InfiniteCylinder((1, 2, 3), (5, 6, 5), 3)
MAST = InfiniteCylinder((4, 0, 1), (4, 3, 5), 2)
TUNNEL = InfiniteCylinder((1, 1, 2), (1, 4, 6), 10)
PLATE = Slab((1, 2, 3), (5, 6, 5))
SHEET = Slab((4, 0, 1), (4, 3, 5))
SLOPE = HalfSpace((1, 2, 3), (0, 3, 4))
FLOOR = HalfSpace((0, 0, 5), (0, 0, -2))
GLOBE = Sphere((0, 0, 0), 1)
MOON = Sphere((-4, 0, 2), 3)
PILLARS = Union((_cylinder(0, 1), _cylinder(6, 1)))
BALLS = Union((Sphere((0, 0, 0), 1), Sphere((6, 0, 0), 1)))
OVERLAP = Intersection((_cylinder(0, 2), _cylinder(1, 2)))
TUBE = Difference((_cylinder(0, 2), _cylinder(0, 1)))
LENS = Intersection((Sphere((0, 0, 0), 2), Sphere((2, 0, 0), 2)))
SHELL = Difference((Sphere((0, 0, 0), 3), Sphere((0, 0, 0), 1)))
PAIRS = [(2.5, 3.5), (5.5, 6.5)]

# fmt: off
TABLE: tuple[tuple[str, Solid, Point, Vector, Sequence[tuple[float, float]]], ...] = (
    ("cylinder-through", TANK, (-6, 0, 1), (2, 0, 0), [(2, 4)]),
    ("cylinder-along-the-axis", TANK, (0.5, 0, -2), (0, 0, 4), [(0.5, 1.5)]),
    ("cylinder-miss", TANK, (-6, 5, 1), (2, 0, 0), []),
    ("cylinder-from-inside", TANK, (0, 0, 1), (0, 4, 0), [(0, 0.5)]),
    ("cylinder-parallel-outside", TANK, (3, 0, -2), (0, 0, 2), []),
    ("cylinder-cap-to-side", TANK, (-1, 0, -2), (3, 0, 4), [(0.5, 1)]),
    ("cylinder-behind", TANK, (6, 0, 1), (2, 0, 0), []),
    ("cylinder-diagonal", TANK, (-6, -8, 2), (3, 4, 0), [(1.6, 2.4)]),
    ("cylinder-other-axis", DRUM, (0, 1, -9), (0, 0, 3), [(2, 4)]),
    ("cylinder-off-centre", BEAM, (-3, 1, 1), (8, 0, 0), [(0.5, 1)]),
    ("cylinder-farther", TANK, (-20, 0, 3), (4, 0, 0), [(4.5, 5.5)]),
    ("cylinder-inside-along", TANK, (0, 0, 1), (0, 0, 2), [(0, 1.5)]),
    ("cylinder-tilted", ROD, (0, 10, -2), (1, -2, 2), [(2, 4)]),
    ("cylinder-tilted-along", ROD, (-2.5, -3, 2), (4, 4, 2), [(1, 2)]),
    ("cylinder-leaning", POST, (-2, 2.25, 4), (2, 0, 0), [(2, 4)]),
    ("cylinder-leaning-along", POST, (5, 6, 9), (0, -3, -4), [(1, 2)]),
    ("infinite-cylinder-through", PIPE, (-9, 0, 7), (3, 0, 0), [(2, 4)]),
    ("infinite-cylinder-inside-along", PIPE, (1, 0, 0), (0, 0, 2), [(0, INF)]),
    ("infinite-cylinder-oblique", PIPE, (0, -15, 0), (0, 6, 8), [(2, 3)]),
    ("infinite-cylinder-behind", PIPE, (9, 0, 0), (4, 0, 0), []),
    ("infinite-cylinder-from-inside", PIPE, (1, 0, 5), (4, 0, 0), [(0, 0.5)]),
    ("infinite-cylinder-tilted", RAIL, (0, 10, -2), (1, -2, 2), [(2, 4)]),
    ("infinite-cylinder-tilted-farther", RAIL, (20, 30, 8), (2, -4, 4), [(1, 2)]),
    ("infinite-cylinder-leaning", MAST, (-2, 7.5, 11), (2, 0, 0), [(2, 4)]),
    ("infinite-cylinder-leaning-wide", TUNNEL, (-29, 4, -4), (10, 0, 0), [(2.2, 3.8)]),
    ("slab-through", LAYER, (0, 0, -6), (0, 0, 4), [(1.5, 2.5)]),
    ("slab-inside-along", LAYER, (1, 1, 1), (5, 0, 0), [(0, INF)]),
    ("slab-oblique", LAYER, (0, 0, -4), (3, 0, 4), [(1, 2)]),
    ("slab-behind", LAYER, (0, 0, 6), (0, 0, 2), []),
    ("slab-from-inside", LAYER, (0, 0, 2), (0, 6, 8), [(0, 0.25)]),
    ("slab-leaning", SHEET, (7, -3, -3), (0, 6, 8), [(0.5, 1)]),
    ("slab-tilted", PLATE, (-8, 2, 3), (3, 0, 0), [(3, 6)]),
    ("half-space-into", WALL, (6, 0, 0), (-8, 0, 0), [(0.5, INF)]),
    ("half-space-out-of", WALL, (0, 0, 0), (4, 0, 0), [(0, 0.5)]),
    ("half-space-along-outside", WALL, (6, 0, 0), (0, 3, 4), []),
    ("half-space-oblique", WALL, (17, 0, 0), (-6, 8, 0), [(2.5, INF)]),
    ("half-space-leaning", SLOPE, (1, 2, 13), (0, 0, -5), [(2, INF)]),
    ("half-space-leaning-out", SLOPE, (9, -1, -1), (0, 3, 4), [(0, 1)]),
    ("half-space-above", FLOOR, (0, 0, 1), (0, 0, 2), [(2, INF)]),
    ("sphere-through", BALL, (-7, 2, 3), (4, 0, 0), [(1.5, 2.5)]),
    ("sphere-from-centre", BALL, (1, 2, 3), (0, 0, 8), [(0, 0.25)]),
    ("sphere-miss", BALL, (1, 10, 3), (0, 2, 0), []),
    ("sphere-oblique", BALL, (1, -4, -5), (0, 3, 4), [(1.6, 2.4)]),
    ("sphere-at-the-origin", GLOBE, (-3, 0, 0), (2, 0, 0), [(1, 2)]),
    ("sphere-elsewhere", MOON, (-4, -9, 2), (0, 3, 0), [(2, 4)]),
    ("sphere-behind", MOON, (2, 0, 2), (2, 0, 0), []),
    ("union-of-cylinders", PILLARS, (-6, 0, 0), (2, 0, 0), PAIRS),
    ("union-of-spheres", BALLS, (-6, 0, 0), (2, 0, 0), PAIRS),
    ("intersection-of-cylinders", OVERLAP, (-6, 0, 0), (2, 0, 0), [(2.5, 4)]),
    ("intersection-of-spheres", LENS, (-4, 0, 0), (2, 0, 0), [(2, 3)]),
    ("difference-of-cylinders", TUBE, (-6, 0, 0), (2, 0, 0), [(2, 2.5), (3.5, 4)]),
    ("difference-of-spheres", SHELL, (-6, 0, 0), (0.5, 0, 0), [(6, 10), (14, 18)]),
)
# fmt: on
"""Slug, solid, origin, direction; the truth.

Neighbours differ, so that an answer to the question before shows. Every type of solid is met at the
origin and elsewhere, upright and tilted, so that misreadings of it differ.
"""
EASY = tuple(
    Easy(slug, solid, Ray(origin, direction), tuple(truth))
    for slug, solid, origin, direction, truth in TABLE
)


def limits(usual: Limits) -> Limits:
    """Return the limits for the easy cases: the usual ones, but given up soon."""
    return replace(usual, in_a_row=2)


@dataclass(frozen=True, slots=True)
class Fallen:
    """The easy cases of a type of solid that fail: how many, of how many, and the first in full.

    `refused` is how many are; `misread` are the misreadings that foretell all answers to this type.
    """

    solid: str
    failed: int
    of: int
    refused: int
    first: Easy
    outcome: Outcome
    misread: tuple[str, ...]

    @property
    def text(self) -> str | None:
        """Return what it does to all questions of the type, in words; None if none is known."""
        return f"it {' or '.join(self.misread)}" if self.misread else None

    def form(self, hello: Hello) -> dict[str, Any]:
        """Return it as the certificate has it: numbers in decimal, as they are pasted into code."""
        case = self.first
        told = {
            "id": case.question.id,
            "solid": write_solid(case.solid),
            "ray": write_ray(case.ray),
            "answer": answered(self.outcome),
            "expected": expected(case, hello),
        }
        counts = {"failed": self.failed, "of": self.of}
        return {"solid": self.solid, **counts, "first": told, "misread": self.text}


def fallen(asked: Sequence[Easy], outcomes: Mapping[str, Outcome], hello: Hello) -> list[Fallen]:
    """Return what fails of the easy cases, for each type of solid of which some do."""
    given: dict[str, list[tuple[Easy, Outcome]]] = {}
    for case in asked:
        if (outcome := outcomes.get(case.question.id)) is not None:
            given.setdefault(type_of(case.solid), []).append((case, outcome))
    found = (_fallen(solid, pairs, hello) for solid, pairs in given.items())
    return [each for each in found if each.failed]


def _fallen(solid: str, given: Sequence[tuple[Easy, Outcome]], hello: Hello) -> Fallen:
    told = [(case, outcome, claimed(outcome, hello)) for case, outcome in given]
    wrong = [
        (case, outcome)
        for case, outcome, said in told
        if said is None or not says(said, case.truth)
    ]
    misread = misreadings(
        [(case.solid, case.ray, case.truth, said) for case, _, said in told if said is not None]
    )
    refused = sum(isinstance(outcome, Reply) and bool(silence(outcome)) for _, outcome in given)
    return Fallen(solid, len(wrong), len(given), refused, *(wrong or given)[0], tuple(misread))


def claimed(outcome: Outcome, hello: Hello) -> Claim | None:
    """Return what an outcome claims; None where it is no answer."""
    if isinstance(outcome, Failure) or silence(outcome):
        return None
    return claim(outcome, hello)


def answered(outcome: Outcome) -> str:
    """Return an outcome in words, numbers in decimal."""
    if quiet := silence(outcome):
        return cut(": ".join(quiet), 300)
    assert isinstance(outcome, Reply)
    if outcome.intervals is not None:
        return listed(outcome.intervals)
    if outcome.hit is not None:
        return "a hit" if outcome.hit else "no hit"
    return "no hit" if outcome.first is None else repr(outcome.first)


def expected(case: Easy, hello: Hello) -> str:
    """Return the answer to a case that is right for what a hello promises, in words."""
    if hello.answers == "intervals":
        return listed(case.truth)
    if hello.answers == "any":
        return answered(Reply("", hit=bool(case.truth)))
    return answered(Reply("", first=first(case.truth, hello.from_inside)))


def listed(pairs: Pairs) -> str:
    """Return a list as code has it, cut after some pairs."""
    text = ", ".join(str([float(x) for x in pair]) for pair in pairs[:6])
    return f"[{text}{', ...' if len(pairs) > 6 else ''}]"
