"""Rims: rays through the circles where wall and cap meet, exactly and almost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import (
    ALIGNED,
    DOWN_X,
    NINTHS,
    UPRIGHT,
    Exact,
    Number,
    frames_for,
)
from raycert.cases.families.ladders import gaps, power
from raycert.cases.families.sketch import MISS, Pairs, cylinder, pair, plus, row, touch, two
from raycert.cases.formats import Format


@dataclass(frozen=True, slots=True)
class Passage:
    """A ray through the point `at` of a rim; `stay` is what it keeps of t, counted from there."""

    slug: str
    text: str
    radius: Number
    at: Exact
    direction: Exact
    stay: tuple[Number, Number]


HEIGHT = 8
PASSAGES = (
    Passage("enters-p", "enters at the rim of p", 4, (-4, 0, 0), (4, 0, 3), (0, 2)),
    Passage("enters-p-low", "enters at the rim of p, flat", 4, (-4, 0, 0), (4, 0, 1), (0, 2)),
    Passage(
        "enters-p-to-cap",
        "enters at the rim of p, leaves by a cap",
        4,
        (-4, 0, 0),
        (1, 0, 4),
        (0, 2),
    ),
    Passage("enters-p-skew", "enters at (3, 4) on the rim of p", 5, (3, 4, 0), (-3, -4, 3), (0, 2)),
    Passage("enters-q", "enters at the rim of q", 4, (-4, 0, 8), (4, 0, -3), (0, 2)),
    Passage(
        "enters-q-skew", "enters at (-5, 12) on the rim of q", 13, (-5, 12, 8), (5, -12, -2), (0, 2)
    ),
    Passage("leaves-q", "leaves at the rim of q", 4, (4, 0, 8), (4, 0, 3), (-2, 0)),
    Passage(
        "leaves-q-from-cap",
        "enters by a cap, leaves at the rim of q",
        4,
        (4, 0, 8),
        (1, 0, 4),
        (-2, 0),
    ),
    Passage("leaves-p", "leaves at the rim of p", 4, (4, 0, 0), (4, 0, -3), (-2, 0)),
    Passage("leaves-p-skew", "leaves at (4, 3) on the rim of p", 5, (4, 3, 0), (4, 3, -3), (-2, 0)),
    Passage("rim-to-rim", "goes from the rim of p to that of q", 4, (4, 0, 8), (4, 0, 4), (-2, 0)),
    Passage(
        "rim-to-rim-down", "goes from the rim of q to that of p", 4, (4, 0, 0), (4, 0, -4), (-2, 0)
    ),
    Passage(
        "rim-to-rim-skew", "goes between rims beside the axis", 5, (-3, 4, 8), (-3, 0, 4), (-2, 0)
    ),
    Passage("touch-q", "touches the rim of q only, from outside", 4, (-4, 0, 8), (1, 0, 1), (0, 0)),
    Passage(
        "touch-p", "touches the rim of p only, from outside", 4, (-4, 0, 0), (3, 0, -4), (0, 0)
    ),
    Passage(
        "touch-q-skew", "touches the rim of q only, at (3, 4)", 5, (3, 4, 8), (-3, -4, 2), (0, 0)
    ),
    Passage(
        "tangent-q", "touches the rim of q as a level tangent", 4, (0, 4, 8), (4, 0, 0), (0, 0)
    ),
    Passage(
        "tangent-p", "touches the rim of p as a level tangent", 4, (0, 4, 0), (4, 0, 0), (0, 0)
    ),
    Passage(
        "tangent-skew",
        "touches the rim of q as a tangent at (3, 4)",
        5,
        (3, 4, 8),
        (4, -3, 0),
        (0, 0),
    ),
    Passage(
        "tangent-climbing",
        "touches the rim of q as a climbing tangent",
        4,
        (0, 4, 8),
        (4, 0, 3),
        (0, 0),
    ),
    Passage(
        "tangent-entering",
        "slides down a tangent to the rim of q",
        4,
        (0, 4, 8),
        (4, 0, -3),
        (0, 0),
    ),
)


def _rims(fmt: Format) -> Iterator[Case]:
    for passage in PASSAGES:
        lattice = passage.slug in ("tangent-p", "tangent-q")
        frames = ALIGNED if lattice else frames_for(passage.slug, aligned=1, oblique=2)
        flags = ("rim",) + (("tangent",) if "tangent" in passage.slug else ())
        for before, when in ((3, "ahead"), (-3, "behind")):
            if before < 0 and not lattice and passage.stay != (0, 0):
                continue
            enter, leave = passage.stay
            known = pair(enter + before, leave + before) if before > 0 else MISS
            for frame in frames if before > 0 else frames[:2]:
                yield row(
                    fmt,
                    f"{passage.slug}-{when}",
                    f"A ray {passage.text}, {when}",
                    cylinder(passage.radius, HEIGHT),
                    plus(passage.at, passage.direction, -before),
                    passage.direction,
                    frame=frame,
                    tier="stiff",
                    flags=flags + (("behind",) if before < 0 else ()),
                    known=known,
                )


def _near_rims(fmt: Format) -> Iterator[Case]:
    for k in gaps(fmt, 8):
        gap = two(-k)
        for side, sign in (("inside", -1), ("outside", 1)):
            yield from _past_the_rim(fmt, f"{side}-{power(-k)}", f"2^-{k} {side}", sign * gap)


def _past_the_rim(fmt: Format, slug: str, text: str, gap: Fraction) -> Iterator[Case]:
    """Yield rays that miss the rim of a cylinder with r = 1, |z| <= 1 by `gap`, upwards."""
    body = cylinder(1, 2, -1)
    inside = gap < 0
    shapes: tuple[tuple[str, str, Exact, Exact, Pairs | None], ...] = (
        ("corner", "cuts the corner of the rim", (-3, 0, -1 + gap), (1, 0, 1),
         pair(2, 2 - gap) if inside else MISS),
        ("level", "runs level with the cap", (-3, 0, 1 + gap), (1, 0, 0),
         pair(2, 4) if inside else MISS),
        ("tangent", "touches the wall near the rim", (-3, 1, 1 + gap), (1, 0, 0),
         touch(3) if inside else MISS),
        ("upright", "runs up the wall", (1 + gap, 0, -3), (0, 0, 1),
         pair(2, 4) if inside else MISS),
        ("steep", "leaves near the rim of q", (-1, 0, -1 + gap), (1, 0, 1),
         pair(-gap, 2) if inside else pair(0, 2 - gap)),
    )  # fmt: skip
    for name, how, origin, direction, known in shapes:
        for frame in (UPRIGHT, DOWN_X, NINTHS) if name == "corner" else (UPRIGHT,):
            yield row(
                fmt,
                f"{name}-{slug}",
                f"A ray {text} the rim {how}",
                body,
                origin,
                direction,
                frame=frame,
                tier="stiff",
                flags=("near-rim",),
                known=known,
            )


FAMILIES = (
    Family("rim", "Rims entered, left, touched, and rim to rim.", _rims),
    Family("rim-near", "Rims passed by a small gap on both sides.", _near_rims),
)
