"""Verdicts on tracers that are known: each fault refused for its reason, each sound one granted."""

import json
import sys
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner

from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.domain import Tolerance
from raycert.cases.levels import Level
from raycert.cases.model import Ray, Solid, type_of
from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.verdict import Touches, by_family, by_solid, verdict
from raycert.oracle.client.process import Failure
from raycert.oracle.commands.certify import certify
from raycert.oracle.commands.main import main
from raycert.oracle.zoo import inhabitants
from raycert.oracle.zoo.inhabitants import BY_NAME
from raycert.reference.tracer import intersect
from shared.corpus import golden

Intersect = Callable[[Solid, Ray], Iterable[tuple[float, float]]]
HELLO = Hello("a tracer", degenerate=DEGENERACIES)
SOUND = {animal.name: animal.tracer for animal in inhabitants.SOUND}
SOLIDS = ("half_space", "slab", "infinite_cylinder", "cylinder")


def rows() -> list[GoldenRow]:
    return [row for row in golden().rows if type_of(row.solid) in SOLIDS]


@cache
def grades(tracer: Intersect) -> tuple[Grade, ...]:
    return tuple(grade(row, outcome(tracer, row), HELLO) for row in rows())


def outcome(tracer: Intersect, row: GoldenRow) -> Reply | Failure:
    try:
        return Reply(row.id, intervals=tuple(tracer(row.solid, row.ray)))
    except ArithmeticError as error:
        return Failure("crash", repr(error))


def failing(graded: Iterable[Grade], level: Level) -> dict[str, int]:
    """Return how many rows of each family fail a level, those of the range tier left out."""
    failed = [g for g in graded if g.fault(level) and g.row.tier != "range"]
    return {group.name: len(group.grades) for group in by_family(failed)}


@pytest.mark.parametrize("name", ["projected", "local-frame"])
def test_sound_tracers_are_stable(name: str) -> None:
    judged = verdict(grades(SOUND[name]), "stable", "closed")
    assert judged.granted, judged.reasons


def test_the_reference_is_stable_and_closed() -> None:
    judged = verdict(grades(intersect), "stable", "closed")
    assert judged.granted, judged.reasons
    assert not verdict(grades(intersect), "exact", "closed").granted


def test_the_textbook_is_sound_and_not_stable_far_away_and_on_needles() -> None:
    graded = grades(SOUND["textbook"])
    assert verdict(graded, "sound", "closed").granted
    judged = verdict(graded, "stable", "closed")
    assert not judged.granted
    families = failing(graded, "stable")
    assert {"far-deep", "far-off-axis", "needle"} <= set(families), families
    assert any("far-deep" in reason for reason in judged.reasons)


@pytest.mark.parametrize(
    ("name", "family", "solids"),
    [
        ("caps-forgotten", "perpendicular", ("cylinder",)),
        ("parallel-missed", "parallel", ("cylinder", "infinite_cylinder")),
        ("no-clip", "behind", SOLIDS),
        ("swapped", "start-inside", SOLIDS),
    ],
)
def test_faults_are_refused_everything(name: str, family: str, solids: tuple[str, ...]) -> None:
    graded = grades(BY_NAME[name].make())
    for level in ("sound", "stable", "faithful", "exact"):
        judged = verdict(graded, level, "closed")  # type: ignore[arg-type]
        assert not judged.granted
    assert family in failing(graded, "sound"), failing(graded, "sound")
    for group in by_solid(graded):
        if group.name in solids:
            assert group.granted() is None, (name, group.name)


def test_a_tracer_that_drops_touches_is_regularized() -> None:
    def regularized(solid: Solid, ray: Ray) -> list[tuple[float, float]]:
        row = next(r for r in rows() if r.solid is solid and r.ray is ray)
        return [
            pair
            for pair, span in zip(row.expected, row.intervals, strict=True)
            if span.touch is None
        ]

    lattice = [row for row in rows() if row.tier == "lattice"]
    graded = [
        grade(row, Reply(row.id, intervals=tuple(regularized(row.solid, row.ray))), HELLO)
        for row in lattice
    ]
    assert Touches.of(graded).name == "regularized"
    assert verdict(graded, "stable", "regularized").granted
    judged = verdict(graded, "stable", "closed")
    assert not judged.granted
    assert all("convention" in reason for reason in judged.reasons)


def test_every_kind_of_touch_is_in_the_corpus() -> None:
    touches = Touches.of(grades(intersect))
    assert set(touches.kept) == {"tangent", "wall", "cap", "rim", "start"}
    assert all(kept == of >= 6 for kept, of in touches.kept.values())


def test_nothing_tested_is_never_granted() -> None:
    judged = verdict([], "sound", "closed")
    assert not judged.granted
    assert judged.reasons == ("nothing was tested",)


def client(folder: Path, name: str) -> list[str]:
    """Write a program that serves one of the planted tracers."""
    script = folder / "client.py"
    script.write_text(
        "from raycert.oracle.zoo.inhabitants import BY_NAME\n"
        "from raycert.cases.protocol import Hello\n"
        "from raycert.cases.protocol import serve\n"
        f"serve({name}, Hello('planted', solids={SOLIDS!r}))\n"
    )
    return [sys.executable, str(script)]


def test_the_report_names_family_row_and_how_to_repeat(tmp_path: Path) -> None:
    out = tmp_path / "certificate.json"
    command = client(tmp_path, "BY_NAME['caps-forgotten'].make()")
    options = ["--family", "perpendicular", "--out", str(out), "--", *command]
    result = CliRunner().invoke(certify, options)
    assert result.exit_code == 1, result.output
    assert "perpendicular" in result.output
    assert "is not granted sound" in result.output
    form = json.loads(out.read_text())
    assert not form["granted"]
    assert form["selection"] == ["--family", "perpendicular"]
    failure = form["failures"][0]
    assert failure["id"] in failure["reproduce"]
    assert failure["id"] in result.output
    assert failure["solid"]["type"] == "cylinder"


def test_a_part_of_the_corpus_is_no_certificate(tmp_path: Path) -> None:
    out = tmp_path / "certificate.json"
    options = ["oracle", "--level", "exact", "--tier", "lattice", "--out", str(out)]
    result = CliRunner().invoke(certify, options)
    assert result.exit_code == 0, result.output
    assert "not a certificate" in " ".join(result.output.split())
    form = json.loads(out.read_text())
    assert form["passed"]
    assert not form["granted"]
    assert form["not_tested"]["rows"] == len(golden().rows) - form["tested"]


@pytest.mark.parametrize(
    ("options", "code", "words"),
    [
        (["--", "no-such-program-anywhere"], 3, "no-such-program-anywhere"),
        (["reference", "--convention", "open"], 2, "closed or regularized"),
        (["reference", "--id", "no/such-row"], 2, "not in the corpus: no/such-row"),
        (["reference", "--golden", "."], 2, "manifest"),
        ([], 2, "Missing argument"),
    ],
)
def test_bad_usage_says_what_is_wrong(
    options: list[str], code: int, words: str, tmp_path: Path
) -> None:
    result = CliRunner().invoke(main, ["certify", *options, "--out", str(tmp_path / "c.json")])
    assert result.exit_code == code, result.output
    assert words in result.output


def test_a_tolerance_beyond_c_decides_nothing() -> None:
    """A tolerance that swallows the solid buys no level; a fine one leaves its rows to decide."""
    rows = [row for row in golden().rows if row.family == "perpendicular"]
    for tolerance, decided in ((1e300, False), (2.0**-40, True)):
        hello = Hello("tolerant", tolerance=Tolerance(tolerance))
        graded = [grade(row, Reply(row.id, intervals=row.expected), hello) for row in rows]
        curved = [g for g in graded if type_of(g.row.solid) == "cylinder"]
        assert curved
        assert all(g.counts("stable") == decided for g in curved)
        assert verdict(curved, "stable", "closed").granted == decided


def test_an_answer_within_the_tolerance_is_stable_and_beyond_it_is_not() -> None:
    crossed = (r for r in golden().rows if r.family == "perpendicular" and r.expected)
    row = next(row for row in crossed if 0 < row.expected[0][0] < row.expected[0][1] < 99)
    off = tuple((a - 2.0**-41, b + 2.0**-41) for a, b in row.expected)
    for tolerance, right in ((2.0**-36, True), (0.0, False)):
        hello = Hello("tolerant", tolerance=Tolerance(tolerance))
        graded = grade(row, Reply(row.id, intervals=off), hello)
        assert (graded.fault("stable") is None) == right


def test_a_row_of_no_level_tests_nothing(tmp_path: Path) -> None:
    options = ["oracle", "--tier", "range", "--out", str(tmp_path / "c.json")]
    result = CliRunner().invoke(certify, options)
    assert result.exit_code == 3, result.output
    assert "nothing was tested" in result.output


def test_a_certificate_that_cannot_be_written_is_refused_before_the_run(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    result = CliRunner().invoke(certify, ["oracle", "--out", str(tmp_path / "file" / "c.json")])
    assert result.exit_code == 2, result.output
    assert "cannot write" in " ".join(result.output.split())
