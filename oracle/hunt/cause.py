"""What tells two failures apart, once they are as simple as they get: the cause, not the digits.

The level and the kind of the failure, for an error its first words; the shape of the solid; the
rows of the case table that the exact answer takes, without the comparisons. Of failures that do not
come again only the words count.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from raycert.cases.model import Solid, Tree, type_of
from raycert.cases.numbers import Probe
from raycert.oracle.exact.trace import trace
from raycert.oracle.hunt.look import Fault

SILENT = ("error", "crash", "unsupported", "bad-line", "unrepeated")
UNREPEATED = "unrepeated"
"""The kind of a failure that does not come again in a new process."""


@dataclass(frozen=True, slots=True)
class Cause:
    """A key: failures with the same one count as one."""

    level: str
    kind: str
    words: str
    shape: str
    rows: tuple[str, ...]

    def __str__(self) -> str:
        where = f" ({' '.join(self.rows)})" if self.rows else ""
        return f"{self.kind} on {self.shape}{where}"


def cause(probe: Probe, fault: Fault) -> Cause:
    """Return the cause of a failure, as far as it shows."""
    silent = fault.kind in SILENT
    words = re.sub(r"[^A-Za-z ]+", " ", fault.reason).split()[:4] if silent else []
    if fault.kind == UNREPEATED:
        return Cause(fault.level, fault.kind, " ".join(words), "any solid", ())
    return Cause(fault.level, fault.kind, " ".join(words), shape(probe.solid), rows(probe))


def shape(solid: Solid) -> str:
    """Return the types of a solid and its parts: `difference(sphere, slab)`."""
    if isinstance(solid, Tree):
        return f"{type_of(solid)}({', '.join(shape(part) for part in solid.of)})"
    return type_of(solid)


def rows(probe: Probe) -> tuple[str, ...]:
    """Return the rows that the exact answer takes, each once, without paths and comparisons."""
    names = (name.rpartition(":")[2] for name in trace(probe.solid, probe.ray).rows)
    return tuple(sorted({name for name in names if not re.search("[<>=]", name)}))
