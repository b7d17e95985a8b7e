"""What `bench` and `stress` share: which ways are measured, and how a run ends."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click

from raycert.cases.interrupts import interruptible
from raycert.oracle.commands.options import FOLDER, repeatable, stop, write_out
from raycert.oracle.reports.foreign import say

if TYPE_CHECKING:
    from raycert.oracle.measure.way import Way


def ways_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that say which ways, from what the rays are drawn, and where files go."""
    for option in (
        click.option("--out", type=FOLDER, metavar="DIR", help="Write the rows and the plots."),
        click.option("--seed", default=1, show_default=True, type=click.IntRange(min=0),
                     help="What the rays are drawn from."),
        repeatable("--client", "clients", "This program too", metavar="CMD"),
        repeatable("--method", "names", "Only this method"),
    ):  # fmt: skip
        function = option(function)
    return function


def chosen(names: Sequence[str], clients: Sequence[str]) -> tuple[list[Way], list[str]]:
    """Return the ways to run, all without a name, and notes on those that cannot.

    A client that cannot be run ends the program.
    """
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.measure import catalog

    known(names, catalog.BY_NAME, "--method", "raycert bench --list shows all")
    targets = [_words(client) for client in clients]
    try:
        with interruptible():
            return catalog.here(catalog.chosen(names, targets))
    except Unusable as error:
        stop(str(error))


def _words(client: str) -> list[str]:
    try:
        words = shlex.split(client)
    except ValueError as error:
        raise click.BadParameter(f"{client!r}: {error}", param_hint="--client") from None
    if not words:
        raise click.BadParameter("names no program", param_hint="--client")
    return words


def known(names: Iterable[str], there: Iterable[str], option: str, hint: str = "") -> None:
    """Refuse a name that is none of those there are."""
    for name in names:
        if name not in there:
            text = f"there is no {name!r}; {hint or 'there are ' + ', '.join(there)}"
            raise click.BadParameter(text, param_hint=option)


def write_rows(folder: Path, name: str, form: Any, table: str) -> list[Path]:
    """Write what was measured as JSON and as CSV; return the paths of what is written."""
    import json

    text = json.dumps(form, indent=1, allow_nan=False) + "\n"
    return write_files(folder, {f"{name}.json": text, f"{name}.csv": table})


def write_files(folder: Path, files: Mapping[str, str | bytes]) -> list[Path]:
    """Write files of these names; return the paths of those that are written."""
    paths = {folder / name: data for name, data in files.items()}
    return [path for path, data in paths.items() if write_out(path, data)]


@contextmanager
def drawing() -> Iterator[None]:
    """Draw, or say what to install: without matplotlib there are no plots."""
    try:
        yield
    except ModuleNotFoundError as absent:
        if absent.name != "matplotlib":
            raise
        say('no plots without matplotlib: pip install "raycert[plots]"', err=True)


def end(interrupted: bool, written: Iterable[Path]) -> NoReturn:
    """Say what was written; an interrupted run ends with exit status 1."""
    for path in written:
        say(f"wrote {path}")
    if interrupted:
        say("raycert: interrupted; this is what was measured by then", err=True)
    raise SystemExit(1 if interrupted else 0)
