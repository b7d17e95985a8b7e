"""The words that rows are sorted by and answers are graded with: tiers and levels.

Nothing is imported here, so that whoever only spells an option pays for nothing else.
"""

from __future__ import annotations

from typing import Literal

Tier = Literal["lattice", "generic", "stiff", "range"]
TIERS: tuple[Tier, ...] = ("lattice", "generic", "stiff", "range")
"""How hard the numbers of a row are; `range` over- or underflows, and is part of no level."""
Level = Literal["sound", "stable", "faithful", "exact"]
LEVELS: tuple[Level, ...] = ("sound", "stable", "faithful", "exact")
"""From weak to strong; each includes the ones before it."""


def upto(level: Level) -> tuple[Level, ...]:
    """Return a level with those that it includes, from weak to strong.

    >>> upto("stable")
    ('sound', 'stable')
    """
    return LEVELS[: LEVELS.index(level) + 1]
