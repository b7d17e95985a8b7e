"""The command `raycert`: a table of verbs, each loaded only when it is called."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import click

from raycert.cases import interrupts
from raycert.cases.files import BadFile
from raycert.oracle.commands import streams
from raycert.oracle.commands.options import FULL, LOST, NOT_WRITTEN, BadInput, Menu, flush
from raycert.oracle.reports.foreign import escaped, say

VERBS: dict[str, dict[str, tuple[str, str]]] = {
    "Certify your tracer": {
        "harness": ("harness", "Write a starter client in C, C++, Rust, Go, Java, ..."),
        "certify": ("certify", "Grade an implementation on the golden cases."),
        "field": ("field", "Grade many implementations into one table."),
        "report": ("certify:report", "Write the reports of a certificate again."),
        "explain": ("explain", "Derive one case, step by step."),
        "show": ("listing:show", "Show golden rows in full."),
        "list": ("listing:list_cases", "List golden cases by family, flag, tier, row."),
    },
    "Have the corpus": {
        "export": ("export", "Write the golden cases as flat TSV."),
        "golden": ("golden", "Regenerate or check the golden files."),
        "adopt": ("adopt", "Keep a found case in the corpus."),
        "serve": ("serve", "Answer the line protocol: oracle or reference."),
    },
    "Look further": {
        "hunt": ("hunt", "Search for failing cases and make them simple."),
        "map": ("map:draw_map", "Draw what surrounds a case: exact answers, errors."),
        "render": ("render", "Render a scene: depth, normals, error."),
        "plan": ("plan", "What a scene lets the tracer leave out, and why."),
    },
    "Why believe us": {
        "crosscheck": ("crosscheck", "Check the oracle by independent witnesses."),
        "zoo": ("zoo", "Try planted wrong tracers: who refuses which, and why."),
    },
    "How fast, how far": {
        "bench": ("bench", "Set error against run time; all figures of speed."),
        "stress": ("stress", "Set error against how stiff the problem is."),
    },
}
"""By what a person comes for: the verbs, each with its module here (and function, where that is
not named like it), and what it does."""
PLACES = {verb: place for group in VERBS.values() for verb, (place, _) in group.items()}
FORMER: dict[str, str] = {
    "speed": "bench --section batch, scalar, libraries or scenes",
    "plan --solids": "raycert bench --section scenes",
    "export --solids": "--declared SOLID",
    "render --tracer": "--method",
    "explain --with": "--target",
    "explain --format": "--json FILE",
    "bench --client": "--target",
    "bench --commands": "--section commands",
    "stress --client": "--target",
    **dict.fromkeys(("explain --id", "map --id", "show --id"), "ID, without --id"),
}
"""Verbs and options that went into others, each with what to type now."""

EPILOG = """\b
First steps:
  raycert certify reference             grade the built-in tracer
  raycert certify -- ./my_tracer        grade yours (it speaks JSON Lines)
  raycert list --families               what is tested, and why
  raycert explain --cylinder 0,0,0 0,0,2 1 --ray=-3,0,1 1,0,0
                                        one case, derived step by step

Exit status: 0 granted or done, 1 not granted or differences found, 2 bad usage or
input, 3 the target could not be run or nothing was tested, 4 an output could not be
written: what was found is printed, what is missing is said last. Ctrl-C, SIGTERM,
SIGHUP and SIGQUIT are one: what a verb keeps is written, with the verb's status;
where there is nothing to keep, the status is 128 and the signal's number.
"""


class Verbs(Menu):
    """A group whose commands are imported when they are needed."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Run the command; called without arguments it is what the process is for."""
        alone = not (args or kwargs)
        if alone:
            streams.keep()
        with interrupts.taken(alone):
            return super().main(*args, **kwargs)

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(PLACES)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        return load(PLACES[cmd_name]) if cmd_name in PLACES else None

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the verb that the words begin with, or say what to type for a former one."""
        if args[0] in FORMER:
            ctx.fail(f"no verb {args[0]!r} any more; type: {FORMER[args[0]]}")
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: click.Context) -> Any:
        """Do what the verb does, and say last what it could not write: exit status 4.

        Whatever it reads and cannot use ends it with exit status 2, an interruption that it does
        not answer for with the signal's.
        """
        lost: list[str] = ctx.meta.setdefault(LOST, [])
        try:
            super().invoke(ctx)
        except (SystemExit, click.exceptions.Exit):
            if not lost:
                raise
        except BadFile as error:
            raise BadInput(escaped(str(error))) from None
        except click.NoSuchOption as error:
            former = f"{error.ctx.info_name if error.ctx else ''} {error.option_name}"
            if former in FORMER:
                raise click.UsageError(f"{former} is now: {FORMER[former]}", error.ctx) from None
            vars(error)["message"] = escaped(error.message)
            raise
        except click.ClickException as error:
            vars(error)["message"] = escaped(error.message)
            raise
        except OSError as error:
            if error.errno not in FULL:
                raise
            lost.append(f"standard output: {error.strerror}")
        except KeyboardInterrupt:
            say("raycert: interrupted", err=True)
            raise SystemExit(interrupts.status()) from None
        finally:
            for what in lost:
                say(f"raycert: not written: {what}", err=True)
        if lost:
            flush()
            raise SystemExit(NOT_WRITTEN)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the verbs and what they do, importing none of them."""
        for title, verbs in VERBS.items():
            with formatter.section(title):
                formatter.write_dl([(f"{verb:10}", text) for verb, (_, text) in verbs.items()])


def load(place: str) -> click.Command:
    """Return the command at `module:function` of this chapter."""
    module, _, function = place.partition(":")
    found = import_module(f"raycert.oracle.commands.{module}")
    command: click.Command = getattr(found, function or module)
    return command


@click.group(cls=Verbs, epilog=EPILOG, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="raycert", message="raycert %(version)s")
def main(**_: Any) -> None:
    """Certify ray/solid intersection against exact answers.

    A ray f(t) = u + t v meets a solid in intervals [(enter, leave), ...]. raycert knows them
    exactly, grades what an implementation answers, and shows where it goes wrong.
    """
