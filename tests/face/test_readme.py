"""The README: its table of names answers as it says, its files are there."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

README = Path(__file__).parents[2] / "README.md"
TEXT = README.read_text("utf-8")
PYTHON = TEXT.partition("## From Python")[2].partition("\n## ")[0]
ROWS = re.findall(r"^\| `(.*?)` \| `(.*?)` \| .+ \|$", PYTHON, re.M)


@pytest.fixture(scope="module")
def names() -> dict[str, Any]:
    """Return what the block above the table defines."""
    given: dict[str, Any] = {}
    exec(PYTHON.partition("```python\n")[2].partition("```")[0], given)
    return given


def test_the_table_has_its_rows() -> None:
    assert len(ROWS) == PYTHON.count("\n| `") >= 10


@pytest.mark.parametrize(("ask", "answer"), ROWS)
def test_a_row_answers_as_it_says(ask: str, answer: str, names: dict[str, Any]) -> None:
    assert repr(eval(ask, dict(names))) == answer


def test_a_wrong_row_would_be_noticed(names: dict[str, Any]) -> None:
    assert repr(eval("float(hits[0][0])", dict(names))) != "2.13397459621556"


def test_every_public_name_is_in_the_table(names: dict[str, Any]) -> None:
    functions = {"trace", "expected", "Judge", "certify", "trace_batch", "explain", "intersect"}
    assert all(re.search(rf"\b{name}\(", PYTHON) for name in functions | {"read", "Ray"})


def test_the_files_that_it_names_are_there() -> None:
    linked = re.findall(r"\]\((?!http)([^)#]+)\)", TEXT)
    assert len(linked) > 10
    assert [name for name in linked if not (README.parent / name).exists()] == []
