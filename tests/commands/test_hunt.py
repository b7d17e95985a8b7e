"""`raycert hunt`: exit statuses, what is printed, and a directory that `certify` replays."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from raycert.cases.corpus import read_corpus
from raycert.oracle.commands.certify import certify
from raycert.oracle.commands.hunt import hunt
from raycert.oracle.hunt.executors import Here, Lost
from shared.hunted_targets import spec


def run(*words: str):
    return CliRunner().invoke(hunt, [*words])


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "hunted"


def test_what_is_found_is_printed_and_certify_replays_it(out, tmp_path):
    options = ["--cases", "1000", "--most", "2", "--no-golden", "--out", str(out)]
    result = run(spec("no-clip"), *options)
    assert result.exit_code == 1, result.output
    assert "malformed on" in result.output
    assert f"raycert certify --golden {out}" in result.output
    report = json.loads((out / "hunt-0.json").read_text())
    assert report["asked"]["target"] == [spec("no-clip")]
    words = ["--golden", str(out), "--level", "stable", "--out", str(tmp_path / "c.json")]
    assert CliRunner().invoke(certify, [*words, spec("no-clip")]).exit_code == 1
    certificate = json.loads((tmp_path / "c.json").read_text())
    assert not certificate["passed"]
    assert CliRunner().invoke(certify, [*words, "--force", "reference"]).exit_code == 0


def test_nothing_found_is_zero_and_nothing_is_written(out):
    result = run("reference", "--cases", "200", "--no-golden", "--out", str(out))
    assert result.exit_code == 0, result.output
    assert "200 cases, 0 causes of failure" in result.output
    assert not out.exists()


def test_golden_rows_are_moved_too(out):
    result = run("raycert.reference.tracer:intersect", "--cases", "120", "--out", str(out))
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--time", "5", "--cases", "5"], "exclude"),
        (["--workers", "2", "--scheduler", "tcp://x:1"], "exclude"),
        (["--solid", "cube"], "cube"),
        (["--convention", "open"], "open"),
        (["--no-golden", "--golden", "."], "exclude"),
    ],
)
def test_bad_usage_is_two(options, words, out):
    result = run("reference", *options, "--out", str(out))
    assert result.exit_code == 2
    assert words in result.output


def test_a_target_that_cannot_be_run_is_three(out):
    result = run("no_such_module:intersect", "--cases", "10", "--out", str(out))
    assert result.exit_code == 3
    assert "no_such_module" in result.output


def test_a_loss_keeps_what_was_found_and_is_three(out, monkeypatch):
    class Failing(Here):
        """Does one unit; then whatever did it is gone."""

        def finished(self, seconds):
            if getattr(self, "did", False):
                raise Lost("no worker is left")
            self.did = True
            return super().finished(seconds)

    monkeypatch.setattr("raycert.oracle.commands.hunt.Here", Failing)
    result = run(spec("no-clip"), "--cases", "1001", "--no-golden", "--out", str(out))
    assert result.exit_code == 3, result.output
    assert "the hunt ended early: no worker is left" in result.stderr
    assert read_corpus("binary64", out).rows


def test_workers_find_what_one_finds(out, tmp_path):
    options = ["--cases", "600", "--most", "1", "--no-golden"]
    one = run(spec("padded-radius"), *options, "--out", str(out))
    two = run(spec("padded-radius"), *options, "--workers", "2", "--out", str(tmp_path / "two"))
    assert one.exit_code == two.exit_code == 1
    files = [folder / "binary64" / "hunt-0.jsonl" for folder in (out, tmp_path / "two")]
    assert files[0].read_bytes() == files[1].read_bytes()


def test_the_help_teaches():
    result = run("--help")
    assert result.exit_code == 0
    for word in ("Ctrl-C", "--scheduler", "Exit status", "replay"):
        assert word in result.output
