"""Pages that need nothing else: no network, no script, no font.

A template escapes all text. Only the style sheets and the drawings, whose text their library
escapes, go in as they are; what others said is cleaned by the caller besides.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib.resources import files
from typing import Any


def render(
    name: str, styles: Sequence[str], filters: Mapping[str, Callable[..., Any]], **values: Any
) -> str:
    """Return the page that a template of this package makes of values and of style sheets."""
    from jinja2 import Environment, StrictUndefined

    here = files("raycert.oracle.reports")
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= filters
    style = "\n".join((here / sheet).read_text("utf-8").rstrip() for sheet in styles)
    template = environment.from_string((here / name).read_text("utf-8"))
    return template.render(style=style, **values)
