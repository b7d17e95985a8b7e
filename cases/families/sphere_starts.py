"""Spheres met from on, below and above their surface, and spheres that are a point."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import SEVENTHS, UPRIGHT, Exact, Frame, frames_for
from raycert.cases.families.ladders import decades, depths
from raycert.cases.families.shapes import Ball, ball, scene
from raycert.cases.families.sketch import ALWAYS, MISS, Pairs, near, pair, ten, touch
from raycert.cases.families.zero import triple
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Ray, Sphere

ROUND, THREE, FIVE, SEVEN = ball(4), ball(3), ball(5), ball(7)
OUT = touch(0)
SURFACE: tuple[tuple[str, str, Ball, Exact, Exact, Pairs], ...] = (
    ("pole-out", "the pole, straight out", ROUND, (0, 0, 4), (0, 0, 2), OUT),
    ("pole-in", "the pole, straight in", ROUND, (0, 0, 4), (0, 0, -2), pair(0, 4)),
    ("pole-around", "the pole, along a tangent", ROUND, (0, 0, 4), (2, 0, 0), OUT),
    ("pole-around-skew", "the pole, along a skew tangent", ROUND, (0, 0, 4), (3, -5, 0), OUT),
    ("pole-chord", "the pole, down a chord", ROUND, (0, 0, 4), (2, 0, -2), pair(0, 2)),
    ("equator-over", "the equator, outward and up", ROUND, (4, 0, 0), (1, 0, 7), OUT),
    ("at-3-4-in", "(3, 4, 0), against x", FIVE, (3, 4, 0), (-3, 0, 0), pair(0, 2)),
    ("at-3-4-out", "(3, 4, 0), along x", FIVE, (3, 4, 0), (3, 0, 0), OUT),
    ("at-3-4-across", "(3, 4, 0), through the centre", FIVE, (3, 4, 0), (-3, -4, 0), pair(0, 2)),
    ("at-3-4-tangent", "(3, 4, 0), along a tangent", FIVE, (3, 4, 0), (4, -3, 2), OUT),
    ("at-1-2-2-in", "(1, 2, 2), through the centre", THREE, (1, 2, 2), (-1, -2, -2), pair(0, 2)),
    ("at-1-2-2-out", "(1, 2, 2), straight out", THREE, (1, 2, 2), (1, 2, 2), OUT),
    ("at-1-2-2-tangent", "(1, 2, 2), along a tangent", THREE, (1, 2, 2), (2, 1, -2), OUT),
    ("at-1-2-2-down", "(1, 2, 2), down a chord", THREE, (1, 2, 2), (0, 0, -1), pair(0, 4)),
    ("at-2-3-6-in", "(2, 3, 6), down a chord", SEVEN, (2, 3, 6), (0, 0, -6), pair(0, 2)),
    ("at-2-3-6-aside", "(2, 3, 6), a chord aside", SEVEN, (2, 3, 6), (-2, 0, 0), pair(0, 2)),
    ("at-2-3-6-out", "(2, 3, 6), outward and aside", SEVEN, (2, 3, 6), (3, -1, 1), OUT),
)


def _on_surface(fmt: Format) -> Iterator[Case]:
    for slug, text, body, origin, direction, known in SURFACE:
        tangent = ("tangent",) if "tangent" in text else ()
        for frame in frames_for(slug, aligned=1, oblique=1):
            yield scene(
                fmt,
                slug,
                f"A ray starts on a sphere at {text}",
                body,
                origin,
                direction,
                frame=frame,
                flags=("start-on-surface", *tangent),
                known=known,
            )


def _near_surface(fmt: Format) -> Iterator[Case]:
    """Yield starts just inside and just outside r = 1, at the nearest number's exact place."""
    for size, depth in depths(fmt):
        for side, sign in (("below", -1), ("above", 1)):
            x = near(fmt, 1 + sign * depth)
            over, inside = x - 1, sign < 0
            start: Exact = (x, 0, 0)
            moves: tuple[tuple[str, str, Exact, Exact, Pairs | None, Frame], ...] = (
                ("out", "outward", start, (1, 0, 0), pair(0, -over) if inside else MISS, UPRIGHT),
                (
                    "in",
                    "inward",
                    start,
                    (-1, 0, 0),
                    pair(max(over, Fraction(0)), 1 + x),
                    SEVENTHS,
                ),
                ("around", "around", start, (0, 1, 0), None if inside else MISS, UPRIGHT),
                ("slanted", "inward aside", start, (-3, 0, 4), None, UPRIGHT),
            )
            for name, way, origin, direction, known, frame in moves:
                yield scene(
                    fmt,
                    f"{name}-{side}-{size}",
                    f"A ray starts {size} radii {side} a sphere and goes {way}",
                    ball(1),
                    origin,
                    direction,
                    frame=frame,
                    tier="stiff",
                    flags=("start-near-surface",),
                    known=known,
                )


POINT = ball(0, 0, 0, 8)  # off the coordinate origin: there, s(0) = 0 and no face would ever move
POINTS: tuple[tuple[str, str, Exact, Exact, Pairs], ...] = (
    ("met", "meets a point", (-8, 0, 8), (4, 0, 0), touch(2)),
    ("met-skew", "meets a point on a slant", (-6, 8, 12), (3, -4, -2), touch(2)),
    ("left", "starts at a point and leaves it", (0, 0, 8), (1, 2, 3), touch(0)),
    ("passed", "passes a point", (-8, 1, 8), (4, 0, 0), MISS),
    ("behind", "has met a point before its start", (8, 0, 8), (4, 0, 0), MISS),
    ("rest-on", "with no direction rests on a point", (0, 0, 8), (0, 0, 0), ALWAYS),
    ("rest-beside", "with no direction rests beside a point", (0, 0, 9), (0, 0, 0), MISS),
)


def _points(fmt: Format) -> Iterator[Case]:
    for slug, what, origin, direction, known in POINTS:
        for frame in frames_for(slug, aligned=1, oblique=slug != "rest-on"):
            yield scene(
                fmt,
                slug,
                f"A ray {what}: a sphere of radius zero",
                POINT,
                origin,
                direction,
                frame=frame,
                tier="stiff",
                flags=("zero-radius",) + (("zero-direction",) if "rest" in slug else ()),
                known=known,
            )
    for k in decades(fmt):
        tiny = near(fmt, ten(-3 * k))
        yield scene(
            fmt,
            f"nearly-1e-{3 * k}",
            f"A ray starts on a sphere of radius 1e-{3 * k} and crosses it",
            ball(tiny),
            (-tiny, 0, 0),
            (tiny, 0, 0),
            tier="stiff",
            flags=("scene-scale", "start-on-surface"),
            known=pair(0, 2),
        )


SIGNED: tuple[tuple[str, str, Sphere, str, str, Pairs], ...] = (
    ("centre", "the centre", Sphere(triple("-0 -0 -0"), 4), "-8 0 0", "4 0 0", pair(1, 3)),
    ("radius", "the radius", Sphere(triple("0 0 0"), -0.0), "-8 0 0", "4 0 0", touch(2)),
    ("direction", "the direction", Sphere(triple("0 0 0"), 4), "-8 0 0", "4 -0 -0", pair(1, 3)),
    ("tangent", "a tangent's direction", Sphere(triple("0 0 0"), 4), "8 4 0", "-4 -0 -0",
     touch(2)),
    ("start", "the start", Sphere(triple("4 0 0"), 4), "-0 -0 -0", "4 0 0", pair(0, 2)),
    ("leaving", "a start that leaves", Sphere(triple("4 0 0"), 4), "-0 -0 -0", "-4 -0 0", OUT),
    ("rest", "the whole direction", Sphere(triple("0 0 0"), 4), "1 2 3", "-0 -0 -0", ALWAYS),
)  # fmt: skip


def _signed_zero(fmt: Format) -> Iterator[Case]:
    for slug, what, solid, origin, direction, known in SIGNED:
        ray = Ray(triple(origin), triple(direction))
        yield Case(
            slug=slug,
            why=f"Zeros are negative in {what}, the solid a sphere.",
            solid=solid,
            ray=ray,
            tier="lattice" if is_lattice(solid, ray) else "generic",
            flags=("signed-zero",),
            source="construction",
            known=known,
        )


FAMILIES = (
    Family("sphere-start", "Starts on a sphere, in every sense.", _on_surface),
    Family("sphere-start-near", "Starts just below and above a sphere: self-hits.", _near_surface),
    Family("sphere-point", "Spheres that are a point, or nearly.", _points),
    Family("sphere-signed-zero", "-0 is 0 in a sphere too.", _signed_zero),
)
