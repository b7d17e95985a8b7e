"""The report as data: strict JSON, one row a point, in the order of the plan."""

import csv
import io
import json
from functools import cache

from raycert.oracle.measure.methods.catalog import by_name
from raycert.oracle.measure.stress.report import form, notes, range_rows, rows, table
from raycert.oracle.measure.stress.run import Plan, Report, run
from raycert.oracle.measure.stress.sagitta import Sides
from raycert.oracle.measure.stress.sweeps import SWEEPS

PLAN = Plan(
    (by_name("textbook"), by_name("seed"), by_name("oracle")),
    (SWEEPS["far"], SWEEPS["speed"]),
    quick=True,
    workers=1,
)


@cache
def report() -> Report:
    return run(PLAN, lambda: None)


def test_it_is_json_without_extensions() -> None:
    sides = [Sides("trimesh", 8, 0.05, 0), Sides("trimesh", 16, float("nan"), 3)]
    found = json.loads(json.dumps(form(report(), sides), allow_nan=False))
    assert found["complete"]
    assert (found["seed"], found["samples"], found["quick"]) == (1, PLAN.count, True)
    assert {"tool", "python", "machine"} <= set(found["environment"])
    assert [sweep["name"] for sweep in found["sweeps"]] == ["far", "speed"]
    assert found["meshes"]["rows"][1]["error"] is None
    assert found["meshes"]["slopes"]["trimesh"] is None
    speed = found["sweeps"][1]
    assert speed["steps"][0]["step"] == "2^-1000"
    assert speed["steps"][0]["value"] == 2.0**-1000


def test_a_row_for_every_method_and_step() -> None:
    found = list(rows(report()))
    assert len(found) == PLAN.total * len(PLAN.methods)
    assert found[0]["sweep"] == "far"
    assert [row["step"] for row in found[:3]] == ["1e0", "1e3", "1e6"]
    last = found[-1]
    assert (last["method"], last["step"], last["exact"]) == ("oracle", "2^1000", PLAN.count)
    overflown = next(r for r in found if r["method"] == "seed" and r["step"] == "2^1000")
    assert overflown["strict"] is None
    assert overflown["condition"] > 0


def test_the_table_is_the_rows() -> None:
    read = list(csv.DictReader(io.StringIO(table(report()))))
    assert len(read) == PLAN.total * len(PLAN.methods)
    assert read[0]["sweep"] == "far"
    assert "" in {row["strict"] for row in read}
    assert table(Report(PLAN)).startswith("sweep,step,value,method")


def test_ranges_say_where_it_breaks_and_why() -> None:
    found = {(row["sweep"], row["method"]): row for row in range_rows(report())}
    far, speed = found["far", "textbook"], found["speed", "textbook"]
    assert far["stable"]["text"] == "to 1e0"
    assert far["stable"]["breaks_at"] == ["1e3"]
    assert far["sound"]["whole"]
    [cause] = far["causes"]
    assert cause["cause"] == "cancellation in the discriminant"
    assert cause["restored"][cause["told_by"]] == cause["broken"]
    assert [cause["at"] for cause in speed["causes"]] == ["2^-600", "2^600"]
    assert found["speed", "oracle"]["exact"]["whole"]
    assert found["speed", "oracle"]["causes"] == []


def test_notes_join_methods_that_break_alike() -> None:
    found = notes(report(), ["textbook", "seed", "oracle"])
    assert len(found) == 2
    assert found[0].startswith("start far from the solid: textbook stable to 1e0; ")
    assert "textbook, seed stable 2^-450 .. 2^450; over- or underflow" in found[1]


def test_nothing_known_is_a_report_too() -> None:
    empty = form(Report(PLAN, interrupted=True))
    assert not empty["complete"]
    assert empty["rows"] == []
    assert empty["ranges"] == []
