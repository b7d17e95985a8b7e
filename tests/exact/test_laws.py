"""Laws of the leaves and of their lists, exactly; those of trees are in `test_laws_trees`.

Scenes are drawn from a small grid, so that tangents, rims, rays in faces, starts on surfaces and
zero directions occur all the time. No tolerance anywhere.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations

from hypothesis import given, settings
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
    Tree,
    Union,
    Vector,
)
from raycert.oracle.exact.intervals import EVERYTHING, contains, intersect, subtract, union
from raycert.oracle.exact.trace import trace

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


SWAPPED = {"AE": "AE", "BE": "AF", "AF": "BE", "AH": "DE", "DE": "AH", "BG": "CF", "CF": "BG"}


def swapped(solid: Solid) -> Solid:
    """Return the solid with p and q of every leaf exchanged."""
    if isinstance(solid, Tree):
        return replace(solid, of=tuple(swapped(part) for part in solid.of))
    return solid if isinstance(solid, HalfSpace | Sphere) else replace(solid, p=solid.q, q=solid.p)


@given(solids, rays)
def test_the_ends_of_an_axis_may_be_exchanged(solid: Solid, ray: Ray) -> None:
    one, two = trace(solid, ray), trace(swapped(solid), ray)
    assert one.intervals == two.intervals
    for a, b in zip(one.decisions, two.decisions, strict=True):
        assert b.row.name == SWAPPED.get(a.row.name, a.row.name)


@given(rays, axes, radii)
def test_a_cylinder_is_what_its_faces_have_in_common(
    ray: Ray, axis: tuple[Vector, Vector], radius: float
) -> None:
    p, q = axis
    w = combine(q, p, -1)
    tube, slab = InfiniteCylinder(p, q, radius), Slab(p, q)
    halves = (HalfSpace(p, times(-1, w)), HalfSpace(q, w))
    lists = [trace(solid, ray).intervals for solid in (tube, slab, *halves)]
    assert lists[1] == intersect(lists[2], lists[3])
    assert trace(Cylinder(p, q, radius), ray).intervals == intersect(lists[0], lists[1])


@given(rays, axes, radii, radii)
def test_a_wider_solid_contains_a_narrower_one(
    ray: Ray, axis: tuple[Vector, Vector], one: float, two: float
) -> None:
    thin, wide = sorted((one, two))
    for make in (
        lambda r: InfiniteCylinder(*axis, r),
        lambda r: Cylinder(*axis, r),
        lambda r: Sphere(axis[0], r),
    ):
        assert contains(trace(make(wide), ray).intervals, trace(make(thin), ray).intervals)


@given(rays, axes, st.integers(-3, 3).filter(bool), st.integers(-3, 3), radii)
def test_where_on_the_line_p_and_q_lie_does_not_matter(
    ray: Ray, axis: tuple[Vector, Vector], stretch: int, slide: int, radius: float
) -> None:
    p, q = axis
    w = combine(q, p, -1)
    base = combine(p, w, slide)
    other = InfiniteCylinder(base, combine(base, w, stretch), radius)
    assert trace(other, ray).intervals == trace(InfiniteCylinder(p, q, radius), ray).intervals


@settings(max_examples=60)
@given(st.lists(leaves, min_size=2, max_size=3), rays)
def test_booleans_are_the_algebra_of_their_parts(parts: list[Solid], ray: Ray) -> None:
    lists = [trace(part, ray).intervals for part in parts]
    for order in permutations(range(len(parts))):
        some = tuple(parts[i] for i in order)
        assert trace(Union(some), ray).intervals == union(lists)
        common = EVERYTHING
        for each in lists:
            common = intersect(common, each)
        assert trace(Intersection(some), ray).intervals == common
        rest = lists[order[0]]
        for i in order[1:]:
            rest = subtract(rest, lists[i])
        once = trace(Difference(some), ray).intervals
        assert once == rest == subtract(lists[order[0]], union(lists[i] for i in order[1:]))
