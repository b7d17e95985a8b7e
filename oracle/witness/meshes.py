"""Witness by meshes: trimesh casts the ray at bodies inside and around each leaf.

Every leaf is looked at in its own coordinates (`frame.py`), where it is a unit cylinder or a unit
ball between an inner and an outer body (`prism.py`) whose chords a caster finds (`casting.py`).
The lists of the leaves combine to an inner and an outer list of the whole solid (`sandwich.py`):

    inner list <= true list <= outer list

holds by geometry; the only thing taken on trust is that the caster seems to move a face by less
than MARGIN, which `margins.py` measures. Of a Boolean, the bodies themselves are combined too, by
Manifold where it is installed (`solids.py`).

What stays undecided is what no mesh can tell: touches, rays in a face, tangents within the gap,
starts on the boundary going out, faces that parts share. Of a fresh sample of `crosscheck`, three
quarters on a small lattice, that is 17 in 100; of 3000 scenes with random coordinates, none.

A disagreement has to be seen with two sets of bodies that share no vertex; seen with one it is the
caster's, and undecided.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from raycert.cases.model import Leaf, Ray, Solid, Tree, leaves
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, fraction
from raycert.oracle.witness.casting import End, Unsure, chord
from raycert.oracle.witness.frame import AWAY, Line, Placed, line, place
from raycert.oracle.witness.prism import Body, Fineness, Side, ball, prism
from raycert.oracle.witness.sandwich import ALL, NONE, Sandwich, combine, judge, show
from raycert.oracle.witness.verdict import Verdict

try:
    from raycert.oracle.witness.solids import check
except ModuleNotFoundError as absent:
    if absent.name != "manifold3d":
        raise
    check = None  # type: ignore[assignment]

FIRST = Fineness(n=256, level=4)
"""Gaps of 8e-5 and 1e-3 radii at about 1 and 3 ms a cast; `convergence.py` has the curve."""

SECOND = Fineness(n=192, level=4, variant=1)
"""Bodies that share no vertex with the first."""


def witness(solid: Solid, ray: Ray, answer: Intervals) -> Verdict:
    """Return what the meshes say of an answer. Any solid and ray of the model; raises nothing."""
    parts = leaf_sandwiches(solid, ray, FIRST)
    found = assemble(solid, iter(parts))
    outcome, why = judge(answer, found)
    if outcome == "disagreed" and judge(answer, sandwich(solid, ray, SECOND))[0] != "disagreed":
        outcome, why = "undecided", f"seen with one set of bodies only: {why}"
    if isinstance(solid, Tree) and check is not None:
        second, reason = check(solid, ray, answer, parts)
        outcome = "disagreed" if second == "disagreed" else outcome
        why = f"{why}; bodies combined by Manifold {second}: {reason}"
    return Verdict(outcome, show(found), why)


def sandwich(solid: Solid, ray: Ray, fineness: Fineness) -> Sandwich:
    """Return an inner and an outer list of any solid of the model."""
    return assemble(solid, iter(leaf_sandwiches(solid, ray, fineness)))


def leaf_sandwiches(solid: Solid, ray: Ray, fineness: Fineness) -> list[Sandwich]:
    """Return the sandwich of each leaf, in the order of `leaves`."""
    return [_leaf(leaf, ray, fineness) for _, leaf in leaves(solid)]


def assemble(solid: Solid, parts: Iterator[Sandwich]) -> Sandwich:
    """Return the sandwich of a solid from those of its leaves."""
    if isinstance(solid, Tree):
        return combine(solid, [assemble(part, parts) for part in solid.of])
    return next(parts)


def _leaf(leaf: Leaf, ray: Ray, fineness: Fineness) -> Sandwich:
    placed = place(leaf, ray)
    cast = line(placed)
    if cast is None:
        return Sandwich(NONE, NONE)
    inner, doubt_in = (NONE, ()) if placed.hollow else _side(placed, cast, fineness, Side.INNER)
    outer, doubt_out = _side(placed, cast, fineness, Side.OUTER)
    return Sandwich(inner, outer, (*doubt_in, *doubt_out))


def _side(
    placed: Placed, cast: Line, fineness: Fineness, side: Side
) -> tuple[Intervals, tuple[str, ...]]:
    """Return the list of one side, and the doubt where two bodies of it say nothing."""
    bodies = ball if placed.round else prism
    doubts: list[str] = []
    for each in (fineness, replace(fineness, variant=1 - fineness.variant)):
        try:
            return _list(bodies(each, side), placed, cast), ()
        except Unsure as unsure:
            doubts.append(str(unsure))
    return NONE if side is Side.INNER else ALL, (doubts[0],)


def _list(body: Body, placed: Placed, cast: Line) -> Intervals:
    """Return the t >= 0 within a body, which has no end where the cast leaves by a free part."""
    found = chord(body, cast)
    if found is None:
        return NONE
    enter, leave = found
    if placed.still:
        return ALL if enter.tau < AWAY < leave.tau else NONE
    low = _time(enter, cast) if _counts(enter, body, placed) else ZERO
    high = _time(leave, cast) if _counts(leave, body, placed) else INFINITY
    return ((max(low, ZERO), high),) if high > ZERO else NONE


def _counts(end: End, body: Body, placed: Placed) -> bool:
    """Tell whether a chord ends on a part that the leaf has, and not on a free one."""
    if placed.round:
        return True
    counted = {body.part(face) in placed.parts for face in end.faces}
    if len(counted) > 1:
        raise Unsure("a hit lies on the rim of an artificial end")
    return counted.pop()


def _time(end: End, cast: Line) -> Surd:
    """Return the ray's t at an end of a chord, exactly."""
    t = cast.t0 + cast.pace * (Fraction(end.tau) - AWAY)
    return fraction(t.numerator, t.denominator)
