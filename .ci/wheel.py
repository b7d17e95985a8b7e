"""Fail where the built wheel lacks a file of the packages, or holds one that is not theirs."""

import subprocess
import sys
import zipfile

FOLDERS = ("cases/", "oracle/", "reference/")
FACE = "oracle/face/"


def installed(name: str) -> str:
    """Return where a file of the repository lies in the wheel."""
    return f"raycert/{name.removeprefix(FACE)}"


def main(wheel: str) -> int:
    """Compare the wheel's files with those that git tracks."""
    tracked = subprocess.run(["git", "ls-files"], check=True, capture_output=True, text=True)
    wanted = {installed(name) for name in tracked.stdout.split("\n") if name.startswith(FOLDERS)}
    with zipfile.ZipFile(wheel) as archive:
        packed = {name for name in archive.namelist() if ".dist-info/" not in name}
    for name in sorted(wanted ^ packed):
        print(f"{name}: {'not in the wheel' if name in wanted else 'in the wheel, not tracked'}")
    print(f"{wheel.rsplit('/', 1)[-1]}: {len(packed)} files")
    return int(wanted != packed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
