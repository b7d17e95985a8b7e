"""Starts in trees: inside parts, on faces in common, at touches; and rays that stay at rest."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.csg_faces import drum
from raycert.cases.families.frames import SEVENTHS, UPRIGHT, Exact, frames_for
from raycert.cases.families.ladders import depths
from raycert.cases.families.shapes import Node, all_of, any_of, ball, less, one_frame, scene, spans
from raycert.cases.families.sketch import ALWAYS, MISS, Pairs, near, pair, touch
from raycert.cases.families.stretches import Rule, d, n, placed, u
from raycert.cases.formats import Format

CLIPPED = (
    Rule("all-behind", "[-4,-2] u [-3,-1]", u((-4, -2), (-3, -1)), MISS, ("behind",)),
    Rule("less-behind", "[-2,2] - [-4,0]", d((-2, 2), (-4, 0)), pair(0, 2), ("closure",)),
    Rule("less-to-start", "[-2,2] - [-4,1]", d((-2, 2), (-4, 1)), pair(1, 2), ("start-inside",)),
    Rule("ends-at-start", "[-4,0] u [2,4]", u((-4, 0), (2, 4)), spans((0, 0), (2, 4)),
         ("closure",)),
    Rule("end-less-same", "[-4,0] - [-2,0]", d((-4, 0), (-2, 0)), MISS, ("closure",)),
    Rule("end-less-next", "[-4,0] - [0,2]", d((-4, 0), (0, 2)), MISS, ("closure",)),
    Rule("next-less-end", "[0,2] - [-4,0]", d((0, 2), (-4, 0)), pair(0, 2), ("closure",)),
    Rule("end-and-next", "[-4,0] n [0,2]", n((-4, 0), (0, 2)), touch(0), ("touching-parts",)),
    Rule("end-or-next", "[-4,0] u [0,2]", u((-4, 0), (0, 2)), pair(0, 2), ("touching-parts",)),
    Rule("touch-at-start", "[0,0] u [-4,-2]", u((0, 0), (-4, -2)), touch(0), ("closure",)),
    Rule("touch-less-end", "[0,0] - [-4,0]", d((0, 0), (-4, 0)), MISS, ("closure",)),
    Rule("prick-at-start", "[-4,4] - [0,0]", d((-4, 4), (0, 0)), pair(0, 4), ("closure",)),
    Rule("prick-behind", "[-4,4] - [-2,-2]", d((-4, 4), (-2, -2)), pair(0, 4), ("start-inside",)),
    Rule("in-a-hole", "[-4,4] - [-2,2]", d((-4, 4), (-2, 2)), pair(2, 4), ("hollow",)),
    Rule("around-start", "[-8,8] - [-4,-2] - [2,4]", d((-8, 8), (-4, -2), (2, 4)),
         spans((0, 2), (4, 8)), ("start-inside",)),
    Rule("abut-behind", "[-4,-2] u [-2,2]", u((-4, -2), (-2, 2)), pair(0, 2), ("touching-parts",)),
)  # fmt: skip


def _clipped(fmt: Format) -> Iterator[Case]:
    for rule in CLIPPED:
        yield from placed(fmt, rule, ("balls", "rods", "mixed"), ())


STACK, CAP, UPPER = (
    any_of(drum(0, 4), drum(4, 8)),
    all_of(drum(0, 4), drum(4, 8)),
    less(drum(0, 8), drum(0, 4)),
)
WAIST, TWIN = less(drum(0, 8), drum(2, 6)), less(drum(0, 8), drum(0, 8))
# Starts on z = 4, in the middle of the stack, and at its wall: for each tree the list.
SEAMS: tuple[tuple[str, Exact, Exact, tuple[Pairs, Pairs, Pairs, Pairs]], ...] = (
    ("up", (1, 2, 4), (0, 0, 2), (pair(0, 2), touch(0), pair(0, 2), pair(1, 2))),
    ("down", (1, 2, 4), (0, 0, -2), (pair(0, 2), touch(0), MISS, pair(1, 2))),
    ("level", (0, 0, 4), (2, 0, 0), (pair(0, 2), pair(0, 2), MISS, MISS)),
    ("slanted", (0, 0, 4), (2, 0, 2), (pair(0, 2), touch(0), pair(0, 2), pair(1, 2))),
    ("wall-out", (4, 0, 4), (2, 0, 0), (touch(0), touch(0), MISS, MISS)),
    ("wall-in", (4, 0, 4), (-4, 0, 0), (pair(0, 2), pair(0, 2), MISS, MISS)),
    ("wall-up", (4, 0, 4), (0, 0, 4), (pair(0, 1), touch(0), pair(0, 1), spans(("1/2", 1)))),
    ("wall-tangent", (4, 0, 4), (0, 4, 0), (touch(0), touch(0), MISS, MISS)),
    ("rest", (1, 2, 4), (0, 0, 0), (ALWAYS, ALWAYS, MISS, MISS)),
    ("rest-on-wall", (4, 0, 4), (0, 0, 0), (ALWAYS, ALWAYS, MISS, MISS)),
    ("rest-above", (1, 2, 7), (0, 0, 0), (ALWAYS, MISS, ALWAYS, ALWAYS)),
)
TREES: tuple[tuple[str, str, Node], ...] = (
    ("stack", "two stacked cylinders", STACK),
    ("cap", "the cap they share", CAP),
    ("upper", "the upper half left over", UPPER),
    ("waist", "a cylinder less its middle", WAIST),
)


def _on_seams(fmt: Format) -> Iterator[Case]:
    for slug, origin, direction, lists in SEAMS:
        still = direction == (0, 0, 0)
        for (name, text, shape), known in zip(TREES, lists, strict=True):
            for frame in one_frame(f"{name}-{slug}"):
                yield scene(
                    fmt,
                    f"{name}-{slug}",
                    f"A ray starts at the seam, {slug.replace('-', ' ')}: {text}",
                    shape,
                    origin,
                    direction,
                    frame=frame,
                    flags=("coincident-faces", "zero-direction" if still else "start-on-surface"),
                    known=known,
                )


def _near_faces(fmt: Format) -> Iterator[Case]:
    """Yield starts just off the inner face of a shell of radii 2 and 1, along x."""
    shell, lens = less(ball(2), ball(1)), all_of(ball(2, -1), ball(2, 1))
    stack = any_of(drum(0, 1, 1), drum(1, 2, 1))
    for size, depth in depths(fmt):
        for side, sign in (("below", -1), ("above", 1)):
            x = near(fmt, 1 + sign * depth)
            gap = max(1 - x, Fraction(0))
            starts: tuple[tuple[str, str, Node, Exact, Exact, Pairs], ...] = (
                ("shell-out", "the inner face of a shell, outward", shell, (x, 0, 0), (1, 0, 0),
                 pair(gap, 2 - x)),
                ("shell-in", "the inner face of a shell, inward", shell, (x, 0, 0), (-1, 0, 0),
                 pair(1 + x, 2 + x) if sign < 0 else spans((0, x - 1), (1 + x, 2 + x))),
                ("lens", "the rim of a lens, inward", lens, (x, 0, 0), (-1, 0, 0),
                 pair(max(x - 1, Fraction(0)), 1 + x)),
                ("seam", "the seam of a stack, down", stack, (0, 0, x), (0, 0, -1), pair(0, x)),
            )  # fmt: skip
            for name, text, shape, origin, direction, known in starts:
                yield scene(
                    fmt,
                    f"{name}-{side}-{size}",
                    f"A ray starts {size} radii {side} {text}",
                    shape,
                    origin,
                    direction,
                    frame=SEVENTHS if name == "lens" else UPRIGHT,
                    tier="stiff",
                    flags=("start-near-surface",),
                    known=known,
                )


HALVES = (ball(4, -4), ball(4, 4))
RESTS: tuple[tuple[str, str, Node, Exact, Pairs], ...] = (
    ("in-a-union", "in one of two parts", any_of(*HALVES), (3, 1, 0), ALWAYS),
    ("beside-a-union", "beside two parts", any_of(*HALVES), (0, 3, 0), MISS),
    ("at-a-touch", "where two spheres touch, united", any_of(*HALVES), (0, 0, 0), ALWAYS),
    ("at-a-touch-and", "where two spheres touch, intersected", all_of(*HALVES), (0, 0, 0), ALWAYS),
    ("at-a-touch-less", "where two spheres touch, subtracted", less(*HALVES), (0, 0, 0), MISS),
    ("in-the-first", "in the first part only", less(*HALVES), (-3, 1, 0), ALWAYS),
    ("in-the-second", "in the part taken away", less(*HALVES), (3, 1, 0), MISS),
    ("in-a-hole", "in a hole", less(ball(8), ball(4)), (1, 2, 3), MISS),
    ("on-a-hole", "on the face of a hole", less(ball(8), ball(4)), (0, 4, 0), MISS),
    ("on-the-outside", "on the outside of a hollow", less(ball(8), ball(4)), (0, 8, 0), ALWAYS),
    ("in-itself", "in a part less itself", TWIN, (1, 2, 3), MISS),
    ("deep", "in a core three deep", less(ball(8), less(ball(4), ball(2))), (1, 0, 0), ALWAYS),
    ("deep-on", "on a core three deep", less(ball(8), less(ball(4), ball(2))), (0, 2, 0), ALWAYS),
)


def _rests(fmt: Format) -> Iterator[Case]:
    for slug, text, shape, origin, known in RESTS:
        for frame in frames_for(slug, 1, 1):
            yield scene(
                fmt,
                slug,
                f"A ray with no direction rests {text}",
                shape,
                origin,
                (0, 0, 0),
                frame=frame,
                flags=("zero-direction",),
                known=known,
            )


FAMILIES = (
    Family("csg-clip", "Parts cut off at t = 0 before they are combined.", _clipped),
    Family("csg-start-shared", "Starts on faces that two parts share.", _on_seams),
    Family("csg-start-near", "Starts just off a face inside a tree.", _near_faces),
    Family("csg-rest", "A ray that stays at rest in a tree.", _rests),
)
