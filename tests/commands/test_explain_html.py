"""The page of `explain`, and the options that ask implementations."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from raycert.oracle.commands.explain import explain

CASE = ("--cylinder", "0,0,0", "0,0,2", "1", "--ray=-3,0.25,1", "1,0,0")
TRACER = "raycert.reference.tracer:intersect"


def run(*words: str) -> Result:
    return CliRunner().invoke(explain, words)


def test_a_page_is_written_with_the_answer_of_the_implementations_asked(tmp_path: Path) -> None:
    page = tmp_path / "case.html"
    result = run(*CASE, "--html", str(page), "--target", TRACER)
    assert result.exit_code == 0, result.output
    text = page.read_text()
    assert "<bdi>intersect</bdi>" in text
    assert f"--target {TRACER}" in text
    assert "Problem 3" in text
    assert result.stdout == ""


def test_without_a_word_the_reference_is_asked() -> None:
    result = run(*CASE, "--html", "-")
    assert result.exit_code == 0
    assert "<bdi>reference</bdi>" in result.stdout
    assert "raycert explain --case - --html - &lt;&lt;&lt;" in result.stdout


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        ((*CASE, "--target", TRACER), 2, "--html"),
        ((*CASE, "--html", "x.html", "--json", "x.html"), 2, "name one file"),
        (("--symbolic", "--html", "x.html"), 2, "a page of one case"),
        ((*CASE, "--html", "/proc/none/x.html"), 2, "--html"),
        ((*CASE, "--html", "-", "--target", "./none.so"), 3, "there is no file"),
    ],
)
def test_what_makes_no_page(words: tuple[str, ...], code: int, says: str) -> None:
    result = run(*words)
    assert result.exit_code == code
    assert says in result.stderr
