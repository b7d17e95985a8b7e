"""Meshes: the error falls as 1 / n^2."""

import math

import pytest

from raycert.oracle.measure.stress.sagitta import Sides, curves, rays, slope


def test_the_error_of_a_mesh_falls_as_one_over_n_squared() -> None:
    advanced: list[None] = []
    found = curves(1, lambda: advanced.append(None), most=128)
    assert [one.n for one in found if one.caster == "trimesh"] == [8, 16, 32, 64, 128]
    assert len(advanced) == len(found)
    assert all(one.lost == 0 for one in found)
    for caster in {one.caster for one in found}:
        assert -2.1 < slope(found, caster) < -1.9
    for one in found:
        assert one.error < 1.2 * (1 - math.cos(math.pi / one.n))


def test_rays_cross_the_wall() -> None:
    for question in rays(1, 8):
        [(enter, leave)] = question.expected
        assert 0 < enter < leave
    assert rays(1, 2) == rays(1, 2)


@pytest.mark.parametrize("power", [-1.0, -2.0, 0.5])
def test_a_slope_is_the_power(power: float) -> None:
    points = [Sides("x", 2**k, 3 * 2 ** (k * power), 0) for k in range(3, 9)]
    assert slope(points, "x") == pytest.approx(power)
    assert math.isnan(slope(points[:1], "x"))
    assert math.isnan(slope(points, "y"))


def test_lost_rays_do_not_count_as_errors() -> None:
    points = [Sides("x", 8, 1.0, 0), Sides("x", 16, 0.25, 0), Sides("x", 32, math.nan, 24)]
    assert slope(points, "x") == pytest.approx(-2.0)
