"""A prism of n sides in each capped cylinder, in world coordinates, under a caster of triangles.

As one would do it who has a mesh and no formula: all hits of the ray, sorted, in and out by the
normals of the faces; hits within JOIN of each other on the same side are one, on an edge. The
chord of a convex body is the answer; hits that are no chord are a failure, nothing is repaired. The
vertices lie on the cylinder: the answer is short by up to r (1 - cos(pi / n)).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
import trimesh

from raycert.cases.model import Cylinder
from raycert.oracle.measure.methods.method import Answered, Case
from raycert.oracle.measure.methods.vector.batches import rays, scattered
from raycert.oracle.witness.prism import Fineness, Side, prism_surface

JOIN = 1e-9
"""In units of the t of the last hit."""


@lru_cache(maxsize=64)
def body(solid: Cylinder, caster: str, n: int) -> tuple[Any, Any]:
    """Return the prism of a cylinder and what casts at it."""
    vertices, faces = prism_surface(Fineness(n, 0), Side.INNER, 0.0)
    p, q = np.array(solid.p), np.array(solid.q)
    along = (q - p) / 2
    n_hat = along / np.linalg.norm(along)
    least = np.eye(3)[np.argmin(np.abs(n_hat))]
    e = np.cross(n_hat, least)
    e /= np.linalg.norm(e)
    across = np.array([e, np.cross(n_hat, e)]) * solid.radius
    world = (p + q) / 2 + vertices[:, :2] @ across + vertices[:, 2:] * along
    mesh = trimesh.Trimesh(world, faces, process=False)
    return mesh, _casters()[caster](mesh)


def _casters() -> dict[str, Callable[[Any], Any]]:
    from trimesh.ray import ray_triangle

    found: dict[str, Callable[[Any], Any]] = {"trimesh": ray_triangle.RayMeshIntersector}
    try:
        from trimesh.ray import ray_pyembree
    except ImportError:
        return found
    return found | {"embree": ray_pyembree.RayMeshIntersector}


def cast(caster: str, n: int) -> Callable[[Sequence[Case]], list[Answered]]:
    """Return the `solve` of prisms of n sides under a caster."""
    return lambda cases: scattered(
        cases, lambda solid: solid, lambda group: _group(group, caster, n)
    )


def _group(cases: list[Case], caster: str, n: int) -> list[Answered]:
    solid = cases[0].solid
    assert isinstance(solid, Cylinder)
    origins, directions = rays(cases)
    try:
        with np.errstate(all="ignore"):
            ray, t, inward = _hits(solid, caster, n, origins, directions)
    except Exception:  # whatever a caster raises of numbers that it cannot take
        return [None] * len(cases)
    hits: list[list[tuple[float, bool]]] = [[] for _ in cases]
    for i, at, goes_in in zip(ray.tolist(), t.tolist(), inward.tolist(), strict=True):
        hits[i].append((at, goes_in))
    return [_chord(sorted(found)) for found in hits]


def _hits(
    solid: Cylinder, caster: str, n: int, origins: Any, directions: Any
) -> tuple[Any, Any, Any]:
    """Return of each hit the number of its ray, its t, and whether it goes in."""
    mesh, casting = body(solid, caster, n)
    points, ray, face = casting.intersects_location(origins, directions, multiple_hits=True)
    if not len(ray):
        return np.zeros(0, int), np.zeros(0), np.zeros(0, bool)
    v = directions[ray]
    t = np.sum((points - origins[ray]) * v, axis=1) / np.sum(v * v, axis=1)
    return ray, t, np.sum(np.asarray(mesh.face_normals)[face] * v, axis=1) < 0


def _chord(hits: list[tuple[float, bool]]) -> Answered:
    """Return the list that hits at t >= 0 tell, or None where they are no chord."""
    if any(t != t for t, _ in hits):
        return None
    apart = hits[-1][0] * JOIN if hits else 0.0
    ends: list[tuple[float, bool]] = []
    for t, goes_in in hits:
        if not ends or ends[-1][1] != goes_in or t - ends[-1][0] > apart:
            ends.append((t, goes_in))
    match ends:
        case []:
            return ()
        case [(leave, False)]:
            return ((0.0, leave),)
        case [(enter, True), (leave, False)]:
            return ((enter, leave),)
    return None
