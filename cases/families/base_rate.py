"""The base rate: rays and solids with nothing special about them, all their bits random.

Beside them random trees on a small grid, where faces coincide and rays lie in them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction

from raycert.cases.case import Family
from raycert.cases.dice import Dice
from raycert.cases.families.frames import Exact
from raycert.cases.families.shots import Shot, family
from raycert.cases.families.sketch import (
    MAKE,
    NOUNS,
    Ball,
    Body,
    Boolean,
    Node,
    Shape,
    ball,
    below,
    layer,
    pipe,
    plus,
    rod,
)
from raycert.cases.formats import Format

COUNT = 40
"""Rays for each solid."""
AXES: tuple[Exact, ...] = ((4, 0, 0), (0, 4, 0), (0, 0, 4), (-2, 0, 0), (0, -2, 0), (0, 0, -2))
BOOLEANS = tuple(MAKE)
Leaf = Callable[[Dice], Shape]


def _point(dice: Dice, fmt: Format, reach: float = 1.0) -> Exact:
    """Return a point in the cube -reach..reach, all its bits random."""
    x, y, z = dice.vector(fmt, -reach, reach)
    return (Fraction(x), Fraction(y), Fraction(z))


def _aimed(slug: str, text: str, shape: Shape, origin: Exact, target: Exact) -> Shot:
    return Shot(slug, text, shape, origin, plus(target, origin, -1))


def _leaves(kind: str, noun: str) -> Callable[[Format], Iterator[Shot]]:
    """Return random solids of a kind, with rays near their middles: most hit, some miss."""

    def shots(fmt: Format) -> Iterator[Shot]:
        # The seed is part of the name, so that a case stays itself when others come or go.
        for seed in (f"{n:02d}" for n in range(COUNT)):
            dice = Dice(f"{kind}-{fmt.name}-{seed}")
            p = _point(dice, fmt)
            q = p if kind == "sphere" else _point(dice, fmt)
            radius = Fraction(dice.real(fmt, 0.125, 1))
            shape = Ball(p, radius) if kind == "sphere" else Body(kind, p, q, radius)
            middle = plus(p, plus(q, p, -1), Fraction(1, 2))
            origin = _point(dice, fmt, 4)
            text = f"A random ray at {noun}, drawn with seed {seed}"
            target = plus(middle, _point(dice, fmt, 0.75))
            yield _aimed(f"seed-{seed}", text, shape, origin, target)

    return shots


def _tree(kind: Boolean, dice: Dice, depth: int, leaf: Leaf) -> Node:
    """Return a tree of this root with two or three parts, some of them trees."""
    parts: list[Shape] = []
    for i in range(dice.integer(2, 3)):
        deeper = depth > 1 and dice.integer(0, 2) == 0
        inner = BOOLEANS[dice.integer(0, 2)]
        # The first part of a difference is large more often than not, so that something is left.
        parts.append(_tree(inner, dice, depth - 1, leaf) if deeper and i else leaf(dice))
    return MAKE[kind](*parts)


def _grid_point(dice: Dice) -> Exact:
    return (2 * dice.integer(-2, 2), 2 * dice.integer(-2, 2), 2 * dice.integer(-2, 2))


def _grid_leaf(dice: Dice) -> Shape:
    """Return a solid on the grid: radii 2 and 4, axes and normals along coordinate axes."""
    p, along = _grid_point(dice), AXES[dice.integer(0, 5)]
    radius = 2 * dice.integer(1, 2)
    match dice.integer(0, 8):
        case 0 | 1 | 2:
            return ball(radius, *p)
        case 3 | 4 | 5:
            return rod(p, plus(p, along), radius)
        case 6:
            return pipe(p, plus(p, along), radius)
        case 7:
            return layer(p, plus(p, along))
        case _:
            return below(p, along)


def _grid(_: Format) -> Iterator[Shot]:
    for kind in BOOLEANS:
        for number in range(20):
            seed = f"{number:02d}"
            dice = Dice(f"grid-{kind}-{seed}")
            shape = _tree(kind, dice, 3, _grid_leaf)
            through, along = _grid_point(dice), AXES[dice.integer(0, 2)]
            way, direction = "straight", along
            if number % 4 == 3:
                way, aside = "slanted", AXES[(AXES.index(along) + 1) % 3]
                direction = plus(along, aside, Fraction(1, 2))
            text = f"A {way} ray meets a random {kind} on the grid, seed {seed}"
            yield Shot(f"{kind}-seed-{seed}", text, shape, through, direction).back(4)


def _leaf(fmt: Format) -> Leaf:
    """Return a maker of solids with all their bits random, about the origin."""

    def leaf(dice: Dice) -> Shape:
        p, q = _point(dice, fmt), _point(dice, fmt)
        radius = Fraction(dice.real(fmt, 0.25, 1.25))
        match dice.integer(0, 6):
            case 0 | 1 | 2:
                return Ball(p, radius)
            case 3 | 4:
                return rod(p, q, radius)
            case 5:
                return pipe(p, q, radius)
            case _:
                # p and q - p have to be numbers of the format: q is no sum of them here.
                return below(p, q)

    return leaf


def _trees(fmt: Format) -> Iterator[Shot]:
    for kind in BOOLEANS:
        for seed in (f"{n:02d}" for n in range(16)):
            dice = Dice(f"tree-{kind}-{fmt.name}-{seed}")
            shape = _tree(kind, dice, 3, _leaf(fmt))
            text = f"A random ray meets a random {kind}, drawn with seed {seed}"
            origin, target = _point(dice, fmt, 4), _point(dice, fmt, 0.5)
            yield _aimed(f"{kind}-seed-{seed}", text, shape, origin, target)


FAMILIES: tuple[Family, ...] = (
    *(
        family(f"random-{k.replace('_', '-')}", "The base rate: random rays.", _leaves(k, noun))
        for k, noun in NOUNS.items()
    ),
    family("csg-grid", "Random trees on a grid, where faces coincide.", _grid,
           flags=("coincident-faces",)),
    family("random-csg", "The base rate: random rays at random trees.", _trees),
)  # fmt: skip
