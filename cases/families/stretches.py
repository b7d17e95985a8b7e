"""Stretches of a ray: shapes made to hold known intervals, so that a Boolean's list is known.

The ray starts at 0 with direction (4, 0, 0). A stretch (a, b) is the interval [a, b] of its t: a
touch where a = b, endless where b is None. A `Term` combines stretches as a tree combines shapes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.case import Case
from raycert.cases.dice import Dice
from raycert.cases.families.frames import Exact, Frame, Number, frames_for
from raycert.cases.families.shapes import (
    MAKE,
    Boolean,
    Shape,
    all_of,
    ball,
    below,
    layer,
    moved,
    pipe,
    rod,
    scene,
)
from raycert.cases.families.sketch import Pairs
from raycert.cases.formats import Format

SPEED = 4
START: Exact = (0, 0, 0)
AHEAD: Exact = (SPEED, 0, 0)
HALF = Fraction(1, 2)

Stretch = tuple[Number, Number | None]
Build = Callable[[Number, Number], Shape]


@dataclass(frozen=True, slots=True)
class Term:
    """A Boolean of stretches and terms."""

    kind: Boolean
    of: tuple[Term | Stretch, ...]


def u(*of: Term | Stretch) -> Term:
    """Return a union."""
    return Term("union", of)


def n(*of: Term | Stretch) -> Term:
    """Return an intersection."""
    return Term("intersection", of)


def d(*of: Term | Stretch) -> Term:
    """Return a difference."""
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
    """A term and its list. `text` names the term in a sentence."""

    slug: str
    text: str
    term: Term
    known: Pairs
    flags: tuple[str, ...] = ()


def placed(
    fmt: Format, rule: Rule, styles: tuple[str, ...], oblique: tuple[str, ...] = ("mixed",)
) -> Iterator[Case]:
    """Yield a rule in several styles on the axes, and in some moved along an oblique ray."""
    for style in styles:
        words, ways = STYLES[style]
        for shift in (0, 1) if style in oblique else (0,):
            slug = f"{rule.slug}-{style}" + (f"-plus-{shift}" if shift else "")
            shape = build(rule.term, ways, Dice(slug))
            later = f" moved by {shift}" if shift else ""
            for frame in _frames(slug, shift):
                yield scene(
                    fmt,
                    slug,
                    f"A ray meets {rule.text}{later}, by {words}",
                    moved(shape, (SPEED * shift, 0, 0)),
                    START,
                    AHEAD,
                    frame=frame,
                    flags=rule.flags,
                    known=shifted_from(rule.known, shift),
                )


def _frames(slug: str, shift: int) -> tuple[Frame, ...]:
    return frames_for(slug, 0, 1) if shift else frames_for(slug, 1, 0)


def shifted_from(known: Pairs, by: Number) -> Pairs:
    """Return a list moved along the ray, its endpoints at 0 too: nothing was cut off there."""
    return tuple((None if a is None else a + by, None if b is None else b + by) for a, b in known)
