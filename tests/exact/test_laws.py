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
from shared.grid import axes, combine, leaves, radii, rays, solids, times

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
