"""Hard to round: endpoints halfway between two numbers, and a little beside.

A ray along x at z = 1 and height y meets the wall of radius r at t = x0 -+ sqrt(r^2 - y^2). At
y = 0 that is x0 -+ r, halfway between two numbers of the format by the choice of r and x0. The
height y = 2^-j moves it by about y^2/2r = 2^-2j/2r, up to the thousandth bit.
"""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import DOWN_X, ON_Y, UPRIGHT, Exact, Number
from raycert.cases.families.ladders import is_double, power
from raycert.cases.families.sketch import Body, cylinder, half_space, pair, row, slab, tube, two
from raycert.cases.formats import BINARY32, Format

START = 6
"""x0: with a radius just above 1 the endpoints lie just above 5 and 7."""
NEIGHBOURS = ((1, "first"), (3, "second"))
"""Half units above 1: at the first a tie goes down to even in 7, at the second up."""


def half_unit(fmt: Format) -> Number:
    """Return half the distance between neighbours in [4, 8)."""
    return two(2 - fmt.precision)


def _bodies(radius: Number) -> tuple[Body, Body]:
    return (tube(radius, 2), cylinder(radius, 2))


def _ties(fmt: Format) -> Iterator[Case]:
    half = half_unit(fmt)
    for count, word in NEIGHBOURS:
        radius = 1 + count * half
        for body in _bodies(radius):
            for frame in (UPRIGHT, ON_Y, DOWN_X):
                yield row(
                    fmt,
                    f"{body.word}-{word}",
                    f"Both ends of {body.noun} are {word} ties of {fmt.name}",
                    body,
                    (-START, 0, 1),
                    (1, 0, 0),
                    frame=frame,
                    tier="stiff",
                    flags=("tie",),
                    known=pair(START - radius, START + radius),
                )
        yield from _skew_ties(fmt, count, word)
        level = -1 - count * half
        for name, body, known in (
            ("half-space", half_space(START), pair(0, START - level)),
            ("slab", slab(2, START - 2), pair(START - 2 - level, START - level)),
        ):
            yield row(
                fmt,
                f"{name}-{word}",
                f"The end of a {name} is the {word} tie of {fmt.name}",
                body,
                (1, 2, level),
                (0, 0, 1),
                tier="stiff",
                flags=("tie",),
                known=known,
            )
    yield from _narrow_ties(fmt)


def _skew_ties(fmt: Format, count: int, word: str) -> Iterator[Case]:
    """Yield chords at 3/5 of the radius 5 (1 + count 2^(5 - precision)): ties in [32, 64)."""
    unit = 1 + count * two(5 - fmt.precision)
    for body in _bodies(5 * unit):
        yield row(
            fmt,
            f"{body.word}-{word}-skew",
            f"The ends of {body.noun} are {word} ties by a Pythagorean chord",
            body,
            (-4 * 40, 3 * unit, 1),
            (4, 0, 0),
            tier="stiff",
            flags=("tie",),
            known=pair(40 - unit, 40 + unit),
        )


def _narrow_ties(fmt: Format) -> Iterator[Case]:
    """Yield ties of binary32, for those who round twice, and the same a little moved."""
    if not is_double(fmt):
        return
    radius = 1 + half_unit(BINARY32)
    for body in _bodies(radius):
        yield row(
            fmt,
            f"{body.word}-in-binary32",
            f"Both ends of {body.noun} are ties of binary32",
            body,
            (-START, 0, 1),
            (1, 0, 0),
            tier="stiff",
            flags=("tie",),
            known=pair(START - radius, START + radius),
        )
        for j in (12, 20, 26, 28, 40, 100, 500):
            yield row(
                fmt,
                f"{body.word}-beside-binary32-{power(-2 * j)}",
                f"Both ends of {body.noun} are 2^-{2 * j}/2r beside ties of binary32",
                body,
                (-START, two(-j), 1),
                (1, 0, 0),
                tier="stiff",
                flags=("hard-to-round",),
            )


def shifts(fmt: Format) -> tuple[int, ...]:
    """Return the j of heights 2^-j: from just below half a unit to 500 (70 in binary32)."""
    if is_double(fmt):
        return (28, 31, 36, 42, 50, 60, 80, 100, 150, 200, 300, 400, 500)
    return (14, 16, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70)


def _hard(fmt: Format) -> Iterator[Case]:
    for j in shifts(fmt):
        for count, word in NEIGHBOURS:
            for body in _bodies(1 + count * half_unit(fmt)):
                yield row(
                    fmt,
                    f"{body.word}-{word}-{power(-2 * j)}",
                    f"Both ends of {body.noun} are 2^-{2 * j}/2r beside the {word} tie",
                    body,
                    (-START, two(-j), 1),
                    (1, 0, 0),
                    tier="stiff",
                    flags=("hard-to-round",),
                )
        yield from _other_side(fmt, j)
        for sign, side in ((1, "above"), (-1, "below")):
            level = -1 - half_unit(fmt)
            yield row(
                fmt,
                f"half-space-{side}-{power(-j)}",
                f"The end of a half-space is 2^-{j} {side} a tie",
                Body("half_space", (0, 0, START), (0, -sign * two(-j), START + 1)),
                (0, 1, level),
                (0, 0, 1),
                tier="stiff",
                flags=("hard-to-round",),
                known=pair(0, START - level + sign * two(-j)),
            )


def _other_side(fmt: Format, j: int) -> Iterator[Case]:
    """Yield irrational ends on the other side of their ties: a chord longer by 3/4 2^-2j each way.

    The chord at 3/5 of the radius 5 u has its ends at ties (`_skew_ties`). Here the axis is 3 u off
    and the ray 2^-2j nearer to it, which no single number could say.
    """
    for count, word in NEIGHBOURS:
        unit = 1 + count * two(5 - fmt.precision)
        axis: tuple[Exact, Exact] = ((0, 3 * unit, 0), (0, 3 * unit, 2))
        for kind, name in (
            ("infinite_cylinder", "an infinite cylinder"),
            ("cylinder", "a cylinder"),
        ):
            yield row(
                fmt,
                f"{kind.replace('_', '-')}-{word}-wide-{power(-2 * j)}",
                f"Both ends of {name} are 3/4 of 2^-{2 * j} outside the {word} tie",
                Body(kind, *axis, 5 * unit),
                (-40, two(-2 * j), 1),
                (1, 0, 0),
                tier="stiff",
                flags=("hard-to-round",),
            )


def _range_ties(fmt: Format) -> Iterator[Case]:
    """Yield ties between subnormal numbers, and the tie at the largest number."""
    smallest = two(fmt.least)
    fast = two(fmt.overflow - 24)
    for odd in (1, 3, 5, 255):
        yield row(
            fmt,
            f"subnormal-{odd}",
            f"A plane is crossed at {odd}/2 times the smallest number",
            half_space(0),
            (0, 0, -odd * smallest * fast / 2),
            (0, 0, fast),
            tier="range",
            flags=("tie", "subnormal"),
            known=pair(0, odd * smallest / 2),
        )
    top = two(fmt.overflow - 1)
    gap = two(fmt.overflow - fmt.precision - 1)
    for slug, words, distance, flags in (
        ("largest", "half a unit above the largest number", 2 * top - gap, ("tie", "overflow")),
        ("largest-itself", "at the largest number", 2 * top - 2 * gap, ("overflow",)),
    ):
        yield row(
            fmt,
            slug,
            f"A plane is crossed {words}",
            half_space(distance - top),
            (0, 0, -top),
            (0, 0, 1),
            tier="range",
            flags=flags,
            known=pair(0, distance),
        )


FAMILIES = (
    Family("rounding-ties", "Endpoints exactly halfway between two numbers.", _ties),
    Family("rounding-hard", "Ties moved by 2^-2j, j up to 500.", _hard),
    Family("range-ties", "Ties among the subnormals and at the largest number.", _range_ties),
)
