"""The model takes any real number, holds floats, and knows of each leaf what its fields are."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

import pytest

from raycert.cases.model import (
    LEAVES,
    SHAPES,
    Cylinder,
    Difference,
    HalfSpace,
    Ray,
    Refused,
    Slab,
    Sphere,
    axis,
    lengths,
    points,
    radius,
    real,
    vector,
)

np = pytest.importorskip("numpy")

ROD = Cylinder((1, 2, 3), (1, 2, 5), 0.5)
CUT = HalfSpace((0, 0, 1), (0, 0, 8))
SOLIDS = (ROD, CUT, Sphere((1, 0, 0), 2), Slab((0, 0, 0), (1, 0, 0)))


@pytest.mark.parametrize(
    ("value", "number"),
    [
        (np.float64(0.1), 0.1),
        (np.float32(0.1), float(np.float32(0.1))),
        (np.int64(-3), -3.0),
        (np.uint8(200), 200.0),
        (np.array(2.5), 2.5),
        (np.longdouble(1) / 3, 1 / 3),
        (Fraction(1, 3), 1 / 3),
        (Fraction(2**60 + 1), 2.0**60),
        (2**53 + 1, 2.0**53),
    ],
)
def test_a_real_number_of_any_kind_is_taken_and_held_as_a_float(value: Any, number: float) -> None:
    taken = real(value, "x")
    assert type(taken) is float
    assert taken == number


@pytest.mark.parametrize(
    "value", [True, np.True_, "1", np.str_("1"), None, 1j, np.complex128(1), [1.0], Decimal(1)]
)
def test_what_is_no_real_number_is_refused_by_its_path(value: Any) -> None:
    with pytest.raises(Refused, match=r"^radius: is not a number"):
        Sphere((0, 0, 0), value)


@pytest.mark.parametrize("value", [math.nan, np.float32("nan"), np.inf, np.array(-np.inf), 10**400])
def test_what_is_not_finite_is_refused(value: Any) -> None:
    with pytest.raises(Refused, match=r"^center\[1\]: is (NaN|infinite)"):
        Sphere((0, value, 0), 1)


@pytest.mark.parametrize("kind", ["float64", "float32", "int64", "float16", "object"])
def test_an_array_of_three_is_taken_where_a_vector_is(kind: str) -> None:
    taken = vector(np.array([1, -2, 3], kind), "x")
    assert taken == (1, -2, 3)
    assert {type(x) for x in taken} == {float}
    assert Ray(np.array([1, -2, 3], kind), np.arange(3)) == Ray((1, -2, 3), (0, 1, 2))


@pytest.mark.parametrize(
    ("value", "path", "reason"),
    [
        (np.zeros(4), "origin", "has 4 numbers"),
        (np.zeros((3, 3)), "origin[0]", "is not a number"),
        (np.array(1.0), "origin", "is not a list"),
        (np.array([1, 0, True], object), "origin[2]", "is not a number"),
        (np.array([True, False, True]), "origin[0]", "is not a number"),
        ("123", "origin", "is not a list"),
        (b"123", "origin", "is not a list"),
        (iter((1, 2, 3)), "origin", "is not a list"),
        ({1, 2, 3}, "origin", "is not a list"),
    ],
)
def test_what_is_no_vector_is_refused_by_its_path(value: Any, path: str, reason: str) -> None:
    with pytest.raises(Refused, match=reason) as refusal:
        Ray(value, (1, 0, 0))
    assert refusal.value.path == path


@pytest.mark.parametrize(
    "thing", [*SOLIDS, Ray((0.1, -0.0, 5e-324), (1, 2, 3)), Difference(SOLIDS)]
)
def test_what_is_shown_can_be_pasted_back(thing: Any) -> None:
    import raycert.cases.model as model

    assert eval(repr(thing), vars(model)) == thing


@pytest.mark.parametrize("kind", LEAVES)
def test_every_field_of_a_leaf_is_a_place_a_direction_or_a_length(kind: Any) -> None:
    shape = SHAPES[kind]
    assert sorted(name for names in shape for name in names) == sorted(kind.__slots__)
    assert shape.points


def test_a_leaf_tells_where_it_stands_which_way_it_goes_and_how_large_it_is() -> None:
    assert points(ROD) == ((1, 2, 3), (1, 2, 5))
    assert axis(ROD) == (0, 0, 2)
    assert lengths(ROD) == [1, 2, 3, 1, 2, 5, 0.5]
    assert axis(CUT) == (0, 0, 8)
    assert lengths(CUT) == [0, 0, 1]
    assert (radius(ROD), radius(CUT), radius(CUT, 1.0)) == (0.5, 0, 1)
    assert axis(Sphere((0, 0, 0), 1)) is None
