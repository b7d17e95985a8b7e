"""The report on a terminal: it says what there is, and prints what clients said as plain text."""

import copy
from io import StringIO

import pytest
from rich.console import Console

import shared.certificates as made_up
from raycert.oracle.reports.reading import failing
from raycert.oracle.reports.terminal import SHOWN, report
from shared.certificates import Json


def printed(certificate: Json, colour: bool = False) -> str:
    stream = StringIO()
    report(certificate, Console(file=stream, width=120, force_terminal=colour))
    return stream.getvalue()


def test_markup_in_what_a_client_said_is_printed_and_not_obeyed() -> None:
    form = copy.deepcopy(made_up.bad())
    for failed in form["failures"]:
        failed["faults"] = dict.fromkeys(failed["faults"], "error: [/x] [bold]b[/bold] :smile:")
        failed["why"] = "[red]why[/]"
    form["run"]["notes"] = ["[link=file:///]note[/link]"]
    text = printed(form, colour=True)
    for words in ("[/x] [bold]b[/bold] :smile:", "[red]why[/]", "[link=file:///]note[/link]"):
        assert words in text


def test_a_client_cannot_write_to_the_terminal() -> None:
    """The only escapes are the report's own styles, and what a name holds is not among them."""
    text = printed(made_up.attacked(), colour=True)
    assert "\x1b[31m ```" not in text
    assert "\x00" not in text
    assert "\u202e" not in text


@pytest.mark.parametrize("name", ["good", "bad", "attacked"])
def test_every_solid_and_family_is_named(name: str) -> None:
    form = getattr(made_up, name)()
    text = printed(form)
    for solid in form["solids"]:
        assert solid in text
    for family in form["families"]:
        assert family["family"] in text


def test_a_few_failing_rows_are_printed_and_the_others_counted() -> None:
    found = failing(made_up.bad())
    text = printed(made_up.bad())
    assert [f["id"] for f in found if f"\n{f['id']}\n" in text] == [f["id"] for f in found[:SHOWN]]
    assert f"and {len(found) - SHOWN} more rows" in text
    assert "does likely this" in text
    assert "note: a note" in text
