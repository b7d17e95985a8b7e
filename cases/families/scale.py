"""Scale: short and long directions, small and large scenes, and the ends of the range."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family, Tier
from raycert.cases.families.frames import SEVENTHS, UPRIGHT, Exact, Frame
from raycert.cases.families.ladders import is_double, power, scales
from raycert.cases.families.sketch import (
    MISS,
    Body,
    Pairs,
    cylinder,
    half_space,
    pair,
    row,
    slab,
    times,
    touch,
    tube,
    two,
)
from raycert.cases.formats import Format

Scene = tuple[str, str, Body, Exact, Exact, Pairs, Frame]
SCENES: tuple[Scene, ...] = (
    ("slanted", "a slanted chord", cylinder(5, 16), (-8, 3, 5), (4, 0, 3), pair(1, 3), UPRIGHT),
    (
        "oblique",
        "an oblique cylinder",
        cylinder(5, 16),
        (-8, 3, 5),
        (4, 0, 3),
        pair(1, 3),
        SEVENTHS,
    ),
    ("inside", "a start inside", cylinder(5, 16), (0, 3, 2), (4, 0, 3), pair(0, 1), UPRIGHT),
    ("axial", "a ray along the axis", cylinder(4, 8), (1, 2, -4), (0, 0, 4), pair(1, 3), UPRIGHT),
    ("tangent", "a tangent", cylinder(4, 8), (-8, 4, 2), (4, 0, 0), touch(2), UPRIGHT),
    ("tube", "a tube", tube(5), (-8, 3, 5), (4, 0, 3), pair(1, 3), SEVENTHS),
    ("slab", "a slab", slab(8), (3, 1, -8), (3, 0, 4), pair(2, 4), UPRIGHT),
    ("half-space", "a half-space", half_space(0, 4), (3, 1, 8), (3, 0, -4), pair(2, None), UPRIGHT),
    ("miss", "a near miss", tube(4), (-8, 5, 5), (4, 0, 3), MISS, UPRIGHT),
)
FLAGS_OF = {"tangent": ("tangent",), "axial": ("parallel",), "inside": ("start-inside",)}


def slower(known: Pairs, factor: Fraction) -> Pairs:
    """Return the answer for a direction `factor` times as long."""
    return tuple(
        (None if a is None else a / factor, None if b is None else b / factor) for a, b in known
    )


def _scene(
    fmt: Format,
    scene: Scene,
    slug: str,
    text: str,
    *,
    scene_factor: Fraction = Fraction(1),
    speed: Fraction = Fraction(1),
    tier: Tier = "stiff",
    flags: tuple[str, ...] = (),
) -> Case:
    """Return a scene with all lengths times `scene_factor`, and the direction times `speed` too."""
    name, what, body, origin, direction, known, frame = scene
    return row(
        fmt,
        f"{name}-{slug}",
        f"{text}: {what}",
        body,
        origin,
        times(speed, direction),
        frame=frame.scaled(scene_factor),
        tier=tier,
        flags=(*FLAGS_OF.get(name, ()), *flags),
        known=slower(known, speed),
    )


def _directions(fmt: Format) -> Iterator[Case]:
    for k in scales(fmt, 40, 12, 8, 4):
        if k == 0:
            continue
        for scene in SCENES:
            text = f"The direction is 2^{k} times as long"
            yield _scene(fmt, scene, power(k), text, speed=two(k), flags=("direction-scale",))


def _scenes(fmt: Format) -> Iterator[Case]:
    for k in scales(fmt, 100, 15, 20, 5):
        if k == 0:
            continue
        for scene in SCENES:
            text = f"Every length is 2^{k} times as long"
            yield _scene(fmt, scene, power(k), text, scene_factor=two(k), flags=("scene-scale",))


def range_exponents(fmt: Format) -> tuple[int, ...]:
    """Return the exponents beyond the scales that count for a level."""
    if is_double(fmt):
        return (120, 150, 170, 200, 255, 300, 340, 400, 500, 531, 700, 1000)
    return (20, 24, 28, 31, 36, 40, 48, 60, 63, 75, 100, 120)


def _range_scenes(fmt: Format) -> Iterator[Case]:
    for end in range_exponents(fmt):
        for k, flag in ((end, "overflow"), (-end, "underflow")):
            for scene in (SCENES[0], SCENES[1], SCENES[4]):
                yield _scene(
                    fmt,
                    scene,
                    f"scene-{power(k)}",
                    f"Every length is 2^{k} times as long",
                    scene_factor=two(k),
                    tier="range",
                    flags=("scene-scale", flag),
                )


def _range_directions(fmt: Format) -> Iterator[Case]:
    for end in range_exponents(fmt)[::2]:
        for k, flag in ((end, "overflow"), (-end, "underflow")):
            for scene in (SCENES[0], SCENES[3], SCENES[5], SCENES[6]):
                yield _scene(
                    fmt,
                    scene,
                    f"direction-{power(k)}",
                    f"The direction is 2^{k} times as long",
                    speed=two(k),
                    tier="range",
                    flags=("direction-scale", flag),
                )
    yield from _beyond(fmt)


def _beyond(fmt: Format) -> Iterator[Case]:
    """Yield endpoints beyond the largest number, and below the smallest."""
    top, bottom = fmt.overflow, fmt.least
    far, slow = two(top - 4), two(4 - top)
    for scene in (SCENES[0], SCENES[2], SCENES[6], SCENES[7]):
        yield _scene(
            fmt,
            scene,
            "endpoints-overflow",
            "Endpoints lie beyond the largest number",
            scene_factor=two(top // 2),
            speed=two(2 - top),
            tier="range",
            flags=("overflow", "direction-scale"),
        )
        yield _scene(
            fmt,
            scene,
            "endpoints-vanish",
            "Endpoints lie below the smallest number",
            scene_factor=two(bottom // 2 + 20),
            speed=two(-bottom - 40),
            tier="range",
            flags=("underflow", "direction-scale"),
        )
    yield row(
        fmt,
        "plane-far-slow",
        "The largest distance at the smallest speed ends beyond the largest number",
        half_space(0),
        (0, 0, -far),
        (0, 0, slow),
        tier="range",
        flags=("overflow",),
        known=pair(0, far / slow),
    )


def _subnormal(fmt: Format) -> Iterator[Case]:
    unit = two(fmt.least)
    for scene in SCENES:
        yield _scene(
            fmt,
            scene,
            "smallest-unit",
            "Every length is a few of the smallest numbers",
            scene_factor=unit,
            tier="range",
            flags=("subnormal", "scene-scale"),
        )
        yield _scene(
            fmt,
            scene,
            "partly-subnormal",
            "Lengths are about the smallest normal number",
            scene_factor=two(fmt.least + fmt.precision - 3),
            tier="range",
            flags=("subnormal", "scene-scale"),
        )
        yield _scene(
            fmt,
            scene,
            "subnormal-direction",
            "The direction is subnormal",
            speed=unit,
            tier="range",
            flags=("subnormal", "direction-scale"),
        )


FAMILIES = (
    Family("direction-scale", "|direction| from 2^-40 to 2^40.", _directions),
    Family("scene-scale", "Scenes from 2^-100 to 2^100 times their size.", _scenes),
    Family("range-scenes", "Scenes whose squares leave the range.", _range_scenes),
    Family("range-directions", "Directions whose squares leave the range.", _range_directions),
    Family("range-subnormal", "Scenes and directions of subnormal numbers.", _subnormal),
)
