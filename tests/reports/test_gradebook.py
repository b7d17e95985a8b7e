"""The gradebook: what it says of certificates, its published form, and that it fits and is safe."""

from __future__ import annotations

import copy
import json
import re
from functools import cache
from importlib.resources import files
from io import StringIO
from typing import Any

import jsonschema
import pytest
from rich.cells import cell_len

import shared.certificates as made_up
from raycert.cases.model import SOLIDS
from raycert.oracle.reports.gradebook import ORDERS, gradebook, graded, in_order, why, without
from raycert.oracle.reports.gradetable import markdown, page, report
from raycert.oracle.reports.screen import screen
from shared.certificates import Json

MADE = {
    "file": "class.toml", "began": "2026-01-02T03:04:05+00:00", "interrupted": False,
    "selection": ["--smoke"], "corpus": "1", "tool": {"name": "t", "version": "1", "sha256": ""},
    "environment": {"implementation": "C", "python": "3", "system": "s", "cores": 2},
}  # fmt: skip


def row(name: str, part: Json, title: str = "") -> Json:
    asked = {"level": "stable", "convention": "closed"}
    place = {"certificate": f"{name}/certificate.json", "page": f"{name}/index.html"}
    place = place if part["solids"] else dict.fromkeys(place)
    return {"name": name, "title": title, "words": ["x"], "asked": asked, **place, **part}


@cache
def _book() -> Json:
    hostile = without("not run", made_up.HOSTILE)
    rows = [
        row("good", graded(made_up.good())),
        row("bad", graded(made_up.bad()), made_up.HOSTILE),
        row("attacked", graded(made_up.attacked())),
        row("z" * 300, hostile),
        row("later", without("not asked", None)),
    ]
    return gradebook(rows, MADE)


@pytest.fixture
def book() -> Json:
    return copy.deepcopy(_book())


def wide(book: Json) -> Json:
    """Return the same with all solids there are, and two more, and a large number in each."""
    some = {"rows": 2403, "failed": 2403, "refused": 2403, "holds": False}
    solid = {**book["targets"][1]["solids"]["cylinder"], **some}
    names = [*SOLIDS, *("box", "capsule")[: 10 - len(SOLIDS)]]
    for each in book["targets"]:
        each["solids"] = dict.fromkeys(names, solid)
    return {**book, "solids": names}


def printed(book: Json, width: int, **style: Any) -> str:
    stream = StringIO()
    report(book, screen(file=stream, width=width, **style))
    return stream.getvalue()


def test_it_is_of_its_published_form(book: Json) -> None:
    path = files("raycert.oracle") / "schemas" / "gradebook.schema.json"
    schema = json.loads(path.read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.Draft202012Validator(schema).validate(json.loads(json.dumps(book, allow_nan=False)))


def test_a_row_says_what_the_certificate_does() -> None:
    certificate = made_up.bad()
    found = graded(certificate)
    assert found["state"] == "refused"
    for name, solid in certificate["solids"].items():
        cell, tally = found["solids"][name], solid["levels"][found["solids"][name]["level"]]
        assert (cell["failed"], cell["refused"]) == (tally["failed"], tally["refused"])
        assert cell["holds"] == (solid["level"] in ("stable", "faithful", "exact"))
    assert found["solids"]["cylinder"]["likely"] == {
        "fault": "some-fault", "does": "does likely this", "rows": 8, "of": 9,
    }  # fmt: skip
    assert "cylinder (8 of 9): does likely this" in why(row("bad", found))
    assert graded(made_up.good())["state"] == "granted"
    assert why(row("good", graded(made_up.good()))) == []


def test_another_convention_is_told_beside_the_level() -> None:
    form = copy.deepcopy(made_up.good())
    form["asked"]["convention"], form["granted"], form["passed"] = "regularized", False, False
    said = row("x", graded(form))
    assert why(said)[0].endswith("convention closed")
    book = gradebook([said], MADE)
    assert "convention" in printed(book, 100)
    assert "*" in printed(book, 100).splitlines()[1]


def test_the_order_is_that_of_the_file_or_of_names_or_of_what_is_left(book: Json) -> None:
    rows = book["targets"]
    names = {order: [each["name"] for each in in_order(rows, order)] for order in ORDERS}
    assert names["file"] == [each["name"] for each in rows]
    assert names["name"][1:] == ["attacked", "good", "later", "z" * 300]
    assert names["left"][0] == "good"
    assert names["left"][3:] == ["z" * 300, "later"]


@pytest.mark.parametrize("width", [60, 80, 100, 120, 200])
@pytest.mark.parametrize("full", [False, True])
def test_it_fits_the_terminal(width: int, full: bool, book: Json) -> None:
    text = printed(wide(book) if full else book, width)
    assert max(map(cell_len, text.splitlines())) <= width
    if width >= 80:
        head, first = text.splitlines()[:2]
        assert "\u2026" not in head
        assert first.count("2403r") == (10 if full else 0)


def test_what_others_wrote_is_shown_as_text(book: Json) -> None:
    text = printed(book, 100, force_terminal=True)
    assert "\x1b[31m ```" not in text
    assert "\u202e" not in text
    assert "\x00" not in text
    lines = markdown(book).splitlines()
    table = [line for line in lines if line.startswith("|")]
    assert len(table) == 2 + len(book["targets"])
    assert {line.count("|") for line in table} == {len(book["solids"]) + 4}
    html = page(book)
    assert "<script" not in html.replace("&lt;", "")
    assert "<img" not in html
    assert "\u202e" not in html


def test_the_page_links_each_certificate_and_nothing_else(book: Json) -> None:
    links = set(re.findall(r'(?:href|src)="([^"]*)"', page(book)))
    pages = {each["page"] for each in book["targets"] if each["page"]}
    assert links == {*pages, "gradebook.json"}
