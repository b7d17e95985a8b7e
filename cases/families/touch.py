"""Touches: tangents, exact and by a small gap; rims; and rays that run along or in the faces."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.families.case_table import TOUCHES
from raycert.cases.families.frames import (
    ALIGNED,
    DOWN_X,
    FIFTHS,
    NINTHS,
    SEVENTHS,
    UPRIGHT,
    Exact,
    frames_for,
)
from raycert.cases.families.shots import Shot, drawn, family, gaps, power, table
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Body,
    Pairs,
    ball,
    between,
    cylinder,
    half_space,
    pair,
    slab,
    times,
    touch,
    tube,
    two,
)
from raycert.cases.formats import Format

CONTACTS = ((3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25))
"""Pythagorean points (x, y) of touch on circles of a whole radius."""
SPHERE_CONTACTS = (
    (3, 4, 0, 5), (1, 2, 2, 3), (2, 3, 6, 7), (1, 4, 8, 9), (2, 6, 9, 11), (3, 4, 12, 13),
)  # fmt: skip
"""Points of touch (x, y, z) on spheres of a whole radius: Pythagorean quadruples."""
HEIGHT, MIDDLE = 8, 4
"""The caps are at 0 and 8, and a touch between them is at 4."""
SIDES = (("inside", -1), ("outside", 1))


def _bodies(radius: int, height: int = HEIGHT) -> tuple[Body, Body]:
    return (tube(radius, height), cylinder(radius, height))


def _tangents(_: Format) -> Iterator[Shot]:
    yield from _straight_tangents()
    for x, y, radius in CONTACTS:
        for climb, how in ((0, "level"), (1, "climbing")):
            for body in _bodies(radius):
                yield Shot(f"{body.word}-{how}-at-{x}-{y}",
                           f"A {how} tangent at ({x}, {y}) touches {body.noun} of radius {radius}",
                           body, (x, y, MIDDLE), (y, -x, climb), touch(0),
                           drawn(1, 2)).back(2)  # fmt: skip


def _straight_tangents() -> Iterator[Shot]:
    """Yield tangents along coordinate axes: ahead, behind, beyond the caps."""
    places = (("ahead", "ahead of", 2, ()), ("behind", "behind", -2, ("behind",)))
    for frame in ALIGNED:
        for name, where, steps, flags in places:
            for body in _bodies(4):
                yield Shot(
                    f"{body.word}-straight-{name}",
                    f"A ray along a coordinate axis has its touch of {body.noun} {where} the start",
                    body, (0, 4, MIDDLE), (4, 0, 0), touch(0), frame, ("perpendicular", *flags),
                ).back(steps)  # fmt: skip
        yield Shot("cylinder-straight-above",
                   "A tangent to the wall one unit above the cap touches nothing", cylinder(4, 8),
                   (-8, 4, 9), (4, 0, 0), MISS, frame, ("perpendicular",))  # fmt: skip


def _gap(fmt: Format) -> Iterator[Shot]:
    for k in gaps(fmt):
        for side, sign in SIDES:
            for body in _bodies(1, 4)[k % 4 > 0 :]:
                yield Shot(f"{body.word}-{side}-{power(-k)}",
                           f"A ray passes 2^-{k} radii {side} tangency to {body.noun}",
                           body, (-2, 1 + sign * two(-k), 2), (1, 0, 0), MISS if sign > 0 else None,
                           flags=("perpendicular",))  # fmt: skip
    # Climbing rays past (3, 4) times 1 -+ 2^-k, as far as the products have room.
    for k in range(1, fmt.precision - 6, 3):
        for side, sign in SIDES:
            share = 1 + sign * two(-k)
            yield Shot(f"skew-{side}-{power(-k)}",
                       f"A climbing ray passes 2^-{k} radii {side} tangency at (3, 4)",
                       cylinder(5, 16), (3 * share - 8, 4 * share + 6, 2), (4, -3, 3),
                       MISS if sign > 0 else None, UPRIGHT if k % 2 else FIFTHS)  # fmt: skip


def _start(fmt: Format) -> Iterator[Shot]:
    for x, y, radius in ((0, 4, 4), *CONTACTS):
        for climb, how in ((0, "level"), (2, "climbing")):
            for turn, way in ((1, "clockwise"), (-1, "counterclockwise")):
                for body in _bodies(radius):
                    yield Shot(f"{body.word}-{way}-{how}-at-{x}-{y}",
                               f"A {how} {way} tangent of {body.noun} starts at ({x}, {y})", body,
                               (x, y, MIDDLE), (turn * y, -turn * x, climb), touch(0),
                               drawn(1, int(climb > 0)),
                               ("tangent", "start-on-surface"))  # fmt: skip
    for k, way, sign, known in _leaning(fmt):
        for body in _bodies(1, 4):
            yield Shot(f"{body.word}-leaning-{way}-{power(-k)}",
                       f"A tangent turned {way}ward by 2^-{k} starts on the wall of {body.noun}",
                       body, (0, 1, 2), (1, sign * two(-k), 0), known,
                       flags=("near-tangent", "start-on-surface"))  # fmt: skip


def _leaning(fmt: Format) -> Iterator[tuple[int, str, int, Pairs]]:
    """Yield the ways to turn a tangent of r = 1 by 2^-k: inward it is a chord near 2^(1-k)."""
    for k in gaps(fmt, 5):
        lean = two(-k)
        yield k, "in", -1, pair(0, 2 * lean / (1 + lean * lean))
        yield k, "out", 1, touch(0)


def tangents(x: int, y: int, z: int) -> tuple[tuple[str, Exact], ...]:
    """Return directions square to a point of touch, and a word for each."""
    return (("level", (y, -x, 0)), ("rising", (0, z, -y)), ("skew", (y - z, z - x, x - y)))


START_FLAGS: dict[int, tuple[str, ...]] = {2: (), 0: ("start-on-surface",), -2: ("behind",)}


def _sphere_tangents(_: Format) -> Iterator[Shot]:
    for frame in ALIGNED:
        for when, t in TOUCHES.items():
            text = f"A ray along a coordinate axis touches a sphere at t = {t}"
            yield Shot(f"straight-{when}", text, ball(4), (0, 4, 0), (4, 0, 0), touch(0), frame,
                       START_FLAGS[t]).back(t)  # fmt: skip
    for x, y, z, radius in SPHERE_CONTACTS:
        for word, direction in tangents(x, y, z):
            for when, t in TOUCHES.items():
                yield Shot(f"{word}-at-{x}-{y}-{z}-{when}",
                           f"A {word} tangent touches a sphere at ({x}, {y}, {z}), at t = {t}",
                           ball(radius), (x, y, z), direction, touch(0),
                           drawn(0, 2 if t > 0 else 1), START_FLAGS[t]).back(t)  # fmt: skip


def _sphere_gap(fmt: Format) -> Iterator[Shot]:
    for k in gaps(fmt):
        for side, sign in SIDES:
            yield Shot(
                f"{side}-{power(-k)}", f"A ray passes 2^-{k} radii {side} tangency to a sphere",
                ball(1), (-2, 1 + sign * two(-k), 0), (1, 0, 0), MISS if sign > 0 else None,
            )  # fmt: skip
    for k in range(2, fmt.precision - 6, 8):
        for side, sign in SIDES:
            yield Shot(f"skew-{side}-{power(-k)}",
                       f"A ray passes 2^-{k} radii {side} tangency to a sphere at (1, 2, 2)",
                       ball(3), times(1 + sign * two(-k), (1, 2, 2)), (2, 1, -2),
                       MISS if sign > 0 else None,
                       (UPRIGHT, SEVENTHS if k % 16 else FIFTHS)).back(2)  # fmt: skip


def _sphere_start(fmt: Format) -> Iterator[Shot]:
    for k, way, sign, known in _leaning(fmt):
        yield Shot(f"leaning-{way}-{power(-k)}",
                   f"A tangent turned {way}ward by 2^-{k} starts on a sphere",
                   ball(1), (0, 1, 0), (1, sign * two(-k), 0), known)  # fmt: skip


# Rays through a point of a rim; the list is counted from there.
NARROW, WIDE, BROAD = (cylinder(r, HEIGHT) for r in (4, 5, 13))
IN, OUT, AT = pair(0, 2), pair(-2, 0), touch(0)
RIMS = table(
    ("enters-p", "enters at the rim of p", NARROW, (-4, 0, 0), (4, 0, 3), IN),
    ("enters-p-low", "enters at the rim of p, flat", NARROW, (-4, 0, 0), (4, 0, 1), IN),
    ("enters-p-to-cap", "enters at the rim of p, leaves by a cap", NARROW, (-4, 0, 0), (1, 0, 4),
     IN),
    ("enters-p-skew", "enters at (3, 4) on the rim of p", WIDE, (3, 4, 0), (-3, -4, 3), IN),
    ("enters-q", "enters at the rim of q", NARROW, (-4, 0, 8), (4, 0, -3), IN),
    ("enters-q-skew", "enters at (-5, 12) on the rim of q", BROAD, (-5, 12, 8), (5, -12, -2), IN),
    ("leaves-q", "leaves at the rim of q", NARROW, (4, 0, 8), (4, 0, 3), OUT),
    ("leaves-q-from-cap", "enters by a cap, leaves at the rim of q", NARROW, (4, 0, 8), (1, 0, 4),
     OUT),
    ("leaves-p", "leaves at the rim of p", NARROW, (4, 0, 0), (4, 0, -3), OUT),
    ("leaves-p-skew", "leaves at (4, 3) on the rim of p", WIDE, (4, 3, 0), (4, 3, -3), OUT),
    ("rim-to-rim", "goes from the rim of p to that of q", NARROW, (4, 0, 8), (4, 0, 4), OUT),
    ("rim-to-rim-down", "goes from the rim of q to that of p", NARROW, (4, 0, 0), (4, 0, -4), OUT),
    ("rim-to-rim-skew", "goes between rims beside the axis", WIDE, (-3, 4, 8), (-3, 0, 4), OUT),
    ("touch-q", "touches the rim of q only, from outside", NARROW, (-4, 0, 8), (1, 0, 1), AT),
    ("touch-p", "touches the rim of p only, from outside", NARROW, (-4, 0, 0), (3, 0, -4), AT),
    ("touch-q-skew", "touches the rim of q only, at (3, 4)", WIDE, (3, 4, 8), (-3, -4, 2), AT),
    ("tangent-q", "touches the rim of q as a level tangent", NARROW, (0, 4, 8), (4, 0, 0), AT),
    ("tangent-p", "touches the rim of p as a level tangent", NARROW, (0, 4, 0), (4, 0, 0), AT),
    ("tangent-skew", "touches the rim of q as a tangent at (3, 4)", WIDE, (3, 4, 8), (4, -3, 0),
     AT),
    ("tangent-climbing", "touches the rim of q as a climbing tangent", NARROW, (0, 4, 8), (4, 0, 3),
     AT),
    ("tangent-entering", "slides down a tangent to the rim of q", NARROW, (0, 4, 8), (4, 0, -3),
     AT),
)  # fmt: skip


def _rims(_: Format) -> Iterator[Shot]:
    for rim in RIMS:
        lattice = rim.slug in ("tangent-p", "tangent-q")
        frames = ALIGNED if lattice else frames_for(rim.slug, 1, 2)
        flags = ("tangent",) if "tangent" in rim.slug else ()
        yield rim.named("{}-ahead", "{}, ahead", *flags).but(frame=frames).back(3)
        if lattice or rim.known == AT:
            behind = rim.named("{}-behind", "{}, behind", *flags, "behind")
            yield behind.but(frame=frames[:2]).back(-3)


def _near_rims(fmt: Format) -> Iterator[Shot]:
    """Yield rays that miss the rim of a cylinder with r = 1, |z| <= 1 by 2^-k, upwards."""
    body = cylinder(1, 2, -1)
    for k in gaps(fmt, 8):
        for side, sign in SIDES:
            gap, inside = sign * two(-k), sign < 0
            long = pair(2, 4) if inside else MISS
            corner = pair(2, 2 - gap) if inside else MISS
            steep = pair(-gap, 2) if inside else pair(0, 2 - gap)
            for shot in table(
                ("corner", "cuts the corner of the rim", body, (-3, 0, -1 + gap), (1, 0, 1),
                 corner),
                ("level", "runs level with the cap", body, (-3, 0, 1 + gap), (1, 0, 0), long),
                ("tangent", "touches the wall near the rim", body, (-3, 1, 1 + gap), (1, 0, 0),
                 touch(3) if inside else MISS),
                ("upright", "runs up the wall", body, (1 + gap, 0, -3), (0, 0, 1), long),
                ("steep", "leaves near the rim of q", body, (-1, 0, -1 + gap), (1, 0, 1), steep),
            ):  # fmt: skip
                frames = (UPRIGHT, DOWN_X, NINTHS) if shot.slug == "corner" else UPRIGHT
                text = f"A ray 2^-{k} {side} the rim {{}}"
                yield shot.named(f"{{}}-{side}-{power(-k)}", text).but(frame=frames)


def _in_wall(_: Format) -> Iterator[Shot]:
    for start, z in {"before": -4, "at-p": 0, "within": 2, "at-q": 8, "after": 12}.items():
        for way, speed in (("up", 2), ("down", -2)):
            for place, x, y, body in (("straight", 0, 4, NARROW), ("skew", 3, 4, WIDE)):
                yield Shot(
                    f"cylinder-{place}-{start}-{way}",
                    f"A ray {way} a {place} line of the wall starts {start.replace('-', ' ')}",
                    body, (x, y, z), (0, 0, speed), between(z, speed, 0, HEIGHT), flags=("rim",),
                )  # fmt: skip
    for x, y, radius in ((0, 4, 4), (3, 4, 5), (5, 12, 13)):
        text = f"A ray runs in the wall of an infinite cylinder at ({x}, {y})"
        yield Shot(f"tube-at-{x}-{y}", text, tube(radius), (x, y, -4), (0, 0, 2), ALWAYS)


def _in_cap_plane(_: Format) -> Iterator[Shot]:
    for cap, z in (("p", 0), ("q", HEIGHT)):
        for name, text, body, y, half in (
            ("diameter", "along a diameter", NARROW, 0, 4),
            ("chord", "along a chord", WIDE, 3, 4),
            ("tangent", "tangent to the rim", NARROW, 4, 0),
            ("beside", "beside the rim", NARROW, 5, None),
        ):
            for start, x in (("outside", -8), ("inside", 0), ("past", 8)):
                known = MISS if half is None else between(x, 4, -half, half)
                yield Shot(f"cap-{cap}-{name}-{start}",
                           f"A ray in the cap plane of {cap} runs {text}, start {start}",
                           body, (x, y, z), (4, 0, 0), known)  # fmt: skip


def _parallel(fmt: Format) -> Iterator[Shot]:
    for name, text, x, y, radius in (
        ("axis", "on the axis", 0, 0, 4),
        ("inside", "inside", 1, -2, 4),
        ("on", "on the wall", 3, 4, 5),
        ("outside", "outside", 3, 3, 4),
    ):
        for body in _bodies(radius):
            for way, start, speed in (("up", -4, 2), ("down", 12, -2), ("away", 12, 2)):
                inside = x * x + y * y <= radius * radius
                yield Shot(f"{body.word}-{name}-{way}",
                           f"A ray {text} of {body.noun} and parallel to its axis goes {way}",
                           body, (x, y, start), (0, 0, speed),
                           _run(inside, body, between(start, speed, 0, HEIGHT)), drawn(1, 1),
                           ("wall",) if name == "on" else ())  # fmt: skip
    for k in gaps(fmt, 6):
        for side, sign in SIDES:
            for body in _bodies(1, 2):
                yield Shot(f"{body.word}-{side}-{power(-k)}",
                           f"A parallel ray runs 2^-{k} radii {side} the wall of {body.noun}", body,
                           (0, 1 + sign * two(-k), -2), (0, 0, 1), _run(sign < 0, body, pair(2, 4)),
                           UPRIGHT, ("near-tangent",), "stiff")  # fmt: skip


def _run(inside: bool, body: Body, capped: Pairs) -> Pairs:
    """Return what a parallel ray keeps: nothing outside, else the run between the caps."""
    if not inside:
        return MISS
    return capped if body.kind == "cylinder" else ALWAYS


def _perpendicular(_: Format) -> Iterator[Shot]:
    heights = (("below", -1), ("on-p", 0), ("low", 1), ("middle", 4), ("on-q", 8), ("above", 10))
    for height, z in heights:
        for name, y, half, body in (
            ("centre", 0, 4, NARROW), ("beside", 3, 4, WIDE), ("wide", 6, 0, WIDE),
        ):  # fmt: skip
            for way, x, speed in (("left", 8, -4), ("right", -12, 4)):
                within = 0 <= z <= HEIGHT and half > 0
                yield Shot(
                    f"{name}-{height}-{way}",
                    f"A ray square to the axis goes {way}, {name}, {height.replace('-', ' ')}",
                    body, (x, y, z), (speed, 0, 0),
                    between(x, speed, -half, half) if within else MISS, drawn(1, 1),
                    ("cap-plane",) if z in (0, HEIGHT) else (),
                )  # fmt: skip
    for name, z, known in (("in-p", 0, ALWAYS), ("beyond", 9, MISS)):
        for body in (slab(HEIGHT), half_space(0)):
            text = f"A ray square to the normal of {body.noun} runs at height {z}"
            yield Shot(f"{body.word}-{name}", text, body, (-2, 1, z), (3, 4, 0), known,
                       flags=() if z else ("cap-plane",))  # fmt: skip


FAMILIES = (
    family("tangent-exact", "The discriminant is zero, on and off the coordinate axes.", _tangents,
           flags=("tangent",), tier="stiff"),
    family("tangent-gap", "The discriminant is almost zero, on both sides.", _gap,
           flags=("near-tangent",), tier="stiff"),
    family("tangent-start", "Rays that start where they touch, exactly or almost.", _start,
           tier="stiff"),
    family("rim", "Rims entered, left, touched, and rim to rim.", _rims, "A ray {}", ("rim",),
           tier="stiff"),
    family("rim-near", "Rims passed by a small gap on both sides.", _near_rims,
           flags=("near-rim",), tier="stiff"),
    family("in-the-wall", "Rays that lie in the curved face.", _in_wall,
           flags=("wall", "parallel"), frame=drawn(2, 1)),
    family("in-the-cap-plane", "Rays that lie in the plane of a cap.", _in_cap_plane,
           flags=("cap-plane", "rim", "perpendicular"), frame=drawn(2, 1)),
    family("parallel", "Rays parallel to the axis: inside, on and outside the wall.", _parallel,
           flags=("parallel",)),
    family("perpendicular", "Rays square to the axis, through and beyond the caps.",
           _perpendicular, flags=("perpendicular",)),
    family("sphere-tangent", "The discriminant is zero, on and off the axes.", _sphere_tangents,
           flags=("tangent",), tier="stiff"),
    family("sphere-tangent-gap", "The discriminant is almost zero, on both sides.", _sphere_gap,
           flags=("near-tangent",), tier="stiff"),
    family("sphere-tangent-start", "Starts on a sphere, almost along a tangent.", _sphere_start,
           flags=("near-tangent", "start-on-surface"), tier="stiff"),
)  # fmt: skip
