"""The catalogue: every golden family, degenerate cases apart from all others.

A degenerate case of a mixed table goes to a family of such cases, under a longer slug.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

from raycert.cases.case import Case, Family
from raycert.cases.degenerate import degenerate
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
from raycert.cases.formats import Format
from raycert.cases.model import Sphere, Tree

WRITTEN: tuple[Family, ...] = (
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
)
APART = ("zero-direction", "csg-rest", "zero-radius", "sphere-point")
"""The families of degenerate cases: of leaves and of trees, of leaves and trees and of spheres."""


def home(case: Case) -> str | None:
    """Return the family that a degenerate case belongs to, None for any other case."""
    match degenerate(case.solid, case.ray):
        case ():
            return None
        case ("zero_direction", *_):
            return "csg-rest" if isinstance(case.solid, Tree) else "zero-direction"
    return "sphere-point" if isinstance(case.solid, Sphere) else "zero-radius"


@cache
def _apart(fmt: Format) -> dict[str, tuple[Case, ...]]:
    """Return the cases of the families of `APART`: their own, then those from mixed tables.

    What a family asks already is not asked again.
    """
    own = {family.name: tuple(family.cases(fmt)) for family in WRITTEN if family.name in APART}
    found = {name: {_question(case): case for case in cases} for name, cases in own.items()}
    for family in WRITTEN:
        for case in () if family.name in own else family.cases(fmt):
            if place := home(case):
                moved = replace(case, slug=f"{family.name}-{case.slug}")
                found[place].setdefault(_question(case), moved)
    return {name: tuple(cases.values()) for name, cases in found.items()}


def _question(case: Case) -> str:
    """Return the numbers of a case; -0 is another than 0."""
    return repr((case.solid, case.ray))


def _unmixed(family: Family) -> Family:
    def cases(fmt: Format) -> Iterator[Case]:
        if family.name in APART:
            yield from _apart(fmt)[family.name]
        else:
            yield from (case for case in family.cases(fmt) if home(case) is None)

    return Family(family.name, family.reason, cases)


FAMILIES: tuple[Family, ...] = (*map(_unmixed, WRITTEN), *adopted.FAMILIES)
