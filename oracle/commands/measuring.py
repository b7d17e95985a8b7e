"""What `bench` and `stress` share: which ways are measured, and how a run ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from raycert.cases.hints import lacking
from raycert.cases.interrupts import interruptible
from raycert.oracle.commands.options import (
    FOLDER,
    out_option,
    repeatable,
    seed_option,
    stop,
    target_option,
    unknown,
    write_out,
)
from raycert.oracle.reports.foreign import say

if TYPE_CHECKING:
    from raycert.oracle.measure.way import Way


def ways_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that say which ways, from what the rays are drawn, and where files go."""
    for option in (
        out_option(FOLDER, "Write the rows and the plots."),
        seed_option(1, "What the rays are drawn from."),
        target_option("This implementation too (repeatable).", "targets", multiple=True),
        repeatable("--method", "names", "Only this method"),
    ):
        function = option(function)
    return function


def chosen(names: Sequence[str], targets: Sequence[Sequence[str]]) -> tuple[list[Way], list[str]]:
    """Return the ways to run, all without a name, and notes on those that cannot.

    A target that cannot be run ends the program.
    """
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.measure import catalog

    known("method", names, catalog.BY_NAME, "raycert bench --list shows all")
    try:
        with interruptible():
            return catalog.here(catalog.chosen(names, targets))
    except Unusable as error:
        stop(str(error))


def known(what: str, names: Iterable[str], there: Iterable[str], hint: str = "") -> None:
    """Refuse a name that is none of those there are."""
    for name in names:
        if name not in there:
            unknown(what, name, there, hint=hint)


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
        say(f"no plots: {lacking('drawing', 'plots', 'matplotlib')}", err=True)


def end(interrupted: bool, written: Iterable[Path]) -> NoReturn:
    """Say what was written; an interrupted run ends with exit status 1."""
    for path in written:
        say(f"wrote {path}")
    if interrupted:
        say("raycert: interrupted; this is what was measured by then", err=True)
    raise SystemExit(1 if interrupted else 0)
