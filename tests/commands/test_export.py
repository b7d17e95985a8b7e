"""The export read back by a small parser that knows the grammar and nothing else."""

import struct
from dataclasses import fields
from math import inf
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from raycert.cases.accept import Accept
from raycert.cases.corpus import read_corpus
from raycert.cases.formats import FORMATS
from raycert.cases.model import HalfSpace, InfiniteCylinder
from raycert.oracle.commands.export import COLUMNS, export, merged_ends
from raycert.oracle.exact.surd import enclose
from raycert.oracle.judge.levels import Judge
from shared.corpus import golden as known
from shared.small_corpus import write_small

SIZES = {"half_space": 6, "sphere": 4, "infinite_cylinder": 7, "slab": 6, "cylinder": 7}


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_small(tmp_path_factory.mktemp("golden"))


def run(golden: Path, *words: str) -> Result:
    return CliRunner().invoke(export, [*words, "--golden", str(golden)])


PARTS = ("difference", "sphere", "union", "cylinder", "half_space")
DECLARED = " ".join(f"--declared {name}" for name in PARTS)


class Reader:
    """Reads a row token by token; blanks and tabs are alike to it."""

    def __init__(self, line: str, pack: str) -> None:
        self.tokens = iter(line.split())
        self.pack = pack

    def word(self) -> str:
        return next(self.tokens)

    def count(self) -> int:
        return int(self.word())

    def number(self) -> float:
        value: float = struct.unpack(self.pack, bytes.fromhex(self.word()))[0]
        return value

    def numbers(self, count: int) -> tuple[float, ...]:
        return tuple(self.number() for _ in range(count))

    def pairs(self) -> tuple[tuple[float, float], ...]:
        return tuple((self.number(), self.number()) for _ in range(self.count()))

    def words(self) -> tuple[str, ...]:
        return tuple(self.word() for _ in range(self.count()))

    def solid(self) -> tuple[Any, ...]:
        kind = self.word()
        if kind in SIZES:
            return (kind, *self.numbers(SIZES[kind]))
        return (kind, *(self.solid() for _ in range(self.count())))

    def row(self) -> dict[str, Any]:
        found: dict[str, Any] = {"id": self.word(), "tier": self.word(), "solid": self.solid()}
        found["ray"] = self.numbers(6)
        for name in ("expected", "down", "up"):
            found[name] = self.pairs()
        found["decisive"] = self.words()
        for level in ("sound", "stable"):
            inner, outer = self.pairs(), self.pairs()
            found[level] = Accept(inner, outer, tuple(map(int, self.words())))
        found["touches"] = self.words()
        assert next(self.tokens, None) is None
        return found


def plain(solid: Any) -> tuple[Any, ...]:
    """Return a solid as the reader does, from its fields."""
    names = {HalfSpace: "half_space", InfiniteCylinder: "infinite_cylinder"}
    name = names.get(type(solid), type(solid).__name__.lower())
    values: list[Any] = []
    for field in fields(solid):
        value = getattr(solid, field.name)
        if field.name == "of":
            values += [plain(part) for part in value]
        else:
            values += value if isinstance(value, tuple) else [value]
    return (name, *values)


@pytest.mark.parametrize(("precision", "pack"), [("binary64", ">d"), ("binary32", ">f")])
def test_the_file_says_what_the_rows_say(golden: Path, precision: str, pack: str) -> None:
    result = run(golden, "--precision", precision)
    assert result.exit_code == 0
    lines = [line for line in result.stdout.split("\n") if line and not line.startswith("#")]
    rows = read_corpus(precision, golden).rows
    assert len(lines) == len(rows) == 7
    for line, row in zip(lines, rows, strict=True):
        assert len(line.split("\t")) == len(COLUMNS)
        assert all(cell == cell.strip() != "" for cell in line.split("\t"))
        read = Reader(line, pack).row()
        assert (read["id"], read["tier"]) == (row.id, row.tier)
        assert read["solid"] == plain(row.solid)
        assert read["ray"] == row.ray.origin + row.ray.direction
        assert read["expected"] == row.expected
        judge = Judge(row.solid, row.ray, FORMATS[precision])
        around = [tuple(enclose(t, judge.format) for t in pair) for pair in judge.merged]
        assert read["down"] == tuple((enter.down, leave.down) for enter, leave in around)
        assert read["up"] == tuple((enter.up, leave.up) for enter, leave in around)
        assert read["decisive"] == row.decisive
        assert {level: read[level] for level in row.accept} == row.accept
        assert read["touches"] == tuple(span.touch or "none" for span in row.intervals)


@pytest.mark.parametrize("precision", FORMATS)
def test_merged_ends_are_those_of_the_expected_list(precision: str) -> None:
    merged = 0
    for row in known(precision).rows:
        ends = merged_ends(row)
        assert tuple((enter.nearest, leave.nearest) for enter, leave in ends) == row.expected
        overflows = any(span.enter.up == inf for span in row.intervals)
        assert overflows == any(enter.up == inf for enter, _ in ends), row.id
        merged += len(ends) < len(row.intervals)
    assert merged


def test_columns_are_where_the_header_says(golden: Path) -> None:
    lines = run(golden).stdout.splitlines()
    header = next(line for line in reversed(lines) if line.startswith("#"))
    assert header[2:].split("\t") == list(COLUMNS)
    first = dict(zip(COLUMNS, lines[lines.index(header) + 1].split("\t"), strict=True))
    assert first["type"] == "cylinder"
    assert len(first["solid"].split()) == 7
    assert first["expected"] == "1 4000000000000000 4010000000000000"
    assert first["down"] == first["up"] == first["expected"]
    assert first["touches"] == "1 none"
    assert first["sound_most"] == "1 1"


def test_the_header_documents_the_grammar(golden: Path) -> None:
    wide, narrow = run(golden).stdout, run(golden, "--precision", "binary32").stdout
    assert "16 hex digits: the binary64" in wide
    assert "7ff0000000000000 is infinity" in wide
    assert "8 hex digits: the binary32" in narrow
    assert "7f800000 is infinity" in narrow
    text = CliRunner().invoke(export, ["--help"]).stdout
    for kind in (*SIZES, "union, intersection, difference"):
        assert kind in wide
        assert kind in text
    assert all(len(line) <= 90 for line in wide.splitlines() if line[:3] != "# i" and "#" in line)


@pytest.mark.parametrize(
    ("words", "ids"),
    [
        ("--family tree", ["tree/tree"]),
        ("--tier stiff --tier generic", ["plain/slab", "plain/tube", "plain/far", "tree/tree"]),
        ("--declared slab --declared infinite_cylinder", ["plain/slab", "plain/tube"]),
        (
            f"{DECLARED} --family tree",
            ["tree/tree"],
        ),
    ],
)
def test_rows_are_selected(golden: Path, words: str, ids: list[str]) -> None:
    lines = run(golden, *words.split()).stdout.splitlines()
    assert [line.split("\t")[0] for line in lines if line[0] != "#"] == ids


def test_a_tree_needs_all_its_types(golden: Path) -> None:
    result = run(golden, "--declared", "difference", "--declared", "sphere")
    assert result.exit_code == 2
    assert "no row" in result.stderr


def test_a_file_is_written_whole(golden: Path, tmp_path: Path) -> None:
    path = tmp_path / "deep" / "golden.tsv"
    result = run(golden, "--out", str(path))
    assert result.exit_code == 0
    assert result.stdout == ""
    assert "7 rows" in result.stderr
    assert path.read_text() == run(golden).stdout
    assert path.read_bytes().isascii()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--family plane", "did you mean plain"),
        ("--declared cilinder", "did you mean cylinder"),
        ("--tier hard", "hard"),
        ("--out /dev/null/golden.tsv", "--out"),
    ],
)
def test_bad_input_exits_2(golden: Path, words: str, said: str) -> None:
    result = run(golden, *words.split())
    assert result.exit_code == 2
    assert said in result.stderr
