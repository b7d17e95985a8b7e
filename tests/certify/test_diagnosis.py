"""Likely faults: named where they are, with nothing beside them, and never where none is.

Each test has a sample; `raycert zoo --diagnose` measures all.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from math import hypot, inf, nan
from typing import Any

import pytest

from raycert.cases.accept import Numbers
from raycert.cases.domain import Domain
from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Cylinder, Ray, Solid, type_of
from raycert.cases.protocol import ANSWERS, Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.alike import Kind, close
from raycert.oracle.certify.cover import (
    LEAST,
    Explanation,
    Failures,
    cover,
    divergence,
    needed,
    shares,
)
from raycert.oracle.certify.diagnosis import diagnose
from raycert.oracle.certify.grading import grade, usual
from raycert.oracle.certify.naming import Naming, Unknown, graded, mixed, score
from raycert.oracle.zoo.inhabitants import BY_NAME, CATALOGUE
from raycert.oracle.zoo.tracer import BASE, Fault, Intersect, Pairs
from shared.corpus import golden

HELLO = Hello("a subject")


@cache
def rows(step: int = 8, *solids: str) -> tuple[GoldenRow, ...]:
    some = [row for row in golden().rows if not solids or type_of(row.solid) in solids]
    return tuple(some[::step])


def told(
    intersect: Intersect, some: Sequence[GoldenRow], hello: Hello = HELLO
) -> dict[str, object]:
    """Return what is said at `sound`: by solid, the rows by name, and how many failures are."""
    return {
        record["solid"]: (
            {cause["fault"]: cause["rows"] for cause in record["explained"]},
            record["unexplained"],
        )
        for record in diagnose(graded(intersect, some, hello))
        if record["level"] == "sound"
    }


@pytest.mark.parametrize("planted", CATALOGUE[::9], ids=lambda f: f.name)
def test_a_fault_alone_is_named_and_no_other(planted: Fault) -> None:
    found = Naming()
    found.add(Unknown((planted,), planted.make), rows(), HELLO)
    assert found.other == 0, found.missed
    assert found.named >= 0.8 * found.showing, found.missed


@pytest.mark.parametrize("answers", ["intervals", "first"])
def test_of_two_faults_nearly_all_are_named(answers: str) -> None:
    found = score("pairs", 6, rows(6), Hello("two", answers=answers))  # type: ignore[arg-type]
    assert found.showing > 20
    assert found.named >= 0.8 * found.showing, found.missed
    assert found.other <= 0.1 * found.showing, found.missed


@pytest.mark.parametrize("trouble", ["rare", "noise"])
def test_of_answers_spoilt_at_random_nothing_is_said(trouble: str) -> None:
    found = score(trouble, 4, rows(6), HELLO)  # type: ignore[arg-type]
    assert found.failures > 100
    assert (found.other, found.signatures) == (0, 0), found.missed


def test_a_fault_under_a_condition_is_named_though_it_would_fail_more() -> None:
    """As a library does that forgets the caps of the rays square to the axis."""

    def square(solid: Solid, ray: Ray) -> Pairs:
        along = sum(v * (b - a) for v, a, b in zip(ray.direction, solid.p, solid.q, strict=True))  # type: ignore[union-attr]
        return BY_NAME["caps-forgotten"].make()(solid, ray) if not along else BASE(solid, ray)

    names, rest = told(square, rows(2, "cylinder"))["cylinder"]  # type: ignore[misc]
    assert set(names) == {"caps-forgotten"}
    assert not rest


def test_misses_are_no_fault_that_would_miss_elsewhere_too() -> None:
    """Misses at random are told as what they are, and as no planted fault's."""

    def missing(solid: Solid, ray: Ray) -> Pairs:
        return [] if random.Random(repr((solid, ray))).random() < 0.1 else BASE(solid, ray)

    for names, rest in told(missing, rows(4)).values():  # type: ignore[misc]
        assert set(names) == {"missed"}
        assert not rest


def test_errors_are_told_by_their_text_and_without_numbers() -> None:
    def failing(row: GoldenRow, i: int) -> Reply:
        if i % 7:
            return Reply(row.id, intervals=row.expected)
        return Reply(row.id, error=f"bad value {i} at 0x{i:x}: division by zero")

    grades = [grade(row, failing(row, i), HELLO) for i, row in enumerate(rows(4, "sphere"))]
    [record] = diagnose(grades)
    [cause] = record["explained"]
    assert cause["does"] == "says 'error: bad value # at #: division by zero'"
    assert cause["rows"] == record["failures"] > LEAST
    assert cause["first"] == next(g.row.id for g in grades if g.fault("sound"))


def test_numbers_of_binary32_that_are_far_from_the_right_ones_are_not_rounded() -> None:
    def far(row: GoldenRow) -> Reply:
        return Reply(
            row.id, intervals=tuple((BINARY32.nearest(3 * a), inf) for a, _ in row.expected)
        )

    for record in diagnose([grade(row, far(row), HELLO) for row in rows(4, "sphere")]):
        assert "single" not in {cause["fault"] for cause in record["explained"]}


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("times-length", lambda t, v: t * v),
        ("over-length", lambda t, v: t / v),
        ("offset", lambda t, v: t + 0.0625),
        ("factor", lambda t, v: t * 3),
    ],
)
def test_numbers_are_told_by_what_makes_them_of_the_right_ones(name: str, change: object) -> None:
    def moved(solid: Solid, ray: Ray) -> Pairs:
        v = hypot(*ray.direction)
        return [(change(a, v), change(b, v)) for a, b in BASE(solid, ray)]  # type: ignore[operator]

    some = [row for row in rows(4, "sphere") if row.tier == "generic" and any(row.ray.direction)]
    names, _ = told(moved, some)["sphere"]  # type: ignore[misc]
    twin = {"times-length": "normalised-direction"}.get(name, name)
    assert set(names) <= {name, twin}
    assert names


def test_rows_outside_the_domain_are_not_explained() -> None:
    grades = graded(BY_NAME["far-clip"].make(), rows(4, "sphere"), HELLO)
    assert any(g.fault("sound") for g in usual(grades))
    near = Hello("near", domain=Domain(direction=(0.01, 100.0), distance=10.0))
    inside = graded(BY_NAME["far-clip"].make(), rows(4, "sphere"), near)
    assert diagnose(grades) != []
    assert diagnose(inside) == []


def test_nothing_is_said_of_few_failures_or_none() -> None:
    grades = graded(BY_NAME["no-clip"].make(), rows(8, "sphere"), HELLO)
    failing = [g for g in grades if g.fault("sound")]
    assert diagnose(failing[: LEAST - 1]) == []
    assert diagnose([]) == []
    assert diagnose(graded(BASE, rows(), HELLO)) == []


def suspect(name: str, explained: set[int], elsewhere: float = 0, **how: object) -> Explanation:
    return Explanation(
        name, "", "", lambda g: True, frozenset(explained),
        failed=dict.fromkeys(explained, "numbers"), passed={"numbers": elsewhere}, **how,  # type: ignore[arg-type]
    )  # fmt: skip


def failures(count: int, passing: int = 300) -> Failures:
    return Failures(["numbers"] * count, [True] * count, passing, passing)


def names(picked: Sequence[Explanation]) -> list[str]:
    return [suspect.name for suspect in picked]


def test_the_cover_takes_what_is_least_by_chance_and_leaves_out_what_is_needless() -> None:
    one, two = suspect("one", set(range(20))), suspect("two", set(range(15, 40)))
    wide = suspect("wide", set(range(5, 35)), 2000)
    found = shares(needed(cover([wide, one, two], failures(40), Counter(wide=9))))
    assert [(s.name, len(rows)) for s, rows in found] == [("two", 25), ("one", 15)]


def test_a_fault_needs_more_rows_than_a_few_and_than_chance() -> None:
    few, many = suspect("few", set(range(LEAST - 1))), suspect("many", set(range(12)), 12000)
    assert cover([few, many], failures(40), Counter()) == []
    assert divergence(12 / 12012, 40 / 340 / 8) == 0


@pytest.mark.parametrize(("kind", "elsewhere", "named"), [
    ("miss", 29, True), ("miss", 31, False), ("numbers", 31, True),
])  # fmt: skip
def test_misses_alone_name_no_fault_that_would_miss_elsewhere_too(
    kind: Kind, elsewhere: int, named: bool
) -> None:
    """A radius that is not squared misses what is large, as a limit does, and much else."""
    failing = Failures([kind] * 30, [True] * 30, 2000, 2000)
    ways: dict[str, Any] = {"failed": dict.fromkeys(range(30), kind), "passed": {kind: elsewhere}}
    fault = replace(suspect("fault", set(range(30))), **ways)
    assert names(cover([fault], failing, Counter())) == ["fault"] * named


def test_a_signature_makes_no_fault_needless() -> None:
    fault = suspect("fault", set(range(10)))
    sign = suspect("signature", set(range(30)), telling=0.5)
    assert names(needed([fault, sign])) == ["fault", "signature"]
    assert [(s.name, len(r)) for s, r in shares([sign, fault])] == [
        ("signature", 20),
        ("fault", 10),
    ]


@pytest.mark.parametrize("answers", ANSWERS)
def test_a_subject_may_answer_in_any_mode(answers: str) -> None:
    hello = Hello("any", answers=answers)  # type: ignore[arg-type]
    names, rest = told(BY_NAME["always-empty"].make(), rows(8, "cylinder"), hello)["cylinder"]  # type: ignore[misc]
    assert set(names) == {"always-empty"}
    assert not rest


def test_faults_of_several_steps_are_put_together() -> None:
    ray = Ray((-3.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    both = mixed([BY_NAME["diameter"], BY_NAME["swapped"]])
    assert both(Cylinder((0, 0, 0), (0, 0, 2), 2), ray) == [(4.0, 2.0)]


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ((), (), True),
        (((1.0, 2.0),), (), False),
        (((1.0, 2.0),), ((1.0 + 2**-50, 2.0),), True),
        (((1.0, 2.0),), ((1.0 + 2**-30, 2.0),), False),
        (((0.0, inf),), ((1e-20, inf),), False),
        (((1.0, inf),), ((1.0, 2.0),), False),
        (((nan, nan),), ((nan, 1.0),), True),
        (((nan, nan),), ((1.0, 2.0),), False),
    ],
)
def test_answers_are_alike_but_for_roundings(one: Numbers, other: Numbers, same: bool) -> None:
    assert close(one, other, BINARY64) is same
