"""The certificate as JSON: what was tested, with what, what was not, and how to repeat it.

Pure: it is told everything, the environment too. Every report is rendered from this alone;
schemas/certificate.schema.json describes it.
"""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from raycert.cases.corpus import FORMAT_VERSION, Corpus
from raycert.cases.levels import LEVELS, Level
from raycert.cases.protocol import Hello
from raycert.oracle.certify.coverage import case_table
from raycert.oracle.certify.evidence import answered, case, failure, worst
from raycert.oracle.certify.grading import Grade
from raycert.oracle.certify.verdict import Group, Touches, Verdict, Window, by_family, by_solid

Json = dict[str, Any]
CERTIFICATE_VERSION = 1
MEASURED: tuple[Level, ...] = ("sound", "stable")
"""The levels that a row may leave undecided."""


@dataclass(frozen=True, slots=True)
class Asked:
    """What `certify` was asked: the level and convention, and of whom."""

    level: Level
    convention: str
    command: tuple[str, ...]
    selection: tuple[str, ...]
    """The options that narrow the corpus; empty for all of it."""
    fresh: tuple[str, ...] = ()
    """The options that draw rows beside it."""
    golden: tuple[str, ...] = ()
    """The options that put another corpus in its place."""

    def repeat(self, *extra: str) -> str:
        """Return the command line that asks again."""
        asked = ("--level", self.level, "--convention", self.convention)
        options = [*asked, *self.golden, *extra]
        return shlex.join(["raycert", "certify", *options, *self.command])

    def repeat_row(self, id: str) -> str:
        """Return the command line that asks one row again, drawn anew if it was."""
        return self.repeat(*(self.fresh if id.startswith("fresh-") else ()), "--id", id)


@dataclass(frozen=True, slots=True)
class Ran:
    """How the run went: what the harness saw beside the answers."""

    restarts: int
    notes: tuple[str, ...]
    seconds: float
    interrupted: bool = False
    began: str | None = None
    """When, in UTC as ISO 8601 has it."""
    diagnosis: tuple[str, ...] = ()
    """What the failing answers look like: the likely fault."""


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
    expectations: Json | None = None,
    shard: str | None = None,
    fresh: Json | None = None,
) -> Json:
    """Return the certificate of a run. `environment` is what `oracle.certify.environment` tells.

    `expectations` says how the failures compare with a file of known ones: `file`, and the lists
    `expected`, `unexpected_passes`, `unmatched`, `new`.
    """
    passed = verdict.granted and not ran.interrupted
    return {
        "certificate": CERTIFICATE_VERSION,
        "granted": passed and not (asked.selection or shard or _departs(expectations)),
        "passed": passed,
        "accepted": _accepted(expectations, ran, grades),
        "reasons": list(verdict.reasons),
        **_question(asked),
        "shard": shard,
        "subject": {"command": list(asked.command), **asdict(hello)},
        "corpus": _corpus(corpus),
        "fresh": fresh,
        "tool": environment["tool"],
        "environment": {name: x for name, x in environment.items() if name != "tool"},
        "run": {**asdict(ran), "notes": list(ran.notes), "diagnosis": list(ran.diagnosis)},
        "tested": len(grades),
        "not_tested": {"solids": list(left.solids), "rows": left.rows},
        **_results(asked, hello, grades),
        "expectations": expectations,
        "standing": {"stress": None, "bench": None},
        "reproduce": asked.repeat(*asked.fresh, *asked.selection),
    }


def _question(asked: Asked) -> Json:
    """Return what was asked, and of which part of the corpus."""
    return {
        "asked": {"level": asked.level, "convention": asked.convention},
        "selection": list(asked.selection),
    }


def _results(asked: Asked, hello: Hello, grades: Sequence[Grade]) -> Json:
    """Return what the answers came to."""
    groups = by_solid(grades)
    return {
        "not_decisive": _not_decisive(grades),
        "solids": {group.name: _solid(group) for group in groups},
        "families": [
            _family(group, solid) for solid in groups for group in by_family(solid.grades)
        ],
        "table": case_table(grades, asked.level),
        "worst": worst(grades, asked.level, hello, asked.repeat_row),
        "failures": [failure(g, asked.repeat_row) for g in grades if g.faults],
    }


LISTS = ("expected", "new", "unexpected_passes", "unmatched")
"""What a file of known failures may have to say of a run."""


def _departs(expectations: Json | None) -> bool:
    """Tell whether known failures were made use of, or are not as the file says."""
    return expectations is not None and any(expectations[name] for name in LISTS)


def _accepted(expectations: Json | None, ran: Ran, grades: Sequence[Grade]) -> bool:
    """Tell whether a run is as its file of known failures expects, to the last row."""
    if expectations is None or ran.interrupted or not grades:
        return False
    return not any(expectations[name] for name in LISTS[1:])


def _not_decisive(grades: Sequence[Grade]) -> Json:
    usual = [g for g in grades if g.row.tier != "range"]
    return {
        level: {
            "rows": [g.row.id for g in usual if not g.counts(level)],
            "outside": [g.row.id for g in usual if level in g.outside],
        }
        for level in MEASURED
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
    grade = group.worst()
    return {
        "family": group.name,
        "solid": solid.name,
        "rows": len(group.grades),
        "levels": _levels(group),
        "worst": {**case(grade.row), **answered(grade)},
    }


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
