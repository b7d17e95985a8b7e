"""Solids in many lanes: a leaf's list, or those of a tree's parts combined."""

from __future__ import annotations

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Slab,
    Sphere,
    Union,
)
from raycert.reference.arrays.bundle import Bundle, Part
from raycert.reference.arrays.leaves import cylinder, half_space, slab, sphere
from raycert.reference.arrays.lists import Lists, difference, intersection, nothing, union


def solve(part: Part, rays: Bundle, first: bool = False) -> Lists:
    """Return the intervals of t >= 0 for which each ray is in a solid.

    With `first`, the leaves of a primitive need not be there. The bundle remembers what is found.
    """
    if not rays.sees(part):
        return nothing(rays.lanes)
    found = _tree(part, rays) if part.parts else _leaf(part, rays, first)
    rays.lists[part.index] = found
    return found


def _leaf(part: Part, rays: Bundle, first: bool) -> Lists:
    match part.solid:
        case HalfSpace() as solid:
            return half_space(solid, rays)
        case Sphere() as solid:
            return sphere(solid, rays, first)
        case Slab() as solid:
            return slab(solid, rays)
        case Cylinder() as solid:
            between = rays.between is not None and bool(rays.between[part.index])
            return cylinder(solid, rays, not between, first)
        case InfiniteCylinder() as solid:
            return cylinder(solid, rays, False, first)
    raise TypeError(part.solid)


def _tree(part: Part, rays: Bundle) -> Lists:
    """Combine the lists of the parts; where one list is the answer, nothing is compared."""
    short = not rays.switches.lists
    keep = isinstance(part.solid, Intersection)
    lists: list[Lists] = []
    for i, child in enumerate(part.parts):
        found = solve(child, rays)
        if short and not found.lane.size:
            if keep or (i == 0 and isinstance(part.solid, Difference)):
                return found
            continue
        lists.append(found)
    if not lists:
        return nothing(rays.lanes)
    if short and len(lists) == 1:
        return lists[0]
    match part.solid:
        case Union():
            return union(lists)
        case Intersection():
            return intersection(lists)
    return difference(lists[0], union(lists[1:])) if len(lists) > 1 else union(lists)
