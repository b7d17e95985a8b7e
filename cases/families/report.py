"""What a reported case is made of: what the report gives, and what is chosen here to draw it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.case import Case, Tier
from raycert.cases.families.frames import UPRIGHT, Exact, Frame
from raycert.cases.families.ladders import is_double
from raycert.cases.families.sketch import Body, Pairs, row
from raycert.cases.formats import Format

GIVEN = ""
"""What is ours in a scene that the report gives whole."""

NUMBERS = "numbers"
"""What is ours where the report names a trigger and no scene."""


@dataclass(frozen=True, slots=True)
class Report:
    """One reported trigger: `source` is the report, `why` one fact about the scene.

    `ours` is what of the scene is chosen here; the sentence of the case ends with it.
    `large` marks distances and sizes that only binary64 has room for.
    """

    slug: str
    source: str
    ours: str
    why: str
    body: Body
    origin: Exact
    direction: Exact
    known: Pairs | None = None
    flags: tuple[str, ...] = ()
    frame: Frame = UPRIGHT
    tier: Tier = "stiff"
    large: bool = False

    @property
    def sentence(self) -> str:
        """Return the fact, and whose numbers these are."""
        whose = f"{self.ours} chosen here" if self.ours else "numbers as given"
        return f"{self.why}; {whose}"

    def case(self, fmt: Format) -> Case | None:
        """Return the case, or None where the format has no room for it."""
        if self.large and not is_double(fmt):
            return None
        return row(
            fmt,
            self.slug,
            self.sentence,
            self.body,
            self.origin,
            self.direction,
            frame=self.frame,
            tier=self.tier,
            flags=("reported", *self.flags),
            known=self.known,
            source=self.source,
        )


def at(text: str) -> Exact:
    """Return the point or vector with these decimal components.

    >>> at("0.5 -1e-3 2")
    (Fraction(1, 2), Fraction(-1, 1000), Fraction(2, 1))
    """
    x, y, z = (Fraction(word) for word in text.split())
    return (x, y, z)


def number(text: str) -> Fraction:
    """Return the exact value of a decimal."""
    return Fraction(text)
