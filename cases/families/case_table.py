"""The three tables: golden rows for each of their rows and cells, exact by construction.

The ray moves in a plane square to the lateral axis: a motion across the infinite cylinder, whose
crossings (t1, t2) are chosen, and a motion along the axis, whose crossings with the cap planes are
chosen too. Origin, direction, radius and height follow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

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
    spans,
    tube,
)
from raycert.cases.formats import Format
from raycert.cases.table import PROBLEM_1, comparison_names

Span = tuple[Number, Number | None]


@dataclass(frozen=True, slots=True)
class Across:
    """A motion across the infinite cylinder: x = x0 + vx t at a fixed y, and the row it takes.

    `span` is what the infinite cylinder emits, or None.
    """

    row: str
    name: str
    text: str
    radius: Number
    x: Number
    vx: Number
    y: Number
    span: Span | None
    flags: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Along:
    """A motion along the axis: z = z0 + vz t between planes at 0 (p) and `height` (q)."""

    row: str
    name: str
    text: str
    height: Number
    z: Number
    vz: Number
    span: Span | None
    flags: tuple[str, ...] = ()


def _clip(t1: Number, t2: Number) -> Span | None:
    return None if t2 < 0 else (max(t1, 0), t2)


def _row_of(t1: Number, t2: Number) -> str:
    if t2 < 0:
        return "behind"
    return "from-inside" if t1 < 0 else "through"


def chord(t1: int, t2: int) -> Across:
    """Cross the wall at t1 < t2, beside the axis: y = 3, half chord 4, radius 5."""
    vx = Fraction(8, t2 - t1)
    text = "off the axis"
    return Across(_row_of(t1, t2), "chord", text, 5, -4 - t1 * vx, vx, 3, _clip(t1, t2))


def diameter(t1: int, t2: int) -> Across:
    """Cross the wall at t1 < t2, through the axis: radius 4."""
    vx = Fraction(8, t2 - t1)
    text = "through the axis"
    return Across(_row_of(t1, t2), "diameter", text, 4, -4 - t1 * vx, vx, 0, _clip(t1, t2))


def graze(t: int) -> Across:
    """Touch the wall at t: y = radius."""
    text = "tangent to the wall"
    return Across(_row_of(t, t), "graze", text, 4, -4 * t, 4, 4, _clip(t, t), ("tangent",))


def _still(name: str, text: str, x: int, y: int, radius: int = 4, *flags: str) -> Across:
    inside = x * x + y * y <= radius * radius
    kind = "along-inside" if inside else "along-outside"
    return Across(kind, name, text, radius, x, 0, y, (0, None) if inside else None, flags)


def rising(start: int, end: int, vz: int) -> Along:
    """Cross the plane of p at `start` and that of q at `end`, moving from p to q."""
    height = vz * (end - start)
    kind = "CF" if start > 0 else "AF"
    return Along(kind, "planes", "from p to q", height, -vz * start, vz, _clip(start, end))


def falling(start: int, end: int, vz: int) -> Along:
    """Cross the plane of q at `start` and that of p at `end`, moving from q to p."""
    height = vz * (end - start)
    kind = "BG" if start > 0 else "BE"
    z = height + vz * start
    return Along(kind, "planes", "from q to p", height, z, -vz, _clip(start, end))


def _level(kind: str, name: str, text: str, z: int, *flags: str) -> Along:
    inside = 0 <= z <= 8
    return Along(kind, name, text, 8, z, 0, (0, None) if inside else None, flags)


LEVEL = (
    _level("AE", "between", "between the caps", 2),
    _level("AE", "in-cap-p", "in the plane of p", 0, "cap-plane"),
    _level("AE", "in-cap-q", "in the plane of q", 8, "cap-plane"),
    _level("AH", "level", "level beyond q", 10),
    _level("DE", "level", "level beyond p", -2),
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
    Across("miss", "wide", "wide of the wall", 4, -8, 4, 5, None),
    Across("miss", "receding", "wide of the wall and moving away", 4, 8, 4, 6, None, ("behind",)),
)
SPANS = [(a, b) for a in range(-3, 5) for b in range(a + 1, 6) if b - a in (1, 2, 4)]
"""Crossing times of a chord."""
TIMES = [(a, b) for a in range(-2, 5) for b in range(a + 1, 6)]
"""Crossing times of the two planes."""


def across(kind: str) -> list[Across]:
    """Return the motions across that take a row of Problem 1, the plainest first."""
    chords = [make(a, b) for make in (chord, diameter) for a, b in SPANS]
    motions = [*STILL, *MISSES, *chords, *(graze(t) for t in range(-2, 5))]
    return [motion for motion in motions if motion.row == kind]


def leaving(vz: int) -> tuple[Along, Along]:
    """Return the motions away from the slab, beyond either plane."""
    return (
        Along("AH", "away", "beyond q and moving away", 8, 10, vz, None, ("behind",)),
        Along("DE", "away", "beyond p and moving away", 8, -2, -vz, None, ("behind",)),
    )


def along(vz: int) -> list[Along]:
    """Return the motions along the axis, the plainest first."""
    planes = [make(a, b, vz) for make in (falling, rising) for a, b in TIMES if b >= 0]
    return [*LEVEL, *leaving(vz), *planes]


def cell_of(one: Across, two: Along) -> tuple[str, ...]:
    """Return the comparisons of the two spans, in the words of a slug; empty where one is empty.

    >>> cell_of(chord(1, 3), falling(2, 4, 3))
    ('a-before-c', 'b-before-d', 'm-before-n')
    """
    if one.span is None or two.span is None:
        return ()
    signs = {
        "a-c": _compare(one.span[0], two.span[0]),
        "b-d": _compare(one.span[1], two.span[1]),
        "m-n": _compare(max(one.span[0], two.span[0]), _least(one.span[1], two.span[1])),
    }
    words = {"<": "-before-", "=": "-with-", ">": "-after-"}
    return tuple(name[0] + words[name[1]] + name[2] for name in comparison_names(signs))


def _least(a: Number | None, b: Number | None) -> Number | None:
    if a is None or b is None:
        return b if a is None else a
    return min(a, b)


def _compare(a: Number | None, b: Number | None) -> int:
    """Return the sign of a - b, None being infinity and equal to itself."""
    if a is None or b is None:
        return int(a is None) - int(b is None)
    return (a > b) - (a < b)


def _meet(one: Span | None, two: Span | None) -> Pairs:
    if one is None or two is None:
        return MISS
    enter, leave = max(one[0], two[0]), _least(one[1], two[1])
    return pair(enter, leave) if leave is None or enter <= leave else MISS


def _plainest(kind: str) -> Iterator[tuple[Across, Along, tuple[str, ...]]]:
    """Yield the first motions for each cell and each manner of motion."""
    seen = set()
    for one in across(kind):
        for two in along(3 if one.vx else 2):
            if one.name == "diameter" and two.vz:
                continue  # a slanted ray through the axis says no more than one beside it
            cell = cell_of(one, two)
            key = (one.name, two.row, two.name, cell)
            if key not in seen:
                seen.add(key)
                yield one, two, cell


def _rows_of(kind: str) -> Callable[[Format], Iterator[Shot]]:
    return lambda _: (_cell(one, two, cell) for one, two, cell in _plainest(kind))


def _cell(one: Across, two: Along, cell: tuple[str, ...]) -> Shot:
    words = [two.row.lower(), *cell, one.name]
    if two.name != "planes":
        words.append(two.name)
    flags = [*one.flags, *two.flags]
    if one.vx == 0:
        flags.append("zero-direction" if two.vz == 0 else "parallel")
    elif two.vz == 0:
        flags.append("perpendicular")
    straight = one.vx == 0 or two.vz == 0
    return Shot(
        "-".join(words), f"{_sentence(one, two)}{_order(cell)}",
        cylinder(one.radius, two.height), (one.x, one.y, two.z), (one.vx, 0, two.vz),
        _meet(one.span, two.span), drawn(2 if straight else 1, 1), tuple(flags),
    )  # fmt: skip


def _sentence(one: Across, two: Along) -> str:
    subject = "a still ray" if one.vx == two.vz == 0 else "a ray"
    return f"Row {two.row} takes {subject} {one.text}, {two.text}"


def _order(cell: tuple[str, ...]) -> str:
    """Return the comparisons in symbols: `: a < c, b = d, m < n`."""
    symbols = {"before": "<", "with": "=", "after": ">"}
    parts = (name.split("-") for name in cell)
    text = ", ".join(f"{left} {symbols[word]} {right}" for left, word, right in parts)
    return f": {text}" if text else ""


WHEN = {
    "ahead": (1, 3),
    "from-the-wall": (0, 2),
    "from-inside": (-1, 1),
    "leaving": (-2, 0),
    "behind": (-3, -1),
}
TOUCHES = {"ahead": 2, "at-the-start": 0, "behind": -2}


def _crossings() -> Iterator[tuple[str, tuple[int, int], Across]]:
    """Yield (slug, crossing times, motion) of chords and diameters."""
    for when, (t1, t2) in WHEN.items():
        for one in (chord(t1, t2), diameter(t1, t2)):
            yield f"{one.name}-{when}", (t1, t2), one


def _motions() -> Iterator[tuple[str, str, Across]]:
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
            if one.vx == vz == 0:
                continue
            way = ("parallel",) if one.vx == 0 else () if vz else ("perpendicular",)
            yield Shot(
                f"{name}-{word}", f"A ray is {one.text}{when}, {text} a part along the axis",
                tube(one.radius), (one.x, one.y, 2), (one.vx, 0, vz),
                MISS if one.span is None else spans(one.span), flags=(*one.flags, *way),
            )  # fmt: skip


def _sphere_rows(_: Format) -> Iterator[Shot]:
    for slug, (t1, t2), one in _crossings():
        text = f"A ray meets a sphere {one.text.replace('axis', 'centre')}"
        yield Shot(
            slug, f"{text}, at t = {t1} and t = {t2}", ball(one.radius), (one.x, one.y, 0),
            (one.vx, 0, 0), MISS if one.span is None else spans(one.span), _moved(2, 1),
            _start_flags(t1, t2),
        )  # fmt: skip
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
    "beyond-p": (-1, "beyond p"),
    "on-p": (0, "on the plane of p"),
    "between": (2, "between the planes"),
    "on-q": (8, "on the plane of q"),
    "beyond-q": (9, "beyond q"),
}
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
                yield Shot(
                    f"{place}-{move}-{slant}", f"A ray starts {where} and goes {way}, {how}",
                    slab(height) if height else half_space(normal=2), (1, -3, z), (vx, vy, vz),
                    between(z, vz, 0, height) if height else _below(z, vz),
                    flags=(*on, "cap-plane") if on and not vz else on,
                )  # fmt: skip


def _near_parallel(fmt: Format) -> Iterator[Shot]:
    for name, tilt in slopes(fmt):
        sink, rise = near(fmt, -tilt), near(fmt, tilt)
        for body, slug, what, start, vz, known, frame in (
            (half_space(), "above-sinking", "sinks into", 1, sink, _below(1, sink), UPRIGHT),
            (half_space(), "below-rising", "rises out of", -1, rise, _below(-1, rise), SEVENTHS),
            (slab(4), "above-sinking", "sinks through", 6, sink, between(6, sink, 0, 4), UPRIGHT),
            (slab(4), "inside-rising", "rises out of", 1, rise, between(1, rise, 0, 4), SEVENTHS),
        ):
            yield Shot(
                f"{body.word}-{slug}-{name}", f"A ray {what} {body.noun} with a slope of {name}",
                body, (2, 1, start), (1, 0, vz), known, frame,
            )  # fmt: skip


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
