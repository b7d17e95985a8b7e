"""Findings as a directory that `raycert certify --golden` replays: rows, manifest, and a report.

A finding is a golden row, with what has to be asked before it in rows before it. Each row gets past
the usual witnesses first. `hunt.json` says what was done and how each case fails. A family of the
directory that is not of this hunt stays as it is.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from math import inf, isinf
from pathlib import Path
from typing import Any

from raycert.cases.case import Case, Family
from raycert.cases.corpus import MANIFEST, encode_rows, manifest, read_manifest, write_whole
from raycert.cases.formats import Format
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.client.dialogue import Outcome
from raycert.oracle.corpus.golden import USUAL, golden_row
from raycert.oracle.hunt.look import Looker
from raycert.oracle.hunt.search import Finding, Hunt

REPORT = "hunt.json"
Json = dict[str, Any]


def family(seed: int) -> str:
    """Return the name of the family that the findings of a seed are."""
    return f"hunt-{seed}" if seed >= 0 else f"hunt-minus-{-seed}"


def named(findings: Iterable[Finding], seed: int) -> dict[str, Finding]:
    """Return findings by their ids: `hunt-7/missed-sphere-1`."""
    found: dict[str, Finding] = {}
    for finding in findings:
        cause = finding.cause
        words = f"{cause.kind}-{cause.shape.partition('(')[0]}".replace(" ", "-").replace("_", "-")
        stem = f"{family(seed)}/{words}"
        number = 1 + sum(id.rpartition("-")[0] == stem for id in found)
        found[f"{stem}-{number}"] = finding
    return found


def rows(findings: dict[str, Finding], looker: Looker) -> list[GoldenRow]:
    """Return the golden rows of findings that repeat. Raises `Contradiction`."""
    made = []
    for id, finding in findings.items():
        if not finding.repeats:
            continue
        for i, probe in enumerate(finding.before, 1):
            made.append(_row(f"{id}-before-{i}", "Is asked before the next row.", probe, looker))
        why = f"A hunt found an answer here that fails: {_why(finding)}."
        made.append(_row(id, why, finding.probe, looker))
    return made


def _why(finding: Finding) -> str:
    text = f"{finding.fault.level}, {finding.fault.kind}: {finding.fault.reason}"
    return text.encode("ascii", "backslashreplace").decode()[:200]


def _row(id: str, why: str, probe: Probe, looker: Looker) -> GoldenRow:
    name, _, slug = id.partition("/")
    asked = Case(slug, why, probe.solid, probe.ray, looker.tier(probe))
    return golden_row(Family(name, "", lambda _: ()), asked, looker.hello.format, USUAL)


def write(folder: Path, seed: int, made: Sequence[GoldenRow], fmt: Format, report: Json) -> None:
    """Write the rows of a hunt, the manifest of the whole directory, and the report."""
    own = f"{fmt.name}/{family(seed)}.jsonl"
    files = {name: (folder / name).read_bytes() for name in _others(folder) if name != own}
    if made:
        files[own] = encode_rows(made, fmt)
        write_whole(folder / own, files[own])
    else:
        (folder / own).unlink(missing_ok=True)
    write_whole(folder / MANIFEST, manifest(files))
    text = json.dumps(report, indent=1, allow_nan=False) + "\n"
    write_whole(folder / REPORT, text.encode())


def _others(folder: Path) -> list[str]:
    if not (folder / MANIFEST).exists():
        return []
    return [name for name in read_manifest(folder)["files"] if (folder / name).is_file()]


def form(found: Hunt, findings: dict[str, Finding], asked: Json) -> Json:
    """Return the report of a hunt; `asked` are the options that repeat it."""
    worst = found.worst
    return {
        "asked": asked,
        "tried": found.tried,
        "seconds": round(found.seconds, 1),
        "ended": found.ended,
        "worst": {"k": _number(worst.k), **(case(worst.probe) if worst.probe else {})},
        "findings": [{"id": id, **_finding(finding)} for id, finding in findings.items()],
    }


def _finding(finding: Finding) -> Json:
    return {
        "cause": str(finding.cause),
        "level": finding.fault.level,
        "kind": finding.fault.kind,
        "reason": finding.fault.reason,
        "k": _number(finding.k),
        "answer": said(finding.outcome),
        "repeats": finding.repeats,
        "seconds": round(finding.after, 1),
        **case(finding.probe),
        "before": [case(probe) for probe in finding.before],
        "found_as": case(finding.first),
    }


def case_line(probe: Probe) -> str:
    """Return a probe as a line of the protocol, without an id."""
    return json.dumps(case(probe))


def answer_line(outcome: Outcome) -> str:
    """Return what was answered, as a line."""
    return json.dumps(said(outcome))


def case(probe: Probe) -> Json:
    """Return a probe as in a line of the protocol."""
    return {"solid": write_solid(probe.solid), "ray": write_ray(probe.ray)}


def said(outcome: Outcome) -> Any:
    """Return what was answered, as JSON."""
    if not isinstance(outcome, Reply):
        return {outcome.kind: outcome.detail}
    if outcome.intervals is not None:
        return [[_number(a), _number(b)] for a, b in outcome.intervals]
    for name in ("error", "unsupported"):
        if (text := getattr(outcome, name)) is not None:
            return {name: text}
    if outcome.hit is not None:
        return outcome.hit
    return None if outcome.first is None else _number(outcome.first)


def _number(x: float) -> float | str:
    """Return a number as JSON can hold it."""
    return x if -inf < x < inf else "inf" if isinf(x) and x > 0 else str(x)
