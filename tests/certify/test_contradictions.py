"""Each contradiction is told of the client that has it, and of no honest one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

from raycert.cases.formats import BINARY32
from raycert.cases.protocol import FROM_INSIDE, FromInside, Hello, Reply, first_end
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.diagnosis import contradictions
from raycert.oracle.certify.grading import Grade, grade
from shared.corpus import golden

Say = Callable[[GoldenRow], Reply]


@cache
def rows() -> Sequence[GoldenRow]:
    return [row for i, row in enumerate(golden().rows) if i % 6 == 0]


def graded(hello: Hello, say: Say) -> list[Grade]:
    return [grade(row, say(row), hello) for row in rows()]


def exact(row: GoldenRow) -> Reply:
    return Reply(row.id, intervals=row.expected)


def single(row: GoldenRow) -> Reply:
    pairs = tuple((BINARY32.nearest(a), BINARY32.nearest(b)) for a, b in row.expected)
    return Reply(row.id, intervals=pairs)


def first(mode: FromInside) -> Say:
    def say(row: GoldenRow) -> Reply:
        end = first_end(row.expected, mode)
        return Reply(row.id, first=None if end is None else row.expected[end[0]][end[1]])

    return say


def test_an_honest_client_contradicts_nothing() -> None:
    hello = Hello("honest")
    assert contradictions(hello, graded(hello, exact)) == []


def test_each_mode_from_inside_is_told_from_the_others() -> None:
    for declared in FROM_INSIDE:
        hello = Hello("first", answers="first", from_inside=declared)
        for true in FROM_INSIDE:
            every = contradictions(hello, graded(hello, first(true)))
            told = [text for text in every if "from_inside" in text]
            assert len(told) == (declared != true), (declared, true, told)
            assert all(f"are those of {true!r}" in text for text in told)


def test_a_negative_answer_is_of_no_mode() -> None:
    """The t of the line's first hit, behind the start, was once called that of an exit."""

    def say(row: GoldenRow) -> Reply:
        t = first("zero")(row).first
        return Reply(row.id, first=-1.5 if t == 0 else t)

    hello = Hello("line", answers="first")
    assert not [t for t in contradictions(hello, graded(hello, say)) if "from_inside" in t]


def test_single_precision_under_a_hello_of_binary64_is_told() -> None:
    hello = Hello("single")
    [told] = contradictions(hello, graded(hello, single))
    assert "binary32 number" in told


def test_a_declared_solid_that_is_never_answered_is_told() -> None:
    def say(row: GoldenRow) -> Reply:
        slab = row.id.startswith("slab") or type(row.solid).__name__ == "Slab"
        return Reply(row.id, unsupported="no slabs") if slab else exact(row)

    hello = Hello("partial")
    [told] = contradictions(hello, graded(hello, say))
    assert told.startswith("slab: ")
    assert "no slabs" in told


def test_another_convention_is_told() -> None:
    def say(row: GoldenRow) -> Reply:
        spans = zip(row.expected, row.intervals, strict=False)
        return Reply(row.id, intervals=tuple(pair for pair, span in spans if not span.touch))

    hello = Hello("regularized")
    told = contradictions(hello, graded(hello, say))
    assert told
    assert all("the answers are regularized" in text for text in told)
