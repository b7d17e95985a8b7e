"""Each library is asked what it can answer; planted wrong answers are seen."""

from __future__ import annotations

from math import cos, nan, pi

import numpy as np
import pytest

from raycert.cases.model import Ray
from raycert.oracle.measure.casters import (
    CASTERS,
    CASTS,
    FACETS,
    QUESTIONS,
    Cast,
    Caster,
    RayHits,
    cast,
    check,
)
from raycert.oracle.measure.sections import answers
from raycert.oracle.measure.way import Case, exact

SIZE = (16, 10)
MESHED = ("trimesh, Embree", "embreex")


@pytest.fixture(scope="module", params=CASTS)
def asked(request: pytest.FixtureRequest) -> Cast:
    return cast(request.param, SIZE, 1)


def test_rays_start_outside_and_their_hits_are_the_scalar_oracles(asked: Cast) -> None:
    found = asked.exact("all")
    assert len(found.t) > 10
    assert (found.t > 0).all()
    for i, (u, v) in enumerate(zip(asked.origins.tolist(), asked.directions.tolist(), strict=True)):
        case = Case(asked.solid, Ray(tuple(u), tuple(v)))
        ends = [t for pair in exact(*case) for t in pair]
        assert found.t[found.ray == i].tolist() == ends
        first = asked.exact("first")
        assert first.t[first.ray == i].tolist() == ends[:1]
    if asked.scene is not None:
        assert (asked.origins == asked.origins[0]).all()
        assert len(asked.origins) == SIZE[0] * SIZE[1]


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("caster", CASTERS, ids=lambda caster: caster.name)
def test_each_library_answers_the_question_as_well_as_it_can(
    asked: Cast, caster: Caster, question: str
) -> None:
    """A formula in doubles is right; a mesh is, where its facets are, in binary32."""
    for package in caster.needs:
        pytest.importorskip(package)
    way = caster.way(asked, question)
    if way is None:
        assert caster.name == "embreex" or (question, asked.inner) != ("first", None)
        return
    found = way.read(way.run())
    wrong, error = check(found, asked.exact(question), len(asked.origins))
    assert error is not None
    if caster.name in MESHED:
        assert wrong == 0
        on_the_surface(asked, found)
        return
    assert wrong == 0
    assert error < 1e-9  # raysect's own epsilon, and the largest of these casters
    assert caster.name != "oracle, batched" or error == 0


def on_the_surface(asked: Cast, found: RayHits) -> None:
    """Assert that each hit is on a face, or on the facet within: binary32 at 32 about a mesh."""
    loose = 32 * 2.0**-22
    p, q = np.array(asked.outer.p), np.array(asked.outer.q)
    n = (q - p) / np.linalg.norm(q - p)
    y = asked.origins[found.ray] + found.t[:, None] * asked.directions[found.ray] - p
    height, across = y @ n, np.linalg.norm(y - (y @ n)[:, None] * n, axis=1)
    on = (abs(height) < loose) | (abs(height - np.linalg.norm(q - p)) < loose)
    for wall in (asked.outer, asked.inner):
        if wall is not None:
            on |= (across < wall.radius + loose) & (across > wall.radius * cos(pi / FACETS) - loose)
    assert on.all()


TRUTH = RayHits(np.array([0, 0, 2, 2]), np.array([1.0, 2.0, 3.0, 4.0]))


@pytest.mark.parametrize(
    ("ray", "t", "verdict"),
    [
        ([0, 0, 2, 2], [1, 2, 3, 4], (0.0, 0.0)),
        ([2, 0, 2, 0], [4, 2, 3, 1], (0.0, 0.0)),
        ([0, 0, 2, 2], [1, 2, 3, 5], (0.0, 0.25)),
        ([0, 0, 2], [1, 2, 3], (0.25, 0.0)),
        ([0, 0, 2, 2, 3], [1, 2, 3, 4, 9], (0.25, 0.0)),
        ([0, 0, 2, 2], [1, 2, 3, nan], (0.25, 0.0)),
        ([1, 1, 3, 3], [1, 2, 3, 4], (1.0, None)),
        ([], [], (0.5, None)),
    ],
)
def test_a_planted_fault_is_wrong_or_an_error(
    ray: list[int], t: list[float], verdict: tuple[float, float | None]
) -> None:
    found = RayHits(np.array(ray, int), np.array(t, float))
    assert check(found, TRUTH, 4) == verdict


def test_rows_are_in_units_of_the_reference() -> None:
    ours = [one for one in CASTERS if one.needs == ("numpy",)]
    pipe = cast("pipe", (6, 4), 1)
    for question in QUESTIONS:
        first, second = answers(pipe, question, 1, ours)
        assert (first["question"], second["question"]) == (question, question)
        assert first["ratio"] == 1
        assert second["ratio"] == pytest.approx(second["ns"] / first["ns"])
