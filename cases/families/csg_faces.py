"""Booleans of solids that share faces: walls, caps, planes, circles, and points of touch."""

from __future__ import annotations

from raycert.cases.case import Family
from raycert.cases.families.bench import Bench, Shot, shoot, shoot_once
from raycert.cases.families.frames import Exact
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

SHARED = ("coincident-faces",)
TOUCHING = ("touching-parts",)


def drum(low: int, high: int, radius: int = 4) -> Shape:
    """Return the cylinder about z between two heights."""
    return rod((0, 0, low), (0, 0, high), radius)


WELL = pipe((0, 0, 0), (0, 0, 8), 4)
ABOVE = layer((0, 0, 4), (0, 0, 8))

# The rays of the drums: through z = 4 at t = 2, where x is 0 or the ray leaves x alone.
LOW = ((-8, 0, 2), (4, 0, 0))
SEAM = ((-8, 0, 4), (4, 0, 0))
HIGH = ((-8, 0, 6), (4, 0, 0))
AXIS = ((0, 0, -4), (0, 0, 4))
BESIDE = ((1, 2, -4), (0, 0, 4))
WALL = ((4, 0, -4), (0, 0, 4))
SLANT = ((-8, 0, -4), (4, 0, 4))
RIM = ((-8, 0, 0), (4, 0, 4))
TANGENT = ((-8, 4, 2), (4, 0, 0))
SEAM_TANGENT = ((-8, 4, 4), (4, 0, 0))
PATHS: dict[str, tuple[Exact, Exact]] = {
    "across-low": LOW,
    "across-in-the-seam-plane": SEAM,
    "across-high": HIGH,
    "along-the-axis": AXIS,
    "beside-the-axis": BESIDE,
    "in-the-wall": WALL,
    "slanted": SLANT,
    "through-the-rim": RIM,
    "tangent-low": TANGENT,
    "tangent-at-the-seam": SEAM_TANGENT,
}


def _drums(
    slug: str, text: str, shape: Node, flags: tuple[str, ...], known: tuple[Pairs, ...]
) -> Bench:
    """Return a bench of drums with the list for each of PATHS."""
    shots = tuple(
        Shot(name, *path, found) for (name, path), found in zip(PATHS.items(), known, strict=True)
    )
    return Bench(slug, text, shape, flags, shots)


ONE, TWO, AT_2 = pair(1, 3), pair(1, 2), touch(2)
DRUMS = (
    _drums(
        "stack", "two cylinders stacked into one", any_of(drum(0, 4), drum(4, 8)), SHARED,
        (ONE, ONE, ONE, ONE, ONE, ONE, ONE, pair(1, 2), AT_2, AT_2),
    ),
    _drums(
        "shared-cap", "what two stacked cylinders share", all_of(drum(0, 4), drum(4, 8)), SHARED,
        (MISS, ONE, MISS, AT_2, AT_2, AT_2, AT_2, touch(1), MISS, AT_2),
    ),
    _drums(
        "stack-less", "a cylinder less the one on it", less(drum(0, 4), drum(4, 8)), SHARED,
        (ONE, MISS, MISS, TWO, TWO, TWO, TWO, MISS, AT_2, MISS),
    ),
    _drums(
        "top-off", "a cylinder less its upper half", less(drum(0, 8), drum(4, 8)), SHARED,
        (ONE, MISS, MISS, TWO, TWO, TWO, TWO, MISS, AT_2, MISS),
    ),
    _drums(
        "sliced", "a cylinder less a slab at its cap", less(drum(0, 8), ABOVE), SHARED,
        (ONE, MISS, MISS, TWO, TWO, TWO, TWO, MISS, AT_2, MISS),
    ),
    _drums(
        "waist", "a cylinder less its middle", less(drum(0, 8), drum(3, 5)), SHARED,
        (ONE, MISS, ONE, *(spans((1, "7/4"), ("9/4", 3)),) * 4, spans(("5/4", 2)), AT_2, MISS),
    ),
    _drums(
        "plug", "an infinite cylinder less a part of it", less(WELL, drum(4, 8)), SHARED,
        (ONE, MISS, MISS, *(spans((0, 2), (3, None)),) * 3, TWO, pair(2, 3), AT_2, MISS),
    ),
    _drums(
        "respelled", "a tube cut by a slab, less that cylinder",
        less(all_of(WELL, ABOVE), drum(4, 8)), SHARED, (MISS,) * 10,
    ),
    _drums(
        "turned", "a cylinder and itself turned upside down",
        all_of(drum(0, 8), rod((0, 0, 8), (0, 0, 0), 4)), SHARED,
        (ONE, ONE, ONE, ONE, ONE, ONE, ONE, pair(1, 2), AT_2, AT_2),
    ),
)  # fmt: skip

BALLS = (ball(4, -4), ball(4, 4))
RODS = (rod((-4, 0, -4), (-4, 0, 4), 4), rod((4, 0, -4), (4, 0, 4), 4))
THROUGH: Exact = (-12, 0, 0)


def _pairs(
    slug: str, text: str, two: tuple[Shape, ...], along: Pairs, across: Pairs = AT_2
) -> tuple[Bench, ...]:
    """Return the Booleans of two solids that touch at 0, on x < 0 and x > 0.

    `along` and `across` are what rays up the z axis and along the y axis find in the second one.
    """
    both = along if slug == "rods" else touch(2)
    lists = {
        "through": (pair(1, 5), touch(3), pair(1, 3)),
        "tangent-to-both": (across, touch(2), MISS),
        "up-the-touch": (along, both, MISS),
    }
    paths: dict[str, tuple[Exact, Exact]] = {
        "through": (THROUGH, (4, 0, 0)),
        "tangent-to-both": ((0, -16, 0), (0, 8, 0)),
        "up-the-touch": ((0, 0, -8), (0, 0, 4)),
    }
    starts = (
        Shot("start-at-the-touch-out", (0, 0, 0), (0, 4, 0), None),
        Shot("start-at-the-touch-in", (0, 0, 0), (-4, 0, 0), None),
        Shot("start-at-the-touch-rest", (0, 0, 0), (0, 0, 0), None),
    )
    return tuple(
        Bench(
            f"{slug}-{name}",
            f"{text}, {name}",
            make(*two),
            TOUCHING,
            (*(Shot(p, *path, lists[p][i]) for p, path in paths.items()), *starts),
        )
        for i, (make, name) in enumerate(
            ((any_of, "united"), (all_of, "intersected"), (less, "subtracted"))
        )
    )


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
    Bench("or", "a sphere on a plane, united", any_of(BUBBLE, FLOOR), TOUCHING, (
        Shot("down", *DOWN, pair(1, None)), Shot("in-the-plane", *FLAT, ALWAYS),
        Shot("to-the-point", *POINT, None),
    )),
    Bench("and", "a sphere on a plane, intersected", all_of(BUBBLE, FLOOR), TOUCHING, (
        Shot("down", *DOWN, touch(3)), Shot("in-the-plane", *FLAT, touch(2)),
        Shot("to-the-point", *POINT, touch(1)),
    )),
    Bench("less", "a sphere less the plane below", less(BUBBLE, FLOOR), TOUCHING, (
        Shot("down", *DOWN, pair(1, 3)), Shot("in-the-plane", *FLAT, MISS),
        Shot("to-the-point", *POINT, None),
    )),
    Bench("floor-less", "the plane less a sphere on it", less(FLOOR, BUBBLE), TOUCHING, (
        Shot("down", *DOWN, pair(3, None)), Shot("in-the-plane", *FLAT, ALWAYS),
        Shot("to-the-point", *POINT, pair(1, None)),
    )),
)  # fmt: skip

SLOT = pipe((0, 0, 0), (0, 0, 8), 4)
MARBLE = ball(4)
CIRCLE = ((-8, 0, -4), (4, 0, 4))
IN_A_TUBE = (
    Bench("fill", "a tube less a sphere that fills it", less(SLOT, MARBLE), SHARED, (
        Shot("across", *FLAT, MISS), Shot("through-the-circle", *CIRCLE, pair(2, 3)),
        Shot("along", (0, 0, -12), (0, 0, 4), spans((0, 2), (4, None))),
        Shot("in-the-wall", (4, 0, -12), (0, 0, 4), ALWAYS),
        Shot("tangent", (-8, 4, 0), (4, 0, 0), MISS),
    )),
    Bench("both", "a sphere in a tube, intersected", all_of(SLOT, MARBLE), SHARED, (
        Shot("across", *FLAT, ONE), Shot("through-the-circle", *CIRCLE, TWO),
        Shot("in-the-wall", (4, 0, -12), (0, 0, 4), touch(3)),
        Shot("tangent", (-8, 4, 0), (4, 0, 0), AT_2),
    )),
    Bench("either", "a sphere in a tube, united", any_of(SLOT, MARBLE), SHARED, (
        Shot("across", *FLAT, ONE), Shot("through-the-circle", *CIRCLE, ONE),
        Shot("in-the-wall", (4, 0, -12), (0, 0, 4), ALWAYS),
        Shot("tangent", (-8, 4, 0), (4, 0, 0), AT_2),
    )),
    Bench("poke", "a sphere less the tube around it", less(MARBLE, SLOT), SHARED, (
        Shot("across", *FLAT, MISS), Shot("through-the-circle", *CIRCLE, MISS),
        Shot("tangent", (-8, 4, 0), (4, 0, 0), MISS),
    )),
)  # fmt: skip

FAMILIES = (
    Family("csg-shared-faces", "Cylinders with walls and caps in common.", shoot_once(DRUMS)),
    Family(
        "csg-touching", "Solids that touch from outside, at a point or a line.", shoot_once(TOUCHES)
    ),
    Family("csg-on-a-plane", "A sphere on a plane: one point in common.", shoot(ON_A_PLANE)),
    Family("csg-in-a-tube", "A sphere and the tube it fills: a circle.", shoot(IN_A_TUBE)),
)
