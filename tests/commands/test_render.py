"""`raycert render`: pictures on disk, one line about them, and refusals that name the field."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from PIL import Image

from raycert.cases.scene import load, shipped, write_scene
from raycert.oracle.commands import scenes
from raycert.oracle.commands.explain import explain
from raycert.oracle.commands.render import render
from raycert.oracle.plots.heatmap import LEAST_WIDTH, STRIP


def run(*words: str) -> Result:
    return CliRunner().invoke(render, words)


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("show", ["depth", "normal", "thickness", "count", "error"])
def test_a_picture_of_each_kind(show: str, tmp_path: Path) -> None:
    result = run("pipe", "--size", "24x18", "--show", show)
    assert result.exit_code == 0, result.output
    with Image.open(tmp_path / f"pipe-{show}.png") as image:
        assert image.size == (LEAST_WIDTH, LEAST_WIDTH * 18 // 24 + STRIP)
    assert f"pipe-{show}.png: 24x18" in result.output


def test_the_line_tells_hits_extremes_and_what_was_left_out() -> None:
    result = run("die", "--size", "32x24", "-o", "die.png", "--off", "axis")
    assert "of 768 rays hit, depth 6." in result.output
    assert "left out: " in result.output
    assert "scaling" in result.output
    assert "axis" not in result.output


def test_the_same_picture_with_and_without_an_item(tmp_path: Path) -> None:
    for name, off in (("a.png", ()), ("b.png", ("--off", "bounds", "--off", "misses"))):
        assert run("forest", "--size", "32x24", "-o", name, *off).exit_code == 0
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


@pytest.mark.parametrize("name", shipped())
def test_errors_are_small_in_every_scene(name: str) -> None:
    result = run(name, "--size", "16x12", "--show", "error")
    assert result.exit_code == 0, result.output
    assert "above 64: 0" in result.output
    assert float(result.output.split("k at most ")[1].split(";")[0]) <= 64


def test_the_textbook_fails_far_away_and_the_worst_pixel_can_be_explained() -> None:
    result = run("far", "--size", "24x18", "--show", "error", "--method", "textbook")
    assert result.exit_code == 1
    assert float(result.output.split("k at most ")[1].split(";")[0]) > 1e5
    words = result.output.split("raycert render ")[1].split(" | ")[0].split()
    case = run(*words).output
    derived = CliRunner().invoke(explain, ["--case", "-"], input=case)
    assert derived.exit_code == 0, derived.output


def test_a_pixel_is_a_case() -> None:
    form = json.loads(run("lens", "--size", "8x6", "--pixel", "4,3").output)
    assert set(form) == {"solid", "ray"}
    assert form["ray"]["origin"][0] == (6.0).hex()


def test_the_shipped_scenes_are_listed() -> None:
    result = run("--list")
    assert [line.split()[0] for line in result.output.splitlines() if line[0] != " "] == [
        *shipped()
    ]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "name a scene"),
        (("nowhere.json",), "no scene 'nowhere.json' and no such file; known: "),
        (("die", "--size", "32"), "--size: is not WxH"),
        (("die", "--size", "0x9"), "--size[0]: is not a whole number"),
        (("die", "--size", "8x6", "--pixel", "8,0"), "--pixel: 8,0 is not in a picture of 8x6"),
        (("die", "--pixel", "a"), "--pixel: is not X,Y"),
        (("die", "--show", "colour"), "Invalid value for '--show'"),
        (("die", "-o", "/proc/none/x.png"), "cannot write"),
    ],
)
def test_bad_usage_says_what_is_wrong(words: tuple[str, ...], message: str) -> None:
    result = run(*words)
    assert result.exit_code == 2
    assert message in result.output


def test_an_unknown_item_is_refused(capfd: pytest.CaptureFixture[str]) -> None:
    assert run("die", "--size", "8x6", "--off", "magic").exit_code == 2
    assert "no item magic; items: bounds" in capfd.readouterr().err


def test_a_bad_scene_names_the_field(tmp_path: Path) -> None:
    form = write_scene(load("cylinder"))
    form["solids"][0]["solid"]["radius"] = -1
    (tmp_path / "bad.json").write_text(json.dumps(form))
    result = run("bad.json")
    assert result.exit_code == 2
    assert "bad.json: solids[0].solid.radius: is negative: -1.0" in result.output


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    result = run("die")
    assert result.exit_code == 3
    assert 'render needs numpy, pillow: pip install "raycert[plots]"' in result.output


def test_a_tracer_that_fails_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scenes, "COMMAND", (sys.executable, "-c", "raise SystemExit(1)"))
    result = run("die")
    assert result.exit_code == 3
    assert "the tracer failed" in result.output


QUIET = """
import sys
from click.testing import CliRunner
from raycert.oracle.commands.render import render
CliRunner().invoke(render, ["--help"])
print({"numpy", "PIL"} & set(sys.modules))
"""


def test_help_loads_no_array_library() -> None:
    assert subprocess.check_output([sys.executable, "-c", QUIET], text=True) == "set()\n"
