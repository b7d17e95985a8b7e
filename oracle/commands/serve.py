"""`raycert serve`: the built-in implementations behind the line protocol."""

from __future__ import annotations

import click

EPILOG = """\b
oracle     the exact lists, correctly rounded
reference  the compact float64 tracer; it reads and writes decimals

\b
Try it:
  echo '{"hello": 1}' | raycert serve oracle
"""


@click.command(epilog=EPILOG)
@click.argument("name", type=click.Choice(["oracle", "reference"]))
@click.option("--precision", type=click.Choice(["binary64", "binary32"]), default="binary64")
@click.option("--numbers", type=click.Choice(["decimal", "hex", "bits"]), default="decimal")
def serve(name: str, precision: str, numbers: str) -> None:
    """Answer the line protocol on standard input and output until the input ends."""
    if name == "reference":
        if (precision, numbers) != ("binary64", "decimal"):
            raise click.UsageError("the reference speaks binary64 in decimals only")
        import subprocess
        import sys

        raise SystemExit(subprocess.call([sys.executable, "-m", "raycert.reference"]))
    from raycert.oracle.client.service import serve_oracle

    serve_oracle(precision, numbers)
