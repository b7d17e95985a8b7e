"""Degenerate inputs: where a solid or a ray has lost a dimension, and what to answer is a choice.

Each has a name, the same in a hello and on a certificate. They are graded apart, and no family
mixes them with other rows.
"""

from __future__ import annotations

from typing import Literal

from raycert.cases.model import Ray, Solid, leaves, radius

Degeneracy = Literal["zero_direction", "zero_radius", "flat_box"]
DEGENERACIES: tuple[Degeneracy, ...] = ("zero_direction", "zero_radius", "flat_box")
"""Their names. No solid has an edge of no length by now, so that none is a flat box."""


def degenerate(solid: Solid, ray: Ray) -> tuple[Degeneracy, ...]:
    """Return in which ways a case is degenerate, in the order of `DEGENERACIES`; -0 is 0.

    A tree is degenerate if any of its leaves is.

    >>> from raycert.cases.model import Sphere
    >>> degenerate(Sphere((0, 0, 0), 0), Ray((1, 0, 0), (0, 0, 0)))
    ('zero_direction', 'zero_radius')
    >>> degenerate(Sphere((0, 0, 0), 1), Ray((1, 0, 0), (0, 0, 1)))
    ()
    """
    holds: dict[Degeneracy, bool] = {
        "zero_direction": not any(ray.direction),
        "zero_radius": any(radius(leaf, 1.0) == 0 for _, leaf in leaves(solid)),
    }
    return tuple(name for name in DEGENERACIES if holds.get(name))
