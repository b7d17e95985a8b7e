"""Causes: why a method breaks, told by which remedy restores it. Never by the method's name.

The broken answers are those with strict k > 64 at the first steps beyond the stable range. Their
questions are asked again with each remedy. A remedy tells the cause if it brings k to 64 or less on
nine in ten of them; where several do, the first in the order below. Where none does, the cause is
`not told`. Two probes stand beside the remedies:

    parallel   the answer is, to the bit, the one to a ray exactly along the axis
    binary32   every number answered is one of binary32, and k is at most 64 in units of 2^-24

A failure may be so rare that any other rounding of the same problem avoids it. The control finds
that out: a copy of the question in another size. Where that is restored too, or few answers are
broken, many copies are asked, with and without the remedies, and a remedy that leaves no failure
counts only if that would not happen by chance.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import isfinite

from raycert.cases.formats import BINARY32
from raycert.oracle.measure.methods.method import Answered, Case
from raycert.oracle.measure.stress.measure import Measured, Point, Question
from raycert.oracle.measure.stress.ranges import MOST, is_stable, sides
from raycert.oracle.measure.stress.remedies import (
    REMEDIES,
    Remedy,
    doublings,
    parallel,
    start_distance,
)
from raycert.oracle.measure.stress.sample import Sample
from raycert.oracle.measure.stress.sweeps import Sweep

Solve = Callable[[Sequence[Case]], list[Answered]]
STEPS = 3
"""Steps from the first broken one on that lend samples."""
ENOUGH = 8
"""Broken samples that are looked at."""
SHARE = 0.9
ORDER = (
    "binary32",
    "scaled",
    "parallel",
    "at-origin",
    "restart",
    "beside",
    "upright",
    "open",
    "abreast",
)
SAFE_DOUBLINGS = 100
"""No product of ten lengths this many doublings from 1 leaves the range of binary64."""
BINARY32_UNIT = 2.0**29
FAR_START = 4.0
"""Radii from the axis: further than `restart` starts."""
NEARLY = Fraction(1, 1024)
"""The slope below which a ray may be taken for parallel."""
NOT_TOLD = "not told"
CONTROL = "control"
COPIES = 1024
"""Copies that are asked to see a rare failure again."""
CHANCE = 0.01
"""How likely it may be that copies without a failure are only luck."""
Remedies = Mapping[str, Remedy]


@dataclass(frozen=True, slots=True)
class Broken:
    """A sample that a method answers with strict k > 64, and its answer."""

    sample: Sample
    answer: Answered
    measured: Measured


@dataclass(frozen=True, slots=True)
class Cause:
    """Why a method breaks at a step: the text, the remedy that told it, and what all of them did.

    `evidence` maps each remedy and probe to how many of `count` questions it accounts for: broken
    ones, or, of a rare failure, copies of them; `control` is what no remedy at all restores.
    """

    step: Fraction
    text: str
    told_by: str | None
    count: int
    evidence: Mapping[str, int]


def lending(sweep: Sweep, curve: Mapping[Fraction, Point], first: Fraction) -> list[Fraction]:
    """Return the broken steps that lend samples: `first` and those further out on its side."""
    steps = [x for x in sweep.steps if x in curve]
    if first == sweep.mild:
        outward = [first]
    else:
        outward = next(side for side in sides(steps, sweep.mild) if first in side)
        outward = outward[outward.index(first) :]
    return [x for x in outward[:STEPS] if not is_stable(curve[x])]


def broken_samples(samples: Iterable[Sample], solve: Solve) -> list[Broken]:
    """Return the samples that break a method, up to as many as are looked at."""
    asked = [(s, q) for s in samples if (q := Question.of(s)) is not None]
    answers = solve([question.case for _, question in asked])
    found: list[Broken] = []
    for (sample, question), answer in zip(asked, answers, strict=True):
        measured = question.measured(answer)
        if measured.strict > MOST:
            found.append(Broken(sample, answer, measured))
        if len(found) == ENOUGH:
            break
    return found


def restored(samples: Sequence[Sample], solve: Solve, remedies: Remedies) -> dict[str, int]:
    """Return on how many samples each remedy leaves k at 64 or less."""
    asked: list[tuple[str, Question]] = []
    for name, remedy in remedies.items():
        for sample in samples:
            changed = remedy(sample)
            question = None if changed is None else Question.of(changed)
            if question is not None:
                asked.append((name, question))
    answers = solve([question.case for _, question in asked])
    counts = dict.fromkeys(remedies, 0)
    for (name, question), answer in zip(asked, answers, strict=True):
        counts[name] += question.is_stable(answer)
    return counts


def copies(sample: Sample, count: int) -> list[Sample]:
    """Return the same problem in other sizes, whose roundings are others."""
    return [
        replace(sample, frame=sample.frame.scaled(Fraction(COPIES + i, COPIES)))
        for i in range(1, count + 1)
    ]


def _rare(
    broken: Sequence[Broken], solve: Solve, candidates: Sequence[str]
) -> tuple[int, dict[str, int], str | None]:
    """Return the copies asked, how many each candidate leaves unbroken, and the one that tells."""
    share = -(-COPIES // len(broken))
    many = [copy for one in broken for copy in copies(one.sample, share)]
    asked: Remedies = {CONTROL: lambda sample: sample} | {n: REMEDIES[n] for n in candidates}
    counts = restored(many, solve, asked)
    unbroken = counts[CONTROL] / len(many)
    if unbroken ** len(many) > CHANCE:
        return len(many), counts, None
    told = next((name for name in candidates if counts[name] == len(many)), None)
    return len(many), counts, told


def taken_for_parallel(broken: Sequence[Broken], solve: Solve) -> int:
    """Return how many answers are the ones to the ray exactly along the axis."""
    near = [one for one in broken if _slope(one.sample) <= NEARLY]
    asked = [(one, q) for one in near if (q := Question.of(parallel(one.sample))) is not None]
    answers = solve([question.case for _, question in asked])
    return sum(one.answer == a for (one, _), a in zip(asked, answers, strict=True))


def has_few_digits(one: Broken) -> bool:
    """Tell whether an answer has numbers of binary32 only, and errors of its size."""
    ends = [t for pair in one.answer or () for t in pair if t and isfinite(t)]
    few = bool(ends) and all(map(BINARY32.holds, ends))
    return few and one.measured.strict <= MOST * BINARY32_UNIT


def _slope(sample: Sample) -> Fraction:
    x, y, z = map(Fraction, sample.direction)
    return max(abs(x), abs(y)) / abs(z) if z else Fraction(1)


def diagnose(
    sweep: Sweep,
    curve: Mapping[Fraction, Point],
    first: Fraction,
    solve: Solve,
    samples: Callable[[Fraction], Sequence[Sample]],
) -> Cause:
    """Return why a method breaks at `first`, the first step of a side that is not stable."""
    steps = lending(sweep, curve, first)
    broken = broken_samples((s for x in steps for s in samples(x)), solve)
    if not broken:
        return Cause(first, NOT_TOLD, None, 0, {})
    plain = [one.sample for one in broken]
    control = {CONTROL: lambda sample: copies(sample, 1)[0]}
    evidence = restored(plain, solve, control | REMEDIES)
    evidence["parallel"] = taken_for_parallel(broken, solve)
    evidence["binary32"] = sum(map(has_few_digits, broken))
    enough = SHARE * len(broken)
    candidates = [name for name in ORDER if evidence[name] >= enough]
    count, told = len(broken), next(iter(candidates), None)
    seldom = len(broken) < ENOUGH or evidence[CONTROL] > len(broken) / 4
    if told in REMEDIES and seldom:
        candidates = [name for name in candidates if name in REMEDIES]
        count, evidence, told = _rare(broken, solve, candidates)
    return Cause(first, _text(told, broken), told, count, evidence)


def _text(told: str | None, broken: Sequence[Broken]) -> str:
    """Return what a remedy that restores tells."""
    match told:
        case None:
            return NOT_TOLD
        case "scaled":
            near = min(doublings(one.sample) for one in broken) <= SAFE_DOUBLINGS
            return "an absolute tolerance" if near else "over- or underflow"
        case "restart":
            if min(start_distance(one.sample) for one in broken) <= FAR_START:
                return "cancellation at a start near the wall"
            squared = sum(one.measured.squared <= MOST for one in broken)
            excused = squared >= SHARE * len(broken)
            return "cancellation in the discriminant" if excused else "distance of the start"
    return TEXTS[told]


TEXTS = {
    "at-origin": "cancellation in origin - p",
    "beside": "axial part of origin - p",
    "open": "rounding of the caps",
    "abreast": "p far along the axis",
    "upright": "rounding of the axis",
    "parallel": "parallel test",
    "binary32": "digits of binary32",
}
