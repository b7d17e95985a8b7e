"""The wall time of whole commands of raycert, start-up included."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import NamedTuple

COMMANDS: tuple[tuple[str, int], ...] = (
    ("--help", 5),
    ("golden write --golden {folder}/golden", 1),
    ("certify reference --level stable --out {folder}/certificate.json", 1),
    ("certify oracle --level exact --out {folder}/certificate.json", 1),
)
"""The commands that are timed whole, and how often."""


class Whole(NamedTuple):
    """Seconds of a command: the least and the median."""

    name: str
    best: float
    median: float


def command(line: str, repeats: int) -> Whole:
    """Return the wall time of one command; `CalledProcessError` if it fails."""
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        words = line.format(folder=Path(folder).as_posix()).split()
        for _ in range(repeats):
            began = time.perf_counter()
            subprocess.run(
                [sys.executable, "-m", "raycert.oracle.commands.main", *words],
                check=True,
                capture_output=True,
            )
            seconds.append(time.perf_counter() - began)
    return Whole("raycert " + line.partition(" --")[0], min(seconds), median(seconds))
