"""The compiled engine: `chunks` and all that it calls, through numba, bit for bit as written.

The functions are compiled from the same code objects, each module in a namespace of its own. Only
`two_prod` is computed otherwise, where the processor has fma: both are exact; and `larger` and
`choose`, by the words of the language. Contraction and fast math stay off, numba's defaults. The
machine code is kept in the user's cache folder, in a folder named for the sources.
"""

from __future__ import annotations

import hashlib
import os
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from raycert.oracle.batch import arithmetic, chunks, decide, formulas
from raycert.oracle.batch.constants import LeafPlan
from raycert.oracle.batch.lanes import UNSURE, Floats, Outcomes

SOURCES: tuple[ModuleType, ...] = (arithmetic, formulas, decide, chunks)
OUTER = ("run", "probe", "load", "screen", "solve", "join")
"""What is called a chunk at a time; all else is part of its caller."""


def cache_folder() -> Path:
    """Return where compiled code is kept: a folder of the user's cache, new for new sources."""
    digest = hashlib.sha256()
    for module in SOURCES:
        digest.update(Path(str(module.__file__)).read_bytes())
    root = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(root) / "raycert" / f"numba-{digest.hexdigest()[:16]}"


@cache
def compiled(name: str = "run") -> Any:
    """Return a function of `chunks`, or the probe, compiled. Raises `ImportError` without numba."""
    return _functions()[name]


@cache
def _functions() -> dict[str, Any]:
    """Return the outer functions by name, after all that they call."""
    import numba

    config: Any = numba.core.config
    if config.DISABLE_JIT:
        raise ImportError("NUMBA_DISABLE_JIT is set")
    done: dict[FunctionType, Any] = _replaced(numba)
    before = config.CACHE_DIR
    config.CACHE_DIR = _writable(cache_folder())
    try:
        for module in SOURCES:
            names = dict(vars(module))
            for name, function in vars(module).items():
                if isinstance(function, FunctionType):
                    if function not in done and function.__module__ == module.__name__:
                        done[function] = _compiled(numba, function, names)
                    names[name] = done.get(function, function)
    finally:
        config.CACHE_DIR = before
    return {function.__name__: done[function] for function in done if function.__name__ in OUTER}


def _compiled(numba: Any, function: FunctionType, names: dict[str, Any]) -> Any:
    """Return the same code compiled, which finds what it calls among the names."""
    name = function.__name__
    rebound = FunctionType(function.__code__, names, name)
    rebound.__module__, rebound.__qualname__ = function.__module__, function.__qualname__
    cache = bool(numba.core.config.CACHE_DIR) and name in ("run", "probe")
    options = {"error_model": "numpy", "forceinline": name not in OUTER, "cache": cache}
    return numba.njit(**options)(rebound)


def _replaced(numba: Any) -> dict[Any, Any]:
    """Return what is computed otherwise than as written, with the same bits."""

    @numba.njit(forceinline=True)  # type: ignore[untyped-decorator]
    def larger(a: Any, b: Any) -> Any:
        return a if a > b else b

    @numba.njit(forceinline=True)  # type: ignore[untyped-decorator]
    def choose(where: Any, a: Any, b: Any) -> Any:
        return a if where else b

    others = {arithmetic.larger: larger, arithmetic.choose: choose}
    if _has_fma(numba.core.config):
        others[arithmetic.two_prod] = _two_prod_by_fma()
    return others


def _writable(folder: Path) -> str:
    """Return the folder's name, made if need be; empty where it cannot be: nothing is kept then."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return ""
    return str(folder) if os.access(folder, os.W_OK) else ""


def _has_fma(config: Any) -> bool:
    """Whether the code is made for this processor, and it has a fused multiply-add."""
    from llvmlite import binding

    if config.CPU_NAME or config.CPU_FEATURES:
        return False
    try:
        return bool(binding.get_host_cpu_features().get("fma"))
    except RuntimeError:
        return False


def _two_prod_by_fma() -> Any:
    """Return a b exactly, by the fused multiply-add of the processor."""
    from llvmlite import ir
    from numba import njit, types
    from numba.extending import intrinsic

    @intrinsic
    def fused(typing: Any, a: Any, b: Any, c: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            double = ir.DoubleType()
            kind = ir.FunctionType(double, [double] * 3)
            function = builder.module.declare_intrinsic("llvm.fma", [double], kind)
            return builder.call(function, args)

        return types.float64(types.float64, types.float64, types.float64), build

    fma: Any = fused

    @njit(forceinline=True)
    def two_prod(a: Any, b: Any) -> Any:
        p = a * b
        return p, fma(a, b, -p)

    return two_prod


def leaf_block(plan: LeafPlan, rays: Floats) -> Outcomes:
    n = rays.shape[1]
    if plan.reason:
        return Outcomes.unsure(n)
    state, rung, ends = np.full(n, UNSURE, np.uint8), np.zeros(n, np.uint8), np.empty((4, n))
    compiled()(rays, plan.constants, plan.kind, plan.planes, state, rung, ends)
    return Outcomes(state, rung, *ends)
