"""What certify writes costs nothing that is there: parts, other runs, other files."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.certify import run as running
from raycert.oracle.commands.main import main
from shared.small_corpus import write_small

HERE = Path("certificate.json")
PARTS = {
    "--id": "plain/through",
    "--family": "plain",
    "--tier": "stiff",
    "--solid": "slab",
    "--shard": "1/2",
}


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_small(tmp_path_factory.mktemp("golden"))


@pytest.fixture(scope="module")
def whole(golden: Path, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A certificate of the small corpus."""
    out = tmp_path_factory.mktemp("whole") / "certificate.json"
    words = ["certify", "--golden", str(golden), "--out", str(out), "reference"]
    assert CliRunner().invoke(main, words).exit_code < 2
    return out.read_bytes()


@pytest.fixture(autouse=True)
def here(tmp_path: Path, golden: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in an empty folder, with the small corpus in place of the installed one."""
    monkeypatch.setenv("SMALL", str(golden))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def there(whole: bytes, here: Path) -> bytes:
    """The certificate of a whole run, that is here."""
    HERE.write_bytes(whole)
    return whole


def run(*options: str, target: str = "reference") -> Result:
    words = ["certify", "--golden", os.environ["SMALL"], *options, target]
    return CliRunner().invoke(main, words)


def certificate(path: Path = HERE) -> dict[str, Any]:
    form: dict[str, Any] = json.loads(path.read_text())
    return form


@pytest.mark.parametrize("option", PARTS)
def test_a_part_has_a_certificate_only_where_one_is_named(option: str, here: Path) -> None:
    assert "no certificate" in run(option, PARTS[option]).output
    assert list(here.iterdir()) == []
    assert run(option, PARTS[option], "--out", "part.json").exit_code < 2
    assert certificate(Path("part.json"))["selection"] == [option, PARTS[option]]


def test_smoke_is_a_part(here: Path) -> None:
    result = CliRunner().invoke(main, ["certify", "--smoke", "oracle"])
    assert result.exit_code == 0, result.output
    assert list(here.iterdir()) == []


def test_a_line_that_repeats_a_row_leaves_the_certificate(there: bytes) -> None:
    form = certificate()
    repeat = next(row["reproduce"] for row in (*form["failures"], *form["worst"])).split()
    assert CliRunner().invoke(main, repeat[1:]).exit_code < 2
    assert HERE.read_bytes() == there


OTHERS = (
    (("--level", "stable"), "reference", "--level stable"),
    (("--convention", "regularized"), "reference", "regularized"),
    (("--seed", "3", "--fresh", "1"), "reference", "--seed 3"),
    (("--family", "plain", "--out", str(HERE)), "reference", "--family plain"),
    ((), "oracle", "oracle"),
)


@pytest.mark.parametrize(("options", "target", "words"), OTHERS)
def test_another_run_is_refused_before_it_begins(
    options: tuple[str, ...],
    target: str,
    words: str,
    there: bytes,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(running, "certify", lambda *_: pytest.fail("it began"))
        result = run(*options, target=target)
    assert result.exit_code == 2, result.output
    assert words in result.output.partition("asked")[2]
    assert "--force" in result.output
    assert "--out FILE" in result.output
    assert HERE.read_bytes() == there


def test_force_overwrites(there: bytes) -> None:
    assert run("--force", target="oracle").exit_code < 2
    assert certificate()["subject"]["command"] == ["oracle"]


def test_the_same_run_again_replaces_its_certificate(there: bytes) -> None:
    HERE.write_text(json.dumps(certificate() | {"tested": 0}))
    assert run().exit_code < 2
    assert certificate()["tested"] > 0


def test_other_golden_files_make_another_run(there: bytes) -> None:
    form = certificate()
    form["corpus"]["manifest_sha256"] = "0" * 64
    HERE.write_text(json.dumps(form))
    result = run()
    assert result.exit_code == 2
    assert "other golden files" in result.output


@pytest.mark.parametrize("text", ["int main() {}", "{}", "[]", "1", '{"corpus": {}}', "[" * 9999])
def test_what_is_no_certificate_stays(text: str) -> None:
    Path("mine").write_text(text)
    result = run("--out", "mine")
    assert result.exit_code == 2
    assert "no certificate" in result.output
    assert Path("mine").read_text() == text


def test_an_empty_file_holds_nothing_to_lose() -> None:
    HERE.touch()
    assert run().exit_code < 2
    assert certificate()["tested"]


def test_a_certificate_that_came_meanwhile_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    certify = running.certify

    def meanwhile(*words: Any) -> Any:
        HERE.write_text("another's")
        return certify(*words)

    monkeypatch.setattr(running, "certify", meanwhile)
    result = run()
    assert result.exit_code == 4
    assert "not written: certificate.json" in result.output
    assert HERE.read_text() == "another's"


def test_an_interrupted_run_leaves_the_certificate_of_the_whole(
    there: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    conduct = running.conduct

    def cut(*words: Any) -> Any:
        with monkeypatch.context() as patch:
            patch.setattr(running, "ask", lambda *_, **__: (_ for _ in ()).throw(KeyboardInterrupt))
            return conduct(*words)

    monkeypatch.setattr(running, "conduct", cut)
    result = run()
    assert "stays" in result.output
    assert HERE.read_bytes() == there
    run("--force")
    assert certificate()["run"]["interrupted"]


def test_reasons_are_not_lost_to_new_expectations() -> None:
    known = Path("known.toml")
    write = ("--write-expectations", str(known))
    assert run(*write, target="raycert.oracle.zoo.textbook:textbook").exit_code < 2
    before = known.read_bytes()
    refused = run(*write, "--out", "x.json")
    assert refused.exit_code == 2
    assert f"--expect {known}" in refused.output
    assert known.read_bytes() == before
    assert run(*write, "--expect", str(known), "--out", "x.json").exit_code < 2


def test_a_domain_that_was_reviewed_stays(here: Path) -> None:
    Path("hello.json").write_text("{}")
    result = run("--hello", "hello.json", "--write-domain", "hello.json")
    assert result.exit_code == 2
    assert "--force" in result.output
    assert Path("hello.json").read_text() == "{}"


@pytest.mark.parametrize(
    "options",
    [
        ("--html", "a", "--junit", "./a"),
        ("--html", str(HERE)),
        ("--out", "a", "--write-expectations", "a"),
    ],
)
def test_two_outputs_are_two_files(options: tuple[str, ...], here: Path) -> None:
    result = run(*options)
    assert result.exit_code == 2
    assert "name one file" in result.output
    assert list(here.iterdir()) == []


def test_a_report_is_made_again_but_not_of_its_certificate(there: bytes) -> None:
    Path("x.xml").write_text("old")
    for out, status in (("x.xml", 0), (str(HERE), 2)):
        result = CliRunner().invoke(main, ["report", str(HERE), "--junit", out])
        assert result.exit_code == status, result.output
    assert Path("x.xml").read_text() != "old"
    assert HERE.read_bytes() == there
