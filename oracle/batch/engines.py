"""Which engine answers, whether its floating point can be trusted, and why not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from raycert.oracle.batch import compiled, vector
from raycert.oracle.batch.lanes import Floats, Found
from raycert.oracle.batch.plan import Plan
from raycert.oracle.batch.trust import untrustworthy

LeafBlock = Callable[[Plan, Floats], Found]
ENGINES = ("auto", "numpy", "numba")


@dataclass(frozen=True, slots=True)
class Engine:
    """A way to run the fast rungs: its name, and what to tell the user.

    Where its floating point is not what the proofs need, it is not `trusted`: every lane goes to
    the integers, and `reason` says why.
    """

    name: str
    leaf_block: LeafBlock
    trusted: bool = True
    reason: str = ""


def engine_of(name: str) -> Engine:
    """Return an engine by name, `auto` for numba where it is there.

    Raises `ValueError` for an unknown name, and for numba where it is missing.
    """
    if name not in ENGINES:
        raise ValueError(f"unknown engine {name!r}; known are {', '.join(ENGINES)}")
    if name == "numpy":
        return _numpy()
    try:
        return _numba()
    except ImportError as error:
        missing = f'numba is missing ({error}): pip install "raycert[speed]"'
    if name == "numba":
        raise ValueError(missing)
    return Engine("numpy", _numpy().leaf_block, _numpy().trusted, missing)


@cache
def _numpy() -> Engine:
    return _checked("numpy", vector.leaf_block, untrustworthy())


@cache
def _numba() -> Engine:
    return _checked("numba", compiled.leaf_block, untrustworthy(compiled.compiled("probe")))


def _checked(name: str, run: LeafBlock, fault: str) -> Engine:
    if not fault:
        return Engine(name, run)
    return Engine(name, _nothing, False, f"{name}: {fault}; every lane in integers")


def _nothing(plan: Plan, rays: Floats) -> Found:
    """Decide nothing."""
    del plan
    return Found.unsure(rays.shape[1])
