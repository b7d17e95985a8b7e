"""What the pipe costs: a client asked through the harness, beside the client alone over a file.

The file holds the very lines that the harness would send, and the answers go to the null device, so
the bare time is what the client itself takes: its start, its reading, its answers. Both are
measured in turn, several times over, and the minimum of each counts: machines are noisy.
"""

from __future__ import annotations

import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice

from raycert.cases.protocol import VERSION, ask, encode
from raycert.oracle.client.dialogue import Question, fresh_ids
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import greet, run

REPEATS = 5


@dataclass(frozen=True, slots=True)
class PipeTiming:
    """Seconds for the same questions: of the client alone, and through the harness."""

    bare: float
    piped: float

    @property
    def ratio(self) -> float:
        """Return how many times the bare time the harness takes."""
        return self.piped / self.bare


def time_pipe(
    command: Sequence[str], questions: Sequence[Question], repeats: int = REPEATS
) -> PipeTiming:
    """Time a client that answers every question. `ValueError` if it does not."""
    bare, piped = [], []
    lines = asked(command, questions)
    for _ in range(repeats):
        bare.append(_bare(command, lines))
        began = time.perf_counter()
        outcomes = run(command, questions).outcomes
        piped.append(time.perf_counter() - began)
        if any(isinstance(outcome, Failure) for outcome in outcomes.values()):
            raise ValueError(f"{command[0]!r} fails on some of the questions")
    return PipeTiming(min(bare), min(piped))


def asked(command: Sequence[str], questions: Sequence[Question]) -> bytes:
    """Return all that the harness would write to a client."""
    hello = greet(command)
    ids = islice(fresh_ids(), len(questions))
    lines = (
        ask(id, question.solid, question.ray, hello.numbers, hello.format)
        for id, question in zip(ids, questions, strict=True)
    )
    return b"".join((encode({"hello": VERSION}), *lines))


def _bare(command: Sequence[str], lines: bytes) -> float:
    """Return how long a client takes over a file of lines."""
    with tempfile.TemporaryFile() as file:
        file.write(lines)
        file.seek(0)
        began = time.perf_counter()
        subprocess.run(command, stdin=file, stdout=subprocess.DEVNULL, check=True)
        return time.perf_counter() - began
