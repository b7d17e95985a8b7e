"""The certificate on a terminal: verdict, levels per solid type, the worst case of each family."""

from __future__ import annotations

from math import isinf
from typing import Any, Literal

from rich.console import Console
from rich.table import Table
from rich.text import Text

from oracle.judge import LEVELS

Json = dict[str, Any]
SHOWN = 8
"""How many failing rows are printed; the certificate has them all."""


def report(certificate: Json, console: Console, out: str | None) -> None:
    """Print a certificate for people."""
    console.print(_solids(certificate))
    console.print(_families(certificate, console.width))
    for line in _notes(certificate):
        console.print(line, highlight=False)
    _failures(certificate, console)
    console.print(_verdict(certificate))
    if out:
        console.print(f"certificate: {out}", highlight=False, soft_wrap=True)


def _table(title: str) -> Table:
    return Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)


def _solids(certificate: Json) -> Table:
    table = _table("Levels: yes and the rows passed, or no and the rows failed")
    for name in ("solid", *LEVELS, "convention"):
        table.add_column(name, no_wrap=name != "convention")
    for name, solid in certificate["solids"].items():
        cells = [_level(solid["levels"][level]) for level in LEVELS]
        table.add_row(name, *cells, solid["convention"])
    return table


def _level(tally: Json) -> Text:
    counted = tally["passed"] + tally["failed"]
    if tally["granted"]:
        return Text(f"yes {counted}", "green")
    if not counted:
        return Text("no row", "yellow")
    return Text(f"no {tally['failed']}/{counted}", "red")


def _families(certificate: Json, width: int) -> Table:
    table = _table("\nWorst answers (k: backward error, strict and squared; ulps: forward error)")
    for name, justify in COLUMNS.items():
        table.add_column(name, justify=justify, no_wrap=True)
    names = [family["family"] for family in certificate["families"]]
    room = max(width - max(map(len, names), default=0) - 46, 0)
    last = ""
    for family in certificate["families"]:
        if family["solid"] != last:
            last = family["solid"]
            table.add_row(Text(last, "bold"))
        worst = family["worst"]
        table.add_row(
            "  " + family["family"],
            str(family["rows"]),
            *(number(worst[key]) for key in ("strict_k", "squared_k", "ulps")),
            _fails(family["levels"]),
            Text(_cut(worst["id"].partition("/")[2], room), "dim"),
        )
    return table


COLUMNS: dict[str, Literal["left", "right"]] = {
    "family": "left",
    "rows": "right",
    "k": "right",
    "k sq.": "right",
    "ulps": "right",
    "fails": "left",
    "row": "left",
}


def _cut(text: str, room: int) -> str:
    return text if len(text) <= room else text[: max(room - 1, 0)] + "\u2026" if room > 8 else ""


def number(x: float | None) -> str:
    """Return a measured error in at most seven characters."""
    if x is None or isinf(x):
        return "inf"
    return f"{x:.3g}" if x < 1e5 else f"{x:.0e}"


def _fails(levels: Json) -> Text:
    for level in LEVELS:
        if failed := levels[level]["failed"]:
            return Text(f"{level} {failed}", "red" if level in ("sound", "stable") else "yellow")
    return Text("-", "green")


def _notes(certificate: Json) -> list[str]:
    notes = [""]
    left = certificate["not_tested"]
    if left["solids"]:
        notes.append(f"not tested: {', '.join(left['solids'])} (no rows sent)")
    for level, ids in certificate["not_decisive"].items():
        if ids["rows"]:
            wrong = f", {len(ids['outside'])} of them answered wrong" if ids["outside"] else ""
            notes.append(f"{level}: {len(ids['rows'])} rows do not decide{wrong}; not counted")
    for name, solid in certificate["solids"].items():
        window = solid["windows"]["stable"]
        spans = [f"{what} {_span(*w)}" for what, w in window.items() if w]
        if spans:
            notes.append(f"{name}: stable for {' and '.join(spans)}")
    run = certificate["run"]
    if run["restarts"]:
        notes.append(f"the target was restarted {run['restarts']} times")
    return notes + [f"note: {note}" for note in run["notes"]]


def _span(low: int, high: int) -> str:
    ends = ([f"down to 2^{low}"] if low < 0 else []) + ([f"up to 2^{high}"] if high > 0 else [])
    return " and ".join(ends) or "of usual size only"


def _failures(certificate: Json, console: Console) -> None:
    level = certificate["asked"]["level"]
    failing = [f for f in certificate["failures"] if level in f["faults"] and f["tier"] != "range"]
    for failed in failing[:SHOWN]:
        console.print(Text(f"\n{failed['id']}", "bold red"), highlight=False)
        console.print(f"  {failed['why']}", highlight=False)
        console.print(f"  {level}: {failed['faults'][level]}", highlight=False)
        console.print(f"  answer   {_pairs(failed['answer'])}", highlight=False)
        console.print(f"  expected {_pairs(failed['expected'])}", highlight=False)
        console.print(f"  repeat   {failed['reproduce']}", highlight=False, soft_wrap=True)
    if len(failing) > SHOWN:
        console.print(f"\nand {len(failing) - SHOWN} more rows, all in the certificate")


def _pairs(pairs: list[list[str]] | None) -> str:
    if pairs is None:
        return "none"
    return "[" + ", ".join(f"[{_decimal(a)}, {_decimal(b)}]" for a, b in pairs) + "]"


def _decimal(text: str) -> str:
    return repr(float.fromhex(text))


def _verdict(certificate: Json) -> Text:
    asked, subject = certificate["asked"], certificate["subject"]["name"]
    tested = {solid["convention"] for solid in certificate["solids"].values()} - {"not tested"}
    what = f"{asked['level']} and {asked['convention'] if tested else '(convention not tested)'}"
    if tolerance := certificate["subject"]["tolerance"]:
        what += f", faces moved by a tolerance of {tolerance:g},"
    if certificate["run"]["interrupted"]:
        what += " (interrupted)"
    rows = f"{certificate['tested']} rows of corpus {certificate['corpus']['version']}"
    if certificate["granted"]:
        return Text(f"\n{subject} is granted {what}: {rows}", "bold green")
    if certificate["passed"]:
        return Text(f"\n{subject} passes {what} on a part: {rows}; not a certificate", "bold")
    lines = "".join(f"\n  {reason}" for reason in certificate["reasons"])
    return Text(f"\n{subject} is not granted {what}:{lines}", "bold red")
