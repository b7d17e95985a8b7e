"""`raycert speed`: tables, a file, one section alone, and every way to get it wrong."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands.speed import SECTIONS, speed
from raycert.oracle.measure.speed import run as running
from raycert.oracle.measure.speed.run import Effort


@pytest.fixture(autouse=True)
def _tiny(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(running, "QUICK", Effort(500, 3, (6, 4), (8, 6), 2, 1))


def run(*words: str) -> Result:
    return CliRunner(env={"COLUMNS": "140"}).invoke(speed, ["--quick", *words])


@pytest.mark.parametrize("section", SECTIONS)
def test_a_section_runs_alone(section: str, tmp_path: Path) -> None:
    file = tmp_path / "new" / "speed.json"
    found = run("--only", section, "--json", str(file), "--seed", "3")
    assert found.exit_code == 0, found.output
    form = json.loads(file.read_text())
    assert list(form["sections"]) == [section]
    assert form["seed"] == 3
    assert form["sections"][section]
    assert "seed 3" in found.output
    assert "speed.json" in found.output


def test_sections_come_in_one_order() -> None:
    assert SECTIONS == running.SECTIONS
    found = run("--only", "solids", "--only", "scalar")
    assert found.exit_code == 0, found.output
    assert found.output.index("undecided") < found.output.index("with nothing left out")


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("--only", "memory"), "'memory' is not one of"),
        (("--seed", "-1"), "--seed"),
        (("--json", "/dev/null/speed.json"), "cannot write to /dev/null"),
    ],
)
def test_bad_usage_is_refused(words: tuple[str, ...], text: str) -> None:
    found = run(*words)
    assert found.exit_code == 2
    assert text in found.output


def test_without_numpy_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    found = run("--only", "solids")
    assert found.exit_code == 3
    assert "raycert[speed]" in found.output


def test_an_interruption_keeps_what_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = running.run

    def stop() -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(running, "run", lambda *args: whole(*args[:-1], stop))
    found = run("--only", "solids")
    assert found.exit_code == 1
    assert "with nothing left out" in found.output
    assert "interrupted" in found.output
