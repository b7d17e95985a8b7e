"""The data of a map give back its cases and answers to the bit."""

import csv
import io
import json
from fractions import Fraction

import pytest

from raycert.cases.forms import read_ray, read_solid
from raycert.cases.model import Cylinder, Ray
from raycert.oracle.client.target import target
from raycert.oracle.map.legend import to_csv, to_json
from raycert.oracle.map.raster import Inputs, Raster
from raycert.oracle.map.sampling import Map, Show, sample

CASE = Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 1, 1), (1, 0, 0))


def made(show: Show) -> Map:
    inputs = Inputs(*CASE)
    axes = inputs.direction("ray.origin[1]"), inputs.direction("solid.radius=1,ray.origin[0]=-1")
    plan = Raster.of(inputs, axes, "units", Fraction(2), 4)
    return sample(plan, show, target(["raycert.reference.tracer:intersect"]))


@pytest.mark.parametrize("show", ["exact", "k", "disagreement"])
def test_json_gives_back_every_cell(show: Show) -> None:
    found = made(show)
    form = json.loads(json.dumps(to_json(found), allow_nan=False))
    assert (read_solid(form["case"]["solid"]), read_ray(form["case"]["ray"])) == CASE
    assert len(form["cells"]) == 25
    inputs = Inputs(*CASE)
    for row in form["cells"]:
        cell = found.cells[row["x"], row["y"]]
        values = {path: float.fromhex(x) for path, x in row["inputs"].items()}
        if cell.topology is None:
            assert row["refused"] == cell.refused
            continue
        assert inputs.probe(values) == found.raster.probe((row["x"], row["y"]))
        assert form["topologies"][row["topology"]]["label"] == cell.topology.label
        pairs = tuple((float.fromhex(a), float.fromhex(b)) for a, b in row["expected"])
        assert pairs == cell.expected
        assert row.get("value") == cell.value
        assert ("answer" in row) == (show != "exact")


def test_csv_has_a_line_a_cell() -> None:
    found = made("k")
    rows = list(csv.DictReader(io.StringIO(to_csv(found))))
    assert len(rows) == 25
    for row in rows:
        cell = found.cells[int(row["x"]), int(row["y"])]
        assert row["refused"] == cell.refused
        if not cell.refused:
            assert float(row["k"]) == cell.value
            assert int(row["pairs"]) == len(cell.expected)


def test_the_same_map_has_the_same_bytes() -> None:
    assert to_csv(made("exact")) == to_csv(made("exact"))
