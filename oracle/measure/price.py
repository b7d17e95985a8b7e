"""The price of certainty: the textbook formula in NumPy and the batch oracle, on the same rays.

One process, one core, processor time; the ways take turns and the minimum counts. Compiling is not
in it: each way has answered a few rays before. Only ratios of one run mean much.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

from raycert.oracle.batch.engines import engine_of
from raycert.oracle.batch.trace import Batch, trace_batch
from raycert.oracle.measure.naive import naive
from raycert.oracle.measure.scenarios import SCENARIOS, SOLIDS, Rays, rays

ENGINES = ("numpy", "numba")


@dataclass(frozen=True, slots=True)
class Row:
    """What one solid in one scenario costs: nanoseconds a ray, and the share of lanes by rung.

    `ratios` are by engine, times of the naive formula; an engine that is missing is left out.
    """

    solid: str
    scenario: str
    rays: int
    hits: float
    naive_ns: float
    certified_ns: dict[str, float]
    shares: dict[str, float]

    @property
    def ratios(self) -> dict[str, float]:
        """Return the cost of each engine in units of the naive formula's."""
        return {name: ns / self.naive_ns for name, ns in self.certified_ns.items()}


def available() -> tuple[str, ...]:
    """Return the engines that are there and trusted."""
    found = []
    for name in ENGINES:
        try:
            engine = engine_of(name)
        except ValueError:
            continue
        if engine.trusted:
            found.append(name)
    return tuple(found)


def benchmark(
    count: int = 200_000,
    repeats: int = 5,
    seed: int = 1,
    solids: tuple[str, ...] = SOLIDS,
    scenarios: tuple[str, ...] = SCENARIOS,
) -> Iterator[Row]:
    """Yield a row for each solid in each scenario."""
    engines = available()
    for solid in solids:
        for scenario in scenarios:
            yield measure(solid, scenario, rays(solid, scenario, count, seed), engines, repeats)


def measure(solid: str, scenario: str, some: Rays, engines: tuple[str, ...], repeats: int) -> Row:
    """Return what these rays cost each way."""
    ways: dict[str, Callable[[], object]] = {"": partial(_naive, some)}
    for name in engines:
        trace_batch(some.solid, some.origins[:64], some.directions[:64], engine=name)
        ways[name] = partial(_batch, some, name)
    best = dict.fromkeys(ways, float("inf"))
    for _ in range(repeats):
        for name, run in ways.items():
            start = time.process_time()
            run()
            best[name] = min(best[name], time.process_time() - start)
    count = len(some.origins)
    found = _batch(some, engines[-1])
    return Row(
        solid=solid,
        scenario=scenario,
        rays=count,
        hits=float((found.counts > 0).mean()),
        naive_ns=best[""] / count * 1e9,
        certified_ns={name: best[name] / count * 1e9 for name in engines},
        shares={rung: lanes / count for rung, lanes in found.lanes.items()},
    )


def _naive(some: Rays) -> object:
    return naive(some.solid, some.origins, some.directions)


def _batch(some: Rays, engine: str) -> Batch:
    return trace_batch(some.solid, some.origins, some.directions, engine=engine)
