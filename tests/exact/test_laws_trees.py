"""Laws of Booleans over random trees, exactly: no tolerance, and each law can fail.

A list is a closed set of t >= 0. Union and intersection are those of sets. A difference is closed
again, A - B = cl(A \\ B), and therefore

    A - (B u C) = (A - B) - C = (A - C) - B         exactly
    A - (B n C) = (A - B) u (A - C)                 exactly
    (A u B) - C = (A - C) u (B - C)                 exactly
    A - (B u C) = ((A - B) n (A - C)) - (B u C)     exactly; without the last term the right side
                                                    may hold single points more: where cl(A \\ B)
                                                    and cl(A \\ C) end upon each other
    (A n B) - C = ((A - C) n (B - C)) - C           likewise, and likewise only up to single points
                = ((A - C) n B) - C                 without the last term
    (A - B) u B = A u B,  A = (A - B) u (A n B)     exactly
    (A - B) n B                                     is a list of single points
    A - (A - B)                                     is A n B less single points of it
    E - (E - A), with E everything                  is A without its single points
    A - (B - C), (A - B) u (A n C)                  the left lies in the right; the right may hold
                                                    single points more

Both sides are asked of the oracle as trees. A leaf is cut off at t = 0 before anything else, so
from another start, or from the other end, a tree with a difference may hold or lack a single
point at the cut; everything else is the same.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from functools import cache
from itertools import cycle, islice, permutations

import pytest

from raycert.cases.dice import Dice
from raycert.cases.draw import sampled
from raycert.cases.formats import BINARY32, BINARY64, Format
from raycert.cases.model import (
    Difference,
    HalfSpace,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
    Vector,
)
from raycert.cases.recipes import LEAVES, TREES
from raycert.cases.vectors import cross
from raycert.oracle.exact.grid import Grid, IntVector
from raycert.oracle.exact.intervals import (
    Intervals,
    contains,
    intersect,
    intersection,
    merge,
    subtract,
    union,
)
from raycert.oracle.exact.leaf import Plane, half_space
from raycert.oracle.exact.surd import INFINITY, ZERO, Surd, fraction
from raycert.oracle.exact.trace import trace

SEED = 11
ENOUGH = 120
"""So many scenes for a law."""

EVERYWHERE = Union((HalfSpace((0, 0, 0), (0, 0, 1)), HalfSpace((0, 0, 0), (0, 0, -1))))


def any_of(*parts: Solid) -> Solid:
    return Union(parts)


def all_of(*parts: Solid) -> Solid:
    return Intersection(parts)


def less(*parts: Solid) -> Solid:
    return Difference(parts)


@dataclass(frozen=True)
class Ask:
    """The lists of solids along one ray."""

    ray: Ray

    def __call__(self, solid: Solid) -> Intervals:
        return trace(solid, self.ray).intervals

    def same(self, *solids: Solid) -> None:
        first, *others = map(self, solids)
        assert all(other == first for other in others)

    def within(self, inner: Solid, outer: Solid) -> None:
        assert contains(self(outer), self(inner))

    def same_but_for_points(self, less: Solid, more: Solid) -> None:
        """The first list is the second without some of its single points."""
        self.within(less, more)
        assert regular(self(less)) == regular(self(more))


def regular(intervals: Intervals) -> Intervals:
    """Return a list without its single points."""
    return tuple((a, b) for a, b in intervals if a < b)


# Laws of three solids and a ray


def commutation(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(any_of(a, b), any_of(b, a))
    ask.same(all_of(a, b), all_of(b, a))
    ask.same(any_of(a, b, c), any_of(c, a, b), any_of(b, c, a))
    ask.same(all_of(a, b, c), all_of(c, a, b), all_of(b, c, a))


def association(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(any_of(a, b, c), any_of(any_of(a, b), c), any_of(a, any_of(b, c)))
    ask.same(all_of(a, b, c), all_of(all_of(a, b), c), all_of(a, all_of(b, c)))


def absorption(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(a, any_of(a, all_of(a, b)), all_of(a, any_of(a, b)))
    ask.same(a, any_of(a, less(a, b)))


def idempotence(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(a, any_of(a), all_of(a), less(a), any_of(a, a), all_of(a, a))
    ask.same(less(a, b), less(less(a, b), b), less(a, b, b))


def distribution(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(all_of(a, any_of(b, c)), any_of(all_of(a, b), all_of(a, c)))
    ask.same(any_of(a, all_of(b, c)), all_of(any_of(a, b), any_of(a, c)))


def nothing_is_left(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    assert ask(less(a, a)) == ask(less(a, b, a)) == ask(less(a, any_of(b, a))) == ()
    assert ask(less(all_of(a, b), a)) == ask(less(less(a, b), a)) == ()


def only_what_is_common_is_taken(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(less(a, b), less(a, all_of(a, b)), less(any_of(a, b), b))


def taking_away_a_union(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    both = any_of(b, c)
    ask.same(less(a, both), less(a, b, c), less(less(a, b), c), less(less(a, c), b))
    ask.same(less(a, both), less(all_of(less(a, b), less(a, c)), both))
    ask.same_but_for_points(less(a, both), all_of(less(a, b), less(a, c)))


def taking_away_an_intersection(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(less(a, all_of(b, c)), any_of(less(a, b), less(a, c)))


def taking_away_a_difference(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same_but_for_points(less(a, less(b, c)), any_of(less(a, b), all_of(a, c)))
    ask.same_but_for_points(less(a, less(a, b)), all_of(a, b))


def taking_away_from_a_union(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(less(any_of(a, b), c), any_of(less(a, c), less(b, c)))


def taking_away_from_an_intersection(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    rest = less(all_of(a, b), c)
    ask.same(rest, less(all_of(less(a, c), less(b, c)), c), less(all_of(less(a, c), b), c))
    ask.same_but_for_points(rest, all_of(less(a, c), less(b, c)))
    ask.same_but_for_points(rest, all_of(less(a, c), b))


def parts_make_the_whole(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    ask.same(any_of(less(a, b), b), any_of(a, b))
    ask.same(any_of(less(a, b), all_of(a, b)), a)
    assert regular(ask(all_of(less(a, b), b))) == ()
    ask.same(any_of(less(a, b), less(b, a)), less(any_of(a, b), all_of(a, b)))


def complements(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    """De Morgan's own form, with everything for the first part."""
    no_a, no_b = less(EVERYWHERE, a), less(EVERYWHERE, b)
    assert ask(EVERYWHERE) == ((ZERO, INFINITY),)
    assert ask(less(EVERYWHERE, no_a)) == regular(ask(a))
    ask.same(less(EVERYWHERE, all_of(a, b)), any_of(no_a, no_b))
    ask.same_but_for_points(less(EVERYWHERE, any_of(a, b)), all_of(no_a, no_b))
    ask.same(any_of(a, no_a), EVERYWHERE)


def monotony(ask: Ask, a: Solid, b: Solid, c: Solid) -> None:
    more = any_of(a, b)
    ask.within(a, more)
    ask.within(all_of(a, b), a)
    ask.within(less(a, b), a)
    ask.within(all_of(a, c), all_of(more, c))
    ask.within(less(a, c), less(more, c))
    ask.within(less(c, more), less(c, a))


Law = Callable[[Ask, Solid, Solid, Solid], None]
LAWS: tuple[Law, ...] = (
    commutation,
    association,
    absorption,
    idempotence,
    distribution,
    nothing_is_left,
    only_what_is_common_is_taken,
    taking_away_a_union,
    taking_away_an_intersection,
    taking_away_a_difference,
    taking_away_from_a_union,
    taking_away_from_an_intersection,
    parts_make_the_whole,
    complements,
    monotony,
)


@cache
def scene(number: int, fmt: Format = BINARY64) -> tuple[Solid, Ray]:
    """Return a drawn scene: the same on every machine."""
    case = sampled(number, SEED, fmt)
    return case.solid, case.ray


def three_parts(number: int) -> tuple[Ask, Solid, Solid, Solid]:
    """Return three solids that share points, axes and radii, and a ray: the parts of a Boolean."""
    leaves, trees = len(LEAVES), len(TREES)
    solid, ray = scene(number // trees * (leaves + trees) + leaves + number % trees)
    assert isinstance(solid, Tree)
    a, b, c = islice(cycle(solid.of), 3)
    return Ask(ray), a, b, c


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_law(law: Law) -> None:
    for number in range(ENOUGH):
        law(*three_parts(number))


# What does not hold: the point by which it fails


def along_x(*ends: float) -> Solid:
    return Slab((ends[0], 0, 0), (ends[1], 0, 0))


POINT = Sphere((2, 0, 0), 0)
ALONG_X = Ask(Ray((0, 0, 0), (1, 0, 0)))
TWO = ((fraction(2, 1), fraction(2, 1)),)


def test_differences_may_touch_where_the_difference_has_nothing() -> None:
    a, b, c = along_x(0, 4), along_x(0, 2), along_x(2, 4)
    assert ALONG_X(less(a, b, c)) == ()
    assert ALONG_X(all_of(less(a, b), less(a, c))) == TWO


def test_the_common_part_of_two_closures_may_lie_in_what_was_taken() -> None:
    a, b = along_x(0, 2), along_x(2, 4)
    assert ALONG_X(less(all_of(a, b), POINT)) == ()
    assert ALONG_X(all_of(less(a, POINT), less(b, POINT))) == TWO
    assert ALONG_X(all_of(less(a, POINT), b)) == TWO


def test_a_point_taken_away_is_closed_again() -> None:
    a = along_x(0, 5)
    assert ALONG_X(less(a, less(a, POINT))) == ()
    assert ALONG_X(all_of(a, POINT)) == TWO
    assert ALONG_X(any_of(less(a, a), all_of(a, POINT))) == TWO


# Laws of motion: what is done to a scene, and what becomes of its list


class Inexact(Exception):
    """A sum that binary64 cannot hold: such a scene is left out."""


def plus(a: Vector, b: Vector, t: float = 1.0) -> Vector:
    """Return a + t b, exactly."""
    found = [x + t * y for x, y in zip(a, b, strict=True)]
    truth = [Fraction(x) + Fraction(t) * Fraction(y) for x, y in zip(a, b, strict=True)]
    if found != truth:
        raise Inexact
    return (found[0], found[1], found[2])


def times(k: float, a: Vector) -> Vector:
    return (k * a[0], k * a[1], k * a[2])


def moved(
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
            new["of"] = tuple(moved(part, point, vector, length) for part in value)
        elif field.name == "radius":
            new["radius"] = length(value)
        else:
            new[field.name] = (vector if field.name == "normal" else point)(value)
    return replace(solid, **new)


def linear(t: Surd, by: Fraction, factor: Fraction = Fraction(1)) -> Surd:
    """Return factor t + by, factor != 0; infinity stays."""
    if not t.finite:
        return t
    m, n = factor.as_integer_ratio()
    a, b = by.as_integer_ratio()
    return Surd(m * t.x * b + a * t.z * n, m * t.y * b, t.d, t.z * n * b)


def exact(x: Fraction | float) -> Surd:
    return fraction(*x.as_integer_ratio())


def between(intervals: Intervals, low: Surd, high: Surd, points: bool) -> Intervals:
    """Return what lies in [low, high]; without `points`, no single points at either."""
    found = intersect(intervals, ((low, high),))
    return tuple((a, b) for a, b in found if points or a < b or a not in (low, high))


def has_difference(solid: Solid) -> bool:
    return isinstance(solid, Tree) and (
        isinstance(solid, Difference) or any(map(has_difference, solid.of))
    )


def power(dice: Dice) -> float:
    return 2.0 ** dice.integer(-60, 60)


def translation(solid: Solid, ray: Ray, dice: Dice) -> None:
    i, j, k = (dice.integer(-48, 48) for _ in range(3))
    by = (i / 8, j / 8, k / 8)
    there = moved(solid, lambda a: plus(a, by), lambda n: n)
    assert trace(there, Ray(plus(ray.origin, by), ray.direction)) == trace(solid, ray)


def turning(solid: Solid, ray: Ray, dice: Dice) -> None:
    """Axes may be exchanged and mirrored, also into a left-handed frame."""
    i, j, k = list(permutations(range(3)))[dice.integer(0, 5)]
    a, b, c = (float(dice.integer(0, 1) * 2 - 1) for _ in range(3))

    def turn(v: Vector) -> Vector:
        return (a * v[i], b * v[j], c * v[k])

    turned = Ray(turn(ray.origin), turn(ray.direction))
    assert trace(moved(solid, turn, turn), turned) == trace(solid, ray)


def scaling(solid: Solid, ray: Ray, dice: Dice) -> None:
    k = power(dice)

    def scale(a: Vector) -> Vector:
        return times(k, a)

    big = moved(solid, scale, scale, lambda r: k * r)
    assert trace(big, Ray(scale(ray.origin), scale(ray.direction))) == trace(solid, ray)


def speed(solid: Solid, ray: Ray, dice: Dice) -> None:
    """A direction 2^k times as long divides every t by 2^k, and changes no decision."""
    k = power(dice)
    fast, slow = trace(solid, Ray(ray.origin, times(k, ray.direction))), trace(solid, ray)
    none, factor = Fraction(0), 1 / Fraction(k)
    assert fast.decisions == slow.decisions
    assert fast.intervals == tuple(
        (linear(a, none, factor), linear(b, none, factor)) for a, b in slow.intervals
    )


def reversal(solid: Solid, ray: Ray, dice: Dice) -> None:
    """From f(T) back along -v, t becomes T - t: on [0, T], but for single points at its ends.

    A tree without a difference keeps those too.
    """
    far = dice.integer(1, 64) / 8
    back = Ray(plus(ray.origin, ray.direction, far), times(-1, ray.direction))
    points = not has_difference(solid)
    there, turned = (
        between(trace(solid, one).intervals, ZERO, exact(far), points) for one in (ray, back)
    )
    by, minus = Fraction(far), Fraction(-1)
    assert there == tuple((linear(b, by, minus), linear(a, by, minus)) for a, b in turned[::-1])


def a_later_start(solid: Solid, ray: Ray, dice: Dice) -> None:
    """From f(s) the list is that of t >= s, less s: but for a single point at the start."""
    step = dice.integer(0, 64) / 8
    later = Ray(plus(ray.origin, ray.direction, step), ray.direction)
    points = not has_difference(solid)
    old = between(trace(solid, ray).intervals, exact(step), INFINITY, points)
    new = between(trace(solid, later).intervals, ZERO, INFINITY, points)
    by = Fraction(-step)
    assert new == tuple((linear(a, by), linear(b, by)) for a, b in old)


def standing_still(solid: Solid, ray: Ray, dice: Dice) -> None:
    """Along the zero direction everything is decided at one point: there sets need no closure."""
    still = Ask(Ray(ray.origin, (0.0, -0.0, 0.0)))
    whole = ((ZERO, INFINITY),)

    def inside(part: Solid) -> bool:
        match part:
            case Union(of):
                return any(map(inside, of))
            case Intersection(of):
                return all(map(inside, of))
            case Difference(of):
                return inside(of[0]) and not any(map(inside, of[1:]))
        starts = trace(part, ray).intervals
        return bool(starts) and starts[0][0] == ZERO

    assert still(solid) == (whole if inside(solid) else ())


Motion = Callable[[Solid, Ray, Dice], None]
MOTIONS: tuple[Motion, ...] = (
    translation,
    turning,
    scaling,
    speed,
    reversal,
    a_later_start,
    standing_still,
)


def moves(motion: Motion, number: int) -> bool:
    """Check a motion of a drawn scene; return whether binary64 can hold it.

    Scenes are drawn in binary32, so that mostly it has the room.
    """
    try:
        motion(*scene(number, BINARY32), Dice(f"motion {number}"))
    except Inexact:
        return False
    return True


@pytest.mark.parametrize("motion", MOTIONS, ids=lambda motion: motion.__name__)
def test_motion(motion: Motion) -> None:
    assert sum(moves(motion, number) for number in range(ENOUGH)) > ENOUGH // 2


def test_a_start_on_a_boundary_may_lack_or_have_a_point_that_the_line_has() -> None:
    """[-1, 0] - [0, 1] along the line has 0; from 0 on, {0} - [0, 1] has nothing. And reversed."""
    before, after = along_x(-1, 0), along_x(0, 1)
    earlier = Ask(Ray((-9, 0, 0), (1, 0, 0)))
    lacks = less(before, after)
    assert earlier(lacks) == ((fraction(8, 1), fraction(9, 1)),)
    assert ALONG_X(lacks) == ()
    has = less(before, less(before, after))
    assert earlier(has) == ()
    assert ALONG_X(has) == ((ZERO, ZERO),)


# Planted faults: a wrong algebra, or a wrong leaf, and the law that it breaks


def union_that_does_not_merge(lists: list[Intervals]) -> Intervals:
    return tuple(sorted(interval for intervals in lists for interval in intervals))


def union_that_forgets_points(lists: list[Intervals]) -> Intervals:
    return regular(union(lists))


def union_of_the_first_two(lists: list[Intervals]) -> Intervals:
    return union(lists[:2])


def union_that_closes_small_gaps(lists: list[Intervals]) -> Intervals:
    """Joins what is less than 1/16 apart, whatever the scale."""
    joined: list[tuple[Surd, Surd]] = []
    for enter, leave in union(lists):
        near = joined and enter <= linear(joined[-1][1], Fraction(1, 16))
        joined[-1:] = [(joined[-1][0], leave)] if near else [*joined[-1:], (enter, leave)]
    return tuple(joined)


def intersection_that_advances_the_first(lists: list[Intervals]) -> Intervals:
    """The fault of a published tracer: the second piece of a hollow solid vanishes."""
    found = lists[0]
    for other in lists[1:]:
        common, i, j = [], 0, 0
        while i < len(found) and j < len(other):
            enter, leave = max(found[i][0], other[j][0]), min(found[i][1], other[j][1])
            if enter <= leave:
                common.append((enter, leave))
                i += 1
            elif found[i][1] < other[j][1]:
                i += 1
            else:
                j += 1
        found = tuple(common)
    return found


def intersection_without_touches(lists: list[Intervals]) -> Intervals:
    return regular(intersection(lists))


def subtract_without_the_second_piece(one: Intervals, two: Intervals) -> Intervals:
    return merge(piece for interval in one for piece in subtract((interval,), two)[:1])


def subtract_that_is_not_closed(one: Intervals, two: Intervals) -> Intervals:
    """Splits at a single point that is taken away."""
    rest = list(one)
    for a, b in two:
        rest = [
            piece
            for enter, leave in rest
            for piece in (
                ((enter, a), (a, leave)) if a == b and enter < a < leave else ((enter, leave),)
            )
        ]
    return tuple(piece for part in rest for piece in subtract((part,), two))


def subtract_that_keeps_points(one: Intervals, two: Intervals) -> Intervals:
    """Keeps the boundary where nothing is left: [2, 2] - [0, 5] = [2, 2]."""
    return merge((*subtract(one, two), *((a, b) for a, b in one if a == b)))


def subtract_the_wrong_way(one: Intervals, two: Intervals) -> Intervals:
    return subtract(two, one)


def subtract_only_the_first(one: Intervals, two: Intervals) -> Intervals:
    return subtract(one, two[:1])


Fault = Callable[..., object]
FAULTS: tuple[tuple[str, Fault, tuple[Law, ...]], ...] = (
    ("union", union_that_does_not_merge, (commutation, idempotence)),
    ("union", union_that_forgets_points, (absorption,)),
    ("union", union_of_the_first_two, (association,)),
    ("union", union_that_closes_small_gaps, (complements,)),
    ("intersection", intersection_that_advances_the_first, (complements, distribution)),
    ("intersection", intersection_without_touches, (absorption, taking_away_an_intersection)),
    (
        "subtract",
        subtract_without_the_second_piece,
        (taking_away_a_difference, taking_away_from_a_union, parts_make_the_whole),
    ),
    ("subtract", subtract_that_is_not_closed, (complements,)),
    ("subtract", subtract_that_keeps_points, (nothing_is_left, taking_away_from_an_intersection)),
    ("subtract", subtract_the_wrong_way, (only_what_is_common_is_taken, monotony)),
    ("subtract", subtract_only_the_first, (taking_away_a_union,)),
)


def radius_longer_by_1(grid: Grid, x: float) -> int:
    """A length that is added whatever the scale."""
    return grid.integers[x] + (1 << grid.length)


def points_taken_for_vectors(a: IntVector, b: IntVector) -> IntVector:
    """Every face lies at the origin."""
    return a


def cross_with_a_wrong_sign(a: IntVector, b: IntVector) -> IntVector:
    x, _, z = cross(a, b)
    return (x, a[2] * b[0] + a[0] * b[2], z)


def half_space_always_left(solid: HalfSpace, grid: Grid) -> Plane:
    """The ray leaves a half-space, whichever way it goes."""
    plane = half_space(solid, grid)
    return plane._replace(b=abs(plane.b))


FAULTS_OF_LEAVES: tuple[tuple[str, Fault, tuple[Motion, ...]], ...] = (
    ("raycert.oracle.exact.leaf.minus", points_taken_for_vectors, (translation,)),
    ("raycert.oracle.exact.leaf.cross", cross_with_a_wrong_sign, (turning,)),
    ("raycert.oracle.exact.grid.Grid.scalar", radius_longer_by_1, (scaling,)),
    ("raycert.oracle.exact.trace.half_space", half_space_always_left, (reversal, a_later_start)),
    ("raycert.oracle.exact.trace.union", union_that_closes_small_gaps, (speed,)),
    ("raycert.oracle.exact.trace.subtract", subtract_the_wrong_way, (standing_still,)),
)
SEARCH = 2_000
"""So many drawn scenes are searched for one that a fault breaks: the same on every machine."""


def broken(check: Callable[[int], object]) -> bool:
    """Whether a check fails on one of the drawn scenes."""
    for number in range(SEARCH):
        try:
            check(number)
        except AssertionError:
            return True
    return False


@pytest.mark.parametrize(
    ("name", "fault", "law"),
    [(name, fault, law) for name, fault, laws in FAULTS for law in laws],
    ids=lambda value: getattr(value, "__name__", value),
)
def test_a_wrong_algebra_breaks_the_law(
    name: str, fault: Fault, law: Law, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"raycert.oracle.exact.trace.{name}", fault)
    assert broken(lambda number: law(*three_parts(number)))


@pytest.mark.parametrize(
    ("target", "fault", "motion"),
    [(target, fault, law) for target, fault, laws in FAULTS_OF_LEAVES for law in laws],
    ids=lambda value: getattr(value, "__name__", value),
)
def test_a_wrong_leaf_or_algebra_breaks_the_motion(
    target: str, fault: Fault, motion: Motion, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(target, fault)
    assert broken(lambda number: moves(motion, number))


def test_every_law_is_broken_by_a_fault() -> None:
    assert {law for _, _, laws in FAULTS for law in laws} == set(LAWS)
    assert {law for _, _, laws in FAULTS_OF_LEAVES for law in laws} == set(MOTIONS)
