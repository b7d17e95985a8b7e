"""Degenerate inputs have names, and stand apart from all others in the golden families."""

from __future__ import annotations

import pytest

from raycert.cases.case import Family
from raycert.cases.degenerate import DEGENERACIES, degenerate
from raycert.cases.families.catalog import APART, FAMILIES
from raycert.cases.flags import FLAGS
from raycert.cases.formats import FORMATS
from raycert.cases.model import Cylinder, Difference, HalfSpace, Ray, Slab, Solid, Sphere, Union

BALL, DOT = Sphere((0, 0, 0), 1), Sphere((0, 0, 2), 0)
FLOOR, LAYER = HalfSpace((0, 0, 0), (0, 0, 1)), Slab((0, 0, 0), (0, 0, 1))
MOVING, RESTING = Ray((3, 0, 0), (-1, 0, 0)), Ray((3, 0, 0), (0.0, -0.0, 0))


@pytest.mark.parametrize(
    ("solid", "zero"),
    [
        (BALL, False),
        (DOT, True),
        (Sphere((0, 0, 0), -0.0), True),
        (Sphere((0, 0, 0), 5e-324), False),
        (Cylinder((0, 0, 0), (0, 0, 1), 0), True),
        (FLOOR, False),
        (LAYER, False),
        (Union((FLOOR, BALL)), False),
        (Difference((BALL, Union((LAYER, DOT)))), True),
    ],
)
def test_a_case_is_degenerate_by_its_numbers(solid: Solid, zero: bool) -> None:
    radius = ("zero_radius",) if zero else ()
    assert degenerate(solid, MOVING) == radius
    assert degenerate(solid, RESTING) == ("zero_direction", *radius)
    assert degenerate(solid, Ray((0, 0, 0), (0, 0, 5e-324))) == radius


def test_the_legend_knows_each_name() -> None:
    named = {name.replace("_", "-") for name in DEGENERACIES if name != "flat_box"}
    assert named <= set(FLAGS)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_no_family_mixes_degenerate_cases_with_others(family: Family) -> None:
    """All have one degeneracy in common, or none has any."""
    for fmt in FORMATS.values():
        found = [set(degenerate(case.solid, case.ray)) for case in family.cases(fmt)]
        assert not any(found) or set.intersection(*found)
        assert any(found) <= (family.name in APART)
