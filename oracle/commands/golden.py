"""`raycert golden`: regenerate the golden files, or check them byte for byte."""

from __future__ import annotations

from pathlib import Path

import click

from raycert.cases.case import Family
from raycert.cases.corpus import GOLDEN
from raycert.cases.families.catalog import FAMILIES
from raycert.oracle.commands.options import (
    FOLDER,
    KNOWN_FOLDER,
    Menu,
    counting,
    statuses,
    writing,
)
from raycert.oracle.corpus.adopt import sources
from raycert.oracle.corpus.golden import RELEASE, USUAL, Contradiction, compare
from raycert.oracle.corpus.golden import write as write_files
from raycert.oracle.corpus.lock import locked
from raycert.oracle.reports.foreign import say

folder_option = click.option(
    "--golden",
    "folder",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Directory of the golden files  [default: the installed corpus]",
)
corpus_option = click.option(
    "--corpus",
    type=KNOWN_FOLDER,
    metavar="DIR",
    help="A corpus that raycert adopt made: its own families, its own golden files.",
)


@click.group(cls=Menu)
def golden() -> None:
    """Regenerate or check the golden files: every row, computed anew from its family."""


WRITE_EPILOG = f"""\b
Examples:
  raycert golden write --golden cases/golden         in a checkout
  raycert golden write --corpus my-corpus            what raycert adopt keeps

{statuses({1: "a witness finds another answer, and nothing was written"})}
"""
CHECK_EPILOG = f"""\b
Examples:
  raycert golden check
  raycert golden check --corpus my-corpus

{statuses({0: "every byte is as computed", 1: "some are not"})}
"""


@golden.command(epilog=WRITE_EPILOG)
@folder_option
@corpus_option
@click.option(
    "--release",
    is_flag=True,
    help="Ask the witnesses by symbols and by meshes too; needs their extras, takes minutes.",
)
def write(folder: Path | None, corpus: Path | None, release: bool) -> None:
    """Compute every row and write the files and the manifest; nothing is written before all is.

    The witnesses by definition and by enclosure check each row. A row on which one disagrees is
    not written, and neither is anything else.
    """
    target = _place(folder, corpus)
    FOLDER.convert(target, None, None)
    try:
        with writing(target), locked(target), counting("computing") as advance:
            witnesses = RELEASE if release else USUAL
            files = write_files(target, _families(corpus), lambda _: advance(), witnesses)
            rows = sum(data.count(b"\n") for data in files.values())
            say(f"{rows} rows in {len(files)} files written to {target}")
    except Contradiction as error:
        raise click.ClickException(f"nothing was written. {error}") from None


@golden.command(epilog=CHECK_EPILOG)
@folder_option
@corpus_option
def check(folder: Path | None, corpus: Path | None) -> None:
    """Compute every row and compare bytes and values with the files; exit 1 on any difference."""
    target = _place(folder, corpus)
    if not target.is_dir():
        raise click.BadParameter(f"no such directory: {target}", param_hint="--golden")
    with counting("computing") as advance:
        drifts = compare(target, _families(corpus), lambda _: advance())
    for drift in drifts[:20]:
        say(f"{drift.file}: {drift.what}")
    if len(drifts) > 20:
        say(f"and {len(drifts) - 20} more")
    if drifts:
        say("the files differ from what the oracle computes: raycert golden write", err=True)
        raise SystemExit(1)
    say(f"every byte in {target} is as computed")


def _place(folder: Path | None, corpus: Path | None) -> Path:
    """Return where the golden files are."""
    if corpus is None:
        return folder or GOLDEN
    if folder is not None:
        raise click.UsageError("--corpus has its golden files in itself: give no --golden")
    return corpus / "golden"


def _families(corpus: Path | None) -> tuple[Family, ...]:
    """Return the families that make the golden files."""
    return FAMILIES if corpus is None else sources(corpus)
