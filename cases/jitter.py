"""The ladders of the golden families with every step drawn: fresh cases, the same for a seed.

A case depends on its seed, its number and the format only, and on no other case. Scenes are drawn
in exact numbers as the golden ones are, so that what is exactly tangent stays so; the answer is
given where the construction makes it evident.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from raycert.cases.case import Case
from raycert.cases.dice import Dice
from raycert.cases.draw import CHORDS, Aim, Draw, any_aim, shot
from raycert.cases.families.frames import UPRIGHT, Exact
from raycert.cases.families.lists import AHEAD, SPEED, START, STYLES, Stretch, Term, build
from raycert.cases.families.shots import Shot, is_double
from raycert.cases.families.sketch import (
    Boolean,
    Shape,
    ball,
    below,
    layer,
    moved,
    pipe,
    plus,
    rod,
    times,
    two,
)
from raycert.cases.formats import Format


def _far(draw: Draw) -> Case:
    return shot(draw, "comes from afar to", any_aim(draw), draw.large(), ("far",))


def _displaced(draw: Draw) -> Case:
    shift = (draw.sign() * draw.large(), draw.sign() * draw.large(), -draw.large())
    frame = draw.frame().moved(shift)
    what = "far from the coordinate origin meets"
    return shot(draw, what, any_aim(draw), draw.whole(2, 9), ("displaced",), frame=frame)


def _start(draw: Draw) -> Case:
    """Return a start inside, on a face, or a small step beside it."""
    aim, step = any_aim(draw), draw.sign() * draw.gap()
    face = draw.pick([t for t in aim.stay if t is not None])
    back, flag = draw.pick(
        [(-face, "start-on-surface"), (step - face, "start-near-surface"), (step, "start-inside")]
    )
    return shot(draw, "starts in or at", aim, back, (flag,))


def _behind(draw: Draw) -> Case:
    past = draw.pick((Fraction(draw.whole(2, 9)), draw.large(), 1 + draw.gap()))
    return shot(draw, "has left behind", any_aim(draw), -past, ("behind",))


def _speed(draw: Draw) -> Case:
    speed = two(draw.sign() * draw.whole(8, 40 if is_double(draw.fmt) else 12))
    back, flags = draw.whole(-1, 9), ("direction-scale",)
    return shot(draw, "very slow or very fast meets", any_aim(draw), back, flags, speed=speed)


def _size(draw: Draw) -> Case:
    factor = two(draw.sign() * draw.whole(8, 100 if is_double(draw.fmt) else 15))
    frame, back = draw.frame().scaled(factor), draw.whole(-1, 9)
    return shot(
        draw, "meets, very small or large,", any_aim(draw), back, ("scene-scale",), frame=frame
    )


def _thin(draw: Draw) -> Case:
    """Return a needle crossed, or a disk met through both caps."""
    y, half, radius = draw.pick(CHORDS)
    if draw.whole(0, 1):
        top = draw.large() * radius
        body, flag = rod((0, 0, -top), (0, 0, top), radius), "needle"
        aim = Aim("a needle", body, (0, y, 0), (half, 0, draw.whole(-9, 9)))
    else:
        body, flag = rod((0, 0, -1), (0, 0, 1), draw.large() * radius), "disk"
        aim = Aim("a disk", body, (draw.whole(-4, 4), 1, 0), (draw.whole(-5, 5), 2, draw.sign()))
    size = two(-draw.whole(0, 30))
    return shot(draw, "meets", aim, draw.whole(0, 9), (flag,), frame=draw.frame().scaled(size))


def _tilt(draw: Draw) -> Case:
    """Return a ray almost along the axis, from inside, or from beside the wall."""
    lean, height = draw.small(), draw.pick((Fraction(8), draw.large()))
    beside = draw.pick((Fraction(-1) - draw.gap(), Fraction(-1), Fraction(draw.whole(-7, 7), 8)))
    across: tuple[Fraction, Fraction] = ((-1 - beside) / lean, (1 - beside) / lean)
    tube = draw.whole(0, 1)
    body = (pipe if tube else rod)((0, 0, -8), (0, 0, height), 1)
    leave = across[1] if tube else min(across[1], height)
    aim = Aim("a cylinder", body, (beside, 0, 0), (lean, 0, 1), (across[0], leave))
    known_miss = not tube and across[0] > height
    case = shot(draw, "runs almost along", aim, 0, ("near-parallel",), frame=UPRIGHT)
    return replace(case, known=None, source="oracle") if known_miss else case


def _level(draw: Draw) -> Case:
    """Return a ray almost level with a plane, or with two."""
    lean, side = draw.sign() * draw.small(), Fraction(draw.whole(-24, 24), 8)
    shape = draw.pick(
        [
            layer((0, 0, -1), (0, 0, 1)),
            below((0, 0, 0), (0, 0, draw.whole(1, 9))),
            rod((0, 0, -1), (0, 0, 1), draw.pick((Fraction(3), draw.large()))),
        ]
    )
    aim = Aim("planes", shape, (0, 0, side), (draw.whole(1, 9), draw.whole(-9, 9), lean))
    case = shot(draw, "is almost level with", aim, draw.whole(0, 2), ("near-parallel",))
    return replace(case, known=None, source="oracle")


def _touching(draw: Draw) -> tuple[Exact, Exact, Shape, str]:
    x, y, radius = draw.pick(CHORDS)
    low, high = (0, 0, -2 * radius), (0, 0, 2 * radius)
    touched: list[tuple[str, Shape]] = [
        ("a cylinder", rod(low, high, radius)),
        ("an infinite cylinder", pipe(low, high, radius)),
        ("a sphere", ball(radius)),
    ]
    noun, shape = draw.pick(touched)
    turn = draw.sign()
    direction: Exact = (turn * y, -turn * x, draw.whole(-2, 2))
    return (x, y, 0), direction, shape, noun


def _tangent(draw: Draw) -> Case:
    contact, direction, shape, noun = _touching(draw)
    aim = Aim(noun, shape, contact, direction, (0, 0))
    back = draw.pick((Fraction(0), Fraction(draw.whole(1, 9)), draw.large()))
    return shot(draw, "touches", aim, back, ("tangent",))


def _gap(draw: Draw) -> Case:
    """Return a tangent moved in or out by a small share of the radius."""
    contact, direction, shape, noun = _touching(draw)
    aim = Aim(noun, shape, times(1 + draw.sign() * draw.gap(), contact), direction)
    case = shot(draw, "almost touches", aim, draw.whole(0, 9), ("near-tangent",))
    return replace(case, known=None, source="oracle")


def _rim(draw: Draw) -> Case:
    """Return a ray through a rim, or by a small gap beside it."""
    x, y, radius = draw.pick(CHORDS)
    gap, flag = draw.pick([(Fraction(0), "rim"), (draw.sign() * draw.gap(), "near-rim")])
    inward: Exact = (-x, -y, draw.whole(-radius, radius))
    direction = draw.pick([inward, (y, -x, 0), (0, 0, 1), (draw.whole(-9, 9), -y, draw.sign())])
    aim = Aim(
        "the rim of a cylinder", rod((0, 0, -4), (0, 0, 4), radius), (x, y, 4 + gap), direction
    )
    case = shot(draw, "passes through or by", aim, draw.whole(0, 3), (flag,))
    return replace(case, known=None, source="oracle")


def _face(draw: Draw) -> Case:
    """Return a ray in a wall, in a plane, or along the axis."""
    x, y, radius = draw.pick(CHORDS)
    base = 4 * draw.whole(-1, 1)
    body = draw.pick((rod, pipe))((0, 0, -4), (0, 0, 4), radius)
    shape, at, direction = draw.pick(
        [
            (body, (x, y, base), (0, 0, draw.sign())),
            (body, (draw.whole(-1, 1), 0, base), (0, 0, draw.sign())),
            (body, (x, y, base), (-1, draw.whole(-3, 3), 0)),
            (layer((0, 0, -4), (0, 0, 4)), (x, y, base), (1, draw.whole(-3, 3), 0)),
            (below((0, 0, 0), (0, 0, 2)), (x, y, base), (1, draw.whole(-3, 3), 0)),
        ]
    )
    aim = Aim("a face", shape, at, direction)
    case = shot(draw, "runs in or along", aim, draw.whole(0, 9), ("parallel",))
    return replace(case, known=None, source="oracle")


def _rest(draw: Draw) -> Case:
    """Return a ray with no direction, inside, on a face or outside."""
    aim = any_aim(draw)
    ends = [t for t in aim.stay if t is not None]
    at = plus(aim.target, aim.direction, draw.pick((*ends, *ends, Fraction(1, 2), 2, -2)))
    still = replace(aim, target=at, direction=(0, 0, 0))
    case = shot(draw, "with no direction rests in or by", still, 0, ("zero-direction",))
    return replace(case, known=None, source="oracle")


def _stretch(draw: Draw) -> Stretch:
    a = Fraction(draw.whole(0, 12), 2)
    b = draw.pick((a, None, *(a + Fraction(draw.whole(1, 12), 2) for _ in range(10))))
    return (a, b)


def _term(draw: Draw, depth: int) -> Term | Stretch:
    """Return a Boolean of stretches of one ray, whose ends coincide more often than not."""
    if not depth:
        return _stretch(draw)
    count = draw.whole(2, 3)
    parts = tuple(_term(draw, min(draw.whole(0, 2), depth - 1)) for _ in range(count))
    kinds: tuple[Boolean, ...] = ("union", "intersection", "difference")
    return Term(draw.pick(kinds), parts)


def _boolean(draw: Draw) -> Case:
    """Return a Boolean met at known places, near or far, in its size or another."""
    _, ways = draw.pick(list(STYLES.values()))
    shape = build(_term(draw, 2), ways, draw.dice)
    later = draw.pick((*map(Fraction, (0, 0, 1)), draw.large()))
    size = draw.pick((Fraction(1), two(draw.whole(-15, 15))))
    return Shot(
        "",
        "A ray meets a Boolean of stretches",
        moved(shape, (SPEED * later, 0, 0)),
        START,
        AHEAD,
        flags=("coincident-faces",),
    ).case(draw.fmt, draw.frame().scaled(size))


LADDERS: tuple[tuple[str, Callable[[Draw], Case]], ...] = (
    ("far", _far),
    ("boolean", _boolean),
    ("tangent", _tangent),
    ("gap", _gap),
    ("displaced", _displaced),
    ("start", _start),
    ("boolean", _boolean),
    ("behind", _behind),
    ("rim", _rim),
    ("tilt", _tilt),
    ("level", _level),
    ("boolean", _boolean),
    ("thin", _thin),
    ("face", _face),
    ("rest", _rest),
    ("boolean", _boolean),
    ("speed", _speed),
    ("size", _size),
)


def jittered(seed: int, number: int, fmt: Format) -> Case:
    """Return one case of a seed; every ladder has its turn."""
    name, ladder = LADDERS[number % len(LADDERS)]
    draw = Draw(Dice(f"jitter {seed} {number} {fmt.name}"), fmt)
    case = ladder(draw)
    return replace(case, slug=f"{name}-{number}", tier="stiff")
