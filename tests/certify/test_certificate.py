"""The certificate: its published form, its case table, its worst cases, the tool's hash."""

import copy
import json
import shlex
from collections.abc import Callable
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from click.testing import CliRunner

import shared.certificates as made_up
from raycert.cases.formats import FORMATS
from raycert.cases.forms import write_ray
from raycert.cases.levels import LEVELS
from raycert.cases.protocol import Hello
from raycert.cases.row import write_row
from raycert.oracle.certify.certificate import Request
from raycert.oracle.certify.environment import PACKAGES, environment, source_sha256, tool_sha256
from raycert.oracle.commands.main import main
from raycert.oracle.corpus.fresh import fresh_rows
from shared.certificates import Json, made, planted
from shared.corpus import golden


@cache
def schema() -> jsonschema.Draft202012Validator:
    text = (files("raycert.oracle") / "schemas" / "certificate.schema.json").read_text()
    form = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(form)
    return jsonschema.Draft202012Validator(form)


CERTIFICATES: dict[str, Callable[[], Json]] = {
    "good": made_up.good,
    "bad": made_up.bad,
    "hostile": made_up.attacked,
    "accepted": made_up.accepted,
    "interrupted": lambda: made(made_up.right, rows=made_up.sample()[:40], interrupted=True),
    "part": lambda: made(made_up.right, "exact", rows=made_up.sample()[:40], selection=("--id",)),
    "first": lambda: made(made_up.first, hello=Hello("f", answers="first", from_inside="exit")),
    "yes-no": lambda: made(made_up.yes_no, hello=Hello("any", answers="any")),
    "shard": lambda: made(made_up.right, rows=made_up.sample()[:40], shard="2/5"),
}


@pytest.mark.parametrize("name", CERTIFICATES)
def test_certificates_follow_the_published_schema(name: str) -> None:
    errors = [(list(e.path), e.message[:200]) for e in schema().iter_errors(CERTIFICATES[name]())]
    assert not errors, errors[:5]


def planted_in(change: Callable[[Json], Any]) -> Json:
    form = copy.deepcopy(made_up.accepted())
    change(form)
    return form


@pytest.mark.parametrize(
    "change",
    [
        lambda c: c.pop("tool"),
        lambda c: c.update(extra=1),
        lambda c: c["worst"][0].update(extra=1),
        lambda c: c["worst"][0]["accept"].pop("inner"),
        lambda c: c["failures"][0]["expected"].append(["0x1.0p+0"]),
        lambda c: c["failures"][0].update(answer=[[1.5, 2.5]]),
        lambda c: c["table"]["cylinder"].pop(),
        lambda c: c["run"].update(seconds="1"),
        lambda c: c["expectations"].pop("new"),
        lambda c: c["solids"].update(cone=c["solids"].popitem()[1]),
    ],
)
def test_the_schema_refuses_what_is_planted(change: Callable[[Json], Any]) -> None:
    assert not schema().is_valid(planted_in(change))


def test_the_same_run_gives_the_same_certificate() -> None:
    rows = made_up.sample()[:60]
    assert made(made_up.right, rows=rows) == made(made_up.right, rows=rows)


@pytest.mark.parametrize("make", [made_up.good, made_up.bad])
@pytest.mark.parametrize(
    ("solid", "rows"), [("infinite_cylinder", 6), ("slab", 7), ("cylinder", 42)]
)
def test_the_case_table_counts_each_row_once(
    make: Callable[[], Json], solid: str, rows: int
) -> None:
    """Over the table's rows the counts add up to those of the solid: none twice, none left out."""
    form = make()
    table, tally = form["table"][solid], form["solids"][solid]["levels"]["stable"]
    assert len(table) == rows
    for name in ("passed", "failed", "not_decisive"):
        assert sum(cell[name] for cell in table) == tally[name]
    failing = {f["id"] for f in form["failures"] if "stable" in f["faults"]}
    for cell in table:
        assert (cell["first_failing"] is not None) == bool(cell["failed"])
        assert cell["first_failing"] is None or cell["first_failing"] in failing


def test_the_worst_cases_are_failures_and_spread_over_families() -> None:
    form = made_up.bad()
    worst = form["worst"]
    assert len(worst) == 12
    assert all("stable" in shown["faults"] and shown["tier"] != "range" for shown in worst)
    failing = {
        f["id"].partition("/")[0]
        for f in form["failures"]
        if "stable" in f["faults"] and f["tier"] != "range"
    }
    families = {shown["id"].partition("/")[0] for shown in worst}
    assert len(families) == min(12, len(failing))
    assert len({shown["kind"] for shown in worst}) >= 3


def test_where_nothing_fails_the_worst_are_the_largest_errors() -> None:
    worst = made_up.good()["worst"]
    assert 0 < len(worst) <= 4
    assert {shown["kind"] for shown in worst} == {"passed"}


@pytest.mark.parametrize("level", LEVELS)
def test_the_band_of_every_level_holds_the_expected_list(level: str) -> None:
    rows = tuple(row for row in made_up.sample() if row.expected)[:80]
    form = made(planted("caps-forgotten"), level, rows=rows)  # type: ignore[arg-type]
    assert form["worst"]
    for shown in form["worst"]:
        numbers = {
            name: [[float.fromhex(x) for x in pair] for pair in pairs]
            for name, pairs in (shown["accept"] | {"expected": shown["expected"]}).items()
            if name != "level"
        }
        for a, b in numbers["expected"]:
            assert any(c <= a and b <= d for c, d in numbers["outer"])
        for a, b in numbers["inner"]:
            assert any(c <= a and b <= d for c, d in numbers["expected"])


def test_a_run_is_accepted_only_if_nothing_surprises() -> None:
    assert made_up.accepted()["accepted"]
    assert not made_up.accepted()["granted"]
    assert not made_up.bad()["accepted"]
    rows = made_up.sample()[:40]
    for surprise in ("new", "unexpected_passes", "unmatched"):
        told = made_up.expecting(**{surprise: ["x/y"]})
        assert not made(made_up.right, rows=rows, expectations=told)["accepted"]
    told = made_up.expecting()
    assert made(made_up.right, rows=rows, expectations=told)["accepted"]
    assert not made(made_up.right, rows=rows, expectations=told, interrupted=True)["accepted"]


def test_a_shard_and_expectations_are_no_certificate() -> None:
    rows = made_up.sample()[:40]
    assert made(made_up.right, rows=rows)["granted"]
    assert not made(made_up.right, rows=rows, shard="1/2")["granted"]
    for told, granted in ((["a/b"], False), ([], True)):
        expectations = made_up.expecting(expected=told)
        assert made(made_up.right, rows=rows, expectations=expectations)["granted"] == granted


def test_the_hash_of_the_tool_is_of_every_source_file(tmp_path: Path) -> None:
    for name in PACKAGES:
        (tmp_path / name / "inner").mkdir(parents=True)
        (tmp_path / name / "inner" / "a.py").write_text("x = 1\n")
    before = source_sha256(tmp_path)
    (tmp_path / "oracle" / "notes.txt").write_text("not source")
    assert source_sha256(tmp_path) == before
    (tmp_path / "reference" / "inner" / "a.py").write_text("x = 2\n")
    changed = source_sha256(tmp_path)
    (tmp_path / "reference" / "inner" / "a.py").rename(tmp_path / "reference" / "inner" / "b.py")
    assert len({before, changed, source_sha256(tmp_path)}) == 3


def test_the_environment_names_the_tool() -> None:
    tool = environment()["tool"]
    assert tool["name"] == "raycert"
    assert tool["sha256"] == tool_sha256()
    assert tool["sha256"] != source_sha256(Path("/nonexistent"))


@pytest.mark.parametrize("precision", FORMATS)
@pytest.mark.parametrize("kind", ["golden", "fresh"])
def test_the_line_that_explains_a_row_derives_it(precision: str, kind: str) -> None:
    fmt = FORMATS[precision]
    some = fresh_rows(3, 30, fmt, ["sphere"]) if kind == "fresh" else golden(precision).rows
    row = next(r for r in some if any(s.leave.down != s.leave.up for s in r.intervals))
    line = Request("sound", "closed", ("t",), ()).explain_row(row, precision)
    given, _, explain = line.rpartition("|") if kind == "fresh" else ("", "", line)
    (_, *words), case = shlex.split(explain), shlex.split(given)[1:]
    said = CliRunner().invoke(main, [*words, "--json", "-"], input="".join(case))
    assert said.exit_code == 0, said.output
    found = json.loads(said.stdout)["row"]
    assert found["ray"] == write_ray(row.ray, "hex")
    assert found["expected"] == write_row(row, fmt)["expected"]
