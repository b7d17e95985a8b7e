"""`raycert report`: write the reports of a certificate that is there already."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from raycert.oracle.commands.output import check_writable

HELP = """Write the reports of a certificate: the same as certify's own options do.

CERTIFICATE is the JSON file that certify wrote. Without an option the report for a terminal is
printed. A FILE of - is standard output.

\b
Examples:
  raycert report certificate.json
  raycert report certificate.json --html out.html --junit out.xml
  raycert report certificate.json --markdown - >> "$GITHUB_STEP_SUMMARY"

Exit status: 0 done, 2 the file is no certificate, or bad usage.
"""
FORMS = {
    "html": "One page that needs no network.",
    "markdown": "For the summary of a CI job.",
    "junit": "JUnit XML: one test for a family.",
}


@click.command(help=HELP)
@click.argument("certificate", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--html", metavar="FILE", help=FORMS["html"])
@click.option("--markdown", metavar="FILE", help=FORMS["markdown"])
@click.option("--junit", metavar="FILE", help=FORMS["junit"])
def report(certificate: Path, **options: str | None) -> None:
    """Write the reports of a certificate."""
    wanted = {form: out for form, out in options.items() if out is not None}
    for form, out in wanted.items():
        if out != "-":
            check_writable(Path(out).parent, f"--{form}")
    read = _read(certificate)
    if wanted:
        write_reports(read, wanted)
    else:
        _print(read)


def write_reports(certificate: dict[str, Any], wanted: dict[str, str]) -> None:
    """Write a certificate in each form (a key of WRITERS) to its file; `-` is standard output."""
    from raycert.cases.corpus import write_whole
    from raycert.oracle.reports.write import WRITERS

    for form, out in wanted.items():
        text = WRITERS[form](certificate)
        if out == "-":
            click.echo(text.encode(), nl=False)
        else:
            write_whole(Path(out), text.encode())


def _read(path: Path) -> dict[str, Any]:
    import json

    from raycert.oracle.reports.form import BadCertificate, check

    try:
        return check(json.loads(path.read_bytes()))
    except BadCertificate as error:
        raise click.UsageError(f"{path}: {error}") from None
    except (ValueError, RecursionError) as error:
        raise click.UsageError(f"{path} is not JSON: {error}") from None


def _print(certificate: dict[str, Any]) -> None:
    from rich.console import Console

    from raycert.oracle.reports.terminal import report as show

    show(certificate, Console(width=None if sys.stdout.isatty() else 120), None)
