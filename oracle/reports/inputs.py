"""The numbers of a case as a person takes them along: in decimal, as code, and in hex.

Decimals are the shortest that round-trip. A solid or a ray in them is an object of JSON, and as
well one of Python. Nothing is cut: lines are broken after commas.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from raycert.oracle.reports.foreign import ELLIPSIS

Json = dict[str, Any]
PARTS = ("solid", "ray")
"""The parts of a case."""


def decimal(text: str) -> str:
    """Return a hex float in decimal, the shortest that round-trips."""
    return repr(float.fromhex(text))


def decimals(form: Any) -> Any:
    """Return a form of hex floats with the numbers themselves; what is no number stays."""
    if isinstance(form, dict):
        return {name: value if name == "type" else decimals(value) for name, value in form.items()}
    if isinstance(form, list):
        return [decimals(item) for item in form]
    try:
        return float.fromhex(form) if isinstance(form, str) else form
    except (ValueError, OverflowError):
        return form


def written(form: Any) -> str:
    """Return a solid or a ray in decimal, on one line.

    >>> written({"type": "sphere", "center": ["0x0.0p+0", "0x1.0p+1", "-0x1.0p-2"]})
    '{"type": "sphere", "center": [0.0, 2.0, -0.25]}'
    """
    return json.dumps(decimals(form))


def case_json(case: Json, hexed: bool = False) -> str:
    """Return solid and ray of a case as the object that `raycert explain` and others read."""
    parts = {part: case[part] for part in PARTS}
    return json.dumps(parts if hexed else decimals(parts))


def at_commas(text: str, width: int, hang: int = 4) -> list[str]:
    """Return text in lines that are broken after commas alone, those after the first indented.

    >>> at_commas("[1.5, 2.5, 3.5]", 11)
    ['[1.5, 2.5,', '    3.5]']
    """
    lines = [""]
    for i, part in enumerate(text.split(", ")):
        part = f"{part}, " if i < text.count(", ") else part
        if lines[-1].strip() and len(lines[-1] + part.rstrip()) > width:
            lines.append(" " * hang)
        lines[-1] += part
    return [line.rstrip() for line in lines]


def assignments(case: Json, width: int) -> list[str]:
    """Return the lines of code that name the solid and the ray of a case."""
    return [line for part in PARTS for line in at_commas(f"{part} = {written(case[part])}", width)]


def length(case: Json) -> int:
    """Return how much there is to read in a case: the characters of its numbers in decimal."""
    return sum(len(written(case[part])) for part in PARTS)


def intervals(pairs: Sequence[Sequence[str]] | None, most: int = 6) -> str:
    """Return a list of pairs of hex floats in decimal, cut after `most` pairs."""
    if pairs is None:
        return "none"
    shown = [f"[{decimal(a)}, {decimal(b)}]" for a, b in pairs[:most]]
    return "[" + ", ".join(shown + [ELLIPSIS] * (len(pairs) > most)) + "]"


def said(shown: Json) -> str:
    """Return what was answered to a row, in decimal."""
    reply = shown["reply"]
    if reply is None:
        return intervals(shown["answer"])
    if "hit" in reply:
        return f"hit: {str(reply['hit']).lower()}"
    return f"first: {'null' if reply['first'] is None else decimal(reply['first'])}"
