"""What an adapter answers that misreads a question, and which misreadings its answers are those of.

A misreading is a change of the question, of the leaves or of the ray, whose exact answer is then
given, or a change of the answer. It is named where it foretells every answer to the easy cases of a
type of solid, the right ones too: one that is right by chance would speak against it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, combinations
from typing import Any

from raycert.cases.model import (
    SHAPES,
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Point,
    Ray,
    Refused,
    Slab,
    Solid,
    Sphere,
    Vector,
    map_leaves,
)
from raycert.cases.protocol import FROM_INSIDE, FromInside, Pairs, first
from raycert.cases.vectors import along, cross, dot, minus, plus, times
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.answer import Claim, First, Listed, YesNo

Given = tuple[Solid, Ray, Pairs, Claim]
"""A question, the right list, and what was answered."""
Lists = Callable[[Solid, Ray], Pairs]
"""From a question to the list that a misreading takes for the right one."""
ORIGIN: Point = (0.0, 0.0, 0.0)
BACK = 64.0
"""All that an easy case meets lies within so many t of its start."""
SEVERAL = 4
"""More misreadings than these, all of which fit, are none that one can name."""


@dataclass(frozen=True, slots=True)
class Misreading:
    """`text` says what it does, after the word "it".

    `from_inside` is how its lists tell a first hit; None for as the hello says.
    """

    text: str
    lists: Lists
    from_inside: FromInside | None = None

    def foretells(self, given: Given) -> bool:
        """Whether the answer to a question is the one of this misreading."""
        solid, ray, _, said = given
        if self.from_inside and isinstance(said, First):
            said = replace(said, from_inside=self.from_inside)
        try:
            return says(said, self.lists(solid, ray))
        except (Refused, ZeroDivisionError):  # what it makes of the question is no question
            return False


def exact(solid: Solid, ray: Ray) -> Pairs:
    """Return the right list, in binary64."""
    return tuple((float(enter), float(leave)) for enter, leave in trace(solid, ray).intervals)


def close(subject: Pairs, truth: Pairs) -> bool:
    """Whether two lists agree to about five digits."""
    ends, others = chain(*subject), chain(*truth)
    return len(subject) == len(truth) and all(map(near, ends, others))


def near(a: float | None, b: float | None) -> bool:
    """Whether two numbers agree to about five digits, or are both none."""
    if a is None or b is None:
        return a is b
    return math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-6)


def says(said: Claim, pairs: Pairs) -> bool:
    """Whether an answer is the one that follows from a list, to about five digits."""
    match said:
        case Listed(given):
            return close(given, pairs)
        case First(t, mode):
            return near(t, first(pairs, mode))
        case YesNo(hit):
            return hit == bool(pairs)
    raise AssertionError(said)


def misreadings(given: Sequence[Given]) -> list[str]:
    """Return the texts of the misreadings that foretell all answers; none if they are too many.

    One wrong answer shows no habit.
    """
    wrong = [each for each in given if not says(each[3], each[2])]
    if len(wrong) < 2:
        return []
    if same := _same(given, wrong):
        return [same]
    fitting = (m for m in MISREADINGS if all(m.foretells(each) for each in (*wrong, *given)))
    texts = [misreading.text for misreading in fitting]
    return texts if len(texts) <= SEVERAL else []


def _same(given: Sequence[Given], wrong: Sequence[Given]) -> str | None:
    """Return what is told of wrong answers that are all the same."""
    first = wrong[0][3]
    if any(repr(said) != repr(first) for *_, said in wrong):
        return None
    value = first.pairs if isinstance(first, Listed) else getattr(first, "t", None)
    if value and not any(truth for _, _, truth, _ in wrong):
        shown = [list(pair) for pair in first.pairs] if isinstance(first, Listed) else value
        return f"answers a miss with {shown}: a miss is an empty list, or no hit"
    if all(says(said, ()) for *_, said in given):
        return "answers every one with a miss: are the hits put into the answer?"
    return None


# How questions are misread.


def _of_leaves(change: Callable[[Any], Leaf], *kinds: type[Leaf]) -> Lists:
    """Return the lists of a change of all leaves of some kinds."""

    def changed(leaf: Leaf) -> Leaf:
        return change(leaf) if isinstance(leaf, kinds) else leaf

    return lambda solid, ray: exact(map_leaves(changed, solid), ray)


def _of_ray(change: Callable[[Ray], Ray]) -> Lists:
    return lambda solid, ray: exact(solid, change(ray))


def _of_pairs(change: Callable[[float, float, float], tuple[float, float]]) -> Lists:
    """Return the lists of a change of each pair, told |direction|."""

    def lists(solid: Solid, ray: Ray) -> Pairs:
        speed = math.hypot(*ray.direction)
        return tuple(change(enter, leave, speed) for enter, leave in exact(solid, ray))

    return lists


def _ends(change: Callable[[Point, Vector], tuple[Point, Point]]) -> Callable[[Any], Leaf]:
    """Return a change of p and q, told p and q - p."""

    def changed(leaf: Any) -> Leaf:
        p, q = change(leaf.p, minus(leaf.q, leaf.p))
        moved: Leaf = replace(leaf, p=p, q=q)
        return moved

    return changed


def _resized(change: Callable[[float], float]) -> Callable[[Any], Leaf]:
    return lambda leaf: replace(leaf, radius=change(leaf.radius))


def _vectors(change: Callable[[Vector], Vector]) -> Callable[[Leaf], Leaf]:
    """Return a change of every point and direction of a leaf."""

    def changed(leaf: Leaf) -> Leaf:
        shape = SHAPES[type(leaf)]
        names = (*shape.points, *shape.directions)
        new: dict[str, Any] = {name: change(getattr(leaf, name)) for name in names}
        return replace(leaf, **new)

    return changed


def _mirrored(i: int, x: Vector) -> Vector:
    return tuple(-c if i == j else c for j, c in enumerate(x))  # type: ignore[return-value]


def _exchanged(i: int, j: int, x: Vector) -> Vector:
    new = list(x)
    new[i], new[j] = x[j], x[i]
    return tuple(new)  # type: ignore[return-value]


def _upright(w: Vector) -> Vector:
    return (0.0, 0.0, math.hypot(*w))


def _turned(factor: float, w: Vector) -> Vector:
    """Return z turned towards w, by a multiple of the angle between them; as long as w."""
    size = math.hypot(*w)
    side = cross((0.0, 0.0, 1.0), w)
    angle = factor * math.atan2(math.hypot(*side), w[2])
    flat = math.hypot(w[0], w[1])
    if not flat:
        return (0.0, 0.0, size * math.cos(angle))
    out = size * math.sin(angle) / flat
    return (w[0] * out, w[1] * out, size * math.cos(angle))


def _tall(factor: float, p: Point, w: Vector) -> tuple[Point, Point]:
    """Return the ends of what has the middle of pq and a multiple of its height."""
    middle = along(p, 0.5, w)
    return along(middle, -0.5 * factor, w), along(middle, 0.5 * factor, w)


def _around(make: Callable[[Vector], Vector], p: Point, w: Vector) -> tuple[Point, Point]:
    """Return the ends of what has the middle of pq and another axis."""
    middle, axis = along(p, 0.5, w), make(w)
    return along(middle, -0.5, axis), along(middle, 0.5, axis)


def _uncut(solid: Solid, ray: Ray) -> Pairs:
    """Return the list of the whole line, t < 0 included."""
    early = Ray(along(ray.origin, -BACK, ray.direction), ray.direction)
    return tuple((a - BACK if a else -math.inf, b - BACK) for a, b in exact(solid, early))


def _within_one(solid: Solid, ray: Ray) -> Pairs:
    """Return the list of the segment from the origin to origin + direction."""
    return tuple((a, min(b, 1.0)) for a, b in exact(solid, ray) if a <= 1)


def _last(solid: Solid, ray: Ray) -> Pairs:
    """Return a list whose first hit is where the ray leaves for good."""
    pairs = exact(solid, ray)
    return ((pairs[-1][1], math.inf),) if pairs else ()


AXIAL = (Cylinder, InfiniteCylinder, Slab)
ROUND = (Cylinder, InfiniteCylinder, Sphere)
RADIAN = math.pi / 180


def _all() -> Iterator[tuple[str, Lists]]:
    yield from (
        ("answers t * |direction|: lengths, or the direction was normalised. t is in units of the "
         "direction as it is given: divide by |direction|",
         _of_pairs(lambda a, b, v: (a * v, b * v))),
        ("answers t * |direction|^2: a division by direction . direction is missing",
         _of_pairs(lambda a, b, v: (a * v**2, b * v**2))),
        ("answers t / |direction|: it divides by the length once too often",
         _of_pairs(lambda a, b, v: (a / v, b / v))),
        ("answers t^2: squared parameters", _of_pairs(lambda a, b, _: (a * a, b * b))),
        ("has enter and leave swapped: each pair is [enter, leave]",
         _of_pairs(lambda a, b, _: (b, a))),
        ("answers [enter, length]: the second number is where the ray leaves",
         _of_pairs(lambda a, b, _: (a, b - a))),
        ("does not cut the line at t = 0: what lies behind the start is left out", _uncut),
        ("takes the ray for the segment from t = 0 to 1: a ray has no end", _within_one),
        ("takes `direction` for a second point of the ray: it is added to the origin",
         _of_ray(lambda ray: Ray(ray.origin, minus(ray.direction, ray.origin)))),
        ("has the direction of the ray reversed",
         _of_ray(lambda ray: Ray(ray.origin, times(-1.0, ray.direction)))),
        ("ignores the origin of the ray", _of_ray(lambda ray: Ray(ORIGIN, ray.direction))),
    )  # fmt: skip
    yield from _places()
    yield from ((text, _of_leaves(_ends(change), *AXIAL)) for text, change in AXES)
    yield from _sizes()


def _places() -> Iterator[tuple[str, Lists]]:
    """Yield what is done to points, normals and coordinates."""
    yield "ignores `center`", _of_leaves(lambda s: replace(s, center=ORIGIN), Sphere)
    yield "ignores `point`", _of_leaves(lambda h: replace(h, point=ORIGIN), HalfSpace)
    yield (
        "has the normal turned inward: `normal` points outward",
        _of_leaves(lambda h: replace(h, normal=times(-1.0, h.normal)), HalfSpace),
    )
    yield (
        "has the sign of `center` wrong",
        _of_leaves(lambda s: replace(s, center=times(-1.0, s.center)), Sphere),
    )
    yield (
        "has the sign of the plane's offset wrong",
        _of_leaves(lambda h: replace(h, point=times(-1.0, h.point)), HalfSpace),
    )
    yield (
        "takes point . normal for the plane's distance from the origin: divide it by |normal|",
        _of_leaves(lambda h: replace(h, point=_foot(h, math.hypot(*h.normal))), HalfSpace),
    )
    yield (
        "takes the plane's distance from the origin for point . normal: `normal` has any length",
        _of_leaves(lambda h: replace(h, point=_foot(h, 1 / math.hypot(*h.normal))), HalfSpace),
    )
    for i, name in enumerate("xyz"):
        kept = partial(_mirrored, i)
        yield (
            f"has the sign of {name} wrong in solids, or in rays",
            _of_leaves(_vectors(kept), *SHAPES),
        )
    for i, j in combinations(range(3), 2):
        yield (
            f"exchanges {'xyz'[i]} and {'xyz'[j]} in solids, or in rays",
            _of_leaves(_vectors(partial(_exchanged, i, j)), *SHAPES),
        )


def _foot(plane: HalfSpace, factor: float) -> Point:
    """Return the point of a plane whose distance from the origin is a multiple of the right one."""
    n = plane.normal
    return times(factor * dot(plane.point, n) / dot(n, n), n)


AXES: tuple[tuple[str, Callable[[Point, Vector], tuple[Point, Point]]], ...] = (
    ("ignores `p`: its axis runs from the origin to q", lambda p, w: (ORIGIN, plus(p, w))),
    ("ignores `p`: its axis runs from the origin along q - p", lambda p, w: (ORIGIN, w)),
    ("ignores where p and q are: its axis is centred at the origin",
     lambda p, w: (times(-0.5, w), times(0.5, w))),
    ("takes `q` for the axis: q is a point, and the axis q - p",
     lambda p, w: (p, plus(p, plus(p, w)))),
    ("has p and q exchanged in the axis: it runs from p along p - q",
     lambda p, w: (p, minus(p, w))),
    ("has p in the middle: the axis runs from p to q",
     lambda p, w: (along(p, -0.5, w), along(p, 0.5, w))),
    ("has the middle of pq where p has to be",
     lambda p, w: (along(p, 0.5, w), along(p, 1.5, w))),
    ("has half the height, from p", lambda p, w: (p, along(p, 0.5, w))),
    ("has half the height, about the middle of pq", partial(_tall, 0.5)),
    ("has twice the height, from p", lambda p, w: (p, along(p, 2.0, w))),
    ("has twice the height, about the middle of pq", partial(_tall, 2.0)),
    ("has the height 1, from p: the length of q - p is lost",
     lambda p, w: (p, along(p, 1 / math.hypot(*w), w))),
    ("ignores `q`: its axis is always z, from p as far as |q - p|",
     lambda p, w: (p, plus(p, _upright(w)))),
    ("has an axis that is always z, about the middle of pq", partial(_around, _upright)),
    ("has an axis that is always z, from the origin", lambda p, w: (ORIGIN, _upright(w))),
    ("has an axis that is always z, about the origin",
     lambda p, w: _around(_upright, times(-0.5, w), w)),
    ("gives an angle in radians where degrees are asked, from p",
     lambda p, w: (p, plus(p, _turned(RADIAN, w)))),
    ("gives an angle in radians where degrees are asked, about the middle of pq",
     partial(_around, partial(_turned, RADIAN))),
    ("gives an angle in degrees where radians are asked, from p",
     lambda p, w: (p, plus(p, _turned(1 / RADIAN, w)))),
    ("gives an angle in degrees where radians are asked, about the middle of pq",
     partial(_around, partial(_turned, 1 / RADIAN))),
    ("turns the axis the wrong way round, from p",
     lambda p, w: (p, plus(p, _turned(-1.0, w)))),
    ("turns the axis the wrong way round, about the middle of pq",
     partial(_around, partial(_turned, -1.0))),
)  # fmt: skip
"""What is done to p and q - p: the new ends."""


def _sizes() -> Iterator[tuple[str, Lists]]:
    """Yield what is done to the radius."""
    yield (
        "takes `radius` for the diameter: its answers are those for half the radius",
        _of_leaves(_resized(lambda r: r / 2), *ROUND),
    )
    yield (
        "doubles `radius`: its answers are those for twice the radius",
        _of_leaves(_resized(lambda r: r * 2), *ROUND),
    )
    yield (
        "takes `radius` for its square: it compares a squared distance with the radius",
        _of_leaves(_resized(math.sqrt), *ROUND),
    )
    yield "squares `radius` once too often", _of_leaves(_resized(lambda r: r * r), *ROUND)
    yield "ignores `radius`: its radius is always 1", _of_leaves(_resized(lambda r: 1.0), *ROUND)


MISREADINGS = (
    *(Misreading(text, lists) for text, lists in _all()),
    Misreading("answers where the ray leaves, and not where it enters", _last, "zero"),
    *(
        Misreading(f'answers a start inside as "from_inside": "{mode}" says', exact, mode)
        for mode in FROM_INSIDE
    ),
)
