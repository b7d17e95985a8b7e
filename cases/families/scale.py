"""Scale, from the smallest numbers to the largest; and endpoints that are hard to round.

Hard to round: a ray along x at z = 1 and height y meets the wall of radius r at
t = x0 -+ sqrt(r^2 - y^2). At y = 0 that is x0 -+ r, halfway between two numbers of the format by
the choice of r and x0. The height y = 2^-j moves it by about y^2/2r = 2^-2j/2r, up to the
thousandth bit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Literal

from raycert.cases.case import Tier
from raycert.cases.families.frames import DOWN_X, DOWN_Z, ON_Y, SEVENTHS, UPRIGHT, Exact, Number
from raycert.cases.families.shots import (
    Frames,
    Shot,
    family,
    is_double,
    ladder,
    power,
    scales,
    table,
)
from raycert.cases.families.sketch import (
    MISS,
    Ball,
    Body,
    all_of,
    any_of,
    ball,
    below,
    cylinder,
    half_space,
    less,
    pair,
    pipe,
    rod,
    slab,
    spans,
    touch,
    tube,
    two,
)
from raycert.cases.formats import BINARY32, Format

LEAVES = (
    Shot("slanted", "a slanted chord", cylinder(5, 16), (-8, 3, 5), (4, 0, 3), pair(1, 3)),
    Shot("oblique", "an oblique cylinder", cylinder(5, 16), (-8, 3, 5), (4, 0, 3), pair(1, 3),
         SEVENTHS),
    Shot("inside", "a start inside", cylinder(5, 16), (0, 3, 2), (4, 0, 3), pair(0, 1), UPRIGHT,
         ("start-inside",)),
    Shot("axial", "a ray along the axis", cylinder(4, 8), (1, 2, -4), (0, 0, 4), pair(1, 3),
         UPRIGHT, ("parallel",)),
    Shot("tangent", "a tangent", cylinder(4, 8), (-8, 4, 2), (4, 0, 0), touch(2), UPRIGHT,
         ("tangent",)),
    Shot("tube", "a tube", tube(5), (-8, 3, 5), (4, 0, 3), pair(1, 3), SEVENTHS),
    Shot("slab", "a slab", slab(8), (3, 1, -8), (3, 0, 4), pair(2, 4)),
    Shot("half-space", "a half-space", half_space(0, 4), (3, 1, 8), (3, 0, -4), pair(2, None)),
    Shot("miss", "a near miss", tube(4), (-8, 5, 5), (4, 0, 3), MISS),
)  # fmt: skip
SPHERES = (
    Shot("chord", "a chord of a sphere", ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3)),
    Shot("oblique", "an oblique chord of a sphere", ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3),
         SEVENTHS),
    Shot("inside", "a start inside of a sphere", ball(3), (1, 2, 1), (0, 0, 1), pair(0, 1),
         UPRIGHT, ("start-inside",)),
    Shot("tangent", "a tangent of a sphere", ball(4), (-8, 4, 0), (4, 0, 0), touch(2),
         UPRIGHT, ("tangent",)),
    Shot("start", "a start on the surface of a sphere", ball(3), (1, 2, 2), (0, 0, -2), pair(0, 2),
         UPRIGHT, ("start-on-surface",)),
    Shot("miss", "a near miss of a sphere", ball(4), (-8, 5, 0), (4, 0, 0), MISS, SEVENTHS),
)  # fmt: skip
TREES = (
    Shot("union", "the union of a sphere and a cylinder",
         any_of(ball(5), rod((0, 0, -8), (0, 0, 8), 4)), (-8, 3, 0), (4, 0, 0), pair(1, 3)),
    Shot("intersection", "the intersection of sphere and half-space",
         all_of(ball(5), below((0, 0, 0), (2, 0, 0))), (-8, 3, 0), (4, 0, 0), pair(1, 2)),
    Shot("difference", "the difference of two spheres", less(ball(25), ball(17)),
         (-32, 15, 0), (4, 0, 0), spans((3, 6), (10, 13))),
    Shot("touching", "two spheres that touch", all_of(ball(4, -4), ball(4, 4)),
         (-12, 0, 0), (4, 0, 0), touch(3)),
)  # fmt: skip
What = Literal["scene", "direction"]


def _scaled(
    shots: Iterable[Shot], what: What, k: int, slug: str, *flags: str, tier: Tier = "stiff"
) -> Iterator[Shot]:
    """Yield the shots with every length, or the direction, 2^k times as long."""
    subject = "Every length" if what == "scene" else "The direction"
    for shot in shots:
        scaled = shot.larger(two(k)) if what == "scene" else shot.faster(two(k))
        text = f"{subject} is 2^{k} times as long: {{}}"
        yield scaled.named(f"{{}}-{slug}", text, f"{what}-scale", *flags).but(tier=tier)


def _beyond(shots: Iterable[Shot], what: What, k: int, slug: str) -> Iterator[Shot]:
    """Yield them scaled to where squares leave the range."""
    flag = "overflow" if k > 0 else "underflow"
    return _scaled(shots, what, k, slug, flag, tier="range")


Leg = tuple[tuple[Shot, ...], What, str, tuple[int, ...]]
"""Shots, what is scaled, how a slug begins, and the steps: of `scales`, or of `ends`."""


def _ladder(*legs: Leg) -> Callable[[Format], Iterator[Shot]]:
    """Return the shots scaled as far as a level counts."""
    return lambda fmt: (
        shot
        for shots, what, prefix, (reach64, reach32, step64, step32) in legs
        for k in scales(fmt, reach64, reach32, step64, step32)
        if k
        for shot in _scaled(shots, what, k, prefix + power(k))
    )


def _range(*legs: Leg) -> Callable[[Format], Iterator[Shot]]:
    """Return the shots scaled beyond."""
    return lambda fmt: (
        shot
        for shots, what, prefix, (first, step) in legs
        for k in ends(fmt, first, step)
        for shot in _beyond(shots, what, k, prefix + power(k))
    )


def ends(fmt: Format, first: int = 0, step: int = 1) -> Iterator[int]:
    """Yield exponents beyond the scales that count for a level, of either sign."""
    exponents = (20, 24, 28, 31, 36, 40, 48, 60, 63, 75, 100, 120)
    if is_double(fmt):
        exponents = (120, 150, 170, 200, 255, 300, 340, 400, 500, 531, 700, 1000)
    for k in exponents[first::step]:
        yield from (k, -k)


def _range_directions(fmt: Format) -> Iterator[Shot]:
    shots = (LEAVES[0], LEAVES[3], LEAVES[5], LEAVES[6])
    yield from _range((shots, "direction", "direction-", (0, 2)))(fmt)
    yield from _endpoints(fmt)


def _endpoints(fmt: Format) -> Iterator[Shot]:
    """Yield endpoints beyond the largest number, and below the smallest."""
    top, bottom = fmt.overflow, fmt.least
    for shot in (LEAVES[0], LEAVES[2], LEAVES[6], LEAVES[7]):
        far = shot.larger(two(top // 2)).faster(two(2 - top))
        text = "Endpoints lie beyond the largest number: {}"
        yield far.named("{}-endpoints-overflow", text, "overflow", "direction-scale")
        near = shot.larger(two(bottom // 2 + 20)).faster(two(-bottom - 40))
        text = "Endpoints lie below the smallest number: {}"
        yield near.named("{}-endpoints-vanish", text, "underflow", "direction-scale")
    distance, slow = two(top - 4), two(4 - top)
    yield Shot("plane-far-slow",
               "The largest distance at the smallest speed ends beyond the largest number",
               half_space(0), (0, 0, -distance), (0, 0, slow), pair(0, distance / slow),
               flags=("overflow",))  # fmt: skip


def _subnormal(fmt: Format, shots: tuple[Shot, ...] = LEAVES) -> Iterator[Shot]:
    for shot in shots:
        least = shot.larger(two(fmt.least))
        text = "Every length is a few of the smallest numbers: {}"
        yield least.named("{}-smallest-unit", text, "subnormal", "scene-scale")
        if shots is LEAVES:
            partly = shot.larger(two(fmt.least + fmt.precision - 3))
            text = "Lengths are about the smallest normal number: {}"
            yield partly.named("{}-partly-subnormal", text, "subnormal", "scene-scale")
        slow, text = shot.faster(two(fmt.least)), "The direction is subnormal: {}"
        yield slow.named("{}-subnormal-direction", text, "subnormal", "direction-scale")


def _range_spheres(fmt: Format) -> Iterator[Shot]:
    turned = set(ends(fmt, 2, 4))
    for k in ends(fmt, 0, 2):
        yield from _beyond((SPHERES[0], SPHERES[3]), "scene", k, f"scene-{power(k)}")
        if k in turned:
            shots = (SPHERES[1], SPHERES[2])
            yield from _beyond(shots, "direction", k, f"direction-{power(k)}")
    yield from _subnormal(fmt, SPHERES)


START = 6
"""x0: with a radius just above 1 the endpoints lie just above 5 and 7."""
NEIGHBOURS = ((1, "first"), (3, "second"))
"""Half units above 1: at the first a tie goes down to even in 7, at the second up."""
NARROW = (12, 20, 26, 28, 40, 100, 500)
"""The j of heights 2^-j beside the ties of binary32, which only binary64 has room for."""


def half_unit(fmt: Format) -> Number:
    """Return half the distance between neighbours in [4, 8)."""
    return two(2 - fmt.precision)


def shifts(fmt: Format) -> tuple[int, ...]:
    """Return the j of heights 2^-j: from just below half a unit to 500 (70 in binary32)."""
    if is_double(fmt):
        return (28, 31, 36, 42, 50, 60, 80, 100, 150, 200, 300, 400, 500)
    return (14, 16, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70)


def _bodies(radius: Number) -> tuple[Body, Body]:
    return (tube(radius, 2), cylinder(radius, 2))


def _ends(
    slug: str, body: Body | Ball, text: str, height: Number = 0, frame: Frames = UPRIGHT
) -> Shot:
    """Return the ray along x at a height past the middle of a cylinder or sphere."""
    noun, z = (body.noun, 1) if isinstance(body, Body) else ("a sphere", 0)
    known = None if height else pair(START - body.radius, START + body.radius)
    return Shot(slug, f"Both ends of {noun} are {text}", body, (-START, height, z), (1, 0, 0),
                known, frame, ("hard-to-round",) if height else ("tie",))  # fmt: skip


def _ties(fmt: Format) -> Iterator[Shot]:
    for count, word in NEIGHBOURS:
        shift = count * half_unit(fmt)
        for body in _bodies(1 + shift):
            text, frames = f"{word} ties of {fmt.name}", (UPRIGHT, ON_Y, DOWN_X)
            yield _ends(f"{body.word}-{word}", body, text, frame=frames)
        yield from _skew_ties(fmt, count, word)
        level, text = -1 - shift, f"The end of a {{}} is the {word} tie of {fmt.name}"
        for shot in table(
            ("half-space", "half-space", half_space(START), (1, 2, level), (0, 0, 1),
             pair(0, START - level)),
            ("slab", "slab", slab(2, START - 2), (1, 2, level), (0, 0, 1),
             pair(START - 2 - level, START - level)),
        ):  # fmt: skip
            yield shot.named(f"{{}}-{word}", text, "tie")
    # Ties of binary32, for those who round twice, and the same a little moved.
    for body in _bodies(1 + half_unit(BINARY32)) if is_double(fmt) else ():
        yield _ends(f"{body.word}-in-binary32", body, "ties of binary32")
        for j in NARROW:
            slug = f"{body.word}-beside-binary32-{power(-2 * j)}"
            yield _ends(slug, body, f"2^-{2 * j}/2r beside ties of binary32", two(-j))


def _skew_ties(fmt: Format, count: int, word: str) -> Iterator[Shot]:
    """Yield chords at 3/5 of the radius 5 (1 + count 2^(5 - precision)): ties in [32, 64)."""
    unit = 1 + count * two(5 - fmt.precision)
    for body in _bodies(5 * unit):
        yield Shot(f"{body.word}-{word}-skew",
                   f"The ends of {body.noun} are {word} ties by a Pythagorean chord", body,
                   (-4 * 40, 3 * unit, 1), (4, 0, 0), pair(40 - unit, 40 + unit),
                   flags=("tie",))  # fmt: skip


def _hard(fmt: Format, j: int) -> Iterator[Shot]:
    for count, word in NEIGHBOURS:
        for body in _bodies(1 + count * half_unit(fmt)):
            text = f"2^-{2 * j}/2r beside the {word} tie"
            yield _ends(f"{body.word}-{word}-{power(-2 * j)}", body, text, two(-j))
    yield from _other_side(fmt, j)
    level = -1 - half_unit(fmt)
    for shift, side in ((two(-j), "above"), (-two(-j), "below")):
        yield Shot(f"half-space-{side}-{power(-j)}",
                   f"The end of a half-space is 2^-{j} {side} a tie",
                   Body("half_space", (0, 0, START), (0, -shift, START + 1)), (0, 1, level),
                   (0, 0, 1), pair(0, START - level + shift), flags=("hard-to-round",))  # fmt: skip


def _other_side(fmt: Format, j: int) -> Iterator[Shot]:
    """Yield irrational ends on the other side of their ties: a chord longer by 3/4 2^-2j each way.

    The chord at 3/5 of the radius 5 u has its ends at ties (`_skew_ties`). Here the axis is 3 u off
    and the ray 2^-2j nearer to it, which no single number could say.
    """
    for count, word in NEIGHBOURS:
        unit = 1 + count * two(5 - fmt.precision)
        axis: tuple[Exact, Exact] = ((0, 3 * unit, 0), (0, 3 * unit, 2))
        for body in (pipe(*axis, 5 * unit), rod(*axis, 5 * unit)):
            yield Shot(f"{body.word}-{word}-wide-{power(-2 * j)}",
                       f"Both ends of {body.noun} are 3/4 of 2^-{2 * j} outside the {word} tie",
                       body, (-40, two(-2 * j), 1), (1, 0, 0),
                       flags=("hard-to-round",))  # fmt: skip


def _range_ties(fmt: Format) -> tuple[Shot, ...]:
    """Return ties between subnormal numbers, and the tie at the largest number."""
    smallest, fast, top = two(fmt.least), two(fmt.overflow - 24), two(fmt.overflow - 1)
    gap = two(fmt.overflow - fmt.precision - 1)
    beyond, last = 2 * top - gap, 2 * top - 2 * gap
    subnormal = tuple(
        Shot(f"subnormal-{odd}", f"A plane is crossed at {odd}/2 times the smallest number",
             half_space(0), (0, 0, -odd * smallest * fast / 2), (0, 0, fast),
             pair(0, odd * smallest / 2), flags=("tie", "subnormal"))
        for odd in (1, 3, 5, 255)
    )  # fmt: skip
    return (
        *subnormal,
        Shot("largest", "A plane is crossed half a unit above the largest number",
             half_space(beyond - top), (0, 0, -top), (0, 0, 1), pair(0, beyond),
             flags=("tie", "overflow")),
        Shot("largest-itself", "A plane is crossed at the largest number",
             half_space(last - top), (0, 0, -top), (0, 0, 1), pair(0, last), flags=("overflow",)),
    )  # fmt: skip


def _sphere_ties(fmt: Format) -> Iterator[Shot]:
    for count, word in NEIGHBOURS:
        body = ball(1 + count * half_unit(fmt))
        text, frames = f"{word} ties of {fmt.name}", (UPRIGHT, ON_Y, DOWN_Z)
        yield _ends(f"{word}-tie", body, text, frame=frames)
        for j in shifts(fmt):
            text = f"2^-{2 * j}/2r beside the {word} tie"
            yield _ends(f"{word}-{power(-2 * j)}", body, text, two(-j))
    if is_double(fmt):
        body = ball(1 + half_unit(BINARY32))
        yield _ends("binary32-tie", body, "ties of binary32")
        for j in NARROW:
            text = f"2^-{2 * j}/2r beside ties of binary32"
            yield _ends(f"binary32-{power(-2 * j)}", body, text, two(-j))


FAMILIES = (
    family("direction-scale", "|direction| from 2^-40 to 2^40.",
           _ladder((LEAVES, "direction", "", (40, 12, 8, 4)))),
    family("scene-scale", "Scenes from 2^-100 to 2^100 times their size.",
           _ladder((LEAVES, "scene", "", (100, 15, 20, 5)))),
    family("range-scenes", "Scenes whose squares leave the range.",
           _range(((LEAVES[0], LEAVES[1], LEAVES[4]), "scene", "scene-", (0, 1)))),
    family("range-directions", "Directions whose squares leave the range.", _range_directions,
           tier="range"),
    family("range-subnormal", "Scenes and directions of subnormal numbers.", _subnormal,
           tier="range"),
    family("sphere-scale", "Directions and scenes from very small to very large.",
           _ladder((SPHERES, "direction", "direction-", (40, 12, 10, 4)),
                   (SPHERES, "scene", "scene-", (100, 15, 25, 5)))),
    family("range-sphere", "Spheres and directions whose squares leave the range.",
           _range_spheres, tier="range"),
    family("csg-scale", "Trees very small and very large.",
           _ladder((TREES, "direction", "speed-", (40, 12, 20, 6)),
                   (TREES, "scene", "size-", (100, 15, 50, 5)))),
    family("range-csg", "Trees whose squares leave the range.",
           _range((TREES, "scene", "size-", (1, 3)), (TREES, "direction", "speed-", (4, 6)))),
    family("rounding-ties", "Endpoints exactly halfway between two numbers.", _ties, tier="stiff"),
    family("rounding-hard", "Ties moved by 2^-2j, j up to 500.", ladder(shifts, _hard),
           tier="stiff"),
    family("range-ties", "Ties among the subnormals and at the largest number.", _range_ties,
           tier="range"),
    family("sphere-rounding", "Ends of spheres halfway between two numbers, and beside.",
           _sphere_ties, tier="stiff"),
)  # fmt: skip
