"""The terminal as tables and colours reach it: no text on it is an escape, and none is mark-up."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.console import Console, ConsoleOptions, ConsoleRenderable, RenderHook
from rich.segment import Segment

from raycert.oracle.reports.foreign import escaped


def screen(**settings: Any) -> Console:
    """Return a console of rich that prints what it is given: as text, never as mark-up."""
    console = Console(markup=False, emoji=False, highlight=False, **settings)
    console.push_render_hook(_Escaping())
    return console


class _Escaping(RenderHook):
    def process_renderables(self, renderables: list[ConsoleRenderable]) -> list[ConsoleRenderable]:
        return [_Escaped(shown) for shown in renderables]


class _Escaped:
    """Something to print, its styles as they are and its text escaped."""

    def __init__(self, shown: ConsoleRenderable):
        self.shown = shown

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Segment]:
        for text, style, control in console.render(self.shown, options):
            yield Segment(text if control else escaped(text), style, control)
