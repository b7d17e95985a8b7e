"""Zeros: the zero direction, the zero radius, and zeros with a sign."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import Exact, frames_for
from raycert.cases.families.ladders import decades
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Body,
    Pairs,
    cylinder,
    half_space,
    near,
    pair,
    row,
    slab,
    ten,
    touch,
    tube,
)
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Ray, Slab, Solid, Vector

DRUM, WIDE = cylinder(4, 8), cylinder(5, 8)

RESTS: tuple[tuple[str, str, Body, Exact, bool], ...] = (
    ("cylinder-inside", "inside a cylinder", DRUM, (1, 2, 3), True),
    ("cylinder-on-axis", "on the axis of a cylinder", DRUM, (0, 0, 3), True),
    ("cylinder-on-wall", "on the wall of a cylinder", DRUM, (0, -4, 3), True),
    ("cylinder-on-skew-wall", "on the wall of a cylinder, at (3, 4)", WIDE, (3, 4, 3), True),
    ("cylinder-on-cap", "on a cap of a cylinder", DRUM, (1, 2, 8), True),
    ("cylinder-on-rim", "on the rim of a cylinder", WIDE, (-3, 4, 0), True),
    ("cylinder-beside", "beside a cylinder", DRUM, (3, 3, 3), False),
    ("cylinder-below", "below a cylinder", DRUM, (0, 0, -1), False),
    ("cylinder-above-rim", "above the rim of a cylinder", DRUM, (4, 0, 9), False),
    ("tube-inside", "inside an infinite cylinder", tube(4), (1, 2, 33), True),
    ("tube-on-wall", "on the wall of an infinite cylinder", tube(5), (4, -3, 33), True),
    ("tube-outside", "outside an infinite cylinder", tube(4), (0, 5, 3), False),
    ("slab-inside", "inside a slab", slab(8), (5, 6, 3), True),
    ("slab-on-plane", "on the plane of a slab", slab(8), (5, 6, 0), True),
    ("slab-outside", "outside a slab", slab(8), (5, 6, 9), False),
    ("half-space-inside", "inside a half-space", half_space(), (5, 6, -1), True),
    ("half-space-on-plane", "on the plane of a half-space", half_space(), (5, 6, 0), True),
    ("half-space-outside", "outside a half-space", half_space(), (5, 6, 1), False),
)


def _zero_direction(fmt: Format) -> Iterator[Case]:
    for slug, where, body, origin, inside in RESTS:
        surface = ("start-on-surface",) if "-on-" in slug and "axis" not in slug else ()
        for frame in frames_for(slug, aligned=1, oblique=1):
            yield row(
                fmt,
                slug,
                f"A ray with no direction rests {where}",
                body,
                origin,
                (0, 0, 0),
                frame=frame,
                flags=("zero-direction", *surface),
                known=ALWAYS if inside else MISS,
            )


LINE, STICK = tube(0), cylinder(0, 8)
THREADS: tuple[tuple[str, str, Body, Exact, Exact, Pairs], ...] = (
    ("line-crossed", "crosses a line", LINE, (-8, 0, 3), (4, 0, 0), touch(2)),
    ("line-crossed-slanted", "crosses a line on a slant", LINE, (-8, 6, 3), (4, -3, 5), touch(2)),
    ("line-passed", "passes a line", LINE, (-8, 1, 3), (4, 0, 0), MISS),
    ("line-followed", "follows a line", LINE, (0, 0, 3), (0, 0, -2), ALWAYS),
    ("line-beside", "runs beside a line", LINE, (0, 1, 3), (0, 0, 2), MISS),
    ("line-left", "starts on a line and leaves it", LINE, (0, 0, 3), (1, 2, 3), touch(0)),
    ("line-behind", "has crossed a line before its start", LINE, (8, 0, 3), (4, 0, 0), MISS),
    ("stick-crossed", "crosses a segment", STICK, (0, -8, 3), (0, 4, 0), touch(2)),
    (
        "stick-crossed-slanted",
        "crosses a segment on a slant",
        STICK,
        (-6, 8, 1),
        (3, -4, 2),
        touch(2),
    ),
    ("stick-end", "meets the end of a segment", STICK, (-8, 0, 14), (4, 0, -3), touch(2)),
    (
        "stick-end-level",
        "meets the end of a segment, level",
        STICK,
        (-8, 0, 0),
        (4, 0, 0),
        touch(2),
    ),
    ("stick-passed-over", "passes over a segment", STICK, (-8, 0, 9), (4, 0, 0), MISS),
    ("stick-followed", "follows a segment", STICK, (0, 0, -4), (0, 0, 4), pair(1, 3)),
    (
        "stick-from-inside",
        "starts on a segment and follows it",
        STICK,
        (0, 0, 4),
        (0, 0, -2),
        pair(0, 2),
    ),
    ("stick-beside", "runs beside a segment", STICK, (1, 0, -4), (0, 0, 4), MISS),
    ("stick-rest", "rests on a segment", STICK, (0, 0, 4), (0, 0, 0), ALWAYS),
)


def _zero_radius(fmt: Format) -> Iterator[Case]:
    for slug, what, body, origin, direction, known in THREADS:
        for frame in frames_for(slug, aligned=1, oblique=1):
            yield row(
                fmt,
                slug,
                f"A ray {what}, the radius being zero",
                body,
                origin,
                direction,
                frame=frame,
                tier="stiff",
                flags=("zero-radius",) + (("zero-direction",) if "rest" in slug else ()),
                known=known,
            )
    for k in decades(fmt):
        tiny = near(fmt, ten(-3 * k))
        yield row(
            fmt,
            f"stick-nearly-1e-{3 * k}",
            f"A ray crosses a cylinder of radius 1e-{3 * k} and height 8",
            cylinder(tiny, 8),
            (-tiny, 0, 3),
            (tiny, 0, 0),
            tier="stiff",
            flags=("needle",),
            known=pair(0, 2),
        )


def triple(text: str) -> Vector:
    """Return the vector of three decimals, the sign of a zero kept."""
    x, y, z = (float(word) for word in text.split())
    return (x, y, z)


BASE, UP = triple("-0 -0 -0"), triple("0 0 8")
ROUND, THREAD = Cylinder(BASE, UP, 4.0), Cylinder(BASE, UP, -0.0)
PIPE = InfiniteCylinder(BASE, UP, 4.0)
LAYER = Slab(BASE, UP)
FLOOR, FLOOR_2 = HalfSpace(BASE, triple("-0 0 1")), HalfSpace(BASE, triple("-0 -0 2"))
SIGNED: tuple[tuple[str, str, Solid, str, str, Pairs | None], ...] = (
    ("across", "the direction, square to the axis", ROUND, "-8 0 2", "4 -0 -0", pair(1, 3)),
    ("axial", "the direction, along the axis", ROUND, "1 2 -8", "-0 -0 4", pair(2, 4)),
    ("down", "the direction, down the axis", ROUND, "1 2 12", "-0 0 -4", pair(1, 3)),
    ("all-inside", "the whole direction, inside", ROUND, "1 2 3", "-0 -0 -0", ALWAYS),
    ("all-outside", "the whole direction, outside", ROUND, "5 0 3", "-0 -0 -0", MISS),
    ("base", "the origin, at the base", ROUND, "-0 -0 -0", "0 0 4", pair(0, 2)),
    ("cap-plane", "the origin, in the plane of p", ROUND, "-8 1 -0", "4 0 0", None),
    ("cap-plane-out", "the origin, leaving by p", ROUND, "1 1 -0", "0 0 -4", touch(0)),
    ("in-p", "direction and origin, in the plane of p", ROUND, "-8 -0 -0", "4 -0 -0", pair(1, 3)),
    ("in-q", "the direction, in the plane of q", ROUND, "-8 0 8", "4 0 -0", pair(1, 3)),
    ("wall", "the direction, in the wall", ROUND, "-0 4 -4", "-0 -0 4", pair(1, 3)),
    ("radius", "the radius", THREAD, "-8 0 2", "4 0 0", touch(2)),
    ("tube-along", "the direction, along a tube", PIPE, "4 -0 0", "-0 -0 -2", ALWAYS),
    ("tube-across", "the direction, across a tube", PIPE, "-8 -0 2", "4 -0 -0", pair(1, 3)),
    ("slab-level", "the direction, in a slab", LAYER, "-8 0 2", "4 -0 -0", ALWAYS),
    ("slab-in-plane", "the origin, in a slab's plane of p", LAYER, "1 1 -0", "4 0 -0", ALWAYS),
    ("slab-beyond", "the direction, beyond a slab", LAYER, "1 1 -1", "4 0 -0", MISS),
    ("plane-level", "the direction, on a plane", FLOOR, "1 2 -0", "1 0 -0", ALWAYS),
    ("plane-outside", "the direction, outside a plane", FLOOR, "1 2 1", "1 0 -0", MISS),
    ("plane-normal", "the normal, crossed", FLOOR_2, "1 2 -4", "-0 -0 2", pair(0, 2)),
)  # fmt: skip


def _signed_zero(fmt: Format) -> Iterator[Case]:
    for slug, what, solid, origin, direction, known in SIGNED:
        ray = Ray(triple(origin), triple(direction))
        yield Case(
            slug=slug,
            why=f"Zeros are negative in {what}.",
            solid=solid,
            ray=ray,
            tier="lattice" if is_lattice(solid, ray) else "generic",
            flags=("signed-zero",),
            source="oracle" if known is None else "construction",
            known=known,
        )


FAMILIES = (
    Family("zero-direction", "A ray that stays where it starts.", _zero_direction),
    Family("zero-radius", "Cylinders that are a line or a segment, or nearly.", _zero_radius),
    Family("signed-zero", "-0 is 0, wherever it stands.", _signed_zero),
)
