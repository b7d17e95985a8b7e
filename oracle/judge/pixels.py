"""The backward error of every pixel of a scene, exactly, at a price that a picture can pay.

For each ray the tree is first cut down to the leaves that the ray comes near. What is dropped is
away by 2^-20 of the sizes of the numbers that meet, in doubles whose error is below 2^-40 of them;
up to k = 2^20, k u s(t) stays below 2^-24 of them wherever the ray is near. So up to there the
outer list of a dropped leaf is empty, as its inner and its exact lists are, and the lists of the
cut tree are those of the whole: the doubles leave work out, and decide nothing. Beyond that k the
whole tree is judged.

The k of a list is found from a guess, by accepting at one step and refusing at the one below; that
is the least k, as the judge's own bisection finds it, because the measure is monotone in k.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot, inf

from raycert.cases.accept import Pairs, malformed
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
    Tree,
    Union,
    Vector,
)
from raycert.cases.scene import Scene, frame, pixel_ray
from raycert.cases.vectors import cross, dot, minus
from raycert.oracle.judge.backward import Bracket
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import Step

NEAR = 2.0**-20
LAST = 48
"""The step of k = 2^20: up to it the cut tree has the lists of the whole."""
STEEP = 0.01
"""The sine between line and axis from which on their distance is found in doubles."""
FEW = 1000
"""So few pixels are judged before other processes have started."""
Answers = Sequence[Pairs]


def row_errors(scene: Scene, row: int, answers: Answers) -> list[float]:
    """Return the strict backward error of each pixel in a row."""
    seen, solid, guess = frame(scene.camera), scene.solid, 0
    errors: list[float] = []
    for column, answer in enumerate(answers):
        ray = pixel_ray(seen, scene.size, column, row)
        k, guess = error(solid, ray, answer, guess)
        errors.append(k)
    return errors


def error(solid: Solid, ray: Ray, answer: Pairs, guess: int = 0) -> tuple[float, int]:
    """Return k of an answer, and the step it was found at, as a guess for the next.

    It is `Judge.backward_error` under the strict measure.
    """
    if malformed(answer, True):
        return inf, guess
    near = cut(solid, ray)
    if near is None:
        return (float(Step.at(0)), 0) if not answer else _in_full(solid, ray, answer)
    judge = Judge(near, ray, BINARY64)
    if not answer and not judge.exact:
        return float(Step.at(0)), 0
    step = Bracket(lambda i: judge.accepts(answer, i, "strict"), lambda: guess, LAST).least
    return (float(Step.at(step)), step) if step <= LAST else _in_full(solid, ray, answer)


def _in_full(solid: Solid, ray: Ray, answer: Pairs) -> tuple[float, int]:
    return Judge(solid, ray, BINARY64).backward_error(answer, "strict"), LAST


def cut(solid: Solid, ray: Ray) -> Solid | None:
    """Return a solid without the leaves that a ray stays away from; None if nothing is left."""
    if not isinstance(solid, Tree):
        return None if _apart(solid, ray) else solid
    parts = [cut(part, ray) for part in solid.of]
    kept = tuple(part for part in parts if part is not None)
    match solid:
        case Union():
            return Union(kept) if kept else None
        case Intersection():
            return Intersection(kept) if len(kept) == len(parts) else None
        case Difference():
            return Difference(kept) if parts[0] is not None else None


def _apart(leaf: Leaf, ray: Ray) -> bool:
    """Whether a ray's line stays away from a leaf, by far more than any rounding."""
    match leaf:
        case HalfSpace() | Slab():
            return False
        case Sphere(center, radius):
            return _passes(center, radius, ray)
        case InfiniteCylinder():
            return _beside(leaf, ray)
        case Cylinder(p, q, radius):
            middle = (p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2, p[2] / 2 + q[2] / 2)
            return _beside(leaf, ray) or _passes(middle, radius + hypot(*minus(q, p)) / 2, ray)


def _passes(center: Vector, radius: float, ray: Ray) -> bool:
    """Whether a line passes a point at more than the radius."""
    y, v = minus(ray.origin, center), ray.direction
    sizes = hypot(*y) + hypot(*center) + radius
    area, speed = hypot(*cross(v, y)), hypot(*v)
    return speed > 0 and inf > area / speed > radius + NEAR * sizes


def _beside(leaf: InfiniteCylinder | Cylinder, ray: Ray) -> bool:
    """Whether a line passes an axis at more than the radius; not where they are parallel."""
    w, y, v = minus(leaf.q, leaf.p), minus(ray.origin, leaf.p), ray.direction
    sizes = hypot(*y) + hypot(*leaf.p) + hypot(*leaf.q) + leaf.radius
    x = cross(v, w)
    area = hypot(*x)
    if area <= STEEP * hypot(*v) * hypot(*w):
        return False
    distance = abs(dot(y, x)) / area
    return inf > distance > leaf.radius + NEAR * sizes


def every_row(scene: Scene, answers: Answers, processes: int = 2) -> Iterator[list[float]]:
    """Yield the errors of each row in turn, given the lists of all pixels; in so many processes."""
    from functools import partial

    from raycert.cases.workers import Workers

    width, height = scene.size
    rows = range(height), [answers[i * width : (i + 1) * width] for i in range(height)]
    work = partial(row_errors, scene)
    if processes < 2 or len(answers) < FEW:
        yield from map(work, *rows)
        return
    with Workers(processes) as pool:
        yield from pool.map(work, *rows, chunksize=2)
