"""The reports of known runs: the right words, whatever a client said, and no more than can be."""

import copy
import re
from collections.abc import Callable
from html import unescape
from html.parser import HTMLParser
from io import StringIO

import pytest
from junitparser import JUnitXml
from rich.console import Console

import shared.certificates as made_up
from raycert.cases.model import Refused
from raycert.oracle.reports.findings import kinds
from raycert.oracle.reports.foreign import clean
from raycert.oracle.reports.inputs import case_json, intervals, written
from raycert.oracle.reports.junit import junit
from raycert.oracle.reports.markdown import code, markdown
from raycert.oracle.reports.page import WRITERS, page
from raycert.oracle.reports.reading import (
    check,
    count,
    failing,
    number,
    verdict,
)
from raycert.oracle.reports.terminal import report
from shared.certificates import Json, made


def terminal(certificate: Json) -> str:
    console = Console(file=StringIO(), width=120, force_terminal=False)
    report(certificate, console)
    assert isinstance(console.file, StringIO)
    return console.file.getvalue()


ALL: dict[str, Callable[[Json], str]] = {**WRITERS, "terminal": terminal}
every = pytest.mark.parametrize("name", ALL)


@every
def test_a_hostile_client_is_quoted_and_harms_nothing(name: str) -> None:
    text = ALL[name](made_up.attacked())
    assert text.encode()
    hidden = {chr(i) for i in range(32)} - {"\n"} | {"\u202e", "\x7f"}
    assert not hidden & set(text)
    assert "A" * 400 not in text
    assert max(map(len, text.splitlines())) < 40_000


@every
def test_the_verdict_is_said(name: str) -> None:
    rows = made_up.sample()[:60]
    part = made(made_up.right, rows=rows, selection=("--family", "x"))
    stopped = made(made_up.right, rows=rows, interrupted=True)
    words = {
        "is granted stable and closed": made_up.good(),
        "is not granted stable and closed": made_up.bad(),
        "run accepted, not certified": made_up.accepted(),
        "not a certificate": part,
        "the run was interrupted": stopped,
    }
    for said, form in words.items():
        assert said in " ".join(ALL[name](form).split()), said


@every
def test_surprises_beside_the_expected_failures_are_named(name: str) -> None:
    told = made_up.expecting(new=["a/new"], unexpected_passes=["a/passes"], unmatched=["no/such"])
    form = made(made_up.right, rows=made_up.sample()[:40], expectations=told)
    text = " ".join(ALL[name](form).split())
    for words in ("a/new", "a/passes", "no/such"):
        assert words in text
    assert "run accepted" not in text
    assert not verdict(form).good


@every
def test_what_is_likely_and_how_to_repeat_is_said(name: str) -> None:
    text = ALL[name](made_up.bad())
    assert "likely" in text or name == "junit"
    failed = failing(made_up.bad())[0]
    assert failed["id"].partition("/")[2] in text
    assert "./tracer" in text


@every
def test_other_answers_than_lists_are_shown(name: str) -> None:
    hello = made_up.Hello("f", answers="first")
    assert "first: " in ALL[name](made(made_up.first, hello=hello)) or name == "html"
    hello = made_up.Hello("any", answers="any")
    assert "hit: " in ALL[name](made(made_up.yes_no, hello=hello))


def test_junit_has_a_test_for_each_family_and_says_why_it_fails() -> None:
    form = made_up.bad()
    xml = JUnitXml.fromstring(junit(form))
    suites = {suite.name: suite for suite in xml}
    for solid in form["solids"]:
        families = [f for f in form["families"] if f["solid"] == solid]
        suite = suites[f"raycert.{solid}"]
        assert suite.tests == len(families)
        fails = sum(f["levels"]["stable"]["failed"] > 0 for f in families)
        assert suite.failures == fails
        assert {p.name for p in suite.properties()} == {"level", "convention", "corpus", "tool"}
    assert xml.time == form["run"]["seconds"]
    texts = [result.text for suite in xml for test in suite for result in test.result]
    assert any("raycert certify --level stable" in (text or "") for text in texts)


def test_junit_of_a_granted_and_of_an_accepted_run_has_no_failure() -> None:
    assert JUnitXml.fromstring(junit(made_up.good())).failures == 0
    xml = JUnitXml.fromstring(junit(made_up.accepted()))
    assert xml.failures == 0
    assert xml.skipped > 0


def test_what_was_not_tested_is_skipped_with_its_reason() -> None:
    form = copy.deepcopy(made_up.good())
    form["not_tested"] = {"solids": ["sphere"], "rows": 3}
    skipped = [
        test
        for suite in JUnitXml.fromstring(junit(form))
        for test in suite
        if test.name == "not tested"
    ]
    assert [test.classname for test in skipped] == ["raycert.sphere"]
    for writer in (markdown, page, terminal):
        assert "not tested" in writer(form)


def test_markdown_is_short_where_all_is_well_and_its_tables_hold() -> None:
    assert markdown(made_up.good()).count("\n") < 60
    for form in (made_up.good(), made_up.bad(), made_up.attacked()):
        tables = [line for line in markdown(form).splitlines() if line.startswith("|")]
        assert tables
        assert {line.count("|") for line in tables} == {7}
        assert markdown(form).count("<details>") == markdown(form).count("</details>")


@pytest.mark.parametrize("text", ["a|b", "`", "``x`", "<b>", "", " ", "*x*", "```\n# h"])
def test_a_code_span_holds_anything(text: str) -> None:
    span = code(text)
    fence = re.match(r"`+", span)
    assert fence
    inner = span[len(fence[0]) : -len(fence[0])]
    assert fence[0] not in re.findall(r"`+", inner)
    assert "|" not in span
    assert "\n" not in span


@every
def test_a_failure_has_its_inputs_and_the_command_that_explains_it(name: str) -> None:
    """In decimal and in hex, whole, whatever the length; the terminal has the decimals alone."""
    form = made_up.bad()
    text = " ".join(re.sub(r"<[^>]*>", "", unescape(ALL[name](form))).split())
    shown = kinds(form)[0].first if name == "terminal" else form["worst"][0]
    if name in ("junit", "markdown"):
        shown = failing(form)[0]
    decimal, coded = case_json(shown), case_json(shown, hexed=True)
    solid, ray = (written(shown[part]) for part in ("solid", "ray"))
    assert decimal in text or (solid in text and ray in text)
    assert coded in text or name == "terminal"
    assert shown["explain"] in text


class Tags(HTMLParser):
    """The tags of a page, with their attributes, and what stands outside `style`."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in ("meta", "li"):
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        if tag != "li":
            assert self.open.pop() == tag


@pytest.mark.parametrize("make", [made_up.good, made_up.bad, made_up.attacked, made_up.accepted])
def test_a_page_asks_for_nothing_and_runs_nothing(make: Callable[[], Json]) -> None:
    text = page(make())
    found = Tags(text)
    assert not found.open
    for tag, attributes in found.tags:
        assert tag not in ("script", "img", "iframe", "link", "object", "base", "form")
        assert not {"src", "href", "srcset", "style"} & set(attributes)
        assert not any(name.startswith("on") for name in attributes)
    style = text[text.index("<style>") : text.index("</style>")]
    assert "url(" not in style
    assert "@import" not in style


def test_a_page_has_every_family_and_every_row_of_the_case_table() -> None:
    form = made_up.bad()
    text = page(form)
    for family in form["families"]:
        assert f"<code>{family['family']}</code>" in text
    cells = text[text.index('class="grid"') :]
    cells = cells[: cells.index("</table>")]
    assert cells.count("<td") == 42
    for row in form["table"]["infinite_cylinder"] + form["table"]["slab"]:
        assert f"<code>{row['rows'][0]}</code>" in text


def test_a_page_with_thousands_of_failures_stays_small() -> None:
    form = copy.deepcopy(made_up.attacked())
    few = [f for f in form["failures"] if "stable" in f["faults"] and f["tier"] != "range"]
    form["failures"] = [
        {**failed, "id": f"{failed['id']}-{i}"}
        for i in range(6000 // len(few) + 1)
        for failed in few
    ]
    assert len(form["failures"]) >= 6000
    text = page(form)
    assert len(text.encode()) < 1_500_000
    assert "more, all in the JSON certificate" in text


def test_words_and_numbers() -> None:
    assert clean("a\tb\x00\u202ec\ud800") == r"a b\x00\u202ec\ud800"
    assert clean("x" * 1000, 10) == "x" * 9 + "\u2026"
    assert clean("e" + "\u0301" * 9) == "e\u0301\u0301"
    assert clean("\u05d0\u05d1 \U0001f600") == "\u05d0\u05d1 \U0001f600"
    assert len(clean("\u0301" * 10**6, 50)) <= 50
    assert (count(1, "row"), count(6662, "row")) == ("1 row", "6,662 rows")
    assert [number(x) for x in (None, 0.0625, 64.0, 5e15)] == ["inf", "0.0625", "64", "5e+15"]
    assert intervals([["0x1.0p+1", "inf"]]) == "[[2.0, inf]]"
    assert intervals(None) == "none"


@pytest.mark.parametrize("name", sorted(set(made_up.good()) - {"certificate"}))
def test_a_file_that_lacks_a_field_is_refused_by_its_name(name: str) -> None:
    form = dict(made_up.good())
    assert check(form) is form
    for change in ({k: v for k, v in form.items() if k != name}, form | {name: 1.5}):
        with pytest.raises(Refused, match=f"certificate.*{name}"):
            check(change)


@pytest.mark.parametrize("form", [None, [], {}, {"certificate": 2}, {"hello": 1}])
def test_what_is_no_certificate_is_refused(form: object) -> None:
    with pytest.raises(Refused, match="certificate"):
        check(form)
