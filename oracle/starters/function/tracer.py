"""A tracer as a function, called in a process of raycert's: no lines, no JSON.

    raycert certify --level stable tracer.py:intersect

What it is called with are objects of `raycert.cases.model`, each vector a tuple of three floats:

    solid   HalfSpace            .point  .normal
            Sphere               .center .radius
            InfiniteCylinder     .p .q .radius
            Slab                 .p .q
            Cylinder             .p .q .radius
            Union, Intersection, Difference    .of, a tuple of solids
    ray     Ray                  .origin .direction, which has any length; t is in units of it

What it returns is what it declares in `answers`:

    intervals   the pairs (enter, leave) of t >= 0 at which the ray is in the solid, sorted and
                disjoint, [] for a miss; infinity for one that never ends
    first       the first t, or None for a miss; `from_inside` says what it is from inside
    any         True or False

`NotImplementedError` says that it cannot do a case, any other exception that it failed. What it
prints goes to standard error.
"""

from __future__ import annotations

from math import hypot, inf, sqrt

from raycert.cases.model import Ray, Sphere

Vector = tuple[float, float, float]

# ---- your tracer: replace from here -----------------------------------------------------------
# The function, and what you declare of it. Solids that you leave out are not asked.


def intersect(solid: Sphere, ray: Ray) -> list[tuple[float, float]]:
    """Return where the ray is in the sphere: A t^2 + 2 B t + C <= 0, in lengths along the ray."""
    v, r, (y1, y2, y3) = ray.direction, solid.radius, minus(ray.origin, solid.center)
    size = hypot(*v)
    if not size:  # the ray stays where it is
        return [(0.0, inf)] if hypot(y1, y2, y3) <= r else []
    n1, n2, n3 = (x / size for x in v)
    b = y1 * n1 + y2 * n2 + y3 * n3
    apart = hypot(y2 * n3 - y3 * n2, y3 * n1 - y1 * n3, y1 * n2 - y2 * n1)
    if apart > r:
        return []
    root = sqrt((r - apart) * (r + apart))
    enter, leave = (-b - root) / size, (-b + root) / size
    return [(max(enter, 0.0), leave)] if leave >= 0 else []


def minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


intersect.hello = {  # type: ignore[attr-defined]
    "name": "my tracer, a function in Python",
    "version": "1",
    "solids": ["sphere"],
    "degenerate": ["zero_direction", "zero_radius"],
}

# ---- to here -----------------------------------------------------------------------------------
