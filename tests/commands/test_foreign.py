"""Text of others, one hostile string in every place it may come from: shown, and never obeyed."""

import json
import re
import shutil
import sys
import xml.etree.ElementTree as ElementTree
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st

import shared.certificates as made_up
from raycert.cases.corpus import GOLDEN, MANIFEST
from raycert.oracle.commands.main import main
from raycert.oracle.reports.foreign import clean, code, escaped, line, plain
from raycert.oracle.reports.page import WRITERS
from raycert.oracle.reports.reading import check
from raycert.oracle.reports.screen import screen
from raycert.oracle.reports.terminal import report

HOSTILE = "\x1b]0;own\x07 \x9b2J \x00 \u202e <script>x</script> [red] | `a` ``b \udc80 \ufffe"
FORBIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufffe]")
ROW = "behind/across-just-past"

CLIENT = f"""
import json, sys
text = {HOSTILE!r}
for line in sys.stdin:
    asked = json.loads(line)
    if "hello" in asked:
        print(json.dumps({{"hello": 1, "name": text, "version": text}}), flush=True)
        continue
    sys.stderr.buffer.write(text.encode("utf-8", "surrogatepass") + b"\\xff\\x1b[31m")
    sys.stderr.flush()
    MODE
"""
MODES = {
    "error": 'print(json.dumps({"id": asked["id"], "error": text}), flush=True)',
    "junk": "print(ascii(text) + chr(27), flush=True)",
    "crash": "sys.exit(3)",
}
MODULE = f"""
def answer(solid, ray):
    raise ValueError({HOSTILE!r})
"""


def unsafe(text: str) -> list[str]:
    return FORBIDDEN.findall(text)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    for name, how in MODES.items():
        (tmp_path / f"{name}.py").write_text(CLIENT.replace("MODE", how))
    (tmp_path / "hostile_answers.py").write_text(MODULE)
    (tmp_path / "hostile_import.py").write_text(f"raise ImportError({HOSTILE!r})")
    return tmp_path


def say(*words: str) -> str:
    """Return what a command prints, on both ways, as it would reach the terminal."""
    result = CliRunner().invoke(main, words)
    assert result.exception is None or isinstance(result.exception, SystemExit), words
    assert result.exit_code in (0, 1, 2, 3, 4)
    assert unsafe(result.output) == [], words
    return result.output


def without_code(markdown: str) -> str:
    return re.sub(r"(?<!`)(`+)(?!`)(.*?)(?<!`)\1(?!`)", "", markdown)


def check_reports(markdown: str, junit: str, page: str) -> None:
    for text in (markdown, junit, page):
        assert unsafe(text) == []
    assert "<script" not in without_code(markdown)
    assert "<script" not in page
    assert ElementTree.fromstring(junit).tag == "testsuites"
    for row in markdown.splitlines():
        if row.startswith("|"):
            assert len(re.findall(r"(?<!\\)\|", row)) == 7, row


@pytest.mark.parametrize("mode", MODES)
def test_a_client_cannot_write_to_what_certify_prints_and_writes(mode: str, here: Path) -> None:
    names = {"html": "x.html", "markdown": "x.md", "junit": "x.xml"}
    reports = [f"--{form}={name}" for form, name in names.items()]
    client = ("--", sys.executable, f"{mode}.py")
    text = say("certify", "--id", ROW, *reports, *client)
    assert "[red]" in text
    assert r"\u202e" in text
    if mode == "error":  # the others end at the first row, with what they said
        check_reports(*((here / name).read_text("utf-8") for name in ("x.md", "x.xml", "x.html")))
        say("report", "certificate.json")


def test_neither_can_a_function_nor_a_module(here: Path) -> None:
    ray = ("--sphere", "0,0,0", "1", "--ray=-3,0,0", "1,0,0")
    target = "hostile_answers:answer"
    assert "[red]" in say("certify", "--id", ROW, target)
    assert "[red]" in say("certify", "--id", ROW, "hostile_import:answer")
    say("explain", *ray, "--html", "x.html", "--target", target)
    assert unsafe((here / "x.html").read_text("utf-8")) == []
    axes = ("--x", "ray.origin[1]", "--y", "solid.radius", "--cells", "2")
    say("map", *ray, *axes, "--target", target, "--out", "x.csv", "--out", "x.svg")
    assert unsafe((here / "x.csv").read_text("utf-8")) == []
    ElementTree.fromstring((here / "x.svg").read_text("utf-8"))
    text = say("hunt", target, "--cases", "3", "--most", "1", "--no-golden", "--out", "found")
    assert "fails" in text
    say("list", "--golden", "found")
    (found,) = (here / "found").glob("hunt*.json")
    ids = [row["id"] for row in json.loads(found.read_text())["findings"]]
    say("show", "--golden", "found", ids[0])


def test_neither_can_the_name_of_a_file_or_of_a_corpus(here: Path) -> None:
    name = HOSTILE.replace("\x00", "").replace("/", "").replace("\ufffe", "")
    (here / name).write_text("{")
    for words in (
        ("report", name),
        ("report", f"{name}.none"),
        ("certify", "--expect", name, "oracle"),
        ("list", "--golden", name),
        ("explain", name),
        ("adopt", name, "--family", "f", "--why", "w", "--corpus", "c"),
        ("render", name),
        ("certify", "--out", f"{name}/x", "oracle"),
        (name,),
        ("list", f"--{name}"),
    ):
        assert say(*words)
    (here / "golden" / "binary64").mkdir(parents=True)
    kept = "binary64/behind.jsonl"
    shutil.copy(GOLDEN / kept, here / "golden" / kept)
    form = json.loads((GOLDEN / MANIFEST).read_text())
    form["files"], form["corpus"] = {kept: form["files"][kept]}, HOSTILE
    (here / "golden" / MANIFEST).write_text(json.dumps(form))
    for verb in (("list",), ("show", ROW), ("export",), ("explain", ROW)):
        assert "2026.1" in say(*verb, "--golden", "golden")  # it is refused, and shown


SAID = {"name", "version", "command", "why", "reproduce", "reasons", "notes", "diagnosis", "faults"}
SAID |= {"reply", "error", "system", "python", "implementation", "note", "exit", "stderr"}
"""The fields of a certificate that hold words of others, as texts or lists or tables of texts."""


def planted(form: Any, words: bool = False) -> Any:
    """Return a form with the string in each text that others wrote."""
    if isinstance(form, dict):
        said = {key: planted(value, words or key in SAID) for key, value in form.items()}
        return said | {key: form[key] for key in ("tool", "standing") if key in form}
    if isinstance(form, list):
        return [planted(item, words) for item in form]
    return HOSTILE if words and isinstance(form, str) else form


def test_neither_can_any_text_of_a_certificate() -> None:
    form = check(planted(made_up.bad()))
    assert json.dumps(form).count(json.dumps(HOSTILE)) > 20
    check_reports(*(WRITERS[name](form) for name in ("markdown", "junit", "html")))
    stream = StringIO()
    report(form, screen(file=stream, width=120))
    assert unsafe(stream.getvalue()) == []
    assert "[red]" in stream.getvalue()


def test_a_screen_shows_its_own_styles_and_nothing_else() -> None:
    stream = StringIO()
    screen(file=stream, force_terminal=True, color_system="standard").print(HOSTILE, style="bold")
    shown = stream.getvalue()
    assert re.findall("\x1b[^m]*m", shown) == re.findall("\x1b.{2,3}?m", shown)
    assert unsafe(re.sub("\x1b\\[[0-9;]*m", "", shown)) == []
    assert r"\x1b]0;own \x9b2J \x00 \u202e <script>" in re.sub("\x1b\\[[0-9;]*m", "", shown)


@given(st.text(st.characters(codec=None), max_size=40))
def test_what_is_shown_is_safe_whatever_it_was(text: str) -> None:
    for shown in (escaped(text), line(text), clean(text, 20), plain(text), code(text)):
        assert unsafe(shown) == []
        shown.encode("utf-8")
    for shown in (line(text), clean(text, 20), plain(text), code(text)):
        assert "\n" not in shown
        ElementTree.fromstring(f"<x>{shown.replace('&', '&amp;').replace('<', '&lt;')}</x>")
    assert len(clean(text, 20)) <= 20
    assert escaped(escaped(text)) == escaped(text)
    assert not re.search(r"(?<!\\)(?:\\\\)*[`|*\[]", plain(text)) or "<" in plain(text)
    assert "<" not in plain(text)
    assert without_code(code(text)) == ""


@pytest.mark.parametrize("most", range(8, 40))
def test_a_number_is_never_cut_in_the_middle(most: int) -> None:
    """What is left of a text has whole numbers, and other words as far as they go."""
    text = "leave 1.25, not 2.4691357802469134e+17 or -0x1.8p-12 or 7"
    shown = clean(text, most)
    assert len(shown) <= most
    assert set(re.findall(r"-?[0-9][^ ,\u2026]*", shown)) <= {"1.25", "2.4691357802469134e+17"} | {
        "-0x1.8p-12"
    }
    assert clean("x1" * 40, 11) == "x1" * 5 + "\u2026"
