"""Spheres from afar, displaced, and so large that the ray starts close to them."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import SEVENTHS, THIRDS, UPRIGHT, Exact, Frame, Number
from raycert.cases.families.ladders import decades
from raycert.cases.families.shapes import Ball, ball, scene
from raycert.cases.families.sketch import MISS, Pairs, near, pair, plus, ten, times, touch, two
from raycert.cases.formats import Format

QUARTER = Fraction(1, 4)
Aim = tuple[str, str, Ball, Exact, Exact, tuple[Number, Number], Frame]
AIMS: tuple[Aim, ...] = (
    ("centre", "through the centre", ball(1), (0, 0, 0), (1, 0, 0), (-1, 1), UPRIGHT),
    ("slanted", "on a slant through the centre", ball(7), (0, 0, 0), (2, 3, 6), (-1, 1), THIRDS),
    ("3-fifths", "3/5 of a radius off the centre", ball(5), (0, 3, 0), (4, 0, 0), (-1, 1), THIRDS),
    ("4-fifths", "4/5 of a radius off the centre", ball(5), (0, 4, 0), (3, 0, 0), (-1, 1), UPRIGHT),
    ("2-thirds", "sqrt(8)/3 off the centre", ball(3), (2, 2, 0), (0, 0, 1), (-1, 1), SEVENTHS),
)


def _far(fmt: Format) -> Iterator[Case]:
    for k in decades(fmt):
        distance = ten(k)
        for name, text, body, target, direction, (enter, leave), frame in AIMS:
            yield scene(
                fmt,
                f"{name}-1e{k}",
                f"From 1e{k} steps away, a ray meets a sphere {text}",
                body,
                plus(target, direction, -distance),
                direction,
                frame=frame,
                tier="stiff",
                flags=("far",),
                known=pair(distance + enter, distance + leave),
            )
        yield scene(
            fmt,
            f"segment-1e{k}",
            f"A direction 1e{k} radii long reaches the centre at t = 1",
            ball(5),
            times(-5 * distance, (3, 0, 4)),
            times(5 * distance, (3, 0, 4)),
            tier="stiff",
            flags=("far", "direction-scale"),
            known=pair(1 - 1 / (5 * distance), 1 + 1 / (5 * distance)),
        )


def _grazing(fmt: Format) -> Iterator[Case]:
    reach = 2 * fmt.precision // 5
    for k in decades(fmt):
        distance = ten(k)
        shapes: tuple[tuple[str, str, Fraction, Pairs | None, str], ...] = (
            ("tangent", "exactly tangent", Fraction(1), touch(distance), "tangent"),
            ("inside", f"2^-{reach} inside tangency", 1 - two(-reach), None, "near-tangent"),
            ("outside", f"2^-{reach} outside tangency", 1 + two(-reach), MISS, "near-tangent"),
            ("twentieth", "0.95 radii off the centre", near(fmt, Fraction(19, 20)), None, "far"),
            ("wide", "a quarter radius wide", 1 + QUARTER, MISS, "far"),
        )
        for name, text, offset, known, flag in shapes:
            yield scene(
                fmt,
                f"{name}-1e{k}",
                f"From 1e{k} radii away, a ray is {text}",
                ball(1),
                (-distance, offset, 0),
                (1, 0, 0),
                frame=UPRIGHT if name != "wide" else SEVENTHS,
                tier="stiff",
                flags=("far", flag) if flag != "far" else ("far",),
                known=known,
            )
        yield scene(
            fmt,
            f"tangent-skew-1e{k}",
            f"From 1e{k} steps away, a ray touches a sphere at (1, 2, 2)",
            ball(3),
            plus((1, 2, 2), (2, 1, -2), -distance),
            (2, 1, -2),
            tier="stiff",
            flags=("far", "tangent"),
            known=touch(distance),
        )


def _displaced(fmt: Format) -> Iterator[Case]:
    shots: tuple[tuple[str, str, Ball, Exact, Exact, Pairs], ...] = (
        ("centre", "through the centre", ball(1), (-3, 0, 0), (1, 0, 0), pair(2, 4)),
        ("chord", "down a chord", ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3)),
        ("tangent", "along a tangent", ball(3), (-3, 0, 6), (2, 1, -2), touch(2)),
        ("inside", "from inside", ball(5), (0, 3, 0), (0, 0, 2), pair(0, 2)),
    )
    for k in decades(fmt):
        place = UPRIGHT.moved((3 * ten(k), -2 * ten(k), ten(k)))
        for name, text, body, origin, direction, known in shots:
            yield scene(
                fmt,
                f"{name}-1e{k}",
                f"A ray goes {text} of a sphere, 1e{k} from the coordinate origin",
                body,
                origin,
                direction,
                frame=place,
                tier="stiff",
                flags=("displaced",) + (("tangent",) if name == "tangent" else ()),
                known=known,
            )


def _large(fmt: Format) -> Iterator[Case]:
    """Yield spheres of radius 1e1 to 1e12 about (0, 0, -radius), seen from one step away."""
    for k in decades(fmt):
        r = ten(k)
        globe = ball(r, 0, 0, -r)
        shots: tuple[tuple[str, str, Exact, Exact, Pairs | None], ...] = (
            ("down", "falls straight onto", (0, 0, 1), (0, 0, -1), pair(1, 1 + 2 * r)),
            ("up", "rises straight from", (0, 0, 0), (0, 0, 1), touch(0)),
            ("level", "runs one step above", (-r, 0, 1), (1, 0, 0), MISS),
            ("slanted", "falls on a slant onto", (0, 0, 1), (4, 0, -3), None),
            ("dip", "starts one step below", (0, 0, -1), (1, 0, 0), None),
        )
        for name, text, origin, direction, known in shots:
            yield scene(
                fmt,
                f"{name}-1e{k}",
                f"A ray {text} a sphere of radius 1e{k}",
                globe,
                origin,
                direction,
                tier="stiff",
                flags=("large",) + (("start-on-surface",) if name == "up" else ()),
                known=known,
            )


FAMILIES = (
    Family("sphere-far", "Far starts aimed through a sphere.", _far),
    Family("sphere-far-grazing", "Far starts that graze a sphere.", _grazing),
    Family("sphere-displaced", "Ray and sphere far from the coordinate origin.", _displaced),
    Family("sphere-large", "Spheres of a planet's size, seen from close by.", _large),
)
