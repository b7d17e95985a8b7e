"""One cast at a convex body by trimesh, and what may be made of its hits.

A line meets a convex body in one chord or not at all. trimesh answers with hits: twice where the
ray meets an edge, none where a face is within 1e-5 of parallel or where rounding loses both sides
of an edge, one where two are closer than 1e-8. So the hits have to look like those of one chord
(some where the surface faces the ray, at one place, then some where it faces away, at one place);
what does not is `Unsure`, and nothing is repaired. Both ends of a chord can be lost, to two faces
near parallel: a miss is believed only where no such face can have been crossed (`may_lose`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from raycert.oracle.witness.frame import Line
from raycert.oracle.witness.prism import MARGIN, Body, Floats

BLIND = 1.1e-5
"""trimesh skips faces with |normal . direction| <= 1e-5; a tenth more for its rounding."""

REACH = 1e-3
"""How far beyond a face, in steps of the cast, its crossing is looked for."""


class Unsure(ArithmeticError):
    """The hits of a cast are not those of one chord, and it says nothing."""


@dataclass(frozen=True, slots=True)
class End:
    """One end of a chord: the parameter tau of the cast, and the faces it was found on."""

    tau: float
    faces: tuple[int, ...]


Chord = tuple[End, End]


@dataclass(frozen=True, slots=True)
class Hits:
    """What a cast found, in order along it: parameters, faces, and whether each goes in."""

    tau: Floats
    faces: tuple[int, ...]
    inward: tuple[bool, ...]


def hits(body: Body, line: Line) -> Hits:
    """Return all hits of a cast, as trimesh finds them."""
    start, direction = np.array([line.start]), np.array([line.direction])
    with np.errstate(divide="ignore", invalid="ignore"):  # triangles whose area rounds to 0
        points, _, faces = body.caster.intersects_location(start, direction, multiple_hits=True)
    if not len(faces):
        return Hits(np.empty(0), (), ())
    d = direction[0]
    tau = (points - start) @ d / (d @ d)
    order = np.argsort(tau)
    found = faces[order]
    inward = body.normals[found] @ d < 0
    return Hits(tau[order], tuple(found.tolist()), tuple(inward.tolist()))


def chord(body: Body, line: Line) -> Chord | None:
    """Return where a cast enters and leaves a convex body, None for a miss.

    The chord is that of the body with its faces moved by at most MARGIN (measured: `margins.py`).
    Raises `Unsure` where the hits are not those of one chord.
    """
    found = hits(body, line)
    if not found.faces:
        if may_lose(body, line):
            raise Unsure("a face is too near parallel to tell a miss")
        return None
    entering = sum(found.inward)
    if found.inward != (True,) * entering + (False,) * (len(found.inward) - entering):
        raise Unsure("the hits do not enter and then leave")
    if not 0 < entering < len(found.inward):
        raise Unsure("a hit of the pair is lost")
    return _end(found, 0, entering), _end(found, entering, len(found.faces))


def may_lose(body: Body, line: Line) -> bool:
    """Tell whether the cast may cross a face that trimesh skips as parallel.

    A face is crossed only if its plane is, on the stretch where the cast passes the face; there the
    distance from the plane is linear, and within 1e-13 of what doubles make of it.
    """
    start, d = np.array(line.start), np.array(line.direction)
    slopes = body.normals @ d
    skipped = (np.abs(slopes) <= BLIND) & (np.abs(body.normals).max(axis=1) > 0)
    normals, slopes = body.normals[skipped], slopes[skipped]
    corners = body.vertices[body.faces[skipped]] - start
    along = corners @ d / (d @ d)
    heights = np.sum(corners[:, 0] * normals, axis=1)
    first = (along.min(axis=1) - REACH) * slopes - heights
    last = (along.max(axis=1) + REACH) * slopes - heights
    near = np.minimum(np.abs(first), np.abs(last)) <= MARGIN
    return bool(np.any(near | (first * last <= 0)))


def _end(found: Hits, first: int, last: int) -> End:
    """Return the end that hits first..last - 1 are: one place, several faces at an edge."""
    if found.tau[last - 1] - found.tau[first] > MARGIN:
        raise Unsure("the hits of one end lie apart")
    return End(float(found.tau[first]), found.faces[first:last])
