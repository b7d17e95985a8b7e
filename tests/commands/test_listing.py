"""`list` and `show` on a small corpus of their own."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from raycert.cases.corpus import read_corpus
from raycert.cases.flags import FLAGS
from raycert.oracle.commands.listing import show
from raycert.oracle.commands.main import main
from shared.small_corpus import write_small

PLAIN = ["through", "tangent", "miss", "slab", "tube", "far"]


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_small(tmp_path_factory.mktemp("golden"))


def run(golden: Path, *words: str) -> Result:
    return CliRunner().invoke(main, ["list", *words, "--golden", str(golden)])


def slugs(result: Result) -> list[str]:
    assert result.exit_code == 0, result.output
    lines = [line for line in result.stdout.splitlines() if line]
    return [line.split("\t")[0].split("/")[1] for line in lines]


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("", [*PLAIN, "tree"]),
        ("--family plain", PLAIN),
        ("--family plain --family tree", [*PLAIN, "tree"]),
        ("--tier lattice", ["through", "tangent", "miss"]),
        ("--flag tangent", ["tangent", "far"]),
        ("--flag tangent --flag far", ["far"]),
        ("--row through --row AE", ["through", "tangent", "tree"]),
        ("--row m=n", ["tangent"]),
        ("--solid slab", ["slab"]),
        ("--solid difference", ["tree"]),
        ("--source geant4", ["tangent"]),
        ("--touch tangent", ["tangent"]),
        ("--touch none --tier lattice", ["through"]),
        ("--not-decisive sound", ["far"]),
        ("--precision binary32 --family tree", ["tree"]),
    ],
)
def test_rows_are_selected(golden: Path, words: str, found: list[str]) -> None:
    assert slugs(run(golden, *words.split())) == found


def test_nothing_found_is_said(golden: Path) -> None:
    result = run(golden, "--touch", "wall")
    assert result.exit_code == 0
    assert result.stdout == ""
    assert "no row" in result.stderr


def test_counts(golden: Path) -> None:
    assert run(golden, "--count").stdout.split() == ["plain", "6", "tree", "1", "rows", "7"]
    by_tier = run(golden, "--count", "tier", "--family", "plain").stdout.split()
    assert by_tier == ["lattice", "3", "stiff", "2", "generic", "1", "rows", "6"]
    assert "tangent" in run(golden, "--count", "flag").stdout
    for field in ("row", "solid", "source", "touch", "decisive"):
        assert run(golden, "--count", field).exit_code == 0


def test_families_are_listed_with_their_tiers(golden: Path) -> None:
    lines = run(golden, "--families").stdout.splitlines()
    assert lines[0].startswith("plain\t3 lattice, 1 generic, 2 stiff")
    assert lines[1].startswith("tree\t1 generic")


def test_installed_families_are_listed_with_their_reasons() -> None:
    result = CliRunner().invoke(main, ["list", "--families"])
    assert result.exit_code == 0
    assert all(line.split("\t")[2] for line in result.stdout.splitlines())


def test_the_legend_names_every_flag(golden: Path) -> None:
    text = run(golden, "--flags").stdout
    assert all(f"{name}\n" in text for name in FLAGS)


@pytest.mark.parametrize(
    ("words", "near"),
    [
        ("--flag tangnt", "did you mean tangent"),
        ("--family plane", "did you mean plain"),
        ("--row thru", "did you mean through"),
        ("--solid cylinder2", "did you mean cylinder"),
        ("--touch edge", "known: cap, none, rim"),
    ],
)
def test_unknown_names_are_refused_with_near_ones(golden: Path, words: str, near: str) -> None:
    result = run(golden, *words.split())
    assert result.exit_code == 2
    assert near in result.stderr


def test_a_folder_without_a_manifest_is_refused(tmp_path: Path) -> None:
    result = run(tmp_path)
    assert result.exit_code == 2
    assert "golden write" in result.stderr


def shown(golden: Path, *words: str) -> Result:
    return CliRunner().invoke(show, [*words, "--golden", str(golden)])


def test_show_prints_what_the_file_holds(golden: Path) -> None:
    result = shown(golden, "plain/tangent", "tree/tree")
    assert result.exit_code == 0
    for words in (
        "A ray touches.",
        "source Geant4 #1",
        "p (0, 0, 0)  q (0, 0, 2)  radius 1",
        "a touch (tangent)",
        "through AE meet a>c b<d m=n",
        "discriminant is exactly zero",
        "Exact interval 2 of 2",
        "of[1]",
        "the smaller root of t^2 - 6 t + 6",
        "stable outer",
    ):
        assert words in result.stdout


def test_show_json_is_the_line_of_the_file(golden: Path) -> None:
    line = shown(golden, "plain/far", "--json", "-").stdout
    assert line in (golden / "binary64" / "plain.jsonl").read_text()
    assert json.loads(line)["id"] == "plain/far"


def test_show_fits_the_screen_and_full_cuts_nothing(golden: Path) -> None:
    short, full = shown(golden, "plain/far"), shown(golden, "plain/far", "--full")
    assert max(map(len, short.stdout.splitlines())) <= 80
    assert "..." in short.stdout
    assert "..." not in full.stdout
    row = read_corpus("binary64", golden).row("plain/far")
    assert row is not None
    polynomial = row.intervals[0].enter.polynomial or ()
    assert str(abs(polynomial[-1])) in full.stdout


@pytest.mark.parametrize(
    ("id", "words"),
    [
        ("plain/trough", "did you mean plain/through"),
        ("through", "did you mean plain/through"),
        ("plain/zzzzzzzzzzzzzzzzz", "raycert list --family plain"),
        ("zzzz", "raycert list --families"),
    ],
)
def test_an_unknown_id_is_refused_with_near_ones(golden: Path, id: str, words: str) -> None:
    result = shown(golden, id)
    assert result.exit_code == 2
    assert words in result.stderr
