"""Causes: why a way breaks, told by which remedy restores it. Never by the way's name.

A remedy is the same problem with one source of error taken away, exactly, and the rest as it was.
It has an exact answer of its own, so what a way answers to it is judged like any other answer. A
remedy that changes nothing gives None.

    scaled      lengths and direction times powers of two: no product leaves the range, and no
                other rounding differs
    at-origin   p moved to the coordinate origin: origin - p is exact
    beside      p and q slid along the axis next to the start: origin - p has no axial part; an
                infinite cylinder stays the one it is
    open        the wall alone
    abreast     the wall alone, and p slid to where the ray is nearest to the axis
    restart     the start moved along its ray to 3 radii before the closest approach to the axis
    upright     in a frame along the coordinate axes: w/|w| is exact, v x w loses nothing

The broken answers are those with strict k > 64 at the first steps beyond the stable range. Their
questions are asked again with each remedy. A remedy tells the cause if it brings k to 64 or less on
nine in ten of them; where several do, the first in ORDER. Where none does, the cause is `not told`.
Two probes stand beside the remedies:

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
from itertools import islice
from math import isfinite

from raycert.cases.families.frames import ALIGNED, UPRIGHT, Exact, Number
from raycert.cases.families.sketch import Ball, Body, Node, Shape, moved, plus, times, two
from raycert.cases.formats import BINARY32
from raycert.oracle.measure.errors import Referee
from raycert.oracle.measure.ranges import LEVELS, MOST, Point, sides
from raycert.oracle.measure.sweeps import Sample, Sweep, root
from raycert.oracle.measure.way import Answered, Solve

Remedy = Callable[[Sample], Sample | None]
Remedies = Mapping[str, Remedy]
BACK = 3
"""Radii before the closest approach at which `restart` starts."""
STEPS = 3
"""Steps from the first broken one on that lend samples."""
ENOUGH = 8
"""Broken samples that are looked at."""
SHARE = 0.9
ORDER = ("binary32", "scaled", "parallel", "at-origin", "restart", "beside", "upright", "open",
         "abreast")  # fmt: skip
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


# Remedies.


def first_leaf(shape: Shape) -> Body | Ball:
    return first_leaf(shape.of[0]) if isinstance(shape, Node) else shape


def anchor(shape: Shape) -> Exact:
    leaf = first_leaf(shape)
    return leaf.center if isinstance(leaf, Ball) else leaf.p


def magnitude(*numbers: Number) -> int:
    """Return the e for which the largest of numbers, not all zero, is in [1/2, 1) 2^e."""
    largest = max(abs(Fraction(number)) for number in numbers)
    e = largest.numerator.bit_length() - largest.denominator.bit_length()
    return e + 1 if largest >= two(e) else e


def _size(sample: Sample) -> Number:
    """Return the length that the scene is made in: the radius, or the stretch of the frame."""
    leaf = first_leaf(sample.shape)
    return sample.frame.stretch * (leaf.radius or 1)


def scaled(sample: Sample) -> Sample | None:
    """Return it with the radius and the direction about as long as 1."""
    shrink = -magnitude(_size(sample))
    slow = -magnitude(*sample.direction)
    if not shrink and not slow:
        return None
    frame = sample.frame.scaled(two(shrink))
    slow -= magnitude(frame.stretch)  # the frame stretches directions too
    return replace(sample, frame=frame, direction=times(two(slow), sample.direction))


def at_origin(sample: Sample) -> Sample | None:
    """Return it with p at the coordinate origin."""
    p = anchor(sample.shape)
    if p == (0, 0, 0) and sample.frame.shift == (0, 0, 0):
        return None
    back, frame = times(-1, p), sample.frame.moved((0, 0, 0))
    return Sample(moved(sample.shape, back), plus(sample.origin, back), sample.direction, frame)


def beside(sample: Sample) -> Sample | None:
    """Return it with the axis of an infinite cylinder given by points next to the start."""
    shape = sample.shape
    if not isinstance(shape, Body) or shape.kind != "infinite_cylinder":
        return None
    along: Exact = (0, 0, sample.origin[2] - shape.p[2])
    return replace(sample, shape=moved(shape, along)) if along[2] else None


def nearest(sample: Sample) -> Fraction | None:
    """Return the t at which the ray is nearest to the axis; None along it, and without one."""
    leaf, (a, b, _) = first_leaf(sample.shape), sample.direction
    across = Fraction(a) ** 2 + Fraction(b) ** 2
    if isinstance(leaf, Ball) or not leaf.radius or not across:
        return None
    return -(sample.origin[0] * a + sample.origin[1] * b) / across


def open_ended(sample: Sample) -> Sample | None:
    shape = sample.shape
    if not isinstance(shape, Body) or shape.kind != "cylinder":
        return None
    return replace(sample, shape=replace(shape, kind="infinite_cylinder"))


def abreast(sample: Sample) -> Sample | None:
    """Return the wall alone, with p where the ray is nearest to the axis."""
    shape, t = sample.shape, nearest(sample)
    if t is None or not isinstance(shape, Body):
        return None
    level = sample.origin[2] + t * sample.direction[2]
    tube = replace(shape, kind="infinite_cylinder")
    return replace(sample, shape=moved(tube, (0, 0, level - shape.p[2])))


def restart(sample: Sample) -> Sample | None:
    """Return it with the start moved along its ray to 3 radii before the axis."""
    leaf, direction, meet = first_leaf(sample.shape), sample.direction, nearest(sample)
    if meet is None or isinstance(leaf, Ball):
        return None
    speed = root(Fraction(direction[0]) ** 2 + Fraction(direction[1]) ** 2)
    return replace(sample, origin=plus(sample.origin, direction, meet - BACK * leaf.radius / speed))


def upright(sample: Sample) -> Sample | None:
    """Return it in a frame along the coordinate axes, its anchor and size about where they were."""
    frame = sample.frame
    if frame.name in {aligned.name for aligned in ALIGNED} | {UPRIGHT.name}:
        return None
    return replace(sample, frame=UPRIGHT.scaled(frame.stretch).moved(frame.shift))


def parallel(sample: Sample) -> Sample:
    """Return it with a direction exactly along the axis: no remedy, but a probe."""
    return replace(sample, direction=(0, 0, sample.direction[2]))


REMEDIES: dict[str, Remedy] = {
    "scaled": scaled,
    "at-origin": at_origin,
    "beside": beside,
    "restart": restart,
    "open": open_ended,
    "abreast": abreast,
    "upright": upright,
}


def start_distance(sample: Sample) -> float:
    """Return the distance of the start from the axis in radii, roughly: 0 where there is none."""
    leaf = first_leaf(sample.shape)
    if isinstance(leaf, Ball) or not leaf.radius:
        return 0.0
    x, y = (Fraction(sample.origin[i]) / leaf.radius for i in (0, 1))
    return float(root(x * x + y * y))


def doublings(sample: Sample) -> int:
    """Return how many doublings the lengths or the direction are away from about 1."""
    size = abs(magnitude(_size(sample)))
    return max(size, abs(magnitude(*sample.direction) + magnitude(sample.frame.stretch)))


# Causes.


@dataclass(frozen=True, slots=True)
class Breakage:
    """A sample that a method answers with strict k > 64, and its answer."""

    sample: Sample
    answer: Answered
    referee: Referee


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
    return [x for x in outward[:STEPS] if not LEVELS["stable"](curve[x])]


def broken_samples(samples: Iterable[Sample], solve: Solve) -> list[Breakage]:
    """Return the samples that break a method, up to as many as are looked at."""
    asked = [(s, referee) for s in samples if (referee := s.referee()) is not None]
    answers = solve([referee.case for _, referee in asked])
    broken = (
        Breakage(sample, answer, referee)
        for (sample, referee), answer in zip(asked, answers, strict=True)
        if referee.backward(answer, "strict") > MOST
    )
    return list(islice(broken, ENOUGH))


def restored(samples: Sequence[Sample], solve: Solve, remedies: Remedies) -> dict[str, int]:
    """Return on how many samples each remedy leaves k at 64 or less."""
    asked: list[tuple[str, Referee]] = []
    for name, remedy in remedies.items():
        for sample in samples:
            changed = remedy(sample)
            referee = None if changed is None else changed.referee()
            if referee is not None:
                asked.append((name, referee))
    answers = solve([referee.case for _, referee in asked])
    counts = dict.fromkeys(remedies, 0)
    for (name, referee), answer in zip(asked, answers, strict=True):
        counts[name] += referee.is_stable(answer)
    return counts


def copies(sample: Sample, count: int) -> list[Sample]:
    return [
        replace(sample, frame=sample.frame.scaled(Fraction(COPIES + i, COPIES)))
        for i in range(1, count + 1)
    ]


def _rare(
    broken: Sequence[Breakage], solve: Solve, candidates: Sequence[str]
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


def taken_for_parallel(broken: Sequence[Breakage], solve: Solve) -> int:
    near = [one for one in broken if _slope(one.sample) <= NEARLY]
    asked = [(one, q) for one in near if (q := parallel(one.sample).referee()) is not None]
    answers = solve([referee.case for _, referee in asked])
    return sum(one.answer == a for (one, _), a in zip(asked, answers, strict=True))


def has_few_digits(one: Breakage) -> bool:
    """Whether an answer has numbers of binary32 only, and errors of its size."""
    ends = [t for pair in one.answer or () for t in pair if t and isfinite(t)]
    few = bool(ends) and all(map(BINARY32.holds, ends))
    return few and one.referee.backward(one.answer, "strict") <= MOST * BINARY32_UNIT


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


def _text(told: str | None, broken: Sequence[Breakage]) -> str:
    match told:
        case None:
            return NOT_TOLD
        case "scaled":
            near = min(doublings(one.sample) for one in broken) <= SAFE_DOUBLINGS
            return "an absolute tolerance" if near else "over- or underflow"
        case "restart":
            if min(start_distance(one.sample) for one in broken) <= FAR_START:
                return "cancellation at a start near the wall"
            squared = sum(one.referee.backward(one.answer, "squared") <= MOST for one in broken)
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
