"""What is said of a map: classes in order, curves between forms, words, and all of it as data.

The data are JSON with everything, or CSV with a line a cell; numbers as hex floats, exactly.
"""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Collection, Iterator
from math import inf, isinf
from textwrap import wrap
from typing import Any

from raycert.cases.protocol import Reply
from raycert.oracle.client.dialogue import silence
from raycert.oracle.map.raster import At
from raycert.oracle.map.sampling import KINDS, NUMBERS, ORDER, Cell, Kind, Map, between

Corner = tuple[int, int]
"""A corner of cells: (i, j) is the lower left one of the cell (i, j)."""
Edge = tuple[Corner, Corner]
Json = dict[str, Any]
VERSION = 1
"""Of the JSON form."""


def class_of(cell: Cell) -> str:
    """Return the class of a cell, without the particulars of a failure; empty for a number."""
    if cell.refused:
        return "no valid case"
    head = cell.says.partition(":")[0]
    if cell.topology is not None and cell.says == cell.topology.label:
        return cell.says
    return head if head == cell.says else f"no answer: {head}"


def classes(found: Map) -> list[tuple[str, int]]:
    counts = Counter(name for name in map(class_of, found.cells.values()) if name)

    def place(name: str) -> tuple[int, int, str]:
        if name == "no valid case" or name.startswith("no answer"):
            return (len(ORDER) + 1, 0, name)
        return (ORDER.index(name) if name in ORDER else len(ORDER), pairs_of(name), name)

    return [(name, counts[name]) for name in sorted(counts, key=place)]


def pairs_of(name: str) -> int:
    """Return how many pairs a class has, read from its name; a hit counts as one."""
    first, _, _ = name.partition(" ")
    return int(first) if first.isdigit() else 0 if first == "no" else 1


def thin(found: Map) -> dict[At, Kind]:
    """Return the cells that lie on a degeneracy exactly, where those form no area but a line.

    An area is a square of four cells that meet the same; there the form is what is usual.
    """
    forms = {at: cell.topology for at, cell in found.cells.items() if cell.topology}
    met = {at: form.kinds[0] for at, form in forms.items() if form.kinds}

    def fills(i: int, j: int) -> bool:
        square = {met.get(at) for at in ((i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1))}
        return len(square) == 1 and None not in square

    return {
        (i, j): kind
        for (i, j), kind in met.items()
        if not any(fills(a, b) for a in (i - 1, i) for b in (j - 1, j))
    }


def edges(found: Map) -> dict[Kind, list[Edge]]:
    """Return the edges between cells of different exact forms, by what lies there.

    Those of `thin` cells are left out: there the curve goes through the cells.
    """
    by_kind: dict[Kind, list[Edge]] = {kind: [] for kind in KINDS}
    line = thin(found)
    plain = {at: c.topology for at, c in found.cells.items() if c.topology and at not in line}
    for (i, j), form in plain.items():
        for beside in ((i + 1, j), (i, j + 1)):
            other = plain.get(beside)
            if other and (kind := between(form, other)):
                by_kind[kind].append((beside, (i + 1, j + 1)))
    return {kind: found for kind, found in by_kind.items() if found}


def links(places: Collection[At]) -> list[Edge]:
    """Return the pairs of cells that touch: at a side, or at a corner where no side leads on."""
    found = list[Edge]()
    for i, j in places:
        found += (((i, j), at) for at in ((i + 1, j), (i, j + 1)) if at in places)
        for up in (1, -1):
            corners = (i + 1, j), (i, j + up)
            if (i + 1, j + up) in places and not any(at in places for at in corners):
                found.append(((i, j), (i + 1, j + up)))
    return found


def lines(edges: list[Edge]) -> list[list[Corner]]:
    """Return edges joined to lines, each edge in one of them once; ends of lines come first."""
    at: dict[Corner, list[Corner]] = {}
    for a, b in edges:
        at.setdefault(a, []).append(b)
        at.setdefault(b, []).append(a)
    joined = []
    for start in sorted(at, key=lambda corner: (len(at[corner]) % 2 == 0, corner)):
        while at[start]:
            line = [start]
            while at[here := line[-1]]:
                there = at[here].pop(0)
                at[there].remove(here)
                line.append(there)
            joined.append(line)
    return joined


def extremes(found: Map) -> tuple[float, float] | None:
    """Return the least and the largest finite number of a map; None if there is none."""
    values = [c.value for c in found.cells.values() if c.value is not None and not isinf(c.value)]
    return (min(values), max(values)) if values else None


def summary(found: Map) -> Iterator[str]:
    total, cells = len(found.raster.places), found.cells.values()
    yield f"{len(cells)} of {total} cells" + ("" if found.whole else "; interrupted")
    for name, count in classes(found):
        yield f"  {count:6}  {name}"
    if found.show in NUMBERS:
        ends = extremes(found)
        if ends:
            yield f"  {found.show} from {ends[0]:.3g} to {ends[1]:.3g}"
        if endless := sum(cell.value == inf for cell in cells):
            yield f"  {endless:6}  {endless_text(found)}"
    on, along = Counter(thin(found).values()), edges(found)
    for kind in KINDS:
        if on[kind] or kind in along:
            beside = len(along.get(kind, ()))
            yield f"  curve: {kind}, through {on[kind]} cells, between {beside} pairs of cells"


def endless_text(found: Map) -> str:
    return "no k is enough" if found.show == "k" else "another number of pairs"


def subtitle(found: Map) -> str:
    name = f" of {found.hello.name}" if found.hello else ""
    shown = {
        "exact": "exact answer: pairs, and rows of the case table or faces",
        "answer": f"the answers{name}",
        "k": f"strict backward error k of the answers{name}",
        "ulps": f"forward error in ulps of the answers{name}",
        "disagreement": f"the answers{name}, compared with the exact lists",
    }[found.show]
    left = "" if found.whole else f"; interrupted, {len(found.cells)} cells done"
    return f"{shown}{left}"


def axis_label(found: Map, name: str) -> str:
    """Return what an axis says: the inputs it moves, their values in the middle, the unit."""
    raster = found.raster
    direction = raster.x if name == "x" else raster.y
    unit = {"ulps": "ulps from", "units": "units from", "relative": "share of"}[raster.unit]
    if len(direction.terms) == 1 and direction.terms[0][1] == 1:
        path = direction.terms[0][0]
        return f"{path}, {unit} {raster.inputs[path]!r}"
    values = ", ".join(f"{path} {raster.inputs[path]!r}" for path, _ in direction.terms)
    text = f"{direction}\n{unit} {values}"
    return "\n".join(part for line in text.split("\n") for part in wrap(line, 78))


def to_json(found: Map) -> Json:
    """Return the map as a JSON object.

    `cells` has one object a cell, in rows from the lower left; `topology` there is a place in
    `topologies`. An infinite k or ulps is the text `inf`.
    """
    forms = list(dict.fromkeys(c.topology for _, c in _rows(found) if c.topology is not None))
    number = {form: i for i, form in enumerate(forms)}
    raster, hello = found.raster, found.hello
    return {
        "map": VERSION,
        "case": raster.inputs.form,
        "precision": raster.inputs.format.name,
        "show": found.show,
        "target": hello.name if hello else None,
        "unit": raster.unit,
        "step": float(raster.step),
        "half": raster.half,
        "axes": {
            name: {path: float(weight) for path, weight in getattr(raster, name).terms}
            for name in ("x", "y")
        },
        "whole": found.whole,
        "topologies": [{"label": x.label, "pairs": x.pairs, "kinds": [*x.kinds]} for x in forms],
        "cells": [_cell(found, at, cell, number) for at, cell in _rows(found)],
    }


def _rows(found: Map) -> list[tuple[At, Cell]]:
    return sorted(found.cells.items(), key=lambda item: (item[0][1], item[0][0]))


def _cell(found: Map, at: At, cell: Cell, number: dict[Any, int]) -> Json:
    values = {path: x.hex() for path, x in found.raster.values(at).items()}
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
    outcome = cell.outcome
    if outcome is None or silence(outcome):
        return {"failure": cell.says}
    assert isinstance(outcome, Reply)
    if outcome.intervals is not None:
        return {"intervals": _pairs(outcome.intervals)}
    if outcome.hit is not None:
        return {"hit": outcome.hit}
    return {"first": None if outcome.first is None else outcome.first.hex()}


def to_csv(found: Map) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    paths = found.raster.paths
    writer.writerow(("x", "y", *paths, "pairs", "topology", "kinds", found.show, "refused"))
    for at, cell in _rows(found):
        values, form = found.raster.values(at), cell.topology
        shown = class_of(cell) if cell.value is None else f"{cell.value:.17g}"
        exact = (form.pairs, form.label, " + ".join(form.kinds)) if form else ("", "", "")
        inputs = (values[path].hex() for path in paths)
        writer.writerow((*at, *inputs, *exact, "" if cell.refused else shown, cell.refused))
    return text.getvalue()
