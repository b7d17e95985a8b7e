"""The two views of a case: along the axis of its solid, and across.

Along is the plane of the ray and the axis: there the caps are lines. Across, a lone cylinder is
seen in the direction of its axis, a disc before which the ray goes as ybar + t vbar; of a tree it
is the plane of the ray that cuts across. What has no axis looks the same from all sides of the
ray, and has one view. In each x is t; a ray that does not move there is its start alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.model import Cylinder, InfiniteCylinder, Leaf, Ray, Slab, Solid, Tree, Vector
from raycert.oracle.reports.plane import Plane, crosswise, lengthwise
from raycert.oracle.reports.scene import Exact, Scene, exact, pivot, seen


@dataclass(frozen=True, slots=True)
class View:
    """A view: its name, its contents, and whether the ray stays at its start there."""

    name: str
    scene: Scene
    still: bool = False


def views(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> list[View]:
    """Return the views of a case, none for what no picture can hold; `ends` are finite."""
    found = [_along(solid, ray, ends)]
    if isinstance(solid, Cylinder | InfiniteCylinder):
        found.append(_end_on(solid, ray, ends))
    elif isinstance(solid, Tree):
        found.append(_across(solid, ray, ends))
    return [view for view in found if view is not None]


def _along(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> View | None:
    origin, direction = exact(ray.origin), exact(ray.direction)
    leaf, still = pivot(solid), not any(ray.direction)
    if still:
        axis = isinstance(leaf, Cylinder | InfiniteCylinder | Slab)
        direction = _axis(leaf) if axis else exact((1.0, 0.0, 0.0))  # type: ignore[arg-type]
    scene = seen(solid, origin, direction, [Fraction(0)] if still else ends, lengthwise)
    return None if scene is None else View(scene.plane.name, scene, still)


def _across(solid: Solid, ray: Ray, ends: Sequence[Fraction]) -> View | None:
    def choose(leaf: Leaf, along: Vector) -> list[Plane]:
        return [crosswise(leaf, along)]

    scene = seen(solid, exact(ray.origin), exact(ray.direction), ends, choose)
    return None if scene is None else View("The plane of the ray across the first", scene)


def _end_on(leaf: Cylinder | InfiniteCylinder, ray: Ray, ends: Sequence[Fraction]) -> View | None:
    """Return the view in the direction of the axis; the caps are not seen there."""
    w, v = _axis(leaf), exact(ray.direction)
    share = _dot(v, w) / _dot(w, w)
    across = _minus(v, w, share)
    still = not any(across)
    if still:
        towards = _minus(exact(leaf.p), exact(ray.origin), Fraction(1))
        across = _minus(towards, w, _dot(towards, w) / _dot(w, w))
        least = min(range(3), key=lambda i: abs(w[i]))
        unit = exact([float(i == least) for i in range(3)])
        across = across if any(across) else _minus(unit, w, w[least] / _dot(w, w))
    wall = InfiniteCylinder(leaf.p, leaf.q, leaf.radius)

    def choose(leaf: Leaf, along: Vector) -> list[Plane]:
        return [crosswise(leaf, along)]

    scene = seen(wall, exact(ray.origin), across, [Fraction(0)] if still else ends, choose)
    name = "Seen along the axis: the wall is a circle, the ray is ybar + t vbar"
    return None if scene is None else View(name, scene, still)


def _axis(leaf: Cylinder | InfiniteCylinder | Slab) -> Exact:
    return _minus(exact(leaf.q), exact(leaf.p), Fraction(1))


def _minus(a: Exact, b: Exact, k: Fraction) -> Exact:
    """Return a - k b."""
    return (a[0] - k * b[0], a[1] - k * b[1], a[2] - k * b[2])


def _dot(a: Exact, b: Exact) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
