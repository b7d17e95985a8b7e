"""Error against the number of sides: a mesh in place of the cylinder is off by its sagitta.

A prism of n sides inscribed in a cylinder lies within r (1 - cos(pi / n)) of it, so the error of a
tracer of meshes falls as 1 / n^2. The rays are the same for every n. They pass the axis of a
cylinder of radius 1 at 1/2 at most and are about as fast as 1: errors of t are errors in radii.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import log2, nan

from raycert.cases.families.frames import UPRIGHT
from raycert.cases.families.sketch import rod
from raycert.oracle.measure.methods.catalog import METHODS, SIDES, here
from raycert.oracle.measure.methods.method import Case, Method
from raycert.oracle.measure.stress.measure import Question
from raycert.oracle.measure.stress.sample import Sample, before, real, root
from raycert.oracle.measure.stress.sweeps import draw

CASTERS = ("trimesh", "embree")
RAYS = 24


@dataclass(frozen=True, slots=True)
class Sides:
    """For a caster and prisms of n sides: the mean error in radii, and the rays that it lost."""

    caster: str
    n: int
    error: float
    lost: int


def rays(seed: int, count: int = RAYS) -> list[Question]:
    """Return rays through the wall on both sides of a cylinder of radius 1, about 3 away."""
    found = []
    for number in range(count):
        dice = draw(seed, "sides", number)
        offset, turn, climb = (real(dice, *ends) for ends in ((-0.5, 0.5), (-1, 1), (-0.25, 0.25)))
        c, s = turn, root(1 - turn * turn)
        target, direction = (-offset * s, offset * c, Fraction(0)), (c, s, climb)
        body = rod((0, 0, -4), (0, 0, 4), 1)
        question = Question.of(Sample(body, before(target, direction, 3), direction, UPRIGHT))
        assert question is not None
        found.append(question)
    return found


def measure(method: Method, caster: str, n: int, questions: Sequence[Question]) -> Sides:
    """Return the error of one mesh: the mean over both ends of the rays that it does not lose."""
    answers = method.solve([Case(q.solid, q.ray) for q in questions])
    errors, lost = [], 0
    for question, answer in zip(questions, answers, strict=True):
        if answer is None or len(answer) != len(question.expected):
            lost += 1
            continue
        for given, true in zip(answer, question.expected, strict=True):
            errors += [abs(a - b) for a, b in zip(given, true, strict=True)]
    return Sides(caster, n, sum(errors) / len(errors) if errors else nan, lost)


def curves(seed: int, advance: Callable[..., None], most: int = SIDES[-1]) -> list[Sides]:
    """Return the errors of every caster that is installed, up to `most` sides."""
    questions, by_name = rays(seed), {method.name: method for method in here(METHODS)[0]}
    found = []
    for caster in CASTERS:
        for n in (n for n in SIDES if n <= most):
            if (method := by_name.get(f"{caster}-{n}")) is not None:
                found.append(measure(method, caster, n, questions))
            advance()
    return found


def slope(found: Sequence[Sides], caster: str) -> float:
    """Return the slope of log error over log n by least squares; NaN for less than two points."""
    points = [
        (log2(one.n), log2(one.error)) for one in found if one.caster == caster and one.error > 0
    ]
    if len(points) < 2:
        return nan
    mx, my = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    spread = sum((x - mx) ** 2 for x, _ in points)
    return sum((x - mx) * (y - my) for x, y in points) / spread
