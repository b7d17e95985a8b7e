"""The corpus on disk: whole, checked against its manifest, described by its schemas."""

from __future__ import annotations

import copy
import hashlib
import json
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from raycert.cases import corpus
from raycert.cases.corpus import (
    FORMAT_VERSION,
    GOLDEN,
    MANIFEST,
    decode_rows,
    encode_rows,
    manifest,
    read_corpus,
    read_manifest,
    write_whole,
)
from raycert.cases.files import BadFile
from raycert.cases.formats import BINARY32, BINARY64, FORMATS, Format
from raycert.cases.model import SOLIDS, types
from raycert.cases.row import GoldenRow, read_row, write_row
from shared.corpus import golden
from shared.rows import CAN, RAYS, WRONG, fresh, made, parent, paths, same_kind

SCHEMAS = Path(corpus.__file__).parent / "schemas"
NAME = "binary64/hand.jsonl"
both = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)


def some_rows(fmt: Format = BINARY64) -> list[GoldenRow]:
    return [replace(made(CAN, ray, fmt), id=f"hand/{name}") for name, ray in RAYS.items()]


def stored(folder: Path, files: dict[str, bytes] | None = None) -> Path:
    """Return a folder with a corpus: of one file of four rows, unless told otherwise."""
    files = {NAME: encode_rows(some_rows(), BINARY64)} if files is None else files
    for name, data in files.items():
        write_whole(folder / name, data)
    write_whole(folder / MANIFEST, manifest(files))
    return folder


def restamp(folder: Path, data: bytes) -> None:
    """Replace the one file, and tell the manifest, so that only its rows can be wrong."""
    stored(folder, {NAME: data})


def test_a_corpus_comes_back_as_it_was(tmp_path: Path) -> None:
    narrow = encode_rows(some_rows(BINARY32), BINARY32)
    wide = encode_rows(some_rows(), BINARY64)
    stored(tmp_path, {NAME: wide, "binary32/hand.jsonl": narrow})
    found = read_corpus("binary64", tmp_path)
    assert list(found.rows) == some_rows()
    assert found.format is BINARY64
    assert found.row("hand/miss") == some_rows()[-1]
    assert found.row("hand/none") is None
    assert found.sha256 == hashlib.sha256((tmp_path / MANIFEST).read_bytes()).hexdigest()
    assert list(read_corpus("binary32", tmp_path).rows) == some_rows(BINARY32)
    assert encode_rows(found.rows, BINARY64) == wide
    assert wide.isascii()
    assert wide.count(b"\n") == len(found.rows)


def test_the_manifest_counts_and_identifies() -> None:
    form = json.loads(manifest({"b": b"1\n2\n", "a": b""}))
    assert list(form["files"]) == ["a", "b"]
    assert form["files"]["b"] == {"rows": 2, "sha256": hashlib.sha256(b"1\n2\n").hexdigest()}
    assert form["format"] == FORMAT_VERSION


def test_an_altered_file_is_refused(tmp_path: Path) -> None:
    path = stored(tmp_path) / NAME
    data = path.read_bytes()
    path.write_bytes(data.replace(b"hand/miss", b"hand/mist"))
    with pytest.raises(BadFile, match=r"hand\.jsonl: SHA-256 differs"):
        read_corpus("binary64", tmp_path)
    path.write_bytes(data[:-1])
    with pytest.raises(BadFile, match="has 3 rows, the manifest says 4"):
        read_corpus("binary64", tmp_path)
    path.write_bytes(data)
    assert len(read_corpus("binary64", tmp_path).rows) == len(RAYS)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    (stored(tmp_path) / NAME).unlink()
    with pytest.raises(BadFile, match=r"hand\.jsonl: No such file"):
        read_corpus("binary64", tmp_path)


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"format": 1}', '{"format": 0, "files": {}}', '{"format": 1, "files": []}'],
)
def test_a_manifest_that_is_none_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(BadFile, match="golden write"):
        read_manifest(tmp_path)
    (tmp_path / MANIFEST).write_text(text)
    with pytest.raises(BadFile, match=MANIFEST):
        read_corpus("binary64", tmp_path)


def test_an_id_occurs_once(tmp_path: Path) -> None:
    row = some_rows()[0]
    restamp(tmp_path, encode_rows([row, row], BINARY64))
    with pytest.raises(BadFile, match=r"hand\.jsonl: the id hand/rational occurs twice"):
        read_corpus("binary64", tmp_path)


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda line: b"", "Expecting value"),
        (lambda line: line[:-9], "delimiter|Unterminated|Expecting"),
        (lambda line: b"\xff" + line, "decode|codec"),
        (lambda line: b"[" * 10_000, "Expecting|recursion"),
        (lambda line: line.replace(b'"why"', b'"whence"'), "row.why: is missing"),
        (lambda line: line.replace(b'"generic"', b'"easy"'), "row.tier"),
        (lambda line: line.replace(b'"cylinder"', b'"cone"'), "solid.type"),
        (lambda line: line.replace(b"-0x1.8", b"-0x1.z"), r"ray\.origin\[0\]"),
    ],
)
def test_a_malformed_line_is_named(
    tmp_path: Path, spoil: Callable[[bytes], bytes], message: str
) -> None:
    lines = encode_rows(some_rows(), BINARY64).split(b"\n")
    lines[0] = spoil(lines[0])
    lines[0], lines[2] = lines[2], lines[0]
    restamp(tmp_path, b"\n".join(lines))
    with pytest.raises(BadFile, match=rf"/binary64/hand\.jsonl:3: .*({message})"):
        read_corpus("binary64", tmp_path)


@pytest.mark.parametrize("solids", [("sphere",), ("slab", "union", "difference"), tuple(SOLIDS)])
def test_rows_that_nobody_needs_are_known_by_their_headings(solids: tuple[str, ...]) -> None:
    whole, some = golden(), read_corpus(solids=solids)
    assert some.rows == tuple(row for row in whole.rows if types(row.solid) <= set(solids))
    assert set(some.headings) == set(whole.headings)
    assert len(some.headings) == len(whole.rows)
    assert some.sha256 == whole.sha256


def test_only_what_is_a_type_counts_as_one(tmp_path: Path) -> None:
    """A text has its quotation marks escaped."""
    row = replace(some_rows()[0], why='Not "type":"sphere", "solid":{"type":"slab"')
    restamp(tmp_path, encode_rows([row, some_rows()[1]], BINARY64))
    assert read_corpus("binary64", tmp_path, ["cylinder"]).rows == (row, some_rows()[1])
    none = read_corpus("binary64", tmp_path, ["sphere", "slab"])
    assert not none.rows
    assert none.headings == tuple((row.id, row.tier, "cylinder") for row in some_rows()[:2])


def test_what_is_not_read_has_a_heading_or_is_refused(tmp_path: Path) -> None:
    lines = encode_rows(some_rows(), BINARY64).split(b"\n")
    for spoiled, message in (
        (lines[0].replace(b'"tier"', b'"tear"'), r":1: row.tier: is missing"),
        (lines[1], "the id hand/[a-z]+ occurs twice"),
        (lines[0].replace(b"hand/", b"foot/"), "of another family"),
    ):
        restamp(tmp_path, b"\n".join([spoiled, *lines[1:]]))
        with pytest.raises(BadFile, match=message):
            read_corpus("binary64", tmp_path, ["sphere"])


def test_a_row_of_another_precision_is_refused() -> None:
    row = replace(some_rows()[0], ray=replace(RAYS["miss"], origin=(0.1, 0, 0)))
    with pytest.raises(BadFile, match=r"x:1: .*binary32"):
        list(decode_rows(encode_rows([row], BINARY64), BINARY32, "x"))


def test_a_file_is_written_whole_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "deep" / "file"
    write_whole(path, b"before")
    assert oct(path.stat().st_mode)[-3:] == "644"

    def fail(*_: object) -> None:
        raise KeyboardInterrupt

    for name in ("open", "replace", "chmod"):
        with monkeypatch.context() as broken:
            broken.setattr(os, name, fail)
            with pytest.raises(KeyboardInterrupt):
                write_whole(path, b"after")
        assert path.read_bytes() == b"before"
        assert [x.name for x in path.parent.iterdir()] == ["file"]
    with pytest.raises(TypeError):
        write_whole(path, "no bytes")  # type: ignore[arg-type]
    assert [x.name for x in path.parent.iterdir()] == ["file"]
    write_whole(path, b"after")
    assert path.read_bytes() == b"after"


@pytest.mark.filterwarnings("ignore::ResourceWarning")  # cut between making a file and `with`
def test_an_interruption_at_any_line_of_the_writing_leaves_no_other_file(tmp_path: Path) -> None:
    path, left = tmp_path / "file", 0

    def trace(frame: FrameType, event: str, _: object) -> Any:
        nonlocal left
        if frame.f_code is not write_whole.__code__:
            return None
        left -= event == "line"
        if left == 0:
            raise KeyboardInterrupt
        return trace

    cuts = 0
    while not path.exists() or path.read_bytes() != b"after":
        path.write_bytes(b"before")
        left = cuts = cuts + 1
        before = sys.gettrace()
        sys.settrace(trace)
        with suppress(KeyboardInterrupt):
            write_whole(path, b"after")
        sys.settrace(before)
        assert path.read_bytes() in (b"before", b"after")
        assert os.listdir(tmp_path) == ["file"]
    assert cuts > 8


# The schemas


def validator(name: str) -> Draft202012Validator:
    schema = json.loads((SCHEMAS / name).read_text())
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


ROW = validator("row.schema.json")


@both
def test_golden_rows_are_what_the_schema_describes(fmt: Format) -> None:
    """Of each family the first rows, the last one, and every eighth."""
    for path in sorted((GOLDEN / fmt.name).glob("*.jsonl")):
        lines = path.read_text().splitlines()
        for line in {*lines[:2], *lines[::8], lines[-1]}:
            error = next(ROW.iter_errors(json.loads(line)), None)
            assert error is None, f"{path.name}: {error.json_path}: {error.message}"


@both
def test_golden_rows_are_read_and_written_alike(fmt: Format) -> None:
    found = golden(fmt.name)
    for path in sorted((GOLDEN / fmt.name).glob("*.jsonl")):
        rows = (row for row in found.rows if row.family == path.stem)
        assert encode_rows(rows, fmt) == path.read_bytes()


def test_the_manifest_is_what_its_schema_describes() -> None:
    check = validator("manifest.schema.json")
    form = read_manifest(GOLDEN)
    assert check.is_valid(form)
    for path in paths(form):
        if isinstance(parent(form, path), dict) and path[:-1] != ("files",):
            short = copy.deepcopy(form)
            del parent(short, path)[path[-1]]
            assert not check.is_valid(short), path
        if len(path) > 2:
            break
    assert not check.is_valid({**form, "files": {"binary64/x": form["files"]}})


def test_a_link_stays_a_link_and_a_mode_stays(tmp_path: Path) -> None:
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("old")
    target.chmod(0o600)
    link.symlink_to(target)
    corpus.write_whole(link, b"new")
    assert link.is_symlink()
    assert target.read_text() == "new"
    corpus.write_whole(target, b"newer")
    assert (target.read_text(), target.stat().st_mode & 0o777) == ("newer", 0o600)


def test_a_pipe_stays_a_pipe(tmp_path: Path) -> None:
    """A certificate written to /dev/null replaced the device once."""
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    reader = os.open(fifo, os.O_RDONLY | os.O_NONBLOCK)
    corpus.write_whole(fifo, b"text")
    assert os.read(reader, 10) == b"text"
    os.close(reader)
    assert fifo.is_fifo()


@pytest.mark.parametrize("name", RAYS)
def test_a_row_without_any_one_of_its_fields_is_not_valid(name: str) -> None:
    whole = fresh(name)
    assert ROW.is_valid(whole)
    for path in paths(whole):
        if isinstance(parent(whole, path), dict):
            short = copy.deepcopy(whole)
            del parent(short, path)[path[-1]]
            assert not ROW.is_valid(short), path


@pytest.mark.parametrize("wrong", WRONG, ids=repr)
def test_a_row_with_a_value_of_another_kind_is_not_valid(wrong: object) -> None:
    """The schema refuses what the reader refuses, but for lists that have to be equally long."""
    whole = fresh()
    for path in paths(whole):
        if same_kind(parent(whole, path)[path[-1]], wrong, path) or path[-1] in {"outer", "most"}:
            continue
        other = copy.deepcopy(whole)
        parent(other, path)[path[-1]] = wrong
        assert not ROW.is_valid(other), path


@pytest.mark.parametrize("where", [(), ("intervals", 0), ("intervals", 0, "enter"), ("accept",)])
def test_a_row_with_an_unknown_field_is_not_valid(where: tuple[Any, ...]) -> None:
    row = fresh()
    parent(row, (*where, ""))["colour"] = "red"
    assert not ROW.is_valid(row)


@pytest.mark.parametrize(
    "change",
    [
        lambda row: row.update(id="Hand/slug"),
        lambda row: row.update(id="slug"),
        lambda row: row.update(why="No full stop"),
        lambda row: row.update(rows=["through", "XY"]),
        lambda row: row["solid"].update(radius="-0x1.0000000000000p+0"),
        lambda row: row["solid"].update(radius=1),
        lambda row: row["intervals"][0].update(touch="kiss"),
        lambda row: row["intervals"][0]["enter"].update(polynomial=["-4", "24", "-33"]),
        lambda row: row["intervals"][0]["enter"].update(fraction="1/2"),
        lambda row: row["intervals"][0]["enter"].update(nearest="-0x1.0000000000000p+0"),
        lambda row: row["intervals"][0]["enter"].update(faces=["cap"]),
        lambda row: row["expected"][0].append("inf"),
        lambda row: row["accept"].update(exact=row["accept"]["sound"]),
    ],
)
def test_a_row_changed_by_hand_is_not_valid(change: Callable[[dict[str, Any]], object]) -> None:
    row = fresh()
    change(row)
    assert not ROW.is_valid(row)


def test_every_part_of_the_schemas_is_described() -> None:
    """The schemas are the documentation of the files: each field says what it is, or refers."""
    for name in ("row.schema.json", "manifest.schema.json"):
        schema = json.loads((SCHEMAS / name).read_text())
        assert schema["description"]
        fields = [p for p in paths(schema) if p[-2:-1] == ("properties",) and "oneOf" not in p]
        assert len(fields) > 4
        for path in fields:
            form = parent(schema, path)[path[-1]]
            assert {"description", "$ref", "const"} & set(form), path


def test_a_tree_is_valid_and_comes_back() -> None:
    tree = {"type": "difference", "of": [fresh()["solid"], fresh()["solid"]]}
    assert ROW.is_valid({**fresh(), "solid": tree})
    assert not ROW.is_valid({**fresh(), "solid": {**tree, "of": []}})
    assert write_row(read_row({**fresh(), "solid": tree}, BINARY64), BINARY64)["solid"] == tree
