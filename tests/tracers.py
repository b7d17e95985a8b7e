"""Tracers to try the judge on: some sound, some with one planted fault each.

Every tracer is an `intersect(solid, ray)` in plain doubles for half_space, slab, infinite_cylinder
and cylinder. They share no code with `reference`: each part of a solid gives an interval of the
whole line, and what they have in common is cut off at t = 0.

    SOUND    must earn `sound`; all but `textbook` must earn `stable` too
    FAULTS   must not earn `sound`
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import hypot, inf, sqrt

from cases.model import Cylinder, HalfSpace, InfiniteCylinder, Ray, Slab, Solid, Vector

Pairs = list[tuple[float, float]]
Intersect = Callable[[Solid, Ray], Pairs]
Wall = Callable[[InfiniteCylinder | Cylinder, Ray], Pairs]
LINE = (-inf, inf)
AHEAD = [(0.0, inf)]


def projected(solid: Solid, ray: Ray) -> Pairs:
    """A sound tracer: start and direction are projected onto the plane square to the axis."""
    return _common(AHEAD, *_parts(solid, ray, _projected_wall))


def local_frame(solid: Solid, ray: Ray) -> Pairs:
    """A sound tracer: start and direction are turned into a frame whose third axis is pq."""
    return _common(AHEAD, *_parts(solid, ray, _framed_wall))


def textbook(solid: Solid, ray: Ray) -> Pairs:
    """A sound tracer that is not stable: the seed's vbar and ybar, the discriminant b^2 - a c."""
    return _common(AHEAD, *_parts(solid, ray, _textbook_wall))


def no_caps(solid: Solid, ray: Ray) -> Pairs:
    """A fault: the cylinder goes on beyond its caps."""
    if isinstance(solid, Cylinder):
        return _common(AHEAD, _projected_wall(solid, ray))
    return projected(solid, ray)


def no_parallel_case(solid: Solid, ray: Ray) -> Pairs:
    """A fault: a ray along the axis, for which vbar = 0 would be divided by, is a miss."""
    if isinstance(solid, InfiniteCylinder | Cylinder):
        w = _minus(solid.q, solid.p)
        if not any(_cross(ray.direction, w)):
            return []
    return projected(solid, ray)


def no_clip(solid: Solid, ray: Ray) -> Pairs:
    """A fault: what lies at t < 0 is not cut off, unless it has no beginning."""
    line = _common(*_parts(solid, ray, _projected_wall))
    return [(0.0 if enter == -inf else enter, leave) for enter, leave in line]


def swapped_pair(solid: Solid, ray: Ray) -> Pairs:
    """A fault: each pair is (leave, enter)."""
    return [(leave, enter) for enter, leave in projected(solid, ray)]


SOUND: dict[str, Intersect] = {
    "projected": projected,
    "local_frame": local_frame,
    "textbook": textbook,
}
FAULTS: dict[str, Intersect] = {
    "no_caps": no_caps,
    "no_parallel_case": no_parallel_case,
    "no_clip": no_clip,
    "swapped_pair": swapped_pair,
}


def _parts(solid: Solid, ray: Ray, wall: Wall) -> Iterator[Pairs]:
    """Yield what each face bounds of the whole line."""
    match solid:
        case HalfSpace(point, normal):
            yield _plane(point, normal, ray)
        case Slab(p, q) | Cylinder(p, q):
            yield _plane(p, _minus(p, q), ray)
            yield _plane(q, _minus(q, p), ray)
    match solid:
        case InfiniteCylinder() | Cylinder():
            yield wall(solid, ray)


def _plane(point: Vector, normal: Vector, ray: Ray) -> Pairs:
    height = _dot(_minus(ray.origin, point), normal)
    climb = _dot(ray.direction, normal)
    if climb == 0:
        return [LINE] if height <= 0 else []
    t = -height / climb
    return [(-inf, t)] if climb > 0 else [(t, inf)]


def _projected_wall(solid: InfiniteCylinder | Cylinder, ray: Ray) -> Pairs:
    n = _unit(_minus(solid.q, solid.p))
    y = _minus(ray.origin, solid.p)
    ybar = _minus(y, _times(_dot(y, n), n))
    vbar = _minus(ray.direction, _times(_dot(ray.direction, n), n))
    return _chord(ybar, vbar, solid.radius)


def _framed_wall(solid: InfiniteCylinder | Cylinder, ray: Ray) -> Pairs:
    n = _unit(_minus(solid.q, solid.p))
    least = min(range(3), key=lambda i: abs(n[i]))
    e = _unit(_cross(n, (float(least == 0), float(least == 1), float(least == 2))))
    f = _cross(n, e)
    y = _minus(ray.origin, solid.p)
    flat_y = (_dot(y, e), _dot(y, f), 0.0)
    flat_v = (_dot(ray.direction, e), _dot(ray.direction, f), 0.0)
    return _chord(flat_y, flat_v, solid.radius)


def _chord(y: Vector, v: Vector, r: float) -> Pairs:
    """Return where |y + t v| <= r, from the closest approach to the axis."""
    a = _dot(v, v)
    if a == 0:
        return [LINE] if hypot(*y) <= r else []
    middle = -_dot(y, v) / a
    x, z, w = y[0] + middle * v[0], y[1] + middle * v[1], y[2] + middle * v[2]
    closest = hypot(x, z, w)
    if closest > r:
        return []
    half = sqrt((r - closest) * (r + closest)) / sqrt(a)
    return [(middle - half, middle + half)]


def _textbook_wall(solid: InfiniteCylinder | Cylinder, ray: Ray) -> Pairs:
    n = _unit(_minus(solid.q, solid.p))
    y, v = _cross(_minus(ray.origin, solid.p), n), _cross(ray.direction, n)
    a, b, c = _dot(v, v), _dot(v, y), _dot(y, y) - solid.radius**2
    if a == 0:
        return [LINE] if c <= 0 else []
    discriminant = b * b - a * c
    if discriminant < 0:
        return []
    return [((-b - sqrt(discriminant)) / a, (-b + sqrt(discriminant)) / a)]


def _common(*lists: Pairs) -> Pairs:
    """Return what the lists, of one interval at most, have in common."""
    if not all(lists):
        return []
    enter, leave = max(pairs[0][0] for pairs in lists), min(pairs[0][1] for pairs in lists)
    return [(enter, leave)] if enter <= leave else []


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _times(k: float, a: Vector) -> Vector:
    return (k * a[0], k * a[1], k * a[2])


def _unit(a: Vector) -> Vector:
    return _times(1 / hypot(*a), a)


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
