"""What a plan is worth, and what a scene costs as it grows: measured, in one run.

Times of one run are comparable: the ways are tried in turn, several times over, and the least time
of each counts. A time is that of a whole picture, its plan included.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from time import perf_counter

from raycert.cases.model import Cylinder, Solid, Sphere
from raycert.cases.scene import Camera, Scene
from raycert.reference.arrays.items import ITEMS, Item, Show
from raycert.reference.arrays.picture import picture
from raycert.reference.arrays.plan import Plan, plan

EVERYTHING = frozenset(ITEMS)
COARSE = 8
CAMERA = Camera("perspective", (4.0, -5.0, 3.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 32.0)


@dataclass(frozen=True, slots=True)
class Worth:
    """An item, and the seconds that a picture takes with it and without; 0 where it is not used."""

    item: Item
    with_it: float
    without: float


@dataclass(frozen=True, slots=True)
class Cost:
    """Seconds that so many solids take, planned and with nothing left out."""

    solids: int
    planned: float
    plain: float


def worth(scene: Scene, show: Show, repeats: int = 3) -> tuple[list[Worth], Cost]:
    """Return what each item is worth in a scene, and all of them together."""
    everything_on = _way(scene, show, frozenset())
    found = []
    for item in plan(scene, show).items:
        seconds = [0.0, 0.0]
        if item.applies:
            seconds = least([everything_on, _way(scene, show, frozenset((item.name,)))], repeats)
        found.append(Worth(item, *seconds))
    whole = least([everything_on, _way(scene, show, EVERYTHING)], repeats)
    return found, Cost(len(scene.solids), *whole)


def costs(size: tuple[int, int], repeats: int = 3, most: int = 1000) -> list[Cost]:
    """Return what a ray costs in scenes of 1 to `most` solids: a crowd that fills one cube.

    With nothing left out a ray costs the same in every picture, so that is timed in a small one.
    """
    small = (max(size[0] // COARSE, 1), max(size[1] // COARSE, 1))
    found = []
    for n in numbers(most):
        (planned,) = least([_way(crowd(n, size), "depth", frozenset())], repeats)
        (plain,) = least([_way(crowd(n, small), "depth", EVERYTHING)], repeats)
        found.append(Cost(n, planned / (size[0] * size[1]), plain / (small[0] * small[1])))
    return found


def numbers(most: int) -> list[int]:
    """Return 1, 2, 5, 10, 20, ... up to a number, and that number.

    >>> numbers(30)
    [1, 2, 5, 10, 20, 30]
    """
    steps = [n * 10**e for e in range(len(str(most))) for n in (1, 2, 5)]
    return [n for n in steps if n < most] + [most]


def crowd(n: int, size: tuple[int, int]) -> Scene:
    """Return n spheres and cylinders, the same every time, of a size that keeps the cube as full.

    >>> [len(crowd(n, (8, 6)).solids) for n in (1, 7)]
    [1, 7]
    """
    dice = random.Random(n)
    reach = 0.5 * n ** (-1 / 3)
    solids: list[tuple[str, Solid]] = []
    for i in range(n):
        x, y, z = (dice.uniform(-1, 1) for _ in range(3))
        if i % 2:
            tip = (x + dice.uniform(-1, 1) * reach, y + dice.uniform(-1, 1) * reach, z + reach)
            solids.append((f"rod {i}", Cylinder((x, y, z), tip, reach / 2)))
        else:
            solids.append((f"ball {i}", Sphere((x, y, z), reach)))
    return Scene(tuple(solids), CAMERA, size)


def least(ways: list[Callable[[], None]], repeats: int) -> list[float]:
    """Return the least seconds of each way, tried in turn."""
    best = [inf] * len(ways)
    for _ in range(repeats):
        for i, way in enumerate(ways):
            began = perf_counter()
            way()
            best[i] = min(best[i], perf_counter() - began)
    return best


def _way(scene: Scene, show: Show, off: frozenset[str]) -> Callable[[], None]:
    def run() -> None:
        made: Plan = plan(scene, show, off)
        picture(made, show)

    return run
