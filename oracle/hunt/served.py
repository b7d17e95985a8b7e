"""The faults of the zoo as targets: `raycert.oracle.hunt.served:no_clip` is the fault `no-clip`."""

from __future__ import annotations

from raycert.oracle.zoo.fault import Intersect
from raycert.oracle.zoo.inhabitants import BY_NAME


def __getattr__(name: str) -> Intersect:
    """Return a new tracer with the fault of this name."""
    fault = BY_NAME.get(name.replace("_", "-"))
    if fault is None:
        raise AttributeError(f"the zoo has no {name!r}")
    return fault.make()


def spec(name: str) -> str:
    """Return how a target names a fault."""
    return f"{__name__}:{name.replace('-', '_')}"
