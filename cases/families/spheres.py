"""Spheres: each row of Problem 1 with the vectors unbarred, and tangents, exact and almost."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.case_table import chord, diameter
from raycert.cases.families.frames import (
    ALIGNED,
    FIFTHS,
    SEVENTHS,
    UPRIGHT,
    Exact,
    Frame,
    frames_for,
)
from raycert.cases.families.infinite import SPANS, TOUCHES
from raycert.cases.families.ladders import gaps, power
from raycert.cases.families.shapes import Ball, ball, scene
from raycert.cases.families.sketch import ALWAYS, MISS, Pairs, pair, plus, times, touch, two
from raycert.cases.formats import Format

RESTS: tuple[tuple[str, str, Ball, Exact, bool], ...] = (
    ("centre", "at the centre of a sphere", ball(4), (0, 0, 0), True),
    ("inside", "inside a sphere", ball(4), (1, 2, 3), True),
    ("pole", "on a sphere, straight above its centre", ball(4), (0, 0, 4), True),
    ("skew", "on a sphere, at (1, 2, 2)", ball(3), (1, 2, 2), True),
    ("corner", "beside a sphere, inside its cube", ball(4), (3, 3, 3), False),
    ("outside", "outside a sphere", ball(4), (0, 0, 5), False),
)


def _placed(slug: str, aligned: int, oblique: int) -> Iterator[Frame]:
    """Yield frames drawn by a name, every second one away from the coordinate origin."""
    for i, frame in enumerate(frames_for(slug, aligned, oblique)):
        yield frame.moved((8, -16, 4)) if (i + len(slug)) % 2 else frame


def _rows(fmt: Format) -> Iterator[Case]:
    for when, (t1, t2) in SPANS.items():
        for make in (chord, diameter):
            one = make(t1, t2)
            slug = f"{one.name}-{when}"
            text = f"A ray meets a sphere {one.text.replace('axis', 'centre')}"
            for frame in _placed(slug, 2, 1):
                yield scene(
                    fmt,
                    slug,
                    f"{text}, at t = {t1} and t = {t2}",
                    ball(one.radius),
                    (one.x, one.y, 0),
                    (one.vx, 0, 0),
                    frame=frame,
                    flags=_flags(t1, t2),
                    known=MISS if one.span is None else (one.span,),
                )
    yield from _misses(fmt)
    yield from _at_rest(fmt)


def _flags(t1: int, t2: int) -> tuple[str, ...]:
    if t2 < 0:
        return ("behind",)
    if t1 == 0 or t2 == 0:
        return ("start-on-surface",)
    return ("start-inside",) if t1 < 0 else ()


def _misses(fmt: Format) -> Iterator[Case]:
    for slug, text, origin, direction, flags in (
        ("wide", "passes wide of a sphere", (-8, 5, 0), (4, 0, 0), ()),
        ("corner", "passes a sphere, through its cube", (-8, 3, 3), (4, 0, 0), ()),
        ("receding", "moves away, its line wide of a sphere", (8, 5, 1), (4, 0, 1), ("behind",)),
        ("away", "moves straight away from a sphere", (0, 6, 0), (0, 2, 0), ("behind",)),
    ):
        for frame in _placed(slug, 1, 2):
            yield scene(
                fmt,
                f"miss-{slug}",
                f"A ray {text}",
                ball(4),
                origin,
                direction,
                frame=frame,
                flags=flags,
                known=MISS,
            )


def _at_rest(fmt: Format) -> Iterator[Case]:
    for slug, where, body, origin, inside in RESTS:
        on = ("start-on-surface",) if slug in ("pole", "skew") else ()
        for frame in _placed(slug, 1, 1):
            yield scene(
                fmt,
                f"rest-{slug}",
                f"A ray with no direction rests {where}",
                body,
                origin,
                (0, 0, 0),
                frame=frame,
                flags=("zero-direction", *on),
                known=ALWAYS if inside else MISS,
            )


CONTACTS: tuple[tuple[int, int, int, int], ...] = (
    (3, 4, 0, 5),
    (1, 2, 2, 3),
    (2, 3, 6, 7),
    (1, 4, 8, 9),
    (2, 6, 9, 11),
    (3, 4, 12, 13),
)
"""Points of touch (x, y, z) on spheres of a whole radius: Pythagorean quadruples."""


def tangents(contact: tuple[int, int, int]) -> tuple[tuple[str, Exact], ...]:
    """Return directions square to a point of touch, and a word for each."""
    x, y, z = contact
    return (("level", (y, -x, 0)), ("rising", (0, z, -y)), ("skew", (y - z, z - x, x - y)))


def _tangents(fmt: Format) -> Iterator[Case]:
    yield from _straight_tangents(fmt)
    for x, y, z, radius in CONTACTS:
        for word, direction in tangents((x, y, z)):
            if direction == (0, 0, 0):
                continue
            for when, t in TOUCHES.items():
                slug = f"{word}-at-{x}-{y}-{z}-{when}"
                behind = ("behind",) if t < 0 else ()
                for frame in frames_for(slug, 0, 2 if t > 0 else 1):
                    yield scene(
                        fmt,
                        slug,
                        f"A {word} tangent touches a sphere at ({x}, {y}, {z}), at t = {t}",
                        ball(radius),
                        plus((x, y, z), direction, -t),
                        direction,
                        frame=frame,
                        tier="stiff",
                        flags=("tangent", *behind) + (() if t else ("start-on-surface",)),
                        known=touch(t) if t >= 0 else MISS,
                    )


def _straight_tangents(fmt: Format) -> Iterator[Case]:
    """Yield tangents along coordinate axes."""
    for frame in ALIGNED:
        for when, t in TOUCHES.items():
            yield scene(
                fmt,
                f"straight-{when}",
                f"A ray along a coordinate axis touches a sphere at t = {t}",
                ball(4),
                (-4 * t, 4, 0),
                (4, 0, 0),
                frame=frame,
                flags=("tangent",) + {2: (), 0: ("start-on-surface",), -2: ("behind",)}[t],
                known=touch(t) if t >= 0 else MISS,
            )


def _gap(fmt: Format) -> Iterator[Case]:
    for k in gaps(fmt):
        for side, sign in (("inside", -1), ("outside", 1)):
            yield scene(
                fmt,
                f"{side}-{power(-k)}",
                f"A ray passes 2^-{k} radii {side} tangency to a sphere",
                ball(1),
                (-2, 1 + sign * two(-k), 0),
                (1, 0, 0),
                tier="stiff",
                flags=("near-tangent",),
                known=MISS if sign > 0 else None,
            )
    for k in range(2, fmt.precision - 6, 8):
        for side, sign in (("inside", -1), ("outside", 1)):
            for frame in (UPRIGHT, SEVENTHS if k % 16 else FIFTHS):
                yield scene(
                    fmt,
                    f"skew-{side}-{power(-k)}",
                    f"A ray passes 2^-{k} radii {side} tangency to a sphere at (1, 2, 2)",
                    ball(3),
                    plus(times(1 + sign * two(-k), (1, 2, 2)), (2, 1, -2), -2),
                    (2, 1, -2),
                    frame=frame,
                    tier="stiff",
                    flags=("near-tangent",),
                    known=MISS if sign > 0 else None,
                )


def _leaning(fmt: Format) -> Iterator[Case]:
    """Yield starts on r = 1, along a tangent turned by 2^-k: a chord near 2^(1-k)."""
    for k in gaps(fmt, 5):
        lean = two(-k)
        length = Fraction(2 * lean, 1 + lean * lean)
        shapes: tuple[tuple[str, int, Pairs], ...] = (
            ("in", -1, pair(0, length)),
            ("out", 1, touch(0)),
        )
        for way, sign, known in shapes:
            yield scene(
                fmt,
                f"leaning-{way}-{power(-k)}",
                f"A tangent turned {way}ward by 2^-{k} starts on a sphere",
                ball(1),
                (0, 1, 0),
                (1, sign * lean, 0),
                tier="stiff",
                flags=("near-tangent", "start-on-surface"),
                known=known,
            )


FAMILIES = (
    Family("sphere-rows", "Each row of Problem 1, the axis shrunk to the centre.", _rows),
    Family("sphere-tangent", "The discriminant is zero, on and off the axes.", _tangents),
    Family("sphere-tangent-gap", "The discriminant is almost zero, on both sides.", _gap),
    Family("sphere-tangent-start", "Starts on a sphere, almost along a tangent.", _leaning),
)
