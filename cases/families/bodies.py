"""Trees and the rays sent at them: faces in common, parts in parts, many parts, starts in trees."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from raycert.cases.case import Family
from raycert.cases.families.frames import SEVENTHS, Exact, frames_for
from raycert.cases.families.lists import AHEAD, START, WHOLE
from raycert.cases.families.shots import (
    Flags,
    Frames,
    Shot,
    beside,
    drawn,
    family,
    one_frame,
    table,
)
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Node,
    Pairs,
    Shape,
    all_of,
    any_of,
    ball,
    below,
    layer,
    less,
    near,
    pair,
    pipe,
    rod,
    spans,
    touch,
)
from raycert.cases.formats import Format

Path = tuple[str, Exact, Exact] | tuple[str, Exact, Exact, Pairs | None]
"""A ray at a tree: words for it, where it starts and goes, and what it meets."""
SHARED = ("coincident-faces",)
TOUCHING = ("touching-parts",)
FLAG_OF = {
    "tangent": "tangent", "wall": "wall", "rim": "rim", "rest": "zero-direction",
    "start": "start-on-surface", "inside": "start-inside", "plane": "cap-plane",
}  # fmt: skip
"""The flags that words for a ray tell."""


def bench(slug: str, text: str, shape: Node, flags: Flags, *paths: Path) -> tuple[Shot, ...]:
    """Return the shots along these paths at a tree that a sentence calls `text`."""
    shots = []
    for path in paths:
        name, origin, direction = path[:3]
        flagged = tuple(flag for word, flag in FLAG_OF.items() if word in name.split("-"))
        shots.append(Shot(
            f"{slug}-{name}", f"A ray meets {text}: {name.replace('-', ' ')}", shape, origin,
            direction, path[3] if len(path) == 4 else None, flags=(*flags, *flagged)))  # fmt: skip
    return tuple(shots)


def drum(low: int, high: int, radius: int = 4) -> Shape:
    return rod((0, 0, low), (0, 0, high), radius)


WELL = pipe((0, 0, 0), (0, 0, 8), 4)
ABOVE = layer((0, 0, 4), (0, 0, 8))

# The rays of the drums: through z = 4 at t = 2, where x is 0 or the ray leaves x alone.
PATHS: dict[str, tuple[Exact, Exact]] = {
    "across-low": ((-8, 0, 2), (4, 0, 0)),
    "across-in-the-seam-plane": ((-8, 0, 4), (4, 0, 0)),
    "across-high": ((-8, 0, 6), (4, 0, 0)),
    "along-the-axis": ((0, 0, -4), (0, 0, 4)),
    "beside-the-axis": ((1, 2, -4), (0, 0, 4)),
    "in-the-wall": ((4, 0, -4), (0, 0, 4)),
    "slanted": ((-8, 0, -4), (4, 0, 4)),
    "through-the-rim": ((-8, 0, 0), (4, 0, 4)),
    "tangent-low": ((-8, 4, 2), (4, 0, 0)),
    "tangent-at-the-seam": ((-8, 4, 4), (4, 0, 0)),
}


def _drums(slug: str, text: str, shape: Node, *known: Pairs) -> tuple[Shot, ...]:
    """Return the shots at drums with the list for each of PATHS."""
    paths = ((name, *path, met) for (name, path), met in zip(PATHS.items(), known, strict=True))
    return bench(slug, text, shape, SHARED, *paths)


ONE, TWO, AT_2 = pair(1, 3), pair(1, 2), touch(2)
DRUMS = (
    *_drums("stack", "two cylinders stacked into one", any_of(drum(0, 4), drum(4, 8)),
        ONE, ONE, ONE, ONE, ONE, ONE, ONE, pair(1, 2), AT_2, AT_2),
    *_drums("shared-cap", "what two stacked cylinders share", all_of(drum(0, 4), drum(4, 8)),
        MISS, ONE, MISS, AT_2, AT_2, AT_2, AT_2, touch(1), MISS, AT_2),
    *_drums("stack-less", "a cylinder less the one on it", less(drum(0, 4), drum(4, 8)),
        ONE, MISS, MISS, TWO, TWO, TWO, TWO, MISS, AT_2, MISS),
    *_drums("top-off", "a cylinder less its upper half", less(drum(0, 8), drum(4, 8)),
        ONE, MISS, MISS, TWO, TWO, TWO, TWO, MISS, AT_2, MISS),
    *_drums("sliced", "a cylinder less a slab at its cap", less(drum(0, 8), ABOVE),
        ONE, MISS, MISS, TWO, TWO, TWO, TWO, MISS, AT_2, MISS),
    *_drums("waist", "a cylinder less its middle", less(drum(0, 8), drum(3, 5)),
        ONE, MISS, ONE, *(spans((1, "7/4"), ("9/4", 3)),) * 4, spans(("5/4", 2)), AT_2, MISS),
    *_drums("plug", "an infinite cylinder less a part of it", less(WELL, drum(4, 8)),
        ONE, MISS, MISS, *(spans((0, 2), (3, None)),) * 3, TWO, pair(2, 3), AT_2, MISS),
    *_drums("respelled", "a tube cut by a slab, less that cylinder",
        less(all_of(WELL, ABOVE), drum(4, 8)), *(MISS,) * 10),
    *_drums("turned", "a cylinder and itself turned upside down",
        all_of(drum(0, 8), rod((0, 0, 8), (0, 0, 0), 4)),
        ONE, ONE, ONE, ONE, ONE, ONE, ONE, pair(1, 2), AT_2, AT_2),
)  # fmt: skip

BALLS = (ball(4, -4), ball(4, 4))
RODS = (rod((-4, 0, -4), (-4, 0, 4), 4), rod((4, 0, -4), (4, 0, 4), 4))
THROUGH: Exact = (-12, 0, 0)
HOW = ((any_of, "united"), (all_of, "intersected"), (less, "subtracted"))


def _pairs(
    slug: str, text: str, two: tuple[Shape, ...], along: Pairs, across: Pairs = AT_2
) -> Iterable[Shot]:
    """Yield shots at the Booleans of two solids that touch at 0, on x < 0 and x > 0.

    `along` and `across` are what rays up the z axis and along the y axis meet in the second one.
    """
    both = along if slug == "rods" else touch(2)
    lists = ((pair(1, 5), across, along), (touch(3), touch(2), both), (pair(1, 3), MISS, MISS))
    for (make, name), (through, tangent, up) in zip(HOW, lists, strict=True):
        yield from bench(
            f"{slug}-{name}", f"{text}, {name}", make(*two), TOUCHING,
            ("through", THROUGH, (4, 0, 0), through),
            ("tangent-to-both", (0, -16, 0), (0, 8, 0), tangent),
            ("up-the-touch", (0, 0, -8), (0, 0, 4), up),
            ("start-at-the-touch-out", (0, 0, 0), (0, 4, 0)),
            ("start-at-the-touch-in", (0, 0, 0), (-4, 0, 0)),
            ("start-at-the-touch-rest", (0, 0, 0), (0, 0, 0)))  # fmt: skip


CAPPED = rod((0, 0, 0), (8, 0, 0), 4)
TOUCHES = (
    *_pairs("balls", "two touching spheres", BALLS, touch(2)),
    *_pairs("rods", "two cylinders that touch in a line", RODS, ONE),
    *_pairs("ball-rod", "a sphere touching a cylinder", (BALLS[0], RODS[1]), ONE),
    *_pairs("ball-cap", "a sphere touching a cap", (BALLS[0], CAPPED), ONE, spans(("3/2", "5/2"))),
)

FLOOR = below((0, 0, 0), (0, 0, 2))
BUBBLE = ball(4, 0, 0, 4)
DOWN = ((0, 0, 12), (0, 0, -4))
FLAT = ((-8, 0, 0), (4, 0, 0))
POINT = ((-4, 0, 3), (4, 0, -3))
ON_A_PLANE = (
    *bench("or", "a sphere on a plane, united", any_of(BUBBLE, FLOOR), TOUCHING,
        ("down", *DOWN, pair(1, None)), ("in-the-plane", *FLAT, ALWAYS),
        ("to-the-point", *POINT, None)),
    *bench("and", "a sphere on a plane, intersected", all_of(BUBBLE, FLOOR), TOUCHING,
        ("down", *DOWN, touch(3)), ("in-the-plane", *FLAT, touch(2)),
        ("to-the-point", *POINT, touch(1))),
    *bench("less", "a sphere less the plane below", less(BUBBLE, FLOOR), TOUCHING,
        ("down", *DOWN, pair(1, 3)), ("in-the-plane", *FLAT, MISS), ("to-the-point", *POINT, None)),
    *bench("floor-less", "the plane less a sphere on it", less(FLOOR, BUBBLE), TOUCHING,
        ("down", *DOWN, pair(3, None)), ("in-the-plane", *FLAT, ALWAYS),
        ("to-the-point", *POINT, pair(1, None))),
)  # fmt: skip

SLOT = pipe((0, 0, 0), (0, 0, 8), 4)
MARBLE = ball(4)
CIRCLE = ((-8, 0, -4), (4, 0, 4))
IN_A_TUBE = (
    *bench("fill", "a tube less a sphere that fills it", less(SLOT, MARBLE), SHARED,
        ("across", *FLAT, MISS), ("through-the-circle", *CIRCLE, pair(2, 3)),
        ("along", (0, 0, -12), (0, 0, 4), spans((0, 2), (4, None))),
        ("in-the-wall", (4, 0, -12), (0, 0, 4), ALWAYS), ("tangent", (-8, 4, 0), (4, 0, 0), MISS)),
    *bench("both", "a sphere in a tube, intersected", all_of(SLOT, MARBLE), SHARED,
        ("across", *FLAT, ONE), ("through-the-circle", *CIRCLE, TWO),
        ("in-the-wall", (4, 0, -12), (0, 0, 4), touch(3)),
        ("tangent", (-8, 4, 0), (4, 0, 0), AT_2)),
    *bench("either", "a sphere in a tube, united", any_of(SLOT, MARBLE), SHARED,
        ("across", *FLAT, ONE), ("through-the-circle", *CIRCLE, ONE),
        ("in-the-wall", (4, 0, -12), (0, 0, 4), ALWAYS), ("tangent", (-8, 4, 0), (4, 0, 0), AT_2)),
    *bench("poke", "a sphere less the tube around it", less(MARBLE, SLOT), SHARED,
        ("across", *FLAT, MISS), ("through-the-circle", *CIRCLE, MISS),
        ("tangent", (-8, 4, 0), (4, 0, 0), MISS)),
)  # fmt: skip

HOLLOW = ("hollow",)
RING = ("hollow", "coincident-faces")


def _rod(radius: int, low: int = 0, high: int = 16) -> Shape:
    return rod((0, 0, low), (0, 0, high), radius)


def _walls(height: int) -> tuple[Path, ...]:
    """Return rays square to the axis at 5/3: the half chords are 5/3, 4/tangent, 3/none."""
    return (
        ("across-both-walls", (-8, 0, height), (1, 0, 0), spans((3, 5), (11, 13))),
        ("tangent-to-the-bore", (-8, 3, height), (2, 0, 0), pair(2, 6)),
        ("beside-the-bore", (-8, 4, height), (1, 0, 0), pair(5, 11)),
        ("tangent-outside", (-8, 5, height), (2, 0, 0), touch(4)),
        ("inside-the-bore", (0, 0, height), (0, 1, 0), pair(3, 5)),
        ("inside-the-material", (4, 0, height), (-1, 0, 0), spans((0, 1), (7, 9))),
        ("start-on-the-bore-inward", (3, 0, height), (-1, 0, 0), pair(6, 8)),
        ("start-on-the-bore-outward", (3, 0, height), (2, 0, 0), pair(0, 1)),
        ("start-on-the-bore-tangent", (3, 0, height), (0, 2, 0), pair(0, 2)),
        ("start-outside-inward", (-5, 0, height), (1, 0, 0), spans((0, 2), (8, 10))),
        ("rest-in-the-bore", (1, 1, height), (0, 0, 0), MISS),
        ("rest-in-the-material", (0, 4, height), (0, 0, 0), ALWAYS),
    )


AXIAL: tuple[Path, ...] = (
    ("along-the-axis", (0, 0, -4), (0, 0, 4), MISS),
    ("along-the-bore-wall", (3, 0, -4), (0, 0, 4), MISS),
    ("along-the-material", (0, 4, -4), (0, 0, 4), pair(1, 5)),
    ("along-the-outer-wall", (5, 0, -4), (0, 0, 4), pair(1, 5)),
)
TUBE, SLEEVE = less(_rod(5), _rod(3)), less(_rod(5), _rod(3, -4, 20))
DRILLED = less(_rod(5), pipe((0, 0, 0), (0, 0, 2), 3))
BLIND = less(_rod(5), _rod(3, 4, 16))
TUBES = (
    *bench("tube", "a tube, the caps coincident", TUBE, RING, *_walls(8), *AXIAL),
    *bench("tube-end", "a tube in the plane of a cap", TUBE, RING, *_walls(16)[:4]),
    *bench("sleeve", "a tube by a longer bore", SLEEVE, HOLLOW, *_walls(8)[:4], *AXIAL),
    *bench("drilled", "a cylinder less an infinite one", DRILLED, HOLLOW, *_walls(8)[:4], *AXIAL),
    *bench("blind", "a cup with a bottom", BLIND, RING,
        *_walls(8)[:2],
        ("down-the-axis", (0, 0, 32), (0, 0, -4), pair(7, 8)),
        ("across-the-bottom", (-8, 0, 2), (1, 0, 0), pair(3, 13)),
        ("in-the-plane-of-the-bottom", (-8, 0, 4), (1, 0, 0), spans((3, 5), (11, 13)))),
)  # fmt: skip

SHELL = less(ball(5), ball(3))
BOWL = less(SHELL, below((0, 0, 0), (0, 0, -1)))
SHELLS = (
    *bench("shell", "a spherical shell", SHELL, HOLLOW, *_walls(0)),
    *bench("bowl", "half a spherical shell, in its plane", BOWL, HOLLOW,
        ("through-the-rim-plane", (-8, 0, 0), (1, 0, 0), MISS),
        ("down-the-axis", (0, 0, 8), (0, 0, -1), pair(11, 13)),
        ("up-the-axis", (0, 0, -8), (0, 0, 1), pair(3, 5)),
        ("up-the-side", (4, 0, -8), (0, 0, 1), pair(5, 8)),
        ("up-the-inner-tangent", (3, 0, -8), (0, 0, 2), pair(2, 4))),
    *bench("surd-shell", "a shell whose ends are surds", less(ball(4), ball(2)), HOLLOW,
        ("beside", (-8, 1, 0), (4, 0, 0)), ("near-the-hole", (-8, 0, 1), (2, 1, 0)),
        ("inside-out", (1, 0, 1), (1, 2, 3)), ("missing-the-hole", (-8, 3, 0), (4, 0, 0))),
    *bench("wide-shell", "a shell of radii 25 and 17", less(ball(25), ball(17)), HOLLOW,
        ("at-15", (-32, 15, 0), (4, 0, 0), spans((3, 6), (10, 13))),
        ("at-8", (-32, 8, 0), (1, 0, 0)), ("tangent-to-the-hole", (-32, 17, 0), (4, 0, 0))),
)  # fmt: skip


def _nest(slug: str, text: str, outer: Shape, inner: Shape) -> Iterable[Shot]:
    """Yield shots at the Booleans of an inner solid in an outer one, met across and along.

    The outer solid holds x in -8..8, the inner in -4..4.
    """
    for name, how, shape, known in (
        ("or", "united", any_of(outer, inner), pair(2, 6)),
        ("and", "intersected", all_of(outer, inner), pair(3, 5)),
        ("less", "subtracted", less(outer, inner), spans((2, 3), (5, 6))),
        ("back", "subtracted the wrong way", less(inner, outer), MISS),
    ):
        yield from bench(
            f"{slug}-{name}", f"{text}, {how}", shape, (),
            ("across", (-16, 0, 0), (4, 0, 0), known),
            ("from-the-middle", (0, 0, 0), (4, 0, 0)),
            ("aside", (-16, 1, 2), (4, 1, 0)))  # fmt: skip


NESTS = (
    *_nest("balls", "a sphere in a sphere", ball(8), ball(4)),
    *_nest("rod-in-ball", "a cylinder in a sphere", ball(8), rod((-4, 0, 0), (4, 0, 0), 4)),
    *_nest("ball-in-rod", "a sphere in a cylinder", rod((0, 0, -8), (0, 0, 8), 8), ball(4)),
    *_nest("rods", "a cylinder in a cylinder",
        rod((0, 0, -8), (0, 0, 8), 8), rod((-4, 0, 0), (4, 0, 0), 2)),
    *_nest("slabs", "a cylinder in a slab", layer((-8, 0, 0), (8, 0, 0)),
        rod((0, 0, -4), (0, 0, 4), 4)),
)  # fmt: skip

INNER = ball(4, 4)
KISSES = (
    *bench("less", "a sphere less one touching it inside", less(ball(8), INNER), TOUCHING,
        ("through", (-16, 0, 0), (4, 0, 0), pair(2, 4)),
        ("tangent-at-the-touch", (8, -8, 0), (0, 4, 0), MISS),
        ("start-at-the-touch", (8, 0, 0), (-4, 0, 0), pair(2, 4)),
        ("start-at-the-touch-out", (8, 0, 0), (4, 0, 0), MISS)),
    *bench("and", "a sphere and one touching it inside", all_of(ball(8), INNER), TOUCHING,
        ("through", (-16, 0, 0), (4, 0, 0), pair(4, 6)),
        ("tangent-at-the-touch", (8, -8, 0), (0, 4, 0), touch(2)),
        ("start-at-the-touch", (8, 0, 0), (-4, 0, 0), pair(0, 2)),
        ("start-at-the-touch-out", (8, 0, 0), (4, 0, 0), touch(0))),
    *bench("back", "a sphere less one around it that touches", less(INNER, ball(8)), TOUCHING,
        ("through", (-16, 0, 0), (4, 0, 0), MISS),
        ("tangent-at-the-touch", (8, -8, 0), (0, 4, 0), MISS)),
)  # fmt: skip
BOTH = drawn(1, 1)


def _at(name: str, reason: str, shots: Iterable[Shot], frame: Frames = BOTH) -> Family:
    return family(name, reason, tuple(shots), frame=frame)


Stretches = list[tuple[int, int]]
REST: Exact = (0, 0, 0)
MANY = ("many-intervals",)
COUNTS = (3, 4, 6, 8)
WAYS = ("ball", "rod", "caps", "ball-aside")


def _each(count: int, every: int) -> Stretches:
    """Return `count` stretches of length 2, their starts `every` apart, from 1 on."""
    return [(1 + every * i, 3 + every * i) for i in range(count)]


def _between(ends: list[int]) -> Pairs:
    return spans(*zip(ends[::2], ends[1::2], strict=True))


def _rows() -> Iterator[Shot]:
    for count in COUNTS:
        apart, joined = _each(count, 4), _each(count, 2)
        last = 4 * count + 2
        left = _between([0, *(end for hole in apart for end in hole), last])
        for way in WAYS:
            parts = [WHOLE[way](*stretch) for stretch in apart]
            chain = [WHOLE[way](*stretch) for stretch in joined]
            whole = rod((0, 0, 0), (4 * last, 0, 0), 16)
            forms: tuple[tuple[str, str, Node, Pairs], ...] = (
                ("row", "parts in a row", any_of(*parts), spans(*apart)),
                ("backwards", "parts in a row, last first", any_of(*parts[::-1]), spans(*apart)),
                ("comb", "holes in a cylinder", less(whole, *parts), left),
                ("chain", "parts that touch", any_of(*chain), pair(1, 2 * count + 1)),
            )
            for slug, text, shape, known in forms:
                if count > 6 and (slug == "backwards" or way == "caps"):
                    continue
                name = f"{slug}-{count}-{way}"
                yield Shot(name, f"A ray meets {count} {text}, each a {way}", shape, START, AHEAD,
                           known, frames_for(name, 1, 1)[count % 2],
                           ("touching-parts",) if slug == "chain" else MANY)  # fmt: skip


def _onions() -> Iterator[Shot]:
    """Yield shells in shells: parts less the next smaller; an odd one has a core."""
    for count in (3, 4, 5, 6):
        for way in ("ball", "rod", "ball-aside", "pipe-aside"):
            layers = [WHOLE[way](k, 24 - k) for k in range(2, 2 + count)]
            shape: Shape = layers[-1]
            for one in layers[-2::-1]:
                shape = less(one, shape)
            name, ends = f"{count}-{way}", [*range(2, 2 + count), *range(23 - count, 23)]
            yield Shot(f"onion-{name}",
                       f"A ray meets {count} nested parts, each less the next, {way} by {way}",
                       shape, START, AHEAD, _between(ends), one_frame(name))  # fmt: skip


UPPER, LOWER = below((0, 0, 0), (0, 0, -2)), below((0, 0, 0), (0, 0, 2))
OVER, UNDER = below((0, 0, 4), (0, 0, -2)), below((0, 0, -4), (0, 0, 1))
CUBE = all_of(*(below(p, p) for p in (
    (4, 0, 0), (-4, 0, 0), (0, 4, 0), (0, -4, 0), (0, 0, 4), (0, 0, -4),
)))  # fmt: skip
WEDGE = all_of(below((0, 0, 0), (2, 0, 0)), LOWER)
ALL_BUT = less(any_of(UPPER, LOWER), ball(4))
TUNNEL = less(layer((0, 0, -4), (0, 0, 4)), pipe((0, 0, 0), (0, 4, 0), 4))
CROSS = any_of(pipe((0, 0, 0), (0, 0, 4), 4), pipe((0, 0, 0), (0, 4, 0), 4))
RISE, LEVEL, SLOPE = ((0, 1, -8), (0, 0, 4)), ((-8, 1, 0), (4, 0, 0)), ((-8, 0, -8), (4, 0, 4))
ENDLESS = (
    *bench("everything", "two half-spaces that cover all", any_of(UPPER, LOWER), (),
        ("rising", *RISE, ALWAYS), ("in-the-shared-plane", *LEVEL, ALWAYS),
        ("slanted", *SLOPE, ALWAYS), ("rest-on-the-plane", (1, 2, 0), (0, 0, 0), ALWAYS)),
    *bench("plane", "what two opposite half-spaces share", all_of(UPPER, LOWER), (),
        ("rising", *RISE, touch(2)), ("in-the-shared-plane", *LEVEL, ALWAYS),
        ("slanted", *SLOPE, touch(2)), ("start-and-leave", (1, 2, 0), (1, 0, 1), touch(0)),
        ("rest-beside-the-plane", (1, 2, 1), (0, 0, 0), MISS)),
    *bench("complement", "a half-space less its opposite", less(UPPER, LOWER), (),
        ("rising", *RISE, pair(2, None)), ("in-the-shared-plane", *LEVEL, MISS),
        ("falling", (0, 1, 8), (0, 0, -4), pair(0, 2))),
    *bench("apart", "two half-spaces apart", any_of(OVER, UNDER), (),
        ("rising", *RISE, spans((0, 1), (3, None))), ("level-between", *LEVEL, MISS),
        ("slanted", *SLOPE, spans((0, 1), (3, None)))),
    *bench("nothing", "half-spaces with nothing in common", all_of(OVER, UNDER), (),
        ("rising", *RISE, MISS), ("slanted", *SLOPE, MISS)),
    *bench("cube", "a cube of six half-spaces", CUBE, (),
        ("through", *RISE, pair(1, 3)), ("through-corners", (-8, -8, -8), (4, 4, 4), pair(1, 3)),
        ("in-a-face-plane", (-8, 0, 4), (4, 0, 0), pair(1, 3)),
        ("along-an-edge", (-8, 4, 4), (4, 0, 0), pair(1, 3)),
        ("past-a-corner", (-8, 4, 0), (4, 4, 0), MISS),
        ("touching-an-edge", (-8, 0, 0), (4, 4, 0), touch(1)),
        ("touching-a-corner", (-8, 0, 2), (4, 4, 2), touch(1)),
        ("inside", (0, 0, 0), (1, 2, 4), pair(0, 1))),
    *bench("wedge", "a wedge of two half-spaces", WEDGE, (),
        ("in", (8, 0, -4), (-4, 0, 0), pair(2, None)),
        ("touching-the-edge", (-4, 0, 4), (4, 0, -4), touch(1)),
        ("along-the-edge", (0, -4, 0), (0, 4, 0), ALWAYS),
        ("down", (-4, 0, 8), (0, 0, -4), pair(2, None))),
    *bench("all-but", "everything less a sphere", ALL_BUT, (),
        ("through", *RISE, None), ("level", (-8, 0, 0), (4, 0, 0), spans((0, 1), (3, None))),
        ("inside", (0, 0, 0), (0, 4, 0), pair(1, None)), ("tangent", (-8, 4, 0), (4, 0, 0), ALWAYS),
    ),
    *bench("cross", "two crossing tubes", CROSS, (),
        ("through-both", (-8, 0, 0), (4, 0, 0), pair(1, 3)), ("along-one", *RISE, ALWAYS),
        ("in-both-walls", (4, 0, -8), (0, 0, 4), ALWAYS), ("skew", (-8, 8, 8), (4, -4, -4), None)),
    *bench("tunnel", "a slab less a tube", TUNNEL, SHARED,
        ("level", (-8, 0, 0), (4, 0, 0), spans((0, 1), (3, None))),
        ("in-the-slab-face", (-8, 0, 4), (4, 0, 0), ALWAYS), ("down", (0, 0, 8), (0, 0, -4), MISS),
        ("down-the-tangent", (4, 0, 8), (0, 0, -4), pair(1, 3))),
)  # fmt: skip

# Starts on z = 4, in the middle of a stack of cylinders, and at its wall: for each tree the list.
STACKS: tuple[tuple[str, str, Node], ...] = (
    ("stack", "two stacked cylinders", any_of(drum(0, 4), drum(4, 8))),
    ("cap", "the cap they share", all_of(drum(0, 4), drum(4, 8))),
    ("upper", "the upper half left over", less(drum(0, 8), drum(0, 4))),
    ("waist", "a cylinder less its middle", less(drum(0, 8), drum(2, 6))),
)
SEAMS: tuple[tuple[str, Exact, Exact, tuple[Pairs, Pairs, Pairs, Pairs]], ...] = (
    ("up", (1, 2, 4), (0, 0, 2), (pair(0, 2), touch(0), pair(0, 2), pair(1, 2))),
    ("down", (1, 2, 4), (0, 0, -2), (pair(0, 2), touch(0), MISS, pair(1, 2))),
    ("level", (0, 0, 4), (2, 0, 0), (pair(0, 2), pair(0, 2), MISS, MISS)),
    ("slanted", (0, 0, 4), (2, 0, 2), (pair(0, 2), touch(0), pair(0, 2), pair(1, 2))),
    ("wall-out", (4, 0, 4), (2, 0, 0), (touch(0), touch(0), MISS, MISS)),
    ("wall-in", (4, 0, 4), (-4, 0, 0), (pair(0, 2), pair(0, 2), MISS, MISS)),
    ("wall-up", (4, 0, 4), (0, 0, 4), (pair(0, 1), touch(0), pair(0, 1), spans(("1/2", 1)))),
    ("wall-tangent", (4, 0, 4), (0, 4, 0), (touch(0), touch(0), MISS, MISS)),
    ("rest", (1, 2, 4), (0, 0, 0), (ALWAYS, ALWAYS, MISS, MISS)),
    ("rest-on-wall", (4, 0, 4), (0, 0, 0), (ALWAYS, ALWAYS, MISS, MISS)),
    ("rest-above", (1, 2, 7), (0, 0, 0), (ALWAYS, MISS, ALWAYS, ALWAYS)),
)


def _on_seams() -> Iterator[Shot]:
    for slug, origin, direction, lists in SEAMS:
        flag = "start-on-surface" if any(direction) else "zero-direction"
        for (name, text, shape), known in zip(STACKS, lists, strict=True):
            yield Shot(f"{name}-{slug}",
                       f"A ray starts at the seam, {slug.replace('-', ' ')}: {text}", shape, origin,
                       direction, known, flags=(flag,))  # fmt: skip


def _near_faces(fmt: Format) -> Iterator[Shot]:
    """Yield starts just off the inner face of a shell of radii 2 and 1, along x."""
    shell, lens = less(ball(2), ball(1)), all_of(ball(2, -1), ball(2, 1))
    stack = any_of(drum(0, 1, 1), drum(1, 2, 1))
    for slug, depth, text, inside in beside(fmt):
        x = near(fmt, 1 + depth)
        gap, over = max(1 - x, Fraction(0)), max(x - 1, Fraction(0))
        back = pair(1 + x, 2 + x) if inside else spans((0, over), (1 + x, 2 + x))
        at: Exact = (x, 0, 0)
        for shot in table(
            ("shell-out", "the inner face of a shell, outward", shell, at, (1, 0, 0),
             pair(gap, 2 - x)),
            ("shell-in", "the inner face of a shell, inward", shell, at, (-1, 0, 0), back),
            ("lens", "the rim of a lens, inward", lens, at, (-1, 0, 0), pair(over, 1 + x),
             SEVENTHS),
            ("seam", "the seam of a stack, down", stack, (0, 0, x), (0, 0, -1), pair(0, x)),
        ):  # fmt: skip
            yield shot.named(f"{{}}-{slug}", text)


HALVES = (ball(4, -4), ball(4, 4))
TWIN, HOLLOWED = less(drum(0, 8), drum(0, 8)), less(ball(8), ball(4))
CORE = less(ball(8), less(ball(4), ball(2)))
RESTS = table(
    ("in-a-union", "in one of two parts", any_of(*HALVES), (3, 1, 0), REST, ALWAYS),
    ("beside-a-union", "beside two parts", any_of(*HALVES), (0, 3, 0), REST, MISS),
    ("at-a-touch", "where two spheres touch, united", any_of(*HALVES), (0, 0, 0), REST, ALWAYS),
    ("at-a-touch-and", "where two spheres touch, intersected", all_of(*HALVES), (0, 0, 0), REST,
     ALWAYS),
    ("at-a-touch-less", "where two spheres touch, subtracted", less(*HALVES), (0, 0, 0), REST,
     MISS),
    ("in-the-first", "in the first part only", less(*HALVES), (-3, 1, 0), REST, ALWAYS),
    ("in-the-second", "in the part taken away", less(*HALVES), (3, 1, 0), REST, MISS),
    ("in-a-hole", "in a hole", HOLLOWED, (1, 2, 3), REST, MISS),
    ("on-a-hole", "on the face of a hole", HOLLOWED, (0, 4, 0), REST, MISS),
    ("on-the-outside", "on the outside of a hollow", HOLLOWED, (0, 8, 0), REST, ALWAYS),
    ("in-itself", "in a part less itself", TWIN, (1, 2, 3), REST, MISS),
    ("deep", "in a core three deep", CORE, (1, 0, 0), REST, ALWAYS),
    ("deep-on", "on a core three deep", CORE, (0, 2, 0), REST, ALWAYS),
)  # fmt: skip


FAMILIES = (
    _at("csg-shared-faces", "Cylinders with walls and caps in common.", DRUMS, one_frame),
    _at("csg-touching", "Solids that touch from outside, at a point or a line.", TOUCHES,
        one_frame),
    _at("csg-on-a-plane", "A sphere on a plane: one point in common.", ON_A_PLANE),
    _at("csg-in-a-tube", "A sphere and the tube it fills: a circle.", IN_A_TUBE),
    _at("csg-tube", "Cylinder less cylinder: the bore, the wall, the ends.", TUBES, one_frame),
    _at("csg-shell", "Sphere less sphere.", SHELLS),
    _at("csg-nested", "One part inside the other.", NESTS, one_frame),
    _at("csg-touching-inside", "One part inside the other, touching it.", KISSES),
    family("csg-many", "Rows, combs and chains: up to 13 intervals.", tuple(_rows())),
    family("csg-onion", "Each part less the next smaller one.", tuple(_onions()),
           flags=("deep-tree", *MANY)),
    family("csg-endless", "Parts that never end: all of space, planes, wedges.", ENDLESS,
           flags=("endless",), frame=one_frame),
    family("csg-start-shared", "Starts on faces that two parts share.", tuple(_on_seams()),
           flags=SHARED, frame=one_frame),
    family("csg-start-near", "Starts just off a face inside a tree.", _near_faces,
           flags=("start-near-surface",), tier="stiff"),
    family("csg-rest", "A ray that stays at rest in a tree.", RESTS,
           "A ray with no direction rests {}", ("zero-direction",), frame=drawn(1, 1)),
)  # fmt: skip
