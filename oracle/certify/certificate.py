"""The certificate as JSON: what was tested, with what, what was not, and how to repeat it.

Pure: it is told everything, the environment too. Every report is rendered from this alone;
schemas/certificate.schema.json describes it. Reals are hex-float strings, so that what is read back
is what was compared; infinite errors are null.

In the order of the file: the certificate, its solids and families, the case table, the worst
answers, and what is said of one answer.
"""

from __future__ import annotations

import json
import shlex
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from math import isfinite
from typing import Any

from raycert.cases.accept import Numbers
from raycert.cases.corpus import FORMAT_VERSION, Corpus
from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.levels import LEVELS, Level, upto
from raycert.cases.model import Tree
from raycert.cases.protocol import Hello
from raycert.cases.row import End, GoldenRow
from raycert.cases.table import PROBLEM_1, PROBLEM_2, Row, cells, pairs_of_rows
from raycert.oracle.certify.again import Again
from raycert.oracle.certify.grading import Grade, by_convention, counting, undeclared, usual
from raycert.oracle.certify.selection import Left
from raycert.oracle.certify.verdict import (
    Group,
    Tally,
    Touches,
    Verdict,
    by_family,
    by_solid,
    gravest,
    window,
)
from raycert.oracle.certify.widest import measured_domain
from raycert.oracle.judge.answer import First, YesNo
from raycert.oracle.judge.levels import MEASURES
from raycert.oracle.zoo.matrix import kind as how

Json = dict[str, Any]
CERTIFICATE_VERSION = 2
DIFFERENCES = ("expected", "new", "unexpected_passes", "unmatched")
"""What a file of known failures may have to say of a run."""
MOST, MOST_PASSED = 12, 4
"""How many worst cases are shown: of failures, and where nothing failed."""


@dataclass(frozen=True, slots=True)
class Request:
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
    hello: tuple[str, ...] = ()
    """The options that give a hello."""
    overridden: tuple[str, ...] = ()
    """The fields of the hello that were given by others than the target."""

    def repeat(self, *extra: str) -> str:
        asked = ("--level", self.level, "--convention", self.convention)
        options = [*asked, *self.hello, *self.golden, *extra]
        return shlex.join(["raycert", "certify", *options, *self.command])

    def whole(self) -> str:
        """Return the command line of all that is asked: two runs with the same are the same run."""
        return self.repeat(*self.fresh, *self.selection)

    def repeat_row(self, id: str) -> str:
        """Return the command line that asks one row again, drawn anew if it was."""
        return self.repeat(*(self.fresh if id.startswith("fresh-") else ()), "--id", id)

    def explain_row(self, row: GoldenRow, precision: str) -> str:
        """Return the command that derives a case: by id, or by its numbers where it was drawn."""
        other = () if precision == "binary64" else ("--precision", precision)
        if not row.id.startswith("fresh-"):
            return shlex.join(["raycert", "explain", *self.golden, *other, row.id])
        case = _case(row)
        given = json.dumps({name: case[name] for name in ("solid", "ray")}, separators=(",", ":"))
        derive = shlex.join(["raycert", "explain", *other, "--case", "-"])
        return f"echo {shlex.quote(given)} | {derive}"


@dataclass(frozen=True, slots=True)
class Ran:
    """How the run went: what was seen beside the answers."""

    restarts: int
    notes: tuple[str, ...]
    seconds: float
    interrupted: bool = False
    began: str | None = None
    """When, in UTC as ISO 8601 has it."""
    diagnosis: Json = field(default_factory=dict)
    """What the failures have in common, as far as it was sought: `likely`, `easy`, `state`."""


def certificate(
    request: Request,
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

    `expectations` says how the failures compare with a file of known ones: `file`, and a list for
    each of DIFFERENCES. Known failures that were met keep a run from being granted, not from being
    accepted.
    """
    passed = verdict.granted and not ran.interrupted
    known = {name: expectations[name] for name in DIFFERENCES} if expectations else {}
    surprises = any(known[name] for name in known if name != "expected")
    return {
        "certificate": CERTIFICATE_VERSION,
        "granted": passed and not (request.selection or shard or any(known.values())),
        "passed": passed,
        "accepted": bool(known and grades and not ran.interrupted and not surprises),
        "reasons": list(verdict.reasons),
        **_question(request, hello, corpus, shard),
        "fresh": fresh,
        "tool": environment["tool"],
        "environment": {name: x for name, x in environment.items() if name != "tool"},
        **_seen(ran),
        "tested": len(grades),
        "not_tested": {"solids": list(left.solids), "rows": left.rows},
        **_results(request, hello, grades),
        "expectations": expectations,
        "standing": {"stress": None, "bench": None},
        "reproduce": request.whole(),
    }


def _seen(ran: Ran) -> Json:
    """Return how the run went, and what the failures have in common."""
    run = {**asdict(replace(ran, diagnosis={})), "notes": list(ran.notes)}
    run.pop("diagnosis")
    return {"run": run, "likely": [], "easy": [], "state": Again().form(), **ran.diagnosis}


def _question(request: Request, hello: Hello, corpus: Corpus, shard: str | None) -> Json:
    return {
        "asked": {"level": request.level, "convention": request.convention},
        "selection": list(request.selection),
        "shard": shard,
        "subject": {"command": list(request.command), **hello.form()},
        "overridden": list(request.overridden),
        "domain": {"declared": hello.domain.form(), "words": hello.domain.words()},
        "corpus": {
            "version": corpus.version,
            "format": FORMAT_VERSION,
            "manifest_sha256": corpus.sha256,
            "precision": corpus.precision,
            "rows": len(corpus.headings),
        },
    }


def _results(request: Request, hello: Hello, grades: Sequence[Grade]) -> Json:
    level, groups = request.level, by_solid(grades)
    return {
        "not_decisive": {name: _not_decisive(usual(grades), name) for name in MEASURES},
        "solids": {group.name: _solid(group, hello) for group in groups},
        "families": [
            _family(family, solid.name) for solid in groups for family in by_family(solid.grades)
        ],
        "table": case_table(grades, level),
        "worst": worst(grades, request, hello),
        "failures": [_failure(g, kind(g, _lowest(g), hello), request) for g in grades if g.faults],
    }


def _not_decisive(grades: Sequence[Grade], level: Level) -> Json:
    return {
        "rows": [g.row.id for g in grades if not g.counts(level)],
        "wrong": [g.row.id for g in grades if level in g.beside],
    }


def _solid(group: Group, hello: Hello) -> Json:
    touches = Touches.of(group.grades)
    return {
        "level": group.granted(),
        "levels": _levels(group),
        "convention": touches.name,
        "touches": {kind: {"kept": n, "of": of} for kind, (n, of) in touches.kept.items()},
        "windows": {
            level: {
                what: window(group.grades, level, which)
                for which, what in enumerate(("lengths", "directions"))
            }
            for level in LEVELS
        },
        **_apart(group, hello),
        "measured": {
            level: _measured(group, level) for level in MEASURES if not group.tally(level).granted
        },
    }


def _apart(group: Group, hello: Hello) -> Json:
    """Return how the rows fared that count for no level: outside the domain, and degenerate."""
    outside, degenerate = (counting(group.grades, place) for place in ("outside", "degenerate"))
    kinds = {
        kind: [g for g in degenerate if kind in undeclared(g.row.solid, g.row.ray, hello)]
        for kind in DEGENERACIES
    }
    return {
        "outside": {level: _fares("right", outside, level) for level in MEASURES},
        "degenerate": {
            kind: _fares("answered", some, "sound") for kind, some in kinds.items() if some
        },
    }


def _measured(group: Group, level: Level) -> Json | None:
    """Return the measured domain of a level that is not granted."""
    found = measured_domain(group.grades, level)
    if found is None:
        return None
    domain, failed = found.domain, found.ordinary
    return {
        "domain": domain and domain.form(),
        "words": domain.words() if domain else "",
        "rows": found.rows,
        "left": found.left,
        "edges": [
            {
                "quantity": edge.flank.quantity,
                "side": edge.flank.name,
                "bound": edge.bound,
                "row": edge.grade.row.id,
                "fault": next(filter(None, map(edge.grade.fault, upto(level)))),
            }
            for edge in found.edges
        ],
        "ordinary": {"failed": len(failed), "rows": [g.row.id for g in failed[:5]]},
        "exhaustive": found.exhaustive,
    }


def _fares(right: str, grades: Sequence[Grade], level: Level) -> Json:
    """Return how rows fared that count for no level; `right` is what those that pass are called."""
    fares = Counter(g.fare(level) for g in grades)
    told = {right: fares["right"], "refused": fares["refused"], "wrong": fares["wrong"]}
    return {"rows": len(grades), **told}


def _levels(group: Group) -> Json:
    tallies = {level: group.tally(level) for level in LEVELS}
    return {level: {"granted": t.granted, **asdict(t)} for level, t in tallies.items()}


def _family(group: Group, solid: str) -> Json:
    grade = group.worst()
    return {
        "family": group.name,
        "solid": solid,
        "rows": len(group.grades),
        "levels": _levels(group),
        "worst": {**_case(grade.row), **_answered(grade)},
    }


def case_table(grades: Sequence[Grade], level: Level) -> Json:
    """Return the state of each row of the case table on a level; the range tier is left out.

    `infinite_cylinder` has the rows of Problem 1, `slab` those of Problem 2, `cylinder` the pairs
    of both. `cells` counts the pairs told apart by the comparisons of Problem 3.
    """
    by_type = {group.name: group.grades for group in by_solid(usual(grades))}

    def state(solid: str, *rows: str) -> Json:
        here = [g for g in by_type.get(solid, ()) if g.row.rows[: len(rows)] == rows]
        failing = next((g.row.id for g in here if g.fault(level)), None)
        return {**asdict(Tally.of(here, level)), "first_failing": failing}

    def line(solid: str, row: Row) -> Json:
        condition = ", ".join(map(" ".join, row.condition))
        head = {"rows": [row.name], "condition": condition, "pairs": row.pairs}
        return {**head, **state(solid, row.name)}

    reachable = set(cells())
    return {
        "infinite_cylinder": [line("infinite_cylinder", row) for row in PROBLEM_1],
        "slab": [line("slab", row) for row in PROBLEM_2],
        "cylinder": [{"rows": list(two), **state("cylinder", *two)} for two in pairs_of_rows()],
        "cells": {
            "reachable": len(reachable),
            "tested": len({g.row.rows for g in by_type.get("cylinder", ())} & reachable),
        },
    }


def worst(grades: Sequence[Grade], request: Request, hello: Hello) -> list[Json]:
    """Return the cases to look at first, with all that a picture of them needs.

    Failures of the level, the gravest first, but each time the first of the family and the kind of
    failure that were chosen least. Where nothing failed, the largest errors. The range tier is
    left out.
    """
    level = request.level
    failing = [g for g in usual(grades) if g.fault(level)]
    passing = [] if failing else [g for g in usual(grades) if g.counts(level)]
    kinds = [(g, kind(g, level, hello)) for g in failing or passing]
    chosen = _spread(kinds, MOST if failing else MOST_PASSED)
    return [_pictured(g, name, request, hello) for g, name in chosen]


def _spread(kinds: Sequence[tuple[Grade, str]], most: int) -> list[tuple[Grade, str]]:
    """Return up to `most`: each time the gravest of the family and kind that are chosen least.

    Of these a lone leaf before a tree, which is harder to see through.
    """
    left: dict[tuple[str, str, bool], list[int]] = {}
    for i, (g, name) in enumerate(kinds):
        left.setdefault((g.row.family, name, isinstance(g.row.solid, Tree)), []).append(i)
    chosen, times = list[tuple[Grade, str]](), Counter[tuple[str, str]]()

    def rank(key: tuple[str, str, bool]) -> tuple[int, int, bool]:
        return times["family", key[0]], times["kind", key[1]], key[2]

    while left and len(chosen) < most:
        least = min(map(rank, left))
        first = sorted(i for key, some in left.items() if rank(key) == least for i in some)
        best = first[gravest([kinds[i][0] for i in first])]
        key = next(key for key, some in left.items() if best in some)
        left[key].remove(best)
        if not left[key]:
            del left[key]
        chosen.append(kinds[best])
        times.update((("family", key[0]), ("kind", key[1])))
    return chosen


def _pictured(g: Grade, name: str, request: Request, hello: Hello) -> Json:
    inner, outer = _band(g, request.level, hello)
    return {
        **_failure(g, name, request),
        "rows": list(g.row.rows),
        "exact": [
            {"enter": _end(s.enter), "leave": _end(s.leave), "touch": s.touch}
            for s in g.row.intervals
        ],
        "accept": {"level": request.level, "inner": _pairs(inner), "outer": _pairs(outer)},
    }


def _end(end: End) -> Json:
    return {"digits": end.digits, "kind": end.kind, "faces": list(end.faces)}


def _lowest(grade: Grade) -> Level:
    """Return the lowest level that a failing grade fails."""
    return next(level for level in LEVELS if grade.fault(level))


def kind(grade: Grade, level: Level, hello: Hello) -> str:
    """Return in a word how an answer fails a level: crash, missed, phantom, ...; or `passed`."""
    fault = grade.fault(level)
    if fault is None:
        return "passed"
    if grade.said is None:
        return fault.partition(":")[0]
    if grade.said.malformed(grade.judge):
        return "malformed"
    inner, outer = _band(grade, level, hello)
    if grade.answer is not None:
        return how(outer, inner, grade.answer)
    match grade.said:
        case First(t=None) | YesNo(hit=False):
            return "missed"
    return "wrong end" if outer else "phantom"


def _band(grade: Grade, level: Level, hello: Hello) -> tuple[Numbers, Numbers]:
    """Return the inner and the outer list of numbers between which a level wants the answer."""
    if level in MEASURES:
        accept = grade.accept(level)
        return accept.inner, accept.outer
    wanted, around = by_convention(grade.row, grade.judge, hello, grade.said)
    if level == "exact":
        return wanted, wanted
    narrow = ((enter[1], leave[0]) for enter, leave in around)
    inner = tuple((a, b) for a, b in narrow if a <= b)
    return inner, tuple((enter[0], leave[1]) for enter, leave in around)


def _failure(grade: Grade, name: str, request: Request) -> Json:
    return {
        **_case(grade.row),
        "why": grade.row.why,
        "tier": grade.row.tier,
        "place": grade.place,
        "kind": name,
        "faults": dict(grade.faults),
        **_answered(grade),
        "reproduce": request.repeat_row(grade.row.id),
        "explain": request.explain_row(grade.row, grade.judge.format.name),
    }


def _case(row: GoldenRow) -> Json:
    return {"id": row.id, "solid": write_solid(row.solid, "hex"), "ray": write_ray(row.ray, "hex")}


def _answered(grade: Grade) -> Json:
    errors = {"strict_k": grade.strict, "squared_k": grade.squared, "ulps": grade.ulps}
    return {
        "answer": _pairs(grade.answer),
        "reply": _reply(grade),
        "expected": _pairs(grade.row.expected),
        **{name: x if isfinite(x) else None for name, x in errors.items()},
    }


def _reply(grade: Grade) -> Json | None:
    """Return what was answered instead of a list: a first hit, or a yes or no; else None."""
    if isinstance(grade.said, First):
        return {"first": None if grade.said.t is None else _real(grade.said.t)}
    return {"hit": grade.said.hit} if isinstance(grade.said, YesNo) else None


def _pairs(numbers: Iterable[tuple[float, float]] | None) -> list[list[str]] | None:
    return None if numbers is None else [[_real(x) for x in pair] for pair in numbers]


def _real(x: float) -> str:
    return x.hex() if isfinite(x) else str(x)
