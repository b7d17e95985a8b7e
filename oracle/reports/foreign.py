r"""Text that others wrote, as it may be shown: clients, files and certificates are never believed.

escaped      lines in which what prints nothing, or turns the text around, is seen: `\x1b`
clean        one such line, of limited length, for a terminal, XML or a page
plain, code  one such line in Markdown: as text, or as code
legible      a JSON form whose every text is one such line
say, screen  the ways to a terminal; all that commands and reports print goes through them
"""

from __future__ import annotations

import unicodedata
from html import escape
from re import findall, match, sub
from typing import Any

import click

LONG, CODE = 300, 8000
"""Characters of a line, and of code, which is copied."""
MARKS = {"Mn", "Me"}
ELLIPSIS = "\u2026"


def escaped(text: str) -> str:
    """Return lines of text in which control, format and unassigned characters are escapes."""
    if text.isprintable():
        return text
    return "".join(char if char in "\n\t" else _visible(char) for char in text)


def _visible(char: str) -> str:
    if char.isprintable() or unicodedata.category(char) == "Zs":
        return char
    return char.encode("unicode_escape").decode()


def line(text: str) -> str:
    """Return text as one line that any terminal, XML or page can hold.

    White space becomes a space, what is hidden an escape, and of marks piled on a letter two are
    left.
    """
    if text.isascii() and text.isprintable():
        return text
    kept: list[str] = []
    piled = 0
    for char in text:
        piled = piled + 1 if unicodedata.category(char) in MARKS else 0
        if piled <= 2:
            kept.append(" " if char.isspace() else _visible(char))
    return "".join(kept)


def clean(text: str, most: int = LONG) -> str:
    """Return one line of at most `most` characters that any terminal, XML or page can hold.

    A number is cut off whole: of 2.46e+17 no 2.46 is left.
    """
    kept = line(text[: 4 * most])
    if len(text) <= 4 * most and len(kept) <= most:
        return kept
    short = kept[: most - 1]
    if match("[0-9a-fpx.+-]", kept[most - 1 :] or text[4 * most :]):
        short = sub(r"(?<![\w.+-])[-+]?[0-9.][\w.+-]{0,39}$", "", short)
    return short + ELLIPSIS


def plain(text: str) -> str:
    """Return text as Markdown text: no HTML, no mark-up and no cell of a table is read in it."""
    return sub(r"([\\`*_\[\]|~$])", r"\\\1", escape(clean(text)))


def code(text: str) -> str:
    """Return text as a code span: nothing in it is read as Markdown or HTML, nor ends a cell.

    A pipe in a table ends the cell even in code, so it is shown as its double-barred likeness.
    """
    shown = clean(text, CODE).replace("|", "\u00a6")
    fence = "`" * (max(map(len, findall("`+", shown)), default=0) + 1)
    pad = " " if shown.startswith("`") or shown.endswith("`") or not shown.strip() else ""
    return f"{fence}{pad}{shown}{pad}{fence}"


def legible(form: Any) -> Any:
    """Return a JSON form whose every text, of keys too, is one line that may be shown."""
    if isinstance(form, str):
        return line(form)
    if isinstance(form, dict):
        return {line(key): legible(value) for key, value in form.items()}
    return [legible(item) for item in form] if isinstance(form, list) else form


def say(text: str = "", err: bool = False, nl: bool = True, **style: Any) -> None:
    """Print lines on standard output, or on standard error."""
    click.secho(escaped(text), err=err, nl=nl, **style)
