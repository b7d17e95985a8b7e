"""First hits and yes-or-no answers: the contract's table, its laws, and tracers that break it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import inf, isinf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.levels import LEVELS
from raycert.cases.model import HalfSpace, Ray, Sphere
from raycert.cases.protocol import FROM_INSIDE, FromInside, Hello, Reply, first
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.verdict import Touches, verdict
from raycert.oracle.judge.answer import First, YesNo, claim, first_fault
from raycert.oracle.judge.levels import Judge
from shared.corpus import golden

Lists = tuple[tuple[float, float], ...]


@st.composite
def nested(draw: st.DrawFn) -> tuple[Lists, Lists, Lists]:
    """Draw inner <= exact <= outer lists of small integers; now and then the last is endless."""
    lists: tuple[list[tuple[float, float]], ...] = ([], [], [])
    at, count = draw(st.integers(-4, 4)), draw(st.integers(0, 3))
    for left in reversed(range(count)):
        size, grow, shrink = (
            draw(st.integers(0, 6)),
            draw(st.integers(0, 2)),
            draw(st.integers(0, 3)),
        )
        end = inf if not left and draw(st.booleans()) else at + size
        for kept, by in zip(lists, (-shrink, 0, grow), strict=True):
            enter, leave = max(at - by, 0), end + by
            if enter <= leave:
                kept.append((enter, leave))
        at += size + grow + draw(st.integers(3, 6))
    inner, exact, outer = map(tuple, lists)
    return inner, exact, outer


def by_the_table(t: float | None, i: Lists, o: Lists, mode: FromInside) -> bool:
    """Return what design.md's table says, its words one by one."""
    in_i, in_o = (bool(x) and x[0][0] == 0 for x in (i, o))
    if t is None:
        return {
            "zero": not i,
            "miss": not i or in_o,
            "exit": not i or (in_o and o[0][1] == inf),
        }[mode]
    entry = any(a <= t <= b for a, b in o) and (not i or t <= i[0][0])
    if mode == "zero":
        return entry
    if mode == "miss":
        return entry and not in_i
    left = in_o and t <= o[0][1] and all(not a <= t < b for a, b in i)
    return (entry and not in_i) or left


MODES = st.sampled_from(FROM_INSIDE)
TIMES = st.none() | st.integers(0, 40).map(float)


@given(nested(), TIMES, MODES)
def test_the_rules_are_those_of_the_table(
    lists: tuple[Lists, Lists, Lists], t: float | None, mode: FromInside
) -> None:
    inner, _, outer = lists
    right = first_fault(t, inner, outer, mode, 0.0, inf) is None
    assert right == by_the_table(t, inner, outer, mode)


@given(nested(), MODES)
def test_the_first_of_the_exact_list_is_right(
    lists: tuple[Lists, Lists, Lists], mode: FromInside
) -> None:
    inner, exact, outer = lists
    assert first_fault(first(exact, mode), inner, outer, mode, 0.0, inf) is None
    assert first_fault(first(exact, mode), exact, exact, mode, 0.0, inf) is None


@given(nested(), TIMES, MODES)
def test_what_is_right_stays_right_when_the_lists_part(
    lists: tuple[Lists, Lists, Lists], t: float | None, mode: FromInside
) -> None:
    inner, exact, outer = lists
    if first_fault(t, exact, exact, mode, 0.0, inf) is None:
        assert first_fault(t, inner, outer, mode, 0.0, inf) is None


@cache
def rows() -> tuple[GoldenRow, ...]:
    """Return every seventh row, and every row of the lattice and of its starts."""
    every = golden().rows
    return tuple(r for i, r in enumerate(every) if i % 7 == 0 or r.tier == "lattice")


def hello(answers: str, mode: FromInside = "zero", convention: str = "closed") -> Hello:
    return Hello(  # type: ignore[arg-type]
        "a tracer",
        answers=answers,  # type: ignore[arg-type]
        from_inside=mode,  # type: ignore[arg-type]
        convention=convention,
        degenerate=DEGENERACIES,
    )


def graded(said: Callable[[GoldenRow], float | None], mode: FromInside) -> list[Grade]:
    return [grade(row, Reply(row.id, first=said(row)), hello("first", mode)) for row in rows()]


@pytest.mark.parametrize("mode", FROM_INSIDE)
def test_the_first_of_the_expected_list_is_exact(mode: FromInside) -> None:
    grades = graded(lambda row: first(row.expected, mode), mode)
    judged = verdict(grades, "exact", "closed")
    assert judged.granted, judged.reasons
    assert not any(g.faults or g.beside for g in grades)


def test_a_correct_first_has_a_backward_error_of_at_most_1() -> None:
    for row in rows()[::5]:
        for mode in FROM_INSIDE:
            g = grade(row, Reply(row.id, first=first(row.expected, mode)), hello("first", mode))
            assert max(g.strict, g.squared) <= 1, (row.id, mode)
            assert g.ulps <= 0.5 or isinf(first(row.expected, mode) or 0)
        g = grade(row, Reply(row.id, hit=bool(row.expected)), hello("any"))
        assert max(g.strict, g.squared) <= 1


def leave(row: GoldenRow) -> float | None:
    return row.expected[0][1] if row.expected and not isinf(row.expected[0][1]) else None


def second(row: GoldenRow) -> float | None:
    return row.expected[1][0] if len(row.expected) > 1 else first(row.expected, "zero")


WRONG: tuple[tuple[str, FromInside, Callable[[GoldenRow], float | None]], ...] = (
    ("the leave for the enter", "zero", leave),
    ("the second piece of a tree", "zero", second),
    ("the exit, declared as zero", "zero", lambda row: first(row.expected, "exit")),
    ("zero, declared as exit", "exit", lambda row: first(row.expected, "zero")),
    ("zero, declared as miss", "miss", lambda row: first(row.expected, "zero")),
    ("a miss, declared as zero", "zero", lambda row: first(row.expected, "miss")),
    ("a miss, declared as exit", "exit", lambda row: first(row.expected, "miss")),
    ("never a hit", "zero", lambda row: None),
    ("always 0", "zero", lambda row: 0.0),
    ("an ulp of binary32 beyond", "zero", lambda row: nudge(first(row.expected, "zero"))),
)


def nudge(t: float | None) -> float | None:
    return None if t is None or isinf(t) else t * (1 + 2.0**-23)


@pytest.mark.parametrize(("name", "mode", "said"), WRONG, ids=[name for name, _, _ in WRONG])
def test_wrong_firsts_are_refused(
    name: str, mode: FromInside, said: Callable[[GoldenRow], float | None]
) -> None:
    grades = graded(said, mode)
    level = "stable" if name.startswith("an ulp") else "sound"
    assert not verdict(grades, level, "closed").granted  # type: ignore[arg-type]


@pytest.mark.parametrize("t", [nan, -1.0, inf])
def test_what_is_no_parameter_is_malformed(t: float) -> None:
    row = next(row for row in rows() if row.tier == "generic" and row.expected)
    g = grade(row, Reply(row.id, first=t), hello("first"))
    assert set(g.faults) == set(LEVELS)
    assert g.strict == g.ulps == inf


def test_yes_and_no_are_graded() -> None:
    for said, granted in ((None, True), (True, False), (False, False)):
        grades = [
            grade(
                row, Reply(row.id, hit=bool(row.expected) if said is None else said), hello("any")
            )
            for row in rows()
        ]
        assert verdict(grades, "exact", "closed").granted == granted
        assert verdict(grades, "sound", "closed").granted == granted


def test_a_first_that_drops_touches_is_regularized() -> None:
    def drops(row: GoldenRow) -> float | None:
        kept = [p for p, s in zip(row.expected, row.intervals, strict=False) if not s.touch]
        return first(tuple(kept), "zero")

    lattice = [row for row in rows() if row.tier == "lattice"]
    client = hello("first", convention="regularized")
    grades = [grade(row, Reply(row.id, first=drops(row)), client) for row in lattice]
    assert Touches.of(grades).name == "regularized"
    assert verdict(grades, "exact", "regularized").granted


def test_from_inside_no_hit_tells_nothing_of_touches() -> None:
    assert First(None, "miss").keeps_touch(((0.0, 0.0),)) is None
    assert First(None, "zero").keeps_touch(((0.0, 0.0),)) is False
    assert First(None, "miss").keeps_touch(((1.0, 1.0),)) is False
    assert YesNo(True).keeps_touch(((0.0, 0.0),)) is True


def test_what_is_endless_may_be_a_number() -> None:
    """From `infinity` on a leave is endless and a first hit is none; below it, nothing changes."""
    half, miss = HalfSpace((0, 0, 0), (0, 0, 1)), Sphere((9, 9, 9), 1)
    ray = Ray((0, 0, 5), (0, 0, -1))
    declared = Hello("x", infinity=1e7)
    for leave, right in ((1e7, True), (2e30, True), (9e6, False), (inf, True)):
        said = claim(Reply("", intervals=((5.0, leave),)), declared)
        assert (said.malformed(Judge(half, ray, tier="lattice")) is None) == right
    first_hit = replace(declared, answers="first")
    assert claim(Reply("", first=1e8), first_hit) == claim(Reply("", first=None), first_hit)
    judge = Judge(miss, ray)
    assert claim(Reply("", first=1e8), first_hit).fault(judge.accept("sound")) is None
    assert claim(Reply("", first=1e8), hello("first", "zero")).fault(judge.accept("sound"))
