"""Sketches: solids in exact numbers, and the pen that writes them in numbers of a format.

In a sketch an axis lies along z unless its p and q say otherwise. Of a cylinder or slab, p is the
lower end. Of a half-space, p is the point and q - p the outward normal.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any, Literal, cast

from raycert.cases.case import KnownEnd
from raycert.cases.families.frames import Exact, Frame, Number
from raycert.cases.formats import Format
from raycert.cases.model import (
    SOLIDS,
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Slab,
    Solid,
    Sphere,
    Vector,
)
from raycert.cases.vectors import along, minus

Pairs = tuple[tuple[KnownEnd, KnownEnd], ...]
MISS: Pairs = ()
ALWAYS: Pairs = ((0, None),)
Boolean = Literal["union", "intersection", "difference"]


@dataclass(frozen=True, slots=True)
class Body:
    """A solid with an axis or a normal. `kind` is its JSON type name."""

    kind: str
    p: Exact
    q: Exact
    radius: Number = 0

    @property
    def noun(self) -> str:
        """Return the word for it in a sentence."""
        return NOUNS[self.kind]

    @property
    def word(self) -> str:
        """Return the word for it in a slug."""
        return self.kind.replace("_", "-")


NOUNS = {
    "half_space": "a half-space", "slab": "a slab", "infinite_cylinder": "an infinite cylinder",
    "cylinder": "a cylinder", "sphere": "a sphere",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Ball:
    """A sphere."""

    center: Exact
    radius: Number


@dataclass(frozen=True, slots=True)
class Node:
    """A Boolean of shapes."""

    kind: Boolean
    of: tuple[Shape, ...]


Shape = Ball | Body | Node


def cylinder(radius: Number, height: Number, base: Number = 0) -> Body:
    """Return the capped cylinder about z from z = base up."""
    return Body("cylinder", (0, 0, base), (0, 0, base + height), radius)


def tube(radius: Number, height: Number = 8, base: Number = 0) -> Body:
    """Return the infinite cylinder about z, its p and q `height` apart."""
    return Body("infinite_cylinder", (0, 0, base), (0, 0, base + height), radius)


def slab(height: Number, base: Number = 0) -> Body:
    """Return the slab from z = base up."""
    return Body("slab", (0, 0, base), (0, 0, base + height))


def half_space(level: Number = 0, normal: Number = 1) -> Body:
    """Return the half-space below z = level, with a normal of this length."""
    return Body("half_space", (0, 0, level), (0, 0, level + normal))


rod = partial(Body, "cylinder")
pipe = partial(Body, "infinite_cylinder")
layer = partial(Body, "slab")
"""The same by p and q, and a radius where there is one."""


def below(point: Exact, normal: Exact) -> Body:
    """Return the half-space with this outward normal."""
    return Body("half_space", point, plus(point, normal))


def ball(radius: Number, x: Number = 0, y: Number = 0, z: Number = 0) -> Ball:
    return Ball((x, y, z), radius)


def any_of(*of: Shape) -> Node:
    return Node("union", of)


def all_of(*of: Shape) -> Node:
    return Node("intersection", of)


def less(*of: Shape) -> Node:
    return Node("difference", of)


Make = Callable[..., Node]
MAKE: dict[Boolean, Make] = {"union": any_of, "intersection": all_of, "difference": less}


def moved(shape: Shape, by: Exact) -> Shape:
    match shape:
        case Ball(center, radius):
            return Ball(plus(center, by), radius)
        case Body(kind, p, q, radius):
            return Body(kind, plus(p, by), plus(q, by), radius)
        case Node(kind=boolean, of=of):
            return Node(boolean, tuple(moved(part, by) for part in of))


def near(fmt: Format, number: Number) -> Fraction:
    """Return the number of the format nearest to `number`."""
    return Fraction(fmt.nearest(float(Fraction(number))))


def two(exponent: int) -> Fraction:
    return Fraction(2) ** exponent


def ten(exponent: int) -> Fraction:
    return Fraction(10) ** exponent


def plus(a: Exact, b: Exact, times: Number = 1) -> Exact:
    return along(a, times, b)


def times(factor: Number, a: Exact) -> Exact:
    return (factor * a[0], factor * a[1], factor * a[2])


def pair(enter: Number, leave: Number | None) -> Pairs:
    return spans((enter, leave))


def touch(t: Number) -> Pairs:
    return pair(t, t)


def spans(*ends: tuple[Number | str, Number | str | None]) -> Pairs:
    """Return the list of these known intervals; `7/4` is a fraction, None is infinity."""
    return tuple((Fraction(a), None if b is None else Fraction(b)) for a, b in ends)


def between(start: Number, speed: Number, low: Number, high: Number) -> Pairs:
    """Return where low <= start + speed t <= high, for t >= 0."""
    if speed == 0:
        return ALWAYS if low <= start <= high else MISS
    one, other = Fraction(low - start) / speed, Fraction(high - start) / speed
    enter, leave = max(min(one, other), Fraction(0)), max(one, other)
    return pair(enter, leave) if leave >= 0 else MISS


def later(known: Pairs, by: Number) -> Pairs:
    """Return a list moved along the ray, and cut off at t = 0."""
    ends = ((a + by, None if b is None else b + by) for a, b in known if a is not None)
    return tuple((max(a, 0), b) for a, b in ends if b is None or b >= 0)


def slower(known: Pairs, factor: Fraction) -> Pairs:
    """Return the list for a direction `factor` times as long."""
    return tuple((a and a / factor, b and b / factor) for a, b in known)


class Pen:
    """Writes exact numbers as numbers of a format, and remembers whether that changed any."""

    def __init__(self, fmt: Format) -> None:
        self.fmt = fmt
        self.exact = True

    def real(self, number: Number) -> float:
        """Return the nearest number of the format."""
        written = self.fmt.nearest(float(Fraction(number)))
        self.exact = self.exact and Fraction(written) == number
        return written

    def vector(self, vector: Exact) -> Vector:
        x, y, z = vector
        return (self.real(x), self.real(y), self.real(z))

    def solid(self, shape: Shape, frame: Frame) -> Solid:
        """Return the solid of a shape put in a frame."""
        match shape:
            case Ball(center, radius):
                return Sphere(self.vector(frame.point(center)), self.real(frame.stretch * radius))
            case Node(kind=boolean, of=of):
                tree: Any = SOLIDS[boolean]
                return cast("Solid", tree(tuple(self.solid(part, frame) for part in of)))
            case Body("half_space", p, q):
                normal = frame.vector(minus(q, p))
                return HalfSpace(self.vector(frame.point(p)), self.vector(normal))
            case Body("slab", p, q):
                return Slab(self.vector(frame.point(p)), self.vector(frame.point(q)))
            case Body(kind, p, q, radius):
                make = InfiniteCylinder if kind == "infinite_cylinder" else Cylinder
                ends = (self.vector(frame.point(p)), self.vector(frame.point(q)))
                return make(*ends, self.real(frame.stretch * radius))
