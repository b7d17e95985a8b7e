"""`raycert golden`: regenerate the golden files, or check them byte for byte."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from raycert.oracle.commands.options import check_writable

if TYPE_CHECKING:
    from raycert.cases.case import Family

FOLDER = click.option(
    "--golden",
    "folder",
    type=click.Path(file_okay=False, path_type=Path),
    help="Directory of the golden files  [default: the installed corpus]",
)
CORPUS = click.option(
    "--corpus",
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    help="A corpus that raycert adopt made: its own families, its own golden files.",
)


@click.group()
def golden() -> None:
    """Regenerate or check the golden files: every row, computed anew from its family."""


@golden.command(epilog="In a checkout: raycert golden write --golden cases/golden")
@FOLDER
@CORPUS
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
    from raycert.oracle.corpus.golden import RELEASE, USUAL, Contradiction
    from raycert.oracle.corpus.golden import write as write_files

    target, families = _place(folder, corpus)
    check_writable(target, "--golden")
    try:
        with _progress("computing") as progress:
            files = write_files(target, families, progress, RELEASE if release else USUAL)
    except Contradiction as error:
        raise click.ClickException(f"nothing was written. {error}") from None
    rows = sum(data.count(b"\n") for data in files.values())
    click.echo(f"{rows} rows in {len(files)} files written to {target}")


@golden.command()
@FOLDER
@CORPUS
def check(folder: Path | None, corpus: Path | None) -> None:
    """Compute every row and compare bytes and values with the files; exit 1 on any difference."""
    from raycert.oracle.corpus.golden import compare

    target, families = _place(folder, corpus)
    if not target.is_dir():
        raise click.BadParameter(f"no such directory: {target}", param_hint="--golden")
    with _progress("computing") as progress:
        drifts = compare(target, families, progress)
    for drift in drifts[:20]:
        click.echo(f"{drift.file}: {drift.what}")
    if len(drifts) > 20:
        click.echo(f"and {len(drifts) - 20} more")
    if drifts:
        click.echo("the files differ from what the oracle computes: raycert golden write", err=True)
        raise SystemExit(1)
    click.echo(f"every byte in {target} is as computed")


def _place(folder: Path | None, corpus: Path | None) -> tuple[Path, tuple[Family, ...]]:
    """Return where the golden files are, and the families that make them."""
    from raycert.cases.corpus import GOLDEN
    from raycert.cases.families.catalog import FAMILIES
    from raycert.oracle.corpus.adopt import sources

    if corpus is None:
        return folder or GOLDEN, FAMILIES
    if folder is not None:
        raise click.UsageError("--corpus has its golden files in itself: give no --golden")
    return corpus / "golden", sources(corpus)


@contextmanager
def _progress(verb: str) -> Iterator[Callable[[str], None]]:
    """Show how many rows are done, on a terminal only."""
    from raycert.oracle.commands.options import counting

    with counting(verb) as advance:
        yield lambda _: advance()
