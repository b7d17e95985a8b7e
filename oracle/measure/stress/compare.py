"""Where an implementation sits: its curves beside the reference, the textbook and the oracle.

For certificates: one quick run of all sweeps, as data and as one picture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from raycert.oracle.client.dialogue import Target
from raycert.oracle.measure.methods.catalog import by_name
from raycert.oracle.measure.methods.method import Method
from raycert.oracle.measure.methods.programs import client
from raycert.oracle.measure.stress.report import form, notes
from raycert.oracle.measure.stress.run import Plan, Report, run

BESIDE = ("reference", "textbook", "oracle")


@dataclass(frozen=True)
class Compared:
    """The data of a comparison, and its picture as SVG: None without matplotlib."""

    form: dict[str, Any]
    svg: str | None


def plan(name: str, target: Target, seed: int, quick: bool, workers: int = 2) -> Plan:
    """Return the plan of a comparison. Raises `Unusable` if the target cannot be compared."""
    beside: tuple[Method, ...] = tuple(map(by_name, BESIDE))
    return Plan((client(name, target), *beside), seed=seed, quick=quick, workers=workers)


def compare(
    name: str,
    target: Target,
    *,
    seed: int = 1,
    quick: bool = True,
    advance: Callable[..., None] = lambda: None,
) -> Compared:
    """Return how a target stands under stress; what is known by then if interrupted.

    `advance()` is called `plan(...).total` times. Raises `Unusable` if the target cannot be
    started, or answers no interval lists.
    """
    report = run(plan(name, target, seed, quick), advance)
    return Compared(form(report), picture(report))


def picture(report: Report) -> str | None:
    """Return the picture of a report as SVG; None without matplotlib."""
    try:
        plots = import_module("raycert.oracle.plots.sweeps")
    except ModuleNotFoundError as absent:
        if absent.name != "matplotlib":
            raise
        return None
    names = [method.name for method in report.plan.methods]
    drawn: str = plots.svg(report, names, notes=notes(report, names))
    return drawn
