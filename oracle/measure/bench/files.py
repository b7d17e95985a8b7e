"""What a run of `bench` leaves behind: rows as JSON and CSV, a plot for each scenario.

Beside the figures stand the machine, the versions and the seed: times travel as ratios only.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Iterable
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from raycert.oracle.certify.environment import environment
from raycert.oracle.measure.bench.rows import as_csv
from raycert.oracle.measure.bench.run import Report

FORM = 1
"""The version of the form of the JSON file."""
PACKAGES = {
    "numpy": "numpy",
    "numba": "numba",
    "mpmath": "mpmath",
    "sympy": "sympy",
    "trimesh": "trimesh",
    "embreex": "embreex",
    "matplotlib": "matplotlib",
}
"""Distributions that figures depend on, by what they are called here."""


def as_json(report: Report) -> dict[str, Any]:
    """Return the report as plain data."""
    return {
        "bench": FORM,
        "seed": report.seed,
        "interrupted": report.interrupted,
        "effort": asdict(report.effort),
        "environment": surroundings(),
        "notes": report.notes,
        "rows": [row.as_json() for row in report.rows],
    }


def surroundings() -> dict[str, Any]:
    """Return the tool, the machine, its load, and the versions of what computes."""
    load = os.getloadavg() if hasattr(os, "getloadavg") else ()
    return {
        **environment(),
        "processor": processor(),
        "load": [round(x, 2) for x in load],
        "packages": dict(_versions(PACKAGES.items())),
        "long_double_bits": _long_double_bits(),
    }


def processor() -> str:
    """Return the model of the processor as the system names it."""
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
            models = [line.partition(":")[2].strip() for line in lines if "model name" in line]
    except OSError:
        models = []
    return models[0] if models else platform.processor()


def _versions(names: Iterable[tuple[str, str]]) -> Iterable[tuple[str, str]]:
    for name, distribution in names:
        try:
            yield name, version(distribution)
        except PackageNotFoundError:
            continue


def _long_double_bits() -> int | None:
    """Return how many bits a long double of NumPy has, which is the platform's affair."""
    try:
        import numpy as np
    except ImportError:
        return None
    return int(np.finfo(np.longdouble).nmant) + 1


def about(report: Report, rays: int) -> str:
    """Return the line below a plot."""
    place = surroundings()
    packages = ", ".join(f"{name} {number}" for name, number in place["packages"].items())
    return (
        f"{rays} rays, seed {report.seed}; one run on {place['processor']}, Python "
        f"{place['python']}, {packages}; only ratios of times travel"
    )


def write(report: Report, folder: Path) -> tuple[list[Path], list[str]]:
    """Write all files; return their paths, and what could not be made and why."""
    data, table = folder / "bench.json", folder / "bench.csv"
    data.write_text(json.dumps(as_json(report), indent=1) + "\n", encoding="ascii")
    table.write_text(as_csv(report.rows), encoding="ascii")
    paths = [data, table]
    try:
        from raycert.oracle.plots.pareto import plot
    except ImportError as absent:
        return paths, [f"no plots: {absent.name} is not installed (pip install 'raycert[plots]')"]
    for name in report.scenarios:
        rows = report.of(name)
        paths += plot(rows, folder, f"bench-{name}", about(report, rows[0].rays))
    return paths, []
