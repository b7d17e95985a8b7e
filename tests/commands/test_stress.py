"""`raycert stress`: tables, files, what it refuses, and what an interrupted run leaves."""

import csv
import json
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands.stress import stress

SHORT = ("--quick", "--workers", "1", "--sweep", "far")


def call(*words: str) -> Result:
    return CliRunner().invoke(stress, words, env={"COLUMNS": "100"})


def test_it_tells_ranges_and_causes_and_writes_them(tmp_path: Path) -> None:
    methods = ("--method", "textbook", "--method", "reference", "--method", "oracle")
    result = call(*SHORT, *methods, "--out", str(tmp_path / "new"))
    assert result.exit_code == 0, result.output
    lines = result.output.splitlines()
    assert lines[0] == "start far from the solid: distance of the start / radius"
    assert "textbook to 1e0 all" in " ".join(result.output.split())
    assert "cancellation in the discriminant: textbook (1e3)" in result.output
    assert "stable throughout, worst k: reference" in result.output
    assert "exact throughout: oracle" in result.output
    assert "a gross answer could hide in k = 64 on all rays at 1e15" in result.output
    names = {path.name for path in (tmp_path / "new").iterdir()}
    pictures = {f"stress{part}.{kind}" for part in ("", "-ulps") for kind in ("svg", "png")}
    assert names == {"stress.json", "stress.csv"} | pictures
    form = json.loads((tmp_path / "new" / "stress.json").read_text())
    assert form["complete"]
    with (tmp_path / "new" / "stress.csv").open() as file:
        assert len(list(csv.DictReader(file))) == len(form["rows"])


def test_the_seed_draws_other_rays() -> None:
    one, same, other = (
        call(*SHORT, "--method", "textbook", "--seed", seed).output for seed in ("1", "1", "2")
    )
    assert one == same
    assert one != other


def test_a_client_stands_beside_the_built_in() -> None:
    result = call(*SHORT, "--target", f"{sys.executable} -m raycert.reference")
    assert result.exit_code == 0, result.output
    said = " ".join(result.output.split())
    [_, after] = said.split("stable throughout, worst k: ")
    assert "-m raycert.reference" in after
    assert "textbook to 1e0 all" in said
    assert "exact throughout: oracle" in after


@pytest.mark.parametrize(
    ("words", "status", "text"),
    [
        (("--sweep", "nowhere"), 2, "no sweep 'nowhere'; known: "),
        (("--method", "nobody"), 2, "no method 'nobody'"),
        (("--target", "no-such-program-here"), 3, "no-such-program-here"),
        (("--workers", "0"), 2, "--workers"),
    ],
)
def test_what_cannot_be_run_is_refused(words: tuple[str, ...], status: int, text: str) -> None:
    result = call(*words)
    assert result.exit_code == status
    assert text in result.output + result.stderr


def test_an_interrupted_run_writes_what_it_has(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from raycert.oracle.measure import curves as module

    walk, done = module.walk, []

    def stopped(job: Any) -> Any:
        if len(done) == 2:
            raise KeyboardInterrupt
        done.append(job)
        return walk(job)

    monkeypatch.setattr(module, "walk", stopped)
    result = call(*SHORT, "--method", "textbook", "--out", str(tmp_path))
    assert result.exit_code == 1
    assert "interrupted" in result.output + result.stderr
    form = json.loads((tmp_path / "stress.json").read_text())
    assert not form["complete"]
    assert len(form["rows"]) == 2
    assert form["ranges"] == []
    assert (tmp_path / "stress.svg").exists()


def test_without_matplotlib_there_are_no_plots(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def absent(*_: object) -> None:
        raise ModuleNotFoundError(name="matplotlib")

    monkeypatch.setattr(sys.modules["raycert.oracle.commands.stress"], "_draw", absent)
    result = call(*SHORT, "--method", "oracle", "--out", str(tmp_path))
    assert result.exit_code == 0
    assert "no plots: drawing needs matplotlib" in result.output + result.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"stress.json", "stress.csv"}
