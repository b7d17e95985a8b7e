"""Marks that do not overlap: each as near to where it belongs as the others let it."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, hypot, pi, sin

Place = tuple[float, float]
TURNS = 24


def apart(places: Sequence[Place], distance: float) -> list[Place]:
    """Return places that keep a distance from each other; the first of a crowd stays.

    Each goes to the nearest free place on circles around its own: of equals, the leftmost.
    """
    found: list[Place] = []
    for place in places:
        found.append(next(p for p in _around(place, distance) if _free(p, found, distance)))
    return found


def _free(place: Place, taken: Sequence[Place], distance: float) -> bool:
    return all(hypot(place[0] - x, place[1] - y) >= distance * (1 - 1e-9) for x, y in taken)


def _around(place: Place, distance: float) -> list[Place]:
    steps = [distance * (1 + k / 4) for k in range(40)]
    return [place] + [
        (place[0] + r * cos(2 * pi * i / TURNS), place[1] + r * sin(2 * pi * i / TURNS))
        for r in steps
        for i in range(TURNS)
    ]
