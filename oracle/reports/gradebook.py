"""A gradebook as JSON: of many targets, how each fares on each solid; and its words.

A row is made from a certificate alone, or from the reason why there is none. Whatever a target
says is hostile until `foreign` has seen it; a row keeps it as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal

from raycert.cases.levels import upto
from raycert.cases.model import SOLIDS
from raycert.oracle.certify.verdict import Touches
from raycert.oracle.reports import reading
from raycert.oracle.reports.reading import Json, count

GRADEBOOK_VERSION = 1
State = Literal["granted", "part", "refused", "interrupted", "not run", "not asked"]
GOOD = ("granted", "part")
Order = Literal["file", "name", "left"]
ORDERS: tuple[Order, ...] = ("file", "name", "left")


def graded(certificate: Json) -> Json:
    """Return what a gradebook's row says of a certificate."""
    found, declared = reading.verdict(certificate), certificate["subject"]
    return {
        "state": found.state,
        "reason": None,
        "subject": {name: declared[name] for name in ("name", "version", "answers", "precision")},
        "domain": certificate["domain"],
        "tested": certificate["tested"],
        "seconds": certificate["run"]["seconds"],
        "headline": found.headline,
        "solids": {name: _solid(certificate, name) for name in certificate["solids"]},
    }


def _solid(certificate: Json, name: str) -> Json:
    """Return how a solid fares on the first of the levels asked that is not granted."""
    solid, asked = certificate["solids"][name], upto(certificate["asked"]["level"])
    level = next((each for each in asked if not solid["levels"][each]["granted"]), asked[-1])
    tally = solid["levels"][level]
    kept = Touches({kind: (touch["kept"], touch["of"]) for kind, touch in solid["touches"].items()})
    misread = (each["misread"] for each in certificate["easy"] if each["solid"] == name)
    return {
        "granted": solid["level"],
        "holds": tally["granted"],
        "level": level,
        "rows": tally["passed"] + tally["failed"],
        "failed": tally["failed"],
        "refused": tally["refused"],
        "convention": solid["convention"],
        "follows": kept.follows(certificate["asked"]["convention"]),
        "measured": _measured(solid["measured"].get(level)),
        "likely": _likely(certificate["likely"], name, level),
        "misread": next(filter(None, misread), None),
    }


def _measured(found: Json | None) -> str | None:
    """Return the words of the domain in which the level would be granted, if there is one."""
    return found["words"] if found and found["domain"] is not None else None


def _likely(found: Sequence[Json], solid: str, level: str) -> Json | None:
    """Return the fault that explains the most failures."""
    here = [each for each in found if each["solid"] == solid and each.get("level", level) == level]
    causes = [(x["rows"], each["failures"], x) for each in here for x in each["explained"]]
    if not causes:
        return None
    rows, of, cause = max(causes, key=lambda each: each[0])
    return {"fault": cause["fault"], "does": cause["does"], "rows": rows, "of": of}


def without(state: State, reason: str | None) -> Json:
    """Return what a row says of a target that has no certificate."""
    nothing = dict.fromkeys(("subject", "domain", "tested", "seconds", "headline"))
    return {"state": state, "reason": reason, **nothing, "solids": {}}


def gradebook(rows: Sequence[Json], made: Mapping[str, Any]) -> Json:
    """Return the gradebook of some rows; `made` says with what, and whether it was interrupted."""
    named = {name for row in rows for name in row["solids"]}
    return {
        "gradebook": GRADEBOOK_VERSION,
        **made,
        "solids": [name for name in SOLIDS if name in named],
        "targets": list(rows),
    }


def in_order(rows: Iterable[Json], order: Order) -> list[Json]:
    """Return rows by name, or by what is left: those granted first, those not run last."""
    keys: dict[Order, Callable[[Json], Any]] = {
        "file": lambda row: 0,
        "name": lambda row: title(row).casefold(),
        "left": lambda row: (not row["solids"], row["state"] not in GOOD, left(row)),
    }
    return sorted(rows, key=keys[order])


def title(row: Json) -> str:
    return str(row["title"] or row["name"])


def left(row: Json) -> int:
    """Return how many failures are left, over all solids, on what is asked of each."""
    return sum(solid["failed"] for solid in row["solids"].values())


def standing(row: Json) -> str:
    """Return in a word or two how a target stands."""
    words = {"part": "passes", "refused": f"{left(row):,} left" if left(row) else "convention"}
    return words.get(row["state"]) or str(row["state"])


def summary(book: Json) -> str:
    """Return how many are granted what was asked, and how the others stand."""
    states = [row["state"] for row in book["targets"]]
    told = {
        "granted": "granted",
        "part": "pass a part of the corpus",
        "refused": "not granted",
        "interrupted": "not granted",
        "not run": "could not be run",
        "not asked": "not asked",
    }
    counts = dict.fromkeys(told.values(), 0)
    for state in states:
        counts[told[state]] += 1
    parts = [f"{n} {what}" for what, n in counts.items() if n]
    return f"{count(len(states), 'target')}: {', '.join(parts)}"


def why(row: Json) -> list[str]:
    """Return what is to be known beside the numbers, the most telling first."""
    if row["reason"]:
        return [row["reason"]]
    declared = row["domain"]["words"] if row["domain"] else ""
    found: dict[str, list[str]] = {}
    for name, solid in sorted(row["solids"].items(), key=lambda item: -item[1]["failed"]):
        for words, detail in _reasons(solid):
            found.setdefault(words, []).append(f"{spoken(name)}{detail}")
    said = [f"{', '.join(solids)}: {words}" for words, solids in found.items()]
    return [f"for {declared}", *said] if declared else said


def _reasons(solid: Json) -> Iterator[tuple[str, str]]:
    """Yield what is to be said of a solid, each with what is of this solid alone."""
    if solid["holds"]:
        if not solid["follows"]:
            yield f"convention {solid['convention']}", ""
        return
    found, level, refused = solid["likely"], solid["level"], solid["refused"]
    if solid["misread"] and not (found and found["rows"] == found["of"]):
        yield solid["misread"], ""
    if found:
        yield found["does"], f" ({found['rows']:,} of {found['of']:,})"
    if solid["measured"]:
        yield f"{level} for {solid['measured']}", ""
    if refused:
        yield "refused", f" ({refused:,} of {solid['failed']:,})"


def spoken(name: str) -> str:
    return name.replace("_", " ")
