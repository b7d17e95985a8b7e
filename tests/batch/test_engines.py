"""Engines give the same bits and counts; one that cannot be trusted, or is missing, is not used."""

from __future__ import annotations

import ctypes
import platform
import sys

import numpy as np
import pytest

from raycert.cases.formats import BINARY32, BINARY64, Format
from raycert.cases.model import Sphere
from raycert.oracle.batch import compiled, engines
from raycert.oracle.batch.arithmetic import probe
from raycert.oracle.batch.blocks import trace_batch
from raycert.oracle.batch.constants import plan
from raycert.oracle.batch.engines import (
    ENGINES,
    INPUT,
    WANTED,
    Engine,
    engine_of,
    untrustworthy,
)
from shared.batch_rays import FAMILIES, beside_ties, free

numba = pytest.importorskip("numba")
RAYS = [[-3.0, 0.25, 0.5]], [[1.0, 0.0, 0.125]]
BALL = Sphere((0, 0, 0), 1)


@pytest.mark.parametrize("fmt", [BINARY64, BINARY32], ids=lambda fmt: fmt.name)
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_both_engines_give_the_same_bits_and_counts(family, fmt: Format) -> None:
    dice = np.random.default_rng(11)
    for _ in range(2):
        leaves, u, v = family(dice, 300)
        for leaf in leaves:
            one, two = (trace_batch(leaf, u, v, fmt, engine) for engine in ("numpy", "numba"))
            assert one.rungs == two.rungs
            assert (one.offsets == two.offsets).all()
            assert (one.enter.view(np.int64) == two.enter.view(np.int64)).all()
            assert (one.leave.view(np.int64) == two.leave.view(np.int64)).all()
            assert (one.engine, two.engine) == ("numpy", "numba")


@pytest.mark.parametrize("flat", [False, True])
def test_both_engines_agree_on_every_lane_of_the_fast_rungs(flat: bool) -> None:
    """Also where nothing is certain: a bound that differs in its last bit would show here."""
    dice = np.random.default_rng(12)
    for _ in range(100):
        solid, u, v = beside_ties(dice, flat)
        rays = np.concatenate([u.T, v.T])
        with np.errstate(all="ignore"):
            one, two = (engine_of(e).leaf_block(plan(solid), rays) for e in ("numpy", "numba"))
        assert one.state.tolist() == two.state.tolist()
        assert one.rung.tolist() == two.rung.tolist()


def test_products_by_fma_are_those_of_dekker() -> None:
    leaves, u, v = free(np.random.default_rng(13), 300)
    del leaves
    x = np.concatenate([u, v]).ravel()
    by_numba = np.array([compiled.compiled("probe")(np.array([*INPUT[:4], 1e300, a])) for a in x])
    rows = np.array([[*INPUT[:4], 1e300, a] for a in x]).T
    with np.errstate(all="ignore"):
        by_numpy = np.array([np.broadcast_to(part, x.shape) for part in probe(rows)]).T
    assert (by_numba == by_numpy).all()


def test_engines_are_found_by_name() -> None:
    assert engine_of("numpy").name == "numpy"
    assert engine_of("numba").name == engine_of("auto").name == "numba"
    with pytest.raises(ValueError, match="unknown engine 'cuda'; known are auto, numpy, numba"):
        engine_of("cuda")
    assert ENGINES == ("auto", "numpy", "numba")


def missing() -> Engine:
    raise ImportError("No module named 'numba'")


def test_without_numba_auto_says_so_and_runs_numpy(monkeypatch) -> None:
    monkeypatch.setattr(engines, "_numba", missing)
    found = trace_batch(BALL, *RAYS)
    assert found.engine == "numpy"
    assert 'pip install "raycert[speed]"' in found.reason
    assert found.lanes["integer"] == 0
    with pytest.raises(ValueError, match="the batch engine needs numba"):
        trace_batch(BALL, *RAYS, engine="numba")


def test_what_cannot_be_trusted_goes_to_the_integers(monkeypatch) -> None:
    broken = engines._checked("numpy", engine_of("numpy").leaf_block, "subnormal numbers are kept")
    monkeypatch.setattr(engines, "_numpy", lambda: broken)
    found = trace_batch(BALL, *RAYS, engine="numpy")
    assert found.lanes == {"float64": 0, "double-double": 0, "rational": 0, "integer": 1}
    assert found.reason == "numpy: subnormal numbers are kept; every lane in integers"
    assert found.pairs(0) == trace_batch(BALL, *RAYS, engine="numba").pairs(0)


def test_both_engines_are_trustworthy() -> None:
    assert untrustworthy() == ""
    assert not untrustworthy(compiled.compiled("probe"))


def planted(**wrong: float):
    """Return a probe with some of its results, by what they show, replaced."""
    texts = [text for text, _, _ in WANTED]

    def run(x):
        results = [float(np.asarray(part).ravel()[0]) for part in probe(x)]
        for text, value in wrong.items():
            (i,) = [i for i, name in enumerate(texts) if name.startswith(text.replace("_", " "))]
            results[i] = value
        return results

    return run


@pytest.mark.parametrize(
    "run",
    [
        planted(a_product_and_a_difference=2.0**-60),
        planted(subnormal_numbers=0.0),
        planted(subnormal_results=0.0),
        planted(binary32_rounds=2.0**-52),
        planted(overflow_is_infinite=1.7976931348623157e308),
    ],
    ids=["contraction", "denormals-are-zero", "flush-to-zero", "no-binary32", "toward-zero"],
)
def test_planted_faults_of_the_floating_point_are_noticed(run) -> None:
    assert untrustworthy(run)


MODES = {"down": 0x400, "up": 0x800, "toward zero": 0xC00}


@pytest.mark.skipif(
    platform.machine() != "x86_64" or not sys.platform.startswith("linux"),
    reason="the rounding modes have other numbers there",
)
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_another_rounding_mode_is_noticed(mode: str, engine: str) -> None:
    libm = ctypes.CDLL("libm.so.6")
    run = probe if engine == "numpy" else compiled.compiled("probe")

    def turned(x):
        libm.fesetround(MODES[mode])
        try:
            return [float(np.asarray(part).ravel()[0]) for part in run(x)]
        finally:
            libm.fesetround(0)

    assert untrustworthy(turned) != ""


def test_compiled_code_is_kept_by_what_its_sources_say(monkeypatch, tmp_path) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert compiled.cache_folder().is_relative_to(tmp_path)
    before = compiled.cache_folder()
    monkeypatch.setattr(compiled, "SOURCES", compiled.SOURCES[1:])
    assert compiled.cache_folder() != before
