"""The algebra of lists, realised by solids: every way two closed intervals can meet.

The ray starts at 0 with direction (4, 0, 0). A stretch (a, b) is the interval [a, b] of its t: a
touch where a = b, endless where b is None. A `Term` combines stretches as a tree combines shapes,
and shapes are made to hold them, so that a Boolean's list is known.

Last come endpoints that are equal, or almost: from different surfaces, an ulp apart, and less.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import permutations

from raycert.cases.case import Family
from raycert.cases.dice import Dice
from raycert.cases.families.frames import ON_Y, SEVENTHS, UPRIGHT, Exact, Number
from raycert.cases.families.shots import (
    Flags,
    Shot,
    drawn,
    family,
    gaps,
    is_double,
    ladder,
    one_frame,
    power,
    table,
)
from raycert.cases.families.sketch import (
    ALWAYS,
    MAKE,
    MISS,
    Boolean,
    Node,
    Pairs,
    Shape,
    all_of,
    any_of,
    ball,
    below,
    later,
    layer,
    less,
    moved,
    pair,
    pipe,
    rod,
    spans,
    touch,
    two,
)
from raycert.cases.formats import Format

SPEED = 4
START: Exact = (0, 0, 0)
AHEAD: Exact = (SPEED, 0, 0)

Stretch = tuple[Number, Number | None]
Build = Callable[[Number, Number], Shape]


@dataclass(frozen=True, slots=True)
class Term:
    """A Boolean of stretches and terms."""

    kind: Boolean
    of: tuple[Term | Stretch, ...]

    def __str__(self) -> str:
        """Return it in a sentence: `([0,8] - [2,4]) u [2,4]`."""
        sign = {"union": " u ", "intersection": " n ", "difference": " - "}[self.kind]
        return sign.join(f"({x})" if isinstance(x, Term) else _interval(*x) for x in self.of)


def _interval(a: Number, b: Number | None) -> str:
    return f"[{a},{'inf' if b is None else b}]"


def u(*of: Term | Stretch) -> Term:
    return Term("union", of)


def n(*of: Term | Stretch) -> Term:
    return Term("intersection", of)


def d(*of: Term | Stretch) -> Term:
    return Term("difference", of)


def _middle(a: Number, b: Number) -> Number:
    return Fraction(SPEED, 2) * (a + b)


def _half(a: Number, b: Number) -> Number:
    return Fraction(SPEED, 2) * (b - a)


def _across(a: Number, b: Number, aside: Number = 0) -> tuple[Exact, Exact, Number]:
    """Return an axis along z and a radius: the ray passes `aside` half chords beside the axis."""
    x, y = _middle(a, b), aside * _half(a, b)
    radius = Fraction(5, 3) * abs(Fraction(y)) if y else _half(a, b)
    return (x, y, -4), (x, y, 4), radius


WHOLE: dict[str, Build] = {
    "ball": lambda a, b: ball(_half(a, b), _middle(a, b)),
    "rod": lambda a, b: rod(*_across(a, b)),
    "pipe": lambda a, b: pipe(*_across(a, b)),
    "layer": lambda a, b: layer((SPEED * a, 4, 4), (SPEED * b, 4, 4)),
    "caps": lambda a, b: rod((SPEED * a, 1, 0), (SPEED * b, 1, 0), 2),
    "wall": lambda a, b: rod((SPEED * a, 4, 0), (SPEED * b, 4, 0), 4),
    "ball-aside": lambda a, b: ball(
        Fraction(5, 4) * _half(a, b), _middle(a, b), Fraction(3, 4) * _half(a, b)
    ),
    "rod-aside": lambda a, b: rod(*_across(a, b, Fraction(3, 4))),
    "pipe-aside": lambda a, b: pipe(*_across(a, b, Fraction(-3, 4))),
}
"""Ways to hold an interval; those `aside` pass at 3/5 of the radius."""

TOUCH: dict[str, Build] = {
    "ball": lambda a, _: ball(4, SPEED * a, 4),
    "rod": lambda a, _: rod((SPEED * a, 4, -4), (SPEED * a, 4, 4), 4),
    "pipe": lambda a, _: pipe((SPEED * a, -4, -4), (SPEED * a, -4, 4), 4),
    "rim": lambda a, _: rod((SPEED * a, 4, 0), (SPEED * a, 4, 8), 4),
    "kiss": lambda a, _: all_of(ball(2, SPEED * a - 2), ball(2, SPEED * a + 2)),
    "point": lambda a, _: ball(0, SPEED * a),
}
"""Ways to hold a touch."""

BALLS = ({"ball": WHOLE["ball"]}, {"ball": TOUCH["ball"]})
RODS = ({"rod": WHOLE["rod"]}, {"rod": TOUCH["rod"]})
FLAT = ({name: WHOLE[name] for name in ("layer", "caps", "wall")}, {"rim": TOUCH["rim"]})
MIXED = (WHOLE, TOUCH)
Ways = tuple[dict[str, Build], dict[str, Build]]
STYLES: dict[str, tuple[str, Ways]] = {
    "balls": ("spheres", BALLS),
    "rods": ("cylinders met across", RODS),
    "flat": ("caps and planes", FLAT),
    "mixed": ("mixed solids", MIXED),
}


def build(term: Term | Stretch, ways: Ways, dice: Dice) -> Shape:
    """Return a shape that holds a term's list, each stretch in a way drawn from `ways`."""
    if isinstance(term, Term):
        return MAKE[term.kind](*(build(part, ways, dice) for part in term.of))
    a, b = term
    if b is None:
        return below((SPEED * a, dice.integer(-2, 2), dice.integer(-2, 2)), (-2, 0, 0))
    makes = list(ways[a == b].values())
    return makes[dice.integer(0, len(makes) - 1)](a, b)


@dataclass(frozen=True, slots=True)
class Rule:
    """A term and its list. `text` names the term in a sentence, if it is not to be written out."""

    slug: str
    term: Term
    known: Pairs
    flags: Flags = ()
    text: str = ""


def held(
    rules: Iterable[Rule], styles: Iterable[str], oblique: tuple[str, ...] = ("mixed",)
) -> Iterator[Shot]:
    """Yield each rule in several styles on the axes, and in some moved along an oblique ray."""
    for rule in rules:
        for style in styles:
            words, ways = STYLES[style]
            for shift in (0, 1) if style in oblique else (0,):
                slug = f"{rule.slug}-{style}" + (f"-plus-{shift}" if shift else "")
                shape = build(rule.term, ways, Dice(slug))
                text = f"A ray meets {rule.text or rule.term}{' moved by 1' if shift else ''}"
                yield Shot(slug, f"{text}, by {words}", moved(shape, (SPEED * shift, 0, 0)), START,
                           AHEAD, later(rule.known, shift), drawn(0, 1) if shift else drawn(1, 0),
                           rule.flags)  # fmt: skip


CLOSURE = ("closure",)
TOUCHING = ("touching-parts",)
SHARED = ("coincident-faces",)
INSIDE = ("start-inside",)
DIFFERENCES = (
    Rule("abut", d((0, 2), (2, 5)), pair(0, 2), CLOSURE),
    Rule("abut-even", d((0, 2), (2, 4)), pair(0, 2), CLOSURE),
    Rule("prick", d((0, 5), (2, 2)), pair(0, 5), CLOSURE),
    Rule("prick-even", d((0, 8), (4, 4)), pair(0, 8), CLOSURE),
    Rule("drop", d((2, 2), (0, 5)), MISS, CLOSURE),
    Rule("drop-even", d((2, 2), (0, 4)), MISS, CLOSURE),
    Rule("same", d((0, 2), (0, 2)), MISS, SHARED),
    Rule("prick-end", d((0, 2), (2, 2)), pair(0, 2), CLOSURE),
    Rule("prick-start", d((0, 2), (0, 0)), pair(0, 2), CLOSURE),
    Rule("abut-before", d((2, 6), (0, 2)), pair(2, 6), CLOSURE),
    Rule("same-touch", d((2, 2), (2, 2)), MISS, CLOSURE),
    Rule("drop-at-start", d((2, 2), (2, 4)), MISS, CLOSURE),
    Rule("drop-at-end", d((2, 2), (0, 2)), MISS, CLOSURE),
    Rule("keep-touch", d((2, 2), (4, 8)), touch(2), CLOSURE),
    Rule("split", d((0, 8), (2, 4)), spans((0, 2), (4, 8))),
    Rule("head", d((0, 4), (0, 2)), pair(2, 4), SHARED),
    Rule("tail", d((0, 8), (4, 8)), pair(0, 4), SHARED),
    Rule("in-two", d((0, 4), (0, 2), (2, 4)), MISS, CLOSURE),
    Rule("both-ends", d((0, 8), (0, 2), (4, 8)), pair(2, 4), SHARED),
    Rule("abutting-holes", d((0, 8), (2, 4), (4, 6)), spans((0, 2), (6, 8)), CLOSURE),
    Rule("all", d((2, 4), (0, 8)), MISS),
    Rule("hole", d((0, None), (2, 6)), spans((0, 2), (6, None))),
    Rule("half", d((0, None), (2, None)), pair(0, 2)),
    Rule("same-half", d((2, None), (2, None)), MISS, SHARED),
    Rule("cut", d((0, 8), (2, None)), pair(0, 2)),
)
UNIONS = (
    Rule("abut", u((0, 2), (2, 5)), pair(0, 5), TOUCHING),
    Rule("abut-even", u((0, 2), (2, 4)), pair(0, 4), TOUCHING),
    Rule("apart", u((0, 2), (4, 8)), spans((0, 2), (4, 8))),
    Rule("touch-inside", u((0, 4), (2, 2)), pair(0, 4), TOUCHING),
    Rule("touch-end", u((0, 2), (2, 2)), pair(0, 2), TOUCHING),
    Rule("two-touches", u((2, 2), (4, 4)), spans((2, 2), (4, 4))),
    Rule("same-touch", u((2, 2), (2, 2)), touch(2), TOUCHING),
    Rule("touch-apart", u((0, 2), (4, 4)), spans((0, 2), (4, 4))),
    Rule("inside", u((0, 8), (2, 4)), pair(0, 8)),
    Rule("chain", u((0, 2), (1, 3), (3, 4)), pair(0, 4), TOUCHING),
    Rule("bridge", u((0, 1), (2, 3), (1, 2)), pair(0, 3), TOUCHING),
    Rule("to-infinity", u((0, 2), (2, None)), ALWAYS, TOUCHING),
)
INTERSECTIONS = (
    Rule("abut", n((0, 2), (2, 5)), touch(2), TOUCHING),
    Rule("abut-even", n((0, 2), (2, 4)), touch(2), TOUCHING),
    Rule("touch-inside", n((0, 4), (2, 2)), touch(2), CLOSURE),
    Rule("touch-end", n((0, 2), (2, 2)), touch(2), TOUCHING),
    Rule("same-touch", n((2, 2), (2, 2)), touch(2), TOUCHING),
    Rule("two-touches", n((2, 2), (4, 4)), MISS),
    Rule("apart", n((0, 2), (4, 8)), MISS),
    Rule("inside", n((0, 8), (2, 4)), pair(2, 4)),
    Rule("three", n((0, 4), (1, 5), (2, 6)), pair(2, 4)),
    Rule("to-infinity", n((0, 2), (2, None)), touch(2), TOUCHING),
)
NESTED = (
    Rule("refill", u(d((0, 8), (2, 4)), (2, 4)), pair(0, 8), SHARED),
    Rule("edges", n(d((0, 8), (2, 4)), (2, 4)), spans((2, 2), (4, 4)), CLOSURE),
    Rule("edge", n(d((0, 4), (0, 2)), (0, 2)), touch(2), CLOSURE),
    Rule("gap", d(u((0, 1), (2, 3)), (1, 2)), spans((0, 1), (2, 3)), CLOSURE),
    Rule("seam", d(u((0, 2), (2, 4)), (2, 2)), pair(0, 4), CLOSURE),
    Rule("again", d(d((0, 8), (2, 4)), (0, 2)), pair(4, 8), SHARED),
    Rule("kissed", d(n((0, 2), (2, 4)), (2, 2)), MISS, CLOSURE),
    Rule("less-kiss", d((0, 8), n((0, 2), (2, 4))), pair(0, 8), CLOSURE),
    Rule("three-kisses", n(u((0, 1), (3, 4)), u((1, 3), (4, 5))), spans((1, 1), (3, 3), (4, 4)),
     TOUCHING),
    Rule("twice", d((0, 8), d((0, 8), (2, 4))), pair(2, 4), SHARED),
    Rule("twice-pricked", d((0, 4), d((0, 4), (2, 2))), MISS, CLOSURE),
    Rule("touch-lost", d(u((0, 1), (2, 2)), (1, 3)), pair(0, 1), CLOSURE),
)  # fmt: skip
CLIPPED = (
    Rule("all-behind", u((-4, -2), (-3, -1)), MISS, ("behind",)),
    Rule("less-behind", d((-2, 2), (-4, 0)), pair(0, 2), CLOSURE),
    Rule("less-to-start", d((-2, 2), (-4, 1)), pair(1, 2), INSIDE),
    Rule("ends-at-start", u((-4, 0), (2, 4)), spans((0, 0), (2, 4)), CLOSURE),
    Rule("end-less-same", d((-4, 0), (-2, 0)), MISS, CLOSURE),
    Rule("end-less-next", d((-4, 0), (0, 2)), MISS, CLOSURE),
    Rule("next-less-end", d((0, 2), (-4, 0)), pair(0, 2), CLOSURE),
    Rule("end-and-next", n((-4, 0), (0, 2)), touch(0), TOUCHING),
    Rule("end-or-next", u((-4, 0), (0, 2)), pair(0, 2), TOUCHING),
    Rule("touch-at-start", u((0, 0), (-4, -2)), touch(0), CLOSURE),
    Rule("touch-less-end", d((0, 0), (-4, 0)), MISS, CLOSURE),
    Rule("prick-at-start", d((-4, 4), (0, 0)), pair(0, 4), CLOSURE),
    Rule("prick-behind", d((-4, 4), (-2, -2)), pair(0, 4), INSIDE),
    Rule("in-a-hole", d((-4, 4), (-2, 2)), pair(2, 4), ("hollow",)),
    Rule("around-start", d((-8, 8), (-4, -2), (2, 4)), spans((0, 2), (4, 8)), INSIDE),
    Rule("abut-behind", u((-4, -2), (-2, 2)), pair(0, 2), TOUCHING),
)
EMPTIES = (
    Rule("disjoint", n((0, 2), (4, 6)), MISS),
    Rule("swallowed", d((2, 4), (0, 8)), MISS),
    Rule("by-two", d((2, 6), (0, 4), (3, 8)), MISS),
    Rule("nested-nothing", d((2, 4), u((2, 4), (6, 8))), MISS, text="A - (A u B)"),
    Rule("nothing-and", n(n((0, 2), (4, 6)), (0, 8)), MISS, text="(A n B) n C"),
    Rule("nothing-less", d(n((0, 2), (4, 6)), (0, 8)), MISS, text="(A n B) - C"),
    Rule("or-nothing", u(n((0, 2), (4, 6)), (2, 4)), pair(2, 4), text="(A n B) u C"),
    Rule("less-nothing", d((2, 4), n((0, 2), (4, 6))), pair(2, 4), text="C - (A n B)"),
)
A, B, C, D = (0, 16), (2, 10), (4, 12), (6, 8)
DEEPS = (
    Rule("less-less-less", d(A, d(B, d(C, D))), spans((0, 2), (4, 6), (8, 16))),
    Rule("less-left", d(d(d(A, B), C), D), spans((0, 2), (12, 16))),
    Rule("or-and-less", u(n(d(A, B), C), D), spans((6, 8), (10, 12))),
    Rule("and-or-less", n(u(d(A, C), D), B), spans((2, 4), (6, 8))),
    Rule("less-and-or", d(n(u(B, D), A), C), pair(2, 4)),
    Rule("less-or-and", d(u(n(A, B), C), D), spans((2, 6), (8, 12))),
    Rule("and-less-or", n(d(A, u(C, D)), B), pair(2, 4)),
    Rule("or-less-and", u(d(A, n(B, C)), D), spans((0, 4), (6, 8), (10, 16))),
    Rule("balanced", d(u(A, B), n(C, D)), spans((0, 6), (8, 16))),
    Rule("halves", n(u(n(A, B), n(C, D)), u(d(A, B), d(B, D))), spans((2, 6), (8, 10))),
    Rule("four-down", d(A, u(B, n(C, d(A, D)))), spans((0, 2), (12, 16))),
    Rule("four-up", u(D, n(C, u(D, d(A, B)))), spans((6, 8), (10, 12))),
    Rule("double-not", d(A, d(A, d(A, d(A, C)))), pair(4, 12)),
    Rule("touching-deep", n(d(A, d(B, D)), u(d(C, D), (0, 2))),
         spans((0, 2), (6, 6), (8, 8), (10, 12))),
)  # fmt: skip
# Both sides of each law, as rows of their own with one known answer: De Morgan, distribution,
# absorption.
TWINS, MEETS = spans((0, 1), (5, 8)), spans((0, 2), (3, 8))
SPREAD, ABSORB = spans((2, 3), (4, 6)), pair(2, 6)
LAWS = (
    Rule("a-less-b-or-c", d((0, 8), u((1, 3), (2, 5))), TWINS, SHARED, "A - (B u C)"),
    Rule("a-less-b-and-a-less-c", n(d((0, 8), (1, 3)), d((0, 8), (2, 5))), TWINS, SHARED,
         "(A - B) n (A - C)"),
    Rule("a-less-b-less-c", d(d((0, 8), (1, 3)), (2, 5)), TWINS, SHARED, "(A - B) - C"),
    Rule("a-less-both", d((0, 8), (1, 3), (2, 5)), TWINS, SHARED, "A - B - C"),
    Rule("a-less-b-and-c", d((0, 8), n((1, 3), (2, 5))), MEETS, SHARED, "A - (B n C)"),
    Rule("a-less-b-or-a-less-c", u(d((0, 8), (1, 3)), d((0, 8), (2, 5))), MEETS, SHARED,
         "(A - B) u (A - C)"),
    Rule("a-less-common", d((0, 8), n((0, 8), (1, 3), (2, 5))), MEETS, SHARED, "A - (A n B n C)"),
    Rule("a-and-b-or-c", n((2, 6), u((0, 3), (4, 8))), SPREAD, SHARED, "A n (B u C)"),
    Rule("a-and-b-or-a-and-c", u(n((2, 6), (0, 3)), n((2, 6), (4, 8))), SPREAD, SHARED,
         "(A n B) u (A n C)"),
    Rule("b-or-c-less-not-a", d(u((0, 3), (4, 8)), d(u((0, 3), (4, 8)), (2, 6))), SPREAD, SHARED,
         "(B u C) - ((B u C) - A)"),
    Rule("a-or-a-and-b", u((2, 6), n((2, 6), (4, 8))), ABSORB, SHARED, "A u (A n B)"),
    Rule("a-and-a-or-b", n((2, 6), u((2, 6), (4, 8))), ABSORB, SHARED, "A n (A u B)"),
    Rule("a-or-b-and-a-or-c", n(u((2, 6), (5, 8)), u((2, 6), (0, 3))), ABSORB, SHARED,
         "(A u B) n (A u C)"),
)  # fmt: skip


ARTICLES = {
    "ball": "a sphere", "rod": "a cylinder met across", "pipe": "an infinite cylinder",
    "layer": "a slab", "caps": "a cylinder met end on", "wall": "a cylinder met in its wall",
    "ball-aside": "a sphere off its centre", "rod-aside": "a cylinder off its axis",
    "pipe-aside": "an infinite cylinder off its axis",
}  # fmt: skip


def _identical() -> Iterator[Shot]:
    for name, make in WHOLE.items():
        one, other, whole = make(1, 3), make(1, 3), pair(1, 3)
        forms: tuple[tuple[str, str, Node, Pairs], ...] = (
            ("less-itself", "A - A", less(one, other), MISS),
            ("or-itself", "A u A", any_of(one, other), whole),
            ("and-itself", "A n A", all_of(one, other), whole),
            ("back", "A - (A - A)", less(one, less(one, other)), whole),
            ("thrice", "A u A u A", any_of(one, other, one), whole),
            ("alone", "A as a union of one", any_of(one), whole),
        )
        for slug, text, shape, known in forms:
            yield Shot(f"{name}-{slug}", f"A ray meets {text}, A being {ARTICLES[name]}", shape,
                       START, AHEAD, known, one_frame,
                       SHARED if slug != "alone" else ())  # fmt: skip


ORDERS = (
    ("touching-rods", "touching", ((0, 2), (2, 4), (4, 8)), pair(0, 8), MISS),
    ("overlap-mixed", "overlapping", ((0, 4), (2, 6), (3, 7)), pair(0, 7), pair(3, 4)),
    ("nested-mixed", "nested", ((0, 8), (2, 6), (2, 4)), pair(0, 8), pair(2, 4)),
    ("meeting-rods", "meeting at t = 4", ((0, 4), (4, 8), (2, 6)), pair(0, 8), touch(4)),
)


def _orders() -> Iterator[Shot]:
    for name, text, stretches, in_any, in_all in ORDERS:
        style = name.split("-")[1]
        words, ways = STYLES[style]
        dice = Dice(f"order-{name}")
        parts = [build(stretch, ways, dice) for stretch in stretches]
        lists: dict[Boolean, Pairs | None] = {"union": in_any, "intersection": in_all}
        for order in permutations(range(3)):
            turn = "".join("abc"[i] for i in order)
            for kind, make in MAKE.items():
                yield Shot(f"{kind}-{name}-{turn}",
                           f"The {kind} of three {text} parts in the order {turn}, by {words}",
                           make(*(parts[i] for i in order)), START, AHEAD, lists.get(kind),
                           SEVENTHS if style == "mixed" else UPRIGHT)  # fmt: skip


def _rules(
    name: str, reason: str, rules: tuple[Rule, ...], *styles: str, flags: Flags = ()
) -> Family:
    return family(name, reason, tuple(held(rules, styles or STYLES)), flags=flags)


ALONG: Exact = (-8, 0, 0)
# Solids whose ends on the x axis are -+sqrt(3) (SURDS) and -+4 (WHOLES): other surfaces, same root.
SURDS: tuple[tuple[str, Shape], ...] = (
    ("ball", ball(2, 0, 1, 0)),
    ("ball-quarter", ball(Fraction(7, 4), 0, 0, Fraction(1, 4))),
    ("ball-wide", ball(Fraction(13, 4), 0, Fraction(11, 4), 0)),
    ("rod", rod((0, 1, -2), (0, 1, 2), 2)),
    ("pipe", pipe((0, Fraction(-1, 4), 0), (0, Fraction(-1, 4), 8), Fraction(7, 4))),
    ("pipe-long", pipe((0, 1, 0), (0, 1, 3), 2)),
)
WHOLES: tuple[tuple[str, Shape], ...] = (
    ("ball", ball(4)),
    ("ball-aside", ball(5, 0, 3, 0)),
    ("rod", rod((0, -3, -4), (0, -3, 4), 5)),
    ("caps", rod((-4, 0, 0), (4, 0, 0), 1)),
    ("layer", layer((-4, 2, 0), (4, 2, 0))),
    ("pipe", pipe((0, 0, 0), (0, 2, 0), 4)),
)
KNOWN: dict[str, Pairs] = {"union": pair(1, 3), "intersection": pair(1, 3), "difference": MISS}


def _equal() -> Iterator[Shot]:
    for kind, solids, lists in (("surds", SURDS, {}), ("wholes", WHOLES, KNOWN)):
        for i, (one, first) in enumerate(solids):
            for other, second in solids[i + 1 :]:
                for name, make in MAKE.items():
                    slug = f"{kind}-{name}-{one}-{other}"
                    aligned = int(kind == "surds" or len(slug) % 2)
                    yield Shot(slug,
                               f"Both ends are equal {kind} in the {name} of {one} and {other}",
                               make(first, second), ALONG, AHEAD, lists.get(name),
                               drawn(aligned, 1 - aligned))  # fmt: skip
    for shot in CROSSINGS:
        text = "Two surfaces are crossed at one point: {}"
        yield shot.but(text=text.format(shot.text), frame=drawn(1, 1))


# Two surfaces that the ray crosses at one point, where they are tangent or cross.
PLANE, GLOBE, TUBE = below((0, 0, 0), (0, 0, 2)), ball(4, 0, 0, 4), pipe((0, 4, 0), (8, 4, 0), 4)
CIRCLE, BORE = ball(5), pipe((0, 0, 0), (0, 0, 1), 3)
SLANT: tuple[Exact, Exact] = ((-4, 0, 4), (4, 0, -4))
CROSSINGS = table(
    ("plane-ball-or", "a plane and its sphere", any_of(PLANE, GLOBE), *SLANT, pair(0, None)),
    ("plane-ball-and", "a plane and its sphere", all_of(PLANE, GLOBE), *SLANT, touch(1)),
    ("plane-ball-less", "a sphere less its plane", less(GLOBE, PLANE), *SLANT, pair(0, 1)),
    ("ball-tube-less", "a sphere less a tangent tube", less(GLOBE, TUBE), *SLANT, None),
    ("circle-or", "sphere and tube on a circle", any_of(CIRCLE, BORE), (-6, 0, 4), (3, 0, 0),
     pair(1, 3)),
    ("circle-and", "sphere and tube on a circle", all_of(CIRCLE, BORE), (-6, 0, 4), (3, 0, 0),
     pair(1, 3)),
    ("circle-less", "sphere less tube on a circle", less(CIRCLE, BORE), (-6, 0, 4), (3, 0, 0),
     MISS),
    ("circle-slanted", "sphere less tube, through a point of their circle", less(CIRCLE, BORE),
     (-6, 0, 8), (3, 0, -4), None),
    ("cap-circle", "sphere and cap on a circle", any_of(CIRCLE, rod((0, 0, 4), (0, 0, 8), 3)),
     (3, 0, -16), (0, 0, 4), pair(3, 6)),
)  # fmt: skip


def _ulp_parts(fmt: Format) -> tuple[Shot, ...]:
    """Return pairs of parts whose faces are one ulp apart, met along x from -8 at speed 4."""
    ulp = two(1 - fmt.precision)
    wide, narrow = 1 + ulp, 1 - ulp / 2
    thin = Fraction(ulp, 4)
    return table(
        ("shell", "a shell one ulp thick", less(ball(wide), ball(1)), ALONG, AHEAD,
         spans((Fraction(7, 4) - thin, "7/4"), ("9/4", Fraction(9, 4) + thin))),
        ("shell-back", "a sphere less one an ulp larger", less(ball(1), ball(wide)), ALONG, AHEAD,
         MISS),
        ("shell-below", "a shell half an ulp thick", less(ball(1), ball(narrow)), ALONG, AHEAD,
         spans(("7/4", Fraction(7, 4) + thin / 2), (Fraction(9, 4) - thin / 2, "9/4"))),
        ("tube", "a tube one ulp thick",
         less(rod((0, 0, -1), (0, 0, 1), wide), rod((0, 0, -1), (0, 0, 1), 1)), ALONG, AHEAD,
         spans((Fraction(7, 4) - thin, "7/4"), ("9/4", Fraction(9, 4) + thin))),
        ("both", "two spheres, one an ulp larger", all_of(ball(wide), ball(1)), ALONG, AHEAD,
         spans(("7/4", "9/4"))),
        ("either", "two spheres united, one an ulp larger", any_of(ball(1), ball(wide)), ALONG,
         AHEAD, pair(Fraction(7, 4) - thin, Fraction(9, 4) + thin)),
        ("caps-gap", "two caps one ulp apart",
         any_of(rod((-1, 0, 0), (1, 0, 0), 1), rod((wide, 0, 0), (3, 0, 0), 1)), ALONG, AHEAD,
         spans(("7/4", "9/4"), (Fraction(9, 4) + thin, "11/4"))),
        ("caps-overlap", "what caps that overlap by an ulp share",
         all_of(rod((-1, 0, 0), (wide, 0, 0), 1), rod((1, 0, 0), (3, 0, 0), 1)), ALONG, AHEAD,
         pair(Fraction(9, 4), Fraction(9, 4) + thin)),
        ("caps-apart", "what caps one ulp apart share",
         all_of(rod((-1, 0, 0), (1, 0, 0), 1), rod((wide, 0, 0), (3, 0, 0), 1)), ALONG, AHEAD,
         MISS),
        ("planes", "two planes one ulp apart",
         less(below((wide, 0, 0), (1, 0, 0)), below((1, 0, 0), (2, 0, 0))), ALONG, AHEAD,
         pair(Fraction(9, 4), Fraction(9, 4) + thin)),
        ("planes-back", "two planes one ulp apart, exchanged",
         less(below((1, 0, 0), (2, 0, 0)), below((wide, 0, 0), (1, 0, 0))), ALONG, AHEAD, MISS),
    )  # fmt: skip


def _one_ulp(fmt: Format) -> Iterator[Shot]:
    for shot in _ulp_parts(fmt):
        across = shot.named("{}-across", "A ray across meets {}")
        yield across
        turned = shot.named("{}-across-turned", "A ray across, turned meets {}")
        yield turned.but(frame=ON_Y)
        aside = shot.named("{}-aside", "A ray aside meets {}")
        yield aside.but(origin=(-8, Fraction(1, 2), 0), known=None)


def _gap_exponents(fmt: Format) -> tuple[int, ...]:
    """Return the k of gaps 2^-k: from some ulps to far below half an ulp of an end near 2."""
    if is_double(fmt):
        return (20, 40, 48, 51, 52, 53, 54, 55, 60, 80, 200)
    return (8, 16, 20, 22, 23, 24, 25, 26, 30, 40, 60)


def _gaps(fmt: Format, k: int) -> Iterator[Shot]:
    """Yield parts on both sides of x = 0 with a gap of 2^-k between them, met at t = 2."""
    gap, after = two(-k), 2 + two(-k) / 4
    block, sliver = layer((-4, 0, 0), (4, 0, 0)), layer((0, 0, 0), (gap, 0, 0))
    slabs = any_of(layer((-4, 0, 0), (0, 0, 0)), layer((gap, 0, 0), (1, 0, 0)))
    rods = any_of(rod((-4, 0, 0), (0, 0, 0), 1), rod((gap, 0, 0), (4, 0, 0), 1))
    plane = any_of(below((0, 0, 0), (1, 0, 0)), layer((gap, 0, 0), (4, 0, 0)))
    turned = SEVENTHS if k < fmt.precision else UPRIGHT
    merges = k + 3 >= fmt.precision  # 2 + 2^-k / 4 rounds to 2
    for shot in table(
        ("slabs", "two slabs with a gap of", slabs, ALONG, AHEAD, spans((1, 2), (after, "9/4"))),
        ("rods", "two caps with a gap of", rods, ALONG, AHEAD, spans((1, 2), (after, 3)), turned),
        ("slot", "a slab with a slot of", less(block, sliver), ALONG, AHEAD,
         spans((1, 2), (after, 3))),
        ("sliver", "a slab of thickness", all_of(block, sliver), ALONG, AHEAD, pair(2, after)),
        ("plane", "a half-space and a slab with a gap of", plane, ALONG, AHEAD,
         spans((0, 2), (after, 3))),
    ):  # fmt: skip
        flags = ("merged-by-rounding",) if merges else ()
        yield shot.named(f"{{}}-{power(-k)}", f"A ray meets {{}} 2^-{k}", *flags)


def _near(_: Format, k: int) -> Iterator[Shot]:
    """Yield spheres that nearly touch, 2^-k apart or into each other."""
    gap = two(-k)
    apart = (spans((1, 3), (3 + gap, 5 + gap)), MISS, pair(1, 3))
    overlapping = (pair(1, 5 - gap), pair(3 - gap, 3), pair(1, 3 - gap))
    for side, shift, lists in (("apart", gap, apart), ("overlapping", -gap, overlapping)):
        for (name, make), known in zip(MAKE.items(), lists, strict=True):
            yield Shot(f"{name}-{side}-{power(-k)}",
                       f"A ray meets the {name} of two spheres 2^-{k} {side}",
                       make(ball(1, -1), ball(1, 1 + shift)), (-3, 0, 0), (1, 0, 0),
                       known)  # fmt: skip


FAMILIES = (
    _rules("csg-difference", "How two lists differ, closed again.", DIFFERENCES),
    _rules("csg-union", "How two lists join, touching or not.", UNIONS),
    _rules("csg-intersection", "What two lists share, a point too.", INTERSECTIONS),
    _rules("csg-nested-lists", "Lists of lists, closed at each node.", NESTED, "mixed"),
    _rules("csg-laws", "De Morgan, distribution and absorption: both sides.",
           tuple(replace(r, text=f"one side of a law, {r.text}") for r in LAWS), "mixed"),
    family("csg-identical", "A - A, A u A, A n A.", tuple(_identical())),
    family("csg-order", "The same parts in every order.", tuple(_orders()), flags=("order",)),
    family("csg-clip", "Parts cut off at t = 0 before they are combined.",
           tuple(held(CLIPPED, ("balls", "rods", "mixed"), ()))),
    _rules("csg-deep", "Trees of three and four levels.",
           tuple(replace(r, text=f"a deep tree, {r.slug.replace('-', ' ')}") for r in DEEPS),
           "balls", "mixed", flags=("deep-tree",)),
    _rules("csg-empty", "Lists that are empty, inside a tree or at its root.", EMPTIES,
           "balls", "rods", "mixed", flags=("empty",)),
    family("csg-equal-ends", "Equal endpoints from different surfaces.", tuple(_equal()),
           flags=("equal-endpoints",)),
    family("csg-one-ulp", "Faces one ulp apart.", _one_ulp, flags=("ulp-apart",), tier="stiff"),
    family("csg-gap", "Gaps from some ulps to far below half an ulp.",
           ladder(_gap_exponents, _gaps), flags=("near-touching",), tier="stiff"),
    family("csg-near-touch", "Spheres that almost touch.", ladder(lambda fmt: gaps(fmt, 12), _near),
           flags=("near-touching",), tier="stiff"),
)  # fmt: skip
