"""The command from end to end: reports, known failures, parts, a client that crashes and hangs."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands.main import main


@pytest.fixture(autouse=True)
def importable(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)


def run(*options: str) -> Result:
    words = ["certify", "--out", "certificate.json", "--force", *options]
    return CliRunner().invoke(main, words)


def form(name: str = "certificate.json") -> dict[str, Any]:
    read: dict[str, Any] = json.loads(Path(name).read_text())
    return read


def faulty(name: str) -> str:
    """Write a module with a planted fault as a callable; return the target."""
    Path("wrong.py").write_text(
        "from raycert.oracle.zoo.inhabitants import BY_NAME\n"
        f"intersect = BY_NAME[{name!r}].make()\n"
    )
    return "wrong:intersect"


def test_one_run_writes_all_reports() -> None:
    reports = ("--html", "r.html", "--markdown", "r.md", "--junit", "r.xml")
    result = run("--smoke", *reports, "reference")
    assert result.exit_code == 0, result.output
    assert "not a certificate" in " ".join(result.output.split())
    for name, begins in (("r.html", "<!doctype html>"), ("r.md", "#"), ("r.xml", "<testsuites")):
        assert Path(name).read_text().lower().startswith(begins), name


def test_known_failures_are_recorded_accepted_and_outgrown() -> None:
    target, part = faulty("caps-forgotten"), ("--solid", "cylinder", "--shard", "1/40")
    assert run(*part, "--write-expectations", "known.toml", target).exit_code == 1
    accepted = run(*part, "--expect", "known.toml", target)
    assert accepted.exit_code == 0, accepted.output
    assert "accepted, not certified" in " ".join(accepted.output.split())
    assert not form()["granted"]
    assert not form()["passed"]
    assert form()["accepted"]
    outgrown = run(*part, "--expect", "known.toml", "reference")
    assert outgrown.exit_code == 1
    assert form()["expectations"]["unexpected_passes"]
    worse = run(*part, "--expect", "known.toml", faulty("no-clip"))
    assert worse.exit_code == 1
    assert form()["expectations"]["new"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--shard", "6/5"), "2/5"),
        (("--fresh", "9"), "--seed"),
        (("--expect", "bad.toml"), "reason is missing"),
        (("--seed", "-1"), "-1"),
    ],
)
def test_bad_options_say_what_to_write(options: tuple[str, ...], words: str) -> None:
    Path("bad.toml").write_text('[[expect]]\nid = "a/b"\nlink = ""\n')
    result = run(*options, "reference")
    assert result.exit_code == 2, result.output
    assert words in result.output


@pytest.mark.parametrize("mode", ["zero", "exit", "miss"])
def test_a_first_hit_client_is_granted_and_one_with_the_other_mode_is_not(mode: str) -> None:
    Path("firsts.py").write_text(
        "from raycert.cases.protocol import first\nfrom raycert.reference.tracer import intersect\n"
        f"hello = {{'name': 'firsts', 'answers': 'first', 'from_inside': {mode!r}}}\n"
        f"def good(solid, ray): return first(intersect(solid, ray), {mode!r})\n"
        "def bad(solid, ray):\n"
        f"    other = 'exit' if {mode!r} == 'zero' else 'zero'\n"
        "    return first(intersect(solid, ray), other)\n"
    )
    part = ("--level", "stable", "--family", "start-inside", "--family", "sphere-start")
    good = run(*part, "firsts:good")
    assert good.exit_code == 0, good.output
    bad = run(*part, "firsts:bad")
    assert bad.exit_code == 1, bad.output
    assert any("from_inside" in note for note in form()["run"]["notes"])


def test_a_yes_or_no_client_is_granted() -> None:
    Path("yes.py").write_text(
        "from raycert.reference.tracer import intersect\n"
        "hello = {'name': 'yes', 'answers': 'any'}\n"
        "def good(solid, ray): return bool(intersect(solid, ray))\n"
        "def bad(solid, ray): return True\n"
    )
    part = ("--smoke", "--level", "stable")
    assert run(*part, "yes:good").exit_code == 0
    assert run(*part, "yes:bad").exit_code == 1


def test_who_crashes_and_hangs_is_graded_on_all_the_others() -> None:
    """Each hundredth case crashes it, each five-hundredth hangs it, whenever it is asked."""
    Path("rough.py").write_text(
        "import os, sys, time\nfrom zlib import crc32\n"
        "from raycert.cases.protocol import Hello\nfrom raycert.cases.protocol import serve\n"
        "from raycert.reference.tracer import intersect\n"
        "def rough(solid, ray):\n"
        "    number = crc32(repr((solid, ray)).encode())\n"
        "    if number % 500 == 1: time.sleep(60)\n"
        "    if number % 100 == 2: os._exit(7)\n"
        "    return intersect(solid, ray)\n"
        "serve(rough, Hello('rough'))\n"
    )
    options = ("--shard", "1/7", "--case-timeout", "0.3", "--level", "stable")
    result = run(*options, "--", sys.executable, "rough.py")
    assert result.exit_code == 1, result.output
    read = form()
    why = [f["faults"]["sound"].partition(":")[0] for f in read["failures"] if f["answer"] is None]
    assert read["tested"] > 850
    assert why.count("crash") >= 4
    assert why.count("hang") >= 1
    assert set(why) == {"crash", "hang"}
    others = [f for f in read["failures"] if f["answer"] is not None]
    assert not any({"sound", "stable"} & set(f["faults"]) for f in others if f["tier"] != "range")
    found = subprocess.run(["pgrep", "-f", "rough.py"], capture_output=True, text=True, check=False)
    assert not found.stdout
