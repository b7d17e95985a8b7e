"""How each library is asked, through the fastest interface that it has for the public.

The solid, and the rays in the form that a library takes, are made before the clock starts: objects
of its own, arrays of its precision. What it hands out is read after the clock stops; only where it
hands out points in place of t, the t are part of what is timed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from raycert.cases.model import Cylinder
from raycert.oracle.measure.speed.casting import Cast, Hits

SIDES = 256
"""Facets around a meshed cylinder, its vertices on the cylinder."""


@dataclass(frozen=True, slots=True)
class Way:
    """What is called; `run` is timed, and `read` turns what it returns into hits.

    `facets` is how many a mesh has around; None where there is no mesh.
    """

    interface: str
    run: Callable[[], Any]
    read: Callable[[Any], Hits]
    facets: int | None = None


@dataclass(frozen=True, slots=True)
class Caster:
    """A library: the packages that it needs, and the way to ask it, None where it has none."""

    name: str
    needs: tuple[str, ...]
    way: Callable[[Cast, str], Way | None]


def _reference(cast: Cast, question: str) -> Way:
    from raycert.cases.scene import Scene

    if isinstance(cast.scene, Scene):
        return _planned(cast, cast.scene, question)
    intersect = import_module("raycert.reference.arrays.tracer").intersect
    solid, u, v = cast.solid, cast.origins, cast.directions
    read = _first_of_padded if question == "first" else _all_of_padded
    return Way("intersect", lambda: intersect(solid, u, v), read)


def _planned(cast: Cast, scene: Any, question: str) -> Way:
    plan = import_module("raycert.reference.arrays.plan").plan
    see = import_module("raycert.reference.arrays.picture")
    if question == "all":
        return Way("plan, lists", lambda: see.lists(plan(scene, "lists")), _all_of_padded)

    def read(picture: Any) -> Hits:
        import numpy as np

        t = picture.values.ravel() / np.linalg.norm(cast.directions, axis=1)
        return _where(t, ~np.isnan(t))

    return Way("plan, picture", lambda: see.picture(plan(scene, "depth"), "depth"), read)


def _first_of_padded(found: Any) -> Hits:
    if not found.enter.shape[1]:
        return Hits(found.count[:0], found.enter.ravel())
    return _where(found.enter[:, 0], found.count > 0)


def _all_of_padded(found: Any) -> Hits:
    import numpy as np

    ray, column = np.nonzero(np.arange(found.enter.shape[1]) < found.count[:, None])
    t = np.column_stack([found.enter[ray, column], found.leave[ray, column]])
    return Hits(np.repeat(ray, 2), t.ravel())


def _where(t: Any, hit: Any) -> Hits:
    """Return the hits of an array that has one t for each ray, where `hit` says so."""
    import numpy as np

    ray = np.flatnonzero(hit)
    return Hits(ray, t[ray])


def _oracle(cast: Cast, question: str) -> Way:
    from dataclasses import replace

    trace_batch = import_module("raycert.oracle.batch.trace").trace_batch
    solid, u, v = cast.solid, cast.origins, cast.directions
    return Way(
        "trace_batch",
        lambda: trace_batch(solid, u, v),
        lambda found: replace(cast, truth=found).exact(question),
    )


def _raysect(cast: Cast, question: str) -> Way:
    core, primitive = import_module("raysect.core"), import_module("raysect.primitive")
    world, whole = core.World(), _of_raysect(cast.outer)
    if cast.inner is not None:
        whole = primitive.Subtract(whole, _of_raysect(cast.inner))
    whole.parent = world
    rays = [
        core.Ray(core.Point3D(*u), core.Vector3D(*v))
        for u, v in zip(cast.origins.tolist(), cast.directions.tolist(), strict=True)
    ]
    hit, following = whole.hit, whole.next_intersection

    def first() -> list[list[float]]:
        found = map(hit, rays)
        return [[] if one is None else [one.ray_distance] for one in found]

    def every() -> list[list[float]]:
        found = []
        for ray in rays:
            mine, one = [], hit(ray)
            while one is not None:
                mine.append(one.ray_distance)
                one = following()
            found.append(mine)
        return found

    if question == "first":
        return Way("hit", first, _of_lists)
    return Way("next_intersection", every, _of_lists)


def _of_raysect(solid: Cylinder) -> Any:
    """Return a cylinder of raysect: along z from its origin, turned and moved to where it is."""
    import numpy as np

    p, q = np.array(solid.p), np.array(solid.q)
    height = np.linalg.norm(q - p)
    n = (q - p) / height
    e = np.cross(n, np.eye(3)[np.argmin(abs(n))])
    e /= np.linalg.norm(e)
    columns = np.column_stack([e, np.cross(n, e), n, p])
    rows = [*columns.tolist(), [0.0, 0.0, 0.0, 1.0]]
    place = import_module("raysect.core").AffineMatrix3D(rows)
    made = import_module("raysect.primitive").Cylinder
    return made(solid.radius, float(height), transform=place)


def _of_lists(found: list[list[float]]) -> Hits:
    import numpy as np

    ray = np.repeat(np.arange(len(found)), [len(one) for one in found])
    return Hits(ray, np.array([t for one in found for t in one], float))


def _mujoco(cast: Cast, question: str) -> Way | None:
    if question != "first" or cast.inner is not None:
        return None
    import numpy as np

    mujoco = import_module("mujoco")
    ends = " ".join(map(repr, (*cast.outer.p, *cast.outer.q)))
    geom = f'<geom type="cylinder" fromto="{ends}" size="{cast.outer.radius!r}"/>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{geom}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)

    def read(t: Any) -> Hits:
        return _where(np.asarray(t), np.asarray(t) >= 0)

    if cast.scene is None:
        place = data.geom_xpos[0].copy(), data.geom_xmat[0].copy(), model.geom_size[0].copy()
        kind, ray = int(model.geom_type[0]), mujoco.mju_rayGeom
        pairs = list(zip(cast.origins, cast.directions, strict=True))
        return Way("mju_rayGeom", lambda: [ray(*place, u, v, kind) for u, v in pairs], read)
    count, eye, ways = len(cast.origins), cast.origins[0].copy(), cast.directions.ravel()
    which, t = np.zeros(count, np.int32), np.zeros(count)

    def many() -> Any:
        mujoco.mj_multiRay(model, data, eye, ways, None, 1, -1, which, t, None, count, 1e10)
        return t

    return Way("mj_multiRay", many, read)


def _mesh(cast: Cast) -> Any:
    """Return the cylinder, or the pipe, with `SIDES` facets around."""
    creation = import_module("trimesh.creation")
    outer, inner = cast.outer, cast.inner
    segment = [outer.p, outer.q]
    if inner is None:
        return creation.cylinder(outer.radius, sections=SIDES, segment=segment)
    return creation.annulus(inner.radius, outer.radius, sections=SIDES, segment=segment)


def _trimesh(cast: Cast, question: str) -> Way:
    import numpy as np

    caster = import_module("trimesh.ray.ray_pyembree").RayMeshIntersector(_mesh(cast))
    u, v, every = cast.origins, cast.directions, question == "all"

    def run() -> Hits:
        points, ray, _ = caster.intersects_location(u, v, multiple_hits=every)
        way = v[ray]
        along = np.einsum("ij,ij->i", points - u[ray], way)
        return Hits(ray, along / np.einsum("ij,ij->i", way, way))

    return Way("intersects_location", run, lambda hits: hits, SIDES)


def _embreex(cast: Cast, question: str) -> Way | None:
    if question != "first":
        return None
    import numpy as np

    mesh, scene = _mesh(cast), import_module("embreex.rtcore_scene").EmbreeScene()
    triangles = import_module("embreex.mesh_construction").TriangleMesh
    triangles(scene, mesh.vertices.astype(np.float32), mesh.faces.astype(np.int32))
    u, v = cast.origins.astype(np.float32), cast.directions.astype(np.float32)
    return Way(
        "EmbreeScene.run",
        lambda: scene.run(u, v, output=1),
        lambda found: _where(found["tfar"].astype(float), found["primID"] >= 0),
        SIDES,
    )


CASTERS = (
    Caster("reference, batched", ("numpy",), _reference),
    Caster("oracle, batched", ("numpy",), _oracle),
    Caster("raysect", ("raysect",), _raysect),
    Caster("MuJoCo", ("mujoco",), _mujoco),
    Caster("trimesh, Embree", ("trimesh", "embreex"), _trimesh),
    Caster("embreex", ("trimesh", "embreex"), _embreex),
)
"""The reference tracer first: it is what ratios are of."""
