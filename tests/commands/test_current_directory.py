"""Whatever the current directory holds, no module of ours is taken from it; a target is."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

from raycert.oracle.client.dialogue import Limits
from raycert.oracle.client.replay import greet
from raycert.oracle.client.target import target
from raycert.oracle.commands.main import PLACES
from shared.places import ROOT
from shared.small_corpus import write_small

TRAP = "open({log!r}, 'a').write({name!r} + ' ')\nraise ImportError('a file of the user')\n"
TRACER = """
from raycert.reference.tracer import intersect
hello = {"name": "theirs"}
"""
OURS = {"cases", "oracle", "reference", "tests", "commands", "shared", "model", "tracer", "worker"}
NAMES = {
    name
    for name in OURS | {"raycert"} | sys.stdlib_module_names | set(packages_distributions())
    if name.isidentifier() and not name.startswith("__")
}
"""Of ours, of Python, of all that is installed: what may be imported anywhere."""
PACKAGES = {"cases", "oracle", "tests", "rich"}

SPHERE = '{"solid": {"type": "sphere", "center": [0,0,0], "radius": 1},'
SPHERE += '"ray": {"origin": [-3,0,0], "direction": [1,0,0]}}'
CASE = ("--case", "case.json")
WORK: Mapping[str, tuple[str, ...]] = {
    "certify": ("reference", "--golden", "golden", "--html", "page.html", "--junit", "units.xml"),
    "explain": (*CASE, "--html", "case.html", "--target", "oracle"),
    "serve": ("reference",),
    "hunt": ("reference", "--cases", "2", "--workers", "2", "--no-golden"),
    "map": (*CASE, "--x", "ray.origin[0]", "--y", "ray.origin[1]", "--cells=3", "--out=map.png"),
    "render": ("die", "--size", "8x6"),
    "plan": ("die", "--size", "8x6", "--repeats", "1"),
    "crosscheck": ("--case", "case.json", "--witness", "definition"),
    "bench": ("--quick", "--scenario", "random", "--rays", "4", "--method", "oracle"),
    "stress": ("--quick", "--sweep", "far", "--method", "oracle", "--workers", "2"),
}
"""Verbs that start processes, at a little of their work; the others load what they use by help."""


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the console scripts as they are installed: theirs is the path of it."""
    folder = tmp_path_factory.mktemp("bin")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    for name, place in (project["scripts"] | {"pytest": "pytest:console_main"}).items():
        module, function = place.split(":")
        text = f"import sys\nfrom {module} import {function}\n"
        text += f"if __name__ == '__main__':\n    sys.exit({function}())\n"
        (folder / name).write_text(text)
    return folder


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_small(tmp_path_factory.mktemp("golden"))


def set_traps(folder: Path, names: set[str]) -> None:
    for name in names:
        path = folder / (f"{name}/__init__.py" if name in PACKAGES else f"{name}.py")
        path.parent.mkdir(exist_ok=True)
        path.write_text(TRAP.format(log=str(folder / "sprung"), name=name))
    (folder / "case.json").write_text(SPHERE)


@pytest.fixture
def here(tmp_path: Path, golden: Path) -> Iterator[Path]:
    (tmp_path / "golden").symlink_to(golden)
    yield tmp_path
    sprung = tmp_path / "sprung"
    assert not sprung.exists(), f"taken from the current directory: {sprung.read_text()}"


def run(here: Path, *words: str | Path, stdin: str = "") -> str:
    done = subprocess.run(
        [sys.executable, *words], cwd=here, input=stdin, capture_output=True, text=True
    )
    assert done.returncode == 0, (words, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


@pytest.mark.parametrize("verb", PLACES)
def test_a_verb_takes_nothing_from_the_current_directory(
    verb: str, here: Path, programs: Path
) -> None:
    set_traps(here, NAMES)
    run(here, programs / "raycert", verb, *WORK.get(verb, ("--help",)))


@cache
def before_us() -> set[str]:
    """Return what Python itself imports before a line of `raycert` runs that could prevent it."""
    code = "import runpy, sys, raycert.oracle.client; print(*sys.modules)"
    return set(subprocess.check_output([sys.executable, "-c", code], text=True).split())


@pytest.mark.parametrize("verb", list(PLACES)[::4])
def test_nor_does_it_where_it_is_run_as_a_module(verb: str, here: Path) -> None:
    """The current directory is left off the path before any verb is looked for."""
    set_traps(here, NAMES - before_us())
    run(here, "-m", "raycert", verb, "--help")


PYTEST = ("--raycert=reference:intersect", "--raycert-golden=golden", "-p", "no:cacheprovider")


def test_the_plugin_takes_nothing_but_the_target(here: Path, programs: Path) -> None:
    set_traps(here, NAMES)
    (here / "reference.py").write_text(TRACER)
    assert "2 passed" in run(here, programs / "pytest", *PYTEST)


def test_nor_does_it_under_python_m_pytest(here: Path) -> None:
    """There the whole of pytest takes what it finds: only names of ours are ours to defend."""
    set_traps(here, OURS)
    (here / "reference.py").write_text(TRACER)
    assert "2 passed" in run(here, "-m", "pytest", *PYTEST)


@pytest.mark.parametrize("name", ["mine", "reference", "cases", "tests", "json", "raycert"])
def test_a_target_is_found_whatever_its_name(
    name: str, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    set_traps(here, OURS - {name})
    (here / f"{name}.py").write_text(TRACER)
    monkeypatch.chdir(here)
    assert greet(target((f"{name}:intersect",)), Limits()).name == "theirs"
