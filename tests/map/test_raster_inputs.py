"""Every number of a case has one path; replacing it changes that number and no other."""

import re
from contextlib import suppress
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32
from raycert.cases.model import Cylinder, Difference, HalfSpace, Ray, Refused, Sphere, leaves
from raycert.oracle.map.raster import Inputs

BALL, ROD = Sphere((1.0, 2.0, 3.0), 4.0), Cylinder((5.0, 6.0, 7.0), (8.0, 9.0, 10.0), 11.0)
TREE = Difference((BALL, Difference((ROD, HalfSpace((12.0, 13.0, 14.0), (15.0, 16.0, 17.0))))))
RAY = Ray((18.0, 19.0, 20.0), (21.0, 22.0, 23.0))
INPUTS = Inputs(TREE, RAY)


def test_all_numbers_are_named_once() -> None:
    assert sorted(INPUTS[path] for path in INPUTS.paths) == [float(i) for i in range(1, 24)]
    assert len(set(INPUTS.paths)) == 23
    assert INPUTS["solid.of[1].of[0].q[2]"] == 10.0
    assert INPUTS["ray.direction[0]"] == 21.0


def test_nothing_replaced_is_the_case() -> None:
    assert INPUTS.probe({}) == (TREE, RAY)


@given(st.sampled_from(INPUTS.paths), st.integers(100, 200))
def test_one_number_is_replaced_and_no_other(path: str, value: int) -> None:
    moved = Inputs(*INPUTS.probe({path: float(value)}))
    assert {p: moved[p] for p in moved.paths} == {
        p: float(value) if p == path else INPUTS[p] for p in INPUTS.paths
    }


def test_what_passes_through_no_case_is_one_in_the_end() -> None:
    """Both points move by 1, so that p is q in between if they move one after the other."""
    solid, _ = Inputs(Cylinder((0, 0, 0), (0, 0, 1), 1), RAY).probe(
        {"solid.p[2]": 1.0, "solid.q[2]": 2.0}
    )
    assert dict(leaves(solid))[""] == Cylinder((0, 0, 1), (0, 0, 2), 1)


@pytest.mark.parametrize(
    ("values", "path"),
    [
        ({"solid.of[0].radius": -1.0}, "solid.of[0].radius"),
        ({"ray.origin[1]": float("inf")}, "ray.origin[1]"),
        (
            {f"solid.of[1].of[0].q[{i}]": 5.0 + i for i in range(3)},
            "solid.of[1].of[0].q",
        ),
    ],
)
def test_what_is_no_case_is_refused_with_its_path(values: dict[str, float], path: str) -> None:
    with pytest.raises(Refused, match=re.escape(path)):
        INPUTS.probe(values)


def test_a_format_is_kept() -> None:
    with pytest.raises(Refused, match="binary32"):
        Inputs(BALL, RAY, BINARY32).probe({"solid.radius": 0.1})


def test_a_direction_is_read_as_it_is_written() -> None:
    one = INPUTS.direction("ray.origin[0]")
    assert one.terms == (("ray.origin[0]", Fraction(1)),)
    two = INPUTS.direction("ray.origin[0]=2, solid.of[0].radius=-0.5")
    assert two.terms == (("ray.origin[0]", Fraction(2)), ("solid.of[0].radius", Fraction(-1, 2)))
    assert [INPUTS.direction(str(d)) for d in (one, two)] == [one, two]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("ray.orgin[0]", "ray.origin"),
        ("", "no number of this case"),
        ("solid", "no number of this case"),
        ("ray.origin[0]=x", "no number: 'x'"),
        ("ray.origin[0]=1/0", "no number"),
        ("ray.origin[0]=nan", "no number"),
        ("ray.origin[0]=0", "weight 0"),
        ("ray.origin[0],ray.origin[0]=2", "twice"),
    ],
)
def test_what_is_no_direction_is_refused(text: str, words: str) -> None:
    with pytest.raises(Refused, match=re.escape(words)):
        INPUTS.direction(text)


@settings(max_examples=50)
@given(st.text(max_size=30))
def test_no_text_breaks_it(text: str) -> None:
    with suppress(Refused):
        assert INPUTS.direction(text).terms
