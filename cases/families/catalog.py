"""The catalogue: every golden family."""

from __future__ import annotations

from raycert.cases.case import Family
from raycert.cases.families import (
    adopted,
    base_rate,
    bodies,
    case_table,
    far,
    lists,
    reports,
    reports_solids,
    scale,
    starts,
    touch,
)

FAMILIES: tuple[Family, ...] = (
    *case_table.FAMILIES,
    *touch.FAMILIES,
    *starts.FAMILIES,
    *far.FAMILIES,
    *scale.FAMILIES,
    *lists.FAMILIES,
    *bodies.FAMILIES,
    *base_rate.FAMILIES,
    *reports.FAMILIES,
    *reports_solids.FAMILIES,
    *adopted.FAMILIES,
)
