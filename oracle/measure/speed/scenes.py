"""The cost of a ray against the number of solids: the batched reference tracer, 1 to 1,000 of them.

Once with the plan, which leaves out what the rays cannot meet, once with nothing left out: the
same pictures of the same size, to the bit. The time is that of the whole picture, plan included.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from typing import Any

from raycert.oracle.measure.speed.clock import race

PATIENCE = 8.0
"""Seconds of a way at one number of solids, the fewest passes aside."""


@dataclass(frozen=True, slots=True)
class Row:
    """Microseconds of a ray, planned and with nothing left out; whether the bits are the same."""

    solids: int
    size: tuple[int, int]
    planned_us: float
    plain_us: float
    ratio: float
    same: bool


def numbers(most: int) -> list[int]:
    """Return the numbers of solids, up to `most`."""
    found: list[int] = import_module("raycert.reference.arrays.measure").numbers(most)
    return found


def rows(size: tuple[int, int], most: int, repeats: int) -> Iterator[Row]:
    """Yield a row for each number of solids."""
    measure = import_module("raycert.reference.arrays.measure")
    pixels = size[0] * size[1]
    for n in numbers(most):
        scene = measure.crowd(n, size)
        ways = {
            "planned": partial(_picture, scene, frozenset()),
            "plain": partial(_picture, scene, measure.EVERYTHING),
        }
        planned, plain = race(ways, repeats, PATIENCE).values()
        yield Row(
            n,
            size,
            planned.seconds / pixels * 1e6,
            plain.seconds / pixels * 1e6,
            plain.seconds / planned.seconds,
            planned.answer.tobytes() == plain.answer.tobytes(),
        )


def _picture(scene: Any, off: frozenset[str]) -> Any:
    made = import_module("raycert.reference.arrays.plan").plan(scene, "depth", off)
    return import_module("raycert.reference.arrays.picture").picture(made, "depth").values
