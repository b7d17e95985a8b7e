"""Kills commands at random moments, by hand: `python tests/commands/kills.py COUNT SEED [KIND...]`.

COUNT times each signal, once or twice within a tenth of a second, against `certify --smoke` with a
client that has a child and one whose child leaves the session, and against a hunt with two workers.
After each: no process is left, no temporary file, no traceback, and what was written can be read.
A signal that comes before the command takes it (while Python starts) is counted apart.
"""

from __future__ import annotations

import json
import os
import random
import secrets
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

CLIENT = (sys.executable, str(Path(__file__).parents[1] / "clients" / "family.py"))
RAYCERT = (sys.executable, "-m", "raycert")
COMMANDS = {
    "certify": (*RAYCERT, "certify", "--smoke", "--out", "c.json", "--", *CLIENT, "pids"),
    "escapes": (
        *RAYCERT, "certify", "--smoke", "--out", "c.json", "--html", "c.html", "--",
        *CLIENT, "pids", "escapes",
    ),
    "hunt": (
        *RAYCERT, "hunt", "--workers", "2", "--cases", "1500", "--no-golden", "--",
        *CLIENT, "pids",
    ),
}  # fmt: skip
LONGEST = {"certify": 1.5, "escapes": 1.5, "hunt": 6.0}
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)


def left(token: str) -> list[str]:
    """Return the command lines of processes that have the token in their environment."""
    found = []
    for place in Path("/proc").iterdir():
        try:
            if place.name.isdigit() and token.encode() in (place / "environ").read_bytes():
                found.append((place / "cmdline").read_bytes().decode().replace("\0", " "))
        except OSError:
            pass
    return found


def started(file: Path, count: int) -> None:
    """Wait until clients have been started so often: to be greeted, for the easy cases, for all."""
    deadline = time.monotonic() + 20
    while count and time.monotonic() < deadline:
        if file.exists() and len(file.read_text().splitlines()) >= count:
            return
        time.sleep(0.01)


def kill(kind: str, number: int, dice: random.Random, folder: Path) -> tuple[str, list[str]]:
    """Run a command, kill it, and return how it ended and what is wrong with what it left."""
    out, tmp, token = folder / "out", folder / "tmp", f"KILLED-{secrets.token_hex(8)}"
    out.mkdir()
    tmp.mkdir()
    environment = {**os.environ, "RAYCERT_KILLED": token, "TMPDIR": str(tmp)}
    with (folder / "errors").open("wb") as errors:
        process = subprocess.Popen(
            COMMANDS[kind], cwd=out, env=environment, stdout=errors, stderr=errors,
            start_new_session=True,
        )  # fmt: skip
        started(out / "pids", dice.randrange(4))
        time.sleep(dice.uniform(0.05, LONGEST[kind]))
        for again in range(dice.choice((1, 2))):
            time.sleep(again * dice.uniform(0, 0.1))
            # As a terminal does: to the whole group.
            if process.poll() is None:
                os.killpg(process.pid, number)
        try:
            status = process.wait(60)
        except subprocess.TimeoutExpired:
            process.kill()
            return "hangs", ["it did not end"]
    deadline = time.monotonic() + 2
    while (alive := left(token)) and time.monotonic() < deadline:
        time.sleep(0.01)
    said = (folder / "errors").read_text()
    wrong = [f"left: {line}" for line in alive]
    wrong += [f"temporary: {path}" for path in (*out.rglob(".*"), *tmp.iterdir())]
    early = status < 0 or (number == signal.SIGINT and "main()" not in said and status == 1)
    if ("Traceback" in said or "Exception ignored" in said) and not early:
        wrong.append(f"said: {said[-3000:]}")
    for path in out.rglob("*.json*"):
        try:
            text = path.read_text()
            for part in text.splitlines() if path.suffix == ".jsonl" else [text]:
                json.loads(part)
        except ValueError as error:
            wrong.append(f"{path}: {error}")
    return f"early {status}" if early and "raycert" not in said else f"status {status}", wrong


def main(count: str = "50", seed: str = "1", *kinds: str) -> None:
    dice, failures = random.Random(seed), 0
    for kind in kinds or COMMANDS:
        for number in SIGNALS:
            ends = Counter[str]()
            for _ in range(int(count)):
                with tempfile.TemporaryDirectory() as folder:
                    end, wrong = kill(kind, number, dice, Path(folder))
                    ends[end] += 1
                    for line in wrong:
                        print(f"  {kind} {number.name}: {line}", flush=True)
                    failures += bool(wrong)
            print(kind, number.name, dict(ends), flush=True)
    print(f"{failures} failures")
    raise SystemExit(bool(failures))


if __name__ == "__main__":
    main(*sys.argv[1:])
