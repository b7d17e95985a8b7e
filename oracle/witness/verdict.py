"""What a witness is, what it says, and which there are. Loads none of them before it is asked for.

A witness has three outcomes. `undecided` is never agreement, and no witness guesses to avoid it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Literal

from raycert.cases.model import Ray, Solid
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.rounding import decimal
from raycert.oracle.exact.surd import Surd

Outcome = Literal["agreed", "undecided", "disagreed"]
OUTCOMES: tuple[Outcome, ...] = ("agreed", "undecided", "disagreed")


@dataclass(frozen=True, slots=True)
class Verdict:
    """What a witness says of an answer: the list it `found` itself, and `why` it says so."""

    outcome: Outcome
    found: str
    why: str


Witness = Callable[[Solid, Ray, Intervals], Verdict]

WITNESSES: dict[str, str] = {
    "definition": "raycert.oracle.witness.definition:witness",
    "enclosure": "raycert.oracle.witness.enclosure:witness",
    "symbols": "raycert.oracle.witness.symbols_solve:witness",
    "meshes": "raycert.oracle.witness.meshes:witness",
}
"""Each witness as `module:function`, in the order they run."""

EXTRAS = {"symbols": "symbols", "meshes": "meshes"}
"""The extra of the distribution that a witness needs."""


class Missing(ImportError):
    """A witness whose libraries are not installed; the text says what to install."""


def load(name: str) -> Witness:
    """Return a witness, imported now. Raises `Missing` where its libraries are not installed."""
    module, _, function = WITNESSES[name].partition(":")
    try:
        witness: Witness = getattr(import_module(module), function)
    except ImportError as error:
        if name not in EXTRAS:
            raise
        message = f'{name} needs {error.name}: pip install "raycert[{EXTRAS[name]}]"'
        raise Missing(message, name=error.name) from None
    return witness


def show(intervals: Intervals) -> str:
    """Return an exact list for people: short fractions as they are, other numbers to 20 digits."""
    return "[" + ", ".join(f"[{_show(a)}, {_show(b)}]" for a, b in intervals) + "]"


def _show(t: Surd) -> str:
    value = t.rational()
    short = value is not None and max(value.numerator, value.denominator) < 10**9
    return str(value) if short else decimal(t, 20)


def lengths_differ(found: int, answered: int) -> str:
    """Return the reason that goes with lists of different lengths."""
    return f"{found} intervals, and the answer has {answered}"
