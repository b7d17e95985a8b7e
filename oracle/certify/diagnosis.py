"""What the answers of a run have in common: the likely fault, and where they belie the hello.

Whose answers are these? The failing ones are compared with those of the zoo. A fault is named if it
explains the run both ways: the share of rows on which the answers agree, of all rows that the
subject or the fault fails, is at least SHARE. It has to be the only such fault, and more than a few
rows have to agree. Otherwise nothing is said. Contradictions of the hello stand beside the verdict,
which they do not change.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import isinf, isnan, ldexp
from typing import Any

from raycert.cases.accept import Numbers
from raycert.cases.formats import BINARY32, BINARY64, Format
from raycert.cases.levels import Level, upto
from raycert.cases.protocol import FROM_INSIDE, FromInside, Hello
from raycert.oracle.certify.grading import Grade, usual
from raycert.oracle.certify.verdict import Touches, by_solid
from raycert.oracle.judge.answer import First, Listed
from raycert.oracle.zoo.inhabitants import FAULTS
from raycert.oracle.zoo.matrix import Outcome, Trials
from raycert.oracle.zoo.tracer import Fault

SHARE = 0.92
"""Between 1, the share of a fault with itself, and 0.83, the most that any two of the zoo share
over the corpus; tests/certify/test_diagnosis.py measures that."""
LEAST = 8
"""Fewer failures than these are explained by too many faults."""
SLACK = 12
"""Bits of an endpoint that may differ: roundings of another formula. Faults differ in far more."""
SAMPLE = 48
"""Failures that every fault is tried on; all others are for those that explain these."""


def diagnose(grades: Sequence[Grade]) -> list[dict[str, Any]]:
    """Return the likely fault for each type of solid, as the certificate has it."""
    return [found for group in by_solid(grades) for found in likely(group.name, group.grades)]


def likely(solid: str, grades: Sequence[Grade]) -> list[dict[str, Any]]:
    """Return what the failing answers look like: one finding, or none. For lists of intervals."""
    level, failing = failures(grades)
    if len(failing) < LEAST:
        return []
    bench, named = Trials([g.row for g in grades], grades[0].judge.format), []
    sample = failing[:: max(len(failing) // SAMPLE, 1)]
    ids = {g.row.id for g in sample}
    for fault in FAULTS:
        if fault.stateful or _outcomes(fault, sample, ids, 1) is not None:
            agreed, share = explained(fault, level, bench, grades, failing)
            if agreed >= LEAST and share >= SHARE:
                named.append((fault, agreed))
    if len(named) != 1:
        return []
    fault, agreed = named[0]
    tracer = fault.make()
    agreeing = (g for g in failing if agrees(g, Outcome.of(tracer, g.row, g.judge.format)))
    first = next(agreeing, failing[0])
    said = {"fault": fault.name, "does": fault.does, "origin": fault.origin}
    causes = [{**said, "rows": agreed, "first": first.row.id}]
    counts = {"failures": len(failing), "explained": causes}
    return [{"solid": solid, "level": level, **counts, "unexplained": len(failing) - agreed}]


def failures(grades: Sequence[Grade]) -> tuple[Level, list[Grade]]:
    """Return the failures to explain: of `sound`; of `stable` where those are only a few."""
    counted = usual(grades)
    gross = [g for g in counted if g.fault("sound")]
    if len(gross) >= LEAST:
        return "sound", gross
    return "stable", [g for g in counted if g.fault("sound") or g.fault("stable")]


def explained(
    fault: Fault, level: Level, bench: Trials, grades: Sequence[Grade], failing: Sequence[Grade]
) -> tuple[int, float]:
    """Return on how many failures a fault agrees, and their share of its failures and these.

    The share is 0 where the failures alone keep it below SHARE.
    """
    ids = {g.row.id for g in failing}
    outcomes = _outcomes(fault, grades, ids)
    if outcomes is None:
        return 0, 0.0
    tried = list(zip(grades, outcomes, bench.base, strict=True))
    agreed = sum(agrees(g, outcome) for g, outcome, _ in tried if g.row.id in ids)
    levels = upto(level)
    others = 0
    for g, outcome, base in tried:
        if g.row.id not in ids and g.row.tier != "range" and outcome != base:
            refusal = bench.refusal(g.row, outcome, base)
            others += refusal is not None and refusal.level in levels
    return agreed, agreed / (len(failing) + others)


def _outcomes(
    fault: Fault, grades: Sequence[Grade], failing: set[str], more: int = 0
) -> list[Outcome] | None:
    """Return what a fault answers to all rows; None once it disagrees on too many failures.

    Too many are those that keep the share below SHARE, and `more`.
    """
    tracer, outcomes = fault.make(), []
    spare = (1 - SHARE) * len(failing) + more
    for g in grades:
        outcome = Outcome.of(tracer, g.row, g.judge.format)
        outcomes.append(outcome)
        spare -= g.row.id in failing and not agrees(g, outcome)
        if spare < 0:
            return None
    return outcomes


def agrees(grade: Grade, outcome: Outcome) -> bool:
    """Whether a graded answer is that of a fault, but for roundings.

    No answer agrees with none, NaN with NaN wherever it stands, and a list with one as long.
    """
    if grade.answer is None or outcome.answer is None:
        said = next(iter(grade.faults.values()), "")
        return grade.answer is outcome.answer and said.startswith(("crash", "error"))
    return close(grade.answer, outcome.answer, grade.judge.format)


def close(one: Numbers, other: Numbers, fmt: Format) -> bool:
    """Whether two lists differ by some roundings of their largest number."""
    ends, others = [x for pair in one for x in pair], [x for pair in other for x in pair]
    if any(map(isnan, ends)) or any(map(isnan, others)):
        return any(map(isnan, ends)) and any(map(isnan, others))
    if len(ends) != len(others):
        return False
    size = max((abs(x) for x in (*ends, *others) if not isinf(x)), default=0.0)
    slack = ldexp(size, SLACK - fmt.precision)
    return all(a == b or abs(a - b) <= slack for a, b in zip(ends, others, strict=True))


FEW = 8
"""Fewer rows than these show no habit."""


def contradictions(hello: Hello, grades: Sequence[Grade]) -> list[str]:
    """Return what the hello says and the answers do not bear out, a sentence each."""
    return [
        *_convention(hello, grades),
        *_unsupported(grades),
        *_from_inside(hello, grades),
        *_precision(hello, grades),
    ]


def _convention(hello: Hello, grades: Sequence[Grade]) -> Iterator[str]:
    for group in by_solid(grades):
        touches = Touches.of(group.grades)
        if not touches.follows(hello.convention):
            yield f"{group.name}: the hello says {hello.convention}, the answers are {touches.name}"


def _unsupported(grades: Sequence[Grade]) -> Iterator[str]:
    """Yield solids that are declared, and not one of which is answered."""
    for group in by_solid(grades):
        faults = [g.faults.get("sound", "") for g in group.grades]
        if all(text.startswith("unsupported: ") for text in faults):
            yield (
                f"{group.name}: the hello declares it, and all {len(faults)} answers are "
                f"{faults[0]!r:.100}; leave it out of `solids`, and it is listed as not tested"
            )


def _from_inside(hello: Hello, grades: Sequence[Grade]) -> Iterator[str]:
    """Yield a mode that the starts inside do not fit, where another one does."""
    starts = [g for g in grades if isinstance(g.said, First) and g.row.accept["sound"].inner]
    inside = [g for g in starts if g.row.accept["sound"].inner[0][0] == 0]
    if len(inside) < FEW or 2 * _fits(inside, hello.from_inside) > len(inside):
        return
    best = max(FROM_INSIDE, key=lambda mode: _fits(inside, mode))
    if 10 * _fits(inside, best) >= 9 * len(inside):
        yield (
            f"the hello says from_inside {hello.from_inside!r}, and {_fits(inside, best)} of "
            f"{len(inside)} answers from inside are those of {best!r}"
        )


def _fits(grades: Sequence[Grade], mode: FromInside) -> int:
    firsts = [(g.said, g.row.accept["sound"]) for g in grades if isinstance(g.said, First)]
    return sum(replace(said, from_inside=mode).fault(accept) is None for said, accept in firsts)


def _precision(hello: Hello, grades: Sequence[Grade]) -> Iterator[str]:
    """Yield answers that are all binary32 numbers, where hardly a right one would be."""
    if hello.format is not BINARY64:
        return
    telling = [x for g in grades for x, t in _numbers(g) if not _is_single(t)]
    if len(telling) >= FEW and all(map(_is_single, telling)):
        yield (
            "the hello says binary64, and every number in the answers is a binary32 number: they "
            "are rounded to single precision somewhere, or `precision` has to be binary32"
        )


def _numbers(grade: Grade) -> Iterator[tuple[float, float]]:
    """Yield each finite number that was answered with the one that was expected."""
    if isinstance(grade.said, Listed) and len(grade.said.pairs) == len(grade.row.expected):
        for pair, wanted in zip(grade.said.pairs, grade.row.expected, strict=True):
            yield from ((x, t) for x, t in zip(pair, wanted, strict=True) if not isinf(x))


def _is_single(x: float) -> bool:
    return x == BINARY32.nearest(x)
