"""Where an implementation sits, for a certificate: its error against stiffness and run time.

Each is measured in one run beside the reference, the textbook and the exact oracle; the plots are
SVG texts, null without matplotlib. Neither decides anything: the levels are the corpus's to grant.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from raycert.oracle.client.dialogue import Target

Json = dict[str, Any]
BESIDE = ("reference", "textbook", "oracle")
SCENARIOS = ("random", "far")
"""Where everybody is right, and where the textbook is not."""

Advance = Callable[..., None]
Counting = Callable[[str, int], Any]


def under_stress(name: str, target: Target, counting: Counting) -> Json:
    """Return the sweeps of a target: ranges, causes, rows and plot.

    Raises `Unusable` if the target answers no interval lists.
    """
    from raycert.oracle.measure.stress import compare

    total = compare.plan(name, target, 1, True).total
    with counting("stressing", total) as advance:
        found = compare.compare(name, target, advance=advance)
    return {**found.form, "name": name, "svg": found.svg}


def in_time(name: str, target: Target, counting: Counting) -> Json:
    """Return the rows of error against run time of a target, with a plot for each scenario.

    Raises `Unusable` if the target answers no interval lists.
    """
    from raycert.oracle.measure.bench.files import about, as_json
    from raycert.oracle.measure.bench.run import QUICK, run, steps
    from raycert.oracle.measure.methods.catalog import by_name
    from raycert.oracle.measure.methods.programs import client

    methods = [client(name, target), *map(by_name, BESIDE)]
    with counting("timing", steps(SCENARIOS, methods, QUICK)) as advance:
        report = run(SCENARIOS, methods, QUICK, advance=advance)
    plots = {one: _drawn(report.of(one), about(report, QUICK.rays)) for one in report.scenarios}
    return {**as_json(report), "name": name, "svg": plots}


def _drawn(rows: Any, about: str) -> str | None:
    """Return a plot as SVG; None without matplotlib."""
    try:
        where = "raycert.oracle.plots"
        pareto, style = (import_module(f"{where}.{name}") for name in ("pareto", "style"))
    except ModuleNotFoundError as absent:
        if absent.name != "matplotlib":
            raise
        return None
    with style.styled():
        drawn: str = style.as_svg(pareto.draw(rows, about))
    return drawn
