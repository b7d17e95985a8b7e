"""How a command names an implementation: its words, the built-in ones, and what they may take."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import click

if TYPE_CHECKING:
    from raycert.oracle.client.dialogue import Limits, Target

BUILT_IN = {
    "oracle": ("-m", "raycert.oracle.commands.main", "serve", "oracle"),
    "reference": ("-m", "raycert.reference"),
}
SECONDS = click.FloatRange(min=0.01, max=86400)
Function = TypeVar("Function", bound=Callable[..., Any])

TARGETS = """\b
TARGET is one of
  reference, oracle       the built-in implementations
  -- COMMAND ARGUMENT...  a program that speaks the line protocol
  module:function         a Python callable: function(solid, ray) -> pairs
  ./tracer.so             a shared library with the signature of raycert.h
                          (raycert harness library --out DIR)
"""


def limits_options(function: Function) -> Function:
    """Add the options for what an implementation may take."""
    options = (
        ("--hello-timeout", SECONDS, 10.0, "Seconds to the hello."),
        ("--case-timeout", SECONDS, 5.0, "Seconds to an answer."),
        ("--line-limit", click.IntRange(min=256), 1 << 20, "Bytes in a line."),
    )
    for name, kind, default, text in reversed(options):
        function = click.option(name, type=kind, default=default, show_default=True, help=text)(
            function
        )
    return function


def limits(options: dict[str, Any]) -> Limits:
    """Return the limits that the options set."""
    from raycert.oracle.client.dialogue import Limits

    return Limits(options["hello_timeout"], options["case_timeout"], options["line_limit"])


def aim(words: tuple[str, ...]) -> Target:
    """Return the target that the words name; end with exit status 3 where they name none."""
    from raycert.oracle.client.dialogue import Unusable
    from raycert.oracle.client.target import target

    if len(words) == 1 and words[0] in BUILT_IN:
        words = (sys.executable, *BUILT_IN[words[0]])
    try:
        return target(words)
    except Unusable as error:
        stop(str(error))


def spelled(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return the words as a command line has to spell them: `--` before what may have options."""
    return words if len(words) == 1 and not words[0].startswith("-") else ("--", *words)


def stop(message: str) -> NoReturn:
    """End with exit status 3: the target could not be run, or nothing was tested."""
    click.echo(f"raycert: {message}", err=True)
    raise SystemExit(3)
