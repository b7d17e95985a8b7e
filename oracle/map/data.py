"""A map as data: JSON with everything, CSV with a line a cell; numbers as hex floats, exactly."""

from __future__ import annotations

import csv
import io
from math import isinf
from typing import Any

from raycert.cases.protocol import Reply
from raycert.oracle.map.cells import Cell, Map
from raycert.oracle.map.legend import class_of
from raycert.oracle.map.plan import At

Json = dict[str, Any]
VERSION = 1


def to_json(found: Map) -> Json:
    """Return the map as a JSON object.

    `cells` has one object a cell, in rows from the lower left; `topology` there is a place in
    `topologies`. An infinite k or ulps is the text `inf`.
    """
    forms = list(dict.fromkeys(c.topology for _, c in _rows(found) if c.topology is not None))
    number = {form: i for i, form in enumerate(forms)}
    plan, hello = found.plan, found.hello
    return {
        "map": VERSION,
        "case": plan.inputs.form,
        "precision": plan.inputs.format.name,
        "show": found.show,
        "target": hello.name if hello else None,
        "unit": plan.unit,
        "step": float(plan.step),
        "half": plan.half,
        "axes": {name: dict(_weights(found, name)) for name in ("x", "y")},
        "whole": found.whole,
        "topologies": [
            {"label": form.label, "pairs": form.pairs, "kinds": list(form.kinds)} for form in forms
        ],
        "cells": [_cell(found, at, cell, number) for at, cell in _rows(found)],
    }


def _rows(found: Map) -> list[tuple[At, Cell]]:
    return sorted(found.cells.items(), key=lambda item: (item[0][1], item[0][0]))


def _weights(found: Map, name: str) -> list[tuple[str, float]]:
    direction = found.plan.x if name == "x" else found.plan.y
    return [(path, float(weight)) for path, weight in direction.terms]


def _cell(found: Map, at: At, cell: Cell, number: dict[Any, int]) -> Json:
    values = {path: x.hex() for path, x in found.plan.values(at).items()}
    form: Json = {"x": at[0], "y": at[1], "inputs": values}
    if cell.topology is None:
        return form | {"refused": cell.refused}
    form |= {"topology": number[cell.topology], "expected": _pairs(cell.expected)}
    if cell.outcome is not None:
        form |= {"answer": _answer(cell)}
    if cell.value is not None:
        form["value"] = "inf" if isinf(cell.value) else cell.value
    elif cell.outcome is not None:
        form["class"] = class_of(cell)
    return form


def _pairs(pairs: Any) -> list[list[str]]:
    return [[float(x).hex() for x in pair] for pair in pairs]


def _answer(cell: Cell) -> Any:
    """Return what was answered: pairs, a first hit, a yes or no, or why nothing."""
    outcome = cell.outcome
    if not isinstance(outcome, Reply) or outcome.unsupported or outcome.error:
        return {"failure": cell.says}
    if outcome.intervals is not None:
        return {"intervals": _pairs(outcome.intervals)}
    if outcome.hit is not None:
        return {"hit": outcome.hit}
    return {"first": None if outcome.first is None else outcome.first.hex()}


def to_csv(found: Map) -> str:
    """Return the map as CSV: places, moved inputs, the exact form, the class or the number."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    paths = found.plan.paths
    writer.writerow(("x", "y", *paths, "pairs", "topology", "kinds", found.show, "refused"))
    for at, cell in _rows(found):
        values, form = found.plan.values(at), cell.topology
        shown = class_of(cell) if cell.value is None else f"{cell.value:.17g}"
        exact = (form.pairs, form.label, " + ".join(form.kinds)) if form else ("", "", "")
        inputs = (values[path].hex() for path in paths)
        writer.writerow((*at, *inputs, *exact, "" if cell.refused else shown, cell.refused))
    return text.getvalue()
