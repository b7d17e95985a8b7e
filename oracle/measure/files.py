"""What a measurement leaves behind: rows as JSON and CSV, with the machine, versions and seed.

Times travel to another machine as ratios only, so that the machine stands beside every figure.
"""

from __future__ import annotations

import csv
import io
import os
import platform
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from importlib.metadata import PackageNotFoundError, version
from math import isfinite
from typing import Any

from raycert.oracle.certify.environment import environment

Row = Mapping[str, Any]
FORM = 1
"""The version of the form of bench.json."""
PACKAGES = ("numpy", "numba", "mpmath", "sympy", "python-flint", "raysect", "mujoco", "trimesh",
            "embreex", "matplotlib")  # fmt: skip
"""Distributions that figures depend on."""


@dataclass(frozen=True, slots=True)
class Effort:
    """How much is measured.

    Of the race: rays of a set, how many of them have a backward error, passes, seconds of a way.
    Of the other sections: lanes of a batch, pixels that libraries cast, pixels of a picture, the
    largest number of solids, questions through the pipe.
    """

    rays: int = 200
    sample: int = 200
    passes: int = 7
    seconds: float = 3.0
    lanes: int = 200_000
    cast: tuple[int, int] = (200, 100)
    picture: tuple[int, int] = (160, 120)
    solids: int = 1000
    questions: int = 20_000


FULL = Effort()
QUICK = Effort(40, 16, 3, 0.3, 20_000, (80, 50), (64, 48), 100, 2_000)


@dataclass
class Report:
    """The rows so far, by section, and what is to be said of them."""

    seed: int
    effort: Effort
    sections: dict[str, list[Any]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    interrupted: bool = False

    def rows(self, name: str) -> list[Any]:
        return [row for row in self.sections.get("methods", ()) if row.scenario == name]

    def sets(self) -> list[str]:
        return list(dict.fromkeys(row.scenario for row in self.sections.get("methods", ())))

    def as_json(self) -> dict[str, Any]:
        """Return the report as plain data: `rows` of the race of methods, and other sections."""
        data = {name: [_plain(row) for row in rows] for name, rows in self.sections.items()}
        return {
            "bench": FORM,
            "seed": self.seed,
            "interrupted": self.interrupted,
            "effort": asdict(self.effort),
            "environment": surroundings(),
            "notes": self.notes,
            "rows": data.pop("methods", []),
            "sections": data,
        }


def _plain(row: Any) -> Row:
    plain: Row = row if isinstance(row, Mapping) else row.as_json()
    return plain


def surroundings() -> dict[str, Any]:
    """Return the tool, the machine, its load, and the versions of what computes."""
    packages = {}
    for name in PACKAGES:
        try:
            packages[name] = version(name)
        except PackageNotFoundError:
            continue
    load = os.getloadavg() if hasattr(os, "getloadavg") else ()
    return {
        **environment(),
        "processor": processor(),
        "load": [round(x, 2) for x in load],
        "packages": packages,
        "long_double_bits": _long_double_bits(),
    }


def processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
            models = [line.partition(":")[2].strip() for line in lines if "model name" in line]
    except OSError:
        models = []
    return models[0] if models else platform.processor()


def _long_double_bits() -> int | None:
    """Return how many bits a long double of NumPy has, which is the platform's affair."""
    try:
        import numpy as np
    except ImportError:
        return None
    return int(np.finfo(np.longdouble).nmant) + 1


def place(seed: int) -> str:
    here = surroundings()
    packages = ", ".join(f"{name} {number}" for name, number in here["packages"].items())
    return (
        f"seed {seed}; one run on {here['processor']}, Python {here['python']}, {packages}; "
        "only ratios of times travel"
    )


def finite(row: Row) -> dict[str, Any]:
    """Return a row with null for what is infinite."""
    return {
        name: None if isinstance(value, float) and not isfinite(value) else value
        for name, value in row.items()
    }


def as_csv(rows: Iterable[Any], names: Sequence[str] = ()) -> str:
    """Return rows as a table with one header line; empty is infinite, or not measured.

    `names` is the header where there is no row.
    """
    flat = [_flat(_plain(row)) for row in rows]
    text = io.StringIO()
    writer = csv.DictWriter(text, list(flat[0]) if flat else names, lineterminator="\n")
    if flat or names:
        writer.writeheader()
    writer.writerows(flat)
    return text.getvalue()


def _flat(row: Row) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in row.items():
        inner = value if isinstance(value, Mapping) else None
        flat |= {name: value} if inner is None else {f"{name}_{k}": x for k, x in inner.items()}
    return flat
