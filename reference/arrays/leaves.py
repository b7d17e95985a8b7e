"""The leaves in many lanes: what `raycert.reference.tracer` does, lane by lane.

What depends on the direction alone (`Course`) and on the start alone (`Meeting`) is kept apart, so
that a bundle can hand either on: from part to part, and from tile to tile.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Slab, Sphere, Vector
from raycert.reference.arrays import vectors as vec
from raycert.reference.arrays.bundle import Bundle
from raycert.reference.arrays.lists import Lists
from raycert.reference.arrays.quadratic import How, Line, Start
from raycert.reference.arrays.vectors import Array, Mask, Vectors, Whole, dot, take_all
from raycert.reference.vectors import displacement, exponent, norm, scaled

UNSCALED = np.zeros(1, np.int64)
"""The exponent of what was not scaled."""


class Course(NamedTuple):
    """The direction, scaled, and across an axis (a sphere has none)."""

    v: Vectors
    e: Whole
    line: Line


class Meeting(NamedTuple):
    """The start from p and from q (for a sphere, from the center), scaled."""

    y: Vectors
    z: Vectors
    e: Whole
    start: Start


def _direction(rays: Bundle) -> tuple[Vectors, Whole]:
    if not rays.switches.scaling:
        return rays.direction, UNSCALED
    return rays.of_direction("scaled", lambda: vec.scaled(rays.direction))


def _from(point: Vector, rays: Bundle) -> tuple[Vectors, Whole]:
    """Return the origins from a point, scaled."""
    if not rays.switches.scaling:
        return vec.difference(point, rays.origin, rays.switches.axis), UNSCALED
    return vec.displacement(point, rays.origin, rays.switches.axis)


def _length(radius: float, e: Whole) -> Array:
    length: Array = np.ldexp(np.array([radius]), -e)
    return length


def course(w: Vector | None, rays: Bundle) -> Course:
    """Return the direction across an axis; w is the scaled axis, None for a sphere."""

    def make() -> Course:
        v, e = _direction(rays)
        across = v if w is None else vec.cross(v, vec.constant(w, rays.switches.axis))
        return Course(v, e, Line(across))

    return rays.of_direction(w, make)


def meeting(solid: InfiniteCylinder | Slab | Cylinder, w: Vector, rays: Bundle) -> Meeting:
    """Return the start relative to an axis."""

    def make() -> Meeting:
        radius = 0.0 if isinstance(solid, Slab) else solid.radius
        y, ye = _from(solid.p, rays)
        z, ze = _from(solid.q, rays)
        if rays.switches.scaling:
            e = np.maximum(np.maximum(ye, ze), exponent(radius))
            y, z = vec.shift(y, ye - e), vec.shift(z, ze - e)
        else:
            e = UNSCALED
        across = vec.cross(y, vec.constant(w, rays.switches.axis))
        return Meeting(y, z, e, Start(across, _length(radius, e) * norm(w)))

    return rays.of_origin(solid, make)


def cylinder(
    solid: InfiniteCylinder | Cylinder, rays: Bundle, capped: bool, first: bool = False
) -> Lists:
    """Problems 1 and 3. Where caps are of no use the slab is left out."""
    w, _ = displacement(solid.p, solid.q)
    there, way = meeting(solid, w, rays), course(w, rays)
    endless = isinstance(solid, InfiniteCylinder)
    compare = capped or (endless and rays.switches.caps)
    how = How(rays.switches.misses, first and not compare)
    pairs = rays.switches.chord(there.start, way.line, how, rays.lanes)
    if compare:
        enter, leave, keep = _planes(pairs.lane, there, way.v, w, rays, endless)
        pairs = Lists(
            pairs.lane, np.maximum(pairs.enter, enter), np.minimum(pairs.leave, leave), pairs.lanes
        ).where(keep & (np.maximum(pairs.enter, enter) <= np.minimum(pairs.leave, leave)))
    return unscale(pairs, there.e - way.e, rays.switches.scaling)


def slab(solid: Slab, rays: Bundle) -> Lists:
    """Problem 2 (g)."""
    w, _ = displacement(solid.p, solid.q)
    there = meeting(solid, w, rays)
    v, e = _direction(rays)
    lanes = np.arange(rays.lanes)
    enter, leave, keep = _planes(lanes, there, v, w, rays)
    return unscale(
        Lists(lanes, enter, leave, rays.lanes).where(keep), there.e - e, rays.switches.scaling
    )


def _planes(
    lanes: Whole, there: Meeting, v: Vectors, w: Vector, rays: Bundle, endless: bool = False
) -> tuple[Array, Array, Mask]:
    """Return the row of Problem 2 in some lanes: enter, leave, and whether there is a pair.

    `endless`: the planes are nowhere, and nothing that was found is used.
    """
    n = vec.constant(w, rays.switches.axis)
    up, uq = -dot(take_all(there.y, lanes), n), -dot(take_all(there.z, lanes), n)
    vn = -dot(take_all(v, lanes), n)
    tp, tq = -up / vn, -uq / vn
    forth, past_q = vn > 0, uq < 0
    past_p = ~past_q & (up > 0)
    enter = np.where(past_q, tq, np.where(past_p, tp, 0.0))
    leave = np.where(past_q, tp, np.where(past_p, tq, np.where(forth, tp, tq)))
    keep = np.where(past_q, forth & (tq <= tp), np.where(past_p, (vn < 0) & (tp <= tq), True))
    level = (vn == 0) | endless
    keep = np.where(level, ((up <= 0) & (uq >= 0)) | endless, keep)
    enter, leave = np.where(level, 0.0, enter), np.where(level, np.inf, leave)
    return _wide(enter, lanes), _wide(leave, lanes), np.broadcast_to(keep, lanes.shape)


def half_space(solid: HalfSpace, rays: Bundle) -> Lists:
    """Problem 2 (c)."""
    n = vec.constant(scaled(solid.normal)[0], rays.switches.axis)
    v, ve = _direction(rays)
    y, ye = rays.of_origin(solid, lambda: _from(solid.point, rays))
    up, vn = dot(y, n), dot(v, n)
    t = -up / vn
    t = (np.ldexp(t, ye - ve) if rays.switches.scaling else t) + 0.0
    along = (vn == 0) | ((vn > 0) == (up > 0))
    keep = np.broadcast_to(~along | (up <= 0), rays.lanes)
    out = ~along & (vn > 0)
    lanes = np.arange(rays.lanes)
    enter = _wide(np.where(along | out, 0.0, t), lanes)
    leave = _wide(np.where(out, t, np.inf), lanes)
    return Lists(lanes, enter, leave, rays.lanes).where(keep)


def sphere(solid: Sphere, rays: Bundle, first: bool = False) -> Lists:
    """Return where the distance from the center is at most the radius."""

    def make() -> tuple[Start, Whole]:
        y, ye = _from(solid.center, rays)
        if not rays.switches.scaling:
            return Start(y, _length(solid.radius, UNSCALED)), UNSCALED
        e = np.maximum(ye, exponent(solid.radius))
        return Start(vec.shift(y, ye - e), _length(solid.radius, e)), e

    start, e = rays.of_origin(solid, make)
    way = course(None, rays)
    pairs = rays.switches.chord(start, way.line, How(rays.switches.misses, first), rays.lanes)
    return unscale(pairs, e - way.e, rays.switches.scaling)


def unscale(pairs: Lists, e: Whole, scaling: bool) -> Lists:
    """Return the pairs with every t multiplied by 2^e: infinite if that overflows, never -0."""
    enter, leave = pairs.enter, pairs.leave
    if scaling:
        e = e if e.size == 1 else e[pairs.lane]
        enter, leave = np.ldexp(enter, e), np.ldexp(leave, e)
    return Lists(pairs.lane, enter + 0.0, leave + 0.0, pairs.lanes)


def _wide(a: Array, lanes: Whole) -> Array:
    return np.broadcast_to(a, lanes.shape)
