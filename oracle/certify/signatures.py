"""What failing answers may have in common without a fault that is known to answer so.

A signature is a statement of the answers, true of each row that it is said of. Those of numbers say
how the answers come from the right ones; the others need to hold of nearly all that is unexplained.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import hypot, isfinite, ldexp, log2

from raycert.cases.formats import BINARY32, BINARY64
from raycert.oracle.certify.alike import Manner, agrees, kind, numbers
from raycert.oracle.certify.grading import Grade

SEEN = "seen in the answers"
"""The origin of a signature."""
DIGITS = 6
"""Digits in which offsets, and factors, are one."""
TEXT = 60
"""Characters of a text of others that are part of a name."""


@dataclass(frozen=True, slots=True)
class Signature:
    """A statement of the answers; `does` completes "a tracer that ...".

    `telling` is how many bits each row is worth; `alone` whether it is said only where it holds
    of nearly all that nothing else explains.
    """

    name: str
    does: str
    holds: Callable[[Grade], bool]
    telling: float
    alone: bool = False
    origin: str = SEEN


def signatures(failing: Sequence[Grade]) -> list[Signature]:
    """Return the signatures that some failing answers may have."""
    return [*_KINDS, *_NUMBERS, *_silences(failing), *_moves(failing)]


def _is(*wanted: str) -> Callable[[Grade], bool]:
    return lambda grade: grade.said is not None and kind(grade.said) in wanted


def _negative(grade: Grade) -> bool:
    return grade.said is not None and any(x < 0 for x in _ends(grade))


def _ends(grade: Grade) -> list[float]:
    """Return the finite numbers of an answer."""
    pairs = numbers(grade.said) if grade.said else ()
    return [x for x in dict.fromkeys(x for pair in pairs for x in pair) if isfinite(x)]


def _right(grade: Grade) -> list[float]:
    """Return the finite numbers of the right answer of the same kind."""
    said = Manner(grade.said).claim(grade.row.expected) if grade.said else None
    pairs = numbers(said) if said else ()
    return [x for x in dict.fromkeys(x for pair in pairs for x in pair) if isfinite(x)]


def _times(change: Callable[[float, float], float]) -> Callable[[Grade], bool]:
    """Whether an answer is the right one changed with the length of the direction."""

    def holds(grade: Grade) -> bool:
        length = hypot(*grade.row.ray.direction)
        if length in (0.0, 1.0) or grade.said is None:
            return False
        try:
            pairs = tuple((change(a, length), change(b, length)) for a, b in grade.row.expected)
        except ArithmeticError:
            return False
        return any(_ends(grade)) and agrees(grade, Manner(grade.said).claim(pairs))

    return holds


def _single(grade: Grade) -> bool:
    """Whether all numbers are binary32, near the right ones, none of which is."""
    if grade.judge.format is not BINARY64:
        return False
    ends, right = [x for x in _ends(grade) if x], [x for x in _right(grade) if x]
    rounded = bool(ends) and all(map(_is_single, ends)) and not any(map(_is_single, right))
    return rounded and len(ends) == len(right) and all(map(_near, ends, right))


def _near(x: float, right: float) -> bool:
    """Whether two numbers differ by some roundings of binary32."""
    return abs(x - right) <= ldexp(abs(right), 8 - BINARY32.precision)


def _is_single(x: float) -> bool:
    return x == BINARY32.nearest(x)


_KINDS = (
    Signature("negative", "answers what lies behind the start", _negative, 0.5),
    Signature("nan", "answers NaN", _is("nan"), 0.5),
    Signature("missed", "sees nothing where there is something", _is("miss"), 0.5, alone=True),
    Signature("zero", "answers 0", _is("zero"), 0.5, alone=True),
    Signature("endless", "answers all of the ray", _is("endless"), 0.5, alone=True),
)
_NUMBERS = (
    Signature("times-length", "gives |v| times the right t", _times(lambda t, v: t * v), 3.0),
    Signature("over-length", "gives the right t over |v|", _times(lambda t, v: t / v), 3.0),
    Signature("single", "gives only numbers of binary32", _single, 1.0),
)


def _silences(failing: Iterable[Grade]) -> list[Signature]:
    """Return a signature for each text that stands where no answer does."""
    return [
        Signature("error", f"says {text!r}", lambda g, text=text: silence(g) == text, 0.5)  # type: ignore[misc]
        for text in dict.fromkeys(map(silence, failing))
        if text
    ]


def silence(grade: Grade) -> str:
    """Return the text that stands for an answer, its numbers and names left out; "" if one does.

    >>> re.sub(NUMBER, "#", "crash: exit 139 at 0x7f3a")
    'crash: exit # at #'
    """
    if grade.said is not None:
        return ""
    text = next(iter(grade.faults.values()), "")
    plain = re.sub(NUMBER, "#", " ".join(text.split()))
    return plain if len(plain) <= TEXT else plain[:TEXT] + "..."


NUMBER = r"0x[0-9a-fA-F]+|[-+]?\d+(\.\d*)?([eE][-+]?\d+)?"
"""What two errors of one kind may differ in."""


def _moves(failing: Sequence[Grade]) -> list[Signature]:
    """Return the commonest offset and the commonest factor between answers and right ones."""
    found = []
    for name, words, move in (
        ("offset", "adds {} to the right t", _offset),
        ("factor", "gives {} times the right t", _factor),
    ):
        common = Counter(x for x in map(move, failing) if x is not None).most_common(1)
        for by, _ in common:
            holds = lambda g, move=move, by=by: move(g) == by  # noqa: E731
            found.append(Signature(name, words.format(by), holds, 3.0))
    return found


def _moved(grade: Grade) -> tuple[list[float], list[float]] | None:
    """Return the numbers of an answer and of the right one, where they are one for one."""
    ends, right = _ends(grade), _right(grade)
    return (ends, right) if ends and len(ends) == len(right) else None


def _offset(grade: Grade) -> float | None:
    if (both := _moved(grade)) is None:
        return None
    return _one([_rounded(x - t) for x, t in zip(*both, strict=True)])


def _factor(grade: Grade) -> float | None:
    if (both := _moved(grade)) is None:
        return None
    return _one([_rounded(x / t) for x, t in zip(*both, strict=True) if t] or [1.0])


def _rounded(x: float) -> float:
    return float(f"{x:.{DIGITS - 1}e}")


def _one(found: Sequence[float]) -> float | None:
    """Return the number that all are, if it moves anything by more than rounding does."""
    same = len(set(found)) == 1 and found[0] not in (0.0, 1.0)
    return found[0] if same and isfinite(found[0]) and abs(log2(abs(found[0]))) < 40 else None
