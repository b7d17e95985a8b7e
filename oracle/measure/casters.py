"""Ray casters that people use, and what they are asked: a solid, rays from outside, the exact hits.

    scattered   each ray has its own origin, all about the solid
    camera      all rays start at one eye, pixel by pixel
    pipe        scattered, at a cylinder with a hole along its axis

Two questions: the `first` hit, and `all` of them, each as the t where the ray meets the surface. A
ray that starts inside has no first hit that all agree on, and is left out.

Each library is asked through the fastest interface that it has for the public. The solid, and the
rays in the form that a library takes, are made before the clock starts: objects of its own, arrays
of its precision. What it hands out is read after the clock stops; only where it hands out points in
place of t, the t are part of what is timed. Every answer is held against the exact one, so that a
fast answer that is wrong is seen to be.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np

from raycert.cases.model import Cylinder, Difference, Solid
from raycert.cases.scene import Camera, Scene, frame, pixel_ray
from raycert.cases.vectors import along, minus, plus, times
from raycert.oracle.batch.blocks import Batch, trace_batch
from raycert.oracle.batch.lanes import Floats
from raycert.oracle.measure.arrays import basis, rows
from raycert.oracle.measure.rays import arrays
from raycert.oracle.measure.way import Case

CASTS = ("scattered", "camera", "pipe")
QUESTIONS = ("first", "all")
DISTANCE, ANGLE = 9.0, 24.0
"""Of the camera: from the middle of the cylinder, and degrees across the picture's height."""
FACETS = 256
"""Facets around a meshed cylinder, its vertices on the cylinder."""


class RayHits(NamedTuple):
    """The hits of all rays: the number of the ray, and the t."""

    ray: Any
    t: Any


@dataclass(frozen=True)
class Cast:
    """Rays at a cylinder, with a hole if `inner` is there; `scene` where a camera sends them."""

    name: str
    outer: Cylinder
    inner: Cylinder | None
    origins: Floats
    directions: Floats
    scene: Scene | None
    truth: Batch | None = None

    @property
    def solid(self) -> Solid:
        return self.outer if self.inner is None else Difference((self.outer, self.inner))

    def exact(self, question: str) -> RayHits:
        assert self.truth is not None
        ray = np.repeat(np.arange(len(self.origins)), self.truth.counts)
        if question == "first":
            leading = np.diff(ray, prepend=-1) != 0
            return RayHits(ray[leading], self.truth.enter[leading])
        both = np.column_stack([self.truth.enter, self.truth.leave])
        return RayHits(np.repeat(ray, 2), both.ravel())


def cast(name: str, size: tuple[int, int], seed: int) -> Cast:
    """Return a cast of as many rays as a picture of a size has pixels, or a few fewer."""
    some = arrays("cylinder", "random", size[0] * size[1], seed)
    outer = some.solid
    assert isinstance(outer, Cylinder)
    origins, directions, scene, inner = some.origins, some.directions, None, None
    if name == "camera":
        at = times(0.5, plus(outer.p, outer.q))
        eye = along(at, DISTANCE, (0.5, -0.75, 0.25))
        seen_from = Camera("perspective", eye, at, (0.0, 0.0, 1.0), ANGLE)
        scene = Scene((("cylinder", outer),), seen_from, size)
        origins, directions = _pixels(scene)
    elif name == "pipe":
        beyond = times(0.25, minus(outer.q, outer.p))
        inner = Cylinder(minus(outer.p, beyond), plus(outer.q, beyond), outer.radius / 2)
    return _from_outside(Cast(name, outer, inner, origins, directions, scene))


def _pixels(scene: Scene) -> tuple[Floats, Floats]:
    seen_from, (width, height) = frame(scene.camera), scene.size
    pixels = ((i, j) for j in range(height) for i in range(width))
    [(_, solid)] = scene.solids
    return rows([Case(solid, pixel_ray(seen_from, scene.size, *pixel)) for pixel in pixels])


def _from_outside(some: Cast) -> Cast:
    lists = trace_batch(some.solid, some.origins, some.directions, engine="numpy")
    inside = lists.enter[lists.offsets[:-1].clip(max=max(len(lists.enter) - 1, 0))] == 0
    keep = ~(inside & (lists.counts > 0))
    if keep.all():
        return replace(some, truth=lists)
    outside = replace(some, origins=some.origins[keep], directions=some.directions[keep])
    return _from_outside(outside)


@dataclass(frozen=True, slots=True)
class Call:
    """What is called; `run` is timed, and `read` turns what it returns into hits.

    `facets` is how many a mesh has around; None where there is no mesh.
    """

    interface: str
    run: Callable[[], Any]
    read: Callable[[Any], RayHits]
    facets: int | None = None


@dataclass(frozen=True, slots=True)
class Caster:
    """A library: the packages that it needs, and the way to ask it, None where it has none."""

    name: str
    needs: tuple[str, ...]
    way: Callable[[Cast, str], Call | None]


def _reference(cast: Cast, question: str) -> Call:
    if cast.scene is not None:
        return _planned(cast, cast.scene, question)
    intersect = import_module("raycert.reference.arrays.tracer").intersect
    solid, u, v = cast.solid, cast.origins, cast.directions
    read = _first_of_padded if question == "first" else _all_of_padded
    return Call("intersect", lambda: intersect(solid, u, v), read)


def _planned(cast: Cast, scene: Scene, question: str) -> Call:
    plan = import_module("raycert.reference.arrays.plan").plan
    see = import_module("raycert.reference.arrays.picture")
    if question == "all":
        return Call("plan, lists", lambda: see.lists(plan(scene, "lists")), _all_of_padded)

    def read(picture: Any) -> RayHits:
        t = picture.values.ravel() / np.linalg.norm(cast.directions, axis=1)
        return _where(t, ~np.isnan(t))

    return Call("plan, picture", lambda: see.picture(plan(scene, "depth"), "depth"), read)


def _first_of_padded(found: Any) -> RayHits:
    if not found.enter.shape[1]:
        return RayHits(found.count[:0], found.enter.ravel())
    return _where(found.enter[:, 0], found.count > 0)


def _all_of_padded(found: Any) -> RayHits:
    ray, column = np.nonzero(np.arange(found.enter.shape[1]) < found.count[:, None])
    t = np.column_stack([found.enter[ray, column], found.leave[ray, column]])
    return RayHits(np.repeat(ray, 2), t.ravel())


def _where(t: Any, hit: Any) -> RayHits:
    """Return the hits of an array that has one t for each ray, where `hit` says so."""
    ray = np.flatnonzero(hit)
    return RayHits(ray, t[ray])


def _oracle(cast: Cast, question: str) -> Call:
    solid, u, v = cast.solid, cast.origins, cast.directions
    return Call(
        "trace_batch",
        lambda: trace_batch(solid, u, v),
        lambda found: replace(cast, truth=found).exact(question),
    )


def _raysect(cast: Cast, question: str) -> Call:
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

    name, run = ("hit", first) if question == "first" else ("next_intersection", every)
    return Call(name, run, _of_lists)


def _of_raysect(solid: Cylinder) -> Any:
    """Return a cylinder of raysect: along z from its origin, turned and moved to where it is."""
    p, q = np.array(solid.p), np.array(solid.q)
    matrix = [*np.column_stack([*basis(q - p), p]).tolist(), [0.0, 0.0, 0.0, 1.0]]
    place = import_module("raysect.core").AffineMatrix3D(matrix)
    made = import_module("raysect.primitive").Cylinder
    return made(solid.radius, float(np.linalg.norm(q - p)), transform=place)


def _of_lists(found: list[list[float]]) -> RayHits:
    ray = np.repeat(np.arange(len(found)), [len(one) for one in found])
    return RayHits(ray, np.array([t for one in found for t in one], float))


def _mujoco(cast: Cast, question: str) -> Call | None:
    if question != "first" or cast.inner is not None:
        return None
    mujoco = import_module("mujoco")
    ends = " ".join(map(repr, (*cast.outer.p, *cast.outer.q)))
    geom = f'<geom type="cylinder" fromto="{ends}" size="{cast.outer.radius!r}"/>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{geom}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)

    def read(t: Any) -> RayHits:
        return _where(np.asarray(t), np.asarray(t) >= 0)

    if cast.scene is None:
        place = data.geom_xpos[0].copy(), data.geom_xmat[0].copy(), model.geom_size[0].copy()
        kind, ray = int(model.geom_type[0]), mujoco.mju_rayGeom
        pairs = list(zip(cast.origins, cast.directions, strict=True))
        return Call("mju_rayGeom", lambda: [ray(*place, u, v, kind) for u, v in pairs], read)
    count, eye, ways = len(cast.origins), cast.origins[0].copy(), cast.directions.ravel()
    which, t = np.zeros(count, np.int32), np.zeros(count)

    def many() -> Any:
        mujoco.mj_multiRay(model, data, eye, ways, None, 1, -1, which, t, None, count, 1e10)
        return t

    return Call("mj_multiRay", many, read)


def _mesh(cast: Cast) -> Any:
    """Return the cylinder, or the pipe, with `FACETS` facets around."""
    creation = import_module("trimesh.creation")
    outer, inner = cast.outer, cast.inner
    segment = [outer.p, outer.q]
    if inner is None:
        return creation.cylinder(outer.radius, sections=FACETS, segment=segment)
    return creation.annulus(inner.radius, outer.radius, sections=FACETS, segment=segment)


def _trimesh(cast: Cast, question: str) -> Call:
    caster = import_module("trimesh.ray.ray_pyembree").RayMeshIntersector(_mesh(cast))
    u, v, every = cast.origins, cast.directions, question == "all"

    def run() -> RayHits:
        points, ray, _ = caster.intersects_location(u, v, multiple_hits=every)
        way = v[ray]
        along = np.einsum("ij,ij->i", points - u[ray], way)
        return RayHits(ray, along / np.einsum("ij,ij->i", way, way))

    return Call("intersects_location", run, lambda hits: hits, FACETS)


def _embreex(cast: Cast, question: str) -> Call | None:
    if question != "first":
        return None
    mesh, scene = _mesh(cast), import_module("embreex.rtcore_scene").EmbreeScene()
    triangles = import_module("embreex.mesh_construction").TriangleMesh
    triangles(scene, mesh.vertices.astype(np.float32), mesh.faces.astype(np.int32))
    u, v = cast.origins.astype(np.float32), cast.directions.astype(np.float32)
    return Call(
        "EmbreeScene.run",
        lambda: scene.run(u, v, output=1),
        lambda found: _where(found["tfar"].astype(float), found["primID"] >= 0),
        FACETS,
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


def check(found: RayHits, truth: RayHits, rays: int) -> tuple[float, float | None]:
    """Return the share of the rays that are wrong, and the largest relative error of the rest."""
    counts = [np.bincount(hits.ray, minlength=rays) for hits in (found, truth)]
    right = counts[0] == counts[1]
    right[found.ray[~np.isfinite(found.t)]] = False
    one, two = (_sorted(hits, right) for hits in (found, truth))
    wrong = 1 - float(right.mean())
    return wrong, float(np.max(abs(one - two) / two)) if two.size else None


def _sorted(hits: RayHits, keep: Any) -> Any:
    kept = keep[hits.ray]
    ray, t = hits.ray[kept], hits.t[kept]
    return t[np.lexsort((t, ray))]
