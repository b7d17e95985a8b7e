"""The certificate as JSON: what was tested, with what, what was not, and how to repeat it.

Pure: it is told everything, the environment too. Infinite errors are written as null.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from math import isfinite
from typing import Any

from cases.corpus import FORMAT_VERSION, Corpus
from cases.forms import write_ray, write_solid
from cases.protocol import Hello
from cases.row import GoldenRow
from oracle.certify import Group, Touches, Verdict, Window, by_family, by_solid
from oracle.grade import Grade
from oracle.judge import LEVELS

Json = dict[str, Any]
CERTIFICATE_VERSION = 1


@dataclass(frozen=True, slots=True)
class Asked:
    """What `certify` was asked: the level and convention, and of whom."""

    level: str
    convention: str
    command: tuple[str, ...]
    selection: tuple[str, ...]
    """The options that narrow the corpus; empty for all of it."""

    def repeat(self, *extra: str) -> str:
        """Return the command line that asks again."""
        options = ["--level", self.level, "--convention", self.convention, *extra]
        return shlex.join(["raycert", "certify", *options, *self.command])


@dataclass(frozen=True, slots=True)
class Ran:
    """How the run went: what the harness saw beside the answers."""

    restarts: int
    notes: tuple[str, ...]
    seconds: float
    interrupted: bool = False


@dataclass(frozen=True, slots=True)
class Left:
    """What was not tested: solids the client did not declare, and rows outside the selection."""

    solids: tuple[str, ...]
    rows: int


def certificate(
    asked: Asked,
    hello: Hello,
    corpus: Corpus,
    grades: Sequence[Grade],
    left: Left,
    ran: Ran,
    verdict: Verdict,
    environment: Json,
) -> Json:
    """Return the certificate of a run."""
    groups = by_solid(grades)
    usual = [g for g in grades if g.row.tier != "range"]
    return {
        "certificate": CERTIFICATE_VERSION,
        "granted": verdict.granted and not asked.selection and not ran.interrupted,
        "passed": verdict.granted and not ran.interrupted,
        "reasons": list(verdict.reasons),
        "asked": {"level": asked.level, "convention": asked.convention},
        "selection": list(asked.selection),
        "subject": {"command": list(asked.command), **asdict(hello)},
        "corpus": _corpus(corpus),
        "environment": environment,
        "run": asdict(ran),
        "tested": len(grades),
        "not_tested": {"solids": list(left.solids), "rows": left.rows},
        "not_decisive": {
            level: {
                "rows": [g.row.id for g in usual if not g.counts(level)],
                "outside": [g.row.id for g in usual if level in g.outside],
            }
            for level in ("sound", "stable")
        },
        "solids": {group.name: _solid(group) for group in groups},
        "families": [
            _family(group, solid) for solid in groups for group in by_family(solid.grades)
        ],
        "failures": [failure(g, asked, hello) for g in grades if g.faults],
        "reproduce": asked.repeat(*asked.selection),
    }


def _corpus(corpus: Corpus) -> Json:
    return {
        "version": corpus.version,
        "format": FORMAT_VERSION,
        "manifest_sha256": corpus.sha256,
        "precision": corpus.precision,
        "rows": len(corpus.rows),
    }


def _solid(group: Group) -> Json:
    touches = Touches.of(group.grades)
    return {
        "level": group.granted(),
        "levels": _levels(group),
        "convention": touches.name,
        "touches": {kind: {"kept": n, "of": of} for kind, (n, of) in touches.kept.items()},
        "windows": {
            level: {
                "lengths": _window(Window.of(group.grades, level, 0)),
                "directions": _window(Window.of(group.grades, level, 1)),
            }
            for level in LEVELS
        },
    }


def _levels(group: Group) -> Json:
    return {
        level: {"granted": tally.granted, **asdict(tally)}
        for level, tally in ((level, group.tally(level)) for level in LEVELS)
    }


def _window(window: Window | None) -> list[int] | None:
    return None if window is None else [window.low, window.high]


def _family(group: Group, solid: Group) -> Json:
    worst = group.worst()
    return {
        "family": group.name,
        "solid": solid.name,
        "rows": len(group.grades),
        "levels": _levels(group),
        "worst": {
            **case(worst.row),
            "answer": _pairs(worst.answer),
            "expected": _pairs(worst.row.expected),
            **errors(worst),
        },
    }


def case(row: GoldenRow) -> Json:
    """Return a row's id and inputs, reals as hex floats."""
    return {"id": row.id, "solid": write_solid(row.solid, "hex"), "ray": write_ray(row.ray, "hex")}


def errors(grade: Grade) -> Json:
    """Return the measured errors of an answer; null for an infinite one."""
    measured = {"strict_k": grade.strict, "squared_k": grade.squared, "ulps": grade.ulps}
    return {name: x if isfinite(x) else None for name, x in measured.items()}


def failure(grade: Grade, asked: Asked, hello: Hello) -> Json:
    """Return one failing row: why, what was answered, and the command that repeats it."""
    return {
        **case(grade.row),
        "why": grade.row.why,
        "tier": grade.row.tier,
        "faults": dict(grade.faults),
        "answer": _pairs(grade.answer),
        "expected": _pairs(grade.row.expected),
        **errors(grade),
        "reproduce": asked.repeat("--id", grade.row.id),
    }


def _pairs(pairs: Iterable[tuple[float, float]] | None) -> list[list[str | None]] | None:
    if pairs is None:
        return None
    return [[x.hex() if isfinite(x) else str(x) for x in pair] for pair in pairs]


def contradictions(hello: Hello, grades: Sequence[Grade]) -> list[str]:
    """Return where the answers contradict what the hello declared."""
    found = []
    for group in by_solid(grades):
        touches = Touches.of(group.grades)
        if not touches.follows(hello.convention):
            found.append(
                f"{group.name}: the hello says {hello.convention}, the answers are {touches.name}"
            )
    return found
