"""Targets for the tests of the hunt, importable in worker processes."""

import os
import time

from raycert.oracle.zoo.inhabitants import BY_NAME
from raycert.oracle.zoo.tracer import BASE


def crashing(solid, ray):
    """Ends the process where the ray starts at x = 7."""
    if ray.origin[0] == 7:
        os._exit(3)
    return BASE(solid, ray)


def hanging(solid, ray):
    """Never answers where the ray starts at x = 7."""
    while ray.origin[0] == 7:
        time.sleep(0.1)
    return BASE(solid, ray)


def __getattr__(name):
    """The fault of the zoo with this name, as a target: `no_clip` is `no-clip`."""
    fault = BY_NAME.get(name.replace("_", "-"))
    if fault is None:
        raise AttributeError(name)
    return fault.make()


def spec(name):
    """How a target names a fault of the zoo."""
    return f"shared.hunted_targets:{name.replace('-', '_')}"
