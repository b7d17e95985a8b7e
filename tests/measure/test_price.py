"""The benchmark asks the same rays of all, and the shares of the rungs are what is promised."""

from __future__ import annotations

import numpy as np
import pytest

from raycert.oracle.batch.trace import trace_batch
from raycert.oracle.measure import price as module
from raycert.oracle.measure.naive import naive
from raycert.oracle.measure.price import available, benchmark
from raycert.oracle.measure.scenarios import SCENARIOS, SOLIDS, rays


@pytest.mark.parametrize("solid", SOLIDS)
@pytest.mark.parametrize("scenario", SCENARIOS)
def test_few_lanes_reach_the_integers(solid: str, scenario: str) -> None:
    some = rays(solid, scenario, 20_000, 2)
    found = trace_batch(some.solid, some.origins, some.directions, engine="numpy")
    most = 0.01 if scenario == "axis-aligned" else 0.0001
    assert found.lanes["integer"] <= most * 20_000


@pytest.mark.parametrize("solid", SOLIDS)
def test_the_naive_formula_is_right_to_many_digits_on_random_rays(solid: str) -> None:
    """So it is the same work that is compared."""
    some = rays(solid, "random", 4000, 3)
    enter, leave = naive(some.solid, some.origins, some.directions)
    found = trace_batch(some.solid, some.origins, some.directions, engine="numpy")
    assert (np.isfinite(enter) == (found.counts > 0)).all()
    hit = np.isfinite(enter)
    first, last = found.padded(1)
    assert np.allclose(enter[hit], first[hit, 0], rtol=1e-6, atol=1e-9)
    assert np.allclose(leave[hit], last[hit, 0], rtol=1e-6, atol=1e-9)


def test_rows_have_the_figures_of_each_engine(monkeypatch) -> None:
    monkeypatch.setattr(module, "available", lambda: ("numpy",))
    (row,) = benchmark(5000, 2, 1, ("sphere",), ("random",))
    assert (row.solid, row.scenario, row.rays) == ("sphere", "random", 5000)
    assert set(row.certified_ns) == set(row.ratios) == {"numpy"}
    assert row.ratios["numpy"] == row.certified_ns["numpy"] / row.naive_ns
    assert 0.05 < row.hits < 0.95
    assert abs(sum(row.shares.values()) - 1) < 1e-12


def test_engines_that_are_there() -> None:
    assert available()[0] == "numpy"


def test_seeds_tell_rays_apart() -> None:
    one, two, other = (rays("sphere", "far", 10, seed).origins for seed in (1, 1, 2))
    assert (one == two).all()
    assert (one != other).any()
