"""Witness by meshes: trimesh casts the ray at bodies inside and around each leaf.

Every leaf is looked at in its own coordinates (`placement.py`), where it is a unit cylinder or a
unit ball between an inner and an outer body whose chords a caster finds (`bodies.py`). The lists of
the leaves combine to an inner and an outer list of the whole solid (`sandwich.py`):

    inner list <= true list <= outer list

holds by geometry; the only thing taken on trust is that the caster seems to move a face by less
than MARGIN, which is measured. Of a Boolean, the bodies themselves are combined too, by
Manifold where it is installed (`manifold.py`).

What stays undecided is what no mesh can tell: touches, rays in a face, tangents within the gap,
starts on the boundary going out, faces that parts share. Of a fresh sample of `crosscheck`, three
quarters on a small lattice, that is 17 in 100; of 3000 scenes with random coordinates, none.

A disagreement has to be seen with two sets of bodies that share no vertex; seen with one it is the
caster's, and undecided.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Leaf, Ray, Solid, Tree, Vector, leaves
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, ZERO
from raycert.oracle.witness.bodies import Body, ChordEnd, Fineness, Side, Unsure, ball, chord, prism
from raycert.oracle.witness.placement import AWAY, CastLine, Placed, line, place
from raycert.oracle.witness.sandwich import ALL, NONE, Sandwich, combine, judge, length, show, surd
from raycert.oracle.witness.testimony import Testimony

try:
    from raycert.oracle.witness.manifold import check
except ModuleNotFoundError as absent:
    if absent.name != "manifold3d":
        raise
    check = None  # type: ignore[assignment]

FIRST = Fineness(n=256, level=4)
"""Gaps of 8e-5 and 1e-3 radii at about 1 and 3 ms a cast; `convergence` gives the curve."""

SECOND = Fineness(n=192, level=4, variant=1)
"""Bodies that share no vertex with the first."""


def witness(solid: Solid, ray: Ray, answer: Intervals) -> Testimony:
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
    return Testimony(outcome, show(found), why)


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
    placed: Placed, cast: CastLine, fineness: Fineness, side: Side
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


def _list(body: Body, placed: Placed, cast: CastLine) -> Intervals:
    """Return the t >= 0 within a body, which has no end where the cast leaves by a free part."""
    found = chord(body, cast)
    if found is None:
        return NONE
    enter, leave = found
    if placed.still:
        return ALL if enter.tau < AWAY < leave.tau else NONE
    low = surd(cast.time(enter.tau)) if _counts(enter, body, placed) else ZERO
    high = surd(cast.time(leave.tau)) if _counts(leave, body, placed) else INFINITY
    return ((max(low, ZERO), high),) if high > ZERO else NONE


def _counts(end: ChordEnd, body: Body, placed: Placed) -> bool:
    """Whether a chord ends on a part that the leaf has, and not on a free one."""
    if placed.round:
        return True
    counted = {body.part(face) in placed.parts for face in end.faces}
    if len(counted) > 1:
        raise Unsure("a hit lies on the rim of an artificial end")
    return counted.pop()


SIDES = tuple(2**k for k in range(3, 13))
UNIT = Cylinder((0.0, 0.0, -1.0), (0.0, 0.0, 1.0), 1.0)


@dataclass(frozen=True, slots=True)
class Gap:
    """For prisms of n sides: the mean gap at one end in radii, and the seconds a ray takes."""

    n: int
    gap: float
    seconds: float

    @property
    def scaled(self) -> float:
        """Return gap * n^2, which stays near a constant."""
        return self.gap * self.n**2


def convergence(sides: Sequence[int] = SIDES, rays: int = 32) -> list[Gap]:
    """Return how fast inner and outer list close in, and the time of two casts a ray.

    A prism of n sides keeps within 1 - cos(pi / n) = (pi / n)^2 / 2 + ... of its cylinder on either
    side, so the ends of the two lists differ by about (pi / n)^2 radii over the cosine at which the
    ray meets the wall. The rays are fixed and meet it at cosines of 1/2 and more; caps have no gap.
    From n = 4096 on, 4 MARGIN = 4e-9 begins to show against (pi / n)^2 = 6e-7.

    Building the bodies is not timed. Raises `ArithmeticError` where a fixed ray is not settled.
    """
    return [_gap(n, [_through_wall(i) for i in range(rays)]) for n in sides]


def _gap(n: int, rays: Sequence[Ray]) -> Gap:
    fineness = Fineness(n, level=0)
    sandwich(UNIT, rays[0], fineness)
    start = perf_counter()
    found = [sandwich(UNIT, ray, fineness) for ray in rays]
    seconds = (perf_counter() - start) / len(rays)
    gap = 0.0
    for one in found:
        if len(one.inner) != 1 or len(one.outer) != 1:
            raise ArithmeticError(f"n = {n} does not settle a ray of the curve: {one}")
        gap += float(length(one.outer[0]) - length(one.inner[0])) / 2
    return Gap(n, gap / len(rays), seconds)


def _through_wall(number: int) -> Ray:
    """Return a ray of about unit speed through the wall on both sides, at cosines of 1/2 or more.

    It passes the axis of UNIT at a distance of at most 1/2 in the plane z = 0, and rises by at most
    1/4 of its way, so that it is within the caps where it meets the wall.
    """
    dice = Dice(f"convergence {number}")
    while True:
        x, y, rise = dice.vector(BINARY64)
        square = x * x + y * y
        if 0.9 < square < 1:
            break
    off = dice.real(BINARY64, -0.5, 0.5)
    direction: Vector = (x, y, rise / 4)
    back = 3.0
    return Ray((-off * y - back * x, off * x - back * y, -back * rise / 4), direction)
