"""`raycert report`: from a certificate's file to its reports, or to the field that is wrong."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner
from junitparser import JUnitXml

import shared.certificates as made_up
from raycert.oracle.commands.certify import report
from raycert.oracle.commands.main import main
from raycert.oracle.reports.page import WRITERS


@pytest.fixture
def certificate(tmp_path: Path) -> Path:
    path = tmp_path / "certificate.json"
    path.write_text(json.dumps(made_up.attacked()))
    return path


def test_each_form_is_written_to_its_file(certificate: Path, tmp_path: Path) -> None:
    options = [f"--{name}={tmp_path / 'reports' / name}" for name in WRITERS]
    result = CliRunner().invoke(report, [str(certificate), *options])
    assert result.exit_code == 0, result.output
    for name, write in WRITERS.items():
        assert (tmp_path / "reports" / name).read_text("utf-8") == write(made_up.attacked())
    assert JUnitXml.fromfile(str(tmp_path / "reports" / "junit")).failures > 0


def test_a_dash_is_standard_output_and_no_option_the_terminal(certificate: Path) -> None:
    result = CliRunner().invoke(report, [str(certificate), "--markdown", "-"])
    assert result.stdout == WRITERS["markdown"](made_up.attacked())
    result = CliRunner().invoke(report, [str(certificate)])
    assert result.exit_code == 0
    assert "is not granted stable" in result.stdout


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "not JSON"),
        ("[" * 10**5, "nested"),
        ("[]", "certificate: is missing"),
        ('{"certificate": 9}', "certificate: is not of version 2"),
        ('{"certificate": 2}', "certificate: must contain"),
        ("\x00\xff", "not UTF-8: byte 0xff"),
    ],
)
def test_what_is_no_certificate_is_refused(text: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    path.write_bytes(text.encode("latin-1"))
    result = CliRunner().invoke(main, ["report", str(path), "--html", str(tmp_path / "x.html")])
    assert result.exit_code == 2, result.output
    assert words in result.output
    assert not (tmp_path / "x.html").exists()


def test_a_file_that_is_not_there_and_one_that_cannot_be_written(certificate: Path) -> None:
    assert CliRunner().invoke(report, ["no-such-file.json"]).exit_code == 2
    out = certificate / "x" / "y.html"
    assert CliRunner().invoke(report, [str(certificate), "--html", str(out)]).exit_code == 2
