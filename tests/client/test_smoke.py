"""The easy cases are right, and what is said of an adapter is said of the right one only."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction

import pytest

from raycert.cases.model import (
    SOLIDS,
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
)
from raycert.cases.protocol import Hello, Pairs, Reply
from raycert.cases.vectors import norm
from raycert.oracle.client.adapter import adapter_faults, misread
from raycert.oracle.client.dialogue import Limits, Outcome, Target
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import run
from raycert.oracle.client.smoke import EASY, Easy, easy, fallen, limits
from raycert.reference import tracer
from shared.places import CLIENTS

Point = tuple[Fraction, ...]
DECLARED = [
    *([name] for name in ("cylinder", "infinite_cylinder", "slab", "half_space", "sphere")),
    ["cylinder", "sphere"],
    list(SOLIDS),
]


def sub(a: Point, b: Point) -> Point:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def dot(a: Point, b: Point) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def exact(vector: tuple[float, ...]) -> Point:
    return tuple(map(Fraction, vector))


def inside(solid: Solid, x: Point) -> bool:
    """Tell membership from the table of design.md, in fractions."""
    match solid:
        case HalfSpace(point, normal):
            return dot(sub(x, exact(point)), exact(normal)) <= 0
        case Sphere(center, radius):
            return dot(sub(x, exact(center)), sub(x, exact(center))) <= Fraction(radius) ** 2
        case InfiniteCylinder(p, q, radius):
            w, y = sub(exact(q), exact(p)), sub(x, exact(p))
            return dot(y, y) * dot(w, w) - dot(y, w) ** 2 <= Fraction(radius) ** 2 * dot(w, w)
        case Slab(p, q):
            w = sub(exact(q), exact(p))
            return 0 <= dot(sub(x, exact(p)), w) <= dot(w, w)
        case Cylinder(p, q, radius):
            return inside(InfiniteCylinder(p, q, radius), x) and inside(Slab(p, q), x)
        case Union(of):
            return any(inside(part, x) for part in of)
        case Intersection(of):
            return all(inside(part, x) for part in of)
        case Difference((first, *others)):
            return inside(first, x) and not any(inside(part, x) for part in others)
    raise AssertionError(solid)


def resized(solid: Solid, factor: float) -> Solid:
    match solid:
        case Union(of) | Intersection(of) | Difference(of):
            return type(solid)(tuple(resized(part, factor) for part in of))
        case Sphere() | InfiniteCylinder() | Cylinder():
            return replace(solid, radius=solid.radius * factor)
    return solid


def agrees(truth: Pairs, solid: Solid, ray: Ray) -> bool:
    """Tell whether a literal list is the right one at 500 points of the ray, off its ends."""
    for n in range(500):
        t = Fraction(n, 47) + Fraction(1, 10007)
        x = tuple(u + t * v for u, v in zip(exact(ray.origin), exact(ray.direction), strict=True))
        if any(abs(t - Fraction(end)) < 1e-6 for pair in truth for end in pair if end < math.inf):
            continue
        if inside(solid, x) != any(a <= t <= b for a, b in truth):
            return False
    return True


@pytest.mark.parametrize("case", EASY, ids=lambda case: case.slug)
def test_the_literal_truths_are_true(case: Easy):
    assert agrees(case.truth, case.solid, case.ray)


def test_slugs_are_unique_and_a_cylinder_gets_sixteen():
    assert len({case.slug for case in EASY}) == len(EASY)
    assert len(easy(Hello("x", solids=("cylinder",)))) == 16


def test_only_declared_solids_are_sent():
    for declared in DECLARED:
        cases = easy(Hello("x", solids=tuple(declared)))
        assert len(cases) >= 4
    assert easy(Hello("x", solids=("union",))) == ()
    assert len(easy(Hello("x"))) == len(EASY)


def outcomes(cases: tuple[Easy, ...], answer: Callable[[int, Easy], Pairs]) -> dict[str, Outcome]:
    return {
        case.question.id: Reply(case.question.id, intervals=answer(n, case))
        for n, case in enumerate(cases)
    }


def scaled(power: int) -> Callable[[int, Easy], Pairs]:
    def times(case: Easy) -> Pairs:
        k = norm(case.ray.direction) ** power
        return tuple((a * k, b * k) for a, b in case.truth)

    return lambda _, case: times(case)


def each(change: Callable[[float, float], tuple[float, float]]) -> Callable[[int, Easy], Pairs]:
    return lambda _, case: tuple(change(a, b) for a, b in case.truth)


FAULTS: list[tuple[str, Callable[[int, Easy], Pairs]]] = [
    ("it answers t * |direction|: lengths", scaled(1)),
    ("it answers t * |direction|^2", scaled(2)),
    ("it answers t / |direction|", scaled(-1)),
    ("it answers t^2", each(lambda a, b: (a * a, b * b))),
    ("enter and leave swapped", each(lambda a, b: (b, a))),
    ("[enter, length]", each(lambda a, b: (a, b - a))),
    ("with a miss", lambda n, case: ()),
    ("the same answer to every question: [[7.0, 8.0]]", lambda n, case: ((7.0, 8.0),)),
]


def every(answer: Callable[[int, Easy], Pairs], declared: list[str]) -> list[str]:
    cases = easy(Hello("x", solids=tuple(declared)))
    return told(cases, outcomes(cases, answer), Hello("x"))


def told(cases: Sequence[Easy], given: Mapping[str, Outcome], hello: Hello) -> list[str]:
    return adapter_faults(cases, given, hello) or misread(fallen(cases, given, hello))


@pytest.mark.parametrize(
    ("says", "answer", "declared"),
    [
        pytest.param(says, answer, declared, id=f"{says}-{'+'.join(declared)}")
        for says, answer in FAULTS
        for declared in DECLARED
        if "length" not in says or "cylinder" in declared  # the others have not three such cases
    ],
)
def test_a_fault_of_the_adapter_is_named(
    says: str, answer: Callable[[int, Easy], Pairs], declared: list[str]
):
    (said,) = every(answer, declared)
    assert says in said


@pytest.mark.parametrize("declared", DECLARED, ids="+".join)
def test_a_right_answer_is_not_blamed(declared: list[str]):
    assert every(lambda _, case: case.truth, declared) == []
    assert every(each(lambda a, b: (a * (1 + 1e-7), b * (1 - 1e-7))), declared) == []


ROUND = [d for d in DECLARED if {"cylinder", "infinite_cylinder", "sphere"} & set(d)]


@pytest.mark.parametrize("declared", ROUND, ids="+".join)
def test_radius_and_diameter_are_told_apart(declared: list[str]):
    def halved(_: int, case: Easy) -> Pairs:
        return tuple(tracer.intersect(resized(case.solid, 0.5), case.ray))

    def doubled(_: int, case: Easy) -> Pairs:
        return tuple(tracer.intersect(resized(case.solid, 2.0), case.ray))

    assert "half the radius" in every(halved, declared)[0]
    assert "twice the radius" in every(doubled, declared)[0]


@pytest.mark.parametrize("declared", DECLARED, ids="+".join)
def test_answers_of_the_question_before_are_named(declared: list[str]):
    cases = easy(Hello("x", solids=tuple(declared)))
    given = outcomes(cases, lambda n, _: cases[n - 1].truth if n else ())
    (said,) = adapter_faults(cases, given, Hello("x"))
    assert "off by one" in said


def wrong_but_not_alike(n: int, case: Easy) -> Pairs:
    return tuple((a + n, b + 2 * n) for a, b in case.truth)


def no_caps(_: int, case: Easy) -> Pairs:
    return ((0.0, math.inf),) if "along" in case.slug else case.truth


def no_clip(_: int, case: Easy) -> Pairs:
    return tuple((a or -1.0, b) for a, b in case.truth)


@pytest.mark.parametrize("answer", [wrong_but_not_alike, no_caps, no_clip])
@pytest.mark.parametrize("declared", DECLARED, ids="+".join)
def test_a_wrong_tracer_is_not_taken_for_a_bad_adapter(
    answer: Callable[[int, Easy], Pairs], declared: list[str]
):
    assert every(answer, declared) == []


def test_a_misreading_of_some_questions_only_is_the_tracers():
    def some(n: int, case: Easy) -> Pairs:
        return case.truth if n % 2 else scaled(1)(n, case)

    cases = easy(Hello("x"))
    given = outcomes(cases, some)
    assert sum(given[c.question.id] != outcomes((c,), scaled(0))[c.question.id] for c in cases) > 12
    assert told(cases, given, Hello("x")) == []


CYLINDERS = easy(Hello("x", solids=("cylinder",)))


def all_failing(failure: Failure) -> dict[str, Outcome]:
    return {case.question.id: failure for case in CYLINDERS}


@pytest.mark.parametrize(
    ("failure", "says"),
    [
        (Failure("hang", "no answer for 5 s"), "does not answer"),
        (Failure("hang", "output is not flushed", "{}"), "came only when its input was closed"),
        (Failure("hang", "x, and has read nothing of its input"), "--hello-timeout"),
        (Failure("hang", "'{}' without a newline", "{}"), "no newline"),
        (Failure("crash", "exit status 1"), "crashes on most easy cases: exit status 1"),
        (Failure("wrong-id", "answered id '0'"), "does not give the id back"),
        (Failure("bad-line", "not JSON", "hit at 3"), "something else than answers"),
        (Failure("bad-line", "x", '{"id": "q", "intervals": [2, 4]}'), "not nested: [2, 4]"),
        (Failure("bad-line", "x", '{"id": "q", "t": 4}'), "not the form"),
        (Failure("bad-line", "x", "[[2, 4]]"), "not the form"),
        (Failure("bad-line", "x", '{"id": "q", "intervals": []}'), "not the form"),
    ],
)
def test_a_common_failure_is_put_in_plain_words(failure: Failure, says: str):
    (said,) = adapter_faults(CYLINDERS, all_failing(failure), Hello("x"))
    assert says in said


def test_failures_of_different_kinds_are_not_explained_away():
    kinds = ["hang", "crash", "wrong-id", "bad-line"] * 4
    given: dict[str, Outcome] = {
        case.question.id: Failure(kind, "x", "y")  # type: ignore[arg-type]
        for case, kind in zip(CYLINDERS, kinds, strict=True)
    }
    assert "in different ways" in adapter_faults(CYLINDERS, given, Hello("x"))[0]


def test_a_few_failures_are_left_to_the_verdict():
    given = outcomes(CYLINDERS, lambda _, case: case.truth)
    for case in CYLINDERS[:5]:
        given[case.question.id] = Failure("hang", "no answer")
    assert adapter_faults(CYLINDERS, given, Hello("x")) == []
    assert adapter_faults(CYLINDERS, {}, Hello("x")) == []
    assert adapter_faults((), {}, Hello("x")) == []


@pytest.mark.parametrize("field", ["unsupported", "error"])
def test_a_client_that_declines_what_it_declared_is_told(field: str):
    given: dict[str, Outcome] = {
        case.question.id: replace(Reply(case.question.id), **{field: "no caps"})
        for case in CYLINDERS
    }
    (said,) = adapter_faults(CYLINDERS, given, Hello("x"))
    assert "no caps" in said
    assert "`solids`" in said


FIRST, ANY = Hello("x", answers="first"), Hello("x", answers="any")


def first(change: Callable[[Easy], float | None]) -> dict[str, Outcome]:
    return {case.question.id: Reply(case.question.id, first=change(case)) for case in CYLINDERS}


def test_a_first_hit_is_compared_with_the_first_of_the_truth():
    right = first(lambda c: c.truth[0][0] if c.truth else None)
    assert adapter_faults(CYLINDERS, right, FIRST) == []
    (said,) = told(
        CYLINDERS,
        first(lambda c: c.truth[0][0] * norm(c.ray.direction) if c.truth else None),
        FIRST,
    )
    assert "lengths" in said
    assert "with a miss" in adapter_faults(CYLINDERS, first(lambda _: None), FIRST)[0]


def test_a_yes_is_compared_with_whether_there_is_a_hit():
    def hits(change: Callable[[Easy], bool]) -> dict[str, Outcome]:
        return {case.question.id: Reply(case.question.id, hit=change(case)) for case in CYLINDERS}

    assert adapter_faults(CYLINDERS, hits(lambda case: bool(case.truth)), ANY) == []
    assert "with a miss" in adapter_faults(CYLINDERS, hits(lambda case: False), ANY)[0]


def test_a_client_that_does_not_flush_is_diagnosed_soon():
    script = CLIENTS / "swallows.py"
    usual = Limits(case=0.3)
    result = run(
        [sys.executable, str(script), "late"], [c.question for c in CYLINDERS], limits(usual)
    )
    (said,) = adapter_faults(CYLINDERS, result.outcomes, Hello("x"))
    assert "fflush" in said
    assert "only when its input was closed" in said


def test_the_check_of_the_truths_can_fail():
    case = EASY[0]
    assert not agrees(((2, 4.01),), case.solid, case.ray)
    assert not agrees((), case.solid, case.ray)
    assert not agrees(case.truth, resized(case.solid, 0.99), case.ray)


def knows_spheres(_: int, case: Easy) -> Pairs | None:
    return case.truth if isinstance(case.solid, Sphere) else None


@pytest.mark.parametrize(
    ("target", "says"),
    [
        (InProcess("callable", "s_ok.py:Tracer.trace"), 'trace.hello = {"solids": ["sphere"]}'),
        (InProcess("library", "./tracer.so"), 'let raycert_hello return "solids": ["sphere"]'),
        (("./tracer",), 'put "solids": ["sphere"] into its hello'),
    ],
)
def test_who_refuses_whole_types_is_asked_whether_it_knows_them(target: Target, says: str):
    hello = Hello("x")
    given: dict[str, Outcome] = {
        case.question.id: Reply("", error="TypeError: no p")
        if (pairs := knows_spheres(0, case)) is None
        else Reply("", intervals=pairs)
        for case in EASY
    }
    (said,) = adapter_faults(EASY, given, hello, target)
    assert (
        "'TypeError: no p' on every easy cylinder, infinite_cylinder, slab, half_space, union, "
        in said
    )
    assert "without `solids` all types are asked" in said
    assert says in said
    assert ("raises" in said) == (isinstance(target, InProcess) and target.kind == "callable")


@pytest.mark.parametrize("kind", ["hang", "crash", "bad-line", "malformed"])
def test_advice_for_pipes_is_for_programs_only(kind: str):
    failure = all_failing(Failure(kind, "it returned the int 7", "x"))  # type: ignore[arg-type]
    pipes = ("flush", "line", "standard output", "input", "JSON")
    for code in (InProcess("callable", "a:f"), InProcess("library", "a.so")):
        (said,) = adapter_faults(CYLINDERS, failure, Hello("x"), code)
        assert not any(word in said for word in pipes), said
    (said,) = adapter_faults(CYLINDERS, failure, Hello("x"), ("./tracer",))
    assert kind == "malformed" or any(word in said for word in pipes)
