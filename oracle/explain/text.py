"""A derivation on the terminal: aligned, coloured where colours are, as wide as the screen.

Lines are laid out here and printed as they are, so nothing is cut and no line ends in blanks.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator

from rich.console import Console
from rich.text import Text

from raycert.cases.formats import Format
from raycert.cases.model import Ray, Solid, Tree, Vector, type_of
from raycert.cases.row import GoldenRow
from raycert.oracle.explain.derive import Derivation
from raycert.oracle.explain.form import Cell, Fact, Note, Step, Table, shorten, shortest

NAME, ASIDE = "cyan", "bright_black"
LABELS = ("point", "normal", "center", "p", "q", "radius")
MARGIN = 2
ALIGNED = 25
"""Values up to this long make a column; what stands beside longer ones just follows."""
Field = tuple[str, str]
"""A text and its style."""


def show(derivation: Derivation, console: Console, full: bool) -> None:
    """Print a derivation; long integers in full, and then on lines of any length, if asked to."""
    width = 10**9 if full else console.width
    lines = list(case_lines(derivation.row, derivation.format, width))
    for step in derivation.steps:
        lines += [Text(), Text(step.heading, "bold"), *step_lines(step, width, full)]
    put(console, lines)


def put(console: Console, lines: Iterable[Text]) -> None:
    """Print lines as they are."""
    for line in lines:
        line.rstrip()
        console.print(line, soft_wrap=True, highlight=False)


def case_lines(row: GoldenRow, fmt: Format, width: int) -> Iterator[Text]:
    """Yield what is asked: the case by name if it has one, its solid and its ray."""
    if row.why:
        flags = f", {' '.join(row.flags)}" if row.flags else ""
        yield Text(row.id, "bold")
        yield Text(row.why)
        yield Text(f"{row.tier}, {fmt.name}, source {row.source}{flags}", ASIDE)
        yield Text()
    named = [*_solid_fields(row.solid, "", fmt), ("ray", _ray(row.ray, fmt))]
    size = max(len(name) for name, _ in named)
    for name, fields in named:
        yield layout(name.ljust(size), [(text, "") for text in fields], width, 0)


def _ray(ray: Ray, fmt: Format) -> list[str]:
    return [f"u {_vector(ray.origin, fmt)}", f"v {_vector(ray.direction, fmt)}"]


def _solid_fields(solid: Solid, path: str, fmt: Format) -> Iterator[tuple[str, list[str]]]:
    words = [type_of(solid)]
    for name in LABELS:
        value = getattr(solid, name, None)
        if value is not None:
            number = _vector(value, fmt) if isinstance(value, tuple) else shortest(value, fmt)
            words.append(f"{name} {number}")
    yield path or "solid", words
    if isinstance(solid, Tree):
        for i, part in enumerate(solid.of):
            yield from _solid_fields(part, f"{path}.of[{i}]" if path else f"of[{i}]", fmt)


def _vector(v: Vector, fmt: Format) -> str:
    return f"({', '.join(shortest(x, fmt) for x in v)})"


def step_lines(step: Step, width: int, full: bool) -> Iterator[Text]:
    """Yield the lines of a step; its facts share their columns."""
    facts = [line for line in step.lines if isinstance(line, Fact)]
    names = max((len(fact.name) for fact in facts), default=0)
    signs = any(fact.sign for fact in facts)
    beside = [f for f in facts if f.about] or [f for f in facts if f.note]
    mains = [len(_main(fact, full)) for fact in beside]
    column = max((size for size in mains if size <= ALIGNED), default=0)
    for line in step.lines:
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
    """Yield one of the seed's tables: each condition with yes or no, the row taken marked."""
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


def _cell(cell: Cell | None) -> str:
    if cell is None:
        return ""
    word = {None: "", True: "yes", False: "no"}[cell.holds]
    return f"{cell.relation:>4} {word}"
