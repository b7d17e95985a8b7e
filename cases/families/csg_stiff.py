"""Trees that are far, thin, very small or very large."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import SEVENTHS, THIRDS, UPRIGHT, Exact, Frame
from raycert.cases.families.ladders import decades, depths, power, scales
from raycert.cases.families.scale import range_exponents, slower
from raycert.cases.families.shapes import (
    Node,
    all_of,
    any_of,
    ball,
    below,
    layer,
    less,
    pipe,
    rod,
    scene,
    spans,
)
from raycert.cases.families.sketch import Pairs, pair, plus, ten, times, touch, two
from raycert.cases.families.stretches import shifted_from
from raycert.cases.formats import Format

Z8: tuple[Exact, Exact] = ((0, 0, -8), (0, 0, 8))
TUBE = less(rod(*Z8, 5), rod(*Z8, 3))
DUMBBELL = any_of(ball(3, -6), rod((-6, 0, 0), (6, 0, 0), 1), ball(3, 6))
LENS = all_of(ball(5, 0, 0, 3), ball(5, 0, 0, -3))
DRILLED = less(ball(5), pipe(*Z8, 3), pipe((-8, 0, 0), (8, 0, 0), 3))

# Trees, the point aimed at, the direction, and the list of t counted from that point.
Aim = tuple[str, str, Node, Exact, Exact, tuple[tuple[int, int], ...], Frame]
AIMS: tuple[Aim, ...] = (
    ("tube", "a tube", TUBE, (0, 0, 0), (1, 0, 0), ((-5, -3), (3, 5)), UPRIGHT),
    ("tube-beside", "a tube, beside the bore", TUBE, (0, 4, 0), (3, 0, 0), ((-1, 1),), SEVENTHS),
    ("dumbbell", "a dumbbell, end on", DUMBBELL, (0, 0, 0), (1, 0, 0), ((-9, 9),), THIRDS),
    ("balls", "two spheres", any_of(ball(3, -6), ball(3, 6)), (0, 0, 0), (1, 0, 0),
     ((-9, -3), (3, 9)), UPRIGHT),
    ("drilled", "a drilled sphere", DRILLED, (0, 4, 0), (3, 0, 0), ((-1, 1),), SEVENTHS),
    ("edge-of-two", "two spheres, 24/25 of a radius off the centre",
     any_of(ball(25), ball(25, 0, -60)), (0, 24, 0), (7, 0, 0), ((-1, 1),), UPRIGHT),
    ("edge-of-rest", "a bored sphere, 24/25 of a radius off the centre",
     less(ball(25), rod((0, 0, -60), (0, 0, 60), 20)), (0, 24, 0), (7, 0, 0), ((-1, 1),), UPRIGHT),
    ("edge-of-both", "a sphere within a cylinder, 24/25 of a radius off the centre",
     all_of(ball(25), rod((0, 0, -60), (0, 0, 60), 25)), (0, 24, 0), (7, 0, 0), ((-1, 1),),
     UPRIGHT),
    ("bore", "a tube, down the bore", TUBE, (1, 1, 0), (0, 0, 4), (), UPRIGHT),
)  # fmt: skip


def _far(fmt: Format) -> Iterator[Case]:
    for k in decades(fmt):
        distance = ten(k)
        for name, text, shape, target, direction, stays, frame in AIMS:
            start = plus(target, direction, -distance)
            known = spans(*((distance + a, distance + b) for a, b in stays))
            yield scene(
                fmt,
                f"{name}-1e{k}",
                f"From 1e{k} steps away, a ray meets {text}",
                shape,
                start,
                direction,
                frame=frame,
                tier="stiff",
                flags=("far",),
                known=known,
            )


def _thin(fmt: Format) -> Iterator[Case]:
    """Yield shells, tubes, plates and lids whose walls are 1e-1 to 1e-12 thick."""
    for name, thickness in (("1e-1", Fraction(fmt.nearest(0.1))), *depths(fmt)):
        inner = Fraction(fmt.nearest(float(1 - thickness)))
        wall = 1 - inner
        plate = layer((0, 0, 0), (0, 0, wall))
        scenes: tuple[tuple[str, str, Node, Exact, Exact, Pairs | None, Frame], ...] = (
            ("shell", "a spherical shell", less(ball(1), ball(inner)), (-3, 0, 0), (1, 0, 0),
             spans((2, 2 + wall), (4 - wall, 4)), UPRIGHT),
            ("shell-inside", "a spherical shell, from its centre", less(ball(1), ball(inner)),
             (0, 0, 0), (0, 0, 1), pair(inner, 1), SEVENTHS),
            ("shell-tangent", "a shell, tangent to its hole", less(ball(1), ball(inner)),
             (-3, inner, 0), (1, 0, 0), None, UPRIGHT),
            ("tube", "a tube", less(rod(*Z8, 1), rod(*Z8, inner)), (-3, 0, 1), (1, 0, 0),
             spans((2, 2 + wall), (4 - wall, 4)), UPRIGHT),
            ("plate", "a plate with a hole", less(plate, pipe(*Z8, 1)), (-3, 0, -1), (1, 0, 1),
             pair(1, 1 + wall), UPRIGHT),
            ("lid", "a lid on a cylinder",
             any_of(rod((0, 0, -1), (0, 0, 0), 1), rod((0, 0, 0), (0, 0, wall), 1)),
             (0, 0, 2), (0, 0, -1), pair(2 - wall, 3), UPRIGHT),
        )  # fmt: skip
        for slug, text, shape, origin, direction, known, frame in scenes:
            yield scene(
                fmt,
                f"{slug}-{name}",
                f"A ray meets {text}, {name} thick",
                shape,
                origin,
                direction,
                frame=frame,
                tier="stiff",
                flags=("thin-wall",),
                known=known,
            )


SCENES: tuple[tuple[str, str, Node, Exact, Exact, Pairs], ...] = (
    ("union", "the union of a sphere and a cylinder", any_of(ball(5), rod(*Z8, 4)),
     (-8, 3, 0), (4, 0, 0), pair(1, 3)),
    ("intersection", "the intersection of sphere and half-space",
     all_of(ball(5), below((0, 0, 0), (2, 0, 0))), (-8, 3, 0), (4, 0, 0), pair(1, 2)),
    ("difference", "the difference of two spheres", less(ball(25), ball(17)),
     (-32, 15, 0), (4, 0, 0), spans((3, 6), (10, 13))),
    ("touching", "two spheres that touch", all_of(ball(4, -4), ball(4, 4)),
     (-12, 0, 0), (4, 0, 0), touch(3)),
)  # fmt: skip


def _scaled(fmt: Format, ends: tuple[int, ...], which: str) -> Iterator[Case]:
    """Yield SCENES with lengths (`size`) or the direction (`speed`) 2^k times as long."""
    for k in ends:
        far = abs(k) > (100 if fmt.precision > 24 else 15)
        size, speed = (two(k), Fraction(1)) if which == "size" else (Fraction(1), two(k))
        words = "Every length" if which == "size" else "The direction"
        flags = ["scene-scale" if which == "size" else "direction-scale"]
        if far:
            flags.append("overflow" if k > 0 else "underflow")
        for name, text, shape, origin, direction, known in SCENES:
            yield scene(
                fmt,
                f"{name}-{which}-{power(k)}",
                f"{words} is 2^{k} times as long: {text}",
                shape,
                origin,
                times(speed, direction),
                frame=UPRIGHT.scaled(size),
                tier="range" if far else "stiff",
                flags=tuple(flags),
                known=slower(known, speed),
            )


def _scale(fmt: Format) -> Iterator[Case]:
    directions, scenes = scales(fmt, 40, 12, 20, 6), scales(fmt, 100, 15, 50, 5)
    yield from _scaled(fmt, tuple(k for k in directions if k), "speed")
    yield from _scaled(fmt, tuple(k for k in scenes if k), "size")


def _range(fmt: Format) -> Iterator[Case]:
    ends = range_exponents(fmt)[1::3]
    yield from _scaled(fmt, tuple(s * k for k in ends for s in (1, -1)), "size")
    yield from _scaled(fmt, tuple(s * k for k in ends[1::2] for s in (1, -1)), "speed")


def _displaced(fmt: Format) -> Iterator[Case]:
    for k in decades(fmt):
        place = UPRIGHT.moved((3 * ten(k), -2 * ten(k), ten(k)))
        for name, text, shape, target, direction, stays, _ in (AIMS[0], AIMS[4]):
            yield scene(
                fmt,
                f"{name}-1e{k}",
                f"A ray meets {text}, 1e{k} from the coordinate origin",
                shape,
                plus(target, direction, -10),
                direction,
                frame=place,
                tier="stiff",
                flags=("displaced",),
                known=shifted_from(spans(*stays), 10),
            )


FAMILIES = (
    Family("csg-far", "Trees from 1e1 to 1e12 steps away.", _far),
    Family("csg-thin", "Trees with walls from 1e-1 to 1e-12 thick.", _thin),
    Family("csg-displaced", "Trees far from the coordinate origin.", _displaced),
    Family("csg-scale", "Trees very small and very large.", _scale),
    Family("range-csg", "Trees whose squares leave the range.", _range),
)
