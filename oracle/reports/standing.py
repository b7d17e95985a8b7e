"""The page's part on where the subject sits: its plots, and the range of each level in each sweep.

A plot goes in as a picture of its own, so that nothing in it can touch the page.
"""

from __future__ import annotations

from base64 import b64encode
from typing import Any

from raycert.oracle.reports.text import clean

Json = dict[str, Any]


def standing(certificate: Json) -> Json:
    """Return `plots`, (what it shows, its address) each, and `sweeps`, a line for each."""
    found = certificate["standing"]
    stress, bench = found["stress"], found["bench"]
    plots = [("Backward error against stiffness", stress["svg"])] if stress else []
    if bench:
        plots += [
            (f"Error against run time, {name} rays", svg) for name, svg in bench["svg"].items()
        ]
    return {
        "plots": [(clean(title, 80), _address(svg)) for title, svg in plots if svg],
        "sweeps": [_line(row, stress) for row in stress["ranges"] if _is_mine(row, stress)]
        if stress
        else [],
    }


def _address(svg: str) -> str:
    return f"data:image/svg+xml;base64,{b64encode(svg.encode()).decode('ascii')}"


def _is_mine(row: Json, stress: Json) -> bool:
    return bool(row["method"] == stress["methods"][0]["name"])


def _line(row: Json, stress: Json) -> Json:
    """Return a sweep's title, the ranges in which two levels hold, and why they end."""
    titles = {sweep["name"]: sweep["title"] for sweep in stress["sweeps"]}
    causes = dict.fromkeys(cause["cause"] for cause in row["causes"])
    return {
        "title": clean(str(titles.get(row["sweep"])), 80),
        "stable": clean(row["stable"]["text"], 60),
        "sound": clean(row["sound"]["text"], 60),
        "whole": row["stable"]["whole"],
        "causes": clean(", ".join(causes), 200),
    }
