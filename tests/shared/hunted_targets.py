"""Targets for the tests of the hunt, importable in worker processes."""

import os
import time

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
