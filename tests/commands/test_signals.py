"""Commands that are interrupted, or that nobody listens to: what is kept, the status, what is left.

A client chooses the moment (clients/killer.py), so nothing here depends on time. Random moments are
for kills.py, which is run by hand.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from raycert.cases.corpus import GOLDEN, MANIFEST, manifest, write_whole
from shared.places import CLIENTS
from shared.processes import gone

pytestmark = pytest.mark.skipif(os.name != "posix", reason="other signals")
RAYCERT = (sys.executable, "-m", "raycert")
GREETED, EASY, ASKED = 1, 2, 3
"""What a client is started for, one start after the other."""


@pytest.fixture(scope="module")
def few(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Golden files of a few rows, which are read in no time."""
    folder = tmp_path_factory.mktemp("golden")
    name = "binary64/rim.jsonl"
    files = {name: (GOLDEN / name).read_bytes()}
    for name, data in (files | {MANIFEST: manifest(files)}).items():
        write_whole(folder / name, data)
    return folder


def killed(number: str, start: int, few: Path, folder: Path) -> tuple[int, str]:
    """Certify a client that kills us in a start; hold that nothing is left of it."""
    client = (sys.executable, str(CLIENTS / "killer.py"), "pids", number, str(start))
    command = (*RAYCERT, "certify", "--golden", str(few), "--", *client)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60)
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    pids = [int(word) for word in (folder / "pids").read_text().split()]
    assert len(pids) == 2 * start
    assert sys.platform != "linux" or gone(pids)
    assert not list(folder.glob(".*"))
    return done.returncode, done.stdout


@pytest.mark.parametrize("number", ["SIGINT", "SIGTERM"])
def test_twice_a_signal_keeps_what_is_known_and_leaves_no_process(
    number: str, few: Path, tmp_path: Path
) -> None:
    status, said = killed(number, ASKED, few, tmp_path)
    form = json.loads((tmp_path / "certificate.json").read_text())
    assert form["run"]["interrupted"]
    assert form["tested"] == 1
    assert not form["granted"]
    assert status == 1
    assert "the run was interrupted" in " ".join(said.split())


def test_in_the_easy_cases_nothing_is_tested_yet(few: Path, tmp_path: Path) -> None:
    status, _ = killed("SIGHUP", EASY, few, tmp_path)
    form = json.loads((tmp_path / "certificate.json").read_text())
    assert form["run"]["interrupted"]
    assert form["tested"] == 0
    assert status == 3


def test_what_keeps_nothing_has_the_status_of_the_signal(tmp_path: Path) -> None:
    code = (
        "import os, signal, sys; sys.argv = ['raycert', 'golden', 'check']\n"
        "from raycert.oracle.commands import golden, main\n"
        "golden.compare = lambda *_: os.kill(os.getpid(), signal.SIGTERM)\n"
        "main.main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 128 + signal.SIGTERM
    assert done.stderr == "raycert: interrupted\n"


@pytest.mark.parametrize("shell", [">&- 2>&- <&-", "2>&1 | true"])
def test_nobody_listens_and_the_verdict_is_the_same(shell: str, few: Path, tmp_path: Path) -> None:
    words = ("certify", "--golden", str(few), "--convention", "regularized", "--html", "page.html")
    line = f'{{ "$@"; echo $? > status; }} {shell}'
    command = ["sh", "-c", line, "sh", *RAYCERT, *words, "reference"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert (tmp_path / "status").read_text() == "1\n"
    assert json.loads((tmp_path / "certificate.json").read_text())["tested"] > 0
    assert (tmp_path / "page.html").exists()
    assert done.stderr == ""


@pytest.mark.parametrize("name", ["oracle", "reference"])
def test_serving_ends_with_its_listener(name: str) -> None:
    line = """yes '{"hello": 1}' | "$@" | head -n 1"""
    command = ["sh", "-c", line, "sh", *RAYCERT, "serve", name]
    done = subprocess.run(command, capture_output=True, text=True, timeout=30)
    assert done.stdout.startswith('{"hello":1')
    assert "Traceback" not in done.stderr
