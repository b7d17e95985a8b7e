"""Standard streams that never fail a command.

What is written to a closed one, or to a pipe whose reader has gone, goes nowhere. So a verdict
keeps its exit status, and its files are written, whoever stopped listening.
"""

from __future__ import annotations

import contextlib
import os
import sys
from io import BufferedWriter, FileIO, TextIOWrapper
from typing import Any, TextIO

GONE: set[int] = set()
"""The descriptors whose readers have gone."""


class _Pipe(FileIO):
    """A descriptor that turns to the null device once its reader has gone."""

    def write(self, data: Any, /) -> int:
        try:
            return super().write(data)
        except BrokenPipeError:
            GONE.add(self.fileno())
            _to_nowhere(self.fileno())
            return super().write(data)


def keep() -> None:
    """Make the three streams of this process such ones."""
    for descriptor in range(3):
        with contextlib.suppress(OSError):  # there is no null device
            try:
                os.fstat(descriptor)
            except OSError:
                _to_nowhere(descriptor)
    if os.name == "posix":
        sys.stdin = sys.stdin or open(0, encoding="utf-8", closefd=False)  # noqa: SIM115
        sys.stdout = _kept(sys.stdout, 1)
        sys.stderr = _kept(sys.stderr, 2)


def _kept(stream: TextIO | None, descriptor: int) -> TextIO:
    encoding, errors, by_line = "utf-8", "backslashreplace", descriptor == 2
    if stream is not None:
        encoding, errors = stream.encoding, stream.errors or errors
        by_line = by_line or stream.isatty()
    pipe = _Pipe(descriptor, "w", closefd=False)
    return TextIOWrapper(BufferedWriter(pipe), encoding, errors, line_buffering=by_line)


def _to_nowhere(descriptor: int) -> None:
    nowhere = os.open(os.devnull, os.O_RDWR)
    if nowhere != descriptor:
        os.dup2(nowhere, descriptor)
        os.close(nowhere)
