"""Bodies of triangles that lie inside, or around, the unit cylinder and the unit ball.

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

Floats = NDArray[np.float64]

MARGIN = 2.0**-30
"""How far a face may seem to be moved by trimesh's caster, in radii; see `margins.py`."""

HUB = (0.1234, 0.0567)
"""Where the triangles of a cap meet; any point off the axis and off the symmetry planes does."""

TURN = (0.3819660112501051, 0.2360679774997898)
"""The share of a step by which the first and the second variant are turned: golden sections."""


class Side(Enum):
    """Which side of the true solid a body keeps to."""

    INNER = -1
    OUTER = 1

    @property
    def other(self) -> Side:
        """Return the opposite side."""
        return Side(-self.value)


class Part(Enum):
    """The parts of a prism's surface."""

    WALL = 0
    BOTTOM = 1
    TOP = 2


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
