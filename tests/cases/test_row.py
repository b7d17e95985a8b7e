"""Golden rows as JSON: there and back, and everything refused that is no row."""

from __future__ import annotations

import copy
import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64, FORMATS, Format
from raycert.cases.model import Ray, Refused, Solid
from raycert.cases.row import read_row, write_row
from raycert.cases.strategies import scenes
from shared.rows import RAYS, WRONG, fresh, made, parent, paths, same_kind

KEYS = ("id", "why", "flags", "tier", "source", "solid", "ray", "rows", "condition", "decisive")
KEYS += ("intervals", "expected", "accept")


@settings(deadline=None)
@given(scenes(4, fmt=BINARY32), st.sampled_from(list(FORMATS.values())))
def test_a_row_comes_back_as_it_was(scene: tuple[Solid, Ray], fmt: Format) -> None:
    row = made(*scene, fmt)
    text = json.dumps(write_row(row, fmt))
    again = read_row(json.loads(text), fmt)
    assert again == row
    assert json.dumps(write_row(again, fmt)) == text
    assert text.isascii()


def test_keys_stand_in_the_order_of_the_contract() -> None:
    assert tuple(fresh()) == KEYS


def test_what_is_written() -> None:
    row = fresh()
    assert row["id"] == "hand/slug"
    assert row["ray"]["origin"][:2] == ["-0x1.8000000000000p+1", "0x1.0000000000000p-1"]
    enter, leave = (row["intervals"][0][name] for name in ("enter", "leave"))
    assert enter["polynomial"] == ["4", "-24", "33"]  # (t - 3)^2 = 3/4
    assert (enter["root"], leave["root"]) == (0, 1)
    endless = fresh("endless")["intervals"][0]
    assert endless["enter"]["fraction"] == "0/1"
    assert (endless["leave"]["inf"], endless["leave"]["nearest"]) == (True, "inf")
    assert fresh("miss")["intervals"] == fresh("miss")["expected"] == []


@pytest.mark.parametrize("name", RAYS)
def test_a_row_without_any_one_of_its_fields_is_refused(name: str) -> None:
    whole = fresh(name)
    for path in paths(whole):
        if isinstance(parent(whole, path), dict):
            short = copy.deepcopy(whole)
            del parent(short, path)[path[-1]]
            with pytest.raises(Refused):
                read_row(short, BINARY64)


@pytest.mark.parametrize("name", RAYS)
@pytest.mark.parametrize("wrong", WRONG, ids=repr)
def test_a_value_of_another_kind_is_refused_wherever_it_stands(name: str, wrong: object) -> None:
    """Refused, or a row of the same kinds: a text for a text, null for the condition."""
    whole = fresh(name)
    for path in paths(whole):
        other = copy.deepcopy(whole)
        if same_kind(parent(whole, path)[path[-1]], wrong, path):
            continue
        parent(other, path)[path[-1]] = wrong
        with pytest.raises(Refused):
            read_row(other, BINARY64)


@pytest.mark.parametrize("where", [(), ("intervals", 0), ("intervals", 0, "enter"), ("accept",)])
def test_an_unknown_field_is_refused(where: tuple[Any, ...]) -> None:
    row = fresh()
    parent(row, (*where, ""))["colour"] = "red"
    with pytest.raises(Refused):
        read_row(row, BINARY64)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda row: row.pop("why"), "row.why: is missing"),
        (lambda row: row.update(tier="easy"), "row.tier"),
        (lambda row: row["solid"].update(radius="-0x1p0"), "solid.radius: is negative"),
        (lambda row: row["solid"].update(type="cone"), "solid.type"),
        (lambda row: row["ray"].pop("direction"), "ray.direction: is missing"),
        (lambda row: row.update(condition="2"), "row.condition"),
        (lambda row: row["intervals"][0].pop("leave"), "row.intervals[0].leave: is missing"),
        (lambda row: row["intervals"][0]["enter"].update(polynomial=["x"]), "intervals[0].enter"),
        (lambda row: row["expected"][0].pop(), "row.expected"),
        (lambda row: row["accept"].pop("stable"), "row.accept"),
        (lambda row: row["accept"]["stable"].update(most=None), "row.accept.stable.most"),
    ],
)
def test_a_refusal_names_the_field(change: Any, message: str) -> None:
    row = fresh()
    change(row)
    with pytest.raises(Refused) as caught:
        read_row(row, BINARY64)
    assert message in str(caught.value)


@pytest.mark.parametrize("text", ["[]", "7", '"row"', "null", "{}"])
def test_what_is_no_object_is_no_row(text: str) -> None:
    with pytest.raises(Refused):
        read_row(json.loads(text), BINARY64)


def test_a_number_of_another_format_is_refused() -> None:
    row = fresh()
    row["ray"]["origin"][0] = (0.1).hex()
    with pytest.raises(Refused, match="binary32"):
        read_row(row, BINARY32)
