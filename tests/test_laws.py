"""Laws of the oracle: what moving, turning and scaling a scene does to its answer, exactly.

Scenes are drawn from a small grid, so that tangents, rims, rays in faces, starts on surfaces and
zero directions occur all the time. No tolerance anywhere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from fractions import Fraction
from itertools import permutations

from hypothesis import given, settings
from hypothesis import strategies as st

from cases.model import (
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
from oracle.intervals import EVERYTHING, Intervals, contains, intersect, subtract, union
from oracle.surd import INFINITY, ZERO, Surd, fraction
from oracle.trace import trace

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
LENGTHS = {"point", "center", "p", "q"}


def combine(a: Vector, b: Vector, t: float) -> Vector:
    """Return a + t b, exact for the small numbers here."""
    return (a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2])


def times(k: float, a: Vector) -> Vector:
    return (k * a[0], k * a[1], k * a[2])


def changed(
    solid: Solid,
    point: Callable[[Vector], Vector],
    vector: Callable[[Vector], Vector],
    length: Callable[[float], float] = lambda r: r,
) -> Solid:
    """Return a solid with its points, its normals and its radii mapped."""
    new: dict[str, object] = {}
    for field in fields(solid):
        value = getattr(solid, field.name)
        if field.name == "of":
            new["of"] = tuple(changed(part, point, vector, length) for part in value)
        elif field.name == "radius":
            new["radius"] = length(value)
        else:
            new[field.name] = (point if field.name in LENGTHS else vector)(value)
    return replace(solid, **new)


def shifted(t: Surd, by: Fraction, factor: Fraction = Fraction(1)) -> Surd:
    """Return factor t + by, factor != 0; infinity stays."""
    if not t.finite:
        return t
    m, n = factor.as_integer_ratio()
    a, b = by.as_integer_ratio()
    return Surd(m * t.x * b + a * t.z * n, m * t.y * b, t.d, t.z * n * b)


def within(intervals: Intervals, low: Fraction, high: Fraction | None) -> Intervals:
    """Return what lies between `low` and `high`, without single points at either."""
    ends = [INFINITY if x is None else fraction(*x.as_integer_ratio()) for x in (low, high)]
    window = ((ends[0], ends[1]),)
    return tuple((a, b) for a, b in intersect(intervals, window) if a < b or a not in ends)


@given(solids, rays, st.integers(1, 6))
def test_the_reversed_ray_sees_the_same(solid: Solid, ray: Ray, far: int) -> None:
    """From u + T v back along -v, t becomes T - t. A start alone is left out: see `within`."""
    back = Ray(combine(ray.origin, ray.direction, far), times(-1, ray.direction))
    there, turned = trace(solid, ray).intervals, trace(solid, back).intervals
    window = Fraction(0), Fraction(far)
    mirrored = tuple(
        (shifted(b, Fraction(far), Fraction(-1)), shifted(a, Fraction(far), Fraction(-1)))
        for a, b in reversed(within(turned, *window))
    )
    assert within(there, *window) == mirrored


@given(leaves, rays, st.integers(1, 6))
def test_of_a_leaf_the_reversed_ray_sees_single_points_too(leaf: Solid, ray: Ray, far: int) -> None:
    """A leaf is closed, so the list on [0, T] is the same set either way."""
    back = Ray(combine(ray.origin, ray.direction, far), times(-1, ray.direction))
    window = ((ZERO, fraction(far, 1)),)
    there = intersect(trace(leaf, ray).intervals, window)
    turned = intersect(trace(leaf, back).intervals, window)
    minus, by = Fraction(-1), Fraction(far)
    assert there == tuple((shifted(b, by, minus), shifted(a, by, minus)) for a, b in turned)


@given(solids, rays, st.integers(-24, 24).map(lambda n: n / 8))
def test_a_start_further_along_shifts_the_list(solid: Solid, ray: Ray, dt: float) -> None:
    moved = Ray(combine(ray.origin, ray.direction, dt), ray.direction)
    by = Fraction(dt)
    old, new = trace(solid, ray).intervals, trace(solid, moved).intervals
    low = max(Fraction(0), -by)
    later = tuple((shifted(a, -by), shifted(b, -by)) for a, b in within(old, low + by, None))
    assert within(new, low, None) == later


@given(solids, rays, st.integers(-60, 60))
def test_scaling_the_scene_changes_nothing(solid: Solid, ray: Ray, k: int) -> None:
    def scale(a: Vector) -> Vector:
        return times(2.0**k, a)

    big = changed(solid, scale, scale, lambda r: r * 2.0**k)
    assert trace(big, Ray(scale(ray.origin), scale(ray.direction))) == trace(solid, ray)


@given(solids, rays, st.integers(-60, 60))
def test_a_longer_direction_shortens_t(solid: Solid, ray: Ray, k: int) -> None:
    faster = trace(solid, Ray(ray.origin, times(2.0**k, ray.direction)))
    slow = trace(solid, ray)
    if any(ray.direction):
        factor = Fraction(1, 2) ** k if k >= 0 else Fraction(2) ** -k
        by = Fraction(0)
        assert faster.intervals == tuple(
            (shifted(a, by, factor), shifted(b, by, factor)) for a, b in slow.intervals
        )
    assert faster.decisions == slow.decisions


@given(solids, rays, points)
def test_moving_the_scene_changes_nothing(solid: Solid, ray: Ray, by: Vector) -> None:
    far = times(1 / 8, combine(by, (3.0, 5.0, 7.0), 2.0**20))

    def move(a: Vector) -> Vector:
        return combine(a, far, 1)

    moved = changed(solid, move, lambda n: n)
    assert trace(moved, Ray(move(ray.origin), ray.direction)) == trace(solid, ray)


@given(solids, rays, st.permutations(range(3)), st.tuples(*[st.sampled_from([1.0, -1.0])] * 3))
def test_axes_may_be_exchanged_and_mirrored(
    solid: Solid, ray: Ray, order: list[int], signs: Vector
) -> None:
    def turn(a: Vector) -> Vector:
        return (signs[0] * a[order[0]], signs[1] * a[order[1]], signs[2] * a[order[2]])

    turned = changed(solid, turn, turn)
    assert trace(turned, Ray(turn(ray.origin), turn(ray.direction))) == trace(solid, ray)


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
        assert contains(once, tuple((a, b) for a, b in rest if a < b))
        assert once == subtract(lists[order[0]], union(lists[i] for i in order[1:]))


@given(solids, rays)
def test_the_zero_direction_stays_where_it_is(solid: Solid, ray: Ray) -> None:
    still = trace(solid, Ray(ray.origin, (0.0, -0.0, 0.0))).intervals
    assert still in ((), EVERYTHING)
    if not isinstance(solid, Tree):
        starts = trace(solid, ray).intervals
        assert bool(still) == bool(starts and starts[0][0] == ZERO)
