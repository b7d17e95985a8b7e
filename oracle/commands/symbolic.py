"""`raycert explain --symbolic`: the proofs that the formulas are right, in the seed's order."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

    from raycert.oracle.witness.proofs import Statement

MARGIN, INDENT = 2, 4
OUTCOMES = {True: ("proved", "green"), False: ("NOT PROVED", "bold red")}


def proofs() -> list[Statement]:
    """Return every statement, proved now. Stops, naming what to install, without SymPy."""
    from raycert.oracle.witness.testimony import Missing, load

    try:
        load("symbols")
    except Missing as missing:
        click.echo(f"raycert: {missing}", err=True)
        raise SystemExit(3) from None
    from rich.console import Console

    from raycert.oracle.witness.proofs import derivation

    with Console(stderr=True).status("proving with SymPy"):
        return derivation()


def to_json(statements: list[Statement]) -> list[dict[str, Any]]:
    """Return the statements as data."""
    return [{"title": s.title, "text": s.text, "proved": s.proved} for s in statements]


def show_proofs(statements: list[Statement], console: Console) -> None:
    """Print what the names mean, and each statement below its title."""
    from raycert.oracle.explain.text import put

    put(console, _lines(statements, console.width))


def _lines(statements: list[Statement], width: int) -> Iterator[Text]:
    from rich.text import Text

    from raycert.oracle.witness.proofs import LEGEND

    yield Text("Symbols", "bold")
    for line in LEGEND:
        yield from _wrapped(line, width, MARGIN)
    heading = ""
    for statement in statements:
        if (found := _heading(statement.title)) not in ("", heading):
            heading = found
            yield Text()
            yield Text(heading, "bold")
        word, style = OUTCOMES[statement.proved]
        title = Text(" " * MARGIN + statement.title, "cyan")
        title.pad_right(max(width - len(word) - len(title), 2))
        yield title.append(word, style)
        yield from _wrapped(unbroken(statement.text), width, INDENT)
    yield Text()
    count = sum(statement.proved for statement in statements)
    yield Text(f"{count} of {len(statements)} statements proved by SymPy", "bold")


def _heading(title: str) -> str:
    """Return the part of the argument that a title opens; none if it goes on in the same."""
    if title.endswith(("complete", "exclusive")):
        return "The case tables"
    if "sphere" in title:
        return "Sphere"
    if title[0].isdigit():
        return f"Problem {title[0]}"
    return "" if title.startswith("the oracle") else "Identity"


def unbroken(text: str) -> str:
    """Return an equation so that it breaks only before =, + and -; words break at every blank."""
    if text.startswith(("one of ", "no two ")):
        return text
    return re.sub(r" (?![-+=] )", "\N{NO-BREAK SPACE}", text)


def _wrapped(text: str, width: int, indent: int) -> Iterator[Text]:
    """Yield a text in lines, those after the first indented by two more."""
    from rich.text import Text

    first, later = " " * indent, " " * (indent + 2)
    for line in textwrap.wrap(text, width, initial_indent=first, subsequent_indent=later):
        yield Text(line.replace("\N{NO-BREAK SPACE}", " "))
