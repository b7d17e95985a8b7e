"""The options that verbs share, each spelled once, and what they stand for.

    rows      golden_option precision_option family_option tier_option solid_option id_option;
              `read(precision, golden)` and `find(corpus, id)` give the rows that they name
    asked     level_option(default); `check_convention` refuses a word that is no convention
    target    target_argument, target_option(text), whose help ends with TARGETS; `aim(words)` is
              the target, `spelled(words)` its words for a command line; limits_options, and
              `limits(options)` what they set
    refusals  `stop(message)` ends with 3, `BadInput` with 2; `unknown` says which name was meant,
              and so does `OneOf`, a choice; `needs(what, extra, modules)` what to install
    output    out_option(type, text), json_option(text); FILE, FILE_OR_DASH and FOLDER are the types
              of what is written, tried before the work; `write_out` and `writing` after it keep
              what fails to the end of the verb, which `main` ends with NOT_WRITTEN; `counting` is
              the progress between
    input     KNOWN_* are the types of what is read
    others    seed_option(default, text), workers_option(default)
    help      `statuses(...)` is the last line of every verb's help

Another repeatable option is `repeatable("--method", "names", "Only this method")`. Nothing but
click is loaded before a function is called.
"""

from __future__ import annotations

import errno
import os
import shlex
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import click

from raycert.cases.hints import lacking, near
from raycert.cases.levels import LEVELS, TIERS, Level
from raycert.oracle.reports.foreign import say

if TYPE_CHECKING:
    from raycert.cases.corpus import Corpus
    from raycert.cases.row import GoldenRow
    from raycert.oracle.client.dialogue import Limits, Target

Function = TypeVar("Function", bound=Callable[..., Any])
Decorator = Callable[[Function], Function]

PRECISIONS = ("binary64", "binary32")
KNOWN_FILE = click.Path(exists=True, dir_okay=False, path_type=Path)
KNOWN_FOLDER = click.Path(exists=True, file_okay=False, path_type=Path)
SECONDS = click.FloatRange(min=0.01, max=86400)


class BadInput(click.ClickException):
    """An input that is refused: exit 2, with what to do."""

    exit_code = 2


def stop(message: str) -> NoReturn:
    """End with exit status 3: the target could not be run, or nothing was tested."""
    say(f"raycert: {message}", err=True)
    raise SystemExit(3)


def needs(what: str, extra: str, *modules: str) -> None:
    """Stop, and say what to install, where a module of an extra is missing."""
    from importlib.util import find_spec

    if missing := [name for name in modules if find_spec(name) is None]:
        stop(lacking(what, extra, *missing))


def unknown(
    what: str, value: str, known: Iterable[str], where: str = "", hint: str = ""
) -> NoReturn:
    """Stop: no such value, and which was meant."""
    names = sorted(set(known))
    hint = near(value, names) or hint or f"known: {', '.join(names)}"
    raise BadInput(f"no {what} {value!r:.80} {where}".rstrip() + f"; {hint}")


class OneOf(click.Choice[str]):
    """A choice among words, which says of another word which was meant."""

    def get_invalid_choice_message(self, value: Any, ctx: click.Context | None) -> str:
        text = super().get_invalid_choice_message(value, ctx)
        hint = near(str(value), map(str, self.choices))
        return f"{text.rstrip('.')}; {hint}" if hint else text


class Menu(click.Group):
    """A group that says of an unknown command which was meant."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        names, word = self.list_commands(ctx), args[0]
        if word not in names and not word.startswith("-"):
            ctx.fail(f"no verb {word!r}; {near(word, names) or f'see: {ctx.command_path} --help'}")
        return super().resolve_command(ctx, args)


STATUSES = {
    0: "done",
    1: "",
    2: "bad usage or input",
    3: "",
    4: "an output could not be written, which is said last",
}


def statuses(said: dict[int, str] | None = None) -> str:
    """Return the end of a verb's help: its exit statuses, the usual ones but for what is said."""
    told = {status: text for status, text in (STATUSES | (said or {})).items() if text}
    return "Exit status: " + "; ".join(f"{status} {text}" for status, text in told.items()) + "."


def repeatable(name: str, field: str, text: str, **more: Any) -> Decorator[Any]:
    """Return an option that may be given several times; `field` has all of its values."""
    if "type" not in more:
        more.setdefault("metavar", name.strip("-").upper())
    return click.option(name, field, multiple=True, help=f"{text} (repeatable).", **more)


# Rows of the corpus.


def _solids(_: click.Context, __: click.Parameter, names: tuple[str, ...]) -> tuple[str, ...]:
    from raycert.cases.model import SOLIDS

    for name in names:
        if name not in SOLIDS:
            unknown("solid", name, SOLIDS)
    return names


family_option = repeatable("--family", "families", "Only this family")
tier_option = repeatable("--tier", "tiers", "Only this tier", type=OneOf(TIERS))
solid_option = repeatable("--solid", "solids", "Only this solid type", callback=_solids)
id_option = repeatable("--id", "ids", "Only this row")
golden_option = click.option(
    "--golden",
    type=KNOWN_FOLDER,
    metavar="DIR",
    help="Golden files to use instead of the installed ones.",
)


def precision_of(what: str) -> Decorator[Any]:
    text, kind = f"Number format of {what}.", OneOf(PRECISIONS)
    return click.option("--precision", type=kind, default="binary64", show_default=True, help=text)


precision_option = precision_of("the rows")


def read(precision: str, golden: Path | None) -> Corpus:
    """Return the rows of a precision. Raises `BadFile`."""
    from raycert.cases.corpus import GOLDEN, read_corpus

    return read_corpus(precision, golden or GOLDEN)


def find(corpus: Corpus, id: str) -> GoldenRow:
    """Return the row with an id, or stop with the ids that come near."""
    row = corpus.row(id)
    if row is None:
        family = id.partition("/")[0]
        families = {row.family for row in corpus.rows}
        hint = f"--family {family}" if family in families else "--families"
        known = (row.id for row in corpus.rows)
        unknown("row", id, known, f"in {corpus.precision}", f"see: raycert list {hint}")
    return row


# What is asked of an answer.


def level_option(default: Level, text: str | None = None) -> Decorator[Any]:
    return click.option(
        "--level", type=OneOf(LEVELS), default=default, show_default=True, help=text
    )


def check_convention(text: str) -> None:
    from raycert.cases.protocol import BadLine, convention

    try:
        convention(text)
    except BadLine as error:
        raise click.BadParameter(str(error), param_hint="--convention") from None


# The implementation that is asked.

TARGETS = """\b
TARGET is one of
  reference, oracle       the built-in implementations
  './tracer --fast'       a program that speaks the line protocol, with its
                          arguments; last on the line also: -- ./tracer --fast
  module:function         a Python callable: function(solid, ray) -> pairs;
                          in a file of any name: dir/tracer.py:function
  ./tracer.so             a shared library with the signature of raycert.h
                          (raycert harness library --out DIR)
"""


def _parted(word: str) -> tuple[str, ...]:
    """Return the words in one, as a shell parts them; a file, or a function in one, is one word."""
    if Path(word).is_file() or Path(word.rpartition(":")[0]).is_file():
        return (word,)
    try:
        words = tuple(shlex.split(word))
    except ValueError as error:
        raise click.BadParameter(f"{word!r:.80}: {error}") from None
    if not words:
        raise click.BadParameter("names no implementation")
    return words


def _of_argument(_: click.Context, __: click.Parameter, words: tuple[str, ...]) -> tuple[str, ...]:
    return _parted(words[0]) if len(words) == 1 else words


def _of_option(_: click.Context, __: click.Parameter, given: Any) -> Any:
    if isinstance(given, tuple):
        return tuple(map(_parted, given))
    return None if given is None else _parted(given)


target_argument = click.argument(
    "target", nargs=-1, required=True, type=click.UNPROCESSED, callback=_of_argument
)


def target_option(text: str, field: str = "target", **more: Any) -> Decorator[Any]:
    """Return an option that names a target; TARGETS says how."""
    more = {"metavar": "TARGET", "callback": _of_option, "help": text, **more}
    return click.option("--target", field, **more)


def limits_options(function: Function) -> Function:
    options = (
        ("--hello-timeout", SECONDS, 10.0, "Seconds to the hello."),
        ("--case-timeout", SECONDS, 5.0, "Seconds to an answer."),
        ("--line-limit", click.IntRange(min=256), 1 << 20, "Bytes in a line."),
    )
    for name, kind, default, text in reversed(options):
        option = click.option(name, type=kind, default=default, show_default=True, help=text)
        function = option(function)
    return function


def limits(options: dict[str, Any]) -> Limits:
    from raycert.oracle.client.dialogue import Limits

    return Limits(options["hello_timeout"], options["case_timeout"], options["line_limit"])


def aim(words: tuple[str, ...]) -> Target:
    """Return the target that the words name; end with exit status 3 where they name none."""
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.client.target import target

    try:
        return target(words)
    except Unusable as error:
        stop(str(error))


def spelled(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return the words as a command line has to spell them: `--` before what may have options."""
    return words if len(words) == 1 and not words[0].startswith("-") else ("--", *words)


def seed_option(default: int | None, text: str) -> Decorator[Any]:
    shown, kind = default is not None, click.IntRange(min=0)
    return click.option("--seed", type=kind, default=default, show_default=shown, help=text)


def workers_option(default: int, most: int | None = None) -> Decorator[Any]:
    kind, text = click.IntRange(1, most), "Processes of this machine."
    return click.option("--workers", type=kind, default=default, show_default=True, help=text)


# What is written, and what is seen meanwhile.


NOT_WRITTEN = 4
"""The exit status of a verb that did its work and could not write all that it was to write."""
LOST = "raycert: outputs that were not written"
FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


def check_writable(path: Path) -> None:
    """Raise `OSError` where a file, or a folder with files, cannot be written; leave no trace."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        if not os.access(path, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        return
    place = Path(os.path.realpath(path)) if path.is_symlink() else path.absolute()
    start = place.parent if place.is_file() else place
    there = next(folder for folder in (start, *start.parents) if folder.exists())
    for part in start.relative_to(there).parts:
        (there / part).exists()  # raises for a name that is too long
    with tempfile.TemporaryFile(dir=there):
        pass


class Output(click.Path):
    """The type of what is written: refused if it cannot be, before any work; `-` passes."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if not str(value):
            self.fail("is the empty name", param, ctx)
        path = super().convert(value, param, ctx)
        try:
            if not (self.allow_dash and str(path) == "-"):
                check_writable(Path(str(path)))
        except OSError as error:
            self.fail(f"cannot write to {str(path)!r:.60}: {error.strerror}", param, ctx)
        return path


FILE = Output(dir_okay=False, path_type=Path)
FILE_OR_DASH = Output(dir_okay=False, allow_dash=True)
FOLDER = Output(file_okay=False, path_type=Path)


def out_option(
    kind: Output, text: str | None = None, field: str = "out", **more: Any
) -> Decorator[Any]:
    """Return the option for what a verb makes; `kind` is one of the three types."""
    metavar = "DIR" if kind is FOLDER else "FILE"
    return click.option("-o", "--out", field, type=kind, metavar=metavar, help=text, **more)


def json_option(text: str, field: str = "out") -> Decorator[Any]:
    """Return the option for what a verb finds, as JSON."""
    text = f"{text}, as JSON; - is standard output."
    return click.option("--json", field, type=FILE_OR_DASH, metavar="FILE", help=text)


@contextmanager
def writing(what: Path | str) -> Iterator[None]:
    """Write something: a failure is kept for the end of the verb, so that it loses nothing else."""
    try:
        yield
    except OSError as error:
        context = click.get_current_context(silent=True)
        if context is None or LOST not in context.meta or error.errno == errno.EPIPE:
            raise
        context.meta[LOST].append(f"{what}: {error.strerror or error}")


def write_out(out: Path | str, data: str | bytes, append: bool = False) -> bool:
    """Write a file, whole or not at all, and return whether that succeeded.

    `-` is standard output. What no UTF-8 has becomes `?`.
    """
    from raycert.cases.corpus import append_whole, write_whole

    data = data if isinstance(data, bytes) else data.encode("utf-8", "replace")
    with writing("standard output" if str(out) == "-" else out):
        if str(out) == "-":
            click.echo(data, nl=False)
        else:
            (append_whole if append else write_whole)(Path(out), data)
        return True
    return False


def flush() -> None:
    """Bring standard output to its end: what it cannot take goes nowhere."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextmanager
def counting(verb: str, total: int | None = None) -> Iterator[Callable[..., None]]:
    """Yield `advance(n=1)`: a bar on a terminal's standard error that goes when all is done."""
    if not sys.stderr.isatty():
        yield lambda n=1: None
        return
    from rich import progress

    from raycert.oracle.reports.screen import screen

    done = progress.BarColumn(), progress.MofNCompleteColumn()
    clocks = progress.TimeElapsedColumn(), progress.TimeRemainingColumn()
    columns = "{task.description}", *done, *clocks
    with progress.Progress(*columns, console=screen(stderr=True), transient=True) as bar:
        task = bar.add_task(verb, total=total)
        yield lambda n=1: bar.advance(task, n)
