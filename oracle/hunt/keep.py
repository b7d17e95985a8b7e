"""Findings as a directory that `raycert certify --golden` replays: rows, manifest, and a report.

A finding is a golden row, with what has to be asked before it in rows before it. Each row gets past
the usual witnesses first. `FAMILY.json` says what was done and how each case fails. A hunt has a
family of its own, which only the same hunt done again replaces; those of others stay as they are,
also where they are written at the same time.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from itertools import chain, count
from math import inf, isinf
from pathlib import Path
from typing import Any

from raycert.cases.corpus import MANIFEST, encode_rows, manifest, read_manifest, write_whole
from raycert.cases.files import decode_json, read_file
from raycert.cases.formats import Format
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.client.dialogue import Outcome, silence
from raycert.oracle.corpus.golden import USUAL
from raycert.oracle.corpus.lock import locked
from raycert.oracle.hunt.look import Looker
from raycert.oracle.hunt.search import Finding, Hunt

Json = dict[str, Any]


def family(seed: int) -> str:
    return f"hunt-{seed}" if seed >= 0 else f"hunt-minus-{-seed}"


def named(findings: Iterable[Finding], name: str) -> dict[str, Finding]:
    """Return findings by their ids: `hunt-7/missed-sphere-1`."""
    names: dict[str, Finding] = {}
    for finding in findings:
        words = f"{finding.symptom.kind}-{finding.symptom.shape.partition('(')[0]}"
        stem = f"{name}/{re.sub('[ _]', '-', words)}"
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


def write(folder: Path, found: Hunt, asked: Json) -> dict[str, Finding]:
    """Keep what a hunt found; return its findings by their ids.

    Raises `Contradiction`, `BadFile` and `OSError`.
    `asked` are the options that repeat it, and "seed" is among them. Where nothing was found, now
    or before, nothing is written, and a folder that is empty is taken away.
    """
    with locked(folder):
        name = own_family(folder, asked, time.time() - found.seconds)
        report = folder / f"{name}.json"
        findings = named(found.findings.values(), name)
        if findings or report.exists():
            _write(folder, name, rows(findings, found.looker), found.looker.hello.format)
            text = json.dumps(form(found, findings, asked), indent=1, allow_nan=False) + "\n"
            write_whole(report, text.encode())
        elif not any(folder.iterdir()):
            folder.rmdir()
    return findings


def own_family(folder: Path, asked: Json, began: float) -> str:
    """Return the name of the family of a hunt: `hunt-7`, or `hunt-7-2` if another hunt has that.

    What the same hunt wrote before this one `began` is its own.
    """
    stem = family(asked["seed"])
    names = chain([stem], (f"{stem}-{number}" for number in count(2)))
    return next(name for name in names if _is_own(folder, name, asked, began))


def _is_own(folder: Path, name: str, asked: Json, began: float) -> bool:
    report = folder / f"{name}.json"
    if not report.exists():
        return not any(folder.glob(f"*/{name}.jsonl"))
    try:
        before = decode_json(read_file(report, regular=True))
    except ValueError:
        return False
    same = isinstance(before, dict) and before.get("asked") == json.loads(json.dumps(asked))
    return same and report.stat().st_mtime < began


def _write(folder: Path, name: str, rows: Sequence[GoldenRow], fmt: Format) -> None:
    """Write the rows of a family, and the manifest of all."""
    own = f"{fmt.name}/{name}.jsonl"
    there = read_manifest(folder)["files"] if (folder / MANIFEST).exists() else ()
    others = (file for file in there if file != own and (folder / file).is_file())
    files = {file: (folder / file).read_bytes() for file in others}
    if rows:
        files[own] = encode_rows(rows, fmt)
        write_whole(folder / own, files[own])
    else:
        (folder / own).unlink(missing_ok=True)
    write_whole(folder / MANIFEST, manifest(files))


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
