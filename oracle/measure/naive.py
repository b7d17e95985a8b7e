"""The textbook formula in plain NumPy, all lanes at once: what the batch oracle's price is.

As one would write it who wants the intervals of many rays and trusts doubles: a unit axis, the
discriminant b^2 - a c, clipping at 0. Nothing is proved; far, thin and tangent rays come out wrong.
"""

from __future__ import annotations

import numpy as np

from raycert.cases.model import Cylinder, InfiniteCylinder, Leaf, Sphere
from raycert.oracle.batch.lanes import Floats


def naive(solid: Leaf, origins: Floats, directions: Floats) -> tuple[Floats, Floats]:
    """Return enter and leave of each ray, NaN where it misses: a sphere or a cylinder."""
    with np.errstate(all="ignore"):
        match solid:
            case Sphere(center, radius):
                enter, leave = _roots(directions, origins - np.array(center), radius)
            case InfiniteCylinder() | Cylinder():
                enter, leave = _cylinder(solid, origins, directions)
            case _:
                raise ValueError("naive: a sphere or a cylinder")
        missed = ~((leave >= 0) & (enter <= leave))
        enter, leave = np.maximum(enter, 0.0), leave.copy()
        enter[missed] = leave[missed] = np.nan
    return enter, leave


def _roots(v: Floats, y: Floats, radius: float) -> tuple[Floats, Floats]:
    a = np.einsum("ij,ij->i", v, v)
    b = np.einsum("ij,ij->i", v, y)
    c = np.einsum("ij,ij->i", y, y) - radius * radius
    root = np.sqrt(b * b - a * c)
    return (-b - root) / a, (-b + root) / a


def _cylinder(solid: InfiniteCylinder | Cylinder, u: Floats, v: Floats) -> tuple[Floats, Floats]:
    p, q = np.array(solid.p), np.array(solid.q)
    length = np.linalg.norm(q - p)
    n = (q - p) / length
    y = u - p
    climb, height = v @ n, y @ n
    across, offset = v - climb[:, None] * n, y - height[:, None] * n
    enter, leave = _roots(across, offset, solid.radius)
    if isinstance(solid, Cylinder):
        one, two = -height / climb, (length - height) / climb
        enter = np.maximum(enter, np.minimum(one, two))
        leave = np.minimum(leave, np.maximum(one, two))
    return enter, leave
