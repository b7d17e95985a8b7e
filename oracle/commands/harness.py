"""`raycert harness`: write a client of the line protocol, to put a tracer into."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from raycert.cases.protocol import ANSWERS, FROM_INSIDE, Answers, FromInside
from raycert.oracle.commands.options import (
    FOLDER,
    OneOf,
    out_option,
    precision_of,
    statuses,
    unknown,
    write_out,
)
from raycert.oracle.reports.foreign import say
from raycert.oracle.starters import (
    FUNCTION,
    IN_PROCESS,
    MARK,
    READERS,
    README,
    STARTERS,
    Starter,
    Wanted,
    templates,
)

LANGUAGES = (*STARTERS, READERS)
EPILOG = """\b
Each client is complete, and granted `stable` as it is: a port of the reference tracer
stands in the place that is marked for yours. It needs the language's own toolchain only.
Each brings a kit of what adapters to libraries need: a frame about the axis, a unit
direction, a far end for segments, intervals from crossings. `--adapter` begins with it.

\b
`readers` in place of a language: two programs, in C and in JavaScript, that judge the
answers of a tracer by the golden rows alone, without raycert.

\b
Examples:
  raycert harness c --out my_tracer
  raycert harness rust --answers first --from-inside exit --precision binary32
  raycert harness python --in-process
  raycert harness readers
  raycert harness --list

"""
EPILOG += statuses()


@click.command(epilog=EPILOG)
@click.argument("lang", required=False)
@out_option(FOLDER, "Where its files go.  [tracer-LANG, or readers]")
@click.option(
    "--answers",
    type=OneOf(ANSWERS),
    default="intervals",
    show_default=True,
    help="What it answers: all intervals, the first hit, or whether there is any.",
)
@click.option(
    "--from-inside",
    type=OneOf(FROM_INSIDE),
    help="Its first hit from a start inside: 0, the exit, or none  [default: zero]",
)
@precision_of("its questions and answers")
@click.option("--adapter", is_flag=True, help="Begin with an adapter to a library, and its kit.")
@click.option("--in-process", is_flag=True, help="For python: a function to be called, no pipe.")
@click.option("--force", is_flag=True, help="Overwrite files that are there.")
@click.option("--list", "listing", is_flag=True, help="List the languages, and stop.")
def harness(
    lang: str | None,
    out: Path | None,
    answers: Answers,
    from_inside: FromInside | None,
    precision: str,
    adapter: bool,
    in_process: bool,
    force: bool,
    listing: bool,
) -> None:
    """Write a small client in LANG that speaks the line protocol, to put your tracer into."""
    if listing:
        for key, starter in STARTERS.items():
            say(f"{key:12}{starter.name:12}{starter.build or starter.run}")
        say(f"{READERS:12}{'C, Node':12}judge answers without raycert; see README.md")
        return
    if lang is None:
        raise click.UsageError(f"no language is given; there are: {', '.join(LANGUAGES)}")
    if lang not in LANGUAGES:
        unknown("language", lang, LANGUAGES)
    if from_inside and answers != "first":
        raise click.UsageError("--from-inside is of the first hit: add --answers first")
    wanted = Wanted(answers, from_inside or "zero", precision, adapter)
    if in_process and (lang != "python" or wanted != Wanted()):
        raise click.UsageError("--in-process is of python, and declares the rest in its `hello`")
    folder = out or Path(READERS if lang == READERS else f"tracer-{lang}")
    files = dict(templates(FUNCTION if in_process else lang, wanted))
    written = _write(folder, files, force)
    if len(written) < len(files):
        say(f"Wrote {len(written)} of {len(files)} files to {folder}.")
    elif lang == READERS:
        say(f"Wrote {len(files)} files to {folder}. Its README.md says how to use them.")
    else:
        _advise(IN_PROCESS if in_process else STARTERS[lang], folder, files)


def _write(folder: Path, files: dict[str, bytes], force: bool) -> list[str]:
    """Write all the files, or none where one is there; return the names of those written."""
    there = [str(folder / name) for name in files if (folder / name).exists()]
    if there and not force:
        raise click.UsageError(f"already there: {', '.join(there)}; --force overwrites")
    return [name for name, data in files.items() if write_out(folder / name, data)]


def _advise(starter: Starter, folder: Path, files: dict[str, bytes]) -> None:
    """Say where the user's place is, and the commands to type next."""
    place = next(name for name, data in files.items() if MARK in data and name != README)
    enter = f"cd {shlex.quote(str(folder))}"
    say(f"Wrote {len(files)} files to {folder}. Your tracer goes into {place}, at the mark.")
    say("Next:")
    say(f"  {enter} && {starter.build}" if starter.build else f"  {enter}")
    dashes = "" if starter is IN_PROCESS else "-- "
    say(f"  raycert certify --level stable {dashes}{starter.run}")
