"""The case table: golden rows for each of its cells, exact by construction.

The ray moves in a plane square to the lateral axis: a motion across the infinite cylinder, whose
crossings (t1, t2) are chosen, and a motion along the axis, whose crossings with the cap planes are
chosen too. Origin, direction, radius and height follow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import Number, frames_for
from raycert.cases.families.sketch import ALWAYS, MISS, Pairs, cylinder, pair, row
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
    if leave is None:
        return ALWAYS if enter == 0 else pair(enter, None)
    return pair(enter, leave) if enter <= leave else MISS


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


def _rows_of(kind: str) -> Callable[[Format], Iterable[Case]]:
    def cases(fmt: Format) -> Iterator[Case]:
        for one, two, cell in _plainest(kind):
            yield from _placed(fmt, one, two, cell)

    return cases


def _placed(fmt: Format, one: Across, two: Along, cell: tuple[str, ...]) -> Iterator[Case]:
    words = [two.row.lower(), *cell, one.name]
    if two.name != "planes":
        words.append(two.name)
    slug = "-".join(words)
    flags = [*one.flags, *two.flags]
    if one.vx == 0:
        flags.append("zero-direction" if two.vz == 0 else "parallel")
    elif two.vz == 0:
        flags.append("perpendicular")
    straight = one.vx == 0 or two.vz == 0
    for frame in frames_for(slug, aligned=2 if straight else 1, oblique=1):
        yield row(
            fmt,
            slug,
            f"{_sentence(one, two)}{_order(cell)}",
            cylinder(one.radius, two.height),
            (one.x, one.y, two.z),
            (one.vx, 0, two.vz),
            frame=frame,
            flags=tuple(dict.fromkeys(flags)),
            known=_meet(one.span, two.span),
        )


def _sentence(one: Across, two: Along) -> str:
    subject = "a still ray" if one.vx == two.vz == 0 else "a ray"
    return f"Row {two.row} takes {subject} {one.text}, {two.text}"


def _order(cell: tuple[str, ...]) -> str:
    """Return the comparisons in symbols: `: a < c, b = d, m < n`."""
    symbols = {"before": "<", "with": "=", "after": ">"}
    parts = (name.split("-") for name in cell)
    text = ", ".join(f"{left} {symbols[word]} {right}" for left, word, right in parts)
    return f": {text}" if text else ""


FAMILIES = tuple(
    Family(
        f"table-{one.name}",
        f"Every reachable cell of the case table with the row {one.name} of Problem 1.",
        _rows_of(one.name),
    )
    for one in PROBLEM_1
)
