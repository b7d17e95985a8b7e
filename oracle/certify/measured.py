"""The errors of what fails, which is shown with them; on all cores where that is much to do.

What is measured, and in which order it comes, does not depend on the cores.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import replace

from raycert.cases.workers import Workers
from raycert.oracle.certify.grading import MEASURED, Grade
from raycert.oracle.judge.answer import Claim
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import Measure

MANY = 2000
"""Failures from which on processes are started: a second of work; they take a third to start."""
CHUNK = 64


def measured(grades: Sequence[Grade]) -> Iterator[Grade]:
    """Yield the grades in their order, each that fails with its errors."""
    failing = [g for g in grades if g.faults and g.said is not None]
    if len(failing) < MANY or cores() < 2:
        yield from map(_measured_here, grades)
        return
    with Workers(cores()) as pool:
        judges, claims = [replace(g.judge) for g in failing], [g.said for g in failing]
        found = pool.map(_errors, judges, claims, chunksize=CHUNK)
        for g in grades:
            if g.faults and g.said is not None:
                with suppress(BrokenProcessPool):  # the rest is then measured here
                    if errors := next(found, None):
                        g.take(*errors)
            yield _measured_here(g)


def cores() -> int:
    """Return on how many cores this process may run."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _measured_here(grade: Grade) -> Grade:
    if grade.faults:
        grade.measure()
    return grade


def _errors(judge: Judge, said: Claim) -> tuple[dict[Measure, int], float]:
    strict, squared = (said.bracket(judge, measure) for measure in MEASURED)
    squared.at_most(strict.least)
    return {"strict": strict.least, "squared": squared.least}, said.forward_error(judge)
