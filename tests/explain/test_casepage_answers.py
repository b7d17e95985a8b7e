"""An implementation is asked one case: graded, or the reason stands in place of the answer."""

from pathlib import Path

from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Intersection, Ray, Solid, Sphere
from raycert.oracle.client.dialogue import Command
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.explain.casepage import ask
from raycert.oracle.explain.derive import derive, given

CAN = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 1.0)
RAY = Ray((-3.0, 0.25, 1.0), (1.0, 0.0, 0.0))
ROW = derive(given(CAN, RAY), BINARY64).row
SPHERES = """
import json, sys
for line in sys.stdin:
    form = json.loads(line)
    print(json.dumps({{"hello": 1, "name": "balls", "solids": {solids}, "precision": "{precision}"}}
          if "hello" in form else {{"id": form["id"], "intervals": []}}), flush=True)
"""


def balls(folder: Path, solids: str = '["sphere"]', precision: str = "binary64") -> Command:
    path = folder / "balls.py"
    path.write_text(SPHERES.format(solids=solids, precision=precision))
    return Command(("python3", str(path)))


def found(solid: Solid, ray: Ray) -> list[tuple[float, float]]:
    """Return what is right for the row."""
    return list(ROW.expected)


def test_an_answer_is_graded() -> None:
    asked = ask(
        "tracer", InProcess("callable", "raycert.reference.tracer:intersect"), ROW, "binary64"
    )
    assert asked.word == "tracer"
    assert asked.grade is not None
    assert asked.grade.answer == ROW.expected
    assert not asked.grade.faults


def test_a_wrong_answer_is_graded_too(tmp_path: Path) -> None:
    asked = ask("balls", balls(tmp_path, '["cylinder"]'), ROW, "binary64")
    assert asked.grade is not None
    assert "sound" in asked.grade.faults


def test_what_is_not_asked_says_why(tmp_path: Path) -> None:
    asked = ask("b", balls(tmp_path), ROW, "binary64")
    assert (asked.name, asked.grade) == ("balls", None)
    assert asked.reason == "not asked: it does not declare cylinder"
    both = derive(given(Intersection((Sphere((0.0, 0.0, 0.0), 1.0), CAN)), RAY), BINARY64).row
    missing = ask("b", balls(tmp_path), both, "binary64").reason
    assert missing == "not asked: it does not declare cylinder, intersection"
    other = ask("b", balls(tmp_path, precision="binary32"), ROW, "binary64").reason
    assert "--precision binary32" in other


def test_what_does_not_run_says_why() -> None:
    asked = ask("none", Command(("/no/such/program",)), ROW, "binary64")
    assert asked.grade is None
    assert asked.reason.startswith("could not be run: ")
