"""The certificate on a terminal: verdict, levels per solid type, the worst case of each family."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table
from rich.text import Text

from raycert.cases.levels import LEVELS
from raycert.oracle.reports import reading
from raycert.oracle.reports.foreign import legible
from raycert.oracle.reports.reading import Json, number

SHOWN = 8
"""How many failing rows are printed; the certificate has them all."""
STYLES = {
    "granted": "bold green",
    "part": "bold",
    "accepted": "bold yellow",
    "refused": "bold red",
    "interrupted": "bold red",
}


def report(certificate: Json, console: Console) -> None:
    """Print a certificate for people. What a client said is printed as text, never as markup."""
    certificate = legible(certificate)
    console.print(_solids(certificate))
    console.print(_families(certificate, console.width))
    likely = [f"likely fault: {line}" for line in reading.likely(certificate)]
    for line in ("", *reading.beside(certificate, "note: "), *likely):
        console.print(Text(line))
    _failures(certificate, console)
    console.print(_verdict(certificate))


def _table(title: str) -> Table:
    return Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)


def _solids(certificate: Json) -> Table:
    table = _table("Levels: yes and the rows passed, or no and the rows failed")
    for name in ("solid", *LEVELS, "convention"):
        table.add_column(name, no_wrap=name != "convention")
    for name, solid in certificate["solids"].items():
        cells = [_level(solid["levels"][level]) for level in LEVELS]
        table.add_row(Text(name), *cells, Text(solid["convention"]))
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


def _failures(certificate: Json, console: Console) -> None:
    found, level = reading.failing(certificate), reading.level_asked(certificate)
    for failed in found[:SHOWN]:
        why, fault, *rest, repeat = reading.facts(certificate, failed)
        console.print(Text(f"\n{failed['id']}", "bold red"))
        for line in (why, f"{level}: {fault}", *rest):
            console.print(Text(f"  {line}"))
        console.print(Text(f"  {repeat}"), soft_wrap=True)
    if len(found) > SHOWN:
        console.print(f"\nand {len(found) - SHOWN} more rows, all in the certificate")


def _verdict(certificate: Json) -> Text:
    found = reading.verdict(certificate)
    rows = f": {certificate['tested']} rows of corpus {certificate['corpus']['version']}"
    reasons = "".join(f"\n  {reason}" for reason in found.reasons)
    return Text(
        f"\n{reading.subject(certificate)} {found.headline}{rows}{reasons}", STYLES[found.state]
    )
