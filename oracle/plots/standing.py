"""Where an implementation sits, for a certificate: its error against stiffness and run time.

Each is measured in one run beside the reference, the textbook and the exact oracle; the plots are
SVG texts, null without matplotlib. Neither decides anything: the levels are the corpus's to grant.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from raycert.oracle.client.dialogue import Target
from raycert.oracle.measure import curves, race
from raycert.oracle.measure.catalog import BESIDE, BY_NAME
from raycert.oracle.measure.files import QUICK, Report, place
from raycert.oracle.measure.way import Way, client

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Json = dict[str, Any]
SETS = ("random", "far")
"""Where everybody is right, and where the textbook is not."""
Counting = Callable[[str, int], Any]


def _ways(name: str, target: Target) -> tuple[Way, ...]:
    return (client(name, target), *(BY_NAME[one] for one in BESIDE))


def itinerary(name: str, target: Target) -> curves.Itinerary:
    """Return what is run for a target. Raises `Unusable` if it answers no interval lists."""
    return curves.Itinerary(_ways(name, target), quick=True)


def under_stress(name: str, target: Target, counting: Counting) -> Json:
    """Return the sweeps of a target: ranges, causes, rows and plot; what is known if interrupted.

    Raises `Unusable` if the target cannot be started, or answers no interval lists.
    """
    plan = itinerary(name, target)
    with counting("stressing", plan.total) as advance:
        stress = curves.run(plan, advance)
    names = [way.name for way in plan.ways]

    def draw() -> Figure:
        from raycert.oracle.plots.stiffness import draw

        return draw(stress, names, notes=curves.notes(stress, names))

    return {**curves.form(stress), "name": name, "svg": as_svg(draw)}


def in_time(name: str, target: Target, counting: Counting) -> Json:
    """Return the rows of error against run time of a target, with a plot for each set.

    Raises `Unusable` if the target cannot be started, or answers no interval lists.
    """
    ways, report = _ways(name, target), Report(1, QUICK)
    with counting("timing", race.steps(SETS, ways, QUICK)) as advance:
        race.run(SETS, ways, report, advance)

    def draw(one: str) -> Figure:
        from raycert.oracle.plots.pareto import draw

        return draw(report.rows(one), f"{QUICK.rays} rays, {place(report.seed)}")

    plots = {one: as_svg(lambda one=one: draw(one)) for one in report.sets()}  # type: ignore[misc]
    return {**report.as_json(), "name": name, "svg": plots}


def as_svg(draw: Callable[[], Figure]) -> str | None:
    """Return a plot as SVG; None without matplotlib."""
    try:
        from raycert.oracle.plots import style
    except ModuleNotFoundError as absent:
        if absent.name != "matplotlib":
            raise
        return None
    with style.styled():
        return style.picture(draw(), "svg").decode()
