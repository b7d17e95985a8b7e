"""A lock waits for who has the folder, not for ever, and never for who has ended."""

import subprocess
import sys
from pathlib import Path

import pytest

from raycert.oracle.corpus import lock
from raycert.oracle.corpus.lock import locked

HOLD = """
import sys
from pathlib import Path
from raycert.oracle.corpus.lock import locked
with locked(Path(sys.argv[1])):
    print("mine", flush=True)
    sys.stdin.read()
"""


def test_one_waits_for_the_other_but_not_for_who_was_killed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lock, "PATIENCE", 0.1)
    command = [sys.executable, "-c", HOLD, str(tmp_path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        assert other.stdout
        assert other.stdout.readline() == b"mine\n"
        with (
            pytest.raises(TimeoutError, match="has been writing here"),
            locked(tmp_path),
        ):
            pass
        other.kill()
        other.wait()
        with locked(tmp_path):
            assert not list(tmp_path.iterdir())


def test_a_folder_that_is_made_anew_is_locked_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lock, "PATIENCE", 0.1)
    folder = tmp_path / "out"
    with locked(folder):
        folder.rmdir()
        with locked(folder):
            assert folder.is_dir()
            with pytest.raises(TimeoutError), locked(folder):
                pass
