"""Golden rows: what they say is the oracle's answer, and no drift of a file goes unnoticed."""

from __future__ import annotations

import os
from collections.abc import Callable
from fractions import Fraction
from math import inf
from pathlib import Path

import pytest

from raycert.cases.case import Case, Family
from raycert.cases.corpus import MANIFEST, read_corpus
from raycert.cases.formats import BINARY64, FORMATS, Format
from raycert.cases.model import Cylinder, Ray, Solid, Union
from raycert.oracle.corpus.golden import Contradiction, compare, golden_row, known, show, write
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import INFINITY, Surd, fraction
from raycert.oracle.witness.testimony import WITNESSES, Testimony
from shared.corpus import golden

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
ACROSS = Ray((-3, 0, 1), (1, 0, 0))
SLANTED = Ray((-3, 0.5, 1), (1, 0, 0))
RIGHT = ((Fraction(2), 4),)


def case(slug: str, ray: Ray, known: object = None) -> Case:
    return Case(slug, "A ray meets a can.", CAN, ray, "generic", (), "construction", known)  # type: ignore[arg-type]


def family(name: str, *cases: Case) -> Family:
    return Family(name, "Made by hand.", lambda fmt: cases)


ONE = family("one", case("across", ACROSS, RIGHT), case("slanted", SLANTED))
TWO = family("two", case("miss", Ray((9, 9, 9), (1, 0, 0)), ()))
FAMILIES = (ONE, TWO)
FILES = [f"{p}/{f.name}.jsonl" for p in FORMATS for f in FAMILIES]


def quiet(_: str) -> None:
    """Hear of no progress."""


def drifts(folder: Path) -> list[str]:
    return [f"{d.file}: {d.what}" for d in compare(folder, FAMILIES, quiet)]


def test_a_row_holds_the_answer_in_every_form() -> None:
    row = golden_row(ONE, ONE.cases(BINARY64)[1], BINARY64)  # type: ignore[index]
    enter, leave = row.intervals[0].enter, row.intervals[0].leave
    assert row.id == "one/slanted"
    assert enter.polynomial == leave.polynomial == (4, -24, 33)  # t = 3 +- sqrt(3)/2
    assert (enter.root, leave.root, enter.fraction) == (0, 1, None)
    assert enter.digits == "2.133974596215561353236276829247063816529e+0"
    assert enter.down <= enter.nearest <= enter.up
    assert (enter.faces, enter.kind) == (("side",), "crossing")
    assert row.expected == ((enter.nearest, leave.nearest),)
    assert row.rows == ("through", "AE", "meet", "a>c", "b<d", "m<n")
    assert row.condition is not None
    assert row.decisive == ("sound", "stable", "faithful", "exact")
    for accept in row.accept.values():
        assert accept.fault(row.expected) is None
        assert accept.fault([]) is not None


def test_infinity_and_trees() -> None:
    still = Ray((0, 0, 1), (0, 0, 0))
    row = golden_row(ONE, case("still", still, ((0, None),)), BINARY64)
    leave = row.intervals[0].leave
    assert (leave.polynomial, leave.root, leave.fraction) == (None, None, None)
    assert (leave.nearest, leave.digits, leave.kind, row.condition) == (inf, "inf", "end", None)
    tree = Case("tree", "A ray meets a tree.", Union((CAN,)), ACROSS, "generic")
    assert golden_row(ONE, tree, BINARY64).intervals[0].touch is None


@pytest.mark.parametrize(
    "wrong",
    [
        (),
        ((Fraction(2), Fraction(5)),),
        ((Fraction(2) + Fraction(1, 2**99), 4),),
        ((2, None),),
        ((2, 3), (3, 4)),
    ],
)
def test_a_known_answer_that_is_not_the_oracles_is_a_contradiction(wrong: object) -> None:
    with pytest.raises(Contradiction, match=r"one/across: known .* the oracle finds \[\[2\.0"):
        golden_row(ONE, case("across", ACROSS, wrong), BINARY64)
    assert golden_row(ONE, case("across", ACROSS, RIGHT), BINARY64).source == "construction"


def liar(solid: Solid, ray: Ray, answer: Intervals) -> Testimony:
    """Disagree with every hit, and leave every miss undecided."""
    return Testimony("disagreed" if answer else "undecided", "[]", "it lies")


def test_a_witness_that_disagrees_stops_the_writing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Undecided is no agreement, and no contradiction either."""
    monkeypatch.setitem(WITNESSES, "liar", f"{__name__}:liar")
    with pytest.raises(Contradiction, match=r"one/across: liar finds \[\]: it lies"):
        write(tmp_path, FAMILIES, quiet, ["liar"])
    assert list(tmp_path.iterdir()) == []
    write(tmp_path, (TWO,), quiet, ["liar"])
    assert (tmp_path / MANIFEST).exists()


def test_known_ends_are_exact_numbers() -> None:
    assert known(((0, Fraction(-1, 3)), (7, None))) == (
        (fraction(0, 1), fraction(-1, 3)),
        (fraction(7, 1), INFINITY),
    )
    assert show(((Surd(0, 1, 2, 1), INFINITY),)) == "[[1.4142135623730950488e+0, inf]]"


def test_what_is_written_checks_and_reads(tmp_path: Path) -> None:
    seen: list[str] = []
    files = write(tmp_path, FAMILIES, seen.append)
    assert list(files) == FILES
    assert seen == ["one/across", "one/slanted", "two/miss"] * 2
    assert drifts(tmp_path) == []
    assert [row.id for row in read_corpus("binary32", tmp_path).rows] == seen[:3]
    found = sorted(str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*") if p.is_file())
    assert found == sorted([*FILES, MANIFEST])


def test_writing_twice_gives_the_same_bytes(tmp_path: Path) -> None:
    one, two = (write(tmp_path / name, FAMILIES, quiet) for name in "ab")
    assert one == two
    assert (tmp_path / "a" / MANIFEST).read_bytes() == (tmp_path / "b" / MANIFEST).read_bytes()


def spoil(folder: Path, name: str, change: Callable[[bytes], bytes]) -> None:
    path = folder / name
    path.write_bytes(change(path.read_bytes()))


@pytest.mark.parametrize(
    ("name", "change", "truth"),
    [
        (FILES[0], lambda b: b.replace(b"slanted", b"slanter"), "line 2 differs"),
        (FILES[0], lambda b: b.replace(b"A ray meets a can.", b"A ray meets a cat.", 1), "line 1"),
        (FILES[0], lambda b: b[:-1], "has 1 lines, 2 are computed"),
        (FILES[1], lambda b: b + b, "has 2 lines, 1 are computed"),
        (FILES[2], lambda b: b"", "has 0 lines, 2 are computed"),
        (FILES[3], lambda b: b"\r\n".join(b.split(b"\n")), "line 1 differs"),
        (MANIFEST, lambda b: b.replace(b"2026", b"2027"), "line 3 differs"),
        (MANIFEST, lambda b: b + b"\n", "lines"),
    ],
)
def test_an_altered_byte_is_drift(
    tmp_path: Path, name: str, change: Callable[[bytes], bytes], truth: str
) -> None:
    write(tmp_path, FAMILIES, quiet)
    spoil(tmp_path, name, change)
    found = drifts(tmp_path)
    assert found
    assert all(drift.startswith(f"{name}: ") for drift in found)
    assert any(truth in drift for drift in found)


def test_a_missing_and_a_stale_file_are_drift(tmp_path: Path) -> None:
    write(tmp_path, FAMILIES, quiet)
    (tmp_path / FILES[1]).rename(tmp_path / "binary64" / "three.jsonl")
    assert drifts(tmp_path) == [
        f"{FILES[1]}: is missing",
        "binary64/three.jsonl: is of no family",
    ]
    (tmp_path / MANIFEST).unlink()
    assert f"{MANIFEST}: is missing" in drifts(tmp_path)
    write(tmp_path, FAMILIES, quiet)
    assert drifts(tmp_path) == []
    assert not (tmp_path / "binary64" / "three.jsonl").exists()


def test_an_empty_folder_is_all_drift(tmp_path: Path) -> None:
    assert drifts(tmp_path) == [f"{name}: is missing" for name in [*FILES, MANIFEST]]


def test_a_contradiction_touches_no_file(tmp_path: Path) -> None:
    """All rows are made before the first file is written."""
    write(tmp_path, FAMILIES, quiet)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
    bad = (family("one", case("across", ACROSS, ((0, 1),))), TWO)
    with pytest.raises(Contradiction):
        write(tmp_path, (TWO, *bad), quiet)
    assert {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()} == before


def test_a_failure_while_writing_leaves_no_half_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, FAMILIES, quiet)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}

    def fail(*_: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(OSError, match="disk full"):
        write(tmp_path, (TWO,), quiet)
    assert {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()} == before


@pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)
def test_in_the_golden_files_every_expected_list_is_accepted(fmt: Format) -> None:
    """And the empty list is refused wherever inner is not empty: the files alone tell."""
    for row in golden(fmt.name).rows:
        for accept in row.accept.values():
            assert accept.fault(row.expected) is None, row.id
            assert (accept.fault([]) is None) == (not accept.inner), row.id
            assert len(accept.most) == len(accept.outer)
