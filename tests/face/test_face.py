"""`import raycert` costs nothing, names what a person wants, and shows what can be pasted back."""

from __future__ import annotations

import ast
import pydoc
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given

import raycert
from raycert.answers import Explanation
from raycert.cases import strategies
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.numbers import Probe
from raycert.trials import Certification

CAN = raycert.Cylinder((0, 0, 0), (0, 0, 2), 1)
ASIDE = raycert.Ray((-3, 0.5, 1), (1, 0, 0))


def everything() -> dict[str, Any]:
    """Return what `from raycert import *` gives."""
    given: dict[str, Any] = {}
    exec("from raycert import *", given)
    return given


def python(*words: str) -> str:
    done = subprocess.run([sys.executable, *words], capture_output=True, text=True, check=True)
    return done.stdout


def test_the_star_gives_the_public_names_and_no_others() -> None:
    assert set(everything()) - {"__builtins__"} == set(raycert.__all__) == set(dir(raycert))
    with pytest.raises(AttributeError, match="no attribute 'sphere'"):
        raycert.sphere  # type: ignore[attr-defined]  # noqa: B018


def test_the_type_checker_is_told_the_same_names() -> None:
    source = ast.parse(Path(raycert.__file__).read_text("utf-8"))
    [block] = [node for node in source.body if isinstance(node, ast.If)]
    lines = [node for node in block.body if isinstance(node, ast.ImportFrom)]
    homes = {alias.name: node.module for node in lines for alias in node.names}
    assert homes == raycert._HOME
    assert sorted(homes) == sorted(raycert.__all__)


def test_every_public_name_has_an_example() -> None:
    for name in raycert.__all__:
        assert ">>>" in (getattr(raycert, name).__doc__ or ""), name


def test_help_teaches_every_public_name() -> None:
    text = pydoc.plain(pydoc.render_doc(raycert))
    assert "Where a ray is inside a solid" in text
    assert all(name in (raycert.__doc__ or "") for name in raycert.__all__)


def test_importing_it_loads_nothing_else() -> None:
    loaded = python("-c", "import sys, raycert; print(*sys.modules)").split()
    assert [name for name in loaded if name.startswith("raycert")] == ["raycert"]
    loaded = python("-c", "import sys, raycert; raycert.trace; print(*sys.modules)").split()
    assert not {"numpy", "rich", "jinja2", "sympy", "mpmath"} & set(loaded)


def test_it_runs_as_a_module() -> None:
    assert "certify" in python("-m", "raycert", "--help")


@given(strategies.scenes())
def test_what_is_shown_can_be_pasted_back(scene: Any) -> None:
    solid, ray = scene
    found = raycert.trace(solid, ray)
    for thing in (solid, ray, found):
        assert eval(repr(thing), everything()) == thing


def test_a_trace_is_a_sequence_of_intervals_and_a_set_of_numbers() -> None:
    found = raycert.trace(CAN, ASIDE)
    [(enter, leave)] = found
    assert found[0] == (enter, leave) in found
    assert len(found) == 1
    assert [3 in found, Fraction(3) in found, 3.0 in found, 5 in found] == [True] * 3 + [False]
    assert raycert.expected(CAN, ASIDE) == ((float(enter), float(leave)),)
    assert str(raycert.trace(raycert.Slab((0, 0, 0), (0, 0, 2)), ASIDE)) == "[0, inf)"
    assert str(raycert.trace(CAN, raycert.Ray((3, 0, 0), (1, 0, 0)))) == "no intersection"


def test_numbers_of_numpy_are_taken() -> None:
    np = pytest.importorskip("numpy")
    ray = raycert.Ray(np.array([-3, 0.5, 1]), np.array([1, 0, 0]))
    can = raycert.Cylinder(np.zeros(3), np.array([0, 0, 2], "f4"), np.float32(1))
    assert raycert.trace(can, ray) == raycert.trace(CAN, ASIDE)
    assert raycert.intersect(can, ray) == raycert.intersect(CAN, ASIDE)


def test_in_a_notebook_answers_draw_themselves() -> None:
    for shown in (raycert.trace(CAN, ASIDE), raycert.explain(CAN, ASIDE)):
        page = shown._repr_html_()
        assert page.startswith("<iframe sandbox")
        assert "&lt;svg" in page
        assert "<script" not in page
    assert raycert.trace(CAN, raycert.Ray((3, 0, 0), (1, 0, 0)))._repr_html_()


def test_an_explanation_reads_as_the_command_prints_it() -> None:
    shown = raycert.explain(CAN, ASIDE)
    assert isinstance(shown, Explanation)
    assert "Problem 1" in str(shown)


def test_read_takes_every_form_of_the_project() -> None:
    solid, ray = write_solid(CAN), write_ray(ASIDE)
    assert raycert.read(solid) == CAN
    assert raycert.read(ray) == ASIDE
    assert raycert.read({"id": "7", "solid": solid, "ray": ray}) == Probe(CAN, ASIDE)
    assert raycert.read({"solid": write_solid(CAN, "hex"), "ray": write_ray(ASIDE, "hex")}) == (
        CAN,
        ASIDE,
    )
    id = "tangent-exact/cylinder-straight-ahead-on-z"
    row = python("-m", "raycert", "show", id, "--json", "-")
    assert raycert.read(row).id == id
    for wrong in ("{", "[1]", {"type": "cone"}, {"solid": solid}):
        with pytest.raises(ValueError, match=r"is not|is missing"):
            raycert.read(wrong)  # type: ignore[arg-type]


def test_a_function_of_the_prompt_is_certified_where_it_is() -> None:
    def sound(solid: raycert.Union, ray: raycert.Ray) -> Any:
        return raycert.intersect(solid, ray)

    def breaks(solid: raycert.Union, ray: raycert.Ray) -> Any:
        raise ZeroDivisionError("no axis")

    granted = raycert.certify(sound, "stable", families=["rim"])  # type: ignore[arg-type]
    refused = raycert.certify(breaks, families=["rim"])  # type: ignore[arg-type]
    assert isinstance(granted, Certification)
    assert granted
    assert not granted.reasons
    assert granted.certificate["granted"] is False  # a part of the cases makes no certificate
    assert not refused
    assert "ZeroDivisionError: no axis" in str(refused)
    with pytest.raises(ValueError, match="not in the corpus: no-such"):
        raycert.certify(sound, families=["no-such"])  # type: ignore[arg-type]
