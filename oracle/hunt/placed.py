"""The same probe elsewhere, in another size, with other leaves; in doubles, rounded."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from raycert.cases.formats import Format
from raycert.cases.model import (
    Difference,
    HalfSpace,
    Intersection,
    Leaf,
    Ray,
    Refused,
    Solid,
    Sphere,
    Union,
    Vector,
)
from raycert.cases.numbers import Probe, rounded


def kept(found: Iterable[Probe | None], fmt: Format) -> list[Probe]:
    """Return the probes there are, in numbers of the format."""
    exact = [rounded(probe, fmt) for probe in found if probe is not None]
    return [probe for probe in exact if probe is not None]


def plus(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    """Return a + factor b, in doubles."""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def axis_of(leaf: Leaf) -> Vector:
    """Return a direction that matters to a leaf."""
    if isinstance(leaf, HalfSpace):
        return leaf.normal
    if isinstance(leaf, Sphere):
        return (0.0, 0.0, 1.0)
    w = plus(leaf.q, leaf.p, -1.0)
    return w if any(w) else (0.0, 0.0, 1.0)


def change(solid: Solid, leaf_change: Callable[[Any], Any]) -> Solid | None:
    """Return the solid with every leaf changed; None where that makes no solid."""

    def changed(part: Solid) -> Solid:
        if isinstance(part, Union | Intersection | Difference):
            return type(part)(tuple(changed(child) for child in part.of))
        new: Solid = leaf_change(part)
        return new

    try:
        return changed(solid)
    except Refused:
        return None


def moved(probe: Probe, step: Vector) -> Probe | None:
    """Return the probe moved by a step; None where rounding makes that no solid."""

    def leaf(part: Any) -> Any:
        names = [name for name in ("point", "center", "p", "q") if hasattr(part, name)]
        return replace(part, **{name: plus(getattr(part, name), step) for name in names})

    solid, ray = change(probe.solid, leaf), probe.ray
    return Probe(solid, Ray(plus(ray.origin, step), ray.direction)) if solid else None


def scaled(probe: Probe, factor: float, of_direction: bool = False) -> Probe | None:
    """Return the probe with all lengths, or the direction only, times a factor; or None."""
    zero = (0.0, 0.0, 0.0)

    def leaf(part: Any) -> Any:
        names = [name for name in ("point", "center", "p", "q") if hasattr(part, name)]
        values: dict[str, Any] = {name: plus(zero, getattr(part, name), factor) for name in names}
        if hasattr(part, "radius"):
            values["radius"] = part.radius * factor
        return replace(part, **values)

    solid = probe.solid if of_direction else change(probe.solid, leaf)
    origin, direction = probe.ray.origin, probe.ray.direction
    try:
        if of_direction:
            ray = Ray(origin, plus(zero, direction, factor))
        else:
            ray = Ray(plus(zero, origin, factor), direction)
    except Refused:
        return None
    return Probe(solid, ray) if solid else None
