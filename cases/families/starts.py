"""Starts: inside, on each face, just below and above it, and past the solid."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import ALIGNED, SEVENTHS, UPRIGHT, Exact, Frame, frames_for
from raycert.cases.families.ladders import depths
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
    times,
    touch,
    tube,
)
from raycert.cases.formats import Format

DRUM = cylinder(4, 8)
WIDE = cylinder(5, 8)

INSIDE: tuple[tuple[str, str, Body, Exact, Exact, Pairs], ...] = (
    ("centre-up", "the centre, up the axis", DRUM, (0, 0, 4), (0, 0, 2), pair(0, 2)),
    ("centre-down", "the centre, down the axis", DRUM, (0, 0, 4), (0, 0, -1), pair(0, 4)),
    ("centre-across", "the centre, square to the axis", DRUM, (0, 0, 4), (2, 0, 0), pair(0, 2)),
    ("centre-to-wall", "the centre, slanted to the wall", DRUM, (0, 0, 4), (4, 0, 3), pair(0, 1)),
    ("centre-to-cap", "the centre, slanted to a cap", DRUM, (0, 0, 4), (1, 0, -2), pair(0, 2)),
    ("centre-to-rim", "the centre, to the rim", DRUM, (0, 0, 4), (2, 0, 2), pair(0, 2)),
    ("beside-to-wall", "a point off the axis", WIDE, (0, 3, 2), (4, 0, 3), pair(0, 1)),
    ("beside-back", "a point off the axis, against x", WIDE, (2, -3, 2), (-3, 0, 0), pair(0, 2)),
    ("tube-centre", "the axis of a tube", tube(4), (0, 0, -9), (2, 0, 5), pair(0, 2)),
    ("tube-beside", "a point in a tube", tube(5), (0, 3, 99), (2, 0, -5), pair(0, 2)),
    ("slab-up", "a slab, to q", slab(8), (7, -5, 2), (1, 1, 3), pair(0, 2)),
    ("slab-down", "a slab, to p", slab(8), (7, -5, 2), (4, 1, -1), pair(0, 2)),
    ("half-space-out", "a half-space, outward", half_space(), (5, 6, -3), (1, 1, 1), pair(0, 3)),
    ("half-space-in", "a half-space, inward", half_space(), (5, 6, -3), (1, 1, -1), pair(0, None)),
)


def _inside(fmt: Format) -> Iterator[Case]:
    for slug, text, body, origin, direction, known in INSIDE:
        for frame in frames_for(slug, aligned=2, oblique=1):
            yield row(
                fmt,
                slug,
                f"A ray starts inside: {text}",
                body,
                origin,
                direction,
                frame=frame,
                flags=("start-inside",),
                known=known,
            )


OUT = touch(0)
SURFACE: tuple[tuple[str, str, Body, Exact, Exact, Pairs], ...] = (
    ("wall-out", "the wall, outward", DRUM, (4, 0, 4), (2, 0, 0), OUT),
    ("wall-in", "the wall, inward", DRUM, (4, 0, 4), (-2, 0, 0), pair(0, 4)),
    ("wall-along", "the wall, along the axis", DRUM, (4, 0, 4), (0, 0, 2), pair(0, 2)),
    ("wall-around", "the wall, tangent", DRUM, (4, 0, 4), (0, 2, 0), OUT),
    ("wall-slanted-out", "the wall, outward and up", DRUM, (4, 0, 4), (3, 0, 4), OUT),
    ("wall-slanted-in", "the wall, inward and up", DRUM, (4, 0, 2), (-4, 0, 3), pair(0, 2)),
    ("skew-wall-out", "the wall at (3, 4), outward", WIDE, (3, 4, 4), (3, 4, 0), OUT),
    ("skew-wall-in", "the wall at (3, 4), inward", WIDE, (3, 4, 4), (-3, 0, 1), pair(0, 2)),
    ("skew-wall-helix", "the wall at (3, 4), a climbing tangent", WIDE, (3, 4, 4), (4, -3, 1), OUT),
    ("cap-q-out", "the cap of q, outward", DRUM, (1, 2, 8), (0, 0, 2), OUT),
    ("cap-q-in", "the cap of q, inward", DRUM, (1, 2, 8), (0, 0, -2), pair(0, 4)),
    ("cap-q-along", "the cap of q, in its plane", DRUM, (0, 0, 8), (2, 0, 0), pair(0, 2)),
    ("cap-q-slanted-out", "the cap of q, outward and aside", DRUM, (1, 2, 8), (3, 1, 1), OUT),
    ("cap-p-out", "the cap of p, outward", DRUM, (1, -2, 0), (0, 0, -1), OUT),
    ("cap-p-in", "the cap of p, inward", DRUM, (1, -2, 0), (0, 0, 1), pair(0, 8)),
    ("cap-p-along", "the cap of p, in its plane", WIDE, (0, 3, 0), (-2, 0, 0), pair(0, 2)),
    ("cap-p-slanted-in", "the cap of p, inward and aside", DRUM, (0, 0, 0), (2, 0, 3), pair(0, 2)),
    ("rim-out", "the rim of q, outward", DRUM, (4, 0, 8), (1, 0, 1), OUT),
    ("rim-in", "the rim of q, to that of p", DRUM, (4, 0, 8), (-4, 0, -4), pair(0, 2)),
    ("rim-up-the-wall", "the rim of p, up the wall", DRUM, (4, 0, 0), (0, 0, 4), pair(0, 2)),
    ("rim-down", "the rim of p, down the wall's line", DRUM, (4, 0, 0), (0, 0, -4), OUT),
    ("rim-across", "the rim of q, across the cap", DRUM, (4, 0, 8), (-4, 0, 0), pair(0, 2)),
    ("rim-away", "the rim of q, away in the cap plane", DRUM, (4, 0, 8), (4, 0, 0), OUT),
    ("rim-tangent", "the rim of q, along its tangent", DRUM, (4, 0, 8), (0, 4, 0), OUT),
    ("rim-over", "the rim of q, over the cap", DRUM, (4, 0, 8), (-1, 0, 1), OUT),
    ("rim-skew-in", "the rim of p at (3, 4)", WIDE, (3, 4, 0), (-3, -4, 3), pair(0, 2)),
    ("tube-out", "the wall of a tube, outward", tube(4), (0, -4, 4), (0, -2, 0), OUT),
    ("tube-in", "the wall of a tube, inward", tube(4), (0, -4, 4), (0, 4, 0), pair(0, 2)),
    ("tube-along", "the wall of a tube, along it", tube(4), (0, -4, 4), (0, 0, -1), pair(0, None)),
    ("tube-slanted-in", "the wall of a tube, a chord", tube(5), (-4, 3, 4), (4, 0, 9), pair(0, 2)),
)


def _on_surface(fmt: Format) -> Iterator[Case]:
    for slug, text, body, origin, direction, known in SURFACE:
        rim = ("rim",) if slug.startswith("rim") else ()
        for frame in frames_for(slug, aligned=2, oblique=1):
            yield row(
                fmt,
                slug,
                f"A ray starts on {text}",
                body,
                origin,
                direction,
                frame=frame,
                flags=("start-on-surface", *rim),
                known=known,
            )


Move = tuple[str, str, Exact, Exact, Pairs | None]


def _moves(x: Fraction, z: Fraction, inside: bool) -> Iterator[Move]:
    """Yield rays from beside the wall, at radius x, and from beside the cap, at height z."""
    wall: Exact = (x, 0, 2)
    cap: Exact = (Fraction(1, 4), 0, z)
    over, up = max(x - 1, Fraction(0)), max(z - 4, Fraction(0))
    yield "wall-out", "the wall, outward", wall, (1, 0, 0), pair(0, 1 - x) if inside else MISS
    yield "wall-in", "the wall, inward", wall, (-1, 0, 0), pair(over, 1 + x)
    yield "wall-up", "the wall, up", wall, (0, 0, 1), pair(0, 2) if inside else MISS
    yield "wall-around", "the wall, around", wall, (0, 1, 0), None if inside else MISS
    yield "cap-out", "the cap, outward", cap, (0, 0, 1), pair(0, 4 - z) if inside else MISS
    yield "cap-in", "the cap, inward", cap, (0, 0, -1), pair(up, z)
    aside = pair(0, Fraction(1, 4)) if inside else MISS
    yield "cap-aside", "the cap, aside", cap, (3, 0, 0), aside


def _below_surface(fmt: Format) -> Iterator[Case]:
    """Yield starts just inside and just outside r = 1, 0 <= z <= 4, in the exact rounded place."""
    body = cylinder(1, 4)
    for size, depth in depths(fmt):
        for side, sign in (("below", -1), ("above", 1)):
            x = Fraction(fmt.nearest(float(1 + sign * depth)))
            z = Fraction(fmt.nearest(float(4 + sign * depth)))
            inside = sign < 0
            for name, where, origin, direction, known in _moves(x, z, inside):
                yield row(
                    fmt,
                    f"{name}-{side}-{size}",
                    f"A ray starts {size} radii {side} {where}",
                    body,
                    origin,
                    direction,
                    tier="stiff",
                    flags=("start-near-surface",) + (("start-inside",) if inside else ()),
                    known=known,
                )


BEHIND: tuple[tuple[str, str, Body, Exact, Exact], ...] = (
    ("across", "a cylinder crossed square to its axis", DRUM, (0, 0, 4), (4, 0, 0)),
    ("along", "a cylinder crossed along its axis", DRUM, (1, 2, 4), (0, 0, 4)),
    ("slanted", "a cylinder crossed on a slant", WIDE, (0, 3, 4), (4, 0, 3)),
    ("rim", "a cylinder met at the rim", DRUM, (4, 0, 8), (4, 0, -2)),
    ("tangent", "a cylinder touched", DRUM, (0, 4, 4), (4, 0, 0)),
    ("tube", "an infinite cylinder crossed", tube(5), (0, 3, 4), (4, 0, 3)),
    ("slab", "a slab crossed", slab(8), (0, 3, 4), (4, 0, 3)),
    ("half-space", "a half-space left", half_space(), (0, 3, -2), (1, 2, 3)),
)


def _behind(fmt: Format) -> Iterator[Case]:
    for slug, text, body, through, direction in BEHIND:
        frames: tuple[Frame, ...] = (*ALIGNED[1:3], UPRIGHT, SEVENTHS)
        for past, far in ((5, "just past"), (200, "far past")):
            for frame in frames[:3] if past == 5 else frames[2:]:
                yield row(
                    fmt,
                    f"{slug}-{far.replace(' ', '-')}",
                    f"The start is {far} {text}",
                    body,
                    plus(through, direction, past),
                    direction,
                    frame=frame,
                    flags=("behind",),
                    known=MISS,
                )
    for slug, text, body, through, direction in BEHIND[:6]:
        yield row(
            fmt,
            f"{slug}-turned-round",
            f"The ray turned round meets {text}",
            body,
            plus(through, direction, 5),
            times(-1, direction),
            frame=SEVENTHS,
        )


FAMILIES = (
    Family("start-inside", "Starts inside: the list begins at 0.", _inside),
    Family("start-on-surface", "Starts on wall, cap and rim, in every sense.", _on_surface),
    Family("start-near-surface", "Starts just below and above a face: self-hits.", _below_surface),
    Family("behind", "What lies at t < 0 is cut off.", _behind),
)
