"""Forms differ where a case is degenerate, and what lies between two is told by its right name."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Solid,
    Sphere,
    Union,
)
from raycert.cases.strategies import leaves, rays
from raycert.oracle.exact.trace import trace
from raycert.oracle.map.sampling import KINDS, Kind, between, topology

ROD = Cylinder((0, 0, 0), (0, 0, 2), 1)
UP, DOWN = 1 + 2.0**-52, 1 - 2.0**-53


def ray(origin: tuple[float, float, float], *direction: float) -> Ray:
    return Ray(origin, direction)  # type: ignore[arg-type]


def cut(height: float) -> Solid:
    return Difference((ROD, Cylinder((0, 0, 1), (0, 0, height), 0.5)))


SIDES: list[tuple[Kind, tuple[Solid, Ray], tuple[Solid, Ray]]] = [
    ("double root", (ROD, ray((-3, UP, 1), 1, 0, 0)), (ROD, ray((-3, DOWN, 1), 1, 0, 0))),
    ("double root", (ROD, ray((-3, UP, 1), 1, 0, 0)), (ROD, ray((-3, 1, 1), 1, 0, 0))),
    ("rim", (ROD, ray((-3, 0, -2 * UP), 1, 0, 1)), (ROD, ray((-3, 0, -2 * DOWN), 1, 0, 1))),
    ("rim", (ROD, ray((-3, 0, -2), 1, 0, 1)), (ROD, ray((-3, 0, -2 * DOWN), 1, 0, 1))),
    ("coincident faces", (cut(2 * UP), ray((0, 0, 4), 0, 0, -1)),
     (cut(2 * DOWN), ray((0, 0, 4), 0, 0, -1))),
    ("coincident faces", (cut(3.0), ray((-1, 0, 4), 0.26, 0, -1)),
     (cut(3.0), ray((-1, 0, 4), 0.24, 0, -1))),
    ("coincident faces", (cut(2.0), ray((-1, 0, 4), 0.25, 0, -1)),
     (cut(2 * DOWN), ray((-1, 0, 4), 0.25, 0, -1))),
    ("start on a face", (ROD, ray((-UP, 0, 1), 1, 0, 0)), (ROD, ray((-DOWN, 0, 1), 1, 0, 0))),
    ("start on a face", (ROD, ray((UP, 0, 1), 1, 0, 0)), (ROD, ray((DOWN, 0, 1), 1, 0, 0))),
    ("start on a face", (ROD, ray((1, 0, 1), 1, 0, 0)), (ROD, ray((DOWN, 0, 1), 1, 0, 0))),
    ("parallel to a face", (HalfSpace((0, 0, 0), (0, 0, 1)), ray((0, 0, -1), 1, 0, 2.0**-60)),
     (HalfSpace((0, 0, 0), (0, 0, 1)), ray((0, 0, -1), 1, 0, -(2.0**-60)))),
    ("parallel to a face", (InfiniteCylinder((0, 0, 0), (0, 0, 1), 1), ray((0, 0, 0), 0, 0, 1)),
     (InfiniteCylinder((0, 0, 0), (0, 0, 1), 1), ray((0, 0, 0), 2.0**-40, 0, 1))),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "one", "other"), SIDES)
def test_what_lies_between_has_its_name(
    kind: Kind, one: tuple[Solid, Ray], other: tuple[Solid, Ray]
) -> None:
    here, there = topology(one)[0], topology(other)[0]
    assert between(here, there) == between(there, here) == kind


def test_a_change_that_is_hidden_in_a_tree_is_none() -> None:
    """The start passes the infinite wall of the first part, far above it."""
    a, b = (topology((cut(2.0), ray((x, 0, 4), -0.1 * x, 0, -1)))[0] for x in (-UP, -DOWN))
    assert a == b
    assert between(a, b) is None


@pytest.mark.parametrize(
    ("case", "kinds"),
    [
        ((ROD, ray((-3, 1, 1), 1, 0, 0)), ("double root",)),
        ((ROD, ray((-3, 0, -2), 1, 0, 1)), ("rim",)),
        ((ROD, ray((1, 0, 1), 1, 0, 0)), ("start on a face",)),
        ((ROD, ray((-3, 0, 1), 1, 0, 0)), ()),
        ((ROD, ray((0, 0, 1), 1, 0, 0)), ()),
        ((Union((ROD, ROD)), ray((-3, 0, 1), 1, 0, 0)), ("coincident faces",)),
        ((Sphere((0, 0, 0), 1), ray((-3, 0, 0), 1, 0, 0)), ()),
    ],
)
def test_what_a_case_lies_on_exactly(case: tuple[Solid, Ray], kinds: tuple[Kind, ...]) -> None:
    assert topology(case)[0].kinds == kinds


def test_a_label_says_pairs_rows_and_what_is_met() -> None:
    tangent = topology((ROD, ray((-3, 1, 1), 1, 0, 0)))[0]
    assert tangent.label == "1 pair, a touch: through AE meet a>c b<d m=n (double root)"
    tree = topology((cut(1.5), ray((0, 0, 4), 0, 0, -1)))[0]
    assert tree.label == ("2 pairs: of[0]:cap_q .. of[1]:cap_q; of[1]:cap_p .. of[0]:cap_p")
    assert topology((cut(1.5), ray((9, 0, 4), 0, 0, 1)))[0].label == "no pair"


@settings(max_examples=100, deadline=None)
@given(leaves(), st.data())
def test_a_leaf_has_no_coincident_faces_and_the_answer_is_the_oracles(
    leaf: Leaf, data: st.DataObject
) -> None:
    one, other = data.draw(rays(leaf)), data.draw(rays(leaf))
    here, answer = topology((leaf, one))
    there, _ = topology((leaf, other))
    assert answer == trace(leaf, one)
    assert here.pairs == len(answer.intervals)
    assert between(here, there) in {None, *KINDS} - {"coincident faces"}
    assert (between(here, there) is None) == (here == there)
