"""Faces, kinds and touches, by rows made by hand: one can, p at z = 0, q at z = 2, radius 1."""

from __future__ import annotations

import pytest
from hypothesis import given

from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
    Vector,
)
from raycert.oracle.exact.faces import place, touch
from raycert.oracle.exact.surd import INFINITY, ZERO
from raycert.oracle.exact.trace import trace
from shared.grid import leaves, rays, solids

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
TUBE = InfiniteCylinder((0, 0, 0), (0, 0, 2), 1)
SLAB = Slab((0, 0, 0), (0, 0, 2))
FLOOR = HalfSpace((0, 0, 0), (0, 0, 3))
BALL = Sphere((0, 0, 0), 5)
LINE = InfiniteCylinder((0, 0, 0), (0, 0, 2), 0)

# (solid, origin, direction, (faces, kind) of enter, of leave, touch)
SIDE, CAP_P, CAP_Q = ("side",), ("cap_p",), ("cap_q",)
ROWS = [
    # crossings
    (CAN, (-3, 0, 1), (1, 0, 0), (SIDE, "crossing"), (SIDE, "crossing"), None),
    (CAN, (0, 0, -3), (0, 0, 1), (CAP_P, "crossing"), (CAP_Q, "crossing"), None),
    (CAN, (0, 0, 9), (0, 0, -1), (CAP_Q, "crossing"), (CAP_P, "crossing"), None),
    (CAN, (-3, 0, -1), (2, 0, 1), (SIDE + CAP_P, "rim"), (SIDE, "crossing"), None),
    (SLAB, (7, 7, -1), (0, 0, 1), (CAP_P, "crossing"), (CAP_Q, "crossing"), None),
    (FLOOR, (0, 0, 1), (1, 0, -1), (("plane",), "crossing"), ((), "end"), None),
    (BALL, (-9, 3, 0), (1, 0, 0), (SIDE, "crossing"), (SIDE, "crossing"), None),
    # starts
    (CAN, (0, 0, 1), (1, 0, 0), (("start",), "start"), (SIDE, "crossing"), None),
    (CAN, (0, 0, 1), (0, 0, 0), (("start",), "start"), ((), "end"), None),
    (CAN, (-1, 0, 1), (1, 0, 0), (("side", "start"), "start"), (SIDE, "crossing"), None),
    (CAN, (0, 0, 0), (0, 0, 1), (("cap_p", "start"), "start"), (CAP_Q, "crossing"), None),
    (
        CAN,
        (-1, 0, 0),
        (1, 0, 1),
        (("side", "cap_p", "start"), "start"),
        (("side", "cap_q"), "rim"),
        None,
    ),
    # the touch `start`: the ray goes out where it starts
    (CAN, (1, 0, 1), (1, 0, 0), (("side", "start"), "start"), None, "start"),
    (CAN, (1, 0, 1), (1, 0, 1), (("side", "start"), "start"), None, "start"),
    (CAN, (0, 0, 2), (0, 0, 1), (("cap_q", "start"), "start"), None, "start"),
    (CAN, (1, 0, 2), (1, 0, 1), (("side", "cap_q", "start"), "start"), None, "start"),
    (CAN, (1, 0, 2), (1, 0, 0), (("side", "cap_q", "start"), "start"), None, "start"),
    (CAN, (1, 0, 2), (0, 0, 1), (("side", "cap_q", "start"), "start"), None, "start"),
    (SLAB, (0, 0, 0), (0, 0, -1), (("cap_p", "start"), "start"), None, "start"),
    (FLOOR, (0, 0, 0), (0, 1, 1), (("plane", "start"), "start"), None, "start"),
    (BALL, (3, 4, 0), (0, 1, 0), (("side", "start"), "start"), None, "start"),
    # the touch `tangent`
    (CAN, (-3, 1, 1), (1, 0, 0), (SIDE, "tangent"), None, "tangent"),
    (TUBE, (-3, 1, 1), (1, 0, 1), (SIDE, "tangent"), None, "tangent"),
    (BALL, (-9, 3, 4), (1, 0, 0), (SIDE, "tangent"), None, "tangent"),
    (TUBE, (0, 1, 1), (1, 0, 0), (("side", "start"), "start"), None, "tangent"),
    (LINE, (-3, 0, 0), (1, 0, 0), (SIDE, "tangent"), None, "tangent"),
    (Sphere((0, 0, 0), 0), (-3, 0, 0), (1, 0, 0), (SIDE, "tangent"), None, "tangent"),
    # the touch `wall`: along the curved face
    (TUBE, (1, 0, 9), (0, 0, -1), (("side", "start"), "start"), ((), "end"), "wall"),
    (CAN, (0, 1, -3), (0, 0, 1), (("side", "cap_p"), "rim"), (("side", "cap_q"), "rim"), "wall"),
    (LINE, (0, 0, 9), (0, 0, -1), (("side", "start"), "start"), ((), "end"), "wall"),
    (TUBE, (1, 0, 9), (0, 0, 0), (("side", "start"), "start"), ((), "end"), "wall"),
    # the touch `cap`: along a plane
    (CAN, (-3, 0, 0), (1, 0, 0), (("side", "cap_p"), "rim"), (("side", "cap_p"), "rim"), "cap"),
    (CAN, (0, 0, 2), (1, 0, 0), (("cap_q", "start"), "start"), (("side", "cap_q"), "rim"), "cap"),
    (SLAB, (7, 7, 0), (1, 1, 0), (("cap_p", "start"), "start"), ((), "end"), "cap"),
    (FLOOR, (7, 7, 0), (1, 1, 0), (("plane", "start"), "start"), ((), "end"), "cap"),
    # the touch `rim`: a point of the rim alone
    (CAN, (-2, 0, -1), (1, 0, 1), (SIDE + CAP_P, "rim"), (SIDE + CAP_Q, "rim"), None),
    (CAN, (-2, 0, 3), (-1, 0, 1), None, None, None),
    (CAN, (-3, 0, -4), (1, 0, 1), (SIDE + CAP_P, "rim"), None, "rim"),
    (CAN, (-3, 1, 0), (1, 0, 0), (SIDE + CAP_P, "rim"), None, "rim"),
    (CAN, (-1, 1, -1), (1, 0, 1), (SIDE + CAP_P, "rim"), None, "rim"),
    (CAN, (1, 0, 2), (1, 0, -1), (("side", "cap_q", "start"), "start"), None, "rim"),
    (CAN, (0, 1, 2), (1, 0, 0), (("side", "cap_q", "start"), "start"), None, "rim"),
    (CAN, (1, 0, 2), (0, 0, 0), (("side", "cap_q", "start"), "start"), ((), "end"), "rim"),
]


@pytest.mark.parametrize(("solid", "origin", "direction", "enter", "leave", "kind"), ROWS)
def test_where_the_ends_lie(
    solid: Solid,
    origin: Vector,
    direction: Vector,
    enter: tuple[tuple[str, ...], str] | None,
    leave: tuple[tuple[str, ...], str] | None,
    kind: str | None,
) -> None:
    ray = Ray(origin, direction)
    intervals = trace(solid, ray).intervals
    assert len(intervals) == (enter is not None)
    for a, b in intervals:
        one, two = place(a, solid, ray), place(b, solid, ray)
        assert (one.faces, one.kind) == enter
        assert (two.faces, two.kind) == (leave or enter)
        assert (a == b) == (leave is None)
        assert touch((a, b), solid, ray) == kind  # type: ignore[arg-type]


def test_every_kind_and_touch_has_a_row() -> None:
    touches = {row[5] for row in ROWS}
    assert touches == {None, "tangent", "wall", "cap", "rim", "start"}
    kinds = {end[1] for row in ROWS for end in (row[3], row[4]) if end}
    assert kinds == {"crossing", "tangent", "rim", "start", "end"}


def test_faces_in_a_tree_carry_their_path() -> None:
    tree = Union((FLOOR, Difference((CAN, BALL))))
    ray = Ray((-9, 0, 0), (1, 0, 0))
    at = place(ZERO, tree, ray)
    assert (at.faces, at.kind) == (("of[0]:plane", "start"), "start")
    both = Intersection((TUBE, SLAB))
    up = Ray((-3, 0, -2), (1, 0, 1))
    enter = trace(both, up).intervals[0][0]
    assert place(enter, both, up).faces == ("of[0]:side", "of[1]:cap_p")
    assert place(enter, both, up).kind == "crossing"  # a rim is of one leaf
    assert place(INFINITY, both, up).faces == ()


def test_of_two_leaves_the_rim_of_one_outranks_the_tangent_of_the_other() -> None:
    """At t = 3 the ray enters the can at its rim, and touches a ball."""
    tree = Union((Sphere((-1, 0, -1), 1), CAN))
    ray = Ray((-4, 0, 0), (1, 0, 0))
    enter = trace(tree, ray).intervals[0][0]
    at = place(enter, tree, ray)
    assert (at.faces, at.kind) == (("of[0]:side", "of[1]:side", "of[1]:cap_p"), "rim")
    assert place(enter, tree.of[0], ray).kind == "tangent"


def test_a_face_out_of_reach_does_not_count() -> None:
    """The wall's circle above the cap is on the tube's surface, and on no face of the can."""
    tree = Union((CAN, HalfSpace((1, 0, 0), (-1, 0, 0))))
    ray = Ray((-9, 0, 5), (1, 0, 0))
    enter = trace(tree, ray).intervals[0][0]
    assert place(enter, tree, ray).faces == ("of[1]:plane",)


@given(leaves, rays)
def test_only_an_interval_that_goes_inside_is_no_touch(leaf: Solid, ray: Ray) -> None:
    """Its middle is on no face, and so is that of none but such an interval."""
    for enter, leave in trace(leaf, ray).intervals:
        is_a_point = enter == leave
        kind = touch((enter, leave), leaf, ray)  # type: ignore[arg-type]
        if is_a_point:
            assert kind in ("tangent", "rim", "start")
        else:
            assert kind in (None, "wall", "cap", "rim")
        zero = isinstance(leaf, Sphere | Cylinder | InfiniteCylinder) and leaf.radius == 0
        assert kind is not None or not zero


@given(solids, rays)
def test_every_end_lies_on_a_face_or_is_the_start_or_infinity(solid: Solid, ray: Ray) -> None:
    for t in (t for interval in trace(solid, ray).intervals for t in interval):
        at = place(t, solid, ray)
        assert (at.kind == "end") == (not t.finite) == (at.faces == ())
        assert (at.kind == "start") == ("start" in at.faces) == (t == ZERO)


@given(leaves, rays)
def test_the_rest_of_the_line_shows_a_start(leaf: Solid, ray: Ray) -> None:
    """The touch `start` is the one that a step back would make longer."""
    intervals = trace(leaf, ray).intervals
    if isinstance(leaf, Tree) or not intervals or intervals[0] != (ZERO, ZERO):
        return
    u, v = ray.origin, ray.direction
    back = Ray((u[0] - v[0], u[1] - v[1], u[2] - v[2]), v)
    longer = trace(leaf, back).intervals[-1]
    starts = touch((ZERO, ZERO), leaf, ray) == "start"  # type: ignore[arg-type]
    assert starts == (longer[0] < longer[1])
