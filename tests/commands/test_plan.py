"""`raycert plan`: what is left out and why, with times, as a table and as data."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands.plan import plan


def run(*words: str) -> Result:
    return CliRunner().invoke(plan, words)


def test_the_table_says_why_and_why_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    result = run("pipe", "--size", "16x12", "--repeats", "1")
    assert result.exit_code == 0, result.output
    assert "every ray starts at the eye" in result.output
    assert "not here: perspective: each ray has its own direction" in result.output
    assert "with nothing left out" in result.output


def test_as_data() -> None:
    result = run("forest", "--size", "16x12", "--repeats", "1", "--json", "-", "--show", "count")
    form = json.loads(result.output)
    assert form["size"] == [16, 12]
    assert form["planned"] > 0 < form["plain"]
    items = {item["name"]: item for item in form["items"]}
    assert items["direction"]["applies"]
    assert items["direction"]["with"] > 0 < items["direction"]["without"]
    assert not items["origin"]["applies"]
    assert items["first"]["why"] == "count asks for whole lists"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "name a scene"),
        (("die", "--size", "axb"), "is not WxH"),
        (("die", "--show", "error"), "Invalid value for '--show'"),
    ],
)
def test_bad_usage_says_what_is_wrong(words: tuple[str, ...], message: str) -> None:
    result = run(*words)
    assert result.exit_code == 2
    assert message in result.output
