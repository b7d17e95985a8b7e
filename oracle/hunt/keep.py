"""Findings as a directory that `raycert certify --golden` replays: rows, manifest, and a report.

A finding is a golden row, with what has to be asked before it in rows before it. Each row gets past
the usual witnesses first. `hunt.json` says what was done and how each case fails. A family of the
directory that is not of this hunt stays as it is.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from math import inf, isinf
from pathlib import Path
from typing import Any

from raycert.cases.corpus import MANIFEST, encode_rows, manifest, read_manifest, write_whole
from raycert.cases.formats import Format
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.client.dialogue import Outcome, silence
from raycert.oracle.corpus.golden import USUAL
from raycert.oracle.hunt.look import Looker
from raycert.oracle.hunt.search import Finding, Hunt

REPORT = "hunt.json"
Json = dict[str, Any]


def family(seed: int) -> str:
    return f"hunt-{seed}" if seed >= 0 else f"hunt-minus-{-seed}"


def named(findings: Iterable[Finding], seed: int) -> dict[str, Finding]:
    """Return findings by their ids: `hunt-7/missed-sphere-1`."""
    names: dict[str, Finding] = {}
    for finding in findings:
        words = f"{finding.symptom.kind}-{finding.symptom.shape.partition('(')[0]}"
        stem = f"{family(seed)}/{re.sub('[ _]', '-', words)}"
        number = 1 + sum(id.rpartition("-")[0] == stem for id in names)
        names[f"{stem}-{number}"] = finding
    return names


def rows(findings: dict[str, Finding], looker: Looker) -> list[GoldenRow]:
    """Return the golden rows of findings that repeat. Raises `Contradiction`."""
    found = []
    for id, finding in findings.items():
        if finding.repeats:
            for i, probe in enumerate(finding.before, 1):
                why = "Is asked before the next row."
                found.append(looker.row(probe, f"{id}-before-{i}", why, USUAL))
            text = f"{finding.flaw.level}, {finding.flaw.kind}: {finding.flaw.reason}"
            how = text.encode("ascii", "backslashreplace").decode()[:200]
            why = f"A hunt found an answer here that fails: {how}."
            found.append(looker.row(finding.probe, id, why, USUAL))
    return found


def write(folder: Path, seed: int, rows: Sequence[GoldenRow], fmt: Format, report: Json) -> None:
    own = f"{fmt.name}/{family(seed)}.jsonl"
    there = read_manifest(folder)["files"] if (folder / MANIFEST).exists() else ()
    others = (name for name in there if name != own and (folder / name).is_file())
    files = {name: (folder / name).read_bytes() for name in others}
    if rows:
        files[own] = encode_rows(rows, fmt)
        write_whole(folder / own, files[own])
    else:
        (folder / own).unlink(missing_ok=True)
    write_whole(folder / MANIFEST, manifest(files))
    text = json.dumps(report, indent=1, allow_nan=False) + "\n"
    write_whole(folder / REPORT, text.encode())


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
        "cause": str(finding.symptom),
        **asdict(finding.flaw),
        "k": _number(finding.k),
        "answer": answer(finding.outcome),
        "repeats": finding.repeats,
        "seconds": round(finding.after, 1),
        **case(finding.probe),
        "before": [case(probe) for probe in finding.before],
        "found_as": case(finding.first),
    }


def case(probe: Probe) -> Json:
    return {"solid": write_solid(probe.solid), "ray": write_ray(probe.ray)}


def answer(outcome: Outcome) -> Any:
    if silent := silence(outcome):
        return dict([silent])
    assert isinstance(outcome, Reply)
    if outcome.intervals is not None:
        return [[_number(a), _number(b)] for a, b in outcome.intervals]
    if outcome.hit is not None:
        return outcome.hit
    return None if outcome.first is None else _number(outcome.first)


def _number(x: float) -> float | str:
    """Return a number as JSON can hold it."""
    return x if -inf < x < inf else "inf" if isinf(x) and x > 0 else str(x)
