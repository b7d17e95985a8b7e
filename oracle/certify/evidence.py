"""One answer as JSON: the case, what was wrong with it, and what a picture of it needs.

Reals are hex-float strings, so that what is read back is what was compared. Infinite errors are
null.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from math import isfinite
from typing import Any

from raycert.cases.accept import Numbers
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.levels import Level
from raycert.cases.model import Tree
from raycert.cases.protocol import Hello
from raycert.cases.row import End, GoldenRow
from raycert.oracle.certify.grading import Grade, kept
from raycert.oracle.certify.verdict import severity
from raycert.oracle.judge.answer import First, YesNo
from raycert.oracle.judge.levels import MEASURES
from raycert.oracle.zoo.matrix import kind as how

Json = dict[str, Any]
Repeat = Callable[[str], str]
"""From a row's id to the command that asks it again."""
MOST, MOST_PASSED = 12, 4
"""How many worst cases are kept: of failures, and where nothing failed."""


def case(row: GoldenRow) -> Json:
    """Return a row's id and inputs, reals as hex floats."""
    return {"id": row.id, "solid": write_solid(row.solid, "hex"), "ray": write_ray(row.ray, "hex")}


def errors(grade: Grade) -> Json:
    """Return the measured errors of an answer; null for an infinite one."""
    measured = {"strict_k": grade.strict, "squared_k": grade.squared, "ulps": grade.ulps}
    return {name: x if isfinite(x) else None for name, x in measured.items()}


def reply(grade: Grade) -> Json | None:
    """Return what was answered instead of a list: a first hit, or a yes or no; else None."""
    match grade.said:
        case First(t):
            return {"first": None if t is None else _real(t)}
        case YesNo(hit):
            return {"hit": hit}
    return None


def answered(grade: Grade) -> Json:
    """Return what was answered and expected, and the errors between."""
    return {
        "answer": pairs(grade.answer),
        "reply": reply(grade),
        "expected": pairs(grade.row.expected),
        **errors(grade),
    }


def failure(grade: Grade, repeat: Repeat) -> Json:
    """Return one failing row: why, what was answered, and the command that repeats it."""
    return {
        **case(grade.row),
        "why": grade.row.why,
        "tier": grade.row.tier,
        "faults": dict(grade.faults),
        **answered(grade),
        "reproduce": repeat(grade.row.id),
    }


def worst(grades: Sequence[Grade], level: Level, hello: Hello, repeat: Repeat) -> list[Json]:
    """Return the cases to look at first, with all that a picture of them needs.

    Failures of the level, the gravest first; a family or kind of failure that is not there yet
    before one that is. Where nothing failed, the largest errors. The range tier is left out.
    """
    usual = [g for g in grades if g.row.tier != "range"]
    failing = [g for g in usual if g.fault(level)]
    passing = [] if failing else [g for g in usual if g.counts(level)]
    ranked = [
        (g, g.row.family, kind(g, level, hello))
        for g in sorted(failing or passing, key=severity, reverse=True)
    ]
    chosen = _spread(ranked, MOST if failing else MOST_PASSED)
    return [_pictured(g, name, level, hello, repeat) for g, _, name in chosen]


def _spread(ranked: Sequence[tuple[Grade, str, str]], most: int) -> list[tuple[Grade, str, str]]:
    """Return up to `most` of a ranking: each time the first of the family and kind least chosen.

    Of these a lone leaf before a tree, which is harder to see through.
    """
    left = list(ranked)
    chosen: list[tuple[Grade, str, str]] = []
    families: Counter[str] = Counter()
    kinds: Counter[str] = Counter()
    while left and len(chosen) < most:
        best = min(left, key=lambda item: (families[item[1]], kinds[item[2]], _is_tree(item[0])))
        left.remove(best)
        chosen.append(best)
        families[best[1]] += 1
        kinds[best[2]] += 1
    return chosen


def _is_tree(grade: Grade) -> bool:
    return isinstance(grade.row.solid, Tree)


def _pictured(g: Grade, name: str, level: Level, hello: Hello, repeat: Repeat) -> Json:
    inner, outer = band(g, level, hello)
    return {
        **failure(g, repeat),
        "kind": name,
        "rows": list(g.row.rows),
        "exact": [
            {"enter": _end(s.enter), "leave": _end(s.leave), "touch": s.touch}
            for s in g.row.intervals
        ],
        "accept": {"level": level, "inner": pairs(inner), "outer": pairs(outer)},
    }


def _end(end: End) -> Json:
    return {"digits": end.digits, "kind": end.kind, "faces": list(end.faces)}


def kind(grade: Grade, level: Level, hello: Hello) -> str:
    """Return in a word how an answer fails a level: crash, missed, phantom, ...; or `passed`."""
    fault = grade.fault(level)
    if fault is None:
        return "passed"
    if grade.said is None:
        return fault.partition(":")[0]
    if grade.said.malformed(grade.judge):
        return "malformed"
    if grade.answer is None:
        return "wrong"
    inner, outer = band(grade, level, hello)
    return how(outer, inner, grade.answer)


def band(grade: Grade, level: Level, hello: Hello) -> tuple[Numbers, Numbers]:
    """Return the inner and the outer list of numbers between which a level wants the answer."""
    if level in MEASURES:
        row = grade.row
        accept = grade.judge.accept(level) if hello.tolerance else row.accept[level]
        return accept.inner, accept.outer
    wanted, around = kept(grade.row, grade.judge, hello)
    if level == "exact":
        return wanted, wanted
    narrow = ((enter[1], leave[0]) for enter, leave in around)
    inner = tuple((a, b) for a, b in narrow if a <= b)
    return inner, tuple((enter[0], leave[1]) for enter, leave in around)


def pairs(numbers: Iterable[tuple[float, float]] | None) -> list[list[str]] | None:
    """Return a list of pairs as hex floats."""
    return None if numbers is None else [[_real(x) for x in pair] for pair in numbers]


def _real(x: float) -> str:
    return x.hex() if isfinite(x) else str(x)
