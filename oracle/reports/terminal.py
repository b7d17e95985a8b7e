"""The certificate on a terminal, within a screen: verdict, levels, likely faults, cases to try.

What a run found comes in the order of its use, each failure with inputs to paste and the command
that explains it. The worst answer of each family, windows and the like are for `verbose`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from textwrap import wrap

from rich.console import Console
from rich.table import Table
from rich.text import Text

from raycert.cases.levels import LEVELS
from raycert.oracle.reports import findings, inputs, reading
from raycert.oracle.reports.findings import KindOfFailure, spaced
from raycert.oracle.reports.foreign import legible
from raycert.oracle.reports.reading import Json, count, number

SCREEN = 58
"""Lines of a report, as long as there are no more types of solids and commands than usual."""
REASONS, CAUSES, NOTES = 5, 3, 3
"""How many of each are shown; the certificate has them all."""
STYLES = {
    "granted": "bold green",
    "part": "bold",
    "accepted": "bold yellow",
    "refused": "bold red",
    "interrupted": "bold red",
}


def report(certificate: Json, console: Console, verbose: bool = False) -> None:
    """Print a certificate for people. What a client said is printed as text, never as markup."""
    certificate, width = legible(certificate), console.width
    if verbose:
        console.print(_families(certificate, width))
    lines = [
        *_verdict(certificate, width),
        Text(),
        *_levels(certificate, width),
        *_beside(certificate, width, verbose),
        *_likely(certificate, width),
        *_easy(certificate, width),
    ]
    room = SCREEN - sum(_height(line, width) for line in lines)
    for line in (*lines, *_failures(certificate, width, room)):
        console.print(line, soft_wrap=True)


def _height(line: Text, width: int) -> int:
    return sum(max(-(-len(part) // width), 1) for part in line.plain.split("\n"))


def _wrapped(text: str, width: int, indent: int = 0, style: str = "") -> list[Text]:
    """Return a sentence in lines, those after the first indented more; no word is cut."""
    first, rest = " " * indent, " " * (indent + 2)
    lines = wrap(
        text,
        width,
        initial_indent=first,
        subsequent_indent=rest,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [Text(line, style) for line in lines]


def _some(texts: Iterable[str], most: int, width: int, indent: int, style: str = "") -> list[Text]:
    """Return the lines of the first sentences, and how many there are more."""
    found = list(texts)
    lines = [line for text in found[:most] for line in _wrapped(text, width, indent, style)]
    more = f"and {len(found) - most} more, all in the certificate"
    return lines + ([Text(" " * indent + more)] if len(found) > most else [])


def _verdict(certificate: Json, width: int) -> list[Text]:
    found, corpus = reading.verdict(certificate), certificate["corpus"]
    style = STYLES[found.state]
    rows = f"{count(certificate['tested'], 'row')} of corpus {corpus['version']}"
    said = f"{reading.subject(certificate)} {found.headline}: {rows}, {corpus['precision']}"
    own = tuple(f"{solid}: " for solid in certificate["solids"])
    general = [reason for reason in found.reasons if not reason.startswith(own)]
    return [*_wrapped(said, width, 0, style), *_some(general, REASONS, width, 2, style)]


# Levels.


def _levels(certificate: Json, width: int) -> Iterator[Text]:
    """Yield the table of the levels, under each type of solid its domain where a level fails."""
    asked = certificate["asked"]["level"]
    yield Text(f"Levels: one run grades all, the exit status is for {asked}", "bold")
    heads = ("", *LEVELS, "convention")
    rows = [_cells(name, solid) for name, solid in certificate["solids"].items()]
    wide = [max(map(len, column)) for column in zip(heads, *rows, strict=True)][:-1]
    yield _row(heads, [""] * 6, wide, width)
    for cells, (name, solid) in zip(rows, certificate["solids"].items(), strict=True):
        styles = ["", *(_style(solid["levels"][level]) for level in LEVELS), ""]
        yield _row(cells, styles, wide, width)
        for line in _below(certificate, name):
            yield from _wrapped(line, width, 2, "dim")
    if left := certificate["not_tested"]["solids"]:
        yield from _wrapped(f"not tested: {', '.join(map(spaced, left))}", width)


def _cells(name: str, solid: Json) -> tuple[str, ...]:
    return (spaced(name), *(_cell(solid["levels"][level]) for level in LEVELS), solid["convention"])


def _cell(tally: Json) -> str:
    counted = tally["passed"] + tally["failed"]
    if tally["granted"]:
        return f"yes {counted}"
    return f"no {tally['failed']}/{counted}" if counted else "no row"


def _style(tally: Json) -> str:
    return {"failed": "red", "passed": "green", "open": "yellow"}[reading.mark(tally)]


def _row(cells: Iterable[str], styles: list[str], wide: list[int], width: int) -> Text:
    """Return a line of the table, its last cell as far as there is room for it."""
    *first, last = cells
    line = Text()
    for cell, style, room in zip(first, styles, wide, strict=False):
        line.append(f"{cell:<{room}}  ", style)
    return line.append(last if len(line) + len(last) <= width else last.partition(":")[0])


def _below(certificate: Json, name: str) -> list[str]:
    """Return what is said of a type of solid below its levels."""
    level, solid = certificate["asked"]["level"], certificate["solids"][name]
    refused, failed = solid["levels"][level]["refused"], solid["levels"][level]["failed"]
    lines = findings.measured(certificate, name)
    if refused:
        said = f"{'all' if refused == failed else refused} of {failed} are refused"
        lines[-1:] = [f"{line}; {said}" for line in lines[-1:]] or [said]
    return lines


# What is beside the levels.


def _beside(certificate: Json, width: int, verbose: bool) -> list[Text]:
    notes = [f"note: {line}" for line in reading.notes(certificate)]
    left = [*reading.left_out(certificate), *reading.windows(certificate)]
    lines = _some(reading.apart(certificate, together=True), 4, width, 0)
    lines += _some(left, len(left), width, 0) if verbose else []
    return lines + _some(notes, NOTES, width, 0)


def _likely(certificate: Json, width: int) -> list[Text]:
    found = [str(cause) for cause in findings.causes(certificate, lowest=True)]
    if not found:
        return []
    left = findings.unexplained(certificate, lowest=True)
    return [
        Text("\nLikely faults", "bold"),
        *_some(found, CAUSES, width, 2),
        *(_wrapped(left, width, 2) if left else []),
    ]


def _easy(certificate: Json, width: int) -> list[Text]:
    found = list(findings.easy(certificate))
    lines = [Text("\nEasy cases", "bold")] if found else []
    for said, first in found[:1]:
        lines += _wrapped(said, width, 2)
        lines += _case(first, str(first["answer"]), str(first["expected"]), width)
    rest = "; ".join(said for said, _ in found[1:])
    return lines + (_wrapped(rest, width, 2) if rest else [])


def _case(case: Json, answer: str, expected: str, width: int) -> list[Text]:
    """Return the lines of a case: code for its inputs, and the answers."""
    code = [Text(f"    {line}", "cyan") for line in inputs.assignments(case, width - 4)]
    answers = f"answer {answer}, expected {expected}"
    lines = inputs.at_commas(answers, width - 4) if len(answers) > width - 4 else [answers]
    return code + [Text(f"    {line}") for line in lines]


# Failures.


def _failures(certificate: Json, width: int, room: int) -> Iterator[Text]:
    """Yield one failure of each kind, at least the first in full, and others as far as they fit."""
    found, total = findings.kinds(certificate), len(reading.failing(certificate))
    if not found:
        return
    yield Text(
        f"\n{count(total, 'failing row')}, one of each kind, the simplest numbers first", "bold"
    )
    again = Text(f"  ask the first again: {found[0].first['reproduce']}")
    room -= 2 + _height(again, width)
    for i, kind in enumerate(found):
        lines = _failure(certificate, kind, width)
        tall, left = sum(_height(line, width) for line in lines), len(found) - i - 1
        if i and tall + left > room:
            lines = [Text(f"  {_named(kind)}: ").append(kind.first["explain"], "bold")]
            tall = _height(lines[0], width)
        yield from lines
        room -= tall
    yield again


def _named(kind: KindOfFailure) -> str:
    return f"{kind.name}, {count(kind.rows, 'row')}"


def _failure(certificate: Json, kind: KindOfFailure, width: int) -> list[Text]:
    failed = kind.first
    why, fault, *_ = reading.facts(certificate, failed)
    quiet = failed["answer"] is None and failed["reply"] is None
    title = _wrapped(f"{_named(kind)}: {why}", width, 2)
    title[0].stylize("bold red", 0, len(_named(kind)) + 3)
    expected = inputs.intervals(failed["expected"])
    return [
        *title,
        *_case(failed, inputs.said(failed), expected, width),
        *(_wrapped(fault, width, 4) if quiet else []),
        Text(f"    {failed['explain']}", "bold"),
    ]


# The worst answer of each family.


def _families(certificate: Json, width: int) -> Table:
    title = "Worst answers (k: backward error, strict and squared; ulps: forward error)"
    table = Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)
    for name in ("family", "rows", "k", "k sq.", "ulps", "fails", "row"):
        right = name in ("rows", "k", "k sq.", "ulps")
        table.add_column(name, justify="right" if right else "left", no_wrap=True)
    names = [family["family"] for family in certificate["families"]]
    room = max(width - max(map(len, names), default=0) - 46, 0)
    last = ""
    for family in certificate["families"]:
        if family["solid"] != last:
            last = family["solid"]
            table.add_row(Text(last, "bold"))
        worst = family["worst"]
        table.add_row(
            Text("  " + family["family"]),
            str(family["rows"]),
            *(number(worst[key]) for key in ("strict_k", "squared_k", "ulps")),
            _fails(family["levels"]),
            Text(_cut(worst["id"].partition("/")[2], room), "dim"),
        )
    return table


def _cut(text: str, room: int) -> str:
    return text if len(text) <= room else text[: max(room - 1, 0)] + "\u2026" if room > 8 else ""


def _fails(levels: Json) -> Text:
    for level in LEVELS:
        if failed := levels[level]["failed"]:
            return Text(f"{level} {failed}", "red" if level in ("sound", "stable") else "yellow")
    return Text("-", "green")
