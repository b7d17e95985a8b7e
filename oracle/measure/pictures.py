"""Pictures of scenes: what each item of a plan is worth, and what a ray costs as the scene grows.

A plan leaves out what the rays cannot meet; the pictures are the same to the bit with it and
without. A time is that of a whole picture, its plan included, on the one clock, in one run. The
tracer is the batched reference, named by its module, as any target is.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from typing import Any

from raycert.cases.model import Cylinder, Solid, Sphere
from raycert.cases.scene import Camera, Scene
from raycert.oracle.measure.clock import Race

NOTHING: frozenset[str] = frozenset()
CAMERA = Camera("perspective", (4.0, -5.0, 3.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 32.0)
PATIENCE = 8.0
"""Seconds of one way at one number of solids, the fewest passes aside."""


@dataclass(frozen=True, slots=True)
class Worth:
    """An item, and the seconds that a picture takes with it and without; 0 where it is not used."""

    item: Any
    with_it: float = 0.0
    without: float = 0.0


def reference(module: str, name: str) -> Any:
    return getattr(import_module(f"raycert.reference.arrays.{module}"), name)


def everything() -> frozenset[str]:
    return frozenset(reference("plan", "ITEMS"))


def picture(scene: Scene, show: str, off: frozenset[str]) -> Any:
    return reference("picture", "picture")(reference("plan", "plan")(scene, show, off), show).values


def worth(scene: Scene, show: str, repeats: int = 3) -> tuple[list[Worth], tuple[float, float]]:
    """Return what each item is worth in a scene, and the seconds with all of them and with none."""
    items = reference("plan", "plan")(scene, show).items
    off = {one.name: frozenset({one.name}) for one in items if one.applies}
    off |= {"planned": NOTHING, "plain": everything()}
    race = Race({name: partial(picture, scene, show, some) for name, some in off.items()})
    least = {name: race.least(name) for name in race.run(repeats).ways}
    planned = least["planned"]
    rows = [Worth(one, *((planned, least[one.name]) if one.applies else ())) for one in items]
    return rows, (planned, least["plain"])


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


def costs(
    size: tuple[int, int],
    most: int,
    repeats: int,
    draw: Callable[[Scene, str, frozenset[str]], Any] = picture,
) -> Iterator[dict[str, Any]]:
    """Yield for each number of solids, up to `most`, microseconds of a ray, planned and not."""
    pixels = size[0] * size[1]
    for n in numbers(most):
        scene = crowd(n, size)
        race = Race(
            {
                "planned": partial(draw, scene, "depth", NOTHING),
                "plain": partial(draw, scene, "depth", everything()),
            }
        ).run(repeats, PATIENCE)
        planned, plain = race.least("planned"), race.least("plain")
        same = race.answers["planned"].tobytes() == race.answers["plain"].tobytes()
        yield {
            "solids": n,
            "size": size,
            "planned_us": planned / pixels * 1e6,
            "plain_us": plain / pixels * 1e6,
            "ratio": plain / planned,
            "same": same,
        }
