"""Random trees: off the lattice, and on a small grid where faces coincide and rays lie in them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.dice import Dice
from raycert.cases.families.base_rate import exactly
from raycert.cases.families.frames import Exact
from raycert.cases.families.shapes import (
    MAKE,
    Ball,
    Boolean,
    Node,
    Shape,
    ball,
    below,
    layer,
    pipe,
    rod,
    scene,
)
from raycert.cases.families.sketch import Body, plus
from raycert.cases.formats import Format

KINDS: tuple[Boolean, ...] = ("union", "intersection", "difference")
AXES: tuple[Exact, ...] = ((4, 0, 0), (0, 4, 0), (0, 0, 4), (-2, 0, 0), (0, -2, 0), (0, 0, -2))
Leaf = Callable[[Dice], Shape]


def _tree(kind: Boolean, dice: Dice, depth: int, leaf: Leaf) -> Node:
    """Return a tree of this root with two or three parts, some of them trees."""
    parts = []
    for i in range(dice.integer(2, 3)):
        deeper = depth > 1 and dice.integer(0, 2) == 0
        inner = KINDS[dice.integer(0, 2)]
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


def _grid(fmt: Format) -> Iterator[Case]:
    for kind in KINDS:
        for number in range(20):
            seed = f"{number:02d}"
            dice = Dice(f"grid-{kind}-{seed}")
            shape = _tree(kind, dice, 3, _grid_leaf)
            through, along = _grid_point(dice), AXES[dice.integer(0, 2)]
            slanted = number % 4 == 3
            aside: Exact = AXES[(AXES.index(along) + 1) % 3] if slanted else (0, 0, 0)
            direction = plus(along, aside, Fraction(1, 2))
            way = "slanted" if slanted else "straight"
            yield scene(
                fmt,
                f"{kind}-seed-{seed}",
                f"A {way} ray meets a random {kind} on the grid, seed {seed}",
                shape,
                plus(through, direction, -4),
                direction,
                flags=("coincident-faces",),
            )


def _leaf(fmt: Format) -> Leaf:
    """Return a maker of solids with all their bits random, about the origin."""

    def leaf(dice: Dice) -> Shape:
        p, q = exactly(dice.vector(fmt)), exactly(dice.vector(fmt))
        radius = Fraction(dice.real(fmt, 0.25, 1.25))
        kind = dice.integer(0, 6)
        if kind < 3:
            return Ball(p, radius)
        names = ("cylinder", "cylinder", "infinite_cylinder", "half_space")
        if names[kind - 3] == "half_space":
            # p and q - p have to be numbers of the format: q is no sum of them here.
            return Body("half_space", p, plus(p, q))
        return Body(names[kind - 3], p, q, radius)

    return leaf


def _random(fmt: Format) -> Iterator[Case]:
    for kind in KINDS:
        for number in range(16):
            seed = f"{number:02d}"
            dice = Dice(f"tree-{kind}-{fmt.name}-{seed}")
            shape = _tree(kind, dice, 3, _leaf(fmt))
            origin = exactly(dice.vector(fmt, -4, 4))
            target = exactly(dice.vector(fmt, -0.5, 0.5))
            yield scene(
                fmt,
                f"{kind}-seed-{seed}",
                f"A random ray meets a random {kind}, drawn with seed {seed}",
                shape,
                origin,
                plus(target, origin, -1),
            )


FAMILIES = (
    Family("csg-grid", "Random trees on a grid, where faces coincide.", _grid),
    Family("random-csg", "The base rate: random rays at random trees.", _random),
)
