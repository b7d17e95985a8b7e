"""The case table as a run met it: for each row of the seed's tables, how its cases fared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from raycert.cases.levels import Level
from raycert.cases.model import type_of
from raycert.cases.table import PROBLEM_1, PROBLEM_2, Row, cells, pairs_of_rows
from raycert.oracle.certify.grading import Grade
from raycert.oracle.certify.verdict import Tally

Json = dict[str, Any]


def case_table(grades: Sequence[Grade], level: Level) -> Json:
    """Return the state of each row of the case table on a level; the range tier is left out.

    `infinite_cylinder` has the rows of Problem 1, `slab` those of Problem 2, `cylinder` the pairs
    of both. `cells` counts the pairs told apart by the comparisons of Problem 3.
    """
    found = {
        name: [g for g in grades if g.row.tier != "range" and type_of(g.row.solid) == name]
        for name in ("infinite_cylinder", "slab", "cylinder")
    }

    def state(solid: str, rows: tuple[str, ...]) -> Json:
        return _state(lambda g: g.row.rows[: len(rows)] == rows, found[solid], level)

    return {
        "infinite_cylinder": [_row(r, state("infinite_cylinder", (r.name,))) for r in PROBLEM_1],
        "slab": [_row(r, state("slab", (r.name,))) for r in PROBLEM_2],
        "cylinder": [{"rows": list(two), **state("cylinder", two)} for two in pairs_of_rows()],
        "cells": {
            "reachable": len(cells()),
            "tested": len({g.row.rows for g in found["cylinder"]} & set(cells())),
        },
    }


def _row(row: Row, state: Json) -> Json:
    condition = ", ".join(f"{quantity} {relation}" for quantity, relation in row.condition)
    return {"rows": [row.name], "condition": condition, "pairs": row.pairs, **state}


def _state(among: Callable[[Grade], bool], grades: Sequence[Grade], level: Level) -> Json:
    here = [g for g in grades if among(g)]
    tally = Tally.of(here, level)
    failing = (g.row.id for g in here if g.fault(level))
    return {
        "passed": tally.passed,
        "failed": tally.failed,
        "not_decisive": tally.not_decisive,
        "first_failing": next(failing, None),
    }
