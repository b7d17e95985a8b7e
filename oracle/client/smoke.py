"""Is it the adapter? Easy cases that are asked first, and what their answers say of the adapter.

The truths are written by hand, from solids along the axes, and no answer depends on a convention.
`adapter_faults` blames the adapter only where most of the easy cases fail in one and the same way;
it says nothing of a tracer that is merely wrong. Nothing here computes an intersection.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from raycert.cases.protocol import Pairs, Reply
from raycert.oracle.client.dialogue import Limits
from raycert.oracle.client.easy import Easy
from raycert.oracle.client.process import Failure

Outcome = Reply | Failure


def limits(usual: Limits) -> Limits:
    """Return the limits for the easy cases: the usual ones, but given up soon."""
    return replace(usual, in_a_row=2)


def adapter_faults(asked: Sequence[Easy], outcomes: Mapping[str, Outcome]) -> list[str]:
    """Return what is wrong with the adapter, in plain words; nothing if that cannot be said.

    A way to fail is named where more than half of the cases fail in it.
    """
    given = [outcomes[case.question.id] for case in asked if case.question.id in outcomes]
    broken = [outcome for outcome in given if isinstance(outcome, Failure)]
    if 2 * len(broken) > len(asked):
        return _of_failures(broken)
    refused = [text for outcome in given if (text := _refusal(outcome))]
    if 2 * len(refused) > len(asked):
        return [f"It answers most easy cases with {refused[0]!r}. {DECLARE}"]
    compared = (_compared(case, outcomes.get(case.question.id)) for case in asked)
    return _of_answers([pair for pair in compared if pair is not None])


DECLARE = "If it cannot do a type of solid, leave that type out of `solids` in its hello."
FLUSH = (
    "flush standard output after each line (C: fflush(stdout); Python: print(..., flush=True); "
    "C++: std::endl; Java: System.out.flush(); Rust: stdout().flush())"
)
SHAPE = 'the form is {"id": "...", "intervals": [[enter, leave], ...]}, [] for a miss'


def _refusal(outcome: Outcome) -> str | None:
    if isinstance(outcome, Failure):
        return None
    return outcome.unsupported or outcome.error


def _of_failures(broken: Sequence[Failure]) -> list[str]:
    """Say what most failures have in common."""
    first = broken[0]
    for kind, say in SAYINGS.items():
        same = [failure for failure in broken if failure.kind == kind]
        if 2 * len(same) > len(broken):
            return [say(same[0])]
    return [f"It fails on most easy cases, in different ways; first: {first.kind}: {first.detail}."]


def _of_hang(failure: Failure) -> str:
    if failure.line:
        return (
            "Its answers come too late: what it wrote came only when its input was closed, or has "
            f"no newline at its end. End each answer with a newline and {FLUSH}; do not wait for "
            f"the end of the input. Seen: {failure.line!r}."
        )
    return (
        f"It does not answer ({failure.detail}). Read one line, answer it, and {FLUSH}; "
        "do not wait for the end of the input."
    )


def _of_crash(failure: Failure) -> str:
    return (
        f"It ends or crashes on most easy cases: {failure.detail}. It has to go on reading lines "
        "until its input ends."
    )


def _of_wrong_id(failure: Failure) -> str:
    return (
        f"It does not give the id back: {failure.detail}. Copy `id`, a string, from each question "
        "to its answer, and answer in order, one line each."
    )


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


SAYINGS: dict[str, Callable[[Failure], str]] = {
    "hang": _of_hang,
    "crash": _of_crash,
    "wrong-id": _of_wrong_id,
    "bad-line": _of_bad_line,
}

Misreading = Callable[[Easy], Pairs | None]


def _compared(case: Easy, outcome: Outcome | None) -> tuple[Easy, Pairs] | None:
    """Return a case and its answer, both in the form that was asked for; None if there is none.

    A first hit t becomes the list [(t, t)], and a yes the list [(0, 0)].
    """
    if not isinstance(outcome, Reply) or _refusal(outcome) is not None:
        return None
    if outcome.intervals is not None:
        return case, outcome.intervals
    if outcome.hit is not None:
        return _seen_as(lambda _: 0.0, case), ((0.0, 0.0),) if outcome.hit else ()
    if case.truth and case.truth[0][0] == 0:
        return None  # from inside, what is first depends on the mode
    first = outcome.first
    return _seen_as(lambda enter: enter, case), () if first is None else ((first, first),)


def _seen_as(view: Callable[[float], float], case: Easy) -> Easy:
    """Return the case with one number for each list: a view of where it begins."""

    def seen(truth: Pairs) -> Pairs:
        return tuple((view(enter), view(enter)) for enter, _ in truth[:1])

    halved = None if case.halved is None else seen(case.halved)
    doubled = None if case.doubled is None else seen(case.doubled)
    return replace(case, truth=seen(case.truth), halved=halved, doubled=doubled)


def _each(change: Callable[[float, float], tuple[float, float]]) -> Misreading:
    """Make a misreading out of what it does to each pair."""
    return lambda case: tuple(change(enter, leave) for enter, leave in case.truth)


def _times(factor: Callable[[float], float]) -> Misreading:
    """Make a misreading that multiplies every t by a function of |direction|."""
    return lambda case: tuple(
        (enter * factor(case.speed), leave * factor(case.speed)) for enter, leave in case.truth
    )


MISREADINGS: tuple[tuple[str, Misreading], ...] = (
    (
        "Its answers are t * |direction|: distances, or the direction was normalised. t is in "
        "units of the direction as it is given, so divide by |direction|.",
        _times(lambda speed: speed),
    ),
    (
        "Its answers are t * |direction|^2: a division by direction . direction is missing.",
        _times(lambda speed: speed * speed),
    ),
    (
        "Its answers are t / |direction|: they are divided by the length once too often.",
        _times(lambda speed: 1 / speed),
    ),
    ("Its answers are t^2: squared parameters.", _each(lambda a, b: (a * a, b * b))),
    (
        "It has enter and leave swapped: each pair is [enter, leave].",
        _each(lambda a, b: (b, a)),
    ),
    (
        "Its pairs are [enter, length]: the second number is where the ray leaves.",
        _each(lambda a, b: (a, b - a)),
    ),
    (
        "It takes `radius` as the diameter: its answers are those for half the radius.",
        lambda case: case.halved,
    ),
    (
        "It doubles `radius`: its answers are those for twice the radius.",
        lambda case: case.doubled,
    ),
)


def _of_answers(answers: Sequence[tuple[Easy, Pairs]]) -> list[str]:
    """Say what most wrong answers have in common."""
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
    """Tell answers that belong to the question before."""
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
            if (subject := misreading(case)) is not None and not _close(subject, case.truth)
        ]
        if sum(tells) >= 3 and 2 * sum(tells) > wrong and 5 * sum(tells) >= 4 * len(tells):
            yield text


def _close(subject: Pairs, truth: Pairs | None) -> bool:
    """Tell whether two lists agree to about five digits."""
    return (
        truth is not None
        and len(subject) == len(truth)
        and all(
            math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-6)
            for pair, other in zip(subject, truth, strict=True)
            for a, b in zip(pair, other, strict=True)
        )
    )
