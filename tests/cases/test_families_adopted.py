"""Adopted cases as data: what is written is read, what is no case is refused by file and line."""

import json
from pathlib import Path
from typing import Any

import pytest

from raycert.cases.case import Case
from raycert.cases.families import adopted
from raycert.cases.families.adopted import Adopted, Retired, encode, families, read
from raycert.cases.families.catalog import FAMILIES
from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Cylinder, Ray

SOLID = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 0.1)
RAY = Ray((-3.0, 0.0, 1.0), (1.0, -0.0, 0.0))
CASE = Case("a-slug", "A ray crosses.", SOLID, RAY, "generic", ("tangent",))
ENTRIES = (Adopted(CASE, ("binary64",)), Retired("an-old-one", "The case was another one's."))


def kept(folder: Path, **changed: Any) -> Path:
    """Write a file whose second line is changed."""
    form = adopted.write_entry(ENTRIES[0]) | {"slug": "second"} | changed
    path = folder / "found.jsonl"
    path.write_bytes(encode(ENTRIES[:1]) + json.dumps(form).encode() + b"\n")
    return path


def test_what_is_written_is_read(tmp_path: Path) -> None:
    path = tmp_path / "found.jsonl"
    path.write_bytes(encode(ENTRIES))
    assert read(path) == ENTRIES
    assert encode(read(path)) == path.read_bytes()
    direction = read(path)[0].case.ray.direction  # type: ignore[union-attr]
    assert str(direction[1]) == "-0.0"


def test_a_family_asks_in_its_precisions_and_not_what_is_retired(tmp_path: Path) -> None:
    (tmp_path / "found.jsonl").write_bytes(encode(ENTRIES))
    [family] = families(tmp_path)
    assert family.name == "found"
    assert list(family.cases(BINARY64)) == [CASE]
    assert list(family.cases(BINARY32)) == []


def test_no_folder_and_an_empty_one_have_no_families(tmp_path: Path) -> None:
    assert families(tmp_path) == families(tmp_path / "none") == ()
    assert read(tmp_path / "none.jsonl") == ()


def test_the_catalogue_ends_with_the_adopted_ones() -> None:
    own = [family.name for family in adopted.FAMILIES]
    assert own == [path.stem for path in sorted(adopted.FOLDER.glob("*.jsonl"))]
    assert [family.name for family in FAMILIES][len(FAMILIES) - len(own) :] == own


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"slug": "a-slug"}, "occurs twice"),
        ({"slug": ""}, "case.slug"),
        ({"why": 3}, "case.why"),
        ({"tier": "hard"}, "case.tier"),
        ({"flags": "tangent"}, "case.flags"),
        ({"precisions": []}, "case.precisions"),
        ({"precisions": ["binary16"]}, "binary16"),
        ({"precisions": ["binary64", "binary32"]}, "is not a binary32 number"),
        ({"ray": {"origin": ["0x1p0"] * 3}}, "ray.direction"),
        ({"answer": []}, "has not the fields"),
    ],
)
def test_what_is_no_case_is_refused(changed: dict[str, Any], words: str, tmp_path: Path) -> None:
    path = kept(tmp_path, **changed)
    with pytest.raises(match=words) as caught:
        read(path)
    assert "found.jsonl:2:" in str(caught.value)
