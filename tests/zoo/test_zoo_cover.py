"""The smoke rows are few, of every family, and still refuse what the corpus refuses."""

from __future__ import annotations

from functools import cache

import pytest

from raycert.cases.model import type_of
from raycert.cases.protocol import Hello
from raycert.oracle.certify.selection import Selection, select
from raycert.oracle.zoo.inhabitants import FAULTS
from raycert.oracle.zoo.matrix import MOST, Trials, greedy, line, served
from raycert.oracle.zoo.smoke import smoke
from raycert.oracle.zoo.tracer import Fault
from shared.corpus import golden

PRECISIONS = ("binary64", "binary32")


@cache
def bench(precision: str) -> Trials:
    rows, _ = select(golden(precision), Hello("all"), Selection(smoke=True))
    return Trials(rows, golden(precision).format)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_smoke_rows_are_few_and_of_every_family(precision: str) -> None:
    ids = smoke(precision)
    rows = {row.id: row for row in golden(precision).rows}
    assert len(set(ids)) == len(ids) <= MOST
    assert set(ids) <= set(rows)
    assert {id.partition("/")[0] for id in ids} == {row.family for row in rows.values()}
    assert {type_of(rows[id].solid) for id in ids} == {type_of(r.solid) for r in rows.values()}


@pytest.mark.parametrize("planted", FAULTS, ids=lambda f: f.name)
def test_the_smoke_rows_refuse_every_fault_at_its_level(planted: Fault) -> None:
    found = line(bench("binary64"), planted)
    assert found.refusals
    assert found.granted == planted.granted


def test_the_rows_are_a_cover_of_what_they_serve() -> None:
    """What is chosen for a fault is a row that refuses it at the lowest level of its type."""
    fault = FAULTS[0]
    found = line(Trials(golden("binary64").rows[::3], golden("binary64").format), fault)
    needs = {need for _, need in served(fault, found.refusals)}
    assert needs == {(fault.name, type_of(r.row.solid)) for r in found.refusals}
    assert len(served(fault, found.refusals)) <= len(found.refusals)


def test_the_choice_is_greedy_and_whole() -> None:
    serves = {"a": {("f", "1")}, "b": {("f", "1"), ("f", "2")}, "c": {("f", "3")}, "d": set()}
    assert greedy(serves) == ["b", "c"]
    assert greedy({}) == []


def test_a_selection_of_smoke_is_just_these_and_says_so() -> None:
    rows, left = select(golden("binary64"), Hello("all"), Selection(smoke=True))
    assert tuple(row.id for row in rows) == smoke("binary64")
    assert left.rows == len(golden("binary64").rows) - len(rows)
    assert Selection(smoke=True).options() == ("--smoke",)
