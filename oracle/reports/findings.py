"""What a run found beside its verdict: measured domains, likely faults, easy cases, kinds of fault.

Sentences, the same in every report. They are about the levels that were asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from raycert.oracle.reports import inputs
from raycert.oracle.reports.reading import Json, failing, levels_asked, limit


def spaced(name: str) -> str:
    """Return a name of the certificate as it is read: `half_space` is `half space`."""
    return name.replace("_", " ")


def measured(certificate: Json, solid: str) -> list[str]:
    """Return in what domain the levels asked for would be granted to a type of solid.

    What fails on ordinary cases is said once: it does so at every level above.
    """
    measures = certificate["solids"][solid]["measured"]
    found = [(level, measures[level]) for level in levels_asked(certificate) if measures.get(level)]
    plain = [one["domain"] is None for _, one in found]
    last = plain.index(True) + 1 if True in plain else len(found)
    return [f"{level}{limit(one)}" for level, one in found[:last]]


# Likely faults.


@dataclass(frozen=True, slots=True)
class LikelyFault:
    """A fault whose answers those of the subject are, with the findings that name it."""

    fault: str
    does: str
    origin: str
    first: str
    on: tuple[tuple[str, str, int, int], ...]
    """For each type of solid and level: how many failures it explains, of how many."""

    @property
    def rows(self) -> int:
        return sum(rows for _, _, rows, _ in self.on)

    def __str__(self) -> str:
        on = [f"{_part(n, of)} {_failures(*where)}" for *where, n, of in self.on]
        return (
            f"on {listed(on)} your answers are those of a tracer that {self.does} "
            f"({self.fault}; {self.origin}), first {self.first}"
        )


def _part(n: int, of: int) -> str:
    return f"all {of:,}" if n == of > 1 else f"{n:,} of {of:,}"


def _failures(solid: str, level: str) -> str:
    return f"{spaced(solid)} failures" + ("" if level == "sound" else f" to be {level}")


def listed(parts: list[str]) -> str:
    """Return parts of a sentence as a list: `a, b and c`."""
    return " and ".join(filter(None, (", ".join(parts[:-1]), *parts[-1:])))


def causes(certificate: Json, lowest: bool = False) -> list[LikelyFault]:
    """Return the likely faults, each once, what explains most first.

    Those of all levels asked for, or of the `lowest` that each type of solid fails.
    """
    told: dict[str, list[tuple[Json, Json]]] = {}
    for found in _explained(certificate, lowest):
        for cause in found["explained"]:
            told.setdefault(cause["fault"], []).append((found, cause))
    return sorted(map(_cause, told.values()), key=lambda cause: -cause.rows)


def _cause(pairs: list[tuple[Json, Json]]) -> LikelyFault:
    first = pairs[0][1]
    on = [(f["solid"], f["level"], cause["rows"], f["failures"]) for f, cause in pairs]
    return LikelyFault(first["fault"], first["does"], first["origin"], first["first"], tuple(on))


def _explained(certificate: Json, lowest: bool) -> list[Json]:
    asked = levels_asked(certificate)
    found = [found for found in certificate["likely"] if found["level"] in asked]
    first = {one["solid"]: one for one in reversed(found)}
    return [one for one in found if not lowest or first[one["solid"]] is one]


def likely(certificate: Json) -> list[str]:
    """Return the likely faults, a sentence each, and what is left where there are some."""
    found = [str(cause) for cause in causes(certificate)]
    return found + ([left] if found and (left := unexplained(certificate)) else [])


def unexplained(certificate: Json, lowest: bool = False) -> str:
    """Return how many failures no known fault explains; empty for none."""
    left = [
        f"{found['unexplained']:,} {_failures(found['solid'], found['level'])}"
        for found in _explained(certificate, lowest)
        if found["unexplained"]
    ]
    return f"explained by none: {listed(left)}" if left else ""


# Easy cases, and kinds of failures.


def easy(certificate: Json) -> Iterator[tuple[str, Json]]:
    """Yield for each type of solid what is said of its easy cases that fail, and the first."""
    for found in certificate["easy"]:
        if found["failed"]:
            said = f"{spaced(found['solid'])}: {found['failed']} of {found['of']} easy cases fail"
            yield said + (f"; {found['misread']}" if found["misread"] else ""), found["first"]


@dataclass(frozen=True, slots=True)
class KindOfFailure:
    """All failures of a kind; the first has the simplest numbers."""

    name: str
    rows: int
    first: Json


def kinds(certificate: Json) -> list[KindOfFailure]:
    """Return the kinds of failures that the verdict is about, the simplest numbers first."""
    groups: dict[str, list[Json]] = {}
    for failed in failing(certificate):
        groups.setdefault(failed["kind"], []).append(failed)
    found = [
        KindOfFailure(k, len(rows), min(rows, key=inputs.length)) for k, rows in groups.items()
    ]
    return sorted(found, key=lambda kind: inputs.length(kind.first))
