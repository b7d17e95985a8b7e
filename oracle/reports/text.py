"""Words and numbers as every report prints them. Whatever a client said goes through `clean`."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from math import isfinite

HIDDEN = {"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"}
"""Categories that print nothing, change the direction, or are no characters at all."""
MARKS = {"Mn", "Me"}
UNKNOWN = "\ufffd"
ELLIPSIS = "\u2026"
SHORT, LONG = 60, 300


def clean(text: str, most: int = LONG) -> str:
    """Return one line of at most `most` characters that any terminal, XML or page can hold.

    White space becomes a space, what is hidden becomes U+FFFD, and of marks piled on a letter two
    are left.
    """
    kept: list[str] = []
    piled = 0
    for char in text[: 4 * most]:
        category = unicodedata.category(char)
        piled = piled + 1 if category in MARKS else 0
        if char.isspace():
            kept.append(" ")
        elif category in HIDDEN:
            kept.append(UNKNOWN)
        elif piled <= 2:
            kept.append(char)
    whole = len(text) <= 4 * most and len(kept) <= most
    return "".join(kept) if whole else "".join(kept[: most - 1]) + ELLIPSIS


def count(n: int, noun: str) -> str:
    """Return a number with its noun: `1 row`, `2,000 rows`."""
    return f"{n:,} {noun}" + ("" if n == 1 else "s")


def number(x: float | None) -> str:
    """Return a measured error in at most seven characters; null is infinite."""
    if x is None or not isfinite(x):
        return "inf"
    return f"{x:.3g}" if x < 1e5 else f"{x:.0e}"


def decimal(text: str) -> str:
    """Return a hex float in decimal, the shortest that round-trips."""
    return repr(float.fromhex(text))


def intervals(pairs: Sequence[Sequence[str]] | None, most: int = 6) -> str:
    """Return a list of pairs of hex floats in decimal, cut after `most` pairs."""
    if pairs is None:
        return "none"
    shown = [f"[{decimal(a)}, {decimal(b)}]" for a, b in pairs[:most]]
    return "[" + ", ".join(shown + [ELLIPSIS] * (len(pairs) > most)) + "]"
