"""The algebra of lists, realised by solids: every way two closed intervals can meet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import permutations

from raycert.cases.case import Case, Family
from raycert.cases.dice import Dice
from raycert.cases.families.frames import SEVENTHS, UPRIGHT
from raycert.cases.families.shapes import Node, Shape, all_of, any_of, less, one_frame, scene, spans
from raycert.cases.families.sketch import ALWAYS, MISS, Pairs, pair, touch
from raycert.cases.families.stretches import (
    AHEAD,
    START,
    STYLES,
    WHOLE,
    Rule,
    Term,
    build,
    d,
    n,
    placed,
    u,
)
from raycert.cases.formats import Format

CLOSURE = ("closure",)
TOUCHING = ("touching-parts",)
SHARED = ("coincident-faces",)
DIFFERENCES = (
    Rule("abut", "[0,2] - [2,5]", d((0, 2), (2, 5)), pair(0, 2), CLOSURE),
    Rule("abut-even", "[0,2] - [2,4]", d((0, 2), (2, 4)), pair(0, 2), CLOSURE),
    Rule("prick", "[0,5] - [2,2]", d((0, 5), (2, 2)), pair(0, 5), CLOSURE),
    Rule("prick-even", "[0,8] - [4,4]", d((0, 8), (4, 4)), pair(0, 8), CLOSURE),
    Rule("drop", "[2,2] - [0,5]", d((2, 2), (0, 5)), MISS, CLOSURE),
    Rule("drop-even", "[2,2] - [0,4]", d((2, 2), (0, 4)), MISS, CLOSURE),
    Rule("same", "[0,2] - [0,2]", d((0, 2), (0, 2)), MISS, SHARED),
    Rule("prick-end", "[0,2] - [2,2]", d((0, 2), (2, 2)), pair(0, 2), CLOSURE),
    Rule("prick-start", "[0,2] - [0,0]", d((0, 2), (0, 0)), pair(0, 2), CLOSURE),
    Rule("abut-before", "[2,6] - [0,2]", d((2, 6), (0, 2)), pair(2, 6), CLOSURE),
    Rule("same-touch", "[2,2] - [2,2]", d((2, 2), (2, 2)), MISS, CLOSURE),
    Rule("drop-at-start", "[2,2] - [2,4]", d((2, 2), (2, 4)), MISS, CLOSURE),
    Rule("drop-at-end", "[2,2] - [0,2]", d((2, 2), (0, 2)), MISS, CLOSURE),
    Rule("keep-touch", "[2,2] - [4,8]", d((2, 2), (4, 8)), touch(2), CLOSURE),
    Rule("split", "[0,8] - [2,4]", d((0, 8), (2, 4)), spans((0, 2), (4, 8))),
    Rule("head", "[0,4] - [0,2]", d((0, 4), (0, 2)), pair(2, 4), SHARED),
    Rule("tail", "[0,8] - [4,8]", d((0, 8), (4, 8)), pair(0, 4), SHARED),
    Rule("in-two", "[0,4] - [0,2] - [2,4]", d((0, 4), (0, 2), (2, 4)), MISS, CLOSURE),
    Rule("both-ends", "[0,8] - [0,2] - [4,8]", d((0, 8), (0, 2), (4, 8)), pair(2, 4), SHARED),
    Rule(
        "abutting-holes", "[0,8] - [2,4] - [4,6]", d((0, 8), (2, 4), (4, 6)),
        spans((0, 2), (6, 8)), CLOSURE,
    ),
    Rule("all", "[2,4] - [0,8]", d((2, 4), (0, 8)), MISS),
    Rule("hole", "[0,inf] - [2,6]", d((0, None), (2, 6)), spans((0, 2), (6, None))),
    Rule("half", "[0,inf] - [2,inf]", d((0, None), (2, None)), pair(0, 2)),
    Rule("same-half", "[2,inf] - [2,inf]", d((2, None), (2, None)), MISS, SHARED),
    Rule("cut", "[0,8] - [2,inf]", d((0, 8), (2, None)), pair(0, 2)),
)  # fmt: skip
UNIONS = (
    Rule("abut", "[0,2] u [2,5]", u((0, 2), (2, 5)), pair(0, 5), TOUCHING),
    Rule("abut-even", "[0,2] u [2,4]", u((0, 2), (2, 4)), pair(0, 4), TOUCHING),
    Rule("apart", "[0,2] u [4,8]", u((0, 2), (4, 8)), spans((0, 2), (4, 8))),
    Rule("touch-inside", "[0,4] u [2,2]", u((0, 4), (2, 2)), pair(0, 4), TOUCHING),
    Rule("touch-end", "[0,2] u [2,2]", u((0, 2), (2, 2)), pair(0, 2), TOUCHING),
    Rule("two-touches", "[2,2] u [4,4]", u((2, 2), (4, 4)), spans((2, 2), (4, 4))),
    Rule("same-touch", "[2,2] u [2,2]", u((2, 2), (2, 2)), touch(2), TOUCHING),
    Rule("touch-apart", "[0,2] u [4,4]", u((0, 2), (4, 4)), spans((0, 2), (4, 4))),
    Rule("inside", "[0,8] u [2,4]", u((0, 8), (2, 4)), pair(0, 8)),
    Rule("chain", "[0,2] u [1,3] u [3,4]", u((0, 2), (1, 3), (3, 4)), pair(0, 4), TOUCHING),
    Rule("bridge", "[0,1] u [2,3] u [1,2]", u((0, 1), (2, 3), (1, 2)), pair(0, 3), TOUCHING),
    Rule("to-infinity", "[0,2] u [2,inf]", u((0, 2), (2, None)), ALWAYS, TOUCHING),
)
INTERSECTIONS = (
    Rule("abut", "[0,2] n [2,5]", n((0, 2), (2, 5)), touch(2), TOUCHING),
    Rule("abut-even", "[0,2] n [2,4]", n((0, 2), (2, 4)), touch(2), TOUCHING),
    Rule("touch-inside", "[0,4] n [2,2]", n((0, 4), (2, 2)), touch(2), CLOSURE),
    Rule("touch-end", "[0,2] n [2,2]", n((0, 2), (2, 2)), touch(2), TOUCHING),
    Rule("same-touch", "[2,2] n [2,2]", n((2, 2), (2, 2)), touch(2), TOUCHING),
    Rule("two-touches", "[2,2] n [4,4]", n((2, 2), (4, 4)), MISS),
    Rule("apart", "[0,2] n [4,8]", n((0, 2), (4, 8)), MISS),
    Rule("inside", "[0,8] n [2,4]", n((0, 8), (2, 4)), pair(2, 4)),
    Rule("three", "[0,4] n [1,5] n [2,6]", n((0, 4), (1, 5), (2, 6)), pair(2, 4)),
    Rule("to-infinity", "[0,2] n [2,inf]", n((0, 2), (2, None)), touch(2), TOUCHING),
)
NESTED = (
    Rule("refill", "([0,8] - [2,4]) u [2,4]", u(d((0, 8), (2, 4)), (2, 4)), pair(0, 8), SHARED),
    Rule(
        "edges", "([0,8] - [2,4]) n [2,4]", n(d((0, 8), (2, 4)), (2, 4)),
        spans((2, 2), (4, 4)), CLOSURE,
    ),
    Rule("edge", "([0,4] - [0,2]) n [0,2]", n(d((0, 4), (0, 2)), (0, 2)), touch(2), CLOSURE),
    Rule(
        "gap", "([0,1] u [2,3]) - [1,2]", d(u((0, 1), (2, 3)), (1, 2)),
        spans((0, 1), (2, 3)), CLOSURE,
    ),
    Rule("seam", "([0,2] u [2,4]) - [2,2]", d(u((0, 2), (2, 4)), (2, 2)), pair(0, 4), CLOSURE),
    Rule("again", "([0,8] - [2,4]) - [0,2]", d(d((0, 8), (2, 4)), (0, 2)), pair(4, 8), SHARED),
    Rule("kissed", "([0,2] n [2,4]) - [2,2]", d(n((0, 2), (2, 4)), (2, 2)), MISS, CLOSURE),
    Rule("less-kiss", "[0,8] - ([0,2] n [2,4])", d((0, 8), n((0, 2), (2, 4))), pair(0, 8), CLOSURE),
    Rule(
        "three-kisses", "([0,1] u [3,4]) n ([1,3] u [4,5])",
        n(u((0, 1), (3, 4)), u((1, 3), (4, 5))), spans((1, 1), (3, 3), (4, 4)), TOUCHING,
    ),
    Rule("twice", "[0,8] - ([0,8] - [2,4])", d((0, 8), d((0, 8), (2, 4))), pair(2, 4), SHARED),
    Rule("twice-pricked", "[0,4] - ([0,4] - [2,2])", d((0, 4), d((0, 4), (2, 2))), MISS, CLOSURE),
    Rule("touch-lost", "([0,1] u [2,2]) - [1,3]", d(u((0, 1), (2, 2)), (1, 3)), pair(0, 1),
         CLOSURE),
)  # fmt: skip


def _family(name: str, reason: str, rules: tuple[Rule, ...], styles: tuple[str, ...]) -> Family:
    def cases(fmt: Format) -> Iterator[Case]:
        for rule in rules:
            yield from placed(fmt, rule, styles)

    return Family(name, reason, cases)


TWINS: tuple[tuple[str, str, Term], ...] = (
    ("a-less-b-or-c", "A - (B u C)", d((0, 8), u((1, 3), (2, 5)))),
    ("a-less-b-and-a-less-c", "(A - B) n (A - C)", n(d((0, 8), (1, 3)), d((0, 8), (2, 5)))),
    ("a-less-b-less-c", "(A - B) - C", d(d((0, 8), (1, 3)), (2, 5))),
    ("a-less-both", "A - B - C", d((0, 8), (1, 3), (2, 5))),
)
MEETS: tuple[tuple[str, str, Term], ...] = (
    ("a-less-b-and-c", "A - (B n C)", d((0, 8), n((1, 3), (2, 5)))),
    ("a-less-b-or-a-less-c", "(A - B) u (A - C)", u(d((0, 8), (1, 3)), d((0, 8), (2, 5)))),
    ("a-less-common", "A - (A n B n C)", d((0, 8), n((0, 8), (1, 3), (2, 5)))),
)
SPREAD: tuple[tuple[str, str, Term], ...] = (
    ("a-and-b-or-c", "A n (B u C)", n((2, 6), u((0, 3), (4, 8)))),
    ("a-and-b-or-a-and-c", "(A n B) u (A n C)", u(n((2, 6), (0, 3)), n((2, 6), (4, 8)))),
    ("b-or-c-less-not-a", "(B u C) - ((B u C) - A)",
     d(u((0, 3), (4, 8)), d(u((0, 3), (4, 8)), (2, 6)))),
)  # fmt: skip
ABSORB: tuple[tuple[str, str, Term], ...] = (
    ("a-or-a-and-b", "A u (A n B)", u((2, 6), n((2, 6), (4, 8)))),
    ("a-and-a-or-b", "A n (A u B)", n((2, 6), u((2, 6), (4, 8)))),
    ("a-or-b-and-a-or-c", "(A u B) n (A u C)", n(u((2, 6), (5, 8)), u((2, 6), (0, 3)))),
)
LAWS: tuple[tuple[tuple[tuple[str, str, Term], ...], Pairs], ...] = (
    (TWINS, spans((0, 1), (5, 8))),
    (MEETS, spans((0, 2), (3, 8))),
    (SPREAD, spans((2, 3), (4, 6))),
    (ABSORB, pair(2, 6)),
)


def _laws(fmt: Format) -> Iterator[Case]:
    """Yield both sides of each law, as rows of their own with one known answer."""
    for sides, known in LAWS:
        for slug, text, term in sides:
            rule = Rule(slug, f"one side of a law, {text}", term, known, ("coincident-faces",))
            yield from placed(fmt, rule, ("mixed",))


def _identical(fmt: Format) -> Iterator[Case]:
    for name, make in WHOLE.items():
        one = make(1, 3)
        other = make(1, 3)
        forms: tuple[tuple[str, str, Node, Pairs], ...] = (
            ("less-itself", "A - A", less(one, other), MISS),
            ("or-itself", "A u A", any_of(one, other), pair(1, 3)),
            ("and-itself", "A n A", all_of(one, other), pair(1, 3)),
            ("back", "A - (A - A)", less(one, less(one, other)), pair(1, 3)),
            ("thrice", "A u A u A", any_of(one, other, one), pair(1, 3)),
            ("alone", "A as a union of one", any_of(one), pair(1, 3)),
        )
        for slug, text, shape, known in forms:
            for frame in one_frame(f"{name}-{slug}"):
                yield scene(
                    fmt,
                    f"{name}-{slug}",
                    f"A ray meets {text}, A being {_article(name)}",
                    shape,
                    START,
                    AHEAD,
                    frame=frame,
                    flags=SHARED if slug != "alone" else (),
                    known=known,
                )


def _article(name: str) -> str:
    words = {
        "ball": "a sphere", "rod": "a cylinder met across", "pipe": "an infinite cylinder",
        "layer": "a slab", "caps": "a cylinder met end on", "wall": "a cylinder met in its wall",
        "ball-aside": "a sphere off its centre", "rod-aside": "a cylinder off its axis",
        "pipe-aside": "an infinite cylinder off its axis",
    }  # fmt: skip
    return words[name]


ORDERS: tuple[tuple[str, str, tuple[tuple[int, int], ...], Pairs, Pairs], ...] = (
    ("touching", "touching", ((0, 2), (2, 4), (4, 8)), pair(0, 8), MISS),
    ("overlap", "overlapping", ((0, 4), (2, 6), (3, 7)), pair(0, 7), pair(3, 4)),
    ("nested", "nested", ((0, 8), (2, 6), (2, 4)), pair(0, 8), pair(2, 4)),
    ("meeting", "meeting at t = 4", ((0, 4), (4, 8), (2, 6)), pair(0, 8), touch(4)),
)


def _orders(fmt: Format) -> Iterator[Case]:
    for name, text, stretches, all_in, common in ORDERS:
        for style in ("rods",) if "ing" in name else ("mixed",):
            words, ways = STYLES[style]
            dice = Dice(f"order-{name}-{style}")
            parts = [build(stretch, ways, dice) for stretch in stretches]
            for order in permutations(range(3)):
                turn = "".join("abc"[i] for i in order)
                shapes = [parts[i] for i in order]
                yield from _ordered(
                    fmt, f"{name}-{style}-{turn}", text, words, shapes, all_in, common
                )


def _ordered(
    fmt: Format,
    slug: str,
    text: str,
    words: str,
    shapes: list[Shape],
    all_in: Pairs,
    common: Pairs,
) -> Iterable[Case]:
    turn, frame = slug[-3:], SEVENTHS if "mixed" in slug else UPRIGHT
    forms: tuple[tuple[str, Node, Pairs | None], ...] = (
        ("union", any_of(*shapes), all_in),
        ("intersection", all_of(*shapes), common),
        ("difference", less(*shapes), None),
    )
    for kind, shape, known in forms:
        yield scene(
            fmt,
            f"{kind}-{slug}",
            f"The {kind} of three {text} parts in the order {turn}, by {words}",
            shape,
            START,
            AHEAD,
            frame=frame,
            flags=("order",),
            known=known,
        )


FAMILIES = (
    _family("csg-difference", "How two lists differ, closed again.", DIFFERENCES, tuple(STYLES)),
    _family("csg-union", "How two lists join, touching or not.", UNIONS, tuple(STYLES)),
    _family("csg-intersection", "What two lists share, a point too.", INTERSECTIONS, tuple(STYLES)),
    _family("csg-nested-lists", "Lists of lists, closed at each node.", NESTED, ("mixed",)),
    Family("csg-laws", "De Morgan, distribution and absorption: both sides.", _laws),
    Family("csg-identical", "A - A, A u A, A n A.", _identical),
    Family("csg-order", "The same parts in every order.", _orders),
)
