"""Right, but that starts beyond 1e6 sizes are missed; `short` refuses them instead."""

import sys
from collections.abc import Iterable

from raycert.cases.domain import Domain, quantities
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Hello, serve
from raycert.reference.tracer import intersect

NEAR = Domain(distance=1e6)


def nearby(solid: Solid, ray: Ray) -> Iterable[tuple[float, float]]:
    return intersect(solid, ray) if NEAR.holds(quantities(solid, ray)) else ()


if __name__ == "__main__":
    serve(nearby, Hello("nearsighted", solids=tuple(sys.argv[1:]) or ("sphere", "half_space")))
