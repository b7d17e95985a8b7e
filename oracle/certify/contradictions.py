"""Where the answers contradict the hello: told beside the verdict, which they do not change."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import isinf

from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.protocol import FROM_INSIDE, FromInside, Hello
from raycert.oracle.certify.grading import Grade
from raycert.oracle.certify.verdict import Touches, by_solid
from raycert.oracle.judge.answer import First, Listed

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
    """Tell solids that are declared, and not one of which is answered."""
    for group in by_solid(grades):
        said = [g.faults.get("sound", "") for g in group.grades]
        if all(text.startswith("unsupported: ") for text in said):
            yield (
                f"{group.name}: the hello declares it, and all {len(said)} answers are "
                f"{said[0]!r:.100}; leave it out of `solids`, and it is listed as not tested"
            )


def _from_inside(hello: Hello, grades: Sequence[Grade]) -> Iterator[str]:
    """Tell a mode that the starts inside do not fit, where another one does."""
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
    """Tell answers that are all binary32 numbers, where hardly a right one would be."""
    if hello.format is not BINARY64:
        return
    told = [(x, t) for g in grades for x, t in _numbers(g) if not _is_single(t)]
    if len(told) >= FEW and all(_is_single(x) for x, _ in told):
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
