"""Rays for the batched tracer, the numbered tree they meet, and the shortcuts that are taken.

A `Part` is a node of the solid with its place in the plan's tables. A `Bundle` is the rays of a
tile: it remembers what several parts ask of it, and hands on what all rays of a scene share.
`Switches` say which shortcuts are taken; none of them changes a bit of an answer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TypeVar

from raycert.cases.model import Solid, Tree
from raycert.reference.arrays.lists import Lists
from raycert.reference.arrays.quadratic import How, Line, Start, chord
from raycert.reference.arrays.vectors import Mask, Vectors, Whole, take_all

T = TypeVar("T")
Chord = Callable[[Start, Line, How, int], Lists]
Memory = dict[object, object]


@dataclass(frozen=True, slots=True)
class Switches:
    """What the leaf routines do and leave out; the plan's items of the same names say why."""

    scaling: bool = True
    axis: bool = False
    shared: bool = False
    caps: bool = True
    lists: bool = True
    misses: bool = False
    first: bool = False
    chord: Chord = chord


PLAIN = Switches()
"""Nothing left out."""


@dataclass(frozen=True)
class Part:
    """A node: `index` is its column in the tables `seen` and `between` of a bundle."""

    solid: Solid
    parts: tuple[Part, ...]
    index: int


def number(solid: Solid, index: int = 0) -> Part:
    """Return the tree with its nodes numbered, the root first."""
    parts = []
    last = index
    for child in solid.of if isinstance(solid, Tree) else ():
        parts.append(number(child, last + 1))
        last = greatest(parts[-1])
    return Part(solid, tuple(parts), index)


def greatest(part: Part) -> int:
    """Return the greatest index in a tree."""
    while part.parts:
        part = part.parts[-1]
    return part.index


def walk(part: Part) -> Iterator[Part]:
    """Yield a tree's nodes in the order of their numbers."""
    yield part
    for child in part.parts:
        yield from walk(child)


@dataclass(frozen=True)
class Bundle:
    """Rays: origin and direction, each for all lanes at once or lane by lane.

    `kept` outlives the bundle: it is for what depends on a vector that all rays of the scene
    share. `here` is for what parts of this bundle share, `lists` has what was found of each.
    `seen` tells which parts the rays may meet, `between` which cylinders only between the caps.
    """

    origin: Vectors
    direction: Vectors
    lanes: int
    switches: Switches = PLAIN
    kept: Memory = field(default_factory=dict)
    one_origin: bool = False
    one_direction: bool = False
    seen: Mask | None = None
    between: Mask | None = None
    here: Memory = field(default_factory=dict)
    lists: dict[int, Lists] = field(default_factory=dict)

    def only(self, lanes: Whole) -> Bundle:
        """Return some of the rays."""
        origin, direction = take_all(self.origin, lanes), take_all(self.direction, lanes)
        return replace(
            self, origin=origin, direction=direction, lanes=lanes.size, here={}, lists={}
        )

    def of_origin(self, key: object, make: Callable[[], T]) -> T:
        """Return what depends on the origins alone: made once where they are all the same."""
        return self._remembered(self.one_origin, ("origin", key), make)

    def of_direction(self, key: object, make: Callable[[], T]) -> T:
        """Return what depends on the directions alone: likewise."""
        return self._remembered(self.one_direction, ("direction", key), make)

    def _remembered(self, one: bool, key: object, make: Callable[[], T]) -> T:
        if not (one or self.switches.shared):
            return make()
        memory = self.kept if one else self.here
        if key not in memory:
            memory[key] = make()
        return memory[key]  # type: ignore[return-value]

    def sees(self, part: Part) -> bool:
        """Tell whether the rays may meet a part."""
        return self.seen is None or bool(self.seen[part.index])
