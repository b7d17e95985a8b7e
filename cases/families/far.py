"""Far starts: 1e1 to 1e12 radii away, aimed deep, off the axis, and grazing.

The deep rays are decisive as far up the ladder as any ray can be: a tracer that gives up with
distance is caught there, not only at the edge.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import SEVENTHS, THIRDS, UPRIGHT, Exact, Frame
from raycert.cases.families.ladders import decades
from raycert.cases.families.sketch import (
    MISS,
    Body,
    Pairs,
    cylinder,
    half_space,
    pair,
    plus,
    row,
    slab,
    ten,
    times,
    touch,
    tube,
    two,
)
from raycert.cases.formats import Format

DRUM = cylinder(1, 4)
CENTRE: Exact = (0, 0, 2)
QUARTER = Fraction(1, 4)

# Aims: what is met, from where, in which direction, and what is kept of t counted from the point
# aimed at. The start is `distance` steps of the direction before that point.
Aim = tuple[str, str, Body, Exact, Exact, tuple[Fraction | int, Fraction | int | None], Frame]
DEEP: tuple[Aim, ...] = (
    ("across", "through the axis, square to it", DRUM, CENTRE, (1, 0, 0), (-1, 1), UPRIGHT),
    (
        "slanted",
        "through the centre on a slant",
        DRUM,
        CENTRE,
        (4, 0, 3),
        (-QUARTER, QUARTER),
        SEVENTHS,
    ),
    ("along", "down the axis", DRUM, CENTRE, (0, 0, -1), (-2, 2), UPRIGHT),
    ("along-oblique", "down the axis", DRUM, CENTRE, (0, 0, -1), (-2, 2), THIRDS),
    (
        "along-beside",
        "down a parallel to the axis",
        DRUM,
        (QUARTER, QUARTER, 2),
        (0, 0, -1),
        (-2, 2),
        UPRIGHT,
    ),
    (
        "tube",
        "through the axis of a tube",
        tube(1, 4),
        CENTRE,
        (4, 0, 3),
        (-QUARTER, QUARTER),
        UPRIGHT,
    ),
    ("slab", "through a slab", slab(4), CENTRE, (4, 0, -2), (-1, 1), SEVENTHS),
    ("half-space", "into a half-space", half_space(), (0, 0, 0), (4, 0, -3), (0, None), SEVENTHS),
)


def _from_afar(fmt: Format, k: int, aim: Aim, flags: tuple[str, ...]) -> Case:
    name, text, body, target, direction, (enter, leave), frame = aim
    distance = ten(k)
    return row(
        fmt,
        f"{name}-1e{k}",
        f"From 1e{k} steps away, a ray goes {text}",
        body,
        plus(target, direction, -distance),
        direction,
        frame=frame,
        tier="stiff",
        flags=flags,
        known=pair(distance + enter, None if leave is None else distance + leave),
    )


def _deep(fmt: Format) -> Iterator[Case]:
    for k in decades(fmt):
        for aim in DEEP:
            yield _from_afar(fmt, k, aim, ("far",))
        yield row(
            fmt,
            f"segment-1e{k}",
            f"A direction 1e{k} radii long reaches from the start to the axis at t = 1",
            DRUM,
            plus(CENTRE, (4, 0, 3), -ten(k)),
            times(ten(k), (4, 0, 3)),
            tier="stiff",
            flags=("far", "direction-scale"),
            known=pair(1 - QUARTER / ten(k), 1 + QUARTER / ten(k)),
        )


OFF_AXIS = cylinder(5, 16)
TUBE = tube(5, 16)
MIDWAY = 8


def _off_axis(fmt: Format) -> Iterator[Case]:
    """Yield chords at 3/5 and 4/5 of the radius: the half chords are 4/5 and 3/5."""
    for k in decades(fmt):
        for y, half in ((3, 4), (-4, 3)):
            for body, slug in ((OFF_AXIS, "cylinder"), (TUBE, "tube")):
                climb = 0 if body is OFF_AXIS else 2
                aim: Aim = (
                    f"{slug}-{abs(y)}-fifths",
                    f"{abs(y)}/5 of a radius off the axis of {body.noun}",
                    body,
                    (0, y, MIDWAY),
                    (half, 0, climb),
                    (-1, 1),
                    UPRIGHT if y > 0 else THIRDS,
                )
                yield _from_afar(fmt, k, aim, ("far",))
        yield row(
            fmt,
            f"nineteen-twentieths-1e{k}",
            f"From 1e{k} radii away, a ray meets a chord at 0.95 of the radius",
            DRUM,
            (-ten(k), Fraction(fmt.nearest(0.95)), 2),
            (1, 0, 0),
            tier="stiff",
            flags=("far",),
        )
        yield row(
            fmt,
            f"wide-1e{k}",
            f"From 1e{k} steps away, a ray passes a quarter radius wide of the wall",
            DRUM,
            (-4 * ten(k), Fraction(5, 4), 2 - 3 * ten(k)),
            (4, 0, 3),
            frame=THIRDS,
            tier="stiff",
            flags=("far",),
            known=MISS,
        )


def _grazing(fmt: Format) -> Iterator[Case]:
    reach = 2 * fmt.precision // 5
    for k in decades(fmt):
        distance = ten(k)
        shapes: tuple[tuple[str, str, Fraction, Pairs | None, str], ...] = (
            ("tangent", "exactly tangent", Fraction(1), touch(distance), "tangent"),
            ("just-inside", f"2^-{reach} inside tangency", 1 - two(-reach), None, "near-tangent"),
            ("just-outside", f"2^-{reach} outside tangency", 1 + two(-reach), MISS, "near-tangent"),
        )
        for name, text, offset, known, flag in shapes:
            for body in (tube(1, 4), DRUM) if name == "tangent" else (DRUM,):
                yield row(
                    fmt,
                    f"{body.word}-{name}-1e{k}",
                    f"From 1e{k} radii away, a ray is {text} to {body.noun}",
                    body,
                    (-distance, offset, 2),
                    (1, 0, 0),
                    tier="stiff",
                    flags=("far", flag),
                    known=known,
                )
        yield row(
            fmt,
            f"cap-1e{k}",
            f"From 1e{k} radii away, a ray comes in the plane of the cap",
            DRUM,
            (0, distance, 4),
            (0, -1, 0),
            tier="stiff",
            flags=("far", "cap-plane"),
            known=pair(distance - 1, distance + 1),
        )


def _displaced(fmt: Format) -> Iterator[Case]:
    """Yield a cylinder far from the coordinate origin, and rays that start close to it."""
    shots: tuple[tuple[str, str, Exact, Exact, Pairs], ...] = (
        ("across", "square to the axis", (-3, 0, 2), (1, 0, 0), pair(2, 4)),
        ("along", "along the axis", (0, 0, -2), (0, 0, 1), pair(2, 6)),
        ("slanted", "on a slant", (-4, 0, -1), (4, 0, 3), pair(1 - QUARTER, 1 + QUARTER)),
    )
    for k in decades(fmt):
        place = UPRIGHT.moved((3 * ten(k), -2 * ten(k), ten(k)))
        for name, text, origin, direction, known in shots:
            yield row(
                fmt,
                f"{name}-1e{k}",
                f"A ray goes {text}, close by, 1e{k} radii from the coordinate origin",
                DRUM,
                origin,
                direction,
                frame=place,
                tier="stiff",
                flags=("displaced",),
                known=known,
            )


FAMILIES = (
    Family("displaced", "Ray and cylinder together far from the coordinate origin.", _displaced),
    Family("far-deep", "Far starts aimed through the axis, the caps and the planes.", _deep),
    Family("far-off-axis", "Far starts aimed beside the axis, and wide of the wall.", _off_axis),
    Family("far-grazing", "Far starts that graze the wall or a cap.", _grazing),
)
