"""The Boolean of the bodies themselves: Manifold combines meshes, trimesh casts at the result.

A second road to the list of a tree, which shares with the first only the bodies and the caster. All
leaves are put into one frame, moved and scaled by a power of two so that the part of the ray in
which they begin and end (the window) lies within 2 of its middle. Leaves without end are cut at
CUT, outside of the window, and lists are compared in the window only.

The frame is in doubles, so the bodies keep 2 WIDE away from the true ones, in units of each leaf:
with leaves of 2^-10 to 2^6 and coordinates below 2^12, 2^-16 2^-10 = 1.5e-8 stands against 2^-42 a
rounding, a few of which place a vertex and the ray, and against the 1e-12 of its greatest
coordinate by which Manifold may move a vertex. What is larger, smaller or farther off is not tried.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, partial

import numpy as np
from manifold3d import Error, Manifold, Mesh64, OpType

from raycert.cases.model import (
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
    leaves,
    points,
)
from raycert.oracle.exact.intervals import Interval, Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO
from raycert.oracle.witness.algebra import Vec
from raycert.oracle.witness.bodies import (
    Body,
    Fineness,
    Floats,
    Hit,
    Side,
    Unsure,
    ball_surface,
    hits,
    may_lose,
    prism_surface,
)
from raycert.oracle.witness.placement import (
    AWAY,
    ONE,
    CastLine,
    across,
    exact,
    floats,
    moderate,
    power,
    root,
)
from raycert.oracle.witness.sandwich import NONE, Sandwich, judge, select, surd
from raycert.oracle.witness.testimony import Outcome

WIDE = 2.0**-16
CUT = 16
"""Where leaves without end are cut: 16 from the point of theirs nearest to the middle."""

SMALLEST, LARGEST = Fraction(1, 1024), 64
START = 2048
"""How many steps of 0.7 or more before the middle a cast starts: a body lies
within 256 sqrt(3) and, a half-space, as far again and 32, which is 950 in all."""

SPREAD = 2.0**-24
"""Hits of one end lie this close together; ends that are not 16 times as far apart are unsure."""

COARSE = (Fineness(n=48, level=2), Fineness(n=40, level=2, variant=1))
"""Two sets of bodies: a disagreement is one that both see. Finer ones settle no more of a random
sample, and cost 2.5 times as much at n = 64, level 3."""


BOOLEANS = {Union: OpType.Add, Intersection: OpType.Intersect, Difference: OpType.Subtract}


class NotTried(ValueError):
    """A scene that does not fit one frame, and why."""


@dataclass(frozen=True, slots=True)
class Viewport:
    """x' = (x - middle) * scale, and the window low <= t <= high."""

    middle: Vec
    scale: Fraction
    low: Fraction
    high: Fraction

    def point(self, x: Vector) -> Vec:
        return self.scale * (exact(x) - self.middle)

    def length(self, x: float | Fraction) -> Fraction:
        """Return a length in the view, or refuse it; the outer body of 0 takes the least."""
        length = self.scale * Fraction(x) or SMALLEST
        if not SMALLEST <= length <= LARGEST:
            raise NotTried("the sizes differ too much for one frame")
        return length

    @property
    def window(self) -> Intervals:
        return ((surd(self.low), surd(self.high)),)


def check(
    solid: Solid, ray: Ray, answer: Intervals, parts: Sequence[Sandwich]
) -> tuple[Outcome, str]:
    """Return what the combined bodies say of an answer, and why.

    `parts` are the sandwiches of the leaves, which give the window.
    """
    try:
        view = _viewport(solid, ray, parts)
        first, second = (
            partial(_compare, solid, ray, answer, view, fineness) for fineness in COARSE
        )
        outcome, why = first()
        if outcome == "disagreed" and second()[0] != "disagreed":
            return "undecided", f"seen with one set of bodies only: {why}"
    except NotTried as reason:
        return "undecided", f"not tried: {reason}"
    except Unsure as unsure:
        return "undecided", str(unsure)
    return outcome, why


def _viewport(solid: Solid, ray: Ray, parts: Sequence[Sandwich]) -> Viewport:
    """Return the view whose window holds the outer ends of all leaves, and a quarter more.

    Where no leaf begins or ends after 0, the window holds the ray as far as the leaves are.
    """
    u, v = exact(ray.origin), exact(ray.direction)
    speed = max(map(abs, v.parts))
    if not speed:
        raise NotTried("the ray stays at its origin")
    ends = {e.rational() for part in parts for pair in part.outer for e in pair if e != INFINITY}
    known = [end for end in ends if end is not None]
    if not any(known):
        away = [exact(points(leaf)[0]) - u for _, leaf in leaves(solid)]
        known = [max(map(abs, d.parts)) / speed for d in away]
    if not any(known):
        raise NotTried("the ray starts where the leaves are, and meets no end of theirs")
    pad = (max(known) - min(known) or max(known)) / 4
    low, high = max(min(known) - pad, Fraction(0)), max(known) + pad
    center, reach = (low + high) / 2, (high - low) / 2
    return Viewport(u + center * v, 1 / power(reach * root(v @ v)), low, high)


def _compare(
    solid: Solid, ray: Ray, answer: Intervals, view: Viewport, fineness: Fineness
) -> tuple[Outcome, str]:
    inner, outer = (
        select((_cast(_build(solid, view, fineness, side), ray, view), view.window), all)
        for side in (Side.INNER, Side.OUTER)
    )
    low, high = view.window[0]
    seen = [(max(a, low), min(b, high)) for a, b in answer]
    return judge(tuple((a, b) for a, b in seen if a <= b), Sandwich(inner, outer))


def _build(solid: Solid, view: Viewport, fineness: Fineness, side: Side) -> Manifold:
    """Return the inner or outer body of a solid; a part that is taken away changes sides."""
    if not isinstance(solid, Tree):
        return _leaf(solid, view, fineness, side)
    away = Side(-side.value) if isinstance(solid, Difference) else side
    parts = [_build(part, view, fineness, away if i else side) for i, part in enumerate(solid.of)]
    return Manifold.batch_boolean(parts, BOOLEANS[type(solid)])


def _leaf(leaf: Leaf, view: Viewport, fineness: Fineness, side: Side) -> Manifold:
    """Return a unit body, moved to where its leaf is in the view."""
    if side is Side.INNER and not getattr(leaf, "radius", True):
        return Manifold()
    vertices, faces = _unit_surface(isinstance(leaf, Sphere), fineness, side)
    middle, columns = _place(leaf, view)
    if max(map(abs, middle.parts)) > 4 * LARGEST:
        raise NotTried("a leaf is far from where the leaves begin and end")
    moved = vertices @ np.array([floats(column) for column in columns]) + floats(middle)
    body = Manifold(Mesh64(np.ascontiguousarray(moved), faces.astype(np.uint64)))
    if body.status() != Error.NoError:
        raise Unsure(f"Manifold refuses a body: {body.status()}")
    return body


@lru_cache(maxsize=16)
def _unit_surface(sphere: bool, fineness: Fineness, side: Side) -> tuple[Floats, np.ndarray]:
    return (ball_surface if sphere else prism_surface)(fineness, side, WIDE)


def _place(leaf: Leaf, view: Viewport) -> tuple[Vec, tuple[Vec, Vec, Vec]]:
    """Return where the middle and the three axes of the unit body go."""
    match leaf:
        case Sphere():
            r, o = view.length(leaf.radius), Fraction(0)
            return view.point(leaf.center), (Vec(r, o, o), Vec(o, r, o), Vec(o, o, r))
        case HalfSpace():
            normal = exact(leaf.normal)
            foot = _onto(view.point(leaf.point), normal)
            up = _as_long(CUT + root(foot @ foot or ONE), normal)
            return foot - up, _axes(up, Fraction(CUT))
    p, q = view.point(leaf.p), view.point(leaf.q)
    w, middle = q - p, (p + q) / 2
    if isinstance(leaf, InfiniteCylinder):
        return p - _onto(p, w), _axes(_as_long(Fraction(CUT), w), view.length(leaf.radius))
    view.length(root(w @ w))
    if isinstance(leaf, Slab):
        return _onto(middle, w), _axes(w / 2, Fraction(CUT))
    return middle, _axes(w / 2, view.length(leaf.radius))


def _onto(x: Vec, w: Vec) -> Vec:
    """Return the part of x along w."""
    part: Vec = (x @ w / (w @ w)) * w
    return part


def _as_long(length: Fraction, w: Vec) -> Vec:
    """Return the vector of a length in the direction of w."""
    return (length / root(w @ w)) * w


def _axes(w: Vec, radius: Fraction) -> tuple[Vec, Vec, Vec]:
    """Return the right-handed axes of a prism with a half axis w."""
    e, f = (_as_long(radius, g) for g in across(w))
    return e, f, w


def _cast(solid: Manifold, ray: Ray, view: Viewport) -> Intervals:
    """Return the t >= 0 for which the ray is within a body, which need not be convex."""
    if solid.is_empty():
        return NONE
    mesh = solid.to_mesh64()
    body = Body.of(
        np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    )
    v = view.scale * exact(ray.direction)
    pace = moderate(v)
    d = pace * v
    t0 = (view.low + view.high) / 2 - pace * (START - AWAY)
    line = CastLine(floats(-START * d), floats(d), t0, pace)
    if may_lose(body, line):
        raise Unsure("a face of the combined bodies is too near parallel")
    return _alternating(hits(body, line), line)


def _alternating(found: Sequence[Hit], line: CastLine) -> Intervals:
    """Return the list that hits make which enter and leave in turn, each at a place of its own."""
    ends: list[tuple[float, bool]] = []
    for tau, _, inward in found:
        apart = tau - ends[-1][0] if ends else 1.0
        if apart <= SPREAD and ends[-1][1] == inward:
            continue
        if apart <= 16 * SPREAD:
            raise Unsure("two ends of the combined bodies lie too close together")
        ends.append((tau, inward))
    turns = [inward for _, inward in ends]
    if turns != [True, False] * (len(ends) // 2):
        raise Unsure("the hits of the combined bodies do not enter and leave in turn")
    times = [surd(line.time(tau)) for tau, _ in ends]
    pairs: list[Interval] = list(zip(times[::2], times[1::2], strict=True))
    return tuple((max(a, ZERO), b) for a, b in pairs if b > ZERO)
