"""The reports: every public fault that gives enough geometry, as a named case."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.case import Case, Family
from raycert.cases.families import reports_measured, reports_parallel, reports_scale, reports_touch
from raycert.cases.formats import Format

REPORTS = (
    *reports_parallel.REPORTS,
    *reports_touch.REPORTS,
    *reports_scale.REPORTS,
    *reports_measured.REPORTS,
)


def _reports(fmt: Format) -> Iterator[Case]:
    for report in REPORTS:
        case = report.case(fmt)
        if case is not None:
            yield case


FAMILIES = (
    Family("reports", "Faults reported in public, or measured on public engines.", _reports),
)
