"""A gradebook's file: what it means, what is refused in it, and when a target has changed."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.files import BadFile
from raycert.oracle.certify.entrants import Entrant, entrants_each, read_entrants
from raycert.oracle.client.dialogue import Limits

FILE = """
level = "stable"
case_timeout = 20
hello = { tolerance = 1e-6, degenerate = ["zero_direction"] }

[targets.mine]
words = "python3 'my tracer.py' --fast"
title = "mine"
level = "exact"
hello = { tolerance = 0, domain = { distance = 1e6 } }

[targets.class]
each = "submissions/*/tracer.py:intersect"
convention = "regularized"
line_limit = 4096
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("bea", "M\u00fcller, Anna"):
        (tmp_path / "submissions" / name).mkdir(parents=True)
        (tmp_path / "submissions" / name / "tracer.py").write_text(f"# {name}")
    return tmp_path


def read(folder: Path, text: str, **over: object) -> list[Entrant]:
    (folder / "class.toml").write_text(text)
    return read_entrants(folder / "class.toml", over)


def test_what_stands_at_the_top_is_for_all_and_each_may_say_otherwise(folder: Path) -> None:
    mine, anna, bea = read(folder, FILE)
    assert mine == Entrant(
        "mine",
        ("python3", "my tracer.py", "--fast"),
        folder,
        "mine",
        "exact",
        "closed",
        {"tolerance": 0, "degenerate": ["zero_direction"], "domain": {"distance": 1e6}},
        Limits(case=20),
    )
    assert (anna.name, bea.name) == ("M\u00fcller, Anna", "bea")
    assert bea.words == ("submissions/bea/tracer.py:intersect",)
    assert (bea.level, bea.convention, bea.limits) == (
        "stable", "regularized", Limits(case=20, line=4096),
    )  # fmt: skip


def test_what_the_command_line_says_holds_for_all(folder: Path) -> None:
    over = {"level": "faithful", "case_timeout": 1}
    assert {(e.level, e.limits.case) for e in read(folder, FILE, **over)} == {("faithful", 1)}


@pytest.mark.parametrize(
    ("pattern", "words", "names", "first"),
    [
        ("*/bea/*.py:f", None, ["submissions/bea/tracer"], ("submissions/bea/tracer.py:f",)),
        ("submissions/**/*.py", "python3 {} {}", ["M\u00fcller, Anna/tracer", "bea/tracer"],
         ("python3", *["submissions/M\u00fcller, Anna/tracer.py"] * 2)),
        ("submissions/b?a/tracer.py", "./run {}", ["e"], ("./run", "submissions/bea/tracer.py")),
        ("*.so", None, ["x"], ("./x.so",)),
    ],
)  # fmt: skip
def test_a_target_for_each_file_called_as_the_wildcards(
    pattern: str, words: str | None, names: list[str], first: tuple[str, ...], folder: Path
) -> None:
    (folder / "x.so").touch()
    (folder / "folder.so").mkdir()
    found = entrants_each([pattern], words, {}, folder)
    assert [entrant.name for entrant in found] == names
    assert found[0].words == first


BAD = [
    ("targets.a", "x = 1", "targets.a.x is not a key; keys: words, each"),
    ("targets.a", "wrods = 'x'", "targets.a.wrods is not a key; did you mean words?"),
    ("target.a", "words = 'x'", "target is not a key; did you mean targets?"),
    ("targets.a", "", "targets.a.words is missing"),
    ("targets.a", "words = []", "targets.a.words is not a text or a list of words"),
    ("targets.a", "words = \"it's\"", "targets.a.words No closing quotation"),
    ("targets.a", "words = 'x'\nlevel = 'stabel'", "level is no level: 'stabel'; did you mean"),
    ("targets.a", "words = 'x'\nconvention = 'open'", "targets.a.convention is not "),
    ("targets.a", "words = 'x'\nhello = 3", "targets.a.hello is not a table"),
    ("targets.a", "words = 'x'\nhello.solid = []", "a.hello.solid is not a key; did you mean"),
    ("targets.a", "words = 'x'\nhello.domain.size = 3", "targets.a.hello.domain.size is not [low"),
    ("targets.a", "words = 'x'\ncase_timeout = true", "case_timeout is not a number: True"),
    ("targets.a", "words = 'x'\ncase_timeout = 0", "case_timeout is not within 0.01 and 86400: 0"),
    ("targets.a", "words = 'x'\nline_limit = 1e4", "line_limit is not a number: 10000.0"),
    ("targets.a", "words = 'x'\ntitle = 3", "targets.a.title is not a text: 3"),
    ("targets.a", "each = 'none*'", "targets.a.each matches no file in"),
    ("targets.a", "each = 'submissions'", "targets.a.each has no wildcard: 'submissions'"),
    ("targets.a", "each = 's*/b*/tracer.py'", "cannot be run by itself: write s*/b*"),
    ("targets.a", "each = 's*/*/*.py:f'\n[targets.b]\neach = 's*/*/*.py:g'", "target of"),
    ("targets.a", "words = 'x'\n[targets.A]\nwords = 'x'", "targets.A 'A' is a target"),
    ("targets.a", "words", "is not TOML: "),
    ("targets", "a = 1", "targets.a is not a table: write [targets.NAME]"),
    ("targets", "", "targets is missing: write [targets.NAME]"),
]  # fmt: skip


@pytest.mark.parametrize(("head", "table", "says"), BAD)
def test_what_is_refused_is_named_by_file_and_key(
    head: str, table: str, says: str, folder: Path
) -> None:
    with pytest.raises(BadFile) as error:
        read(folder, f"[{head}]\n{table}")
    assert str(error.value).startswith(f"{folder / 'class.toml'}: ")
    assert says in str(error.value)


def test_a_target_has_changed_where_it_or_what_is_asked_of_it_has(folder: Path) -> None:
    text = '[targets.x]\nwords = "python3 a.py"\n[targets.y]\nwords = "b:f"\n'
    for name in "abc":
        (folder / f"{name}.py").write_text(name)

    def prints(text: str = text, *context: object) -> tuple[str, str]:
        found = read(folder, text)
        own = {path for entrant in found for path in entrant.files()}
        x, y = (entrant.fingerprint(own, *context) for entrant in found)
        return x, y

    def differ(before: tuple[str, str]) -> tuple[bool, bool]:
        return prints()[0] != before[0], prints()[1] != before[1]

    before = prints()
    assert differ(before) == (False, False)
    for name, changed in (("a", (True, False)), ("b", (False, True)), ("c", (True, True))):
        before = prints()
        (folder / f"{name}.py").write_text("other")
        assert differ(before) == changed
    before = prints()
    assert prints(text.replace("a.py", "a.py -v"))[0] != before[0]
    assert prints(f"level = 'exact'\n{text}")[0] != before[0]
    assert prints(f"hello.version = '2'\n{text}")[0] != before[0]
    assert prints(f"case_timeout = 1\n{text}")[0] != before[0]
    assert prints(text, "corpus")[0] != before[0]
    assert prints(text.replace("[targets.y]", "title = 'X'\n[targets.y]")) == before


@given(st.text(min_size=1), st.text(min_size=1))
def test_each_name_has_a_folder_of_its_own(one: str, other: str) -> None:
    here, there = (Entrant(name, ("x",), Path()).place for name in (one, other))
    assert (here == there) == (one == other)
    assert Path(here).name == here
    assert here not in (".", "..", "")
    assert here.isascii()
    assert len(here) < 80
