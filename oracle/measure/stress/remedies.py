"""Remedies: the same problem with one source of error taken away, exactly, and the rest as it was.

Each makes a new question from the sketch of a sample. It has an exact answer of its own, so what a
method answers to it is judged like any other answer. A remedy that changes nothing gives None.

    scaled      lengths and direction times powers of two: no product leaves the range, and no
                other rounding differs
    at-origin   p moved to the coordinate origin: origin - p is exact
    beside      p and q slid along the axis next to the start: origin - p has no axial part; an
                infinite cylinder stays the one it is
    open        the wall alone
    abreast     the wall alone, and p slid to where the ray is nearest to the axis
    restart     the start moved along its ray to 3 radii before the closest approach to the axis
    upright     in a frame along the coordinate axes: w/|w| is exact, v x w loses nothing
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from raycert.cases.families.frames import ALIGNED, UPRIGHT, Exact, Number
from raycert.cases.families.sketch import Ball, Body, Node, Shape, moved, plus, times, two
from raycert.oracle.measure.stress.sample import Sample, root

Remedy = Callable[[Sample], Sample | None]
BACK = 3
"""Radii before the closest approach at which `restart` starts."""


def first_leaf(shape: Shape) -> Body | Ball:
    """Return the first leaf of a shape."""
    return first_leaf(shape.of[0]) if isinstance(shape, Node) else shape


def anchor(shape: Shape) -> Exact:
    """Return p, or the center, of the first leaf."""
    leaf = first_leaf(shape)
    return leaf.center if isinstance(leaf, Ball) else leaf.p


def magnitude(numbers: Exact) -> int:
    """Return the e for which the largest of numbers, not all zero, is in [1/2, 1) 2^e."""
    largest = max(abs(Fraction(number)) for number in numbers)
    e = largest.numerator.bit_length() - largest.denominator.bit_length()
    return e + 1 if largest >= two(e) else e


def power(x: Number) -> int:
    """Return about log2 of a number that is not 0."""
    return magnitude((x, 0, 0))


def _size(sample: Sample) -> Number:
    """Return the length that the scene is made in: the radius, or the stretch of the frame."""
    leaf = first_leaf(sample.shape)
    return sample.frame.stretch * (leaf.radius or 1)


def scaled(sample: Sample) -> Sample | None:
    """Return it with the radius and the direction about as long as 1."""
    shrink = -power(_size(sample))
    slow = -magnitude(sample.direction)
    if not shrink and not slow:
        return None
    frame = sample.frame.scaled(two(shrink))
    slow -= power(frame.stretch)  # the frame stretches directions too
    return replace(sample, frame=frame, direction=times(two(slow), sample.direction))


def at_origin(sample: Sample) -> Sample | None:
    """Return it with p at the coordinate origin."""
    p = anchor(sample.shape)
    if p == (0, 0, 0) and sample.frame.shift == (0, 0, 0):
        return None
    back = times(-1, p)
    return Sample(
        moved(sample.shape, back),
        plus(sample.origin, back),
        sample.direction,
        sample.frame.moved((0, 0, 0)),
    )


def beside(sample: Sample) -> Sample | None:
    """Return it with the axis of an infinite cylinder given by points next to the start."""
    shape = sample.shape
    if not isinstance(shape, Body) or shape.kind != "infinite_cylinder":
        return None
    along: Exact = (0, 0, sample.origin[2] - shape.p[2])
    return replace(sample, shape=moved(shape, along)) if along[2] else None


def nearest(sample: Sample) -> Fraction | None:
    """Return the t at which the ray is nearest to the axis; None along it, and without one."""
    leaf, (a, b, _) = first_leaf(sample.shape), sample.direction
    across = Fraction(a) ** 2 + Fraction(b) ** 2
    if isinstance(leaf, Ball) or not leaf.radius or not across:
        return None
    return -(sample.origin[0] * a + sample.origin[1] * b) / across


def open_ended(sample: Sample) -> Sample | None:
    """Return the wall of a cylinder without its caps."""
    shape = sample.shape
    if not isinstance(shape, Body) or shape.kind != "cylinder":
        return None
    return replace(sample, shape=replace(shape, kind="infinite_cylinder"))


def abreast(sample: Sample) -> Sample | None:
    """Return the wall alone, with p where the ray is nearest to the axis."""
    shape, t = sample.shape, nearest(sample)
    if t is None or not isinstance(shape, Body):
        return None
    level = sample.origin[2] + t * sample.direction[2]
    tube = replace(shape, kind="infinite_cylinder")
    return replace(sample, shape=moved(tube, (0, 0, level - shape.p[2])))


def restart(sample: Sample) -> Sample | None:
    """Return it with the start moved along its ray to 3 radii before the axis."""
    leaf, direction, meet = first_leaf(sample.shape), sample.direction, nearest(sample)
    if meet is None or isinstance(leaf, Ball):
        return None
    speed = root(Fraction(direction[0]) ** 2 + Fraction(direction[1]) ** 2)
    return replace(sample, origin=plus(sample.origin, direction, meet - BACK * leaf.radius / speed))


def upright(sample: Sample) -> Sample | None:
    """Return it in a frame along the coordinate axes, its anchor and size about where they were."""
    frame = sample.frame
    if frame.name in {aligned.name for aligned in ALIGNED} | {UPRIGHT.name}:
        return None
    return replace(sample, frame=UPRIGHT.scaled(frame.stretch).moved(frame.shift))


def parallel(sample: Sample) -> Sample:
    """Return it with a direction exactly along the axis: no remedy, but a probe."""
    return replace(sample, direction=(0, 0, sample.direction[2]))


REMEDIES: dict[str, Remedy] = {
    "scaled": scaled,
    "at-origin": at_origin,
    "beside": beside,
    "restart": restart,
    "open": open_ended,
    "abreast": abreast,
    "upright": upright,
}


def start_distance(sample: Sample) -> float:
    """Return the distance of the start from the axis in radii, roughly: 0 where there is none."""
    leaf = first_leaf(sample.shape)
    if isinstance(leaf, Ball) or not leaf.radius:
        return 0.0
    x, y = (Fraction(sample.origin[i]) / leaf.radius for i in (0, 1))
    return float(root(x * x + y * y))


def doublings(sample: Sample) -> int:
    """Return how many doublings the lengths or the direction are away from about 1."""
    size = abs(power(_size(sample)))
    return max(size, abs(magnitude(sample.direction) + power(sample.frame.stretch)))
