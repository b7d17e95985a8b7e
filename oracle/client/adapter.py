"""What is wrong with the adapter, rather than with the tracer, and what to do, in plain words.

What to do depends on what the target is: a program has a standard output to flush, a function has a
value to return, a library a symbol to export.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from raycert.cases.model import SOLIDS, type_of
from raycert.cases.protocol import Hello, cut
from raycert.oracle.client.dialogue import Outcome, Target, silence
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.client.misread import says
from raycert.oracle.client.process import UNFLUSHED, UNREAD, Failure
from raycert.oracle.client.smoke import Easy, Fallen, claimed, fallen, listed
from raycert.oracle.judge.answer import Claim, First, Listed

FLUSH = (
    "flush standard output after each line (C: fflush(stdout); Python: print(..., flush=True); "
    "C++: std::endl; Java: System.out.flush(); Rust: stdout().flush())"
)
FORMS = {
    "intervals": '{"id": "...", "intervals": [[enter, leave], ...]}, [] for a miss',
    "first": '{"id": "...", "first": t}, null for a miss',
    "any": '{"id": "...", "hit": true} or false',
}
VALUES = {
    "intervals": "a list of pairs (enter, leave), [] for a miss",
    "first": "a number, None for a miss",
    "any": "True or False",
}


def adapter_faults(
    asked: Sequence[Easy],
    outcomes: Mapping[str, Outcome],
    hello: Hello,
    target: Sequence[str] | Target = (),
) -> list[str]:
    """Return what is wrong with the adapter; nothing if that cannot be said.

    A way to fail is named where more than half of the cases fail in it, a refusal where it is that
    of every case of a type of solid.
    """
    given = [(case, outcomes[id]) for case in asked if (id := case.question.id) in outcomes]
    broken = [outcome for _, outcome in given if isinstance(outcome, Failure)]
    code = target if isinstance(target, InProcess) else None
    if 2 * len(broken) > len(asked):
        return [_of_failures(broken, hello, code)]
    said = [(case, claim) for case, o in given if (claim := claimed(o, hello)) is not None]
    wrong = sum(not says(claim, case.truth) for case, claim in said)
    alike = [*_constant(said), *_late(said)]
    if alike and 2 * wrong > sum(bool(case.truth) for case, _ in said):
        return alike[:1]
    return list(_refusals(asked, fallen(asked, outcomes, hello), hello, code))


def _constant(said: Sequence[tuple[Easy, Claim]]) -> Iterator[str]:
    """Yield that all answers are the same."""
    first = said[0][1] if len(said) > 1 else None
    if first is not None and all(repr(claim) == repr(first) for _, claim in said):
        if says(first, ()):
            yield (
                "It answers every question with a miss. Is the solid read from the question, and "
                "are the hits put into the answer?"
            )
        elif isinstance(first, Listed | First):
            told = listed(first.pairs) if isinstance(first, Listed) else first.t
            yield f"It gives the same answer to every question: {told}."


def _late(said: Sequence[tuple[Easy, Claim]]) -> Iterator[str]:
    """Yield that the answers belong to the question before."""
    shifted = [says(claim, before.truth) for (before, _), (_, claim) in pairwise(said)]
    if len(shifted) > 2 and all(shifted):
        yield (
            "It answers each question with the answer of the one before: it is off by one. Compute "
            "the answer first, and give it before the next question is read."
        )


def misread(found: Sequence[Fallen]) -> list[str]:
    """Return what is done to types of solid where all answers show it, each text once."""
    texts: dict[str, list[str]] = {}
    for each in found:
        if each.text:
            texts.setdefault(each.text, []).append(each.solid)
    return [f"{', '.join(solids)}: {text}." for text, solids in texts.items()]


# No answers: refused, or not of the form.


def _refusals(
    asked: Sequence[Easy], found: Sequence[Fallen], hello: Hello, code: InProcess | None
) -> Iterator[str]:
    """Yield that types of solid are refused, every one of them, and how not to be asked them."""
    refused = [each for each in found if each.refused == each.of]
    if not refused:
        return
    failing = {each.solid: each for each in found}
    answered = [name for name in _asked_types(asked) if failing.get(name) not in refused]
    right = [name for name in answered if name not in failing]
    known = right or answered
    *others, last = (each.solid for each in refused)
    names = f"{', '.join(others)} and {last}" if others else last
    callable_ = code is not None and code.kind == "callable"
    _, reason = silence(refused[0].outcome) or ("", "")
    seen = f"It {'raises' if callable_ else 'answers'} {cut(reason, 100)!r} on every easy {names}."
    yield f"{seen} {CALLED if callable_ and not known else _declare(known, hello, code)}"


def _asked_types(asked: Sequence[Easy]) -> list[str]:
    return list(dict.fromkeys(type_of(case.solid) for case in asked))


CALLED = (
    "It is called as intersect(solid, ray), with objects of raycert.cases.model: a Sphere has "
    "solid.center and solid.radius, a Cylinder solid.p, solid.q and solid.radius, a ray "
    "ray.origin and ray.direction; points are tuples of three floats."
)


def _declare(known: Sequence[str], hello: Hello, code: InProcess | None) -> str:
    """Return how to declare the types of solid that it knows."""
    if not known:
        return "What it cannot do has to be left out of `solids` in its hello."
    solids = json.dumps(list(known))
    if code is None:
        where = f'put "solids": {solids} into its hello'
    elif code.kind == "library":
        where = f'let raycert_hello return "solids": {solids}'
    else:
        name = code.spec.rpartition(":")[2].rpartition(".")[2]
        where = f'declare what it knows: {name}.hello = {{"solids": {solids}}}'
    every = "; without `solids` all types are asked" if _all(hello) else ""
    return f"Does it know that? If not, {where}{every}."


def _all(hello: Hello) -> bool:
    return set(hello.solids) == set(SOLIDS)


def _of_failures(broken: Sequence[Failure], hello: Hello, code: InProcess | None) -> str:
    first = broken[0]
    kind, times = Counter(failure.kind for failure in broken).most_common(1)[0]
    if 2 * times <= len(broken) or kind == "unrepeatable":
        return (
            f"It fails on most easy cases, in different ways; first: {first.kind}: {first.detail}."
        )
    failure = next(failure for failure in broken if failure.kind == kind)
    if failure.kind == "malformed":
        return f"Its answers have too many pairs: {failure.detail}."
    return _of_code(failure, hello) if code else _of_program(failure, hello)


def _of_code(failure: Failure, hello: Hello) -> str:
    seen = failure.detail
    match failure.kind:
        case "hang":
            return f"It does not return ({seen}). If it needs longer, raise --case-timeout."
        case "crash":
            return f"It ends or crashes its process on most easy cases: {seen}."
    return f"What it returns is no answer: {seen}. It has to return {VALUES[hello.answers]}."


def _of_program(failure: Failure, hello: Hello) -> str:
    seen = failure.detail
    match failure.kind:
        case "hang" if UNFLUSHED in seen:
            return (
                "Its answers come too late: what it wrote came only when its input was closed. "
                f"End each answer with a newline and {FLUSH}; do not wait for the end of the "
                f"input. Seen: {failure.line!r}."
            )
        case "hang" if UNREAD in seen:
            return (
                f"It does not read ({seen}). If it is slow to start, raise --hello-timeout and "
                "--case-timeout; else let it read standard input line by line."
            )
        case "hang" if failure.line:
            return (
                f"Its answers have no newline at their end ({seen}). End each answer with a "
                f"newline and {FLUSH}."
            )
        case "hang":
            return (
                f"It does not answer ({seen}). Read one line, answer it, and {FLUSH}; do not wait "
                "for the end of the input. If it needs longer, raise --case-timeout."
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
    return _of_bad_line(failure, hello)


def _of_bad_line(failure: Failure, hello: Hello) -> str:
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
    return (
        f"Its answers have not the form that its hello promises: {failure.detail}; the form is "
        f"{FORMS[hello.answers]}."
    )
