"""Known failures: what is written is read again, and a run is accepted for no other failures."""

from dataclasses import dataclass, replace
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.files import BadFile
from raycert.cases.levels import LEVELS, Level
from raycert.cases.model import SOLIDS, type_of
from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.known import (
    Expectation,
    Expectations,
    Matched,
    match,
    read,
    record,
    write,
)
from shared.corpus import golden

GOOD = """
[[expect]]
id = "far-deep/across-1e9"
level = "stable"
reason = "cancellation"
link = "https://example.org/1"

[[expect]]
family = "needle"
reason = "too thin"
link = ""

[[expect]]
convention = "sphere"
reason = "drops tangents"
link = "x"
"""

texts = st.text(st.characters(exclude_categories=("Cs",)), min_size=1).filter(str.strip)
leveled = st.none() | st.sampled_from(LEVELS)
entries = st.lists(
    st.builds(Expectation, st.sampled_from(("id", "family")), texts, texts, st.text(
        st.characters(exclude_categories=("Cs",))), leveled)
    | st.builds(Expectation, st.just("convention"), st.sampled_from(sorted(SOLIDS)), texts),
    unique_by=lambda entry: (entry.kind, entry.name),
    max_size=5,
)  # fmt: skip


@given(entries)
def test_what_is_written_is_read_again(listed: list[Expectation]) -> None:
    expectations = Expectations(tuple(listed))
    assert read(write(expectations)) == expectations


def test_the_form_is_read() -> None:
    found = read(GOOD)
    assert [str(entry) for entry in found.entries] == [
        "far-deep/across-1e9",
        "family needle",
        "convention sphere",
    ]
    assert found.entries[0].level == "stable"
    assert found.warnings == ["expected failures without a link: family needle"]
    assert read("").entries == ()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[[expect]\n", "is not TOML.*line 1"),
        ("[[expected]]\n", "unknown key 'expected'"),
        ("expect = 3", r"write \[\[expect\]\]"),
        ("expect = [3]", "entry 1: is not a table"),
        (GOOD + '[[expect]]\nid = "a/b"\nlink = ""', "entry 4: reason is missing"),
        (GOOD + '[[expect]]\nid = "a/b"\nreason = ""', "entry 4: reason is empty"),
        (GOOD + '[[expect]]\nid = "a/b"\nreason = " \\t"\nlink = ""', "entry 4: reason is empty"),
        (GOOD + '[[expect]]\nid = "a/b"\nreason = "r"', "entry 4: link is missing"),
        (GOOD + '[[expect]]\nid = 3\nreason = "r"\nlink = ""', "entry 4: id is not a string"),
        (GOOD + '[[expect]]\nid = "a"\nreason = "r"\nlink = 1', "entry 4: link is not a string"),
        (GOOD + '[[expect]]\nreason = "r"\nlink = ""', "entry 4: has to have exactly one of id"),
        ('[[expect]]\nid = "a"\nfamily = "b"\nreason = "r"\nlink = ""', "entry 1: has to have"),
        ('[[expect]]\nid = "a"\nwhy = "b"', "entry 1: unknown key 'why'"),
        ('[[expect]]\nid = "a"\nlevel = "good"\nreason = "r"\nlink = ""', "entry 1: level is not"),
        ('[[expect]]\nconvention = "cone"\nreason = "r"\nlink = ""', "entry 1: convention is not"),
        (
            '[[expect]]\nconvention = "sphere"\nlevel = "sound"\nreason = "r"\nlink = ""',
            "entry 1: level is for id and family",
        ),
        (
            GOOD + '[[expect]]\nfamily = "needle"\nreason = "r"\nlink = ""',
            "entry 4: family 'needle' is entry 2 too",
        ),
    ],
)
def test_a_bad_file_is_refused_with_the_place(text: str, words: str) -> None:
    with pytest.raises(BadFile, match=words) as raised:
        read(text, "known.toml")
    assert str(raised.value).startswith("known.toml: ")


def test_deep_nesting_is_refused() -> None:
    with pytest.raises(BadFile, match="nested"):
        read("expect = " + "[" * 100_000)


@pytest.mark.parametrize("digits", ["1" * 10_000, "0x" + "f" * 10_000])
def test_an_integer_of_many_digits_is_refused(digits: str) -> None:
    """Python reads no decimal of so many digits, and shows no integer."""
    for text in (f"expect = {digits}", GOOD + f"[[expect]]\nid = {digits}"):
        with pytest.raises(BadFile, match=r"known\.toml: .*(digits|string|list of tables)"):
            read(text, "known.toml")


# Runs: rows of the corpus with faults planted in their grades.


@cache
def rows() -> tuple[GoldenRow, ...]:
    """Return decisive rows of two families of spheres and one of cylinders, and two range rows."""
    corpus = golden()
    found: list[GoldenRow] = []
    for family in ("sphere-far", "sphere-tangent", "needle", "range-sphere"):
        some = [r for r in corpus.rows if r.family == family and "sound" in r.decisive]
        found += [r for r in some if len(r.decisive) == len(LEVELS)][:4]
    return tuple(found)


@cache
def good(id: str) -> Grade:
    row = next(row for row in rows() if row.id == id)
    return grade(row, Reply(id, intervals=row.expected), Hello("planted"))


def grades(failing: dict[str, Level], asked: tuple[GoldenRow, ...] | None = None) -> list[Grade]:
    """Return the grades of a run where some rows fail, from their level on."""
    found = []
    for row in rows() if asked is None else asked:
        first = LEVELS.index(failing[row.id]) if row.id in failing else len(LEVELS)
        found.append(replace(good(row.id), faults=dict.fromkeys(LEVELS[first:], "planted")))
    return found


def ids(family: str) -> list[str]:
    return [row.id for row in rows() if row.family == family]


def of(*listed: Expectation) -> Expectations:
    return Expectations(tuple(listed))


def entry(kind: str, name: str, level: Level | None = None) -> Expectation:
    return Expectation(kind, name, "known", "link", level)  # type: ignore[arg-type]


def run(expectations: Expectations, failing: dict[str, Level], level: Level = "stable") -> Matched:
    return match(expectations, grades(failing), level, "closed")


def usual() -> list[str]:
    return [row.id for row in rows() if row.tier != "range"]


def test_the_rows_are_what_the_tests_take_them_for() -> None:
    families = {row.family for row in rows()}
    assert len(families) == 4
    assert {row.tier for row in rows() if row.family == "range-sphere"} == {"range"}


failures = st.dictionaries(st.sampled_from(range(12)), st.sampled_from(LEVELS)).map(
    lambda found: {usual()[n]: level for n, level in found.items()}
)


@given(failures, failures, st.sampled_from(LEVELS))
def test_a_recorded_run_is_accepted_and_no_other(
    one: dict[str, Level], other: dict[str, Level], level: Level
) -> None:
    recorded = record(grades(one), level, "closed", "2026.1")
    assert run(recorded, one, level).accepted
    counted = [
        {id: of for id, of in found.items() if LEVELS.index(of) <= LEVELS.index(level)}
        for found in (one, other)
    ]
    assert run(recorded, other, level).accepted == (counted[0] == counted[1])


@given(failures, failures, st.sampled_from(LEVELS))
def test_recording_over_an_old_file_mends_it_and_keeps_what_holds(
    one: dict[str, Level], other: dict[str, Level], level: Level
) -> None:
    old = record(grades(one), level, "closed", "2025.1")
    new = record(grades(other), level, "closed", "2026.1", old)
    assert run(new, other, level).accepted
    for kept in old.entries:
        if other.get(kept.name) == kept.level:
            assert kept in new.entries


@given(failures, st.sampled_from(LEVELS))
def test_every_failure_is_expected_or_new(failing: dict[str, Level], level: Level) -> None:
    family = rows()[0].family
    found = run(of(entry("family", family)), failing, level)
    counted = {id for id, of in failing.items() if LEVELS.index(of) <= LEVELS.index(level)}
    assert set(found.expected) | set(found.new) == counted
    assert set(found.expected) == {id for id in counted if id.startswith(f"{family}/")}


def test_without_expectations_any_failure_is_new() -> None:
    assert run(of(), {}).accepted
    assert run(of(), {usual()[0]: "sound"}).new == (usual()[0],)
    assert run(of(), {usual()[0]: "faithful"}).accepted, "above the level that is asked"


def test_an_expected_failure_that_passes_is_a_failure() -> None:
    found = run(of(entry("id", usual()[0])), {})
    assert found.unexpected_passes == (f"{usual()[0]}: passes stable",)
    assert not found.accepted
    family = rows()[0].family
    assert run(of(entry("family", family)), {}).unexpected_passes
    assert run(of(entry("family", family)), {usual()[0]: "sound"}).accepted


def test_a_failure_worse_than_expected_is_new() -> None:
    found = run(of(entry("id", usual()[0], "stable")), {usual()[0]: "sound"})
    assert found.new == (f"{usual()[0]}: fails sound, expected to fail from stable on",)
    assert not found.unexpected_passes


def test_a_failure_better_than_expected_is_an_unexpected_pass() -> None:
    found = run(of(entry("id", usual()[0], "sound")), {usual()[0]: "stable"})
    assert found.unexpected_passes == (f"{usual()[0]}: passes sound, fails stable",)
    assert not found.new


def test_an_entry_above_the_level_asked_is_left_alone() -> None:
    known = of(entry("id", usual()[0], "exact"), entry("family", "needle", "faithful"))
    assert run(known, {}, "stable").accepted
    assert not run(known, {}, "exact").accepted


def test_an_entry_about_nothing_is_unmatched() -> None:
    cone = entry("convention", "slab")
    found = run(of(entry("id", "no/row"), entry("family", "none"), cone), {})
    assert found.unmatched == (
        "no/row: no such id is asked",
        "family none: no such family is asked",
        "convention slab: no such solid is asked",
    )


def test_an_id_is_no_family() -> None:
    assert run(of(entry("id", "needle")), {}).unmatched
    assert run(of(entry("family", usual()[0])), {}).unmatched


def test_rows_of_the_range_tier_are_part_of_no_level() -> None:
    [first, *_] = ids("range-sphere")
    assert run(of(), {first: "sound"}).accepted
    found = run(of(entry("id", first)), {first: "sound"})
    assert found.unmatched == (
        f"{first}: is of the range tier, or not what the target is for: part of no level",
    )


def test_what_lies_outside_the_part_asked_is_neither_matched_nor_missed() -> None:
    part = tuple(row for row in rows() if row.id != usual()[0])
    known = of(
        entry("id", usual()[0]), entry("family", rows()[0].family), entry("convention", "sphere")
    )
    assert match(known, grades({}, part), "stable", "closed", rows()).accepted
    alone = match(known, grades({}, part), "stable", "closed")
    assert alone.unmatched == (f"{usual()[0]}: no such id is asked",)
    assert len(alone.unexpected_passes) == 2


@dataclass(frozen=True)
class Touching:
    """All golden rows of spheres on the lattice, answered with or without touches."""

    keeps: bool

    @property
    def grades(self) -> list[Grade]:
        found = []
        for row in lattice():
            spans = zip(row.expected, row.intervals, strict=True)
            kept = tuple(pair for pair, span in spans if self.keeps or not span.touch)
            found.append(grade(row, Reply(row.id, intervals=kept), Hello("planted")))
        return found


@cache
def lattice() -> tuple[GoldenRow, ...]:
    rows = golden().rows
    return tuple(r for r in rows if r.tier == "lattice" and type_of(r.solid) == "sphere")


def test_a_convention_is_expected_by_the_type_of_solid() -> None:
    drops, known = Touching(keeps=False).grades, of(entry("convention", "sphere"))
    text = "sphere: convention is regularized, not closed"
    assert match(of(), drops, "stable", "closed").new == (text,)
    found = match(known, drops, "stable", "closed")
    assert found.expected == (text,)
    assert found.accepted
    assert match(known, Touching(keeps=True).grades, "stable", "closed").unexpected_passes == (
        "convention sphere: is closed",
    )
    recorded = record(drops, "stable", "closed", "2026.1")
    assert match(recorded, drops, "stable", "closed").accepted


def test_a_run_that_tells_nothing_is_not_accepted() -> None:
    assert match(of(), [], "sound", "closed").new == ("nothing was tested",)
    mute = [replace(g, decides=()) for g in grades({}, rows()[:2])]
    assert match(of(), mute, "stable", "closed").new == ("sphere: no row decides sound",)


def test_the_json_form() -> None:
    found = run(of(entry("id", usual()[0])), {usual()[0]: "sound", usual()[1]: "sound"})
    assert found.as_json("known.toml") == {
        "file": "known.toml",
        "expected": [usual()[0]],
        "unexpected_passes": [],
        "unmatched": [],
        "new": [usual()[1]],
    }
