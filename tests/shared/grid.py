"""Scenes on a small grid: tangents, rims, rays in faces, starts on surfaces all the time."""

from __future__ import annotations

from hypothesis import strategies as st

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    Vector,
)

whole = st.integers(-4, 4).map(float)
points = st.tuples(whole, whole, whole)
directions = st.tuples(*[st.integers(-2, 2).map(float)] * 3)
radii = st.sampled_from([0.0, 0.5, 1.0, 2.0, 3.0, 5.0])
axes = st.tuples(points, points).filter(lambda pq: pq[0] != pq[1])
normals = directions.filter(any)
aimed = st.builds(
    lambda target, v, n: Ray(combine(target, v, -n), v),
    st.tuples(*[st.integers(-1, 1).map(float)] * 3),
    directions,
    st.integers(-1, 4),
)
rays = st.one_of(st.builds(Ray, points, directions), aimed)
"""Half of them through the middle of the scenes, where most solids are."""
slabs = axes.map(lambda pq: Slab(*pq))
leaves = st.one_of(
    st.builds(HalfSpace, points, normals),
    st.builds(Sphere, points, radii),
    st.builds(lambda pq, r: InfiniteCylinder(*pq, r), axes, radii),
    slabs,
    st.builds(lambda pq, r: Cylinder(*pq, r), axes, radii),
    st.builds(lambda pq, r: Cylinder(*pq, r), axes, radii),
)


def _trees(parts: st.SearchStrategy[Solid]) -> st.SearchStrategy[Solid]:
    two = st.lists(parts, min_size=2, max_size=3).map(tuple)
    some = st.lists(parts, min_size=1, max_size=3).map(tuple)
    kinds = ((Union, some), (Intersection, some), (Difference, some), (Difference, two))
    return st.one_of(*(st.builds(kind, of) for kind, of in kinds))


trees = _trees(st.recursive(leaves, _trees, max_leaves=4))
blocks = st.sampled_from(
    [
        Sphere((0, 0, 0), 5),
        InfiniteCylinder((0, 0, 0), (1, 0, 0), 3),
        Slab((-3, 0, 0), (4, 0, 0)),
        HalfSpace((1, 0, 0), (1, 2, 2)),
        Cylinder((0, -4, 0), (0, 4, 0), 4),
    ]
)
carved = st.builds(
    lambda block, parts: Difference((block, *parts)),
    blocks,
    st.lists(leaves, min_size=1, max_size=3),
)
solids: st.SearchStrategy[Solid] = st.one_of(leaves, trees, carved)
"""Blocks are large, so that much is left when something is cut away."""


def combine(a: Vector, b: Vector, t: float) -> Vector:
    """Return a + t b, exact for the small numbers here."""
    return (a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2])


def times(k: float, a: Vector) -> Vector:
    return (k * a[0], k * a[1], k * a[2])
