"""Derivations, golden rows and proofs on the terminal: aligned, coloured, as wide as the screen.

Lines are laid out here and printed as they are, so nothing is cut and no line ends in blanks.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from rich.console import Console
from rich.text import Text

from raycert.cases.formats import Format
from raycert.cases.model import FIELDS, Solid, Tree, Vector, type_of
from raycert.cases.row import GoldenRow
from raycert.oracle.explain.derive import Derivation, row_passages
from raycert.oracle.explain.wording import Demand, Fact, Note, Passage, Table, shorten, shortest

if TYPE_CHECKING:
    from raycert.oracle.witness.proofs import Statement

NAME, ASIDE = "cyan", "bright_black"
MARGIN, INDENT = 2, 4
OUTCOMES = {True: ("proved", "green"), False: ("NOT PROVED", "bold red")}
ALIGNED = 25
"""Values up to this long make a column; what stands beside longer ones just follows."""
Field = tuple[str, str]
"""A text and its style."""


def show(derivation: Derivation, console: Console, full: bool) -> None:
    """Print a derivation; long integers in full, and then on lines of any length, if asked to."""
    _put(console, _case(derivation.row, derivation.format, derivation.steps, console, full))


def show_rows(rows: Sequence[GoldenRow], fmt: Format, console: Console, full: bool) -> None:
    for i, row in enumerate(rows):
        if i:
            _put(console, (Text(), Text()))
        _put(console, _case(row, fmt, row_passages(row, fmt), console, full))


def show_proofs(statements: Sequence[Statement], console: Console) -> None:
    _put(console, proof_lines(statements, console.width))


def _put(console: Console, lines: Iterable[Text]) -> None:
    for line in lines:
        line.rstrip()
        console.print(line, soft_wrap=True, highlight=False)


def _case(
    row: GoldenRow, fmt: Format, passages: Iterable[Passage], console: Console, full: bool
) -> Iterator[Text]:
    width = 10**9 if full else console.width
    yield from case_lines(row, fmt, width)
    for passage in passages:
        yield from (Text(), Text(passage.heading, "bold"))
        yield from passage_lines(passage, width, full)


def case_lines(row: GoldenRow, fmt: Format, width: int) -> Iterator[Text]:
    if row.why:
        flags = f", {' '.join(row.flags)}" if row.flags else ""
        aside = f"{row.tier}, {fmt.name}, source {row.source}{flags}"
        yield from (Text(row.id, "bold"), Text(row.why), Text(aside, ASIDE), Text())
    ray = [f"u {_vector(row.ray.origin, fmt)}", f"v {_vector(row.ray.direction, fmt)}"]
    named = [*_solid_fields(row.solid, "", fmt), ("ray", ray)]
    size = max(len(name) for name, _ in named)
    for name, fields in named:
        yield layout(name.ljust(size), [(text, "") for text in fields], width, 0)


def _solid_fields(solid: Solid, path: str, fmt: Format) -> Iterator[tuple[str, list[str]]]:
    words = [type_of(solid)]
    for name in () if isinstance(solid, Tree) else FIELDS[type(solid)]:
        value = getattr(solid, name)
        number = _vector(value, fmt) if isinstance(value, tuple) else shortest(value, fmt)
        words.append(f"{name} {number}")
    yield path or "solid", words
    if isinstance(solid, Tree):
        for i, part in enumerate(solid.of):
            yield from _solid_fields(part, f"{path}.of[{i}]" if path else f"of[{i}]", fmt)


def _vector(v: Vector, fmt: Format) -> str:
    return f"({', '.join(shortest(x, fmt) for x in v)})"


def passage_lines(passage: Passage, width: int, full: bool) -> Iterator[Text]:
    facts = [line for line in passage.lines if isinstance(line, Fact)]
    names = max((len(fact.name) for fact in facts), default=0)
    signs = any(fact.sign for fact in facts)
    beside = [f for f in facts if f.about] or [f for f in facts if f.note]
    mains = [len(_main(fact, full)) for fact in beside]
    column = max((size for size in mains if size <= ALIGNED), default=0)
    for line in passage.lines:
        if isinstance(line, Fact):
            fields = list(_fields(line, full, signs, column))
            yield layout(line.name.ljust(names), fields, width, MARGIN)
        elif isinstance(line, Note):
            for part in textwrap.wrap(line.text, width - MARGIN):
                yield Text(" " * MARGIN + part)
        else:
            yield from table_lines(line, width)


def _main(fact: Fact, full: bool) -> str:
    return fact.about or (fact.value if full else shorten(fact.value))


def _fields(fact: Fact, full: bool, signs: bool, column: int) -> Iterator[Field]:
    if signs:
        yield fact.sign.ljust(3), ""
    yield _main(fact, full).ljust(column), ""
    if fact.note:
        yield fact.note, ASIDE
    if fact.about:
        yield "= " + (fact.value if full else shorten(fact.value)), ASIDE


def layout(name: str, fields: list[Field], width: int, margin: int) -> Text:
    """Return a name and its fields, two blanks apart; what does not fit goes below the first."""
    text = Text(" " * margin).append(name, NAME)
    indent = margin + len(name) + 2
    at = indent - 2
    for i, (field, style) in enumerate(fields):
        if i and at + 2 + len(field.rstrip()) > width:
            text.append("\n" + " " * (indent - 2))
            at = indent - 2
        parts = textwrap.wrap(field, max(width - at - 2, 20)) or [field]
        text.append("  ").append(f"\n{' ' * indent}".join(parts), style)
        if len(parts) == 1:
            text.append(" " * (len(field) - len(parts[0])))
            at += 2 + len(field)
        else:
            at = indent + len(parts[-1])
    return text


def table_lines(table: Table, width: int) -> Iterator[Text]:
    head = ["  row", *table.quantities, "emits"]
    here = ["  here", *(sign.rjust(4) for sign in table.signs), ""]
    body = [
        [("> " if row.taken else "  ") + row.name, *map(_cell, row.cells), row.pairs]
        for row in table.rows
    ]
    sizes = [max(len(line[i]) for line in (head, here, *body)) for i in range(len(head))]
    gap = 2 if MARGIN + sum(sizes) + 2 * len(sizes) <= width else 1

    def line(cells: list[str], style: str) -> Text:
        text = (" " * gap).join(cell.ljust(size) for cell, size in zip(cells, sizes, strict=True))
        return Text(" " * MARGIN + text, style)

    yield line(head, NAME)
    yield line(here, "")
    for row, cells in zip(table.rows, body, strict=True):
        yield line(cells, "bold green" if row.taken else ASIDE)


def _cell(cell: Demand | None) -> str:
    words = {None: "", True: "yes", False: "no"}
    return "" if cell is None else f"{cell.relation:>4} {words[cell.holds]}"


def proof_lines(statements: Sequence[Statement], width: int) -> Iterator[Text]:
    from raycert.oracle.witness.proofs import LEGEND  # needs SymPy

    yield Text("Symbols", "bold")
    for line in LEGEND:
        yield from _wrapped(line, width, MARGIN)
    heading = ""
    for statement in statements:
        if (opened := _heading(statement.title)) not in ("", heading):
            heading = opened
            yield from (Text(), Text(heading, "bold"))
        word, style = OUTCOMES[statement.proved]
        title = Text(" " * MARGIN + statement.title, "cyan")
        title.pad_right(max(width - len(word) - len(title), 2))
        yield title.append(word, style)
        yield from _wrapped(unbroken(statement.text), width, INDENT)
    count = sum(statement.proved for statement in statements)
    yield from (Text(), Text(f"{count} of {len(statements)} statements proved by SymPy", "bold"))


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
    first, later = " " * indent, " " * (indent + 2)
    for line in textwrap.wrap(text, width, initial_indent=first, subsequent_indent=later):
        yield Text(line.replace("\N{NO-BREAK SPACE}", " "))
