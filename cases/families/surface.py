"""Rays that run along, in or square to the faces."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import UPRIGHT, frames_for
from raycert.cases.families.ladders import gaps, power
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Body,
    Pairs,
    between,
    cylinder,
    half_space,
    pair,
    row,
    slab,
    tube,
    two,
)
from raycert.cases.formats import Format

HEIGHT = 8


def _in_wall(fmt: Format) -> Iterator[Case]:
    starts = {"before": -4, "at-p": 0, "within": 2, "at-q": 8, "after": 12}
    for start, z in starts.items():
        for way, speed in (("up", 2), ("down", -2)):
            for place, x, y, radius in (("straight", 0, 4, 4), ("skew", 3, 4, 5)):
                slug = f"cylinder-{place}-{start}-{way}"
                for frame in frames_for(slug, aligned=2):
                    yield row(
                        fmt,
                        slug,
                        f"A ray {way} a {place} line of the wall starts {start.replace('-', ' ')}",
                        cylinder(radius, HEIGHT),
                        (x, y, z),
                        (0, 0, speed),
                        frame=frame,
                        flags=("wall", "parallel", "rim"),
                        known=between(z, speed, 0, HEIGHT),
                    )
    for x, y, radius in ((0, 4, 4), (3, 4, 5), (5, 12, 13)):
        slug = f"tube-at-{x}-{y}"
        for frame in frames_for(slug, aligned=2):
            yield row(
                fmt,
                slug,
                f"A ray runs in the wall of an infinite cylinder at ({x}, {y})",
                tube(radius),
                (x, y, -4),
                (0, 0, 2),
                frame=frame,
                flags=("wall", "parallel"),
                known=ALWAYS,
            )


def _in_cap_plane(fmt: Format) -> Iterator[Case]:
    chords = (
        ("diameter", "along a diameter", 4, 0, 4, 4),
        ("chord", "along a chord", 5, 3, 4, 4),
        ("tangent", "tangent to the rim", 4, 4, 0, 4),
        ("beside", "beside the rim", 4, 5, None, 4),
    )
    for cap, z in (("p", 0), ("q", HEIGHT)):
        for name, text, radius, y, half, speed in chords:
            for start, x in (("outside", -8), ("inside", 0), ("past", 8)):
                known = MISS if half is None else between(x, speed, -half, half)
                slug = f"cap-{cap}-{name}-{start}"
                for frame in frames_for(slug, aligned=2):
                    yield row(
                        fmt,
                        slug,
                        f"A ray in the cap plane of {cap} runs {text}, start {start}",
                        cylinder(radius, HEIGHT),
                        (x, y, z),
                        (speed, 0, 0),
                        frame=frame,
                        flags=("cap-plane", "rim", "perpendicular"),
                        known=known,
                    )


def _parallel(fmt: Format) -> Iterator[Case]:
    places = (
        ("axis", "on the axis", 0, 0, 4),
        ("inside", "inside", 1, -2, 4),
        ("on", "on the wall", 3, 4, 5),
        ("outside", "outside", 3, 3, 4),
    )
    for name, text, x, y, radius in places:
        for body in (tube(radius), cylinder(radius, HEIGHT)):
            for way, start, speed in (("up", -4, 2), ("down", 12, -2), ("away", 12, 2)):
                inside = x * x + y * y <= radius * radius
                capped = between(start, speed, 0, HEIGHT)
                slug = f"{body.word}-{name}-{way}"
                for frame in frames_for(slug):
                    yield row(
                        fmt,
                        slug,
                        f"A ray {text} of {body.noun} and parallel to its axis goes {way}",
                        body,
                        (x, y, start),
                        (0, 0, speed),
                        frame=frame,
                        flags=("parallel",) + (("wall",) if name == "on" else ()),
                        known=_when(inside, body, capped),
                    )
    for k in gaps(fmt, 6):
        for side, sign in (("inside", -1), ("outside", 1)):
            for body in (tube(1, 2), cylinder(1, 2)):
                yield row(
                    fmt,
                    f"{body.word}-{side}-{power(-k)}",
                    f"A parallel ray runs 2^-{k} radii {side} the wall of {body.noun}",
                    body,
                    (0, 1 + sign * two(-k), -2),
                    (0, 0, 1),
                    frame=UPRIGHT,
                    tier="stiff",
                    flags=("parallel", "near-tangent"),
                    known=_when(sign < 0, body, pair(2, 4)),
                )


def _when(inside: bool, body: Body, capped: Pairs) -> Pairs:
    """Return what a parallel ray keeps: nothing outside, else the run between the caps."""
    if not inside:
        return MISS
    return capped if body.kind == "cylinder" else ALWAYS


def _perpendicular(fmt: Format) -> Iterator[Case]:
    heights = (("below", -1), ("on-p", 0), ("low", 1), ("middle", 4), ("on-q", 8), ("above", 10))
    for height, z in heights:
        for name, y, half, radius in (
            ("centre", 0, 4, 4),
            ("beside", 3, 4, 5),
            ("wide", 6, None, 5),
        ):
            for way, x, speed in (("left", 8, -4), ("right", -12, 4)):
                within = 0 <= z <= HEIGHT and half is not None
                slug = f"{name}-{height}-{way}"
                flags = ("perpendicular",) + (("cap-plane",) if z in (0, HEIGHT) else ())
                for frame in frames_for(slug):
                    yield row(
                        fmt,
                        slug,
                        f"A ray square to the axis goes {way}, {name}, {height.replace('-', ' ')}",
                        cylinder(radius, HEIGHT),
                        (x, y, z),
                        (speed, 0, 0),
                        frame=frame,
                        flags=flags,
                        known=between(x, speed, -(half or 0), half or 0) if within else MISS,
                    )
    for name, z, known in (("in-p", 0, ALWAYS), ("beyond", 9, MISS)):
        for body in (slab(HEIGHT), half_space(0)):
            yield row(
                fmt,
                f"{body.word}-{name}",
                f"A ray square to the normal of {body.noun} runs at height {z}",
                body,
                (-2, 1, z),
                (3, 4, 0),
                flags=("perpendicular", "cap-plane") if z == 0 else ("perpendicular",),
                known=known,
            )


FAMILIES = (
    Family("in-the-wall", "Rays that lie in the curved face.", _in_wall),
    Family("in-the-cap-plane", "Rays that lie in the plane of a cap.", _in_cap_plane),
    Family("parallel", "Rays parallel to the axis: inside, on and outside the wall.", _parallel),
    Family(
        "perpendicular", "Rays square to the axis, through and beyond the caps.", _perpendicular
    ),
)
