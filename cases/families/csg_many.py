"""Many parts: rows, combs and chains, nested shells, deep trees, endless and empty ones."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.case import Case, Family
from raycert.cases.families.bench import Bench, Shot, shoot_once
from raycert.cases.families.frames import Number, frames_for
from raycert.cases.families.shapes import (
    Node,
    Shape,
    all_of,
    any_of,
    ball,
    below,
    layer,
    less,
    one_frame,
    pipe,
    rod,
    scene,
    spans,
)
from raycert.cases.families.sketch import ALWAYS, MISS, Pairs, pair, touch
from raycert.cases.families.stretches import AHEAD, START, WHOLE, Rule, d, n, placed, u
from raycert.cases.formats import Format

MANY = ("many-intervals",)
COUNTS = (3, 4, 6, 8)
WAYS = ("ball", "rod", "caps", "ball-aside")


def _each(count: int, every: int, length: int, first: int = 1) -> list[tuple[int, int]]:
    """Return `count` stretches of a length, their starts `every` apart."""
    return [(first + every * i, first + every * i + length) for i in range(count)]


def _holes(whole: tuple[int, int], holes: list[tuple[int, int]]) -> Pairs:
    """Return what is left of a stretch between sorted holes."""
    ends = [whole[0], *(end for hole in holes for end in hole), whole[1]]
    left: list[tuple[Number, Number]] = list(zip(ends[::2], ends[1::2], strict=True))
    return spans(*((a, b) for a, b in left if a < b))


def _rows(fmt: Format) -> Iterator[Case]:
    for count in COUNTS:
        apart, joined = _each(count, 4, 2), _each(count, 2, 2)
        last = 4 * count + 2
        for way in WAYS:
            parts = [WHOLE[way](*stretch) for stretch in apart]
            chain = [WHOLE[way](*stretch) for stretch in joined]
            whole = rod((0, 0, 0), (4 * last, 0, 0), 16)
            left = _holes((0, last), apart)
            forms: tuple[tuple[str, str, Node, Pairs], ...] = (
                ("row", "parts in a row", any_of(*parts), spans(*apart)),
                ("backwards", "parts in a row, last first", any_of(*parts[::-1]), spans(*apart)),
                ("comb", "holes in a cylinder", less(whole, *parts), left),
                ("chain", "parts that touch", any_of(*chain), pair(1, 2 * count + 1)),
            )
            for slug, text, shape, known in forms:
                if count > 6 and (slug == "backwards" or way == "caps"):
                    continue
                yield scene(
                    fmt,
                    f"{slug}-{count}-{way}",
                    f"A ray meets {count} {text}, each a {way}",
                    shape,
                    START,
                    AHEAD,
                    frame=frames_for(f"{slug}-{count}-{way}", 1, 1)[count % 2],
                    flags=("touching-parts",) if slug == "chain" else MANY,
                    known=known,
                )


def _onions(fmt: Format) -> Iterator[Case]:
    """Yield shells in shells: spheres or cylinders less the next smaller, up to 6 of them."""
    for count in (3, 4, 5, 6):
        for way in ("ball", "rod", "ball-aside", "pipe-aside"):
            layers = [WHOLE[way](k, 24 - k) for k in range(2, 2 + count)]
            shape: Shape = layers[-1]
            for one in layers[-2::-1]:
                shape = less(one, shape)
            ends = [*range(2, 2 + count), *range(23 - count, 23)]
            for frame in one_frame(f"{count}-{way}"):
                yield scene(
                    fmt,
                    f"onion-{count}-{way}",
                    f"A ray meets {count} nested parts, each less the next, {way} by {way}",
                    shape,
                    START,
                    AHEAD,
                    frame=frame,
                    flags=("deep-tree", "many-intervals"),
                    known=spans(*_between(ends)),
                )


def _between(ends: list[int]) -> list[tuple[int, int]]:
    """Return the stretches of an onion from its sorted ends; an odd one has a core."""
    return list(zip(ends[::2], ends[1::2], strict=True))


A, B, C, D = (0, 16), (2, 10), (4, 12), (6, 8)
DEEP = (
    ("less-less-less", d(A, d(B, d(C, D))), spans((0, 2), (4, 6), (8, 16))),
    ("less-left", d(d(d(A, B), C), D), spans((0, 2), (12, 16))),
    ("or-and-less", u(n(d(A, B), C), D), spans((6, 8), (10, 12))),
    ("and-or-less", n(u(d(A, C), D), B), spans((2, 4), (6, 8))),
    ("less-and-or", d(n(u(B, D), A), C), pair(2, 4)),
    ("less-or-and", d(u(n(A, B), C), D), spans((2, 6), (8, 12))),
    ("and-less-or", n(d(A, u(C, D)), B), pair(2, 4)),
    ("or-less-and", u(d(A, n(B, C)), D), spans((0, 4), (6, 8), (10, 16))),
    ("balanced", d(u(A, B), n(C, D)), spans((0, 6), (8, 16))),
    ("halves", n(u(n(A, B), n(C, D)), u(d(A, B), d(B, D))), spans((2, 6), (8, 10))),
    ("four-down", d(A, u(B, n(C, d(A, D)))), spans((0, 2), (12, 16))),
    ("four-up", u(D, n(C, u(D, d(A, B)))), spans((6, 8), (10, 12))),
    ("double-not", d(A, d(A, d(A, d(A, C)))), pair(4, 12)),
    ("touching-deep", n(d(A, d(B, D)), u(d(C, D), (0, 2))), spans((0, 2), (6, 6), (8, 8), (10,
     12))),
)  # fmt: skip


def _deep(fmt: Format) -> Iterator[Case]:
    for slug, term, known in DEEP:
        rule = Rule(slug, f"a deep tree, {slug.replace('-', ' ')}", term, known, ("deep-tree",))
        yield from placed(fmt, rule, ("balls", "mixed"), ("mixed",))


UP, DOWN = below((0, 0, 0), (0, 0, -2)), below((0, 0, 0), (0, 0, 2))
OVER, UNDER = below((0, 0, 4), (0, 0, -2)), below((0, 0, -4), (0, 0, 1))
CUBE = all_of(*(below(p, p) for p in (
    (4, 0, 0), (-4, 0, 0), (0, 4, 0), (0, -4, 0), (0, 0, 4), (0, 0, -4),
)))  # fmt: skip
WEDGE = all_of(below((0, 0, 0), (2, 0, 0)), DOWN)
GRID = less(any_of(UP, DOWN), ball(4))
CROSS = any_of(pipe((0, 0, 0), (0, 0, 4), 4), pipe((0, 0, 0), (0, 4, 0), 4))
RISE, LEVEL, SLOPE = ((0, 1, -8), (0, 0, 4)), ((-8, 1, 0), (4, 0, 0)), ((-8, 0, -8), (4, 0, 4))
ENDLESS = (
    Bench("everything", "two half-spaces that cover all", any_of(UP, DOWN), ("endless",), (
        Shot("rising", *RISE, ALWAYS), Shot("in-the-shared-plane", *LEVEL, ALWAYS),
        Shot("slanted", *SLOPE, ALWAYS), Shot("rest-on-the-plane", (1, 2, 0), (0, 0, 0), ALWAYS),
    )),
    Bench("plane", "what two opposite half-spaces share", all_of(UP, DOWN), ("endless",), (
        Shot("rising", *RISE, touch(2)), Shot("in-the-shared-plane", *LEVEL, ALWAYS),
        Shot("slanted", *SLOPE, touch(2)), Shot("start-and-leave", (1, 2, 0), (1, 0, 1), touch(0)),
        Shot("rest-beside-the-plane", (1, 2, 1), (0, 0, 0), MISS),
    )),
    Bench("complement", "a half-space less its opposite", less(UP, DOWN), ("endless",), (
        Shot("rising", *RISE, pair(2, None)), Shot("in-the-shared-plane", *LEVEL, MISS),
        Shot("falling", (0, 1, 8), (0, 0, -4), pair(0, 2)),
    )),
    Bench("apart", "two half-spaces apart", any_of(OVER, UNDER), ("endless",), (
        Shot("rising", *RISE, spans((0, 1), (3, None))), Shot("level-between", *LEVEL, MISS),
        Shot("slanted", *SLOPE, spans((0, 1), (3, None))),
    )),
    Bench("nothing", "half-spaces with nothing in common", all_of(OVER, UNDER), ("endless",), (
        Shot("rising", *RISE, MISS), Shot("slanted", *SLOPE, MISS),
    )),
    Bench("cube", "a cube of six half-spaces", CUBE, ("endless",), (
        Shot("through", *RISE, pair(1, 3)), Shot("through-corners", (-8, -8, -8), (4, 4, 4), pair(1,
             3)),
        Shot("in-a-face-plane", (-8, 0, 4), (4, 0, 0), pair(1, 3)),
        Shot("along-an-edge", (-8, 4, 4), (4, 0, 0), pair(1, 3)),
        Shot("past-a-corner", (-8, 4, 0), (4, 4, 0), MISS),
        Shot("touching-an-edge", (-8, 0, 0), (4, 4, 0), touch(1)),
        Shot("touching-a-corner", (-8, 0, 2), (4, 4, 2), touch(1)),
        Shot("inside", (0, 0, 0), (1, 2, 4), pair(0, 1)),
    )),
    Bench("wedge", "a wedge of two half-spaces", WEDGE, ("endless",), (
        Shot("in", (8, 0, -4), (-4, 0, 0), pair(2, None)), Shot("touching-the-edge", (-4, 0, 4), (4,
             0, -4), touch(1)),
        Shot("along-the-edge", (0, -4, 0), (0, 4, 0), ALWAYS), Shot("down", (-4, 0, 8), (0, 0, -4),
             pair(2, None)),
    )),
    Bench("all-but", "everything less a sphere", GRID, ("endless",), (
        Shot("through", *RISE, None), Shot("level", (-8, 0, 0), (4, 0, 0), spans((0, 1), (3,
             None))),
        Shot("inside", (0, 0, 0), (0, 4, 0), pair(1, None)), Shot("tangent", (-8, 4, 0), (4, 0, 0),
             ALWAYS),
    )),
    Bench("cross", "two crossing tubes", CROSS, ("endless",), (
        Shot("through-both", (-8, 0, 0), (4, 0, 0), pair(1, 3)), Shot("along-one", *RISE, ALWAYS),
        Shot("in-both-walls", (4, 0, -8), (0, 0, 4), ALWAYS), Shot("skew", (-8, 8, 8), (4, -4, -4),
             None),
    )),
    Bench("tunnel", "a slab less a tube", less(layer((0, 0, -4), (0, 0, 4)), pipe((0, 0, 0), (0, 4,
        0), 4)),
        ("endless", "coincident-faces"), (
        Shot("level", (-8, 0, 0), (4, 0, 0), spans((0, 1), (3, None))),
        Shot("in-the-slab-face", (-8, 0, 4), (4, 0, 0), ALWAYS),
        Shot("down", (0, 0, 8), (0, 0, -4), MISS), Shot("down-the-tangent", (4, 0, 8), (0, 0, -4),
             pair(1, 3)),
    )),
)  # fmt: skip
EMPTY = (
    Rule("disjoint", "[0,2] n [4,6]", n((0, 2), (4, 6)), MISS, ("empty",)),
    Rule("swallowed", "[2,4] - [0,8]", d((2, 4), (0, 8)), MISS, ("empty",)),
    Rule("by-two", "[2,6] - [0,4] - [3,8]", d((2, 6), (0, 4), (3, 8)), MISS, ("empty",)),
    Rule("nested-nothing", "A - (A u B)", d((2, 4), u((2, 4), (6, 8))), MISS, ("empty",)),
    Rule("nothing-and", "(A n B) n C", n(n((0, 2), (4, 6)), (0, 8)), MISS, ("empty",)),
    Rule("nothing-less", "(A n B) - C", d(n((0, 2), (4, 6)), (0, 8)), MISS, ("empty",)),
    Rule("or-nothing", "(A n B) u C", u(n((0, 2), (4, 6)), (2, 4)), pair(2, 4), ("empty",)),
    Rule("less-nothing", "C - (A n B)", d((2, 4), n((0, 2), (4, 6))), pair(2, 4), ("empty",)),
)


def _empty(fmt: Format) -> Iterator[Case]:
    for rule in EMPTY:
        yield from placed(fmt, rule, ("balls", "rods", "mixed"), ("mixed",))


FAMILIES = (
    Family("csg-many", "Rows, combs and chains: up to 13 intervals.", _rows),
    Family("csg-onion", "Each part less the next smaller one.", _onions),
    Family("csg-deep", "Trees of three and four levels.", _deep),
    Family(
        "csg-endless", "Parts that never end: all of space, planes, wedges.", shoot_once(ENDLESS)
    ),
    Family("csg-empty", "Lists that are empty, inside a tree or at its root.", _empty),
)
