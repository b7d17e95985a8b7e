"""The base rate: rays and solids with nothing special about them, all their bits random."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.dice import Dice
from raycert.cases.families.frames import Exact
from raycert.cases.families.sketch import Body, plus, row
from raycert.cases.formats import Format

COUNT = 40
"""Rays for each solid."""


def exactly(vector: tuple[float, float, float]) -> Exact:
    """Return the exact numbers of a vector."""
    return (Fraction(vector[0]), Fraction(vector[1]), Fraction(vector[2]))


def _random(kind: str) -> Callable[[Format], Iterable[Case]]:
    def cases(fmt: Format) -> Iterator[Case]:
        for n in range(COUNT):
            # The seed is part of the name, so that a case stays itself when others come or go.
            seed = f"{n:02d}"
            dice = Dice(f"{kind}-{fmt.name}-{seed}")
            body = _body(kind, dice, fmt)
            origin = exactly(dice.vector(fmt, -4, 4))
            target = _target(body, dice, fmt)
            case = row(
                fmt,
                f"seed-{seed}",
                f"A random ray at {body.noun}, drawn with seed {seed}",
                body,
                origin,
                plus(target, origin, -1),
            )
            yield case

    return cases


def _body(kind: str, dice: Dice, fmt: Format) -> Body:
    p, q = exactly(dice.vector(fmt, -1, 1)), exactly(dice.vector(fmt, -1, 1))
    return Body(kind, p, q, Fraction(dice.real(fmt, 0.125, 1)))


def _target(body: Body, dice: Dice, fmt: Format) -> Exact:
    """Return a point near the middle of the solid: most rays hit, some miss."""
    middle = plus(body.p, plus(body.q, body.p, -1), Fraction(1, 2))
    return plus(middle, exactly(dice.vector(fmt, -0.75, 0.75)))


KINDS = ("half_space", "slab", "infinite_cylinder", "cylinder")
FAMILIES = tuple(
    Family(f"random-{kind.replace('_', '-')}", "The base rate: random rays.", _random(kind))
    for kind in KINDS
)
