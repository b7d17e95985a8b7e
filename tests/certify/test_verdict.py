"""The gravest of many grades, and what is measured to find it."""

from collections.abc import Callable, Sequence

import pytest

from raycert.cases.levels import LEVELS
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.verdict import by_family, by_solid, gravest
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import Measure
from raycert.oracle.zoo.inhabitants import BY_NAME, SOUND
from raycert.oracle.zoo.tracer import Intersect
from shared.corpus import golden

TRACERS: dict[str, Callable[[], Intersect]] = {
    **{sound.name: lambda sound=sound: sound.tracer for sound in SOUND},  # type: ignore[misc]
    **{name: fault.make for name, fault in BY_NAME.items()},
}


def graded(name: str, hello: Hello) -> list[Grade]:
    """Return the grades of every 16th row, answered by an inhabitant of the zoo."""
    tracer, rows = TRACERS[name](), golden().rows[::16]
    replies = []
    for i, row in enumerate(rows):
        try:
            pairs = tuple((float(a), float(b)) for a, b in tracer(row.solid, row.ray))
            first = pairs[0][0] if pairs else None
            replies.append(Reply(str(i), intervals=pairs, first=first, hit=bool(pairs)))
        except ArithmeticError:
            replies.append(Reply(str(i), error="division"))
    return [grade(row, reply, hello) for row, reply in zip(rows, replies, strict=True)]


def key(grade: Grade) -> tuple[int, float, float, float]:
    """Return what grows with how bad a grade is, everything measured."""
    failed = [i for i, level in enumerate(LEVELS) if grade.fault(level)]
    k = [
        float("inf") if grade.said is None else grade.said.backward_error(grade.judge, measure)
        for measure in ("strict", "squared")
    ]
    return len(LEVELS) - min(failed, default=len(LEVELS)), *k, grade.ulps  # type: ignore[return-value]


def groups(grades: Sequence[Grade]) -> list[tuple[Grade, ...]]:
    families = [f.grades for solid in by_solid(grades) for f in by_family(solid.grades)]
    return [*families, tuple(grades), tuple(reversed(grades))]


@pytest.mark.parametrize("answers", ["intervals", "first", "any"])
@pytest.mark.parametrize("name", ["extended", "textbook", "no-clip", "minus-forgotten"])
def test_the_gravest_is_the_first_with_the_largest_errors(name: str, answers: str) -> None:
    measured = {g.row.id: key(g) for g in graded(name, Hello("x", answers=answers))}  # type: ignore[arg-type]
    for some in groups(graded(name, Hello("x", answers=answers))):  # type: ignore[arg-type]
        assert some[gravest(some)] is max(some, key=lambda g: measured[g.row.id])


def test_most_of_the_others_cost_one_step_of_k(monkeypatch: pytest.MonkeyPatch) -> None:
    """By bisection it would be seven for each measure; an answer that is exact costs none."""
    asked = 0

    def moved(self, step: int, measure: Measure, sigma: int, whole=Judge.moved):  # type: ignore[no-untyped-def]
        nonlocal asked
        asked += sigma > 0
        return whole(self, step, measure, sigma)

    grades = graded("base", Hello("x"))
    monkeypatch.setattr("raycert.oracle.judge.levels.Judge.moved", moved)
    inexact = sum(g.bracket("strict").high > 0 for g in grades)
    for some in groups(grades):
        gravest(some)
    assert 50 < inexact < len(grades) / 3
    assert asked < 2 * inexact


def test_of_equals_the_first_is_told_whatever_is_guessed() -> None:
    row, reply = golden().rows[0], Reply("0", intervals=((1.0, 2.0),))
    some = [grade(row, reply, Hello("x")) for _ in range(3)]
    for g, guess in zip(some, (3, 90, 40), strict=True):
        g.bracket("strict").guess = guess
    assert gravest(some) == 0
