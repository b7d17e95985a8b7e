"""Adoption: what is kept is reproduced by `golden`, what is no fit leaves no trace."""

import json
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from threading import Barrier
from typing import Any

import pytest

from raycert.cases.case import Case, Family
from raycert.cases.corpus import MANIFEST, encode_rows, read_corpus, write_whole
from raycert.cases.families.adopted import Retired, encode, families, read
from raycert.cases.families.catalog import FAMILIES
from raycert.cases.files import BadFile
from raycert.cases.formats import BINARY32, BINARY64, Format
from raycert.cases.model import Cylinder, Ray, Sphere, Union
from raycert.oracle.corpus import golden
from raycert.oracle.corpus.adopt import (
    CORPUS,
    Candidate,
    Unfit,
    adopt,
    examine,
    from_row,
    rows_in,
    slug_for,
    sources,
)
from raycert.oracle.corpus.golden import USUAL, Contradiction, compare, golden_row
from raycert.oracle.witness.crosscheck import check
from raycert.oracle.witness.testimony import Testimony

CAN = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 1.0)
FOUND = Candidate(CAN, Ray((-3.0, 0.25, 1.0), (1.0, 0.0, 0.0)), BINARY64, "A ray crosses.")
OTHER = replace(FOUND, ray=Ray((-3.0, 0.1, 1.0), (1.0, 0.0, 0.0)), why="A ray passes by the axis.")


def tree(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_what_is_kept_is_what_golden_writes_and_checks(tmp_path: Path) -> None:
    kept = adopt(tmp_path, "crossed", FOUND)
    again = adopt(tmp_path, "crossed", OTHER)
    assert kept.id.startswith("crossed/")
    assert again.id.startswith("crossed/")
    assert kept.id != again.id
    assert kept.precisions == ("binary64", "binary32")
    assert again.precisions == ("binary64",)
    assert compare(tmp_path / "golden", sources(tmp_path), lambda _: None) == []
    before = tree(tmp_path)
    golden.write(tmp_path / "golden", sources(tmp_path), lambda _: None)
    assert tree(tmp_path) == before
    row = read_corpus("binary64", tmp_path / "golden").row(again.id)
    assert row is not None
    assert (row.solid, row.ray, row.why) == (CAN, OTHER.ray, OTHER.why)
    assert (row.tier, row.source) == ("generic", "oracle")


def test_files_of_other_families_stay_and_stay_in_the_manifest(tmp_path: Path) -> None:
    adopt(tmp_path, "crossed", FOUND)
    before = tree(tmp_path)
    adopt(tmp_path, "others", OTHER)
    after = tree(tmp_path)
    assert {name: after[name] for name in before if MANIFEST not in name} == {
        name: data for name, data in before.items() if MANIFEST not in name
    }
    assert len(read_corpus("binary64", tmp_path / "golden").rows) == 2
    assert compare(tmp_path / "golden", sources(tmp_path), lambda _: None) == []


def test_adoptions_at_once_lose_nothing(tmp_path: Path) -> None:
    start = Barrier(4)

    def keep(number: int) -> str:
        start.wait()
        ray = replace(OTHER.ray, origin=(-3.0, number / 16, 1.1))
        found = replace(OTHER, ray=ray, why=f"A ray passes at {number} sixteenths.")
        return adopt(tmp_path, f"family-{number % 2}", found, f"ray-{number}").id

    with ThreadPoolExecutor(4) as pool:
        ids = set(pool.map(keep, range(8)))
    assert {row.id for row in read_corpus("binary64", tmp_path / "golden").rows} == ids
    assert compare(tmp_path / "golden", sources(tmp_path), lambda _: None) == []


def test_a_checkout_has_the_catalogue_and_what_it_adopted() -> None:
    names = [family.name for family in sources(CORPUS)]
    assert len(set(names)) == len(names)
    assert {family.name for family in FAMILIES} <= set(names)
    assert {family.name for family in families(CORPUS / "adopted")} <= set(names)


def test_an_id_does_not_depend_on_what_came_before(tmp_path: Path) -> None:
    adopt(tmp_path / "one", "crossed", FOUND)
    one = adopt(tmp_path / "one", "crossed", replace(OTHER, flags=("near-tangent",)))
    other = adopt(tmp_path / "two", "crossed", replace(OTHER, flags=("near-tangent",)))
    assert one.id == other.id == "crossed/near-tangent-cylinder"


def test_a_slug_is_not_used_again(tmp_path: Path) -> None:
    entries = (Retired(slug_for(FOUND), "It was wrong."), Retired("mine", "It was wrong."))
    write_whole(tmp_path / "adopted" / "crossed.jsonl", encode(entries))
    with pytest.raises(Unfit, match="no slug is used again"):
        adopt(tmp_path, "crossed", FOUND, "mine")
    kept = adopt(tmp_path, "crossed", FOUND)
    assert kept.id.startswith(f"crossed/{slug_for(FOUND)}-")
    assert len(read(tmp_path / "adopted" / "crossed.jsonl")) == 3


@pytest.mark.parametrize(
    ("changed", "family", "words"),
    [
        ({"why": "a ray crosses."}, "crossed", "--why"),
        ({"why": "A ray crosses"}, "crossed", "--why"),
        ({"why": "A ray crosses.\nTwice."}, "crossed", "--why"),
        ({"why": "A" * 120 + "."}, "crossed", "--why"),
        ({"why": "A ray should cross."}, "crossed", "'should'"),
        ({"source": "construction"}, "crossed", "--source"),
        ({"source": "two\nlines"}, "crossed", "--source"),
        ({"flags": ("odd",)}, "crossed", "--flag"),
        ({"tier": "lattice"}, "crossed", "--tier"),
        ({}, "Crossed", "--family"),
        ({}, "../crossed", "--family"),
        ({}, "reports", "--family: reports is made by the catalogue"),
    ],
)
def test_what_is_no_fit_leaves_no_trace(
    changed: dict[str, Any], family: str, words: str, tmp_path: Path
) -> None:
    with pytest.raises(Unfit, match=words):
        adopt(tmp_path, family, replace(FOUND, **changed))
    assert tree(tmp_path) == {}


def test_a_question_is_not_kept_twice(tmp_path: Path) -> None:
    kept = adopt(tmp_path, "crossed", FOUND)
    before = tree(tmp_path)
    with pytest.raises(Unfit, match=f"{kept.id} asks the same"):
        adopt(tmp_path, "others", replace(FOUND, why="It comes again."))
    with pytest.raises(Unfit, match="--why: another case"):
        adopt(tmp_path, "crossed", replace(OTHER, why=FOUND.why))
    assert tree(tmp_path) == before


def test_altered_golden_files_are_not_blessed(tmp_path: Path) -> None:
    adopt(tmp_path, "crossed", FOUND)
    path = tmp_path / "golden" / "binary64" / "crossed.jsonl"
    path.write_bytes(path.read_bytes().replace(b"crosses", b"cresses"))
    with pytest.raises(BadFile, match="the manifest says"):
        adopt(tmp_path, "others", OTHER)


def test_a_witness_that_disagrees_refuses(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not examine(FOUND, USUAL).disagreed

    def contradicts(*words: Any) -> Any:
        said = Testimony("disagreed", "[[1, 2]]", "another root")
        return replace(check(*words), testimonies=(("definition", said, 0.0),))

    monkeypatch.setattr("raycert.oracle.corpus.adopt.check", contradicts)
    with pytest.raises(Contradiction, match=r"definition finds \[\[1, 2\]\]"):
        examine(FOUND, USUAL)


@pytest.mark.parametrize(
    ("found", "tier"),
    [
        (FOUND, "generic"),
        (replace(FOUND, ray=Ray((-3.0, 0.0, 1.0), (1.0, 0.0, 0.0))), "lattice"),
        (replace(FOUND, ray=Ray((-3.0, 1 - 2**-53, 1.0), (1.0, 0.0, 0.0))), "stiff"),
        (replace(FOUND, ray=Ray((-3.0, 1.0, 1.0), (3.0, 0.0, 0.0))), "stiff"),
        (replace(FOUND, ray=Ray((-3.0, 0.0, 1.0), (2.0**200, 0.0, 0.0))), "range"),
    ],
)
def test_the_tier_is_told_by_the_numbers(found: Candidate, tier: str, tmp_path: Path) -> None:
    adopt(tmp_path, "crossed", found)
    [row] = read_corpus("binary64", tmp_path / "golden").rows
    assert row.tier == tier


def test_a_slug_says_what_a_case_shows() -> None:
    assert slug_for(FOUND) == "through-ae-meet-cylinder"
    assert slug_for(replace(FOUND, flags=("tangent", "rim"))) == "tangent-rim-cylinder"
    both = replace(FOUND, solid=Union((CAN, Sphere((0.0, 0.0, 9.0), 1.0))))
    assert slug_for(both).endswith("union-cylinder-sphere")


def cases(fmt: Format) -> Iterator[Case]:
    yield Case("one", "A ray crosses.", CAN, FOUND.ray, "generic", ("far",), "example/tracer #1")


def test_golden_rows_are_found_with_the_format_of_their_folder(tmp_path: Path) -> None:
    family = Family("found", "", cases)
    for fmt in (BINARY64, BINARY32):
        rows = [golden_row(family, case, fmt) for case in cases(fmt)]
        write_whole(tmp_path / fmt.name / "found.jsonl", encode_rows(rows, fmt))
    found = rows_in(tmp_path, BINARY64)
    assert [fmt.name for _, fmt in found] == ["binary32", "binary64"]
    row, fmt = found[0]
    assert from_row(row, fmt, "It is so.").source == "example/tracer #1"
    (tmp_path / "x.jsonl").write_text(json.dumps({"id": 3}))
    with pytest.raises(BadFile, match=r"x\.jsonl:1"):
        rows_in(tmp_path / "x.jsonl", BINARY64)
