"""`raycert field`: many targets certified into one table, each with its certificate and page."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from raycert.cases.interrupts import held
from raycert.oracle.commands.options import (
    FILE_OR_DASH,
    FOLDER,
    KNOWN_FILE,
    BadInput,
    OneOf,
    check_convention,
    golden_option,
    json_option,
    level_option,
    limits_options,
    out_option,
    repeatable,
    statuses,
    stop,
    unknown,
    write_out,
    writing,
)
from raycert.oracle.reports.foreign import clean, say

if TYPE_CHECKING:
    from raycert.oracle.certify.entrants import Entrant
    from raycert.oracle.commands.fielding import Came, Turn

Json = dict[str, Any]
BOOK, PAGE, CERTIFICATE, ROW, HELLO = (
    "gradebook.json", "index.html", "certificate.json", "row.json", "hello.json",
)  # fmt: skip

EXAMPLE = """\
# A gradebook: raycert field THIS_FILE. Words and patterns are relative to this file's folder.

# What stands at the top is for all targets, and each may say otherwise:
level = "sound"          # sound, stable, faithful or exact
convention = "closed"    # as for certify --convention
hello_timeout = 10       # seconds to the hello
case_timeout = 5         # seconds to an answer

# A class: one target for each file, called as what the wildcard stands for.
# [targets.class]
# each = "submissions/*/tracer.py:intersect"

# Programs in a language that starts slowly; {} is the file.
# [targets.java]
# each = "java/*.jar"
# words = "java -jar {}"
# hello_timeout = 30

[targets.reference]
words = "reference"
title = "the built-in tracer"
level = "stable"

# A program with its arguments; fields of the hello that hold in place of what it says itself.
# [targets.mine]
# words = ["python3", "my tracer.py", "--fast"]
# hello = { domain = { distance = 1e6, size = [1e-4, 1e4] }, degenerate = ["zero_direction"] }
"""

STATUSES = {0: "all are granted", 1: "some are not", 3: "none of them could be run"}
EPILOG = """\b
FILE has a table for each target (raycert field --example shows one of all kinds):
  [targets.mine]
  words = "python3 tracer.py --fast"   a program; or tracer:intersect, ./tracer.so
  [targets.class]
  each = "submissions/*.py:intersect"  one target for each file

\b
Examples:
  raycert field --each 'submissions/*.py:intersect'
  raycert field --each 'submissions/*/tracer' --sort left --markdown table.md
  raycert field --each 'submissions/*/Main.jar' --words 'java -jar {}'
  raycert field class.toml                  all of them; what is done is kept
  raycert field class.toml alice bob --again

\b
In --out: index.html and gradebook.json, and for each target a folder with its
certificate.json and index.html. A target is asked again only if its files, what
is asked of it, the corpus or raycert have changed, or with --again. Ctrl-C keeps
what is done. A target that cannot be run is a row with its reason.

"""
EPILOG += statuses(STATUSES)


@click.command(epilog=EPILOG)
@click.argument("file", type=KNOWN_FILE, required=False)
@click.argument("names", nargs=-1)
@repeatable("--each", "patterns", "A target for each such file, instead of FILE", metavar="GLOB")
@click.option("--words", help="How each is run, {} being the file: 'python3 {}'.")
@level_option("sound")
@click.option("--convention", default="closed", show_default=True, help="As for certify.")
@click.option("--smoke", is_flag=True, help="Only some 150 rows that refuse every planted fault.")
@golden_option
@click.option("--workers", type=click.IntRange(1, 256), help="Targets at a time.  [the cores]")
@click.option("--again", is_flag=True, help="Ask again what is done.")
@click.option("--sort", "order", type=OneOf(("file", "name", "left")), default="file",
              show_default=True, help="The order of the table.")  # fmt: skip
@out_option(FOLDER, "For the table and the certificates.", default="gradebook", show_default=True)
@json_option("The table", "out_json")
@click.option("--markdown", type=FILE_OR_DASH, metavar="FILE",
              help="A summary for a CI job, added to what FILE holds.")  # fmt: skip
@click.option("--example", is_flag=True, help="Print an example of FILE, and end.")
@limits_options
@held()
def field(file: Path | None, names: tuple[str, ...], **options: Any) -> None:
    """Certify many targets into one table: those of FILE, or only NAMES of them."""
    if options["example"]:
        say(EXAMPLE, nl=False)
        return
    entrants = _entrants(file, options)
    book = _Book(entrants, _chosen(entrants, names, file), file, options)
    book.certify()
    form = book.written()
    if str(options["out_json"]) != "-":
        _print(form)
    states = [row["state"] for row in form["targets"]]
    if all(state in ("not run", "not asked") for state in states):
        if form["interrupted"]:
            raise KeyboardInterrupt
        stop("none of the targets could be run")
    raise SystemExit(0 if set(states) <= {"granted", "part"} else 1)


def _entrants(file: Path | None, options: Json) -> list[Entrant]:
    """Return the targets that there are. Raises `BadFile`."""
    from raycert.oracle.certify.entrants import TIMES, entrants_each, read_entrants

    if (file is None) == (not options["patterns"]):
        raise click.UsageError("give FILE or --each; an example: raycert field --example")
    if options["words"] and file:
        raise click.UsageError("--words is for --each; in FILE it stands with the target")
    check_convention(options["convention"])
    given, typed = click.get_current_context().get_parameter_source, ParameterSource.COMMANDLINE
    keys = ("level", "convention", *TIMES, "line_limit")
    over = {key: options[key] for key in keys if given(key) is typed}
    if file is None:
        return entrants_each(options["patterns"], options["words"], over, Path.cwd())
    return read_entrants(file, over)


def _chosen(entrants: list[Entrant], names: Sequence[str], file: Path | None) -> list[Entrant]:
    """Return the targets that are named, or all."""
    known = {entrant.name: entrant for entrant in entrants}
    for name in names:
        if name not in known:
            unknown("target", name, known, f"in {file}")
    return [known[name] for name in dict.fromkeys(names)] or entrants


class _Book:
    """The rows of a gradebook, those that are done, and the folder where all is kept."""

    def __init__(
        self, every: list[Entrant], entrants: list[Entrant], file: Path | None, options: Json
    ) -> None:
        from raycert.cases.corpus import GOLDEN, digest, read_manifest
        from raycert.oracle.certify.environment import environment, tool_sha256
        from raycert.oracle.certify.selection import Selection

        self.out, self.options, self.entrants = options["out"].absolute(), options, entrants
        self._check()
        self.golden = (options["golden"] or GOLDEN).absolute()
        self.selection = Selection(smoke=options["smoke"])
        self.made = {
            "file": str(file or " ".join(options["patterns"])),
            "began": datetime.now(UTC).isoformat(timespec="seconds"),
            "interrupted": False,
            "selection": list(self.selection.options()),
            "corpus": read_manifest(self.golden)["corpus"],
            "tool": (made := environment()).pop("tool"),
            "environment": made,
        }
        self.came: dict[str, Json] = {}
        own = {path for entrant in every for path in entrant.files()}
        context = digest(self.golden), tool_sha256(), self.made["selection"]
        self.prints = {entrant.name: entrant.fingerprint(own, *context) for entrant in entrants}

    def _check(self) -> None:
        if (self.out / PAGE).exists() and not (self.out / BOOK).is_file():
            raise BadInput(f"{self.options['out']} has another {PAGE}; --out DIR writes elsewhere")

    def certify(self) -> None:
        """Certify what is not done; on KeyboardInterrupt what has come is kept."""
        from raycert.oracle.certify.measured import cores
        from raycert.oracle.commands.fielding import run

        turns = [turn for entrant in self.entrants if (turn := self._turn(entrant))]
        with _Board(self, len(turns)) as board:
            try:
                run(turns, self.options["workers"] or cores(), board)
            except KeyboardInterrupt:
                self.made["interrupted"] = True

    def _turn(self, entrant: Entrant) -> Turn | None:
        """Return what is to be done for a target; None where it is done."""
        from raycert.oracle.commands.fielding import Turn

        folder = self.out / entrant.place
        if not self.options["again"] and (row := self._kept(entrant, folder)):
            self.came[entrant.name] = row
            return None
        number = self.entrants.index(entrant)
        hello = os.path.relpath(folder / HELLO, entrant.folder)
        return Turn(number, entrant, self.selection, self.golden, hello)

    def _kept(self, entrant: Entrant, folder: Path) -> Json | None:
        from raycert.cases.files import BadFile, decode_json, read_file

        with suppress(BadFile, ValueError, LookupError, TypeError):
            kept = decode_json(read_file(folder / ROW, regular=True))
            whole = all((folder / name).is_file() for name in (CERTIFICATE, PAGE))
            if whole and kept["fingerprint"] == self.prints[entrant.name]:
                row: Json = kept["row"]
                return row
        return None

    def begin(self, turn: Turn) -> None:
        """Write what the certificate's commands name."""
        if turn.entrant.hello:
            text = json.dumps(dict(turn.entrant.hello), indent=1, default=str) + "\n"
            write_out(self.out / turn.entrant.place / HELLO, text)

    def take(self, turn: Turn, came: Came) -> None:
        """Keep what came of a target: its row last, which says that all is there."""
        self.came[turn.entrant.name] = came.row
        if came.certificate:
            folder, row = self.out / turn.entrant.place, came.row
            kept = {"fingerprint": self.prints[turn.entrant.name], "row": row}
            files = {CERTIFICATE: came.certificate, PAGE: came.page}
            if row["state"] != "not run":
                files[ROW] = json.dumps(kept, indent=1) + "\n"
            all(write_out(folder / name, text) for name, text in files.items())

    def row(self, entrant: Entrant) -> Json:
        from raycert.oracle.reports.gradebook import without

        came = self.came.get(entrant.name) or without("not asked", "interrupted before it was done")
        there = bool(came["solids"])
        return {
            "name": entrant.name,
            "title": entrant.title,
            "words": list(entrant.words),
            "asked": {"level": entrant.level, "convention": entrant.convention},
            "certificate": f"{entrant.place}/{CERTIFICATE}" if there else None,
            "page": f"{entrant.place}/{PAGE}" if there else None,
            **came,
        }

    def written(self) -> Json:
        """Write the gradebook in its forms, and return it."""
        from raycert.oracle.reports.gradebook import gradebook, in_order
        from raycert.oracle.reports.gradetable import markdown, page

        rows = in_order(map(self.row, self.entrants), self.options["order"])
        form = gradebook(rows, self.made)
        text = json.dumps(form, indent=1, allow_nan=False) + "\n"
        write_out(self.out / BOOK, text)
        write_out(self.out / PAGE, page(form))
        if self.options["out_json"]:
            write_out(self.options["out_json"], text)
        if self.options["markdown"]:
            write_out(self.options["markdown"], markdown(form), append=True)
        return form


class _Board:
    """What a person sees of the work: on a terminal a line for each target under way, and a bar.

    Elsewhere a line for each that has ended.
    """

    def __init__(self, book: _Book, total: int) -> None:
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeElapsedColumn

        from raycert.oracle.reports.screen import screen

        self.book, self.total, self.done = book, total, 0
        self.console = screen(stderr=True)
        columns = "{task.description}", BarColumn(), MofNCompleteColumn(), TimeElapsedColumn()
        self.bars = Progress(
            *columns, console=self.console, transient=True, disable=not sys.stderr.isatty()
        )
        self.all = self.bars.add_task("targets", total=total)
        self.tasks: dict[int, Any] = {}

    def __enter__(self) -> _Board:
        self.bars.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.bars.stop()

    def begun(self, turn: Turn) -> None:
        self.book.begin(turn)
        self.tasks[turn.number] = self.bars.add_task(
            self._line(turn.number, "starting"), total=None
        )

    def progress(self, number: int, verb: str, done: int, total: int) -> None:
        line = self._line(number, verb)
        self.bars.update(self.tasks[number], description=line, completed=done, total=total)

    def _line(self, number: int, verb: str) -> str:
        return f"{clean(self.book.entrants[number].name, 24)}: {verb}"

    def ended(self, turn: Turn, came: Came) -> None:
        from raycert.oracle.reports.gradebook import standing

        self.bars.remove_task(self.tasks.pop(turn.number))
        self.bars.advance(self.all)
        self.done += 1
        self.book.take(turn, came)
        said = came.row["reason"] or standing(came.row)
        self.console.print(
            clean(f"{self.done}/{self.total} {turn.entrant.name}: {said}", 300), soft_wrap=True
        )


def _print(form: Json) -> None:
    from raycert.oracle.reports.gradetable import report
    from raycert.oracle.reports.screen import screen

    with writing("standard output"):
        report(form, screen(width=None if sys.stdout.isatty() else 100))
