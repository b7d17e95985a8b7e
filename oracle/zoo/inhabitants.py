"""Everything in the zoo: planted faults, sound tracers, and the faults that need a process.

A sound tracer is right in another way than the base, and stands here with what it deserves.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import Any

from raycert.cases.levels import Level
from raycert.cases.model import Ray, Solid
from raycert.cases.vectors import cross, dot, minus, times
from raycert.oracle.zoo import limits, lists, surfaces
from raycert.oracle.zoo.tracer import (
    BASE,
    PLAIN,
    Fault,
    Intersect,
    Pairs,
    Sight,
    Tracer,
    ahead,
    discriminant,
    fault,
    fraction,
    merged,
    single,
    unit,
    unscaled,
)


@dataclass(frozen=True)
class Sound:
    """A tracer that is right in another way, and what it deserves.

    `deserves` is the highest level, where `but` names no other for the type of solid.
    """

    name: str
    does: str
    tracer: Intersect
    deserves: Level
    convention: str = "closed"
    precision: str = "binary64"
    but: tuple[tuple[str, Level], ...] = ()


@dataclass(frozen=True)
class ProcessFault:
    """A fault that needs a process of its own; `test` is the one that sees it."""

    name: str
    does: str
    test: str


FAULTS = (*surfaces.FAULTS, *limits.FAULTS, *lists.FAULTS)
"""The planted faults, by the part of a tracer that they are in."""

BY_NAME: dict[str, Fault] = {planted.name: planted for planted in FAULTS}

HARNESS = "tests/client/test_replay.py::"
PINNED = HARNESS + "test_a_fault_is_pinned_on_its_question"
CRASHES = HARNESS + "test_crashes_and_hangs_are_pinned_and_all_else_is_graded"
PROCESS: tuple[ProcessFault, ...] = (
    ProcessFault("crash", "ends at every hundredth question", CRASHES),
    ProcessFault("hang", "never answers every five-hundredth question", CRASHES),
    ProcessFault("chatter", "writes a word to standard output before its answer", PINNED),
    ProcessFault("after", "writes a word to standard output after its answer", PINNED),
    ProcessFault("half", "ends in the middle of a line", PINNED),
    ProcessFault("no-newline", "answers without the end of the line", PINNED),
    ProcessFault("wrong-id", "answers to another id", PINNED),
    ProcessFault("dies-after", "ends after its answer",
                 HARNESS + "test_a_death_after_an_answer_is_pinned_on_that_answer"),
    ProcessFault("hostile", "answers with what is no list of pairs",
                 HARNESS + "test_a_hostile_line_is_a_verdict"),
)  # fmt: skip
"""Faults of a process; the clients that have them are in tests/clients."""


def _framed(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the wall, in a frame whose third axis is pq."""
    n = unit(s.w)
    least = min(range(3), key=lambda i: abs(n[i]))
    e = unit(cross(n, (float(least == 0), float(least == 1), float(least == 2))))
    f = cross(n, e)
    y, v = (dot(s.y, e), dot(s.y, f), 0.0), (dot(s.v, e), dot(s.v, f), 0.0)
    return self.chord(y, v, s.r)


def _rationally(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the wall: projected without a root."""
    k = 1 / dot(s.w, s.w)
    y = minus(s.y, times(dot(s.y, s.w) * k, s.w))
    return self.chord(y, minus(s.v, times(dot(s.v, s.w) * k, s.w)), s.r)


def _to_double(solid: Solid, ray: Ray, pairs: Pairs) -> Pairs:
    return merged([(_float(a), _float(b)) for a, b in pairs])


def _float(t: float) -> float:
    try:
        return float(t)
    except OverflowError:
        return inf


DROPPED: dict[str, Any] = {
    "chord": surfaces.off_wall, "plane": surfaces.off_plane,
    "ahead": lambda pairs: [(a, b) for a, b in ahead(pairs) if a < b],
}  # fmt: skip
"""The steps of a tracer that drops what only touches."""

UNSTRESSED = ("half_space", "slab")
"""Solids with no discriminant."""

TEXTBOOK = "solves by the discriminant b^2 - a c"
DISCRIMINANT = fault("discriminant", TEXTBOOK, "any textbook: far away, c is all cancellation",
                     "sphere-far", "wrong end", "sound", chord=discriminant)  # fmt: skip
CATALOGUE = (*FAULTS, DISCRIMINANT)
"""What failures are explained by: planted faults, and what is sound and not stable."""

SOUND: tuple[Sound, ...] = (
    Sound("base", "crosses with the axis, and starts from the closest approach", BASE, "stable"),
    Sound("projected", "projects on the plane square to the axis, and scales nothing",
          replace(BASE, **PLAIN), "stable"),
    Sound("local-frame", "turns the ray into a frame whose third axis is that of the solid",
          replace(BASE, scale=unscaled, wall=_framed), "stable"),
    Sound("textbook", TEXTBOOK, replace(BASE, chord=discriminant), "sound",
          but=tuple((name, "stable") for name in UNSTRESSED)),
    Sound("extended", "computes in fractions, roots to 240 bits, and rounds at the end",
          replace(BASE, number=fraction, scale=unscaled, wall=_rationally, chord=discriminant,
                  tell=_to_double), "exact"),
    Sound("binary32", "computes in binary32, and declares it", replace(BASE, number=single),
          "stable", precision="binary32"),
    Sound("regularized", "drops what only touches", replace(BASE, **DROPPED), "stable",
          convention="regularized"),
    Sound("negative-zero", "answers -0 for 0",
          replace(BASE, tell=lambda _, __, pairs: [(a or -0.0, b or -0.0) for a, b in pairs]),
          "stable"),
)  # fmt: skip
