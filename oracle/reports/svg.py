"""Drawings as SVG text: elements whose attributes and text are escaped by the library."""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree.ElementTree import Element, tostring

WIDTH, GUTTER = 480, 66
"""Width of a drawing, and of the column at its left that names the lines."""
PLOT = WIDTH - GUTTER
MIDDLE = GUTTER + PLOT / 2


def el(tag: str, *children: Element, text: str | None = None, **attributes: str | float) -> Element:
    """Return an element; `_` in the name of an attribute is `-`, and `kind` is its class."""
    names = {name: "class" if name == "kind" else name.replace("_", "-") for name in attributes}
    element = Element(tag, {names[name]: spelled(x) for name, x in attributes.items()})
    element.text = text
    element.extend(children)
    return element


def spelled(x: str | float) -> str:
    """Return an attribute's value; a number to a tenth of a pixel."""
    return x if isinstance(x, str) else f"{x:.1f}".removesuffix(".0")


def path(points: Iterable[tuple[float, float]], closed: bool = False) -> str:
    """Return the data of a path through points."""
    steps = " ".join(f"{spelled(x)},{spelled(y)}" for x, y in points)
    return f"M{steps}{'Z' if closed else ''}"


def drawing(height: float, title: str, *children: Element) -> str:
    """Return a drawing of the common width, as text for a page; `title` is read aloud."""
    box = f"0 0 {WIDTH} {spelled(height)}"
    named = el("title", text=title)
    return tostring(el("svg", named, *children, viewBox=box, role="img"), encoding="unicode")


def label(x: float, y: float, text: str, kind: str = "label", anchor: str = "start") -> Element:
    """Return a line of text."""
    return el("text", text=text, x=x, y=y, kind=kind, text_anchor=anchor)
