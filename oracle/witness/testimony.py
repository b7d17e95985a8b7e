"""What a witness is, what it says, and which there are. Loads none of them before it is asked for.

A witness has three outcomes. `undecided` is never agreement, and no witness guesses to avoid it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Literal, TypeVar

from raycert.cases.hints import lacking
from raycert.cases.model import Ray, Solid
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import Surd, decimal

Outcome = Literal["agreed", "undecided", "disagreed"]
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Testimony:
    """What a witness says of an answer: the list it `found` itself, and `why` it says so."""

    outcome: Outcome
    found: str
    why: str

    __test__ = False  # no class of tests, whatever its name begins with


Witness = Callable[[Solid, Ray, Intervals], Testimony]

WITNESSES: dict[str, str] = {
    "definition": "raycert.oracle.witness.definition:witness",
    "enclosure": "raycert.oracle.witness.enclosure:witness",
    "symbols": "raycert.oracle.witness.symbols:witness",
    "meshes": "raycert.oracle.witness.meshes:witness",
}
"""Each witness as `module:function`, in the order they run."""

EXTRAS = ("symbols", "meshes")
"""Witnesses that need the extra of the distribution that has their name."""


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
        message = lacking(name, name, str(error.name).partition(".")[0])
        raise Missing(message, name=error.name) from None
    return witness


def compared(
    found: Sequence[tuple[T, T | None]],
    answer: Intervals,
    show: Callable[[T | None], str],
    fault: Callable[[T | None, Surd], str | None],
    agreed: str,
) -> Testimony:
    """Return what a list found says of an answer; None is infinity.

    `fault` says what is wrong with an end of the answer, None if it is the end found, and `agreed`
    why the two lists are one.
    """
    text = listed(found, show)
    if len(found) != len(answer):
        why = f"{len(found)} intervals, and the answer has {len(answer)}"
        return Testimony("disagreed", text, why)
    for number, (pair, other) in enumerate(zip(found, answer, strict=True)):
        for end, mine, t in zip(("enter", "leave"), pair, other, strict=True):
            if wrong := fault(mine, t):
                return Testimony("disagreed", text, f"the {end} of interval {number} {wrong}")
    return Testimony("agreed", text, agreed)


def listed(pairs: Sequence[tuple[T, T | None]], show: Callable[[T | None], str]) -> str:
    """Return a list for people, each end as `show` has it."""
    return "[" + ", ".join(f"[{show(a)}, {show(b)}]" for a, b in pairs) + "]"


def show(intervals: Intervals) -> str:
    """Return an exact list for people: short fractions as they are, other numbers to 20 digits."""
    return listed(intervals, show_end)


def show_end(t: Surd | None) -> str:
    """Return one end for people; None is infinity."""
    if t is None:
        return "inf"
    value = t.rational()
    short = value is not None and max(value.numerator, value.denominator) < 10**9
    return str(value) if short else decimal(t, 20)
