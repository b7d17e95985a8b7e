"""What is said of an inhabitant of the zoo."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

from raycert.cases.levels import Level
from raycert.cases.model import Ray, Solid
from raycert.oracle.zoo.tracer import BASE, Pairs

Intersect = Callable[[Solid, Ray], Pairs]
Kind = Literal[
    "crash", "malformed", "missed", "phantom", "wrong end", "count", "touch dropped", "unrepeated"
]
"""How an answer is refused; see `matrix.kind` for what each means."""


@dataclass(frozen=True)
class Fault:
    """A planted fault: `does` completes "a tracer that ...".

    `home` is the family made for it, `kind` the way most of its answers there are refused.
    `granted` is the highest level that its answers are still granted, `make` gives a new tracer;
    a `stateful` one answers by what it was asked before.
    """

    name: str
    does: str
    origin: str
    home: str
    kind: Kind
    make: Callable[[], Intersect]
    granted: Level | None = None
    stateful: bool = False


def fault(
    name: str,
    does: str,
    origin: str,
    home: str,
    kind: Kind,
    granted: Level | None = None,
    **steps: Any,
) -> Fault:
    tracer = replace(BASE, **steps)
    return Fault(name, does, origin, home, kind, lambda: tracer, granted)


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
