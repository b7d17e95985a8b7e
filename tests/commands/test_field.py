"""`raycert field`: many targets into one table, whatever they do; asked again where it is due."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands import field as verb
from raycert.oracle.commands.field import EXAMPLE
from raycert.oracle.commands.main import main
from shared.certificates import Json
from shared.places import CLIENTS
from shared.processes import gone
from shared.small_corpus import write_small

BAD = {
    "crashes": "none of the easy cases was answered",
    "dies": "gave no hello",
    "silent": "gave no hello",
    "hangs": "none of the easy cases was answered",
    "another": "became another while it was asked",
    "kills": "raycert itself failed on it: BrokenProcessPool",
}
"""Kinds of submission.py, each with why it is not run."""
WRONG = ["always-empty", "diameter", "far-root"]
SUBMISSION = """\
from raycert.oracle.zoo.inhabitants import BY_NAME

intersect = BY_NAME[{name!r}].make()
hello = {{"name": {name!r}, "solids": ["cylinder"]}}
"""
STEADY = """\
from raycert.reference.tracer import intersect
hello = {"name": "steady", "solids": ["cylinder", "slab"]}
"""
CLASS = """\
hello_timeout = 60

[targets.class]
each = "submissions/*.py:intersect"

[targets.no-module]
words = "no_such_module:f"

[targets.nothing]
words = "./no-such-program"
"""


def field(folder: Path, *words: str) -> tuple[Result, Json]:
    """Run the verb; return what it says and its table."""
    options = ("--golden", str(folder / "small"), "--out", str(folder / "book"), "--workers", "2")
    result = CliRunner().invoke(main, ["field", *words, *options])
    assert "Traceback" not in result.output
    book = folder / "book" / "gradebook.json"
    return result, json.loads(book.read_text()) if book.exists() else {}


def ended(result: Result) -> list[str]:
    """Return the names of the targets that were asked in this run."""
    lines = result.stderr.splitlines()
    return sorted(x.partition(" ")[2].partition(":")[0] for x in lines if x[:1].isdigit())


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("class")
    write_small(folder / "small")
    (folder / "submissions").mkdir()
    for name in WRONG:
        (folder / "submissions" / f"{name}.py").write_text(SUBMISSION.format(name=name))
    (folder / "submissions" / "M\u00fcller, A.py").write_text(STEADY)
    client = CLIENTS / "submission.py"
    bad = [
        f"\n[targets.{kind}]\nwords = [{sys.executable!r}, {str(client)!r}, {kind!r}]\n"
        f"case_timeout = {0.4 if kind == 'hangs' else 30}\n"
        f"hello_timeout = {0.4 if kind == 'silent' else 60}\n"
        for kind in BAD
    ]
    (folder / "class.toml").write_text(CLASS + "\n".join(bad))
    return folder


HEARD: set[tuple[int, str]] = set()
"""How far the board of the first run was told that targets are."""


@pytest.fixture(scope="module")
def first(place: Path) -> tuple[Result, Json]:
    markdown = ("--markdown", str(place / "table.md"))

    def heard(_: object, number: int, verb: str, done: int, total: int) -> None:
        assert 0 <= done <= total
        HEARD.add((number, verb))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verb._Board, "progress", heard)
        return field(place, str(place / "class.toml"), *markdown, "--sort", "name")


def test_the_board_is_told_how_far_each_is(first: tuple[Result, Json]) -> None:
    _, book = first
    ran = sum(row["state"] in ("granted", "refused") for row in book["targets"])
    assert len([number for number, what in HEARD if what == "judging"]) == ran
    assert {what for _, what in HEARD} >= {"asking", "judging"}


def test_none_stops_the_others_and_each_has_its_reason(first: tuple[Result, Json]) -> None:
    result, book = first
    rows = {row["name"]: row for row in book["targets"]}
    assert result.exit_code == 1
    assert set(rows) == {*WRONG, "M\u00fcller, A", *BAD, "no-module", "nothing"}
    assert list(rows) == sorted(rows, key=str.casefold)
    for kind, reason in BAD.items():
        assert rows[kind]["state"] == "not run"
        assert reason in rows[kind]["reason"]
    assert "cannot import 'no_such_module'" in rows["no-module"]["reason"]
    assert "cannot start './no-such-program'" in rows["nothing"]["reason"]
    assert rows["M\u00fcller, A"]["state"] == "granted"
    assert rows["M\u00fcller, A"]["solids"]["slab"]["holds"]
    for name in WRONG:
        assert rows[name]["state"] == "refused"
        assert rows[name]["solids"]["cylinder"]["failed"] > 0


def test_all_that_was_found_is_there(first: tuple[Result, Json], place: Path) -> None:
    result, book = first
    folder = place / "book"
    for row in book["targets"]:
        if row["state"] in ("granted", "refused"):
            assert row["subject"]["name"] in (folder / row["page"]).read_text()
            certificate = json.loads((folder / row["certificate"]).read_text())
            assert certificate["tested"] == row["tested"]
        assert row["name"] in result.stdout
        assert row["name"] in (place / "table.md").read_text()
        assert row["name"] in (folder / "index.html").read_text()
    assert f"{len(book['targets'])} targets: 1 granted, {len(WRONG)} not granted" in result.stdout


def test_only_what_has_changed_is_asked_again(first: tuple[Result, Json], place: Path) -> None:
    file, names = str(place / "class.toml"), [*WRONG, "M\u00fcller, A"]
    result, book = field(place, file, *names)
    assert ended(result) == []
    assert [row["state"] for row in book["targets"]] == [*["refused"] * len(WRONG), "granted"]
    changed = place / "submissions" / f"{WRONG[0]}.py"
    changed.write_text(STEADY)
    assert ended(field(place, file, *names)[0]) == [WRONG[0]]
    assert ended(field(place, file, *names, "--level", "stable")[0]) == sorted(names)
    result, _ = field(place, file, "M\u00fcller, A", "--level", "stable", "--again")
    assert ended(result) == ["M\u00fcller, A"]
    assert result.exit_code == 0
    (place / "book" / WRONG[1] / "certificate.json").unlink()
    (place / "book" / WRONG[2] / "row.json").write_text("{")
    assert ended(field(place, file, *names, "--level", "stable")[0]) == sorted(WRONG[1:])


def test_what_an_entry_says_of_its_target_holds(place: Path, tmp_path: Path) -> None:
    hello = '{ name = "x", domain = { distance = 1000 }, solids = ["slab"] }'
    text = f'[targets.one]\nwords = "reference"\nhello = {hello}\n'
    (tmp_path / "one.toml").write_text(text)
    (tmp_path / "small").symlink_to(place / "small")
    result, book = field(tmp_path, str(tmp_path / "one.toml"))
    assert result.exit_code == 0
    [row] = book["targets"]
    assert row["domain"]["words"] == "starts within 1000 sizes"
    assert list(row["solids"]) == ["slab"]
    certificate = json.loads((tmp_path / "book" / "one" / "certificate.json").read_text())
    assert certificate["overridden"] == ["name", "domain", "solids"]
    assert "--hello book/one/hello.json" in certificate["reproduce"]
    assert "for starts within 1000 sizes" in result.stdout


STOPPED = """
import os, signal, sys
from raycert.oracle.commands import field, main
before = field._Board.ended
def ended(*words):
    before(*words)
    os.kill(os.getpid(), signal.SIGTERM)
field._Board.ended = ended
sys.argv = ["raycert", "field", *sys.argv[1:]]
main.main()
"""


@pytest.mark.skipif(os.name != "posix", reason="other signals")
def test_an_interruption_keeps_what_is_done_and_leaves_no_process(
    place: Path, tmp_path: Path
) -> None:
    client = [sys.executable, str(CLIENTS / "submission.py"), "lingers", str(tmp_path / "pid")]
    text = f"""
[targets.quick]
words = "reference"
hello.solids = ["slab"]
[targets.slow]
words = {client}
[targets.later]
words = "reference"
"""
    (tmp_path / "three.toml").write_text(text)
    words = ["three.toml", "--workers", "2", "--golden", str(place / "small")]
    command = [sys.executable, "-c", STOPPED, *words]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert "Traceback" not in done.stderr
    book = json.loads((tmp_path / "gradebook" / "gradebook.json").read_text())
    assert [row["state"] for row in book["targets"]] == ["granted", "not asked", "not asked"]
    assert book["interrupted"]
    assert done.returncode == 1
    pid = tmp_path / "pid"
    assert not pid.exists() or gone([int(pid.read_text())])


@pytest.mark.parametrize(
    ("words", "status", "says"),
    [
        (["--example"], 0, "[targets.reference]"),
        ([], 2, "give FILE or --each; an example: raycert field --example"),
        (["bad.toml"], 2, "bad.toml: targets.a.wrods is not a key; did you mean words?"),
        (["good.toml", "--words", "x"], 2, "--words is for --each"),
        (["good.toml", "alise"], 2, "alice"),
        (["--each", "none/*"], 2, "--each: targets.each none/*.each matches no file"),
        (["good.toml", "--out", "other"], 2, "other has another index.html"),
        (["good.toml", "--convention", "open"], 2, "open"),
        (["good.toml"], 3, "none of the targets could be run"),
        (["good.toml", "--json", "/dev/full"], 4, "/dev/full: No space left"),
    ],
)
def test_what_goes_wrong_has_its_status(
    words: list[str], status: int, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.toml").write_text("[targets.a]\nwrods = 'x'")
    (tmp_path / "good.toml").write_text("[targets.alice]\nwords = './no-such-program'")
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "index.html").touch()
    result = CliRunner().invoke(main, ["field", *words])
    assert says in " ".join(result.output.split())
    assert result.exit_code == status, result.output


def test_the_example_is_one(tmp_path: Path) -> None:
    """Also what is commented out in it."""
    from raycert.oracle.certify.entrants import read_entrants

    for name in ("submissions/alice/tracer.py", "java/Bea.jar"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).touch()
    (tmp_path / "class.toml").write_text(EXAMPLE)
    assert [entrant.name for entrant in read_entrants(tmp_path / "class.toml")] == ["reference"]
    lines = EXAMPLE.splitlines()
    code = [
        line.removeprefix("# ") for line in lines if line.startswith(("# [", "[")) or "=" in line
    ]
    (tmp_path / "class.toml").write_text("\n".join(code))
    names = [entrant.name for entrant in read_entrants(tmp_path / "class.toml")]
    assert names == ["alice", "Bea", "reference", "mine"]
