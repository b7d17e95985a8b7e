"""The price of certainty: the batch oracle beside the naive float64 formula, on the same rays.

The naive formula is what one writes in NumPy who trusts doubles; the oracle's lists are correctly
rounded in every lane. The aims are stated beside the figures, and not met is said so.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raycert.oracle.measure.price import Row as Measured

RATIOS = {"numba": 1.0, "numpy": 8.0}
"""How many times the naive formula an engine may cost at most, on `random` rays."""
INTEGERS = {"axis-aligned": 0.01}
FEW_INTEGERS = 0.0001
"""The share of the lanes that must stay below it at the integers, where `INTEGERS` has no other."""


@dataclass(frozen=True, slots=True)
class Row:
    """A solid in a scenario: times of the naive formula by engine, shares of the lanes by rung.

    `met` tells of each aim that there is for the scenario whether it is: an engine's ratio, and
    `integer`, the share of the lanes that reach the integers.
    """

    solid: str
    scenario: str
    rays: int
    hits: float
    naive_ns: float
    ratios: dict[str, float]
    shares: dict[str, float]
    met: dict[str, bool]


def steps() -> int:
    """Return the number of rows."""
    from raycert.oracle.measure.scenarios import SCENARIOS, SOLIDS

    return len(SCENARIOS) * len(SOLIDS)


def rows(lanes: int, repeats: int, seed: int) -> Iterator[Row]:
    """Yield a row for each solid in each scenario."""
    from raycert.oracle.measure.price import benchmark

    yield from map(row, benchmark(lanes, repeats, seed))


def row(one: Measured) -> Row:
    """Return the figures of one scenario, beside the aims."""
    aims = RATIOS if one.scenario == "random" else {}
    met = {name: one.ratios[name] <= aim for name, aim in aims.items() if name in one.ratios}
    most = INTEGERS.get(one.scenario, FEW_INTEGERS)
    return Row(
        one.solid,
        one.scenario,
        one.rays,
        one.hits,
        one.naive_ns,
        one.ratios,
        one.shares,
        met | {"integer": one.shares["integer"] < most},
    )
