"""Half-spaces and slabs: each row of Problem 2, and rays almost parallel to the planes."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import SEVENTHS, UPRIGHT, Frame, Number, frames_for
from raycert.cases.families.ladders import slopes
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Body,
    Pairs,
    between,
    half_space,
    near,
    pair,
    row,
    slab,
)
from raycert.cases.formats import Format

HEIGHT = 8
SLANTS = {"straight": (0, "straight"), "slanted": (3, "with a part along the plane")}


def _below(z: Number, vz: Number) -> Pairs:
    """Return where z + vz t <= 0."""
    if vz == 0:
        return ALWAYS if z <= 0 else MISS
    t = Fraction(-z) / vz
    if vz > 0:
        return pair(0, t) if t >= 0 else MISS
    return pair(max(t, Fraction(0)), None)


def _half_space_rows(fmt: Format) -> Iterator[Case]:
    places = {"inside": (-6, "inside"), "on": (0, "on the plane"), "outside": (5, "outside")}
    moves = {"in": (-2, "inward"), "along": (0, "along the plane"), "out": (2, "outward")}
    for place, (z, where) in places.items():
        for move, (vz, way) in moves.items():
            for slant, (vx, how) in SLANTS.items():
                vx = 4 if move == "along" and not vx else vx
                vy = 2 if move == "along" and slant == "slanted" else 0
                flags = _flags(z == 0, vz)
                slug = f"{place}-{move}-{slant}"
                for frame in frames_for(slug, aligned=2, oblique=2):
                    yield row(
                        fmt,
                        slug,
                        f"A ray starts {where} and goes {way}, {how}",
                        half_space(normal=2),
                        (1, -3, z),
                        (vx, vy, vz),
                        frame=frame,
                        flags=flags,
                        known=_below(z, vz),
                    )


def _flags(on: bool, vz: Number) -> tuple[str, ...]:
    """Return the flags of a start on a plane or off it."""
    if not on:
        return ()
    return ("start-on-surface",) if vz else ("start-on-surface", "cap-plane")


def _slab_rows(fmt: Format) -> Iterator[Case]:
    places = {
        "beyond-p": (-1, "beyond p"),
        "on-p": (0, "on the plane of p"),
        "between": (2, "between the planes"),
        "on-q": (HEIGHT, "on the plane of q"),
        "beyond-q": (HEIGHT + 1, "beyond q"),
    }
    moves = {"to-q": (2, "towards q"), "along": (0, "along the planes"), "to-p": (-2, "towards p")}
    for place, (z, where) in places.items():
        for move, (vz, way) in moves.items():
            for slant, (vx, how) in SLANTS.items():
                vx = 4 if move == "along" and not vx else vx
                vy = 2 if move == "along" and slant == "slanted" else 0
                flags = _flags(z in (0, HEIGHT), vz)
                slug = f"{place}-{move}-{slant}"
                for frame in frames_for(slug, aligned=2, oblique=1):
                    yield row(
                        fmt,
                        slug,
                        f"A ray starts {where} and goes {way}, {how}",
                        slab(HEIGHT),
                        (1, -3, z),
                        (vx, vy, vz),
                        frame=frame,
                        flags=flags,
                        known=between(z, vz, 0, HEIGHT),
                    )


def _near_parallel(fmt: Format) -> Iterator[Case]:
    for name, tilt in slopes(fmt):
        sink, rise = near(fmt, -tilt), near(fmt, tilt)
        leaning: tuple[tuple[str, str, Body, Number, Number, Pairs, Frame], ...] = (
            ("above-sinking", "sinks into", half_space(), 1, sink, _below(1, sink), UPRIGHT),
            ("below-rising", "rises out of", half_space(), -1, rise, _below(-1, rise), SEVENTHS),
            ("above-sinking", "sinks through", slab(4), 6, sink, between(6, sink, 0, 4), UPRIGHT),
            ("inside-rising", "rises out of", slab(4), 1, rise, between(1, rise, 0, 4), SEVENTHS),
        )
        for slug, what, body, start, vz, known, frame in leaning:
            yield row(
                fmt,
                f"{body.word}-{slug}-{name}",
                f"A ray {what} {body.noun} with a slope of {name}",
                body,
                (2, 1, start),
                (1, 0, vz),
                frame=frame,
                tier="stiff",
                flags=("near-parallel",),
                known=known,
            )


FAMILIES = (
    Family("half-space-rows", "The four cases of Problem 2 (c), from each side.", _half_space_rows),
    Family("slab-rows", "The seven rows of Problem 2, starts on the planes included.", _slab_rows),
    Family("planes-near-parallel", "A plane met at a vanishing angle.", _near_parallel),
)
