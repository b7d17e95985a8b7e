"""Where a target sits: measured beside the others, in the certificate's form, on its page."""

from __future__ import annotations

import json
import sys
from base64 import b64decode
from contextlib import nullcontext
from dataclasses import replace
from importlib.resources import files
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import shared.certificates as made_up
from raycert.oracle import plots
from raycert.oracle.client.dialogue import Unusable
from raycert.oracle.client.target import target
from raycert.oracle.measure.catalog import BESIDE
from raycert.oracle.measure.curves import Itinerary
from raycert.oracle.measure.files import Effort
from raycert.oracle.measure.sweeps import SWEEPS
from raycert.oracle.plots import standing
from raycert.oracle.plots.standing import SETS, as_svg, in_time, under_stress
from raycert.oracle.reports.page import page

MINE = target(("raycert.reference.tracer:intersect",))


def silent(_verb: str, _total: int) -> Any:
    return nullcontext(lambda: None)


def valid(form: dict[str, Any]) -> bool:
    schema = json.loads(
        (files("raycert.oracle") / "schemas" / "certificate.schema.json").read_text()
    )
    return Draft202012Validator(schema).is_valid(form)


@pytest.fixture
def stressed(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    whole = standing.itinerary

    def small(*arguments: Any) -> Itinerary:
        return replace(whole(*arguments), sweeps=(SWEEPS["far"],), workers=1)

    monkeypatch.setattr(standing, "itinerary", small)
    return under_stress("mine <u>", MINE, silent)


@pytest.fixture
def timed(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    monkeypatch.setattr(standing, "QUICK", Effort(4, 4, 1, 0.01))
    return in_time("mine <u>", MINE, silent)


def test_both_are_of_the_published_form_and_on_the_page(
    stressed: dict[str, Any], timed: dict[str, Any]
) -> None:
    form = made_up.made(made_up.right, rows=made_up.sample()[:20])
    assert valid(form)
    assert "Where it sits" not in page(form)
    form["standing"] = {"stress": stressed, "bench": timed}
    assert valid(form)
    shown = page(form)
    assert "Where it sits" in shown
    assert shown.count("data:image/svg+xml;base64,") == 1 + len(SETS)
    for text in shown.split("base64,")[1:]:
        assert b"<svg" in b64decode(text.partition('"')[0])
    assert "<u>" not in shown
    form["standing"] = {"stress": stressed}
    assert not valid(form)


def test_each_stands_beside_the_same_three(stressed: dict[str, Any], timed: dict[str, Any]) -> None:
    assert [method["name"] for method in stressed["methods"]] == ["mine <u>", *BESIDE]
    assert {row["method"] for row in timed["rows"]} == {"mine <u>", *BESIDE}
    assert {row["scenario"] for row in timed["rows"]} == set(SETS)
    [mine] = [row for row in stressed["ranges"] if row["method"] == "mine <u>"]
    assert mine["stable"]["whole"]


def test_who_gives_no_lists_has_no_standing(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "firsts.py").write_text(
        "hello = {'name': 'firsts', 'answers': 'first'}\ndef trace(solid, ray): return None\n"
    )
    monkeypatch.chdir(tmp_path)
    for measure in (under_stress, in_time):
        with pytest.raises(Unusable):
            measure("firsts", target(("firsts:trace",)), silent)


def test_no_picture_without_matplotlib(monkeypatch: pytest.MonkeyPatch) -> None:
    def draw() -> Any:
        raise AssertionError

    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "raycert.oracle.plots.style", raising=False)
    monkeypatch.delattr(plots, "style", raising=False)
    assert as_svg(draw) is None
