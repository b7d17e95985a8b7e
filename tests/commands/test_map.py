"""`raycert map`: exit statuses, files, and what is said about what cannot be mapped."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands.map import draw_map

ROD = ("--cylinder", "0,0,0", "0,0,2", "1", "--ray=-3,1,1", "1,0,0")
AXES = ("--x", "ray.origin[1]", "--y", "solid.radius")
SMALL = ("--cells", "6")


def run(*words: str, given: str | None = None) -> Result:
    return CliRunner().invoke(draw_map, [*words], input=given)


def test_all_files_are_written_and_what_was_found_is_said(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    paths = [tmp_path / f"map.{end}" for end in ("png", "svg", "json", "csv")]
    outs = [word for path in paths for word in ("--out", str(path))]
    result = run(*ROD, *AXES, *SMALL, *outs)
    assert result.exit_code == 0, result.output
    assert "49 of 49 cells" in result.output
    assert "double root, through 7 cells" in result.output
    assert paths[0].read_bytes().startswith(b"\x89PNG")
    assert b"<svg" in paths[1].read_bytes()
    form = json.loads(paths[2].read_text())
    assert (form["unit"], form["half"], form["step"], form["whole"]) == ("ulps", 3, 1.0, True)
    assert len(paths[3].read_text().splitlines()) == 50


def test_a_target_is_asked(tmp_path: Path) -> None:
    out = tmp_path / "map.json"
    result = run(
        *ROD, *AXES, *SMALL, "--target", "raycert.oracle.zoo.textbook:textbook", "--out", str(out)
    )
    assert result.exit_code == 0, result.output
    form = json.loads(out.read_text())
    assert (form["show"], form["target"]) == ("k", "raycert.oracle.zoo.textbook:textbook")
    assert all(cell["value"] < 64 for cell in form["cells"])


def test_the_reference_is_the_target_where_none_is_named(tmp_path: Path) -> None:
    out = tmp_path / "map.json"
    result = run(*ROD, *AXES, *SMALL, "--show", "answer", "--out", str(out))
    assert result.exit_code == 0, result.output
    assert json.loads(out.read_text())["cells"][24]["class"] == "1 pair, a touch"


def test_a_golden_row_and_an_object_are_cases(tmp_path: Path) -> None:
    out = str(tmp_path / "map.csv")
    golden = run("far-grazing/cylinder-tangent-1e8", *AXES, *SMALL, "--out", out)
    assert golden.exit_code == 0, golden.output
    form = {
        "solid": {"type": "union", "of": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]},
        "ray": {"origin": [-3, 0, 0], "direction": [1, 0, 0]},
    }
    words = ("--x", "solid.of[0].center[1]", "--y", "ray.origin[0]=1,ray.direction[0]=1")
    result = run("--case", "-", *words, *SMALL, "--out", out, given=json.dumps(form))
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((*ROD, "--x", "ray.origin[3]", "--y", "solid.radius"), "ray.origin[2]"),
        ((*ROD, "--x", "solid.radius", "--y", "solid.radius"), "same direction"),
        ((*ROD, *AXES, "--span", "x"), "not a number"),
        ((*ROD, *AXES, "--span", "1.5"), "whole number of ulps"),
        ((*ROD, *AXES, "--show", "exact", "--target", "oracle"), "asks no --target"),
        ((*ROD, *AXES, "--show", "k", "--target", "'"), "--target"),
        (("no/such", *AXES), "no row"),
        (AXES, "give one case"),
        (("some/row", *ROD, *AXES), "give one case"),
    ],
)
def test_bad_usage_is_two(words: tuple[str, ...], said: str, tmp_path: Path) -> None:
    result = run(*words, "--out", str(tmp_path / "map.csv"))
    assert result.exit_code == 2, result.output
    assert said in result.output
    assert not list(tmp_path.iterdir())


def test_a_file_of_another_kind_is_refused_before_the_work(tmp_path: Path) -> None:
    result = run(*ROD, *AXES, "--out", str(tmp_path / "map.gif"))
    assert result.exit_code == 2
    assert ".png, .svg, .json, .csv" in result.output


@pytest.mark.parametrize("name", ["no_such_module:intersect", "./no-such-program"])
def test_a_target_that_cannot_be_run_is_three(name: str, tmp_path: Path) -> None:
    out = str(tmp_path / "map.csv")
    result = run(*ROD, *AXES, *SMALL, "--target", name, "--out", out)
    assert result.exit_code == 3, result.output


def test_a_target_of_another_format_is_three(tmp_path: Path) -> None:
    words = ("--precision", "binary32", "--show", "k", "--out", str(tmp_path / "map.csv"))
    result = run(*ROD, *AXES, *SMALL, *words)
    assert result.exit_code == 3
    assert "binary32" in result.output
