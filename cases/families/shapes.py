"""Sketches of spheres and of trees: shapes in exact numbers, and the cases that they become.

A shape is a sphere, a `Body` of `sketch` (its axis where its p and q say), or a Boolean of shapes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from raycert.cases.case import Case, Tier
from raycert.cases.dice import Dice
from raycert.cases.families.frames import UPRIGHT, Exact, Frame, Number, frames_for
from raycert.cases.families.sketch import Body, LeafPen, Pairs, plus
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Difference, Intersection, Ray, Solid, Sphere, Union

Boolean = Literal["union", "intersection", "difference"]


@dataclass(frozen=True, slots=True)
class Ball:
    """A sphere in exact numbers."""

    center: Exact
    radius: Number


@dataclass(frozen=True, slots=True)
class Node:
    """A Boolean of shapes."""

    kind: Boolean
    of: tuple[Shape, ...]


Shape = Ball | Body | Node
Make = Callable[..., Node]


def ball(radius: Number, x: Number = 0, y: Number = 0, z: Number = 0) -> Ball:
    """Return the sphere about (x, y, z)."""
    return Ball((x, y, z), radius)


def rod(p: Exact, q: Exact, radius: Number) -> Body:
    """Return the capped cylinder from p to q."""
    return Body("cylinder", p, q, radius)


def pipe(p: Exact, q: Exact, radius: Number) -> Body:
    """Return the infinite cylinder about the line pq."""
    return Body("infinite_cylinder", p, q, radius)


def layer(p: Exact, q: Exact) -> Body:
    """Return the slab between the planes through p and q."""
    return Body("slab", p, q)


def below(point: Exact, normal: Exact) -> Body:
    """Return the half-space with this outward normal."""
    return Body("half_space", point, plus(point, normal))


def any_of(*of: Shape) -> Node:
    """Return a union."""
    return Node("union", of)


def all_of(*of: Shape) -> Node:
    """Return an intersection."""
    return Node("intersection", of)


def less(*of: Shape) -> Node:
    """Return a difference."""
    return Node("difference", of)


MAKE: dict[Boolean, Make] = {"union": any_of, "intersection": all_of, "difference": less}


def moved(shape: Shape, by: Exact) -> Shape:
    """Return a shape moved by a vector."""
    match shape:
        case Ball(center, radius):
            return Ball(plus(center, by), radius)
        case Body(kind, p, q, radius):
            return Body(kind, plus(p, by), plus(q, by), radius)
        case Node(kind=boolean, of=of):
            return Node(boolean, tuple(moved(part, by) for part in of))


def spans(*ends: tuple[Number | str, Number | str | None]) -> Pairs:
    """Return the list of these known intervals; `7/4` is a fraction, None is infinity."""
    return tuple((Fraction(a), None if b is None else Fraction(b)) for a, b in ends)


def one_frame(name: str) -> tuple[Frame, ...]:
    """Return one frame drawn by a name: on the axes for half of the names, else oblique."""
    aligned = Dice(name).bits(1)
    return frames_for(name, aligned, 1 - aligned)


class Pen(LeafPen):
    """Writes any shape in numbers of a format, and remembers whether that changed any."""

    def solid(self, body: Shape, frame: Frame) -> Solid:
        """Return the solid of a shape put in a frame."""
        match body:
            case Ball(center, radius):
                return Sphere(self.vector(frame.point(center)), self.real(frame.stretch * radius))
            case Node(kind, of):
                parts = tuple(self.solid(part, frame) for part in of)
                return _BOOLEANS[kind](parts)
            case _:
                return super().solid(body, frame)


_BOOLEANS: dict[Boolean, type[Union | Intersection | Difference]] = {
    "union": Union,
    "intersection": Intersection,
    "difference": Difference,
}


def scene(
    fmt: Format,
    slug: str,
    why: str,
    shape: Shape,
    origin: Exact,
    direction: Exact,
    *,
    frame: Frame = UPRIGHT,
    tier: Tier = "generic",
    flags: tuple[str, ...] = (),
    known: Pairs | None = None,
    source: str = "",
) -> Case:
    """Return the case of a shape and a ray put in a frame, as `sketch.row` does for a body."""
    where = frame.text.replace("axis", "z")
    pen = Pen(fmt)
    solid = pen.solid(shape, frame)
    ray = Ray(pen.vector(frame.point(origin)), pen.vector(frame.vector(direction)))
    if not pen.exact:
        known = None
    return Case(
        slug=f"{slug}-{frame.name}" if frame.name else slug,
        why=f"{why}, {where}." if where else f"{why}.",
        solid=solid,
        ray=ray,
        tier="lattice" if tier != "range" and is_lattice(solid, ray) else tier,
        flags=flags,
        source=source or ("oracle" if known is None else "construction"),
        known=known,
    )
