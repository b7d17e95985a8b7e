"""The verbs: each has a place and a line of help, and a word that is none is met with advice."""

import pytest
from click.testing import CliRunner

from raycert.oracle.commands.main import PLACES, load, main


@pytest.mark.parametrize("verb", PLACES)
def test_every_verb_is_there(verb: str) -> None:
    command = load(PLACES[verb])
    assert command.name == verb
    assert command.get_short_help_str()


def test_help_names_every_verb_once_in_groups() -> None:
    result = CliRunner().invoke(main, ["--help"])
    assert result.exit_code == 0
    assert all(result.output.count(f"\n  {verb} ") == 1 for verb in PLACES)


@pytest.mark.parametrize(
    ("word", "advice"),
    [("certfy", "did you mean certify?"), ("xyzzy", "see: raycert --help")],
)
def test_an_unknown_verb_is_met_with_advice(word: str, advice: str) -> None:
    result = CliRunner().invoke(main, [word, "--level", "stable"], prog_name="raycert")
    assert result.exit_code == 2
    assert f"no verb '{word}'; {advice}" in result.output
