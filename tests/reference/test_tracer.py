"""The compact tracer: the seed's rows by hand, touches, scales, and its promise."""

from __future__ import annotations

import ast
import doctest
import subprocess
import sys
from importlib import import_module
from math import inf, ldexp, sqrt
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert import reference
from raycert.cases.formats import BINARY64
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
    Union,
    Vector,
)
from raycert.oracle.judge.levels import Judge
from raycert.reference.intervals import Pairs
from raycert.reference.quadratic import roots
from raycert.reference.tracer import intersect

FOLDER = Path(reference.__file__).parent
MODULES = ["vectors", "intervals", "quadratic", "tracer"]
START, X, Y, Z = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

# Along the z axis: the rod of radius 2, the slab 0 <= z <= 2, and what they have in common.
ROD, SLICE, DRUM = (
    InfiniteCylinder(START, Z, 2),
    Slab(START, (0, 0, 2)),
    Cylinder(START, (0, 0, 2), 2),
)

PROBLEM_1 = {
    "along-inside": (Ray((1, 0, 7), (0, 0, 4)), [(0, inf)]),
    "along-inside, in the wall": (Ray((0, 2, 7), (0, 0, -4)), [(0, inf)]),
    "along-outside": (Ray((3, 0, 7), (0, 0, 4)), []),
    "miss": (Ray((-5, 3, 0), X), []),
    "behind": (Ray((5, 0, 0), X), []),
    "from-inside": (Ray((1, 0, 0), (2, 0, 0)), [(0, 0.5)]),
    "through": (Ray((-5, 0, 0), (2, 0, 2)), [(1.5, 3.5)]),
    "through, off the axis": (Ray((-5, 1, 0), X), [(5 - sqrt(3), 5 + sqrt(3))]),
    "through, tangent": (Ray((-5, 2, 0), (2, 0, 2)), [(2.5, 2.5)]),
}
PROBLEM_2 = {
    "AE": (Ray((9, 0, 1), X), [(0, inf)]),
    "AE, in the face of p": (Ray((9, 0, 0), X), [(0, inf)]),
    "BE": (Ray((9, 0, 1), (1, 0, -2)), [(0, 0.5)]),
    "AF": (Ray((9, 0, 1), (1, 0, 4)), [(0, 0.25)]),
    "AH": (Ray((9, 0, 3), (1, 0, 1)), []),
    "AH, beside": (Ray((9, 0, 3), X), []),
    "BG": (Ray((9, 0, 3), (1, 0, -2)), [(0.5, 1.5)]),
    "DE": (Ray((9, 0, -1), (1, 0, -1)), []),
    "DE, beside": (Ray((9, 0, -1), X), []),
    "CF": (Ray((9, 0, -1), (1, 0, 2)), [(0.5, 1.5)]),
}
PROBLEM_2_C = {
    "A": (Ray((0, 0, -1), (1, 0, -1)), [(0, inf)]),
    "A, beside": (Ray((0, 0, -1), X), [(0, inf)]),
    "A, in the plane": (Ray(X, X), [(0, inf)]),
    "B": (Ray((0, 0, -1), (1, 0, 2)), [(0, 0.5)]),
    "C": (Ray((0, 0, 1), (1, 0, -2)), [(0.5, inf)]),
    "D": (Ray((0, 0, 1), (1, 0, 1)), []),
    "D, beside": (Ray((0, 0, 1), X), []),
}
PROBLEM_3 = {
    "(a) neither": (Ray((5, 0, 3), Z), []),
    "(b) no pairs from Problem 1": (Ray((5, 0, 1), Z), []),
    "(c) no pairs from Problem 2": (Ray((1, 0, 3), Z), []),
    "(d) m > n": (Ray((-6, 0, 1), (1, 0, 1)), []),
    "(d) m = a, n = b": (Ray((-3, 0, 1), X), [(1, 5)]),
    "(d) m = a, n = d": (Ray((-3, 0, 0.5), (2, 0, 1)), [(0.5, 1.5)]),
    "(d) m = c, n = b": (Ray((0, 0, -1), (1, 0, 1)), [(1, 2)]),
    "(d) m = c, n = d": (Ray((1, 0, 5), (0, 0, -1)), [(3, 5)]),
    "(d) m = n, over a rim": (Ray((-3, 0, -1), (1, 0, 1)), [(1, 3)]),
    "(d) m = n, a touch of a rim": (Ray((-3, 0, 1), (1, 0, 1)), [(1, 1)]),
}
TOUCHES = {
    "tangent": (Ray((-3, 2, 1), X), [(3, 3)]),
    "wall, going out": (Ray((2, 0, 1), X), [(0, 0)]),
    "wall, going in": (Ray((2, 0, 1), (-1, 0, 0)), [(0, 4)]),
    "wall, along": (Ray((2, 0, 1), Z), [(0, 1)]),
    "wall, along a tangent": (Ray((2, 0, 1), Y), [(0, 0)]),
    "cap, going out": (Ray((1, 0, 2), Z), [(0, 0)]),
    "cap, going in": (Ray(START, Z), [(0, 2)]),
    "cap, along": (Ray((0, 0, 2), X), [(0, 2)]),
    "rim, across": (Ray((-3, 0, 2), X), [(1, 5)]),
    "rim, tangent": (Ray((-3, 2, 2), X), [(3, 3)]),
    "rim, along the wall": (Ray((2, 0, 2), Z), [(0, 0)]),
    "zero direction inside": (Ray((2, 0, 2), START), [(0, inf)]),
    "zero direction outside": (Ray((3, 0, 2), START), []),
}
ROWS = [
    pytest.param(solid, ray, pairs, id=f"{type(solid).__name__} {name}")
    for solid, table in (
        (ROD, PROBLEM_1),
        (SLICE, PROBLEM_2),
        (HalfSpace(START, (0, 0, 8)), PROBLEM_2_C),
        (DRUM, PROBLEM_3),
        (DRUM, TOUCHES),
    )
    for name, (ray, pairs) in table.items()
]


@pytest.mark.parametrize(("solid", "ray", "pairs"), ROWS)
def test_rows_of_the_seed(solid: Solid, ray: Ray, pairs: Pairs) -> None:
    assert intersect(solid, ray) == pairs


@pytest.mark.parametrize(
    ("ray", "pairs"),
    [
        (Ray((-3, 0, 0), (2, 0, 0)), [(0.5, 2.5)]),
        (Ray((-3, 2, 0), X), [(3, 3)]),
        (Ray((-3, 2, 1), X), []),
        (Ray((3, 0, 0), X), []),
        (Ray(START, (0, 4, 0)), [(0, 0.5)]),
        (Ray((0, 2, 0), Y), [(0, 0)]),
        (Ray((0, 2, 0), START), [(0, inf)]),
    ],
)
def test_the_sphere(ray: Ray, pairs: Pairs) -> None:
    assert intersect(Sphere(START, 2), ray) == pairs


def test_a_radius_of_zero_leaves_the_axis() -> None:
    needle = Cylinder(START, (0, 0, 2), 0)
    assert intersect(needle, Ray((-3, 0, 1), X)) == [(3, 3)]
    assert intersect(needle, Ray((-3, 1, 1), X)) == []
    assert intersect(needle, Ray((0, 0, 3), (0, 0, -1))) == [(1, 3)]
    assert intersect(Sphere(START, 0), Ray((-3, 0, 0), X)) == [(3, 3)]


def test_trees() -> None:
    ray = Ray((-5, 0, 1), X)
    ball = Sphere((0, 0, 1), 1)
    assert intersect(Union((DRUM, ball)), ray) == [(3, 7)]
    assert intersect(Intersection((DRUM, ball)), ray) == [(4, 6)]
    assert intersect(Difference((DRUM, ball)), ray) == [(3, 4), (6, 7)]
    assert intersect(Difference((DRUM, ball, Sphere((2, 0, 1), 1))), ray) == [(3, 4)]


@pytest.mark.parametrize("solid", [DRUM, ROD, SLICE, Sphere(START, 2), HalfSpace(START, Z)])
def test_a_minus_zero_never_comes_out(solid: Solid) -> None:
    for start in ((2.0, -0.0, 0.0), START, (-0.0, 2.0, 2.0)):
        for way in ((1.0, -0.0, -0.0), (-0.0, -1.0, 1.0), (-0.0, -0.0, -1.0)):
            ends = [t for pair in intersect(solid, Ray(start, way)) for t in pair]
            assert "-0x0.0p+0" not in [t.hex() for t in ends]


SMALL = st.integers(-9, 9).map(float)
VECTORS = st.tuples(SMALL, SMALL, SMALL)


@given(VECTORS.filter(any), st.integers(-50, 50).filter(bool), VECTORS)
def test_a_direction_parallel_to_the_axis_never_leaves_the_wall(
    w: Vector, stretch: int, u: Vector
) -> None:
    direction = (stretch * w[0], stretch * w[1], stretch * w[2])
    assert intersect(InfiniteCylinder(START, w, 99), Ray(u, direction)) == [(0, inf)]
    assert intersect(InfiniteCylinder(START, w, 0), Ray(START, direction)) == [(0, inf)]


REALS = st.one_of(SMALL, st.floats(-100, 100))
SPACE = st.tuples(REALS, REALS, REALS)


@st.composite
def leaves(draw: st.DrawFn) -> Solid:
    """Draw a primitive, often with small integers for numbers."""
    p, q, r = draw(SPACE), draw(SPACE), abs(draw(REALS))
    solids: list[Solid] = [Sphere(p, r)]
    if p != q:
        solids += [Cylinder(p, q, r), InfiniteCylinder(p, q, r), Slab(p, q)]
    if any(q):
        solids += [HalfSpace(p, q)]
    return draw(st.sampled_from(solids))


@given(leaves(), SPACE, SPACE)
def test_promise_stable(solid: Solid, origin: Vector, direction: Vector) -> None:
    ray = Ray(origin, direction)
    judge = Judge(solid, ray, BINARY64)
    answer = intersect(solid, ray)
    assert judge.malformed(answer) is None
    assert judge.backward_error(answer, "strict") <= 64


def scaled(solid: Solid, e: int) -> Solid:
    """Return a primitive with all its lengths times 2^e."""

    def times(a: Vector) -> Vector:
        return (ldexp(a[0], e), ldexp(a[1], e), ldexp(a[2], e))

    match solid:
        case Sphere(center, radius):
            return Sphere(times(center), ldexp(radius, e))
        case Slab(p, q):
            return Slab(times(p), times(q))
        case InfiniteCylinder(p, q, radius) | Cylinder(p, q, radius):
            return type(solid)(times(p), times(q), ldexp(radius, e))
    raise TypeError(solid)


LENGTHS = VECTORS.map(lambda a: (a[0] / 8, a[1] / 8, a[2] / 8))


@given(LENGTHS, LENGTHS, SMALL.map(abs), LENGTHS, LENGTHS, st.integers(-1000, 1000), st.data())
def test_a_power_of_two_changes_no_bit(
    p: Vector, q: Vector, r: float, u: Vector, v: Vector, e: int, data: st.DataObject
) -> None:
    solids: list[Solid] = [Sphere(p, r)]
    if p != q:
        solids += [Cylinder(p, q, r), InfiniteCylinder(p, q, r), Slab(p, q)]
    solid = data.draw(st.sampled_from(solids))
    f = data.draw(st.integers(max(-1000, e - 900), min(1000, e + 900)))
    moved = Ray(
        (ldexp(u[0], e), ldexp(u[1], e), ldexp(u[2], e)),
        (ldexp(v[0], f), ldexp(v[1], f), ldexp(v[2], f)),
    )
    plain = [(ldexp(a, e - f), ldexp(b, e - f)) for a, b in intersect(solid, Ray(u, v))]
    assert intersect(scaled(solid, e), moved) == plain


def test_lengths_that_overflow_between_two_points() -> None:
    far = ldexp(1.0, 1023)
    drum = Cylinder((0, 0, -far), (0, 0, far), far)
    assert intersect(drum, Ray((-far, 0, far), (far, 0, 0))) == [(0, 2)]
    assert intersect(Sphere((far, 0, 0), far), Ray((-far, 0, 0), (far, 0, 0))) == [(1, 3)]


def test_t_that_overflows_is_infinite() -> None:
    slow = ldexp(1.0, -1000)
    assert intersect(Sphere((2.0**100, 0, 0), 1), Ray(START, (slow, 0, 0))) == [(inf, inf)]
    assert intersect(Sphere(START, 2.0**100), Ray(START, (slow, 0, 0))) == [(0, inf)]


NEAR_TANGENT_STARTS = [
    (
        Sphere((-1.5835035300287958, 3.760835646820014, -1.342159635322795), 3.944970106369189),
        Ray(
            (0.2809669618435826, 7.12879244861753, -0.47994973842439137),
            (3.0726979518766715e-10, -8.153052224704385e-11, -3.459762991449284e-10),
        ),
    ),
    (
        InfiniteCylinder(
            START, (-4.189675868016304, -0.9885766842925389, 7.649717983471466), 0.8133617131251663
        ),
        Ray(
            (-1.2924023371861244, 0.4610892529199849, 1.3842032056190943),
            (1.277880322215674e-06, 1.066855139314197e-06, 8.377527744539627e-07),
        ),
    ),
]
"""Starts outside by rounding only, where c / k lies beyond the other root."""


@pytest.mark.parametrize(("solid", "ray"), NEAR_TANGENT_STARTS)
def test_rounding_does_not_swap_the_roots(solid: Solid, ray: Ray) -> None:
    answer = intersect(solid, ray)
    assert all(enter <= leave for enter, leave in answer)
    assert Judge(solid, ray, BINARY64).backward_error(answer, "strict") <= 4


@given(st.floats(0.25, 4), st.floats(-1, 1), st.floats(-1, 1), st.floats(0, 1))
def test_roots_are_in_order_whatever_their_rounding(
    a: float, b: float, c: float, half: float
) -> None:
    t1, t2 = roots(a, b, c, half)
    assert t1 <= t2


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_in_the_docstrings(name: str) -> None:
    assert doctest.testmod(import_module(f"raycert.reference.{name}")).failed == 0


def test_it_needs_only_the_model_and_the_standard_library() -> None:
    allowed = {"__future__", "collections", "importlib", "math", "typing", "raycert"}
    for path in FOLDER.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="ascii"))):
            if isinstance(node, ast.ImportFrom):
                assert (node.module or ".").split(".")[0] in allowed, path
            assert not isinstance(node, ast.Import), path


def test_it_serves_the_line_protocol() -> None:
    case = (
        b'{"id": "7", "solid": {"type": "cylinder", "p": [0, 0, 0], "q": [0, 0, 2], "radius": 1},'
        b' "ray": {"origin": [-3, 0, 1], "direction": [1, 0, 0]}}\n'
    )
    done = subprocess.run(
        [sys.executable, "-m", "raycert.reference"],
        input=b'{"hello": 1}\n' + case,
        capture_output=True,
        cwd=FOLDER.parent,
        check=True,
    )
    hello, reply = done.stdout.splitlines()
    assert hello.startswith(b'{"hello":1,"name":"raycert reference"')
    assert reply == b'{"id":"7","intervals":[[2.0,4.0]]}'
