"""The report on a terminal: it fits a screen, and prints what clients said as plain text."""

import ast
import copy
import json
import re
from io import StringIO

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

import shared.certificates as made_up
from raycert.oracle.reports.findings import kinds
from raycert.oracle.reports.inputs import assignments, length
from raycert.oracle.reports.reading import failing
from raycert.oracle.reports.terminal import report
from shared.certificates import Json


def printed(
    certificate: Json, colour: bool = False, width: int = 100, verbose: bool = False
) -> str:
    stream = StringIO()
    report(certificate, Console(file=stream, width=width, force_terminal=colour), verbose)
    return stream.getvalue()


def test_markup_in_what_a_client_said_is_printed_and_not_obeyed() -> None:
    form = copy.deepcopy(made_up.bad())
    for failed in form["failures"]:
        failed["faults"] = dict.fromkeys(failed["faults"], "error: [/x] [bold]b[/bold] :smile:")
        failed["why"], failed["answer"] = "[red]why[/]", None
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
def test_every_solid_is_named_and_with_verbose_every_family(name: str) -> None:
    form = getattr(made_up, name)()
    text = printed(form, verbose=True)
    for solid in form["solids"]:
        assert solid.replace("_", " ") in text
    for family in form["families"]:
        assert family["family"] in text
    assert "Worst answers" not in printed(form)


@pytest.mark.parametrize("width", [80, 100, 120])
@pytest.mark.parametrize("name", ["good", "bad", "attacked", "much"])
def test_a_report_fits_a_screen(name: str, width: int) -> None:
    """Sixty lines hold the report and the names of the files; at 80 columns some lines more."""
    lines = printed(getattr(made_up, name)(), width=width).splitlines()
    assert len(lines) <= (59 if width >= 100 else 75)
    long = [line for line in lines if len(line) > width]
    words = ("    raycert explain", "ask the first again", "crash:", "A" * 50)
    assert all(any(word in line for word in words) for line in long)


def test_one_failure_of_each_kind_is_shown_the_simplest_first_and_explained() -> None:
    form = made_up.bad()
    found, text = kinds(form), printed(form)
    assert len(found) > 2
    assert {kind.name for kind in found} == {failed["kind"] for failed in failing(form)}
    assert sum(kind.rows for kind in found) == len(failing(form))
    for kind in found:
        alike = [failed for failed in failing(form) if failed["kind"] == kind.name]
        assert length(kind.first) == min(map(length, alike))
    assert [length(kind.first) for kind in found] == sorted(length(kind.first) for kind in found)
    places = [text.index(f"  {kind.name}, {kind.rows}") for kind in found]
    assert places == sorted(places)
    for kind in found:
        assert kind.first["id"] in text
    assert found[0].first["explain"] in text


@pytest.mark.parametrize("width", [80, 100])
def test_inputs_paste_into_code_and_into_json(width: int) -> None:
    """What is shown of a case is that case, to the last bit, in Python and in JSON."""
    form = made_up.bad()
    text = printed(form, width=width)
    blocks = re.findall(r"    solid = (\{.*?\n)    ray = (\{.*?\n)    answer", text, re.DOTALL)
    assert len(blocks) > 1
    shown = [kind.first for kind in kinds(form)]
    for block in blocks:
        for part in block:
            assert ast.literal_eval(part.strip()) == json.loads(part)
        solid, ray = map(json.loads, block)
        again = [[x.hex() for x in ray[name]] for name in ("origin", "direction")]
        assert [
            failed
            for failed in shown
            if failed["solid"]["type"] == solid["type"]
            and [failed["ray"]["origin"], failed["ray"]["direction"]] == again
        ]


def test_what_was_found_is_said() -> None:
    text = printed(made_up.much())
    for words in (
        "does likely this",
        "explained by none: 1 cylinder failure",
        "on 8 of 9 cylinder failures and all 9 union failures",
        "3 of 4 easy cases fail; it ignores the center",
        'solid = {"type": "sphere", "center": [1.0, 2.0, 3.0], "radius": 2.0}',
        "sound for starts within 1000 sizes; first failure beyond: sphere-far/far",
        "outside the domain: 312 rows: 250 right, 40 refused, 22 wrong",
        "zero direction, not declared: 16 rows: 0 answered, 15 refused, 1 wrong",
        "note: a note",
    ):
        assert words in " ".join(text.split()), words


def test_a_row_outside_the_domain_is_no_failure() -> None:
    form = copy.deepcopy(made_up.bad())
    before = sum(kind.rows for kind in kinds(form))
    failing(form)[0]["place"] = "outside"
    assert sum(kind.rows for kind in kinds(form)) == before - 1


@given(
    st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=3, max_size=3),
    st.integers(30, 120),
)
def test_decimals_are_the_numbers_and_lines_break_after_commas(x: list[float], width: int) -> None:
    hexed = [number.hex() for number in x]
    case = {"solid": {"type": "sphere", "center": hexed}, "ray": {"origin": hexed}}
    lines = assignments(case, width)
    code = "\n".join(lines)
    names: dict[str, Json] = {}
    exec(code, names)  # it is code of ours, made of these numbers
    for part, field in (("solid", "center"), ("ray", "origin")):
        assert [number.hex() for number in names[part][field]] == hexed
    broken = [line for line in lines[:-1] if not line.endswith(",")]
    assert all(line.endswith("}") for line in broken)
    assert all(len(line) <= width for line in lines if line.count(", "))
