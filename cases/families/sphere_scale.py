"""Spheres at every scale, at the ends of the range, hard to round, and drawn at random."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family, Tier
from raycert.cases.dice import Dice
from raycert.cases.families.base_rate import COUNT, exactly
from raycert.cases.families.frames import DOWN_Z, ON_Y, SEVENTHS, UPRIGHT, Exact, Frame
from raycert.cases.families.ladders import is_double, power, scales
from raycert.cases.families.rounding import NEIGHBOURS, START, half_unit, shifts
from raycert.cases.families.scale import range_exponents, slower
from raycert.cases.families.shapes import Ball, ball, scene
from raycert.cases.families.sketch import MISS, Pairs, pair, plus, times, touch, two
from raycert.cases.formats import BINARY32, Format

Scene = tuple[str, str, Ball, Exact, Exact, Pairs, Frame]
SCENES: tuple[Scene, ...] = (
    ("chord", "a chord", ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3), UPRIGHT),
    ("oblique", "an oblique chord", ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3), SEVENTHS),
    ("inside", "a start inside", ball(3), (1, 2, 1), (0, 0, 1), pair(0, 1), UPRIGHT),
    ("tangent", "a tangent", ball(4), (-8, 4, 0), (4, 0, 0), touch(2), UPRIGHT),
    ("start", "a start on the surface", ball(3), (1, 2, 2), (0, 0, -2), pair(0, 2), UPRIGHT),
    ("miss", "a near miss", ball(4), (-8, 5, 0), (4, 0, 0), MISS, SEVENTHS),
)
FLAGS_OF = {
    "tangent": ("tangent",),
    "inside": ("start-inside",),
    "start": ("start-on-surface",),
}


def _scene(
    fmt: Format,
    what: Scene,
    slug: str,
    text: str,
    *,
    size: Fraction = Fraction(1),
    speed: Fraction = Fraction(1),
    tier: Tier = "stiff",
    flags: tuple[str, ...] = (),
) -> Case:
    """Return a scene with all lengths times `size`, and the direction times `speed` too."""
    name, noun, body, origin, direction, known, frame = what
    return scene(
        fmt,
        f"{name}-{slug}",
        f"{text}: {noun} of a sphere",
        body,
        origin,
        times(speed, direction),
        frame=frame.scaled(size),
        tier=tier,
        flags=(*FLAGS_OF.get(name, ()), *flags),
        known=slower(known, speed),
    )


def _scales(fmt: Format) -> Iterator[Case]:
    for k in scales(fmt, 40, 12, 10, 4):
        for what in SCENES if k else ():
            text = f"The direction is 2^{k} times as long"
            flags = ("direction-scale",)
            yield _scene(fmt, what, f"direction-{power(k)}", text, speed=two(k), flags=flags)
    for k in scales(fmt, 100, 15, 25, 5):
        for what in SCENES if k else ():
            text = f"Every length is 2^{k} times as long"
            flags = ("scene-scale",)
            yield _scene(fmt, what, f"scene-{power(k)}", text, size=two(k), flags=flags)


def _range(fmt: Format) -> Iterator[Case]:
    for i, end in enumerate(range_exponents(fmt)[::2]):
        for k, flag in ((end, "overflow"), (-end, "underflow")):
            for what in (SCENES[0], SCENES[3]):
                text = f"Every length is 2^{k} times as long"
                slug, flags = f"scene-{power(k)}", ("scene-scale", flag)
                yield _scene(fmt, what, slug, text, size=two(k), tier="range", flags=flags)
            for what in (SCENES[1], SCENES[2]) if i % 2 else ():
                text = f"The direction is 2^{k} times as long"
                slug, flags = f"direction-{power(k)}", ("direction-scale", flag)
                yield _scene(fmt, what, slug, text, speed=two(k), tier="range", flags=flags)
    unit = two(fmt.least)
    for what in SCENES:
        text = "Every length is a few of the smallest numbers"
        flags = ("subnormal", "scene-scale")
        yield _scene(fmt, what, "smallest-unit", text, size=unit, tier="range", flags=flags)
        text = "The direction is subnormal"
        flags = ("subnormal", "direction-scale")
        yield _scene(fmt, what, "subnormal-direction", text, speed=unit, tier="range", flags=flags)


def _rounding(fmt: Format) -> Iterator[Case]:
    for count, word in NEIGHBOURS:
        radius = 1 + count * half_unit(fmt)
        for frame in (UPRIGHT, ON_Y, DOWN_Z):
            yield _axial(fmt, f"{word}-tie", f"are {word} ties of {fmt.name}", radius, frame=frame)
        for j in shifts(fmt):
            text = f"are 2^-{2 * j}/2r beside the {word} tie"
            yield _axial(fmt, f"{word}-{power(-2 * j)}", text, radius, two(-j))
    if is_double(fmt):
        radius = 1 + half_unit(BINARY32)
        yield _axial(fmt, "binary32-tie", "are ties of binary32", radius)
        for j in (12, 20, 26, 28, 40, 100, 500):
            text = f"are 2^-{2 * j}/2r beside ties of binary32"
            yield _axial(fmt, f"binary32-{power(-2 * j)}", text, radius, two(-j))


def _axial(
    fmt: Format,
    slug: str,
    text: str,
    radius: Fraction | int,
    height: Fraction = Fraction(0),
    frame: Frame = UPRIGHT,
) -> Case:
    """Return a ray along x at this height past the centre."""
    return scene(
        fmt,
        slug,
        f"Both ends of a sphere {text}",
        ball(radius),
        (-START, height, 0),
        (1, 0, 0),
        frame=frame,
        tier="stiff",
        flags=("hard-to-round",) if height else ("tie",),
        known=None if height else pair(START - radius, START + radius),
    )


def _random(fmt: Format) -> Iterator[Case]:
    for n in range(COUNT):
        seed = f"{n:02d}"
        dice = Dice(f"sphere-{fmt.name}-{seed}")
        body = Ball(exactly(dice.vector(fmt)), Fraction(dice.real(fmt, 0.125, 1)))
        origin = exactly(dice.vector(fmt, -4, 4))
        target = plus(body.center, exactly(dice.vector(fmt, -0.75, 0.75)))
        yield scene(
            fmt,
            f"seed-{seed}",
            f"A random ray at a sphere, drawn with seed {seed}",
            body,
            origin,
            plus(target, origin, -1),
        )


FAMILIES = (
    Family("sphere-scale", "Directions and scenes from very small to very large.", _scales),
    Family("range-sphere", "Spheres and directions whose squares leave the range.", _range),
    Family(
        "sphere-rounding", "Ends of spheres halfway between two numbers, and beside.", _rounding
    ),
    Family("random-sphere", "The base rate: random rays.", _random),
)
