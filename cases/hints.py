"""What a message says to do: which name was meant, which package to install."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

DISTRIBUTIONS = {"PIL": "pillow"}
"""Modules whose distribution has another name."""


def near(value: str, names: Iterable[str], most: int = 3) -> str:
    """Return "did you mean a or b?" of the names that come near a value, or nothing."""
    known = sorted(set(names))
    found = get_close_matches(value, known, n=most, cutoff=0.6)
    found += [name for name in known if value and value in name and name not in found]
    return f"did you mean {' or '.join(found[:most])}?" if found else ""


def lacking(what: str, extra: str, *modules: str) -> str:
    """Return what to type where `what` lacks modules of an extra of raycert.

    It holds for an environment of one's own, a checkout in it or not, and for tools that make one.
    """
    names = [DISTRIBUTIONS.get(module, module) for module in modules]
    with_each = " ".join(f"--with {name}" for name in names)
    return (
        f'{what} needs {", ".join(names)}: pip install "raycert[{extra}]" '
        f"(uvx: uvx {with_each} ...; pipx: pipx inject raycert {' '.join(names)})"
    )
