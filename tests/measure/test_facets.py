"""Meshes: prisms come nearer as 1 / n^2, and what is no chord is a failure."""

from __future__ import annotations

from itertools import pairwise
from math import cos, isclose, isnan, nan, pi

import pytest

from raycert.cases.model import Cylinder, Ray
from raycert.oracle.measure.catalog import BY_NAME, WAYS, here
from raycert.oracle.measure.errors import referees
from raycert.oracle.measure.facets import Sides, chord, curves, slope
from raycert.oracle.measure.facets import referees as asked
from raycert.oracle.measure.rays import rays_of
from raycert.oracle.measure.way import Case, Way

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)

MESHES = [m for m in WAYS if m.precision == "mesh"]


def caster(name: str) -> None:
    pytest.importorskip("trimesh")
    pytest.importorskip("rtree")
    if name == "embree":
        pytest.importorskip("embreex")


@pytest.mark.parametrize("name", ["trimesh", "embree"])
def test_prisms_come_nearer_as_the_square_of_their_sides(name: str) -> None:
    """The rays meet the wall at cosines above 0.9, and go a tenth up."""
    caster(name)
    cases = [Case(CAN, Ray((-3, 0.02 * i - 0.4, 1.1), (1, 0.01, 0.1))) for i in range(40)]
    truth = referees(cases)
    errors = []
    for n in (16, 64, 256):
        answers = BY_NAME[f"{name}-{n}"].solve(cases)
        errors.append(max(j.radii(a) for a, j in zip(answers, truth, strict=True)))
    for coarse, fine in pairwise(errors):
        assert 10 < coarse / fine < 25
    assert errors[0] < 1.1 * (1 - cos(pi / 16)) / 0.9


@pytest.mark.parametrize("name", ["trimesh", "embree"])
def test_a_cast_from_inside_starts_at_zero_and_a_miss_is_empty(name: str) -> None:
    caster(name)
    inside, past = Ray((0.1, 0.2, 0.9), (1, 0.1, 0.2)), Ray((-3, 5, 1), (1, 0, 0.1))
    mine, miss = BY_NAME[f"{name}-512"].solve([Case(CAN, inside), Case(CAN, past)])
    [(_, leave)] = BY_NAME["oracle"].solve([Case(CAN, inside)])[0] or ()
    assert mine is not None
    assert mine[0][0] == 0.0
    assert isclose(mine[0][1], leave, rel_tol=1e-4)
    assert miss == ()


@pytest.mark.parametrize("name", ["tiny", "huge"])
def test_a_caster_that_cannot_take_the_numbers_fails_and_does_not_raise(name: str) -> None:
    caster("trimesh")
    cases = rays_of(name, 12)
    assert len(BY_NAME["trimesh-8"].solve(cases)) == 12


def test_hits_that_are_no_chord_are_a_failure() -> None:
    assert chord([(1.0, True), (2.0, False)]) == ((1.0, 2.0),)
    assert chord([(1.0, True), (1.0 + 1e-12, True), (2.0, False)]) == ((1.0, 2.0),)
    for hits in (
        [(1.0, True)],
        [(1.0, False), (2.0, True)],
        [(1.0, True), (2.0, False), (3.0, True)],
        [(nan, True), (2.0, False)],
    ):
        assert chord(hits) is None


@pytest.mark.parametrize("method", MESHES[::5], ids=lambda m: m.name)
def test_meshes_answer_capped_cylinders_only(method: Way) -> None:
    assert method.solids == {"cylinder"}
    assert not method.stress


def test_the_error_of_a_mesh_falls_as_one_over_n_squared() -> None:
    ways, advanced = {way.name: way for way in here(WAYS)[0]}, list[None]()
    found = curves(ways, 1, lambda: advanced.append(None), 128)
    assert [one.n for one in found if one.caster == "trimesh"] == [8, 16, 32, 64, 128]
    assert len(advanced) == len(found)
    assert all(one.lost == 0 for one in found)
    for caster in {one.caster for one in found}:
        assert -2.1 < slope(found, caster) < -1.9
    for one in found:
        assert one.error < 1.2 * (1 - cos(pi / one.n))


def test_rays_cross_the_wall() -> None:
    for referee in asked(1, 8):
        [(enter, leave)] = referee.expected
        assert 0 < enter < leave
    assert asked(1, 2) == asked(1, 2)


@pytest.mark.parametrize("power", [-1.0, -2.0, 0.5])
def test_a_slope_is_the_power(power: float) -> None:
    points = [Sides("x", 2**k, 3 * 2 ** (k * power), 0) for k in range(3, 9)]
    assert slope(points, "x") == pytest.approx(power)
    assert isnan(slope(points[:1], "x"))
    assert isnan(slope(points, "y"))


def test_lost_rays_do_not_count_as_errors() -> None:
    points = [Sides("x", 8, 1.0, 0), Sides("x", 16, 0.25, 0), Sides("x", 32, nan, 24)]
    assert slope(points, "x") == pytest.approx(-2.0)
