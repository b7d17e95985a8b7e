"""What implementations answer to one case, graded: each is asked that case alone.

One that cannot be run, or that does not take the case, is no error: the reason stands in place of
its answer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from raycert.cases.model import types
from raycert.cases.protocol import Hello
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.client.dialogue import Limits, Question, Target, Unusable
from raycert.oracle.client.replay import greet, run


@dataclass(frozen=True, slots=True)
class Asked:
    """An implementation asked one case: `grade` is None where it was not, for the `reason`.

    `word` is what the person called it, `name` what it calls itself.
    """

    word: str
    name: str
    grade: Grade | None
    reason: str = ""


def ask(word: str, target: Sequence[str] | Target, row: GoldenRow, precision: str) -> Asked:
    """Return the graded answer of an implementation; `word` is what to call it."""
    limits = Limits()
    try:
        hello = greet(target, limits)
        said = f"{hello.name} {hello.version}".strip() or word
        if reason := _unasked(row, hello, precision):
            return Asked(word, said, None, reason)
        ran = run(target, [Question(row.id, row.solid, row.ray)], limits)
    except Unusable as error:
        return Asked(word, word, None, f"could not be run: {error}")
    return Asked(word, said, grade(row, ran.outcomes[row.id], ran.hello))


def _unasked(row: GoldenRow, hello: Hello, precision: str) -> str:
    """Return why an implementation is not asked a case; empty where it is."""
    if hello.precision != precision:
        return f"not asked: it computes in {hello.precision}; see: --precision {hello.precision}"
    missing = sorted(types(row.solid) - set(hello.solids))
    return f"not asked: it does not declare {', '.join(missing)}" if missing else ""
