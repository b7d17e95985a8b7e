"""The likely fault: whose answers are these? The failing ones are compared with those of the zoo.

A fault is named if it explains the run both ways: the share of rows on which the answers agree, of
all rows that the subject or the fault fails, is at least SHARE. It has to be the only such fault,
and more than a few rows have to agree. Otherwise nothing is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isinf, isnan, ldexp

from raycert.cases.accept import Numbers
from raycert.cases.formats import Format
from raycert.cases.levels import Level
from raycert.oracle.certify.grading import Grade
from raycert.oracle.zoo.catalog import FAULTS
from raycert.oracle.zoo.fault import Fault
from raycert.oracle.zoo.matrix import Bench, Outcome

SHARE = 0.92
"""Between 1, the share of a fault with itself, and 0.83, the most that any two of the zoo share
over the corpus; tests/certify/test_diagnosis.py measures that."""
LEAST = 8
"""Fewer failures than these are explained by too many faults."""
SLACK = 12
"""Bits of an endpoint that may differ: roundings of another formula. Faults differ in far more."""
SAMPLE = 48
"""Failures that every fault is tried on; all others are for those that explain these."""


def diagnose(grades: Sequence[Grade]) -> list[str]:
    """Return what the failing answers look like: one sentence, or none. For lists of intervals."""
    level, failing = failures(grades)
    if len(failing) < LEAST:
        return []
    bench, named = Bench([g.row for g in grades], grades[0].judge.format), []
    for fault in FAULTS:
        if fault.stateful or _plausible(fault, failing):
            agreed, share = explained(fault, level, bench, grades, failing)
            if agreed >= LEAST and share >= SHARE:
                named.append((fault, agreed))
    if len(named) != 1:
        return []
    fault, agreed = named[0]
    return [
        f"on {agreed} of {len(failing)} failures your answers are those of a tracer that "
        f"{fault.does} ({fault.name}; {fault.origin})"
    ]


def failures(grades: Sequence[Grade]) -> tuple[Level, list[Grade]]:
    """Return the failures to explain: of `sound`; of `stable` where those are only a few."""
    counted = [g for g in grades if g.row.tier != "range"]
    gross = [g for g in counted if g.fault("sound")]
    if len(gross) >= LEAST:
        return "sound", gross
    return "stable", [g for g in counted if g.fault("sound") or g.fault("stable")]


def _plausible(fault: Fault, failing: Sequence[Grade]) -> bool:
    """Tell whether a fault may explain the failures, by a sample of them."""
    step = max(len(failing) // SAMPLE, 1)
    sample, tracer = failing[::step], fault.make()
    spare = (1 - SHARE) * len(sample) + 1
    for g in sample:
        spare -= not agrees(g, Outcome.of(tracer, g.row, g.judge.format))
        if spare < 0:
            return False
    return True


def explained(
    fault: Fault, level: Level, bench: Bench, grades: Sequence[Grade], failing: Sequence[Grade]
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
    levels = ("sound",) if level == "sound" else ("sound", "stable")
    others = 0
    for g, outcome, base in tried:
        if g.row.id not in ids and g.row.tier != "range" and outcome != base:
            refusal = bench.refusal(g.row, outcome, base)
            others += refusal is not None and refusal.level in levels
    return agreed, agreed / (len(failing) + others)


def _outcomes(fault: Fault, grades: Sequence[Grade], failing: set[str]) -> list[Outcome] | None:
    """Return what a fault answers to all rows; None once it disagrees on too many failures."""
    tracer, outcomes = fault.make(), []
    spare = (1 - SHARE) * len(failing)
    for g in grades:
        outcome = Outcome.of(tracer, g.row, g.judge.format)
        outcomes.append(outcome)
        spare -= g.row.id in failing and not agrees(g, outcome)
        if spare < 0:
            return None
    return outcomes


def agrees(grade: Grade, outcome: Outcome) -> bool:
    """Tell whether a graded answer is that of a fault, but for roundings.

    No answer agrees with none, NaN with NaN wherever it stands, and a list with one as long.
    """
    if grade.answer is None or outcome.answer is None:
        said = next(iter(grade.faults.values()), "")
        return grade.answer is outcome.answer and said.startswith(("crash", "error"))
    return close(grade.answer, outcome.answer, grade.judge.format)


def close(one: Numbers, other: Numbers, fmt: Format) -> bool:
    """Tell whether two lists differ by some roundings of their largest number."""
    ends, others = [x for pair in one for x in pair], [x for pair in other for x in pair]
    if any(map(isnan, ends)) or any(map(isnan, others)):
        return any(map(isnan, ends)) and any(map(isnan, others))
    if len(ends) != len(others):
        return False
    size = max((abs(x) for x in (*ends, *others) if not isinf(x)), default=0.0)
    slack = ldexp(size, SLACK - fmt.precision)
    return all(a == b or abs(a - b) <= slack for a, b in zip(ends, others, strict=True))
