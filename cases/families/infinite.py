"""The infinite cylinder alone: each row of Problem 1, level and climbing."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.case import Case, Family
from raycert.cases.families.case_table import MISSES, STILL, Across, chord, diameter, graze
from raycert.cases.families.frames import frames_for
from raycert.cases.families.sketch import MISS, row, tube
from raycert.cases.formats import Format

SPANS = {
    "ahead": (1, 3),
    "from-the-wall": (0, 2),
    "from-inside": (-1, 1),
    "leaving": (-2, 0),
    "behind": (-3, -1),
}
TOUCHES = {"ahead": 2, "at-the-start": 0, "behind": -2}


def _motions() -> Iterator[tuple[str, str, Across]]:
    """Yield (slug, words for when, motion)."""
    for when, (t1, t2) in SPANS.items():
        for make in (chord, diameter):
            one = make(t1, t2)
            yield f"{one.name}-{when}", f", from t = {t1} to {t2}", one
    for when, t in TOUCHES.items():
        yield f"graze-{when}", f" at t = {t}", graze(t)
    for one in (*STILL, *MISSES):
        yield one.name, "", one


def _rows(fmt: Format) -> Iterator[Case]:
    for name, when, one in _motions():
        for word, text, vz in (("level", "without", 0), ("climbing", "with", 2)):
            if one.vx == vz == 0:
                continue
            slug = f"{name}-{word}"
            flags = (*one.flags, *_flags(one, vz))
            for frame in frames_for(slug, aligned=1, oblique=1):
                yield row(
                    fmt,
                    slug,
                    f"A ray is {one.text}{when}, {text} a part along the axis",
                    tube(one.radius),
                    (one.x, one.y, 2),
                    (one.vx, 0, vz),
                    frame=frame,
                    flags=flags,
                    known=MISS if one.span is None else (one.span,),
                )


def _flags(one: Across, vz: int) -> tuple[str, ...]:
    if one.vx == 0:
        return ("parallel",)
    return () if vz else ("perpendicular",)


FAMILIES = (
    Family("infinite-cylinder-rows", "Each row of Problem 1, with and without a climb.", _rows),
)
