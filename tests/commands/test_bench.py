"""`raycert bench`: tables, files, and every way to get it wrong."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands.bench import SECTIONS, bench, short
from raycert.oracle.commands.main import main
from raycert.oracle.measure import clock, files, sections
from raycert.oracle.measure.catalog import WAYS
from raycert.oracle.measure.clock import Timed
from raycert.oracle.measure.files import Effort

ONE = ("--scenario", "random", "--rays", "8", "--quick")


def run(*words: str) -> Result:
    return CliRunner(env={"COLUMNS": "140"}).invoke(bench, words)


def test_a_table_names_methods_ratios_and_losses() -> None:
    found = run(*ONE, "--method", "oracle", "--method", "textbook")
    assert found.exit_code == 0, found.output
    assert "random: 8 rays, seed 1" in found.output
    lines = {
        line.strip(" *").split()[0]: line for line in found.output.splitlines() if line.strip()
    }
    assert {"oracle", "textbook"} <= set(lines)
    assert "trimesh-8" not in found.output
    for column in ("us/ray", "median", "iqr", "ratio", "k p99", "squared", "rounded", "lost"):
        assert column in lines["method"]


def test_files_are_written_on_request(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    found = run(*ONE, "--method", "oracle", "--out", str(tmp_path / "new"), "--seed", "3")
    assert found.exit_code == 0, found.output
    data = json.loads((tmp_path / "new" / "bench.json").read_text())
    assert data["seed"] == 3
    for name in ("bench.csv", "bench-random.svg", "bench-random.png"):
        assert (tmp_path / "new" / name).stat().st_size > 100
        assert name in found.output


def test_a_client_runs_beside_the_methods() -> None:
    found = run(*ONE, "--method", "oracle", "--target", "raycert.reference.tracer:intersect")
    assert found.exit_code == 0, found.output
    assert "raycert.reference.tracer:intersect" in found.output


@pytest.mark.parametrize(
    ("words", "status", "text"),
    [
        (("--scenario", "nowhere"), 2, "no scenario 'nowhere'; known: "),
        (("--method", "guess"), 2, "no method 'guess'"),
        (("--rays", "0"), 2, "--rays"),
        (("--section", "memory"), 2, "'memory' is not one of"),
        (("--seed", "-1"), 2, "--seed"),
        (("--target", "no-such-program"), 3, "cannot start"),
        (("--target", "'unclosed"), 2, "--target"),
        (("--target", ""), 2, "--target"),
    ],
)
def test_bad_usage_is_told_before_any_work(words: tuple[str, ...], status: int, text: str) -> None:
    found = run(*words)
    assert found.exit_code == status, found.output
    assert text in found.output


def test_an_unwritable_folder_is_refused_first(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    found = run("--out", str(tmp_path / "file" / "folder"))
    assert found.exit_code == 2
    assert "cannot write" in found.output


def test_sections_and_methods_are_listed() -> None:
    found = run("--list")
    assert found.exit_code == 0
    assert all(name in found.output for name in (*SECTIONS, *(way.name for way in WAYS)))


def test_whole_commands_are_timed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sections, "COMMANDS", (("--help", 1),))
    found = run(*ONE, "--method", "oracle", "--section", "methods", "--section", "commands")
    assert "raycert --help" in found.output
    assert found.output.index("random: 8 rays") < found.output.index("raycert --help")


def test_sections_come_in_one_order_and_are_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(files, "QUICK", Effort(4, 0, 1, 0.1, 500, (6, 4), (8, 6), 2, 4))
    out = tmp_path / "new"
    words = ("--section", "scenes", "--section", "scalar", "--quick", "--seed", "3")
    found = run(*words, "--out", str(out))
    assert found.exit_code == 0, found.output
    form = json.loads((out / "bench.json").read_text())
    assert list(form["sections"]) == ["scalar", "scenes"]
    assert form["seed"] == 3
    assert form["rows"] == []
    assert all(form["sections"].values())
    assert found.output.index("scalar, touching") < found.output.index("with nothing left out")
    assert "seed 3" in found.output


def test_without_numpy_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    found = run("--section", "scenes")
    assert found.exit_code == 3
    assert "raycert[speed]" in found.output


def test_the_words_that_went_say_where() -> None:
    for verb, words in (("speed", ["--quick"]), ("plan", ["--solids", "9"])):
        found = CliRunner().invoke(main, [verb, *words])
        assert found.exit_code == 2
        assert "bench --section" in found.output


@pytest.mark.parametrize(
    ("x", "text"),
    [(0, "0"), (0.0213, "0.021"), (1.5, "1.5"), (312.4, "312"), (1.13e8, "1.1e8"), (2e-4, "2.0e-4"),
     (float("inf"), "inf"), (9.96, "10")],
)  # fmt: skip
def test_figures_are_short(x: float, text: str) -> None:
    assert short(x) == text


def test_an_interruption_keeps_what_is_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the third pass: both methods have one, the first has two."""
    passes: list[float] = []

    def processor(call: Callable[[], Any]) -> Timed:
        if len(passes) == 3:
            raise KeyboardInterrupt
        passes.append(0.5)
        return Timed(0.5)

    monkeypatch.setattr(clock, "processor", processor)
    found = run(*ONE, "--method", "oracle", "--method", "textbook", "--out", str(tmp_path))
    assert found.exit_code == 1
    assert "interrupted" in found.output
    data = json.loads((tmp_path / "bench.json").read_text())
    assert data["interrupted"] is True
    assert [row["seconds_per_ray"]["passes"] for row in data["rows"]] == [2, 1]
    assert [row["backward_sample"] for row in data["rows"]] == [0, 0]
    assert (tmp_path / "bench.csv").exists()
