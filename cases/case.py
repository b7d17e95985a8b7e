"""A case: one question, and why it is asked.

Families (cases/families/) make cases; the oracle answers them; the corpus stores both. A case
carries no answer but the one that its construction makes evident (`known`), which the oracle
has to reproduce.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.formats import Format
from raycert.cases.levels import TIERS as TIERS
from raycert.cases.levels import Tier as Tier
from raycert.cases.model import Ray, Solid

KnownEnd = Fraction | int | None
"""An endpoint known by construction; None is infinity."""


@dataclass(frozen=True, slots=True)
class Case:
    """A ray, a solid, and the reason to ask.

    `slug` is unique in its family and never reused; with the family it makes the id. `why` is one
    sentence of fact. `source` is `construction`, `oracle`, or a public bug report. `known` is the
    exact interval list where the construction gives it, else None.
    """

    slug: str
    why: str
    solid: Solid
    ray: Ray
    tier: Tier
    flags: tuple[str, ...] = ()
    source: str = "oracle"
    known: tuple[tuple[KnownEnd, KnownEnd], ...] | None = None


@dataclass(frozen=True, slots=True)
class Family:
    """Cases with one reason to exist, under a name. `cases(fmt)` makes them, the same each time."""

    name: str
    reason: str
    cases: Callable[[Format], Iterable[Case]]
