"""`raycert list` and `raycert show`: find golden rows, and read them."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Collection, Iterable
from pathlib import Path
from shutil import get_terminal_size
from textwrap import wrap
from typing import Any

import click

from raycert.cases.corpus import Corpus, encode_rows
from raycert.cases.flags import FLAGS
from raycert.cases.levels import LEVELS, TIERS
from raycert.cases.model import SOLIDS, type_of
from raycert.cases.protocol import TOUCHES
from raycert.cases.row import GoldenRow
from raycert.cases.table import HALF_SPACE, PROBLEM_1, PROBLEM_2, PROBLEM_3
from raycert.oracle.commands.options import (
    OneOf,
    family_option,
    find,
    golden_option,
    json_option,
    precision_option,
    read,
    repeatable,
    solid_option,
    statuses,
    tier_option,
    unknown,
    write_out,
)
from raycert.oracle.reports.foreign import say
from raycert.oracle.reports.screen import screen

FIELDS = ("family", "tier", "flag", "row", "solid", "source", "touch", "decisive")

LIST_EPILOG = f"""\b
Examples:
  raycert list --families                        what is tested, and why
  raycert list --row through --row BG --row m=n   one cell of the case table
  raycert list --flag tangent --touch rim
  raycert list --not-decisive stable --count
  raycert list --count tier --family tilt

\b
Rows of the case tables (cases/README.md):
  Problem 1   along-inside along-outside miss behind from-inside through
  Problem 2   AE BE AF AH BG DE CF; of one plane A B C D
  Problem 3   neither no-1 no-2 apart meet, and a>c a=c a<c b>d ... m<n m=n m>n

{statuses()}
"""
SHOW_EPILOG = f"""\b
Examples:
  raycert show behind/across-just-past
  raycert show behind/across-just-past --json - | jq .accept
  raycert explain behind/across-just-past            the same case, derived

{statuses()}
"""


@click.command(name="list", epilog=LIST_EPILOG)
@family_option
@tier_option
@repeatable("--flag", "flags", "With this flag, and all others given")
@repeatable("--row", "rows", "Taking this table row, and all others given")
@solid_option
@click.option("--source", help="With this text in the source, such as geant4.")
@click.option("--touch", help="With a touch of this kind: tangent, wall, cap, rim, start.")
@click.option("--not-decisive", type=OneOf(LEVELS), help="Not decisive for this level.")
@click.option(
    "--count",
    is_flag=False,
    flag_value="family",
    type=OneOf(FIELDS),
    help="Count the rows by a field (family if none is named) instead of listing them.",
)
@click.option("--families", "reasons", is_flag=True, help="List the families and their reasons.")
@click.option("--flags", "legend", is_flag=True, help="Print the legend of the flags.")
@precision_option
@golden_option
def list_cases(precision: str, golden: Path | None, **options: Any) -> None:
    """List golden rows: id, tier and reason, one a line; tabs between them when piped."""
    if options["legend"]:
        _print_legend()
        return
    chosen = select(read(precision, golden), **options)
    if options["reasons"]:
        _print_families(chosen)
    elif options["count"]:
        _print_counts(chosen, options["count"])
    else:
        _print_rows(chosen)
    if not chosen:
        say("no row is such", err=True)


def values(row: GoldenRow, field: str) -> tuple[str, ...]:
    match field:
        case "flag":
            return row.flags
        case "row":
            return tuple(dict.fromkeys(name.rpartition(":")[2] for name in row.rows))
        case "solid":
            return (type_of(row.solid),)
        case "touch":
            return tuple(dict.fromkeys(span.touch or "none" for span in row.intervals))
        case "decisive":
            return row.decisive
    return (str(getattr(row, field)),)


def select(corpus: Corpus, **options: Any) -> list[GoldenRow]:
    """Return the rows that have what the options name; none of an option is no restriction.

    Of `families`, `tiers` and `solids` a row has any, of `flags` and `rows` all. Ends the command
    at a name that no row of any corpus has.
    """
    tables = (*PROBLEM_1, *PROBLEM_2, *PROBLEM_3, *HALF_SPACE)
    signs = {f"{pair[0]}{s}{pair[1]}" for pair in ("ac", "bd", "mn") for s in "<=>"}
    touches = (options["touch"],) if options.get("touch") else ()
    known: dict[str, tuple[Collection[str], Iterable[str]]] = {
        "family": (options.get("families", ()), {row.family for row in corpus.rows}),
        "tier": (options.get("tiers", ()), TIERS),
        "solid": (options.get("solids", ()), SOLIDS),
        "flag": (options.get("flags", ()), FLAGS),
        "row": (options.get("rows", ()), {row.name for row in tables} | signs),
        "touch": (touches, (*TOUCHES, "none")),
    }
    for field, (given, names) in known.items():
        for name in given:
            if name not in names:
                unknown(field, name, names)
    wanted = {field: set(given) for field, (given, _) in known.items() if given}
    source, level = (options.get("source") or "").lower(), options.get("not_decisive")

    def has(row: GoldenRow, field: str, names: set[str]) -> bool:
        own = set(values(row, field))
        return names <= own if field in ("flag", "row") else bool(names & own)

    return [
        row
        for row in corpus.rows
        if all(has(row, *item) for item in wanted.items())
        and source in row.source.lower()
        and level not in row.decisive
    ]


def _screen() -> int | None:
    return get_terminal_size().columns if sys.stdout.isatty() else None


def _print_rows(rows: list[GoldenRow]) -> None:
    width = _screen()
    size = min(max((len(row.id) for row in rows), default=0), 48)
    for row in rows:
        if width is None:
            say(f"{row.id}\t{row.tier}\t{row.why}")
        else:
            line = f"{row.id:{size}}  {row.tier:7}  {row.why}"
            say(line if len(line) <= width else line[: width - 3] + "...")
    if width is not None:
        say(f"{len(rows)} rows; one in full: raycert show ID", err=True)


def _print_counts(rows: list[GoldenRow], field: str) -> None:
    counts = Counter(value for row in rows for value in values(row, field))
    size = max((len(name) for name in counts), default=0)
    for name, count in sorted(counts.items(), key=lambda item: (-item[1], item[0])):
        say(f"{name:{size}}  {count:6}")
    say(f"{'rows':{size}}  {len(rows):6}")


def _print_families(rows: list[GoldenRow]) -> None:
    from raycert.cases.families.catalog import FAMILIES

    reasons = {family.name: family.reason for family in FAMILIES}
    width = _screen()
    for name in dict.fromkeys(row.family for row in rows):
        tiers = Counter[str](row.tier for row in rows if row.family == name)
        counts = ", ".join(f"{tiers[tier]} {tier}" for tier in TIERS if tiers[tier])
        reason = reasons.get(name, "")
        if width is None:
            say(f"{name}\t{counts}\t{reason}")
            continue
        say(name, nl=False, bold=True)
        say(f"  {counts}")
        for line in wrap(reason, width - 4):
            say(f"    {line}")


def _print_legend() -> None:
    width = _screen() or 100
    for flag in FLAGS.values():
        say(flag.name, bold=True)
        about = [line for text in (flag.trouble, flag.effect) for line in wrap(text, width - 4)]
        for line in (*about, *flag.references):
            say(f"    {line}")


@click.command(epilog=SHOW_EPILOG)
@click.argument("ids", nargs=-1, required=True)
@json_option("Instead: the lines of the golden files, as they are")
@click.option("--full", is_flag=True, help="Long integers in full.")
@precision_option
@golden_option
def show(
    ids: tuple[str, ...], out: str | None, full: bool, precision: str, golden: Path | None
) -> None:
    """Show golden rows: the case, its exact answer, and the lists that accept."""
    corpus = read(precision, golden)
    rows = [find(corpus, id) for id in ids]
    if out:
        write_out(out, encode_rows(rows, corpus.format))
        return
    from raycert.oracle.explain.console import show_rows

    show_rows(rows, corpus.format, screen(), full)
