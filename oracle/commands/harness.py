"""`raycert harness`: write a client of the line protocol, to put a tracer into."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from pathlib import Path

import click

from raycert.oracle.commands.options import FOLDER, write_out
from raycert.oracle.reports.foreign import say

MARK = b"replace from here"
"""Begins the one place, in one file of each language, that is the user's."""


@dataclass(frozen=True, slots=True)
class Starter:
    """A language: its name, what is typed to build its client (may be nothing) and to run it."""

    name: str
    build: str
    run: str


PLAIN = "-O2 -ffp-contract=off"
"""No multiplication is fused with an addition: the answers are those of every other language."""
STARTERS = {
    "c": Starter("C", f"cc -std=c11 {PLAIN} -o tracer client.c tracer.c -lm", "./tracer"),
    "cpp": Starter("C++", f"c++ -std=c++17 {PLAIN} -o tracer client.cpp tracer.cpp", "./tracer"),
    "rust": Starter("Rust", "cargo build --release", "target/release/tracer"),
    "go": Starter("Go", "go build", "./tracer"),
    "java": Starter("Java", "javac Tracer.java", "java Tracer"),
    "javascript": Starter("JavaScript", "", "node client.mjs"),
    "python": Starter("Python", "", "python3 tracer.py"),
    "library": Starter(
        "C library",
        f"cc -std=c11 -shared -fPIC {PLAIN} -o tracer.so library.c tracer.c -lm",
        "./tracer.so",
    ),
}

READERS = "readers"
"""No client: programs that judge answers by the golden rows alone. Asked for like a language."""

EPILOG = """\b
Each client is complete, and granted `stable` as it is: a port of the reference tracer
stands in the place that is marked for yours. It needs the language's own toolchain only.

\b
`readers` in place of a language: two programs, in C and in JavaScript, that judge the
answers of a tracer by the golden rows alone, without raycert.

\b
Examples:
  raycert harness c --out my_tracer
  raycert harness readers
  raycert harness --list
"""


@click.command(epilog=EPILOG)
@click.argument("lang", required=False)
@click.option(
    "--out",
    type=FOLDER,
    help="Directory to write to  [default: tracer-LANG, or readers]",
)
@click.option("--force", is_flag=True, help="Overwrite files that are there.")
@click.option("--list", "listing", is_flag=True, help="List the languages, and stop.")
def harness(lang: str | None, out: Path | None, force: bool, listing: bool) -> None:
    """Write a small client in LANG that speaks the line protocol, to put your tracer into."""
    if listing:
        for key, starter in STARTERS.items():
            say(f"{key:12}{starter.name:12}{starter.build or starter.run}")
        say(f"{READERS:12}{'C, Node':12}judge answers without raycert; see README.md")
        return
    if lang is None or lang not in (*STARTERS, READERS):
        wrong = "no language is given" if lang is None else f"{lang!r} is not a language here"
        raise click.UsageError(f"{wrong}; there are: {', '.join((*STARTERS, READERS))}")
    folder = out or Path(READERS if lang == READERS else f"tracer-{lang}")
    files = dict(templates(lang))
    written = _write(folder, files, force)
    if len(written) < len(files):
        say(f"Wrote {len(written)} of {len(files)} files to {folder}.")
    elif lang == READERS:
        say(f"Wrote {len(files)} files to {folder}. Its README.md says how to use them.")
    else:
        _advise(STARTERS[lang], folder, files)


def templates(lang: str) -> Iterator[tuple[str, bytes]]:
    """Yield each file of a language's client: its path in the directory, and its bytes."""
    from importlib.resources import files

    root = files("raycert.oracle.starters")
    yield from _walk(root / lang, "")
    if lang == "library":  # binds the tracer of the C client
        yield from ((name, (root / "c" / name).read_bytes()) for name in ("tracer.c", "tracer.h"))


def _walk(folder: Traversable, path: str) -> Iterator[tuple[str, bytes]]:
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if entry.is_file():
            yield path + entry.name, entry.read_bytes()
        elif entry.name != "__pycache__":  # pip compiles the Python one where it lies
            yield from _walk(entry, f"{path}{entry.name}/")


def _write(folder: Path, files: dict[str, bytes], force: bool) -> list[str]:
    """Write all the files, or none where one is there; return the names of those written."""
    there = [str(folder / name) for name in files if (folder / name).exists()]
    if there and not force:
        raise click.UsageError(f"already there: {', '.join(there)}; --force overwrites")
    return [name for name, data in files.items() if write_out(folder / name, data)]


def _advise(starter: Starter, folder: Path, files: dict[str, bytes]) -> None:
    """Say where the user's place is, and the commands to type next."""
    place = next(name for name, data in files.items() if MARK in data and name != "README.md")
    enter = f"cd {shlex.quote(str(folder))}"
    say(f"Wrote {len(files)} files to {folder}. Your tracer goes into {place}, at the mark.")
    say("Next:")
    say(f"  {enter} && {starter.build}" if starter.build else f"  {enter}")
    say(f"  raycert certify --level stable -- {starter.run}")
