"""The measured domain: it is granted, it cannot be widened, and no better one was missed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import product
from math import inf, nextafter
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from raycert.cases.accept import Numbers
from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.domain import PAIRS, Domain, quantities
from raycert.cases.model import Sphere, type_of
from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade, place_of
from raycert.oracle.certify.verdict import Group, by_solid
from raycert.oracle.certify.widest import (
    FLANKS,
    ORDINARY,
    WHOLE,
    Row,
    best,
    bound,
    measured_domain,
    point,
)
from raycert.oracle.zoo.inhabitants import BY_NAME, SOUND
from shared.corpus import golden

ALL = Hello("all", degenerate=DEGENERACIES)


@cache
def rows() -> tuple[GoldenRow, ...]:
    return tuple(row for row in golden().rows if row.tier != "range")[::3]


@cache
def graded(answer: Callable[[GoldenRow], Numbers], hello: Hello = ALL) -> tuple[Grade, ...]:
    return tuple(grade(row, Reply(row.id, intervals=answer(row)), hello) for row in rows())


def of_the_zoo(name: str) -> Callable[[GoldenRow], Numbers]:
    tracers = {sound.name: sound.tracer for sound in SOUND}
    tracer = tracers.get(name) or BY_NAME[name].make()
    return lambda row: tuple(tracer(row.solid, row.ray))


def nearsighted(row: GoldenRow) -> Numbers:
    """Answer right, but for starts beyond 1e6 sizes."""
    return row.expected if Domain(distance=1e6).holds(quantities(row.solid, row.ray)) else ()


def shortsighted(row: GoldenRow) -> Numbers:
    """Answer right, but for directions shorter than 1e-3, and for disks."""
    known = quantities(row.solid, row.ray)
    return row.expected if Domain(direction=(1e-3, None), aspect=1e5).holds(known) else ()


def within(grades: tuple[Grade, ...], domain: Domain) -> tuple[Grade, ...]:
    hello = replace(ALL, domain=domain)
    return tuple(replace(g, place=place_of(g.row.solid, g.row.ray, hello)) for g in grades)


def found(grades: tuple[Grade, ...], level: Any) -> Iterator[tuple[Group, Any]]:
    for group in by_solid(grades):
        if not group.tally(level).granted and (one := measured_domain(group.grades, level)):
            yield group, one


@pytest.mark.parametrize("level", ["sound", "stable"])
@pytest.mark.parametrize(
    "answer",
    [nearsighted, shortsighted, *map(of_the_zoo, ("textbook", "small-a", "thin-lost"))],
)
def test_a_run_with_the_measured_domain_is_granted_and_a_wider_one_is_not(
    answer: Callable[[GoldenRow], Numbers], level: Any
) -> None:
    """The law of the measured domain, and that no bound can go to the value of the next row."""
    grades, domains = graded(answer), 0
    for group, one in found(grades, level):
        if one.domain is None:
            assert one.ordinary
            continue
        domains += 1
        assert Group(group.name, within(group.grades, one.domain)).tally(level).granted
        assert one.exhaustive
        for edge in one.edges:
            wider = widened(one.domain, edge, group.grades)
            let_in = within(group.grades, wider)
            assert any(g.place == "inside" and g.fault(level) for g in let_in), edge
            assert edge.grade.fault(level) or edge.grade.fault("sound")
    assert domains >= (answer in (nearsighted, shortsighted))


def widened(domain: Domain, edge: Any, grades: tuple[Grade, ...]) -> Domain:
    """Return the domain with one bound at the next row's value."""
    name, low = edge.flank.quantity, edge.flank.low
    spans = [quantities(g.row.solid, g.row.ray).spans() for g in grades if g.row.tier != "range"]
    values = [s[name][not low] for s in spans if name in s]
    beyond = [x for x in values if (x < edge.bound if low else x > edge.bound)]
    next_one = float(max(beyond) if low else min(beyond))
    moved = nextafter(next_one, 0.0 if low else inf)
    pair = getattr(domain, name)
    bounds = (moved, pair[1]) if low else (pair[0], moved) if name in PAIRS else moved
    return replace(domain, **{name: bounds})


def test_a_limit_is_told_from_a_fault() -> None:
    """The one who does not see far has a bound of 1e6, the one who forgets caps has none."""
    limits = {group.name: one for group, one in found(graded(nearsighted), "sound")}
    assert limits.keys() >= {"sphere", "cylinder", "union"}
    for one in limits.values():
        assert one.domain is not None
        assert 1e5 < one.domain.distance < 1e8, "rows beyond that miss are right all the same"
        assert one.domain == Domain(distance=one.domain.distance)
        assert one.rows > 5 * one.left
    for group, one in found(graded(of_the_zoo("caps-forgotten")), "sound"):
        assert one.domain is None, group.name
        assert one.ordinary
        assert all(g.fault("sound") for g in one.ordinary)


def test_what_is_ordinary_is_what_no_family_is_there_for() -> None:
    """A domain of what is ordinary leaves out only families that are about what is not."""
    ordinary = Domain(**{name: x if name in PAIRS else x[1] for name, x in ORDINARY.items()})  # type: ignore[arg-type]
    out: dict[str, list[bool]] = {}
    for row in golden().rows:
        if row.tier != "range":
            held = ordinary.holds(quantities(row.solid, row.ray))
            out.setdefault(row.family, []).append(not held)
    mixed = {name: sum(some) for name, some in out.items() if any(some)}
    ladders = ("far", "scale", "needle", "disk", "displaced", "thin", "tilt", "nearly", "deep",
               "reports", "large", "gap", "tangent", "ties", "behind")  # fmt: skip
    others = {n: k for n, k in mixed.items() if not any(word in n for word in ladders)}
    assert all(few <= 5 for few in others.values()), others


# The search, against all domains there are.

COORDINATES = st.sampled_from([0.0, 1.0, 2.0, 3.0, 4.0])
POINTS = st.tuples(COORDINATES, COORDINATES, COORDINATES)


def as_row(at: tuple[float, ...]) -> Row:
    """Return a row that lies so many steps out on distance, offset and aspect."""
    none: Any = None
    ordinary = tuple(flank.ordinary for flank in FLANKS[:4])
    return Row(none, (*ordinary, *(64.0 * 2.0**x for x in at)))


GREEDY = ([(1.0, 0, 0)] * 2 + [(0, 1.0, 0)] + [(0, 0, 1.0)] * 2, [(1.0, 1.0, 0), (1.0, 0, 1.0)])
"""Whoever shuts out the first where that costs least pays more for the second."""


@example(*GREEDY)
@given(st.lists(POINTS, max_size=12), st.lists(POINTS.filter(any), min_size=1, max_size=6))
def test_no_other_domain_keeps_more_rows(passing: Any, failing: Any) -> None:
    kept, out = [*map(as_row, passing)], [*map(as_row, failing)]
    cuts, exhaustive = best(kept, out)
    assert exhaustive
    assert all(row.beyond(cuts) for row in out)
    steps = [64.0 * 2.0**x for x in (1.0, 2.0, 3.0, 4.0)] + [inf]
    every = [(*WHOLE[:4], *three) for three in product(steps, repeat=3)]
    fair = [some for some in every if all(row.beyond(some) for row in out)]

    def lost(cuts: tuple[float, ...]) -> int:
        return sum(bool(row.beyond(cuts)) for row in kept)

    assert lost(cuts) == min(map(lost, fair))
    for i in (4, 5, 6):  # and no bound can be taken away
        if cuts[i] < inf:
            free = (*cuts[:i], inf, *cuts[i + 1 :])
            assert not all(row.beyond(free) for row in out)


@given(st.lists(POINTS, max_size=12), st.lists(POINTS.filter(any), min_size=1, max_size=6))
def test_what_is_found_in_few_steps_is_granted_and_cannot_be_widened(
    passing: Any, failing: Any
) -> None:
    """With a cap on the search: it says so, and each bound is at a row that only it shuts out."""
    kept, out = [*map(as_row, passing)], [*map(as_row, failing)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("raycert.oracle.certify.widest.MOST", 1)
        cuts, _ = best(kept, out)
    assert all(row.beyond(cuts) for row in out)
    for i in (4, 5, 6):
        if cuts[i] < inf:
            assert min(row.at[i] for row in out if row.beyond(cuts) == [i]) == cuts[i]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("raycert.oracle.certify.widest.MOST", 2)
        greedy, exhaustive = best(*(list(map(as_row, points)) for points in GREEDY))
    assert not exhaustive
    assert all(as_row(at).beyond(greedy) for at in GREEDY[1])


@given(st.floats(64.5, 1e12), st.floats(1.0001, 1e6))
def test_a_bound_lies_between_the_rows(last: float, times: float) -> None:
    rows = [Row(None, (-inf,) * 4 + (last, -inf, -inf))]  # type: ignore[arg-type]
    cut = last * times
    found = bound(4, cut, rows)
    assert last <= found < cut
    rows = [Row(None, (-1 / last, *(-inf,) * 6))]  # type: ignore[arg-type]
    if last > 256:
        found = bound(0, -1 / cut, rows)
        assert 1 / cut < -found <= 1 / last


def test_points_grow_outward() -> None:
    tiny = next(g for g in graded(nearsighted) if type_of(g.row.solid) == "sphere")
    small = replace(tiny.row, solid=Sphere((0, 0, 0), 2.0**-30))
    at = point(replace(tiny, row=small))
    assert at[2] == -(2.0**-30)
    assert at[3] == 2.0**-30
    assert at[6] == 1
