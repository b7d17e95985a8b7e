"""Tangents: exact ones, ones missed and met by a small gap, and starts on the point of touch."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import ALIGNED, FIFTHS, UPRIGHT, frames_for
from raycert.cases.families.ladders import gaps, power
from raycert.cases.families.sketch import MISS, Pairs, cylinder, pair, plus, row, touch, tube, two
from raycert.cases.formats import Format

CONTACTS = ((3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25))
"""Pythagorean points (x, y) of touch on circles of a whole radius."""
MIDDLE = 4
"""The height of a touch between the caps, which are at 0 and 8."""


def _exact(fmt: Format) -> Iterator[Case]:
    yield from _on_the_lattice(fmt)
    for x, y, radius in CONTACTS:
        for climb, how in ((0, "level"), (1, "climbing")):
            contact, direction = (x, y, MIDDLE), (y, -x, climb)
            slug = f"{how}-at-{x}-{y}"
            for body in (tube(radius), cylinder(radius, 8)):
                name = f"{body.word}-{slug}"
                for frame in frames_for(name, aligned=1, oblique=2):
                    yield row(
                        fmt,
                        name,
                        f"A {how} tangent at ({x}, {y}) touches {body.noun} of radius {radius}",
                        body,
                        plus(contact, direction, -2),
                        direction,
                        frame=frame,
                        tier="stiff",
                        flags=("tangent",),
                        known=touch(2),
                    )


def _on_the_lattice(fmt: Format) -> Iterator[Case]:
    """Yield tangents along coordinate axes: ahead, at the start, behind, beyond the caps."""
    places: tuple[tuple[str, str, int, Pairs], ...] = (
        ("ahead", "ahead of the start", -8, touch(2)),
        ("behind", "behind the start", 8, MISS),
    )
    for frame in ALIGNED:
        for name, text, x, known in places:
            for body in (tube(4), cylinder(4, 8)):
                yield row(
                    fmt,
                    f"{body.word}-straight-{name}",
                    f"A ray along a coordinate axis has its touch of {body.noun} {text}",
                    body,
                    (x, 4, MIDDLE),
                    (4, 0, 0),
                    frame=frame,
                    flags=("tangent", "perpendicular") + (("behind",) if x > 0 else ()),
                    known=known,
                )
        yield row(
            fmt,
            "cylinder-straight-above",
            "A tangent to the wall one unit above the cap touches nothing",
            cylinder(4, 8),
            (-8, 4, 9),
            (4, 0, 0),
            frame=frame,
            flags=("tangent", "perpendicular"),
            known=MISS,
        )


def _gap(fmt: Format) -> Iterator[Case]:
    for k in gaps(fmt):
        bodies = (tube(1, 4), cylinder(1, 4)) if k % 4 == 0 else (cylinder(1, 4),)
        for side, sign in (("inside", -1), ("outside", 1)):
            offset = 1 + sign * two(-k)
            known = MISS if sign > 0 else None
            for body in bodies:
                yield row(
                    fmt,
                    f"{body.word}-{side}-{power(-k)}",
                    f"A ray passes 2^-{k} radii {side} tangency to {body.noun}",
                    body,
                    (-2, offset, 2),
                    (1, 0, 0),
                    tier="stiff",
                    flags=("near-tangent", "perpendicular"),
                    known=known,
                )
    yield from _skew_gap(fmt)


def _skew_gap(fmt: Format) -> Iterator[Case]:
    """Yield climbing rays past (3, 4) times 1 -+ 2^-k, as far as the products have room."""
    for k in range(1, fmt.precision - 6, 3):
        for side, sign in (("inside", -1), ("outside", 1)):
            share = 1 + sign * two(-k)
            yield row(
                fmt,
                f"skew-{side}-{power(-k)}",
                f"A climbing ray passes 2^-{k} radii {side} tangency at (3, 4)",
                cylinder(5, 16),
                (3 * share - 8, 4 * share + 6, 2),
                (4, -3, 3),
                frame=UPRIGHT if k % 2 else FIFTHS,
                tier="stiff",
                flags=("near-tangent",),
                known=MISS if sign > 0 else None,
            )


def _start(fmt: Format) -> Iterator[Case]:
    for x, y, radius in ((0, 4, 4), *CONTACTS):
        for climb, how in ((0, "level"), (2, "climbing")):
            for turn, way in ((1, "clockwise"), (-1, "counterclockwise")):
                slug = f"{way}-{how}-at-{x}-{y}"
                for body in (tube(radius), cylinder(radius, 8)):
                    for frame in frames_for(f"{body.word}-{slug}", 1, int(climb > 0)):
                        yield row(
                            fmt,
                            f"{body.word}-{slug}",
                            f"A {how} {way} tangent of {body.noun} starts at ({x}, {y})",
                            body,
                            (x, y, MIDDLE),
                            (turn * y, -turn * x, climb),
                            frame=frame,
                            tier="stiff",
                            flags=("tangent", "start-on-surface"),
                            known=touch(0),
                        )
    yield from _leaning_start(fmt)


def _leaning_start(fmt: Format) -> Iterator[Case]:
    """Yield starts on the wall r = 1, along a tangent turned by 2^-k: a chord near 2^(1-k)."""
    for k in gaps(fmt, 5):
        lean = two(-k)
        chord = Fraction(2 * lean, 1 + lean * lean)
        for way, sign, known in (("in", -1, pair(0, chord)), ("out", 1, touch(0))):
            for body in (tube(1, 4), cylinder(1, 4)):
                yield row(
                    fmt,
                    f"{body.word}-leaning-{way}-{power(-k)}",
                    f"A tangent turned {way}ward by 2^-{k} starts on the wall of {body.noun}",
                    body,
                    (0, 1, 2),
                    (1, sign * lean, 0),
                    tier="stiff",
                    flags=("near-tangent", "start-on-surface"),
                    known=known,
                )


FAMILIES = (
    Family("tangent-exact", "The discriminant is zero, on and off the coordinate axes.", _exact),
    Family("tangent-gap", "The discriminant is almost zero, on both sides.", _gap),
    Family("tangent-start", "Rays that start where they touch, exactly or almost.", _start),
)
