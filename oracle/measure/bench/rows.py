"""A row for each method and scenario: what it costs, and how wrong it is. JSON and CSV of rows."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isinf, log2
from typing import Any

from raycert.oracle.measure.bench.errors import Error, Spread
from raycert.oracle.measure.bench.timing import Time
from raycert.oracle.measure.methods.method import Method

FIGURES = ("median", "p99", "largest")
SPREADS = ("ulps", "ulps_counted", "radii_counted", "strict", "squared")


@dataclass(frozen=True)
class Row:
    """What a method did on a scenario.

    `ulps` is over all rays but right misses, infinite where there is no answer or a wrong number
    of pairs; `ulps_counted` and `radii_counted` over those with the right number alone. The
    backward errors are those of a sample of `sample` rays, misses too. `ratio` is the time over
    that of the oracle, of the same run.
    """

    scenario: str
    method: Method
    time: Time
    rays: int
    exact: int
    wrong: int
    missed: int
    phantom: int
    failures: int
    ulps: Spread | None
    ulps_counted: Spread | None
    radii_counted: Spread | None
    strict: Spread | None
    squared: Spread | None
    sample: int
    ratio: float | None = None
    front: bool = False

    @property
    def lost(self) -> int:
        """Return how many rays have no answer, or a wrong number of pairs."""
        return self.wrong + self.failures

    def as_json(self) -> dict[str, Any]:
        """Return the row as plain data; null is infinite, or not measured."""
        t = self.time
        return {
            "scenario": self.scenario,
            "method": self.method.name,
            "does": self.method.does,
            "family": self.method.family,
            "rays": self.rays,
            "seconds_per_ray": {
                "min": t.best,
                "median": t.median,
                "iqr": t.iqr,
                "passes": t.passes,
                "rays_per_pass": t.rays,
            },
            "ratio_to_oracle": self.ratio,
            "correctly_rounded": self.exact,
            "wrong_counts": self.wrong,
            "missed_pairs": self.missed,
            "phantom_pairs": self.phantom,
            "failures": self.failures,
            **{name: _spread(getattr(self, name)) for name in SPREADS},
            "bits": _bits(self.ulps),
            "bits_counted": _bits(self.ulps_counted),
            "backward_sample": self.sample,
            "pareto": self.front,
        }


def row(
    scenario: str,
    method: Method,
    time: Time,
    errors: Sequence[Error],
    backward: tuple[Sequence[float], Sequence[float]] = ((), ()),
) -> Row:
    """Return the row of a method from its errors, and the strict and squared k of a sample."""
    telling = [e for e in errors if not e.idle]
    counted = [e for e in telling if e.counts]
    return Row(
        scenario=scenario,
        method=method,
        time=time,
        rays=len(errors),
        exact=sum(e.exact for e in errors),
        wrong=sum(bool(e.missed or e.phantom) for e in errors),
        missed=sum(e.missed for e in errors),
        phantom=sum(e.phantom for e in errors),
        failures=sum(e.failed for e in errors),
        ulps=Spread.of([e.ulps for e in telling]),
        ulps_counted=Spread.of([e.ulps for e in counted]),
        radii_counted=Spread.of([e.radii for e in counted]),
        strict=Spread.of(backward[0]),
        squared=Spread.of(backward[1]),
        sample=len(backward[0]),
    )


def pareto(points: Sequence[tuple[float, float]]) -> list[bool]:
    """Tell which (time, error) no other beats: none as cheap and better, nor as good and cheaper.

    What has an infinite error is on no front.
    """
    return [
        b < inf and not any(c <= a and d <= b and (c, d) != (a, b) for c, d in points)
        for a, b in points
    ]


def as_csv(rows: Sequence[Row]) -> str:
    """Return the rows as a table with one header line; empty is infinite, or not measured."""
    text = io.StringIO()
    flat = [_flat(r.as_json()) for r in rows]
    if not flat:
        return ""
    writer = csv.DictWriter(text, list(flat[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(flat)
    return text.getvalue()


def _flat(data: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in data.items():
        if isinstance(value, dict):
            found |= {f"{name}_{key}": inner for key, inner in value.items()}
        else:
            found[name] = value
    return found


def _spread(spread: Spread | None) -> dict[str, float | None]:
    return {
        name: None if spread is None or isinf(x := getattr(spread, name)) else x for name in FIGURES
    }


def _bits(spread: Spread | None) -> dict[str, float | None]:
    """Return the same in bits of error, log2(1 + ulps)."""
    return {name: None if x is None else log2(1 + x) for name, x in _spread(spread).items()}
