"""Each section is a table of plain data; aims that are missed are marked."""

from __future__ import annotations

import json
import sys
from typing import Any

import numpy as np
import pytest

from raycert.cases.model import Cylinder, Ray
from raycert.oracle.client.dialogue import Question
from raycert.oracle.measure import sections
from raycert.oracle.measure.files import Effort, Report
from raycert.oracle.measure.pictures import costs
from raycert.oracle.measure.rays import ARRAYS, LEAVES, arrays, rays_of
from raycert.oracle.measure.sections import SECTIONS, aimed, command, lines, over, price, steps
from raycert.oracle.measure.way import missing, questions
from shared.places import CLIENTS

TINY = Effort(4, 0, 1, 0.1, 500, (8, 5), (16, 12), 2, 6)
CHEAP = ("batch", "libraries", "scenes", "pipe")
SHARES = {"float64": 0.5, "double-double": 0.5, "rational": 0.0, "integer": 0.0}


def met(name: str, integer: float = 0.0, **ratios: float) -> dict[str, bool]:
    row = {"ratios": ratios, "shares": SHARES | {"integer": integer}}
    found: dict[str, bool] = aimed(row, name)["met"]
    return found


def test_aims_on_ratios_hold_for_random_rays_and_the_engines_there() -> None:
    fine = {"numpy": True, "numba": True, "integer": True}
    assert met("random", numpy=8.0, numba=1.0) == fine
    assert met("random", numpy=8.1, numba=1.1) == fine | {"numpy": False, "numba": False}
    assert met("random", numpy=3.0) == {"numpy": True, "integer": True}
    assert met("far", numpy=9.0, numba=2.0) == {"integer": True}


@pytest.mark.parametrize(
    ("name", "share", "fine"),
    [
        ("far", 0.00009, True),
        ("far", 0.0001, False),
        ("axis-aligned", 0.009, True),
        ("axis-aligned", 0.01, False),
    ],
)
def test_aims_at_the_integers(name: str, share: float, fine: bool) -> None:
    assert met(name, share) == {"integer": fine}


def cells(name: str, row: dict[str, Any]) -> dict[str, str]:
    columns = (*SECTIONS[name].words, *SECTIONS[name].figures)
    return {title: spell(row) for title, spell in columns}


def test_missed_aims_and_other_bits_are_marked() -> None:
    row = {"solid": "sphere", "scenario": "random", "rays": 9, "naive_ns": 100.0}
    row |= aimed({"ratios": {"numpy": 9.5, "numba": 0.5}, "shares": SHARES}, "random")
    shown = cells("batch", row)
    assert (shown["numpy"], shown["numba"], shown["float64"]) == ("! 9.5", "0.5", "50")
    scene = {"solids": 3, "size": (4, 4), "planned_us": 1.0, "plain_us": 2.0, "ratio": 2.0}
    assert cells("scenes", scene | {"same": False})["same"] == "NO"
    library = {"cast": "camera", "question": "first", "library": "embreex", "interface": "run"}
    library |= {"facets": 256, "rays": 9, "ns": 1.0, "ratio": 1.0, "wrong": 0.0, "error": None}
    assert cells("libraries", library)["library"] == "embreex, 256"


@pytest.mark.parametrize("name", CHEAP)
def test_a_section_makes_rows_that_are_plain_data(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sections, "CLIENTS", {"constant": sections.CLIENTS["constant"]})
    monkeypatch.setattr(sections, "_compiled", lambda folder, notes: {})
    report, done = Report(1, TINY), list[None]()
    sections.run(name, report, lambda: done.append(None))
    assert not report.interrupted
    form = json.loads(json.dumps(report.as_json(), allow_nan=False))
    assert form["sections"][name]
    assert form["environment"]["packages"]["numpy"] == np.__version__
    for row in report.sections[name]:
        assert all(cells(name, row).values())
    assert len(done) == steps(name, TINY) - (name == "pipe")
    if name == "batch":
        assert len({(r["solid"], r["scenario"]) for r in report.sections[name]}) == len(done)


def test_what_is_measured_survives_an_interruption() -> None:
    def stop() -> None:
        raise KeyboardInterrupt

    report = Report(1, TINY)
    sections.run("scenes", report, stop)
    assert report.interrupted
    assert len(report.sections["scenes"]) == 1


def test_lanes_are_shared_out_among_the_rungs() -> None:
    row = price("far", arrays(LEAVES[1], ARRAYS[1], 500, 1), ["numpy"], TINY)
    assert sum(row["shares"].values()) == pytest.approx(1)
    assert row["rays"] == 500
    assert 0 < row["hits"] < 1


def test_the_scalar_section_is_a_race_over_three_sets() -> None:
    report = Report(1, TINY)
    sections.run_scalar(report)
    rows = report.sections["scalar"]
    assert {row.scenario for row in rows} == set(sections.SINGLE_SETS)
    for row in rows:
        assert row.sample == 0
        assert row.exact == 4 or row.way.name in ("arb", "mpmath-50", "mpmath-intervals")
        assert row.ratio == 1 or row.way.name != "oracle"


def test_what_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        sections, "missing", lambda names: [name for name in names if name != "numpy"]
    )
    report = Report(1, TINY)
    rows = next(sections.SECTIONS["libraries"].rows(report))
    assert {row["library"] for row in rows} == {"reference, batched", "oracle, batched"}
    assert "libraries: raysect: not installed: raysect" in report.notes
    assert missing(["numpy", "no_such_package"]) == ["no_such_package"]


def test_pictures_are_the_same_with_the_plan() -> None:
    rows = list(costs((16, 12), 5, 1))
    assert [row["solids"] for row in rows] == [1, 2, 5]
    assert all(row["same"] for row in rows)
    assert all(row["ratio"] == pytest.approx(row["plain_us"] / row["planned_us"]) for row in rows)


def test_a_picture_that_is_not_the_same_is_seen() -> None:
    def draw(scene: object, show: str, off: frozenset[str]) -> Any:
        return np.full(4, 1.0 + 2.0**-52 * bool(off))

    assert [row["same"] for row in costs((2, 2), 1, 1, draw)] == [False]


def test_the_lines_are_a_hello_and_the_questions() -> None:
    asked = questions(rays_of("random", 8))
    hello, *each = map(json.loads, lines(sections.CLIENTS["constant"], asked).splitlines())
    assert hello == {"hello": 1}
    assert [line["ray"]["origin"] for line in each] == [list(one.ray.origin) for one in asked]


def test_a_client_that_fails_is_not_timed() -> None:
    can = Cylinder((0, 0, 0), (0, 0, 1), 1)
    counted = [Question(str(n), can, Ray((n, 0, 0), (0, 0, 1))) for n in range(6)]
    faulty = [sys.executable, str(CLIENTS / "raw.py"), "no-id"]
    with pytest.raises(ValueError, match="fails on some"):
        over(faulty, counted, 1)


def test_a_whole_command_is_timed() -> None:
    row = command("--help", 2)
    assert row["command"] == "raycert --help"
    assert 0 < row["seconds"] <= row["median"]
    assert cells("commands", row)["command"] == "raycert --help"
