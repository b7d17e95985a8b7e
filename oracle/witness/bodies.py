"""Bodies of triangles inside, or around, the unit cylinder and the unit ball; and a cast at one.

The unit cylinder is x^2 + y^2 <= 1, |z| <= 1. Each body comes in two sides, inner and outer, that
keep 2 MARGIN away from it, so that a face moved by MARGIN is still on its own side:

    inner prism    vertices at radius 1 - 2 MARGIN, caps at +-(1 - 2 MARGIN)
    outer prism    vertices at radius (1 + 2 MARGIN) / cos(pi / n), caps at +-(1 + 2 MARGIN)
    inner ball     vertices at radius 1 - 2 MARGIN
    outer ball     the inner one, scaled until its nearest face plane is 1 + 2 MARGIN away

Why the factor 2: moving the planes of a convex body by m moves its vertices by at most m / cos a,
with a the angle between a face and the vertex's ray: 1 / cos(pi / 8) < 1.1 for the coarsest prism,
less for the balls. Why they enclose: a ball holds all triangles whose corners it holds; a closed
surface around the center that stays out of a ball holds the ball. The vertices are doubles, and
`tests/witness/test_meshes.py` proves each of these bounds in exact fractions of those doubles.

Vertices are turned by a share of a step that no simple slope has, and caps are fans around a point
off the axis: a ray along an axis or through a center meets neither an edge nor a vertex.

A line meets a convex body in one chord or not at all. trimesh answers with hits: twice where the
ray meets an edge, none where a face is within 1e-5 of parallel or where rounding loses both sides
of an edge, one where two are closer than 1e-8. So the hits have to look like those of one chord
(some where the surface faces the ray, at one place, then some where it faces away, at one place);
what does not is `Unsure`, and nothing is repaired. Both ends of a chord can be lost, to two faces
near parallel: a miss is believed only where no such face can have been crossed (`may_lose`).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from math import pi
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.ray.ray_triangle import RayMeshIntersector

from raycert.oracle.witness.placement import CastLine, Part

Floats = NDArray[np.float64]

MARGIN = 2.0**-30
"""How far a face may seem to be moved by trimesh's caster, in radii. Measured in exact integers, by
`PYTHONPATH=tests python -m shared.margins 40000 1`: 1.6e-12 at most for prisms of n <= 256 and all
balls, which the witness uses, and 1e-10 for n = 4096, which only the curve of convergence does."""

HUB = (0.1234, 0.0567)
"""Where the triangles of a cap meet; any point off the axis and off the symmetry planes does."""

TURN = (0.3819660112501051, 0.2360679774997898)
"""The share of a step by which the first and the second variant are turned: golden sections."""


class Side(Enum):
    """Which side of the true solid a body keeps to."""

    INNER = -1
    OUTER = 1


@dataclass(frozen=True, slots=True)
class Fineness:
    """How fine the bodies are: a prism has n sides, a ball 20 * 4^level faces.

    `variant` (0 or 1) tells two bodies of the same kind apart: they share no vertex.
    """

    n: int
    level: int
    variant: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """A closed convex surface, triangles outward, and trimesh's caster on it."""

    vertices: Floats
    faces: NDArray[np.int64]
    normals: Floats
    caster: Any

    @classmethod
    def of(cls, vertices: Floats, faces: NDArray[np.int64]) -> Body:
        """Return the body of a surface; nothing is merged, moved or dropped (`process=False`)."""
        mesh = trimesh.Trimesh(vertices, faces, process=False)
        caster: Any = RayMeshIntersector
        return cls(vertices, faces, np.asarray(mesh.face_normals), caster(mesh))

    def part(self, face: int) -> Part:
        """Return the part of a prism that a face lies on; faces come in that order, 2 : 1 : 1."""
        quarter = len(self.faces) // 4
        return Part(max(0, int(face) // quarter - 1))


@lru_cache(maxsize=64)
def prism(fineness: Fineness, side: Side) -> Body:
    """Return the prism on one side of the unit cylinder: n sides, 4 n triangles."""
    return Body.of(*prism_surface(fineness, side, MARGIN))


def prism_surface(
    fineness: Fineness, side: Side, margin: float
) -> tuple[Floats, NDArray[np.int64]]:
    """Return vertices (n at the bottom, n at the top, two hubs) and faces of a prism."""
    n, reach = fineness.n, 1 + side.value * 2 * margin
    radius = reach if side is Side.INNER else reach / np.cos(pi / n)
    angles = 2 * pi * (np.arange(n) + TURN[fineness.variant]) / n
    ring = np.column_stack((radius * np.cos(angles), radius * np.sin(angles)))
    heights = np.repeat((-reach, reach), n)
    rims = np.column_stack((np.vstack((ring, ring)), heights))
    vertices = np.vstack((rims, ((*HUB, -reach), (*HUB, reach))))
    i = np.arange(n, dtype=np.int64)
    j = (i + 1) % n
    low, high = np.full_like(i, 2 * n), np.full_like(i, 2 * n + 1)
    triangles = ((i, j, j + n), (i, j + n, i + n), (low, j, i), (high, i + n, j + n))
    return vertices, np.vstack([np.column_stack(triangle) for triangle in triangles])


@lru_cache(maxsize=32)
def ball(fineness: Fineness, side: Side) -> Body:
    """Return the polyhedron on one side of the unit ball: 20 * 4^level triangles."""
    return Body.of(*ball_surface(fineness, side, MARGIN))


def ball_surface(fineness: Fineness, side: Side, margin: float) -> tuple[Floats, NDArray[np.int64]]:
    """Return vertices and faces of an icosphere, turned away from the coordinate axes."""
    sphere = trimesh.creation.icosphere(subdivisions=fineness.level)
    turn = 1 + TURN[fineness.variant]
    vertices = np.asarray(sphere.vertices) @ _rotation(turn, turn / 2, turn / 3)
    vertices /= np.linalg.norm(vertices, axis=1)[:, np.newaxis]
    faces = np.asarray(sphere.faces, dtype=np.int64)
    reach = 1 + side.value * 2 * margin
    if side is Side.OUTER:
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        depths = np.sum(normals * a, axis=1) / np.linalg.norm(normals, axis=1)
        reach /= depths.min()
    return vertices * reach, faces


def _rotation(a: float, b: float, c: float) -> Floats:
    """Return the rotation by the angles a, b, c about z, x and z."""

    def about_z(angle: float) -> Floats:
        x, y = np.cos(angle), np.sin(angle)
        return np.array(((x, -y, 0), (y, x, 0), (0, 0, 1)))

    about_x = about_z(b)[[2, 0, 1]][:, [2, 0, 1]]
    return np.asarray(about_z(a) @ about_x @ about_z(c))


BLIND = 1.1e-5
"""trimesh skips faces with |normal . direction| <= 1e-5; a tenth more for its rounding."""

REACH = 1e-3
"""How far beyond a face, in steps of the cast, its crossing is looked for."""


class Unsure(ArithmeticError):
    """The hits of a cast are not those of one chord, and it says nothing."""


@dataclass(frozen=True, slots=True)
class ChordEnd:
    """One end of a chord: the parameter tau of the cast, and the faces it was found on."""

    tau: float
    faces: tuple[int, ...]


Hit = tuple[float, int, bool]
"""The parameter tau of a cast, the face, and whether the cast goes in there."""


def hits(body: Body, line: CastLine) -> list[Hit]:
    """Return all hits of a cast, as trimesh finds them, in order along it."""
    start, direction = np.array([line.start]), np.array([line.direction])
    with np.errstate(divide="ignore", invalid="ignore"):  # triangles whose area rounds to 0
        points, _, faces = body.caster.intersects_location(start, direction, multiple_hits=True)
    if not len(faces):
        return []
    d = direction[0]
    tau, inward = (points - start) @ d / (d @ d), body.normals[faces] @ d < 0
    found = zip(tau.tolist(), faces.tolist(), inward.tolist(), strict=True)
    return sorted(found, key=lambda hit: hit[0])


def chord(body: Body, line: CastLine) -> tuple[ChordEnd, ChordEnd] | None:
    """Return where a cast enters and leaves a convex body, None for a miss.

    The chord is that of the body with its faces moved by at most MARGIN. Raises `Unsure`
    where the hits are not those of one chord.
    """
    found = hits(body, line)
    if not found:
        if may_lose(body, line):
            raise Unsure("a face is too near parallel to tell a miss")
        return None
    turns = [inward for _, _, inward in found]
    entering = sum(turns)
    if turns != sorted(turns, reverse=True):
        raise Unsure("the hits do not enter and then leave")
    if not 0 < entering < len(turns):
        raise Unsure("a hit of the pair is lost")
    return _end(found[:entering]), _end(found[entering:])


def may_lose(body: Body, line: CastLine) -> bool:
    """Whether the cast may cross a face that trimesh skips as parallel.

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


def _end(found: list[Hit]) -> ChordEnd:
    """Return the end that some hits are: one place, several faces at an edge."""
    if found[-1][0] - found[0][0] > MARGIN:
        raise Unsure("the hits of one end lie apart")
    return ChordEnd(found[0][0], tuple(face for _, face, _ in found))
