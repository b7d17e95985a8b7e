"""One ray at a time, at a capped cylinder: the oracle beside others who aim at all the digits.

All answer the same rays; an answer counts as rounded if both ends of every pair are the nearest
doubles.

    random, axis-aligned   as in `oracle.measure.scenarios`, `OF_ONE_SOLID` rays at each cylinder
    touching               small integers throughout: each ray touches, at halves and thirds
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from typing import TYPE_CHECKING

from raycert.oracle.measure.speed.clock import race

if TYPE_CHECKING:
    from raycert.oracle.measure.methods.method import Answered, Case, Method

SCENARIOS = ("random", "axis-aligned", "touching")
METHODS = ("oracle", "mpmath-50", "mpmath-intervals", "sympy")
"""From the catalog of methods, the oracle first."""
OF_ONE_SOLID = 4
"""Rays at one cylinder."""
PATIENCE = 4.0
"""Seconds of a method in a scenario, the fewest passes aside."""


@dataclass(frozen=True, slots=True)
class Row:
    """What a method costs in a scenario: microseconds a ray, and in units of the oracle's.

    `rounded` rays have the correctly rounded list, `undecided` ones none at all, `wrong` ones
    another.
    """

    scenario: str
    method: str
    does: str
    rays: int
    us: float
    ratio: float
    rounded: int
    undecided: int
    wrong: int


def methods() -> tuple[list[Method], list[str]]:
    """Return the methods that can run here, and notes on those that cannot."""
    from raycert.oracle.measure.methods.catalog import by_name
    from raycert.oracle.measure.methods.method import Method, one_by_one
    from raycert.oracle.measure.speed.arb import BITS, intersect

    ladder = Method(
        "arb",
        f"is the seed's formulas in arb's balls, {BITS[0]} to {BITS[-1]} bits",
        one_by_one(intersect),
        frozenset({"cylinder"}),
        "interval",
        needs=("flint",),
    )
    found = [*(by_name(name) for name in METHODS), ladder]
    absent = {m.name: [x for x in m.needs if find_spec(x) is None] for m in found}
    notes = [f"scalar: {name}: not installed: {', '.join(x)}" for name, x in absent.items() if x]
    return [m for m in found if not absent[m.name]], notes


def rows(rays: int, repeats: int, seed: int, some: list[Method]) -> Iterator[list[Row]]:
    """Yield the rows of each scenario, one for each method; ratios are of the first method."""
    for scenario in SCENARIOS:
        yield list(_race(scenario, cases(scenario, rays, seed), repeats, some))


def cases(scenario: str, rays: int, seed: int) -> list[Case]:
    """Return so many cases of a scenario."""
    from raycert.cases.model import Ray
    from raycert.oracle.measure.methods.method import Case
    from raycert.oracle.measure.scenarios import rays as draw

    if scenario == "touching":
        return _touching(rays, seed)
    found: list[Case] = []
    for number in range(-(-rays // OF_ONE_SOLID)):
        some = draw("cylinder", scenario, OF_ONE_SOLID, 1000 * seed + number)
        for u, v in zip(some.origins.tolist(), some.directions.tolist(), strict=True):
            found.append(Case(some.solid, Ray((u[0], u[1], u[2]), (v[0], v[1], v[2]))))
    return found[:rays]


def _touching(rays: int, seed: int) -> list[Case]:
    """Return rays in coordinate directions, square to the axis, in a tangent plane of the wall."""
    from raycert.cases.dice import Dice
    from raycert.cases.model import Cylinder, Ray
    from raycert.oracle.measure.methods.method import Case

    dice = Dice(f"speed touching {seed}")
    found: list[Case] = []
    for _ in range(rays):
        turn, height, radius = (dice.integer(*span) for span in ((0, 2), (1, 4), (1, 4)))
        p = [float(dice.integer(-4, 4)) for _ in range(3)]
        rise, back, pace = dice.integer(0, height), dice.integer(0, 4), dice.integer(1, 3)

        def at(*by: int, p: list[float] = p, turn: int = turn) -> tuple[float, float, float]:
            x, y, z = (p[i] + by[(i + turn) % 3] for i in range(3))
            return x, y, z

        solid = Cylinder(at(0, 0, 0), at(height, 0, 0), float(radius))
        way = at(0, 0, pace, p=[0.0, 0.0, 0.0])
        found.append(Case(solid, Ray(at(rise, radius, -back), way)))
    return found


def _race(scenario: str, some: list[Case], repeats: int, ways: list[Method]) -> Iterator[Row]:
    from raycert.oracle.measure.methods.programs import exact

    truth = [exact(*case) for case in some]
    times = race({m.name: partial(m.solve, some) for m in ways}, repeats, PATIENCE)
    for m in ways:
        answers: list[Answered] = times[m.name].answer
        rounded = sum(a == b for a, b in zip(answers, truth, strict=True))
        undecided = sum(a is None for a in answers)
        yield Row(
            scenario,
            m.name,
            m.does,
            len(some),
            times[m.name].seconds / len(some) * 1e6,
            times[m.name].seconds / times[ways[0].name].seconds,
            rounded,
            undecided,
            len(some) - rounded - undecided,
        )
