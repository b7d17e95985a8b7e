"""Starts: inside, on each face, just below and above it, past the solid; and rays at rest.

Beside them what is zero otherwise: a radius, and numbers with a sign.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family, Tier
from raycert.cases.families.frames import ALIGNED, SEVENTHS, UPRIGHT, Exact
from raycert.cases.families.shots import Shot, beside, decades, drawn, family, table
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Pairs,
    ball,
    cylinder,
    half_space,
    near,
    pair,
    slab,
    ten,
    times,
    touch,
    tube,
)
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Ray,
    Slab,
    Solid,
    Sphere,
    Vector,
)

DRUM = cylinder(4, 8)
WIDE = cylinder(5, 8)
ROUND, THREE, FIVE, SEVEN = ball(4), ball(3), ball(5), ball(7)
REST: Exact = (0, 0, 0)
INSIDE = table(
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
OUT = touch(0)
SURFACE = table(
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
SPHERE_SURFACE = table(
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
# These rays go through the origin at t = 0, which lies behind their start.
BEHIND = table(
    ("across", "a cylinder crossed square to its axis", DRUM, (0, 0, 4), (4, 0, 0), None),
    ("along", "a cylinder crossed along its axis", DRUM, (1, 2, 4), (0, 0, 4), None),
    ("slanted", "a cylinder crossed on a slant", WIDE, (0, 3, 4), (4, 0, 3), None),
    ("rim", "a cylinder met at the rim", DRUM, (4, 0, 8), (4, 0, -2), None),
    ("tangent", "a cylinder touched", DRUM, (0, 4, 4), (4, 0, 0), None),
    ("tube", "an infinite cylinder crossed", tube(5), (0, 3, 4), (4, 0, 3), None),
    ("slab", "a slab crossed", slab(8), (0, 3, 4), (4, 0, 3), None),
    ("half-space", "a half-space left", half_space(), (0, 3, -2), (1, 2, 3), None),
)


def _flagged(shots: tuple[Shot, ...], word: str, *flags: str) -> tuple[Shot, ...]:
    """Return the shots, those that have the word in their slug or text with these flags."""
    return tuple(
        shot.but(flags=flags) if word in f"{shot.slug} {shot.text}" else shot for shot in shots
    )


def _near_surface(fmt: Format) -> Iterator[Shot]:
    """Yield starts just inside and just outside r = 1, 0 <= z <= 4, in the exact rounded place."""
    body, quarter = cylinder(1, 4), Fraction(1, 4)
    for slug, depth, text, inside in beside(fmt):
        x, z = near(fmt, 1 + depth), near(fmt, 4 + depth)
        over, up = max(x - 1, Fraction(0)), max(z - 4, Fraction(0))
        wall: Exact = (x, 0, 2)
        cap: Exact = (quarter, 0, z)

        def known(leave: Fraction | int, inside: bool = inside) -> Pairs:
            return pair(0, leave) if inside else MISS

        for shot in table(
            ("wall-out", "the wall, outward", body, wall, (1, 0, 0), known(1 - x)),
            ("wall-in", "the wall, inward", body, wall, (-1, 0, 0), pair(over, 1 + x)),
            ("wall-up", "the wall, up", body, wall, (0, 0, 1), known(2)),
            ("wall-around", "the wall, around", body, wall, (0, 1, 0), None if inside else MISS),
            ("cap-out", "the cap, outward", body, cap, (0, 0, 1), known(4 - z)),
            ("cap-in", "the cap, inward", body, cap, (0, 0, -1), pair(up, z)),
            ("cap-aside", "the cap, aside", body, cap, (3, 0, 0), known(quarter)),
        ):
            yield shot.named(f"{{}}-{slug}", text, *(("start-inside",) if inside else ()))


def _near_sphere(fmt: Format) -> Iterator[Shot]:
    """Yield starts just inside and just outside r = 1, at the nearest number's exact place."""
    body = ball(1)
    for slug, depth, text, inside in beside(fmt):
        x = near(fmt, 1 + depth)
        start: Exact = (x, 0, 0)
        inward = pair(max(x - 1, Fraction(0)), 1 + x)
        for shot in table(
            ("out", "outward", body, start, (1, 0, 0), pair(0, 1 - x) if inside else MISS),
            ("in", "inward", body, start, (-1, 0, 0), inward, SEVENTHS),
            ("around", "around", body, start, (0, 1, 0), None if inside else MISS),
            ("slanted", "inward aside", body, start, (-3, 0, 4), None),
        ):
            yield shot.named(f"{{}}-{slug}", text.format("a sphere and goes {}"))


def _behind() -> Iterator[Shot]:
    for shot in BEHIND:
        gone = shot.but(known=MISS)
        just = gone.named("{}-just-past", "The start is just past {}", "behind").back(-5)
        yield just.but(frame=(*ALIGNED[1:3], UPRIGHT))
        far = gone.named("{}-far-past", "The start is far past {}", "behind").back(-200)
        yield far.but(frame=(UPRIGHT, SEVENTHS))
    for shot in BEHIND[:6]:
        turned = shot.back(-5).but(direction=times(-1, shot.direction), frame=SEVENTHS)
        yield turned.named("{}-turned-round", "The ray turned round meets {}")


RESTS = table(
    ("cylinder-inside", "inside a cylinder", DRUM, (1, 2, 3), REST, ALWAYS),
    ("cylinder-on-axis", "on the axis of a cylinder", DRUM, (0, 0, 3), REST, ALWAYS),
    ("cylinder-on-wall", "on the wall of a cylinder", DRUM, (0, -4, 3), REST, ALWAYS),
    ("cylinder-on-skew-wall", "on the wall of a cylinder, at (3, 4)", WIDE, (3, 4, 3), REST,
     ALWAYS),
    ("cylinder-on-cap", "on a cap of a cylinder", DRUM, (1, 2, 8), REST, ALWAYS),
    ("cylinder-on-rim", "on the rim of a cylinder", WIDE, (-3, 4, 0), REST, ALWAYS),
    ("cylinder-beside", "beside a cylinder", DRUM, (3, 3, 3), REST, MISS),
    ("cylinder-below", "below a cylinder", DRUM, (0, 0, -1), REST, MISS),
    ("cylinder-above-rim", "above the rim of a cylinder", DRUM, (4, 0, 9), REST, MISS),
    ("tube-inside", "inside an infinite cylinder", tube(4), (1, 2, 33), REST, ALWAYS),
    ("tube-on-wall", "on the wall of an infinite cylinder", tube(5), (4, -3, 33), REST, ALWAYS),
    ("tube-outside", "outside an infinite cylinder", tube(4), (0, 5, 3), REST, MISS),
    ("slab-inside", "inside a slab", slab(8), (5, 6, 3), REST, ALWAYS),
    ("slab-on-plane", "on the plane of a slab", slab(8), (5, 6, 0), REST, ALWAYS),
    ("slab-outside", "outside a slab", slab(8), (5, 6, 9), REST, MISS),
    ("half-space-inside", "inside a half-space", half_space(), (5, 6, -1), REST, ALWAYS),
    ("half-space-on-plane", "on the plane of a half-space", half_space(), (5, 6, 0), REST, ALWAYS),
    ("half-space-outside", "outside a half-space", half_space(), (5, 6, 1), REST, MISS),
)  # fmt: skip
LINE, STICK = tube(0), cylinder(0, 8)
THREADS = table(
    ("line-crossed", "crosses a line", LINE, (-8, 0, 3), (4, 0, 0), touch(2)),
    ("line-crossed-slanted", "crosses a line on a slant", LINE, (-8, 6, 3), (4, -3, 5), touch(2)),
    ("line-passed", "passes a line", LINE, (-8, 1, 3), (4, 0, 0), MISS),
    ("line-followed", "follows a line", LINE, (0, 0, 3), (0, 0, -2), ALWAYS),
    ("line-beside", "runs beside a line", LINE, (0, 1, 3), (0, 0, 2), MISS),
    ("line-left", "starts on a line and leaves it", LINE, (0, 0, 3), (1, 2, 3), touch(0)),
    ("line-behind", "has crossed a line before its start", LINE, (8, 0, 3), (4, 0, 0), MISS),
    ("stick-crossed", "crosses a segment", STICK, (0, -8, 3), (0, 4, 0), touch(2)),
    ("stick-crossed-slanted", "crosses a segment on a slant", STICK, (-6, 8, 1), (3, -4, 2),
     touch(2)),
    ("stick-end", "meets the end of a segment", STICK, (-8, 0, 14), (4, 0, -3), touch(2)),
    ("stick-end-level", "meets the end of a segment, level", STICK, (-8, 0, 0), (4, 0, 0),
     touch(2)),
    ("stick-passed-over", "passes over a segment", STICK, (-8, 0, 9), (4, 0, 0), MISS),
    ("stick-followed", "follows a segment", STICK, (0, 0, -4), (0, 0, 4), pair(1, 3)),
    ("stick-from-inside", "starts on a segment and follows it", STICK, (0, 0, 4), (0, 0, -2),
     pair(0, 2)),
    ("stick-beside", "runs beside a segment", STICK, (1, 0, -4), (0, 0, 4), MISS),
    ("stick-rest", "rests on a segment", STICK, (0, 0, 4), (0, 0, 0), ALWAYS),
)  # fmt: skip
POINT = ball(0, 0, 0, 8)  # off the coordinate origin: there, s(0) = 0 and no face would ever move
POINTS = table(
    ("met", "meets a point", POINT, (-8, 0, 8), (4, 0, 0), touch(2)),
    ("met-skew", "meets a point on a slant", POINT, (-6, 8, 12), (3, -4, -2), touch(2)),
    ("left", "starts at a point and leaves it", POINT, (0, 0, 8), (1, 2, 3), touch(0)),
    ("passed", "passes a point", POINT, (-8, 1, 8), (4, 0, 0), MISS),
    ("behind", "has met a point before its start", POINT, (8, 0, 8), (4, 0, 0), MISS),
    ("rest-on", "with no direction rests on a point", POINT, (0, 0, 8), (0, 0, 0), ALWAYS),
    ("rest-beside", "with no direction rests beside a point", POINT, (0, 0, 9), (0, 0, 0), MISS),
)


def _rests() -> Iterator[Shot]:
    for shot in RESTS:
        on = "-on-" in shot.slug and "axis" not in shot.slug
        yield shot.but(flags=("start-on-surface",) if on else ())


def _threads() -> Iterator[Shot]:
    for shot in _flagged(THREADS, "rest", "zero-direction"):
        text = "A ray {}, the radius being zero"
        yield shot.but(text=text.format(shot.text), flags=("zero-radius", *shot.flags),
                       frame=drawn(1, 1))  # fmt: skip


def _thin(fmt: Format) -> Iterator[Shot]:
    for k in decades(fmt):
        tiny, text = near(fmt, ten(-3 * k)), f"A ray crosses a cylinder of radius 1e-{3 * k}"
        yield Shot(f"stick-nearly-1e-{3 * k}", f"{text} and height 8", cylinder(tiny, 8),
                   (-tiny, 0, 3), (tiny, 0, 0), pair(0, 2), flags=("needle",))  # fmt: skip


def _points() -> Iterator[Shot]:
    for shot in _flagged(POINTS, "rest", "zero-direction"):
        text = "A ray {}: a sphere of radius zero"
        yield shot.but(text=text.format(shot.text), flags=("zero-radius", *shot.flags),
                       frame=drawn(1, int(shot.slug != "rest-on")))  # fmt: skip


def _tiny(fmt: Format) -> Iterator[Shot]:
    for k in decades(fmt):
        tiny = near(fmt, ten(-3 * k))
        yield Shot(f"nearly-1e-{3 * k}",
                   f"A ray starts on a sphere of radius 1e-{3 * k} and crosses it", ball(tiny),
                   (-tiny, 0, 0), (tiny, 0, 0), pair(0, 2),
                   flags=("scene-scale", "start-on-surface"))  # fmt: skip


def triple(text: str) -> Vector:
    """Return the vector of three decimals, the sign of a zero kept."""
    x, y, z = (float(word) for word in text.split())
    return (x, y, z)


# No sketches: in exact numbers there is no -0.
Signed = tuple[tuple[str, str, Solid, str, str, Pairs | None], ...]
ZERO, BASE, UP = triple("0 0 0"), triple("-0 -0 -0"), triple("0 0 8")
DRUM_0, THREAD = Cylinder(BASE, UP, 4.0), Cylinder(BASE, UP, -0.0)
PIPE, LAYER = InfiniteCylinder(BASE, UP, 4.0), Slab(BASE, UP)
FLOOR, FLOOR_2 = HalfSpace(BASE, triple("-0 0 1")), HalfSpace(BASE, triple("-0 -0 2"))
GLOBE, ASIDE = Sphere(ZERO, 4), Sphere(triple("4 0 0"), 4)
SIGNED: Signed = (
    ("across", "the direction, square to the axis", DRUM_0, "-8 0 2", "4 -0 -0", pair(1, 3)),
    ("axial", "the direction, along the axis", DRUM_0, "1 2 -8", "-0 -0 4", pair(2, 4)),
    ("down", "the direction, down the axis", DRUM_0, "1 2 12", "-0 0 -4", pair(1, 3)),
    ("all-inside", "the whole direction, inside", DRUM_0, "1 2 3", "-0 -0 -0", ALWAYS),
    ("all-outside", "the whole direction, outside", DRUM_0, "5 0 3", "-0 -0 -0", MISS),
    ("base", "the origin, at the base", DRUM_0, "-0 -0 -0", "0 0 4", pair(0, 2)),
    ("cap-plane", "the origin, in the plane of p", DRUM_0, "-8 1 -0", "4 0 0", None),
    ("cap-plane-out", "the origin, leaving by p", DRUM_0, "1 1 -0", "0 0 -4", touch(0)),
    ("in-p", "direction and origin, in the plane of p", DRUM_0, "-8 -0 -0", "4 -0 -0", pair(1, 3)),
    ("in-q", "the direction, in the plane of q", DRUM_0, "-8 0 8", "4 0 -0", pair(1, 3)),
    ("wall", "the direction, in the wall", DRUM_0, "-0 4 -4", "-0 -0 4", pair(1, 3)),
    ("radius", "the radius", THREAD, "-8 0 2", "4 0 0", touch(2)),
    ("tube-along", "the direction, along a tube", PIPE, "4 -0 0", "-0 -0 -2", ALWAYS),
    ("tube-across", "the direction, across a tube", PIPE, "-8 -0 2", "4 -0 -0", pair(1, 3)),
    ("slab-level", "the direction, in a slab", LAYER, "-8 0 2", "4 -0 -0", ALWAYS),
    ("slab-in-plane", "the origin, in a slab's plane of p", LAYER, "1 1 -0", "4 0 -0", ALWAYS),
    ("slab-beyond", "the direction, beyond a slab", LAYER, "1 1 -1", "4 0 -0", MISS),
    ("plane-level", "the direction, on a plane", FLOOR, "1 2 -0", "1 0 -0", ALWAYS),
    ("plane-outside", "the direction, outside a plane", FLOOR, "1 2 1", "1 0 -0", MISS),
    ("plane-normal", "the normal, crossed", FLOOR_2, "1 2 -4", "-0 -0 2", pair(0, 2)),
)
SIGNED_SPHERES: Signed = (
    ("centre", "the centre", Sphere(BASE, 4), "-8 0 0", "4 0 0", pair(1, 3)),
    ("radius", "the radius", Sphere(ZERO, -0.0), "-8 0 0", "4 0 0", touch(2)),
    ("direction", "the direction", GLOBE, "-8 0 0", "4 -0 -0", pair(1, 3)),
    ("tangent", "a tangent's direction", GLOBE, "8 4 0", "-4 -0 -0", touch(2)),
    ("start", "the start", ASIDE, "-0 -0 -0", "4 0 0", pair(0, 2)),
    ("leaving", "a start that leaves", ASIDE, "-0 -0 -0", "-4 -0 0", OUT),
    ("rest", "the whole direction", GLOBE, "1 2 3", "-0 -0 -0", ALWAYS),
)


def _signed_zero(name: str, reason: str, signed: Signed, text: str) -> Family:
    def cases(_: Format) -> Iterator[Case]:
        for slug, what, solid, origin, direction, known in signed:
            ray = Ray(triple(origin), triple(direction))
            tier: Tier = "lattice" if is_lattice(solid, ray) else "generic"
            source = "oracle" if known is None else "construction"
            why = text.format(what)
            yield Case(slug, why, solid, ray, tier, ("signed-zero",), source, known)

    return Family(name, reason, cases)


FAMILIES = (
    family("start-inside", "Starts inside: the list begins at 0.", INSIDE,
           "A ray starts inside: {}", ("start-inside",), frame=drawn(2, 1)),
    family("start-on-surface", "Starts on wall, cap and rim, in every sense.",
           _flagged(SURFACE, "rim-", "rim"), "A ray starts on {}", ("start-on-surface",),
           frame=drawn(2, 1)),
    family("start-near-surface", "Starts just below and above a face: self-hits.", _near_surface,
           flags=("start-near-surface",), tier="stiff"),
    family("behind", "What lies at t < 0 is cut off.", tuple(_behind())),
    family("zero-direction", "A ray that stays where it starts.", tuple(_rests()),
           "A ray with no direction rests {}", ("zero-direction",), frame=drawn(1, 1)),
    family("zero-radius", "Cylinders that are a line or a segment.", tuple(_threads()),
           tier="stiff"),
    family("nearly-line", "Cylinders of a radius that is next to nothing.", _thin, tier="stiff"),
    _signed_zero("signed-zero", "-0 is 0, wherever it stands.", SIGNED,
                 "Zeros are negative in {}."),
    family("sphere-start", "Starts on a sphere, in every sense.",
           _flagged(SPHERE_SURFACE, "tangent", "tangent"), "A ray starts on a sphere at {}",
           ("start-on-surface",), frame=drawn(1, 1)),
    family("sphere-start-near", "Starts just below and above a sphere: self-hits.", _near_sphere,
           flags=("start-near-surface",), tier="stiff"),
    family("sphere-point", "Spheres that are a point.", tuple(_points()), tier="stiff"),
    family("sphere-nearly-point", "Spheres of a radius that is next to nothing.", _tiny,
           tier="stiff"),
    _signed_zero("sphere-signed-zero", "-0 is 0 in a sphere too.", SIGNED_SPHERES,
                 "Zeros are negative in {}, the solid a sphere."),
)  # fmt: skip
