"""A prism of n sides in each capped cylinder, under a caster of triangles; how its error falls.

As one would do it who has a mesh and no formula: all hits of the ray, sorted, in and out by the
normals of the faces; hits within JOIN of each other on the same side are one, on an edge. The
chord of a convex body is the answer; hits that are no chord are a failure, nothing is repaired.

The vertices lie on the cylinder, so that a tracer of meshes is off by up to the sagitta
r (1 - cos(pi / n)): its error falls as 1 / n^2. That is measured with the same rays for every n.
They pass the axis of a cylinder of radius 1 at 1/2 at most and are about as fast as 1: errors of t
are errors in radii.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from importlib import import_module
from math import log2, nan
from statistics import linear_regression
from typing import Any

from raycert.cases.families.frames import UPRIGHT
from raycert.cases.families.sketch import rod
from raycert.cases.model import Cylinder
from raycert.oracle.measure.errors import Referee
from raycert.oracle.measure.sweeps import Sample, before, draw, real, root
from raycert.oracle.measure.way import Answered, Case, Way

CASTERS = {"trimesh": "ray_triangle", "embree": "ray_pyembree"}
"""The modules of trimesh that cast: in doubles, and by Embree in binary32."""
SIDES = tuple(2**k for k in range(3, 13))
JOIN = 1e-9
"""In units of the t of the last hit."""
RAYS = 24


@lru_cache(maxsize=64)
def body(solid: Cylinder, caster: str, n: int) -> tuple[Any, Any]:
    """Return the prism of a cylinder, in world coordinates, and what casts at it."""
    import numpy as np
    import trimesh

    from raycert.oracle.measure.arrays import basis
    from raycert.oracle.witness.bodies import Fineness, Side, prism_surface

    vertices, faces = prism_surface(Fineness(n, 0), Side.INNER, 0.0)
    p, q = np.array(solid.p), np.array(solid.q)
    along = (q - p) / 2
    across = basis(along)[:2] * solid.radius
    world = (p + q) / 2 + vertices[:, :2] @ across + vertices[:, 2:] * along
    mesh = trimesh.Trimesh(world, faces, process=False)
    return mesh, import_module(f"trimesh.ray.{CASTERS[caster]}").RayMeshIntersector(mesh)


def cast(caster: str, n: int, cases: Sequence[Case]) -> list[Answered]:
    from raycert.oracle.measure.arrays import by_solid, scattered

    return scattered(cases, by_solid, lambda group: _group(group, caster, n))


def _group(cases: list[Case], caster: str, n: int) -> list[Answered]:
    import numpy as np

    from raycert.oracle.measure.arrays import rows

    solid = cases[0].solid
    assert isinstance(solid, Cylinder)
    try:
        with np.errstate(all="ignore"):
            ray, t, inward = _hits(solid, caster, n, *rows(cases))
    except Exception:  # whatever a caster raises of numbers that it cannot take
        return [None] * len(cases)
    hits: list[list[tuple[float, bool]]] = [[] for _ in cases]
    for i, at, goes_in in zip(ray.tolist(), t.tolist(), inward.tolist(), strict=True):
        hits[i].append((at, goes_in))
    return [chord(sorted(each)) for each in hits]


def _hits(
    solid: Cylinder, caster: str, n: int, origins: Any, directions: Any
) -> tuple[Any, Any, Any]:
    """Return of each hit the number of its ray, its t, and whether it goes in."""
    import numpy as np

    mesh, casting = body(solid, caster, n)
    points, ray, face = casting.intersects_location(origins, directions, multiple_hits=True)
    if not len(ray):
        return np.zeros(0, int), np.zeros(0), np.zeros(0, bool)
    v = directions[ray]
    t = np.sum((points - origins[ray]) * v, axis=1) / np.sum(v * v, axis=1)
    return ray, t, np.sum(np.asarray(mesh.face_normals)[face] * v, axis=1) < 0


def chord(hits: list[tuple[float, bool]]) -> Answered:
    """Return the list of hits at t >= 0, each with whether it goes in; None if they are none."""
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


@dataclass(frozen=True, slots=True)
class Sides:
    """For a caster and prisms of n sides: the mean error in radii, and the rays that it lost."""

    caster: str
    n: int
    error: float
    lost: int


def referees(seed: int, count: int = RAYS) -> list[Referee]:
    """Return rays through the wall on both sides of a cylinder of radius 1, about 3 away."""
    asked = []
    for number in range(count):
        dice = draw(seed, "sides", number)
        offset, turn, climb = (real(dice, *ends) for ends in ((-0.5, 0.5), (-1, 1), (-0.25, 0.25)))
        c, s = turn, root(1 - turn * turn)
        target, direction = (-offset * s, offset * c, Fraction(0)), (c, s, climb)
        body = rod((0, 0, -4), (0, 0, 4), 1)
        referee = Sample(body, before(target, direction, 3), direction, UPRIGHT).referee()
        assert referee is not None
        asked.append(referee)
    return asked


def measure(way: Way, caster: str, n: int, asked: Sequence[Referee]) -> Sides:
    """Return the error of one mesh: the mean over both ends of the rays that it does not lose."""
    errors, lost = [], 0
    for referee, answer in zip(asked, way.solve([one.case for one in asked]), strict=True):
        if answer is None or len(answer) != len(referee.expected):
            lost += 1
            continue
        for given, true in zip(answer, referee.expected, strict=True):
            errors += [abs(a - b) for a, b in zip(given, true, strict=True)]
    return Sides(caster, n, sum(errors) / len(errors) if errors else nan, lost)


def curves(
    ways: Mapping[str, Way], seed: int, advance: Callable[..., None], most: int = SIDES[-1]
) -> list[Sides]:
    """Return the errors of every caster that is among the ways, up to `most` sides."""
    asked, errors = referees(seed), []
    for caster in CASTERS:
        for n in (n for n in SIDES if n <= most):
            if (way := ways.get(f"{caster}-{n}")) is not None:
                errors.append(measure(way, caster, n, asked))
            advance()
    return errors


def slope(sides: Sequence[Sides], caster: str) -> float:
    """Return the slope of log error over log n by least squares; NaN for less than two points."""
    points = [(log2(x.n), log2(x.error)) for x in sides if x.caster == caster and x.error > 0]
    return linear_regression(*zip(*points, strict=True)).slope if len(points) > 1 else nan
