"""`raycert adopt`: keep a found case in a corpus, after every witness has checked it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from raycert.cases.files import read_file
from raycert.cases.formats import FORMATS, Format
from raycert.cases.levels import TIERS
from raycert.oracle.commands.asking import from_json
from raycert.oracle.commands.options import (
    FOLDER,
    BadInput,
    OneOf,
    precision_of,
    repeatable,
    statuses,
    unknown,
    writing,
)
from raycert.oracle.corpus.adopt import (
    CORPUS,
    Candidate,
    Unfit,
    examine,
    from_row,
    installed,
    rows_in,
)
from raycert.oracle.corpus.adopt import adopt as keep
from raycert.oracle.corpus.golden import Contradiction
from raycert.oracle.reports.foreign import say
from raycert.oracle.witness.crosscheck import Hearing
from raycert.oracle.witness.testimony import WITNESSES

EPILOG = """\b
Examples:
  raycert adopt hunted --id hunt-0/missed-sphere-1 --family grazed-spheres \\
      --why "A grazed sphere is lost where the start is 300 radii away."
  raycert adopt case.json --family caps --slug axis-in-the-cap-plane \\
      --source "example/tracer #12" --flag cap-plane \\
      --why "A ray in the plane of a cap passes the axis."
  raycert adopt case.json --family mine --why "..." --corpus my-corpus
  raycert certify --golden my-corpus/golden ./my_tracer

\b
FILE is a JSON object {"solid": ..., "ray": ...} as in the line protocol, a
golden file (.jsonl), or a directory of golden files, such as hunt writes.
The inputs go to CORPUS/adopted/FAMILY.jsonl, and the rows made of them to
CORPUS/golden. In a checkout the corpus is the project's own.

"""
EPILOG += statuses(
    {
        0: "adopted",
        1: "a witness finds another answer",
        2: "bad usage or input, or the corpus has the case already",
    }
)


@click.command(epilog=EPILOG)
@click.argument("file", type=click.Path(exists=True, path_type=Path))
@click.option(
    "--family", metavar="FAMILY", required=True, help="The family to put it in; made if it is new."
)
@click.option("--why", required=True, help="What the case shows: one sentence of fact.")
@click.option("--id", metavar="ID", help="Which row of FILE, where it has several.")
@click.option("--slug", help="Its name in the family  [default: from what it shows]")
@click.option("--source", help="The public report that it comes from.")
@repeatable("--flag", "flags", "A flag of the legend")
@click.option("--tier", type=OneOf(TIERS), help="[default: told by its numbers]")
@precision_of("FILE, where its folder does not tell")
@click.option(
    "--corpus",
    type=FOLDER,
    metavar="DIR",
    help="The corpus  [default: the project's own, in a checkout]",
)
def adopt(file: Path, family: str, slug: str | None, corpus: Path | None, **options: Any) -> None:
    """Keep a found case: check it with all witnesses, name it, and make its golden rows.

    Its id is FAMILY/SLUG, and no slug is used twice. `raycert golden write` makes the same rows
    again. The witnesses that are installed are asked; one that finds another answer refuses.
    """
    folder = _corpus(corpus)
    found = _found(file, options)
    try:
        checked = examine(found, installed())
        with writing(folder):
            kept = keep(folder, family, found, slug)
            _say(checked)
            say(f"adopted as {kept.id} ({', '.join(kept.precisions)})")
            for path in kept.files:
                say(f"written {path}")
    except Contradiction as error:
        raise click.ClickException(f"nothing was written: {error}") from None
    except Unfit as error:
        raise BadInput(str(error)) from None


def _corpus(corpus: Path | None) -> Path:
    """Return the folder of the corpus: the one given, or that of the checkout this runs in."""
    if corpus is not None:
        return corpus
    if not (CORPUS.parent / "pyproject.toml").is_file():
        raise BadInput("this is no checkout; say where to keep the case: --corpus DIR")
    tried: Path = FOLDER.convert(CORPUS, None, None)
    return tried


def _found(file: Path, options: dict[str, Any]) -> Candidate:
    """Return the case of the file, with what the options say of it."""
    fmt, id = FORMATS[options["precision"]], options["id"]
    if file.is_dir() or file.suffix == ".jsonl":
        found = _row(file, fmt, id, options["why"])
    elif id is not None:
        raise BadInput(f"--id: {file} is one case, and no golden file")
    else:
        found = Candidate(*from_json(read_file(file), fmt, str(file)), fmt, options["why"])
    source = found.source if options["source"] is None else options["source"]
    flags = tuple(dict.fromkeys((*found.flags, *options["flags"])))
    return replace(found, tier=options["tier"], source=source, flags=flags)


def _row(file: Path, fmt: Format, id: str | None, why: str) -> Candidate:
    rows = rows_in(file, fmt)
    chosen = [(row, own) for row, own in rows if id in (None, row.id)]
    ids = ", ".join(sorted({row.id for row, _ in rows})[:8])
    if not rows:
        raise BadInput(f"{file} has no golden rows")
    if not chosen:
        unknown("row", id or "", (row.id for row, _ in rows), f"in {file}", f"it has {ids}")
    if len({row.id for row, _ in chosen}) > 1:
        raise BadInput(f"{file} has {len(rows)} rows; choose one with --id: {ids}")
    wanted = [(row, own) for row, own in chosen if own is fmt] or chosen
    return from_row(*wanted[0], why)


def _say(checked: Hearing) -> None:
    say(f"exactly {checked.answer}")
    said = dict.fromkeys(WITNESSES, "not installed, not asked")
    for name, verdict, _ in checked.testimonies:
        why = f": {verdict.why}" if verdict.outcome == "undecided" and verdict.why else ""
        said[name] = f"{verdict.outcome}{why}"
    for name, words in said.items():
        say(f"{name}: {words}")
