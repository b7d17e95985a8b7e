"""`adopt` from a file of each kind, and every way to get it wrong."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from raycert.cases.corpus import read_corpus
from raycert.oracle.commands.adopt import adopt
from raycert.oracle.commands.golden import golden
from raycert.oracle.corpus.golden import Contradiction

FORM = {
    "solid": {"type": "cylinder", "p": [0, 0, 0], "q": [0, 0, 2], "radius": 1},
    "ray": {"origin": [-3, 0.25, 1], "direction": [1, 0, 0]},
}
WHY = ("--why", "A ray crosses a cylinder aside of its axis.")


@pytest.fixture(autouse=True)
def usual_witnesses(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ask the two quick witnesses, which need no extra."""
    monkeypatch.setattr(
        "raycert.oracle.commands.adopt.installed", lambda: ("definition", "enclosure")
    )


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "case.json"
    path.write_text(json.dumps(FORM))
    return path


def run(file: Path, corpus: Path, *words: str) -> Result:
    return CliRunner().invoke(adopt, [str(file), "--corpus", str(corpus), *words])


def test_a_json_object_becomes_a_golden_row_and_that_row_another(
    file: Path, tmp_path: Path
) -> None:
    result = run(file, tmp_path / "mine", "--family", "crossed", *WHY, "--flag", "far")
    assert result.exit_code == 0, result.output
    assert "adopted as crossed/far-cylinder (binary64, binary32)" in result.stdout
    assert "definition: agreed" in result.stdout
    assert "symbols: not installed, not asked" in result.stdout
    made = tmp_path / "mine" / "golden"
    [row] = read_corpus("binary64", made).rows
    assert (row.why, row.flags) == (WHY[1], ("far",))
    words = ("--family", "again", *WHY, "--id", row.id, "--slug", "aside", "--source", "x/y #2")
    for given in (made, made / "binary64" / "crossed.jsonl"):
        result = run(given, tmp_path / given.name, *words)
        assert result.exit_code == 0, result.output
        [again] = read_corpus("binary64", tmp_path / given.name / "golden").rows
        assert (again.id, again.ray, again.source) == ("again/aside", row.ray, "x/y #2")


def test_a_witness_that_disagrees_is_exit_1(
    file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def differs(*_: object) -> None:
        raise Contradiction("definition finds [[1, 2]]")

    monkeypatch.setattr("raycert.oracle.commands.adopt.examine", differs)
    result = run(file, tmp_path / "mine", "--family", "crossed", *WHY)
    assert result.exit_code == 1
    assert "nothing was written: definition finds" in result.stderr
    assert not list((tmp_path / "mine").rglob("*.jsonl"))


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--family", "crossed"), "--why"),
        (WHY, "--family"),
        (("--family", "crossed", *WHY, "--id", "a/b"), "is one case"),
        (("--family", "crossed", "--why", "It must."), "without 'must'"),
        (("--family", "crossed", *WHY, "--tier", "lattice"), "off the lattice"),
        (("--family", "crossed", *WHY, "--slug", "A B"), "--slug"),
    ],
)
def test_bad_usage_is_exit_2(words: tuple[str, ...], says: str, file: Path, tmp_path: Path) -> None:
    result = run(file, tmp_path / "mine", *words)
    assert result.exit_code == 2
    assert says in result.stderr


def test_a_file_with_no_case_is_exit_2(tmp_path: Path) -> None:
    words = ("--family", "crossed", *WHY)
    for text, says in (("{}", "solid: is missing"), ("[]", "bad.json"), ("{", "bad.json")):
        (tmp_path / "bad.json").write_text(text)
        result = run(tmp_path / "bad.json", tmp_path / "mine", *words)
        assert result.exit_code == 2, result.output
        assert says in result.stderr
    (tmp_path / "empty.jsonl").write_text("")
    assert "has no golden rows" in run(tmp_path / "empty.jsonl", tmp_path / "m", *words).stderr


def test_of_several_rows_one_is_to_be_chosen(file: Path, tmp_path: Path) -> None:
    run(file, tmp_path / "mine", "--family", "crossed", *WHY, "--slug", "one")
    file.write_text(json.dumps(FORM | {"ray": {"origin": [0, 0, 0.5], "direction": [1, 1, 0]}}))
    run(file, tmp_path / "mine", "--family", "crossed", "--why", "It ends.", "--slug", "two")
    golden = tmp_path / "mine" / "golden"
    result = run(golden, tmp_path / "other", "--family", "found", *WHY)
    assert result.exit_code == 2
    assert "choose one with --id: crossed/one, crossed/two" in result.stderr
    result = run(golden, tmp_path / "other", "--family", "found", *WHY, "--id", "crossed/three")
    assert "no row 'crossed/three'" in result.stderr


def test_outside_a_checkout_a_corpus_is_to_be_named(
    file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "raycert.oracle.commands.adopt.CORPUS", tmp_path / "site-packages" / "cases"
    )
    unfit = ("--why", "It must.")  # so nothing is written whatever CORPUS is
    result = CliRunner().invoke(adopt, [str(file), "--family", "crossed", *unfit])
    assert result.exit_code == 2
    assert "--corpus DIR" in result.stderr


def test_golden_check_and_write_know_an_adopted_corpus(file: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    assert run(file, mine, "--family", "crossed", *WHY).exit_code == 0
    before = {path: path.read_bytes() for path in (mine / "golden").rglob("*") if path.is_file()}
    for verb in ("check", "write", "check"):
        result = CliRunner().invoke(golden, [verb, "--corpus", str(mine)])
        assert result.exit_code == 0, result.output
    assert {p: p.read_bytes() for p in (mine / "golden").rglob("*") if p.is_file()} == before
    next((mine / "golden").rglob("crossed.jsonl")).write_text("")
    assert CliRunner().invoke(golden, ["check", "--corpus", str(mine)]).exit_code == 1
