"""Files that somebody gives: spoiled in any way, each means something or is refused by name."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from io import StringIO
from pathlib import Path
from time import process_time
from typing import Any

import pytest
from click.testing import CliRunner, Result
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rich.console import Console

import shared.certificates as made_up
from raycert.cases import files
from raycert.cases.case import Case
from raycert.cases.corpus import MANIFEST, decode_rows, encode_rows, manifest, read_corpus
from raycert.cases.families import adopted
from raycert.cases.files import DEEPEST, BadFile, decode_json, read_as, read_file, read_text
from raycert.cases.formats import BINARY64
from raycert.cases.forms import read_ray, read_solid
from raycert.cases.scene import SHIPPED, load, read_scene
from raycert.oracle.certify import known
from raycert.oracle.commands.main import main
from raycert.oracle.reports.page import WRITERS
from raycert.oracle.reports.reading import check
from raycert.oracle.reports.terminal import report
from shared.rows import CAN, RAYS, WRONG, made, parent, paths

ROW = made(CAN, RAYS["irrational"])
TOML = b"""[[expect]]
id = "far-deep/across-1e9"
level = "stable"
reason = "cancellation"
link = "https://example.org/12"
"""
BOM = b"\xef\xbb\xbf"
DEEP = b"[" * 600 + b"]" * 600
JUNK = (b"\0", BOM, b"\\ud800", b"\\u0000", "\uff11".encode(), b"_", b" ", b"1e999", b"NaN",
        b"\xff", b'"', b"{", b"9" * 5000, DEEP, b"\r", b"\x1b[31m", b"-")  # fmt: skip
VALUES = (*WRONG, 10**400, float("inf"), float("nan"), "\ud800", "a\0b", json.loads(DEEP[1:-1]))


@dataclass(frozen=True)
class Kind:
    """A kind of file: one that is valid, and what reads it and does with it what commands do."""

    valid: Callable[[], bytes]
    use: Callable[[Path], object]


def _case(form: Any) -> object:
    assert isinstance(form, dict)
    return read_solid(form.get("solid")), read_ray(form.get("ray"))


def _entry() -> bytes:
    case = Case("slug", "A ray meets a solid.", CAN, RAYS["irrational"], "generic")
    return adopted.encode([adopted.Adopted(case, ("binary64",))])


@cache
def _certificate() -> bytes:
    form = dict(made_up.attacked())
    form["failures"], form["families"] = form["failures"][:9], form["families"][:3]
    form["worst"] = form["worst"][:2]
    return json.dumps(form, indent=1).encode()


def _reports(path: Path) -> object:
    form = read_as(path, read_file(path), check)
    report(form, Console(file=StringIO()))
    return [write(form) for write in WRITERS.values()]


KINDS = {
    "row": Kind(
        lambda: encode_rows([ROW], BINARY64),
        lambda path: list(decode_rows(read_file(path), BINARY64, str(path))),
    ),
    "adopted": Kind(_entry, adopted.read),
    "expectations": Kind(lambda: TOML, lambda path: known.read(read_text(path), str(path))),
    "scene": Kind((SHIPPED / "die.json").read_bytes, lambda path: load(str(path))),
    "certificate": Kind(_certificate, _reports),
}


def lines_changed(data: bytes, where: int, twice: bool) -> bytes:
    lines = data.splitlines(keepends=True)
    where %= len(lines)
    return b"".join([*lines[:where], *[lines[where]] * 2 * twice, *lines[where + 1 :]])


def swapped(data: bytes, where: int, value: Any) -> bytes:
    """Put a value in the place of another of a JSON form, or what JSON has no words for in TOML."""
    if data == TOML:
        return data.replace(b'"stable"', json.dumps(value).encode())
    form = json.loads(data)
    ways = list(paths(form))
    way = ways[where % len(ways)]
    parent(form, way)[way[-1]] = value
    return json.dumps(form).encode()


WHERE = st.integers(0, 10**6)
SPOILS = st.one_of(
    st.builds(lambda i, c: lambda d: d[: i % len(d)] + bytes([c]) + d[i % len(d) + 1 :],
              WHERE, st.integers(0, 255)),
    st.builds(lambda i, junk: lambda d: d[: i % len(d)] + junk + d[i % len(d) :],
              WHERE, st.sampled_from(JUNK)),
    st.builds(lambda i: lambda d: d[: i % len(d)], WHERE),
    st.builds(lambda i, twice: lambda d: lines_changed(d, i, twice), WHERE, st.booleans()),
    st.builds(lambda i, value: lambda d: swapped(d, i, value), WHERE, st.sampled_from(VALUES)),
)  # fmt: skip
QUICK = settings(
    deadline=None, max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.mark.parametrize("name", KINDS)
@QUICK
@given(spoil=SPOILS)
def test_a_spoiled_file_is_refused_by_its_name_or_means_something(
    name: str, spoil: Callable[[bytes], bytes], tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(spoil(KINDS[name].valid()))
    try:
        KINDS[name].use(path)
    except BadFile as error:
        assert str(error).startswith(str(path))  # noqa: PT017
        assert str(error).isprintable()  # noqa: PT017


@QUICK
@given(spoil=SPOILS, which=st.sampled_from(["binary64/hand.jsonl", MANIFEST]))
def test_a_spoiled_corpus_is_refused_or_the_same(
    spoil: Callable[[bytes], bytes], which: str, tmp_path: Path
) -> None:
    data = encode_rows([ROW], BINARY64)
    whole = {"binary64/hand.jsonl": data, MANIFEST: manifest({"binary64/hand.jsonl": data})}
    (tmp_path / "binary64").mkdir(exist_ok=True)
    for name, right in whole.items():
        (tmp_path / name).write_bytes(spoil(right) if name == which else right)
    try:
        found = read_corpus("binary64", tmp_path).rows
    except BadFile as error:
        assert str(error).startswith(str(tmp_path))  # noqa: PT017
    else:
        assert found in ((), (ROW,))  # a manifest without files is one too


def run(*words: object) -> Result:
    return CliRunner().invoke(main, [str(word) for word in words])


def corpus(folder: Path, data: bytes) -> Path:
    """Return the golden file of a corpus that has only it, with a manifest that is right."""
    path = folder / "binary64" / "hand.jsonl"
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(data)
    (folder / MANIFEST).write_bytes(manifest({"binary64/hand.jsonl": data}))
    return path


LINE = encode_rows([ROW], BINARY64)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (b'"id":"hand/slug"', b'"id":"hand/\\u0000"', "do not print"),
        (b"A ray meets", b"A \\ud800 ray", "do not print"),
        (b"A ray meets", "A r\u00e4y".encode(), "is not spelled as a row is written"),
        (b"A ray meets", b"A r\xffy", "0xff"),
        (b'"id":"hand/slug"', b'"id":"other/slug"', "is of another family"),
        (b'"id":"hand/slug"', b'"id":"hand/Slug"', "row.id: is not FAMILY/SLUG"),
        (b'"touch":null', b'"touch":"kiss"', r"touch: is not one of null, tangent, .*'kiss'"),
        (b'"kind":"crossing"', b'"kind":"x"', "kind: is not one of crossing"),
        (b'"decisive":["', b'"decisive":["best","', "decisive: is not one of sound"),
        (b'["4","-24","33"]', b'["4","-2_4","33"]', "row.intervals: is not as a row is written"),
        (b'["4","-24","33"]', '["4","-2\uff14","33"]'.encode(), "row.intervals: is not as"),
        (b'["4","-24","33"]', b'["4","-24 ","33"]', "row.intervals: is not as a row is written"),
        (b'["4","-24","33"]', b'["4","-' + b"9" * 5000 + b'","33"]', "digits"),
        (b'["4","-24","33"]', b'["4","-24"]', "polynomial of degree 2"),
        (b'"tier":"generic"', b'"tier":"generic","tier":"generic"', "is not spelled as a row"),
        (b'"rows":', b'"rows": ', "is not spelled as a row is written"),
        (b'"root":0', b'"root":1e999', "root: is not a int"),
        (b'"root":0', b'"root":NaN', "root: is not a int"),
        (b'"why":', b'"whence":' + DEEP + b',"why":', "is not as a row is written"),
    ],
)
def test_a_row_that_is_none_is_refused_by_file_and_line(
    old: bytes, new: bytes, words: str, tmp_path: Path
) -> None:
    assert LINE.count(old) >= 1
    path = corpus(tmp_path, LINE.replace(old, new, 1))
    result = run("list", "--golden", tmp_path)
    assert result.exit_code == 2, result.output
    assert re.search(f"{path}(:1)?: .*{words}", result.stderr), result.stderr


def test_an_empty_line_and_a_line_cut_short_are_refused_by_their_numbers(tmp_path: Path) -> None:
    for data, number in ((LINE + b"\n", 2), (b"\n" + LINE, 1), (LINE + LINE[:-9], 2)):
        path = corpus(tmp_path, data)
        assert f"{path}:{number}: " in run("list", "--golden", tmp_path).stderr


@pytest.mark.parametrize("name", ["binary64/hand.jsonl", MANIFEST])
def test_only_a_regular_file_is_part_of_a_corpus(name: str, tmp_path: Path) -> None:
    """A FIFO is no file to wait for, and a directory none to read."""
    corpus(tmp_path, LINE)
    for make in (os.mkfifo, os.mkdir):
        (tmp_path / name).unlink()
        make(tmp_path / name)
        result = run("list", "--golden", tmp_path)
        assert result.exit_code == 2
        assert f"{tmp_path / name}: is not a regular file" in result.stderr


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"binary64/hand.jsonl": {"rows": 2}}, "has 1 rows, the manifest says 2"),
        ({"binary64/hand.jsonl": {"rows": True}}, "the manifest says True"),
        ({"binary64/hand.jsonl": {"sha256": 7}}, "SHA-256 differs"),
        ({"binary64/hand.jsonl": {"colour": 7}}, "colour: is not a field here"),
        ({"binary64/hand.jsonl": None}, "is not an object"),
        ({"../hand.jsonl": {}}, "is not PRECISION/FAMILY.jsonl"),
        ({"/dev/zero": {}}, "is not PRECISION/FAMILY.jsonl"),
    ],
)
def test_a_manifest_says_what_is_there(changes: dict[str, Any], words: str, tmp_path: Path) -> None:
    corpus(tmp_path, LINE)
    form = json.loads((tmp_path / MANIFEST).read_bytes())
    for name, change in changes.items():
        entry = form["files"].get(name, {})
        form["files"][name] = change if change is None else entry | change
    (tmp_path / MANIFEST).write_text(json.dumps(form))
    result = run("list", "--golden", tmp_path)
    assert result.exit_code == 2
    assert words in result.stderr


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (BOM + b"{}", "byte order mark"),
        ("{}".encode("utf-16"), "is not UTF-8"),
        (b"{\n\n\xff}", "byte 0xff in line 3"),
        (b'{"solid": 1, "solid": 2}', "the key 'solid' occurs twice"),
        (b"[" * 100_000, f"nested more than {DEEPEST} deep"),
        (b'{"solid": ' + DEEP + b"}", f"nested more than {DEEPEST} deep"),
        (b'{"solid": ' + b"9" * 5000 + b"}", "an integer of 5000 digits"),
        (b'{"solid"', "line 1, column 9"),
        (b'{"\\ud800\\u001b": 1}', "is"),
    ],
)
def test_json_that_cannot_be_used_is_refused_by_file_and_place(
    data: bytes, words: str, tmp_path: Path
) -> None:
    path = tmp_path / "x.json"
    path.write_bytes(data)
    for verb in (("render",), ("report",), ("explain", "--case")):
        result = run(*verb, path)
        assert result.exit_code == 2, result.output
        name = "--case" if verb[0] == "explain" else str(path)
        assert name in result.stderr
        assert words in result.stderr
        assert result.stderr.replace("\n", "").isprintable()


def test_a_file_may_be_so_large_and_is_readable(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = corpus(tmp_path, LINE)
    with monkeypatch.context() as changed:
        changed.setattr(files, "MOST", len(LINE) - 1)
        with pytest.raises(BadFile, match=r"hand\.jsonl: has more than"):
            read_corpus("binary64", tmp_path)
        changed.setattr(files, "MOST", len(LINE))
        assert read_file(path) == LINE

    def refuse(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(BadFile, match=r"manifest\.json: Permission denied"):
        read_corpus("binary64", tmp_path)


@pytest.mark.parametrize("power", ["+1024", "+9999", "-99999"])
def test_a_real_of_a_certificate_is_a_binary64(power: str, tmp_path: Path) -> None:
    """Beyond it, `float.fromhex` has no number, and a report had a traceback."""
    path, form = tmp_path / "x.json", json.loads(_certificate())
    form["failures"][0]["expected"] = [["0x1.0000000000000p+0", f"0x1.0000000000000p{power}"]]
    path.write_text(json.dumps(form))
    result = run("report", path)
    assert result.exit_code == 2, result.output
    assert "certificate.failures[0].expected[0][1]" in result.stderr


def test_many_names_take_no_longer_each() -> None:
    """Of a million solids or keys none is compared with all the others."""
    ball = {"type": "sphere", "center": [0, 0, 0], "radius": 1}
    form = {"solids": [{"name": str(n), "solid": ball} for n in range(20_000)]}
    camera = {"type": "orthographic", "eye": [0, -9, 0], "look_at": [0, 0, 0], "up": [0, 0, 1]}
    form |= {"camera": camera | {"height": 2}, "size": [2, 2]}
    began = process_time()
    read_scene(form)
    keys = ",".join(f'"{n}":0' for n in (*range(40_000), 39_999))
    with pytest.raises(ValueError, match="'39999' occurs twice"):
        decode_json(f"{{{keys}}}")
    assert process_time() - began < 2


@pytest.mark.parametrize("words", [("--size", "9" * 5000 + "x9"), ("--pixel", "0," + "9" * 5000)])
def test_pixels_of_thousands_of_digits_are_refused(words: tuple[str, str]) -> None:
    result = run("render", "die", *words)
    assert result.exit_code == 2, result.output
    assert words[0] in result.stderr


@pytest.mark.parametrize("word", ["1_0", "\uff11", " 1", "1e5 ", "1e999", "nan", "0x", ""])
def test_a_number_in_words_is_plain(word: str) -> None:
    result = run("explain", "--sphere", "0,0,0", word, "--ray=-3,0,0", "1,0,0")
    assert result.exit_code == 2, result.output
    assert "solid.radius" in result.stderr
