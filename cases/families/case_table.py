"""The three tables: golden rows for each of their rows and cells, exact by construction.

The ray moves in a plane square to the lateral axis: a motion across the infinite cylinder, whose
crossings (t1, t2) are chosen, and a motion along the axis, whose crossings with the cap planes are
chosen too. Origin, direction, radius and height follow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import inf

from raycert.cases.families.frames import SEVENTHS, UPRIGHT, Frame, Number, frames_for
from raycert.cases.families.shots import Flags, Shot, drawn, family, slopes, table
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Pairs,
    ball,
    between,
    cylinder,
    half_space,
    near,
    pair,
    slab,
    tube,
)
from raycert.cases.formats import Format
from raycert.cases.table import PROBLEM_1, comparison_names

Span = tuple[Number, Number | float]
"""Of t, from 0 on; the end may be infinity."""
ENDLESS: Span = (0, inf)


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion across the infinite cylinder at a fixed y, or along the axis, and the row it takes.

    `at` and `speed` are x and vx, or z and vz; `size` is the radius, or the height of q over p.
    `span` is what the infinite cylinder or the slab emits, or None.
    """

    row: str
    name: str
    text: str
    size: Number
    at: Number
    speed: Number
    span: Span | None
    flags: Flags = ()
    y: Number = 0


def _ahead(t1: Number, t2: Number) -> Span | None:
    return None if t2 < 0 else (max(t1, 0), t2)


def _across(
    name: str, text: str, radius: int, y: int, times: tuple[int, int], *flags: str
) -> Motion:
    """Cross the wall at these times: it is 4 on each side of the axis, or touched."""
    t1, t2 = times
    speed = Fraction(8, t2 - t1) if t1 < t2 else 4
    row = "behind" if t2 < 0 else "from-inside" if t1 < 0 else "through"
    start = -t1 * speed - (4 if t1 < t2 else 0)
    return Motion(row, name, text, radius, start, speed, _ahead(t1, t2), flags, y)


def chord(t1: int, t2: int) -> Motion:
    """Cross the wall at t1 < t2, beside the axis: y = 3, half chord 4, radius 5."""
    return _across("chord", "off the axis", 5, 3, (t1, t2))


def diameter(t1: int, t2: int) -> Motion:
    """Cross the wall at t1 < t2, through the axis: radius 4."""
    return _across("diameter", "through the axis", 4, 0, (t1, t2))


def graze(t: int) -> Motion:
    """Touch the wall at t: y = radius."""
    return _across("graze", "tangent to the wall", 4, 4, (t, t), "tangent")


def _still(name: str, text: str, x: int, y: int, radius: int = 4, *flags: str) -> Motion:
    if x * x + y * y <= radius * radius:
        return Motion("along-inside", name, text, radius, x, 0, ENDLESS, flags, y)
    return Motion("along-outside", name, text, radius, x, 0, None, flags, y)


def rising(start: int, end: int, vz: int) -> Motion:
    """Cross the plane of p at `start` and that of q at `end`, moving from p to q."""
    row, height = "CF" if start > 0 else "AF", vz * (end - start)
    return Motion(row, "planes", "from p to q", height, -vz * start, vz, _ahead(start, end))


def falling(start: int, end: int, vz: int) -> Motion:
    """Cross the plane of q at `start` and that of p at `end`, moving from q to p."""
    row, height = "BG" if start > 0 else "BE", vz * (end - start)
    return Motion(row, "planes", "from q to p", height, vz * end, -vz, _ahead(start, end))


LEVEL = (
    Motion("AE", "between", "between the caps", 8, 2, 0, ENDLESS),
    Motion("AE", "in-cap-p", "in the plane of p", 8, 0, 0, ENDLESS, ("cap-plane",)),
    Motion("AE", "in-cap-q", "in the plane of q", 8, 8, 0, ENDLESS, ("cap-plane",)),
    Motion("AH", "level", "level beyond q", 8, 10, 0, None),
    Motion("DE", "level", "level beyond p", 8, -2, 0, None),
)
STILL = (
    _still("axis", "on the axis", 0, 0),
    _still("inside", "inside the wall", 1, 2),
    _still("wall", "in the wall", 0, 4, 4, "wall"),
    _still("skew-wall", "in the wall at (3, 4)", 3, 4, 5, "wall"),
    _still("outside", "outside the wall", 0, 5),
    _still("corner", "outside the wall but inside its square", 3, 3),
)
MISSES = (
    Motion("miss", "wide", "wide of the wall", 4, -8, 4, None, (), 5),
    Motion("miss", "receding", "wide of the wall and moving away", 4, 8, 4, None, ("behind",), 6),
)
SPANS = [(a, b) for a in range(-3, 5) for b in range(a + 1, 6) if b - a in (1, 2, 4)]
"""Crossing times of a chord."""
TIMES = [(a, b) for a in range(-2, 5) for b in range(a + 1, 6)]
"""Crossing times of the two planes."""


def across(kind: str) -> list[Motion]:
    """Return the motions across that take a row of Problem 1, the plainest first."""
    chords = [make(a, b) for make in (chord, diameter) for a, b in SPANS]
    motions = [*STILL, *MISSES, *chords, *(graze(t) for t in range(-2, 5))]
    return [motion for motion in motions if motion.row == kind]


def along(vz: int) -> list[Motion]:
    """Return the motions along the axis, the plainest first."""
    planes = [make(a, b, vz) for make in (falling, rising) for a, b in TIMES if b >= 0]
    leaving = (
        Motion("AH", "away", "beyond q and moving away", 8, 10, vz, None, ("behind",)),
        Motion("DE", "away", "beyond p and moving away", 8, -2, -vz, None, ("behind",)),
    )
    return [*LEVEL, *leaving, *planes]


def cell_of(one: Motion, two: Motion) -> tuple[str, ...]:
    """Return the comparisons of the two spans, in the words of a slug; empty where one is empty.

    >>> cell_of(chord(1, 3), falling(2, 4, 3))
    ('a-before-c', 'b-before-d', 'm-before-n')
    """
    if one.span is None or two.span is None:
        return ()
    (a, b), (c, d) = one.span, two.span
    m, n = max(a, c), min(b, d)
    signs = {"a-c": (a > c) - (a < c), "b-d": (b > d) - (b < d), "m-n": (m > n) - (m < n)}
    words = {"<": "-before-", "=": "-with-", ">": "-after-"}
    return tuple(name[0] + words[name[1]] + name[2] for name in comparison_names(signs))


def _meet(one: Span | None, two: Span | None = ENDLESS) -> Pairs:
    if one is None or two is None:
        return MISS
    enter, leave = max(one[0], two[0]), min(one[1], two[1])
    if enter > leave:
        return MISS
    return pair(enter, None if leave == inf else Fraction(leave))


def _plainest(kind: str) -> Iterator[tuple[Motion, Motion, tuple[str, ...]]]:
    """Yield the first motions for each cell and each manner of motion."""
    seen = set()
    for one in across(kind):
        for two in along(3 if one.speed else 2):
            if one.name == "diameter" and two.speed:
                continue  # a slanted ray through the axis says no more than one beside it
            cell = cell_of(one, two)
            key = (one.name, two.row, two.name, cell)
            if key not in seen:
                seen.add(key)
                yield one, two, cell


def _rows_of(kind: str) -> Callable[[Format], Iterator[Shot]]:
    return lambda _: (_cell(one, two, cell) for one, two, cell in _plainest(kind))


def _cell(one: Motion, two: Motion, cell: tuple[str, ...]) -> Shot:
    words = [two.row.lower(), *cell, one.name]
    if two.name != "planes":
        words.append(two.name)
    flags = [*one.flags, *two.flags]
    if one.speed == 0:
        flags.append("zero-direction" if two.speed == 0 else "parallel")
    elif two.speed == 0:
        flags.append("perpendicular")
    straight = one.speed == 0 or two.speed == 0
    return Shot("-".join(words), f"{_sentence(one, two)}{_order(cell)}",
                cylinder(one.size, two.size), (one.at, one.y, two.at), (one.speed, 0, two.speed),
                _meet(one.span, two.span), drawn(2 if straight else 1, 1),
                tuple(flags))  # fmt: skip


def _sentence(one: Motion, two: Motion) -> str:
    subject = "a still ray" if one.speed == two.speed == 0 else "a ray"
    return f"Row {two.row} takes {subject} {one.text}, {two.text}"


def _order(cell: tuple[str, ...]) -> str:
    """Return the comparisons in symbols: `: a < c, b = d, m < n`."""
    symbols = {"before": "<", "with": "=", "after": ">"}
    parts = (name.split("-") for name in cell)
    text = ", ".join(f"{left} {symbols[word]} {right}" for left, word, right in parts)
    return f": {text}" if text else ""


WHEN = {
    "ahead": (1, 3), "from-the-wall": (0, 2), "from-inside": (-1, 1), "leaving": (-2, 0),
    "behind": (-3, -1),
}  # fmt: skip
TOUCHES = {"ahead": 2, "at-the-start": 0, "behind": -2}


def _crossings() -> Iterator[tuple[str, tuple[int, int], Motion]]:
    """Yield (slug, crossing times, motion) of chords and diameters."""
    for when, (t1, t2) in WHEN.items():
        for one in (chord(t1, t2), diameter(t1, t2)):
            yield f"{one.name}-{when}", (t1, t2), one


def _motions() -> Iterator[tuple[str, str, Motion]]:
    """Yield (slug, words for when, motion)."""
    for slug, (t1, t2), one in _crossings():
        yield slug, f", from t = {t1} to {t2}", one
    for when, t in TOUCHES.items():
        yield f"graze-{when}", f" at t = {t}", graze(t)
    for one in (*STILL, *MISSES):
        yield one.name, "", one


def _tube_rows(_: Format) -> Iterator[Shot]:
    for name, when, one in _motions():
        for word, text, vz in (("level", "without", 0), ("climbing", "with", 2)):
            if one.speed == vz == 0:
                continue
            way = ("parallel",) if one.speed == 0 else () if vz else ("perpendicular",)
            yield Shot(f"{name}-{word}", f"A ray is {one.text}{when}, {text} a part along the axis",
                       tube(one.size), (one.at, one.y, 2), (one.speed, 0, vz),
                       _meet(one.span), flags=(*one.flags, *way))  # fmt: skip


def _sphere_rows(_: Format) -> Iterator[Shot]:
    for slug, (t1, t2), one in _crossings():
        text = f"A ray meets a sphere {one.text.replace('axis', 'centre')}"
        yield Shot(slug, f"{text}, at t = {t1} and t = {t2}", ball(one.size), (one.at, one.y, 0),
                   (one.speed, 0, 0), _meet(one.span), _moved(2, 1),
                   _start_flags(t1, t2))  # fmt: skip
    for shot in SPHERE_MISSES:
        yield shot.named("miss-{}", "A ray {}").but(frame=_moved(1, 2)(shot.slug))
    for shot in SPHERE_RESTS:
        on = ("start-on-surface",) if shot.slug in ("pole", "skew") else ()
        text = "A ray with no direction rests {}"
        frames = _moved(1, 1)(shot.slug)
        yield shot.named("rest-{}", text, "zero-direction", *on).but(frame=frames)


def _moved(aligned: int, oblique: int) -> Callable[[str], tuple[Frame, ...]]:
    """Return a draw of frames, every second one away from the coordinate origin."""

    def frames(slug: str) -> tuple[Frame, ...]:
        numbered = enumerate(frames_for(slug, aligned, oblique), len(slug))
        return tuple(frame.moved((8, -16, 4)) if i % 2 else frame for i, frame in numbered)

    return frames


def _start_flags(t1: int, t2: int) -> Flags:
    if t2 < 0:
        return ("behind",)
    if t1 == 0 or t2 == 0:
        return ("start-on-surface",)
    return ("start-inside",) if t1 < 0 else ()


SPHERE_MISSES = (
    Shot("wide", "passes wide of a sphere", ball(4), (-8, 5, 0), (4, 0, 0), MISS),
    Shot("corner", "passes a sphere, through its cube", ball(4), (-8, 3, 3), (4, 0, 0), MISS),
    Shot("receding", "moves away, its line wide of a sphere", ball(4), (8, 5, 1), (4, 0, 1), MISS,
         flags=("behind",)),
    Shot("away", "moves straight away from a sphere", ball(4), (0, 6, 0), (0, 2, 0), MISS,
         flags=("behind",)),
)  # fmt: skip
REST = (0, 0, 0)
SPHERE_RESTS = table(
    ("centre", "at the centre of a sphere", ball(4), (0, 0, 0), REST, ALWAYS),
    ("inside", "inside a sphere", ball(4), (1, 2, 3), REST, ALWAYS),
    ("pole", "on a sphere, straight above its centre", ball(4), (0, 0, 4), REST, ALWAYS),
    ("skew", "on a sphere, at (1, 2, 2)", ball(3), (1, 2, 2), REST, ALWAYS),
    ("corner", "beside a sphere, inside its cube", ball(4), (3, 3, 3), REST, MISS),
    ("outside", "outside a sphere", ball(4), (0, 0, 5), REST, MISS),
)
Places = dict[str, tuple[int, str]]
HALF_SPACE_PLACES = {"inside": (-6, "inside"), "on": (0, "on the plane"), "outside": (5, "outside")}
HALF_SPACE_MOVES = {"in": (-2, "inward"), "along": (0, "along the plane"), "out": (2, "outward")}
SLAB_PLACES = {
    "beyond-p": (-1, "beyond p"), "on-p": (0, "on the plane of p"),
    "between": (2, "between the planes"), "on-q": (8, "on the plane of q"),
    "beyond-q": (9, "beyond q"),
}  # fmt: skip
SLAB_MOVES = {"to-q": (2, "towards q"), "along": (0, "along the planes"), "to-p": (-2, "towards p")}


def _below(z: Number, vz: Number) -> Pairs:
    """Return where z + vz t <= 0."""
    if vz == 0:
        return ALWAYS if z <= 0 else MISS
    t = Fraction(-z) / vz
    if vz > 0:
        return pair(0, t) if t >= 0 else MISS
    return pair(max(t, Fraction(0)), None)


def _plane_rows(height: int, places: Places, moves: Places) -> Iterator[Shot]:
    """Yield the motions from each place at a slab of this height, or at a half-space (0)."""
    for place, (z, where) in places.items():
        for move, (vz, way) in moves.items():
            for slant, (vx, how) in {
                "straight": (0, "straight"),
                "slanted": (3, "with a part along the plane"),
            }.items():
                vx = 4 if move == "along" and not vx else vx
                vy = 2 if move == "along" and slant == "slanted" else 0
                on = ("start-on-surface",) if z in (0, height) else ()
                yield Shot(f"{place}-{move}-{slant}", f"A ray starts {where} and goes {way}, {how}",
                           slab(height) if height else half_space(normal=2), (1, -3, z),
                           (vx, vy, vz), between(z, vz, 0, height) if height else _below(z, vz),
                           flags=(*on, "cap-plane") if on and not vz else on)  # fmt: skip


def _near_parallel(fmt: Format) -> Iterator[Shot]:
    for name, tilt in slopes(fmt):
        sink, rise = near(fmt, -tilt), near(fmt, tilt)
        for body, slug, what, start, vz, known, frame in (
            (half_space(), "above-sinking", "sinks into", 1, sink, _below(1, sink), UPRIGHT),
            (half_space(), "below-rising", "rises out of", -1, rise, _below(-1, rise), SEVENTHS),
            (slab(4), "above-sinking", "sinks through", 6, sink, between(6, sink, 0, 4), UPRIGHT),
            (slab(4), "inside-rising", "rises out of", 1, rise, between(1, rise, 0, 4), SEVENTHS),
        ):
            yield Shot(f"{body.word}-{slug}-{name}",
                       f"A ray {what} {body.noun} with a slope of {name}", body, (2, 1, start),
                       (1, 0, vz), known, frame)  # fmt: skip


FAMILIES = (
    *(
        family(
            f"table-{one.name}",
            f"Every reachable cell of the case table with the row {one.name} of Problem 1.",
            _rows_of(one.name),
        )
        for one in PROBLEM_1
    ),
    family("infinite-cylinder-rows", "Each row of Problem 1, with and without a climb.", _tube_rows,
           frame=drawn(1, 1)),
    family("half-space-rows", "The four cases of Problem 2 (c), from each side.",
           tuple(_plane_rows(0, HALF_SPACE_PLACES, HALF_SPACE_MOVES)), frame=drawn(2, 2)),
    family("slab-rows", "The seven rows of Problem 2, starts on the planes included.",
           tuple(_plane_rows(8, SLAB_PLACES, SLAB_MOVES)), frame=drawn(2, 1)),
    family("planes-near-parallel", "A plane met at a vanishing angle.", _near_parallel,
           flags=("near-parallel",), tier="stiff"),
    family("sphere-rows", "Each row of Problem 1, the axis shrunk to the centre.", _sphere_rows),
)  # fmt: skip
