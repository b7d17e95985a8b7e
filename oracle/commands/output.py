"""Where a command writes: refused before the work, rather than found out after it."""

from __future__ import annotations

import tempfile
from pathlib import Path

import click


def check_writable(folder: Path, option: str) -> None:
    """Make the folder if it is missing; refuse the option if no file can be written there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise click.BadParameter(f"cannot write to {folder}: {error}", param_hint=option) from None
