"""`raycert serve`: the built-in implementations behind the line protocol."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from raycert.oracle.commands import streams
from raycert.oracle.commands.options import OneOf, precision_of, statuses

if TYPE_CHECKING:
    from raycert.cases.model import Ray, Solid

EPILOG = f"""\b
oracle     the exact lists, correctly rounded
reference  the compact float64 tracer; it reads and writes decimals

\b
Examples:
  echo '{{"hello": 1}}' | raycert serve oracle
  raycert certify -- raycert serve oracle --precision binary32 --numbers bits

{statuses()}
"""


@click.command(epilog=EPILOG)
@click.argument("name", type=OneOf(("oracle", "reference")))
@precision_of("the answers")
@click.option(
    "--numbers",
    type=OneOf(("decimal", "hex", "bits")),
    default="decimal",
    show_default=True,
    help="How a number is spelled.",
)
def serve(name: str, precision: str, numbers: str) -> None:
    """Answer the line protocol on standard input and output until the input ends."""
    if name == "reference":
        if (precision, numbers) != ("binary64", "decimal"):
            raise click.UsageError("the reference speaks binary64 in decimals only")
        import subprocess

        from raycert.oracle.client.apart import ours

        raise SystemExit(subprocess.call(ours("raycert.reference")))
    _serve_oracle(precision, numbers)


def _serve_oracle(precision: str, numbers: Any) -> None:
    """Answer every case with the exact list, correctly rounded to the precision."""
    import sys
    from itertools import takewhile

    from raycert.cases.degenerate import DEGENERACIES
    from raycert.cases.formats import FORMATS
    from raycert.cases.protocol import Hello, serve
    from raycert.oracle.exact.intervals import expected
    from raycert.oracle.exact.trace import trace

    def intersect(solid: Solid, ray: Ray) -> tuple[tuple[float, float], ...]:
        return expected(trace(solid, ray).intervals, FORMATS[precision])[1]

    heard = takewhile(lambda _: 1 not in streams.GONE, sys.stdin.buffer)
    hello = Hello("raycert oracle", precision=precision, numbers=numbers, degenerate=DEGENERACIES)
    serve(intersect, hello, heard)
