"""The report as data: JSON for programs, CSV for tables. A number that no k accepts is null.

Steps are given as text, exactly (1e-7, 2^-53), and as the nearest double.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from fractions import Fraction
from math import isfinite
from typing import Any

from raycert.oracle.certify.environment import environment
from raycert.oracle.measure.stress.causes import Cause
from raycert.oracle.measure.stress.ranges import Range, Ranges, spelled
from raycert.oracle.measure.stress.run import Report
from raycert.oracle.measure.stress.sagitta import CASTERS, Sides, slope
from raycert.oracle.measure.stress.sweeps import Sweep

FORMAT = 1
Row = dict[str, Any]
KEY = ("sweep", "step", "value", "method")


def form(report: Report, sides: Sequence[Sides] = ()) -> dict[str, Any]:
    """Return the whole report as a JSON value."""
    plan = report.plan
    return {
        "format": FORMAT,
        "about": "backward error k, forward error and wrong counts against stiffness",
        "environment": environment(),
        "seed": plan.seed,
        "quick": plan.quick,
        "samples": plan.count,
        "complete": not report.interrupted,
        "methods": [{"name": m.name, "does": m.does, "family": m.family} for m in plan.methods],
        "sweeps": [_sweep(report, sweep) for sweep in plan.sweeps],
        "ranges": list(range_rows(report)),
        "rows": list(rows(report)),
        "meshes": _meshes(sides),
    }


def _sweep(report: Report, sweep: Sweep) -> Row:
    grounds = report.grounds.get(sweep.name, {})
    steps = [x for x in report.plan.steps(sweep) if x in grounds]
    return {
        "name": sweep.name,
        "title": sweep.title,
        "parameter": sweep.axis,
        "mild": sweep.text(sweep.mild),
        "samples": report.plan.count * sweep.weight,
        "steps": [_step(sweep, x) | _finite(asdict(grounds[x])) for x in steps],
    }


def _step(sweep: Sweep, x: Fraction) -> Row:
    return {"step": sweep.text(x), "value": float(x)}


def _finite(fields: Row) -> Row:
    """Return fields with null for what is infinite."""
    return {
        name: None if isinstance(value, float) and not isfinite(value) else value
        for name, value in fields.items()
    }


def rows(report: Report) -> Iterator[Row]:
    """Yield one row for each sweep, method and step that is known, in the order of the plan."""
    for sweep in report.plan.sweeps:
        for method in report.plan.methods:
            curve = report.curve(sweep.name, method.name)
            for x in (x for x in sweep.steps if x in curve):
                about = {"sweep": sweep.name, **_step(sweep, x), "method": method.name}
                floor = _finite({"condition": report.grounds[sweep.name][x].floor})
                yield about | _finite(asdict(curve[x])) | floor


def range_rows(report: Report) -> Iterator[Row]:
    """Yield the ranges and causes of each sweep and method whose curve is whole."""
    for sweep in report.plan.sweeps:
        for method in report.plan.methods:
            ranges = report.ranges(sweep, method.name)
            if ranges is not None:
                causes = report.causes.get((sweep.name, method.name), [])
                yield {"sweep": sweep.name, "method": method.name} | _ranges(ranges, sweep, causes)


def _ranges(ranges: Ranges, sweep: Sweep, causes: Sequence[Cause]) -> Row:
    levels = {"stable": ranges.stable, "sound": ranges.sound, "exact": ranges.exact}
    return {level: _range(found, sweep) for level, found in levels.items()} | {
        "causes": [_cause(cause, sweep) for cause in causes]
    }


def _range(found: Range, sweep: Sweep) -> Row:
    return {
        "text": spelled(found, sweep),
        "low": None if found.low is None else sweep.text(found.low),
        "high": None if found.high is None else sweep.text(found.high),
        "whole": found.whole,
        "breaks_at": [sweep.text(x) for x in found.broken],
    }


def _cause(cause: Cause, sweep: Sweep) -> Row:
    return {
        "at": sweep.text(cause.step),
        "cause": cause.text,
        "told_by": cause.told_by,
        "broken": cause.count,
        "restored": dict(cause.evidence),
    }


def _meshes(sides: Sequence[Sides]) -> Row:
    slopes = {caster: slope(sides, caster) for caster in CASTERS}
    return {"slopes": _finite(slopes), "rows": [_finite(asdict(one)) for one in sides]}


def table(report: Report) -> str:
    """Return the rows as CSV, with an empty field for null."""
    found = list(rows(report))
    names = list(found[0]) if found else list(KEY)
    text = io.StringIO()
    writer = csv.DictWriter(text, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(found)
    return text.getvalue()


def causes_text(report: Report, sweep: Sweep, method: str) -> str:
    """Return the causes of a method on a sweep in a few words, each once."""
    causes = report.causes.get((sweep.name, method), [])
    return "; ".join(dict.fromkeys(cause.text for cause in causes))


def notes(report: Report, names: Sequence[str]) -> list[str]:
    """Return what breaks, in lines for people: sweep, methods, where they are stable, and why."""
    found: dict[tuple[str, str, str], list[str]] = {}
    for sweep in report.plan.sweeps:
        for name in names:
            ranges = report.ranges(sweep, name)
            if ranges and not ranges.stable.whole:
                where, why = spelled(ranges.stable, sweep), causes_text(report, sweep, name)
                found.setdefault((sweep.title, where, why), []).append(name)
    return [
        f"{title}: {', '.join(methods)} stable {where}" + (f"; {why}" if why else "")
        for (title, where, why), methods in found.items()
    ]
