"""Is it the adapter? Easy cases that are asked first, and what their answers say of the adapter.

The truths are written by hand, from solids along the axes, and no answer depends on a convention.
`adapter_faults` blames the adapter only where most of the easy cases fail in one and the same way;
it says nothing of a tracer that is merely wrong. Nothing here computes an intersection.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, pairwise
from typing import Any, Literal

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Union,
    types,
)
from raycert.cases.protocol import Hello, Pairs, Reply, cut
from raycert.oracle.client.dialogue import Limits, Outcome, Question, silence
from raycert.oracle.client.process import Failure

INF = math.inf


@dataclass(frozen=True, slots=True)
class Easy:
    """A question with its truth, and the truths for half and for twice of each radius.

    The last two are None where the question is not for telling radius from diameter.
    """

    slug: str
    solid: Solid
    ray: Ray
    truth: Pairs
    halved: Pairs | None = None
    doubled: Pairs | None = None

    @property
    def question(self) -> Question:
        return Question(f"smoke/{self.slug}", self.solid, self.ray)


def easy(hello: Hello) -> tuple[Easy, ...]:
    """Return the easy cases whose solids, parts included, are all declared."""
    return tuple(case for case in EASY if types(case.solid) <= set(hello.solids))


def _cylinder(x: float, radius: float) -> Cylinder:
    return Cylinder((x, 0, -1), (x, 0, 1), radius)


TANK = Cylinder((0, 0, 0), (0, 0, 4), 2)
PIPE = InfiniteCylinder((0, 0, 0), (0, 0, 1), 3)
LAYER = Slab((0, 0, 0), (0, 0, 4))
WALL = HalfSpace((2, 0, 0), (4, 0, 0))
BALL = Sphere((1, 2, 3), 2)
DRUM = Cylinder((0, -1, 0), (0, 3, 0), 3)
BEAM = Cylinder((1, 1, 1), (5, 1, 1), 1)
PILLARS = Union((_cylinder(0, 1), _cylinder(6, 1)))
BALLS = Union((Sphere((0, 0, 0), 1), Sphere((6, 0, 0), 1)))
OVERLAP = Intersection((_cylinder(0, 2), _cylinder(1, 2)))
TUBE = Difference((_cylinder(0, 2), _cylinder(0, 1)))
PAIRS = [(2.5, 3.5), (5.5, 6.5)], [(2.75, 3.25), (5.75, 6.25)], [(2, 4), (5, 7)]

# fmt: off
TABLE: tuple[tuple[Any, ...], ...] = (
    ("cylinder-through", TANK, (-6, 0, 1), (2, 0, 0), [(2, 4)], [(2.5, 3.5)], [(1, 5)]),
    ("cylinder-along-the-axis", TANK, (0.5, 0, -2), (0, 0, 4), [(0.5, 1.5)]),
    ("cylinder-miss", TANK, (-6, 5, 1), (2, 0, 0), []),
    ("cylinder-from-inside", TANK, (0, 0, 1), (0, 4, 0), [(0, 0.5)], [(0, 0.25)], [(0, 1)]),
    ("cylinder-parallel-outside", TANK, (3, 0, -2), (0, 0, 2), [], [], [(1, 3)]),
    ("cylinder-cap-to-side", TANK, (-1, 0, -2), (3, 0, 4),
     [(0.5, 1)], [(0.5, 2 / 3)], [(0.5, 1.5)]),
    ("cylinder-behind", TANK, (6, 0, 1), (2, 0, 0), []),
    ("cylinder-diagonal", TANK, (-6, -8, 2), (3, 4, 0), [(1.6, 2.4)], [(1.8, 2.2)], [(1.2, 2.8)]),
    ("cylinder-other-axis", DRUM, (0, 1, -9), (0, 0, 3), [(2, 4)], [(2.5, 3.5)], [(1, 5)]),
    ("cylinder-off-centre", BEAM, (-3, 1, 1), (8, 0, 0), [(0.5, 1)]),
    ("cylinder-farther", TANK, (-20, 0, 3), (4, 0, 0), [(4.5, 5.5)], [(4.75, 5.25)], [(4, 6)]),
    ("cylinder-inside-along", TANK, (0, 0, 1), (0, 0, 2), [(0, 1.5)]),
    ("infinite-cylinder-through", PIPE, (-9, 0, 7), (3, 0, 0), [(2, 4)], [(2.5, 3.5)], [(1, 5)]),
    ("infinite-cylinder-inside-along", PIPE, (1, 0, 0), (0, 0, 2), [(0, INF)]),
    ("infinite-cylinder-oblique", PIPE, (0, -15, 0), (0, 6, 8),
     [(2, 3)], [(2.25, 2.75)], [(1.5, 3.5)]),
    ("infinite-cylinder-behind", PIPE, (9, 0, 0), (4, 0, 0), []),
    ("infinite-cylinder-from-inside", PIPE, (1, 0, 5), (4, 0, 0),
     [(0, 0.5)], [(0, 0.125)], [(0, 1.25)]),
    ("slab-through", LAYER, (0, 0, -6), (0, 0, 4), [(1.5, 2.5)]),
    ("slab-inside-along", LAYER, (1, 1, 1), (5, 0, 0), [(0, INF)]),
    ("slab-oblique", LAYER, (0, 0, -4), (3, 0, 4), [(1, 2)]),
    ("slab-behind", LAYER, (0, 0, 6), (0, 0, 2), []),
    ("slab-from-inside", LAYER, (0, 0, 2), (0, 6, 8), [(0, 0.25)]),
    ("half-space-into", WALL, (6, 0, 0), (-8, 0, 0), [(0.5, INF)]),
    ("half-space-out-of", WALL, (0, 0, 0), (4, 0, 0), [(0, 0.5)]),
    ("half-space-along-outside", WALL, (6, 0, 0), (0, 3, 4), []),
    ("half-space-oblique", WALL, (17, 0, 0), (-6, 8, 0), [(2.5, INF)]),
    ("sphere-through", BALL, (-7, 2, 3), (4, 0, 0), [(1.5, 2.5)], [(1.75, 2.25)], [(1, 3)]),
    ("sphere-from-centre", BALL, (1, 2, 3), (0, 0, 8), [(0, 0.25)], [(0, 0.125)], [(0, 0.5)]),
    ("sphere-miss", BALL, (1, 10, 3), (0, 2, 0), []),
    ("sphere-oblique", BALL, (1, -4, -5), (0, 3, 4), [(1.6, 2.4)], [(1.8, 2.2)], [(1.2, 2.8)]),
    ("union-of-cylinders", PILLARS, (-6, 0, 0), (2, 0, 0), *PAIRS),
    ("union-of-spheres", BALLS, (-6, 0, 0), (2, 0, 0), *PAIRS),
    ("intersection-of-cylinders", OVERLAP, (-6, 0, 0), (2, 0, 0),
     [(2.5, 4)], [(3, 3.5)], [(1.5, 5)]),
    ("difference-of-cylinders", TUBE, (-6, 0, 0), (2, 0, 0),
     [(2, 2.5), (3.5, 4)], [(2.5, 2.75), (3.25, 3.5)], [(1, 2), (4, 5)]),
)
# fmt: on
"""Slug, solid, origin, direction; the truth, and where it tells those for half and for
twice the radius.

Neighbours differ, so that an answer to the question before shows.
"""
EASY = tuple(
    Easy(slug, solid, Ray(origin, direction), *map(tuple, lists))
    for slug, solid, origin, direction, *lists in TABLE
)


def limits(usual: Limits) -> Limits:
    """Return the limits for the easy cases: the usual ones, but given up soon."""
    return replace(usual, in_a_row=2)


def adapter_faults(asked: Sequence[Easy], outcomes: Mapping[str, Outcome]) -> list[str]:
    """Return what is wrong with the adapter, in plain words; nothing if that cannot be said.

    A way to fail is named where more than half of the cases fail in it.
    """
    given = [(case, outcomes.get(case.question.id)) for case in asked]
    broken = [outcome for _, outcome in given if isinstance(outcome, Failure)]
    if 2 * len(broken) > len(asked):
        return _of_failures(broken)
    replies = [(case, outcome) for case, outcome in given if isinstance(outcome, Reply)]
    refused = [text for _, reply in replies if (text := reply.unsupported or reply.error)]
    if 2 * len(refused) > len(asked):
        return [f"It answers most easy cases with {cut(refused[0], 160)!r}. {DECLARE}"]
    compared = (_compared(case, reply) for case, reply in replies if silence(reply) is None)
    return _of_answers([pair for pair in compared if pair is not None])


DECLARE = "If it cannot do a type of solid, leave that type out of `solids` in its hello."
FLUSH = (
    "flush standard output after each line (C: fflush(stdout); Python: print(..., flush=True); "
    "C++: std::endl; Java: System.out.flush(); Rust: stdout().flush())"
)
SHAPE = 'the form is {"id": "...", "intervals": [[enter, leave], ...]}, [] for a miss'


def _of_failures(broken: Sequence[Failure]) -> list[str]:
    first = broken[0]
    kind, times = Counter(failure.kind for failure in broken).most_common(1)[0]
    if 2 * times > len(broken) and kind != "unrepeatable":
        return [_saying(next(failure for failure in broken if failure.kind == kind))]
    return [f"It fails on most easy cases, in different ways; first: {first.kind}: {first.detail}."]


def _saying(failure: Failure) -> str:
    seen = failure.detail
    match failure.kind:
        case "hang" if failure.line:
            return (
                "Its answers come too late: what it wrote came only when its input was closed, or "
                f"has no newline at its end. End each answer with a newline and {FLUSH}; do not "
                f"wait for the end of the input. Seen: {failure.line!r}."
            )
        case "hang":
            return (
                f"It does not answer ({seen}). Read one line, answer it, and {FLUSH}; "
                "do not wait for the end of the input."
            )
        case "crash":
            return (
                f"It ends or crashes on most easy cases: {seen}. It has to go on reading lines "
                "until its input ends."
            )
        case "wrong-id":
            return (
                f"It does not give the id back: {seen}. Copy `id`, a string, from each question "
                "to its answer, and answer in order, one line each."
            )
        case "malformed":
            return f"Its answers have too many pairs: {seen}."
    return _of_bad_line(failure)


def _of_bad_line(failure: Failure) -> str:
    try:
        message = json.loads(failure.line)
    except (ValueError, RecursionError):
        return (
            f"It writes something else than answers to standard output: {failure.detail}. Anything "
            "but answers belongs on standard error; each answer is one line of JSON."
        )
    hits = message.get("intervals") if isinstance(message, dict) else None
    if isinstance(hits, list) and hits and not any(isinstance(hit, list) for hit in hits):
        return (
            f"Its intervals are not nested: {json.dumps(hits)[:80]}. Each interval is a list of "
            "its own: [[2, 4]], and not [2, 4]."
        )
    return f"Its answers have not the form that its hello promises: {failure.detail}; {SHAPE}."


def _compared(case: Easy, reply: Reply) -> tuple[Easy, Pairs] | None:
    """Return a case and its answer, both in the form that was asked for; None if there is none.

    A first hit t becomes the list [(t, t)], and a yes the list [(0, 0)].
    """
    if reply.intervals is not None:
        return case, reply.intervals
    if reply.hit is not None:
        return _seen_as(lambda _: 0.0, case), ((0.0, 0.0),) if reply.hit else ()
    if case.truth and case.truth[0][0] == 0:
        return None  # from inside, what is first depends on the mode
    first = reply.first
    return _seen_as(lambda enter: enter, case), () if first is None else ((first, first),)


def _seen_as(view: Callable[[float], float], case: Easy) -> Easy:
    """Return the case with one number for each list: a view of where it begins."""

    def seen(truth: Pairs | None) -> Any:
        return truth and tuple((view(enter), view(enter)) for enter, _ in truth[:1])

    lists = seen(case.truth), seen(case.halved), seen(case.doubled)
    return Easy(case.slug, case.solid, case.ray, *lists)


Misreading = Callable[[float, float, float], tuple[float, float]] | Literal["halved", "doubled"]
"""What it makes of each pair, knowing |direction|; or which of the other truths it answers."""
# fmt: off
MISREADINGS: tuple[tuple[str, Misreading], ...] = (
    ("Its answers are t * |direction|: distances, or the direction was normalised. t is in units "
     "of the direction as it is given, so divide by |direction|.", lambda a, b, v: (a * v, b * v)),
    ("Its answers are t * |direction|^2: a division by direction . direction is missing.",
     lambda a, b, v: (a * v**2, b * v**2)),
    ("Its answers are t / |direction|: they are divided by the length once too often.",
     lambda a, b, v: (a / v, b / v)),
    ("Its answers are t^2: squared parameters.", lambda a, b, _: (a * a, b * b)),
    ("It has enter and leave swapped: each pair is [enter, leave].", lambda a, b, _: (b, a)),
    ("Its pairs are [enter, length]: the second number is where the ray leaves.",
     lambda a, b, _: (a, b - a)),
    ("It takes `radius` as the diameter: its answers are those for half the radius.", "halved"),
    ("It doubles `radius`: its answers are those for twice the radius.", "doubled"),
)
# fmt: on


def _misreads(case: Easy, misreading: Misreading) -> Pairs | None:
    """Return what a misreading answers to a case; None where the case does not tell."""
    if isinstance(misreading, str):
        return case.halved if misreading == "halved" else case.doubled
    speed = math.hypot(*case.ray.direction)
    return tuple(misreading(enter, leave, speed) for enter, leave in case.truth)


def _of_answers(answers: Sequence[tuple[Easy, Pairs]]) -> list[str]:
    wrong = sum(not _close(answer, case.truth) for case, answer in answers)
    if 2 * wrong <= sum(bool(case.truth) for case, _ in answers):
        return []
    sayings = *_constant(answers), *_late(answers), *_misread(answers, wrong)
    return list(sayings[:1])


def _constant(answers: Sequence[tuple[Easy, Pairs]]) -> Iterator[str]:
    first = answers[0][1]
    if len(answers) > 1 and all(_close(answer, first) for _, answer in answers):
        if first:
            yield f"It gives the same answer to every question: {[list(pair) for pair in first]}."
        else:
            yield (
                "It answers every question with a miss. Is the solid read from the question, and "
                "are the hits put into the answer?"
            )


def _late(answers: Sequence[tuple[Easy, Pairs]]) -> Iterator[str]:
    """Yield that the answers belong to the question before."""
    shifted = [_close(answer, before.truth) for (before, _), (_, answer) in pairwise(answers)]
    if len(shifted) > 2 and all(shifted):
        yield (
            "It answers each question with the answer of the one before: it is off by one. Write "
            "the answer after computing it, before reading the next line."
        )


def _misread(answers: Sequence[tuple[Easy, Pairs]], wrong: int) -> Iterator[str]:
    """Yield each misreading that foretells most of the wrong answers, and hardly a false one."""
    for text, misreading in MISREADINGS:
        tells = [
            _close(answer, subject)
            for case, answer in answers
            if (subject := _misreads(case, misreading)) is not None
            and not _close(subject, case.truth)
        ]
        if sum(tells) >= 3 and 2 * sum(tells) > wrong and 5 * sum(tells) >= 4 * len(tells):
            yield text


def _close(subject: Pairs, truth: Pairs) -> bool:
    """Whether two lists agree to about five digits."""
    ends, others = chain(*subject), chain(*truth)
    return len(subject) == len(truth) and all(
        math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-6) for a, b in zip(ends, others, strict=True)
    )
