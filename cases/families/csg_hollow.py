"""One solid inside another: nested parts, tubes, shells, bowls, and touches from inside."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.case import Family
from raycert.cases.families.bench import Bench, Shot, shoot, shoot_once
from raycert.cases.families.shapes import (
    Node,
    Shape,
    all_of,
    any_of,
    ball,
    below,
    layer,
    less,
    pipe,
    rod,
    spans,
)
from raycert.cases.families.sketch import ALWAYS, MISS, Pairs, pair, touch

HOLLOW = ("hollow",)
RING = ("hollow", "coincident-faces")


def _rod(radius: int, low: int = 0, high: int = 16) -> Shape:
    return rod((0, 0, low), (0, 0, high), radius)


def _walls(height: int) -> tuple[Shot, ...]:
    """Return rays square to the axis at 5/3: the half chords are 5/3, 4/tangent, 3/none."""
    return (
        Shot("across-both-walls", (-8, 0, height), (1, 0, 0), spans((3, 5), (11, 13))),
        Shot("tangent-to-the-bore", (-8, 3, height), (2, 0, 0), pair(2, 6)),
        Shot("beside-the-bore", (-8, 4, height), (1, 0, 0), pair(5, 11)),
        Shot("tangent-outside", (-8, 5, height), (2, 0, 0), touch(4)),
        Shot("inside-the-bore", (0, 0, height), (0, 1, 0), pair(3, 5)),
        Shot("inside-the-material", (4, 0, height), (-1, 0, 0), spans((0, 1), (7, 9))),
        Shot("start-on-the-bore-inward", (3, 0, height), (-1, 0, 0), pair(6, 8)),
        Shot("start-on-the-bore-outward", (3, 0, height), (2, 0, 0), pair(0, 1)),
        Shot("start-on-the-bore-tangent", (3, 0, height), (0, 2, 0), pair(0, 2)),
        Shot("start-outside-inward", (-5, 0, height), (1, 0, 0), spans((0, 2), (8, 10))),
        Shot("rest-in-the-bore", (1, 1, height), (0, 0, 0), MISS),
        Shot("rest-in-the-material", (0, 4, height), (0, 0, 0), ALWAYS),
    )


AXIAL = (
    Shot("along-the-axis", (0, 0, -4), (0, 0, 4), MISS),
    Shot("along-the-bore-wall", (3, 0, -4), (0, 0, 4), MISS),
    Shot("along-the-material", (0, 4, -4), (0, 0, 4), pair(1, 5)),
    Shot("along-the-outer-wall", (5, 0, -4), (0, 0, 4), pair(1, 5)),
)
TUBE, SLEEVE = less(_rod(5), _rod(3)), less(_rod(5), _rod(3, -4, 20))
DRILLED = less(_rod(5), pipe((0, 0, 0), (0, 0, 2), 3))
BLIND = less(_rod(5), _rod(3, 4, 16))
TUBES = (
    Bench("tube", "a tube, the caps coincident", TUBE, RING, (*_walls(8), *AXIAL)),
    Bench("tube-end", "a tube in the plane of a cap", TUBE, RING, _walls(16)[:4]),
    Bench("sleeve", "a tube by a longer bore", SLEEVE, HOLLOW, (*_walls(8)[:4], *AXIAL)),
    Bench("drilled", "a cylinder less an infinite one", DRILLED, HOLLOW, (*_walls(8)[:4], *AXIAL)),
    Bench("blind", "a cup with a bottom", BLIND, RING, (
        *_walls(8)[:2],
        Shot("down-the-axis", (0, 0, 32), (0, 0, -4), pair(7, 8)),
        Shot("across-the-bottom", (-8, 0, 2), (1, 0, 0), pair(3, 13)),
        Shot("in-the-plane-of-the-bottom", (-8, 0, 4), (1, 0, 0), spans((3, 5), (11, 13))),
    )),
)  # fmt: skip

SHELL = less(ball(5), ball(3))
BOWL = less(SHELL, below((0, 0, 0), (0, 0, -1)))
SHELLS = (
    Bench("shell", "a spherical shell", SHELL, HOLLOW, _walls(0)),
    Bench("bowl", "half a spherical shell, in its plane", BOWL, HOLLOW, (
        Shot("through-the-rim-plane", (-8, 0, 0), (1, 0, 0), MISS),
        Shot("down-the-axis", (0, 0, 8), (0, 0, -1), pair(11, 13)),
        Shot("up-the-axis", (0, 0, -8), (0, 0, 1), pair(3, 5)),
        Shot("up-the-side", (4, 0, -8), (0, 0, 1), pair(5, 8)),
        Shot("up-the-inner-tangent", (3, 0, -8), (0, 0, 2), pair(2, 4)),
    )),
    Bench("surd-shell", "a shell whose ends are surds", less(ball(4), ball(2)), HOLLOW, (
        Shot("beside", (-8, 1, 0), (4, 0, 0)), Shot("near-the-hole", (-8, 0, 1), (2, 1, 0)),
        Shot("inside-out", (1, 0, 1), (1, 2, 3)), Shot("missing-the-hole", (-8, 3, 0), (4, 0, 0)),
    )),
    Bench("wide-shell", "a shell of radii 25 and 17", less(ball(25), ball(17)), HOLLOW, (
        Shot("at-15", (-32, 15, 0), (4, 0, 0), spans((3, 6), (10, 13))),
        Shot("at-8", (-32, 8, 0), (1, 0, 0)),
        Shot("tangent-to-the-hole", (-32, 17, 0), (4, 0, 0)),
    )),
)  # fmt: skip


def _nest(
    slug: str, text: str, outer: Shape, inner: Shape, at: tuple[Pairs, Pairs]
) -> Iterator[Bench]:
    """Yield the Booleans of an inner solid in an outer one, met across and along.

    `at` is the list of the difference; the outer solid holds x in -8..8, the inner in -4..4.
    """
    forms: tuple[tuple[str, str, Node, Pairs], ...] = (
        ("or", "united", any_of(outer, inner), pair(2, 6)),
        ("and", "intersected", all_of(outer, inner), pair(3, 5)),
        ("less", "subtracted", less(outer, inner), at[0]),
        ("back", "subtracted the wrong way", less(inner, outer), at[1]),
    )
    for name, how, shape, known in forms:
        shot = Shot("across", (-16, 0, 0), (4, 0, 0), known)
        later = Shot("from-the-middle", (0, 0, 0), (4, 0, 0), None)
        aside = Shot("aside", (-16, 1, 2), (4, 1, 0), None)
        yield Bench(f"{slug}-{name}", f"{text}, {how}", shape, (), (shot, later, aside))


APART = (spans((2, 3), (5, 6)), MISS)
NESTS = (
    *_nest("balls", "a sphere in a sphere", ball(8), ball(4), APART),
    *_nest("rod-in-ball", "a cylinder in a sphere", ball(8), rod((-4, 0, 0), (4, 0, 0), 4), APART),
    *_nest("ball-in-rod", "a sphere in a cylinder", rod((0, 0, -8), (0, 0, 8), 8), ball(4), APART),
    *_nest(
        "rods", "a cylinder in a cylinder",
        rod((0, 0, -8), (0, 0, 8), 8), rod((-4, 0, 0), (4, 0, 0), 2), APART,
    ),
    *_nest(
        "slabs", "a cylinder in a slab", layer((-8, 0, 0), (8, 0, 0)),
        rod((0, 0, -4), (0, 0, 4), 4), APART,
    ),
)  # fmt: skip

INNER = ball(4, 4)
KISSES = (
    Bench("less", "a sphere less one touching it inside", less(ball(8), INNER), ("touching-parts",),
        (
        Shot("through", (-16, 0, 0), (4, 0, 0), pair(2, 4)),
        Shot("tangent-at-the-touch", (8, -8, 0), (0, 4, 0), MISS),
        Shot("start-at-the-touch", (8, 0, 0), (-4, 0, 0), pair(2, 4)),
        Shot("start-at-the-touch-out", (8, 0, 0), (4, 0, 0), MISS),
    )),
    Bench("and", "a sphere and one touching it inside", all_of(ball(8), INNER), ("touching-parts",),
        (
        Shot("through", (-16, 0, 0), (4, 0, 0), pair(4, 6)),
        Shot("tangent-at-the-touch", (8, -8, 0), (0, 4, 0), touch(2)),
        Shot("start-at-the-touch", (8, 0, 0), (-4, 0, 0), pair(0, 2)),
        Shot("start-at-the-touch-out", (8, 0, 0), (4, 0, 0), touch(0)),
    )),
    Bench("back", "a sphere less one around it that touches", less(INNER, ball(8)),
        ("touching-parts",), (
        Shot("through", (-16, 0, 0), (4, 0, 0), MISS),
        Shot("tangent-at-the-touch", (8, -8, 0), (0, 4, 0), MISS),
    )),
)  # fmt: skip

FAMILIES = (
    Family("csg-tube", "Cylinder less cylinder: the bore, the wall, the ends.", shoot_once(TUBES)),
    Family("csg-shell", "Sphere less sphere.", shoot(SHELLS)),
    Family("csg-nested", "One part inside the other.", shoot_once(NESTS)),
    Family("csg-touching-inside", "One part inside the other, touching it.", shoot(KISSES)),
)
