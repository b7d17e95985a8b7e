"""Samples: roots without a float, and the same draws everywhere."""

from fractions import Fraction

import pytest

from raycert.cases.dice import Dice
from raycert.cases.draw import Draw
from raycert.cases.families.frames import ON_Z
from raycert.cases.families.sketch import rod
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Refused
from raycert.oracle.measure.stress.sample import Sample, before, disc, frame, heading, root


def draw(name: str = "test") -> Draw:
    return Draw(Dice(name), BINARY64)


@pytest.mark.parametrize("number", [2, 10**40, Fraction(2, 3), Fraction(1, 10**700), 10**900])
def test_a_root_squares_back(number: Fraction | int) -> None:
    error = root(number) ** 2 / Fraction(number) - 1
    assert abs(error) < Fraction(1, 2**60)


def test_roots_of_squares_are_exact() -> None:
    assert root(0) == 0
    assert root(Fraction(9, 4)) == Fraction(3, 2)


def test_a_heading_is_about_as_long_as_one_and_goes_across() -> None:
    for i in range(50):
        a, b, c = map(Fraction, heading(draw(f"heading {i}")))
        assert abs(a * a + b * b + c * c - 1) < Fraction(1, 2**50)
        assert a * a + b * b >= Fraction(1, 4)


def test_a_disc_holds_its_points() -> None:
    for i in range(50):
        a, b = disc(draw(f"disc {i}"), 0.875)
        assert a * a + b * b <= Fraction(49, 64)


def test_frames_are_along_the_axes_or_oblique() -> None:
    for i in range(20):
        assert sorted(map(abs, frame(draw(str(i)), oblique=False).axis)) == [0, 0, 1]
        assert frame(draw(str(i)), oblique=True).stretch > 1


def test_a_sample_is_posed_in_its_frame() -> None:
    sample = Sample(rod((0, 0, 0), (0, 0, 2), 1), before((0, 0, 1), (1, 0, 0), 3), (1, 0, 0))
    solid, ray = sample.posed()
    assert solid == Cylinder((0, 0, 0), (0, 0, 2), 1)
    assert (ray.origin, ray.direction) == ((-3, 0, 1), (1, 0, 0))


def test_what_rounding_leaves_no_solid_is_refused() -> None:
    far = Sample(rod((0, 0, 0), (0, 0, 2), 1), (0, 0, 0), (1, 0, 0), ON_Z.moved((0, 0, 10**40)))
    with pytest.raises(Refused):
        far.posed()
