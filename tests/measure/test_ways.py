"""Ways answer alike where nothing is hard; each loses, where it does, what it is known for."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from math import inf, isclose, isinf, nan
from pathlib import Path

import pytest

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
    types,
)
from raycert.oracle.client.dialogue import Unusable
from raycert.oracle.client.target import target
from raycert.oracle.measure.catalog import BY_NAME, WAYS, chosen, here
from raycert.oracle.measure.digits import Box, Undecided, in_intervals
from raycert.oracle.measure.errors import referees
from raycert.oracle.measure.facets import SIDES
from raycert.oracle.measure.quadratics import DOUBLES, frame, printed, q_root, textbook
from raycert.oracle.measure.rays import TIES, rays_of
from raycert.oracle.measure.way import (
    ALL,
    FAILURES,
    PRECISIONS,
    Answered,
    Case,
    Way,
    answered,
    client,
    exact,
    one_by_one,
)

SOLVED = [m for m in here(WAYS)[0] if m.precision != "mesh" and "slab" in m.solids]
EXACT = ("mpmath-50", "mpmath-100", "mpmath-200", "mpmath-intervals", "sympy", "oracle",
         "oracle-batch")  # fmt: skip
CAN, BALL = Cylinder((0.1, 0, 0), (0, 0.2, 2), 1), Sphere((0.3, 0, 0.2), 1)
CROSSING = Ray((-3, 0.2, 0.9), (1, 0.03, 0.1))
SOLIDS: tuple[Solid, ...] = (
    HalfSpace((0.5, 0, 0), (1, 0.2, 0)),
    HalfSpace((0.5, 0, 0), (-2, 0.2, 0)),
    BALL,
    InfiniteCylinder((0, 0, 0), (0.1, 0.2, 1), 1),
    Slab((-0.5, 0, 0), (1, 0.1, 0)),
    CAN,
    Union((CAN, Sphere((5, 0, 1), 1))),
    Intersection((CAN, BALL, HalfSpace((0.2, 0, 0), (1, 0, 0)))),
    Difference((CAN, Sphere((0, 0, 1), 0.4), Slab((0.5, 0, 0), (0.6, 0, 0)))),
)
each_solved = pytest.mark.parametrize("method", SOLVED, ids=lambda m: m.name)


def lists(name: str, cases: Sequence[Case]) -> list[Answered]:
    return BY_NAME[name].solve(cases)


@each_solved
def test_easy_questions_have_one_answer(method: Way) -> None:
    rays = (CROSSING, Ray((0.3, 0.1, 0.5), (0.2, 1, 0.3)), Ray((9, 9, 9), (1, 0.5, 0.2)))
    cases = [Case(solid, ray) for solid in SOLIDS for ray in rays]
    for case, mine, true in zip(cases, method.solve(cases), lists("oracle", cases), strict=True):
        assert mine is not None
        assert true is not None
        assert len(mine) == len(true), case
        for (a, b), (c, d) in zip(mine, true, strict=True):
            assert isclose(a, c, rel_tol=2e-5, abs_tol=2e-5), case
            assert (isinf(b) and isinf(d)) or isclose(b, d, rel_tol=2e-5), case


@each_solved
def test_a_ray_that_stays_or_runs_along_the_axis_divides_by_nothing(method: Way) -> None:
    rod = InfiniteCylinder((0, 0, 0), (0, 0, 1), 1)
    along, beside = Ray((0.5, 0, 0), (0, 0, 2)), Ray((2, 0, 0), (0, 0, 2))
    still = Ray((0, 0, 0.5), (0, 0, 0))
    cases = [Case(rod, along), Case(rod, beside), Case(Sphere((0, 0, 0), 1), still)]
    assert method.solve(cases) == [((0.0, inf),), (), ((0.0, inf),)]


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize("scene", ["random", "boolean"])
def test_methods_with_digits_enough_round_correctly(name: str, scene: str) -> None:
    cases = rays_of(scene, 24)
    assert lists(name, cases) == [j.expected for j in referees(cases)]


@pytest.mark.parametrize("scene", ["random", "tilted", "boolean", "huge"])
@pytest.mark.parametrize("name", ["reference", "oracle"])
def test_a_batch_gives_the_bits_of_the_single_rays(name: str, scene: str) -> None:
    cases = rays_of(scene, 40)
    assert lists(f"{name}-batch", cases) == lists(name, cases)


def test_intervals_are_right_or_say_nothing() -> None:
    cases = [case for name in ("tangent", "ties", "tiny") for case in rays_of(name, 24)]
    for mine, judge in zip(lists("mpmath-intervals", cases), referees(cases), strict=True):
        assert mine is None or mine == judge.expected
    solid, ray = rays_of("ties", 4)[0]
    beside = Ray((ray.origin[0], 2.0**-900, ray.origin[2]), ray.direction)
    assert in_intervals([Case(solid, beside)]) == [None]


def test_ties_are_rounded_by_who_sees_that_they_are_none() -> None:
    """t = tie + 2^-2j: what has fewer digits than 2 j bits sees the tie, and rounds to even."""
    cases = rays_of("ties", 64)
    wanted = [j.expected for j in referees(cases)]
    depth = [TIES[i % 16 % len(TIES)] for i in range(64)]
    assert lists("oracle", cases) == lists("mpmath-intervals", cases) == wanted
    for name, reach in (("mpmath-50", 80), ("mpmath-100", 120), ("mpmath-200", 300)):
        wrong = [a != b for a, b in zip(lists(name, cases), wanted, strict=True)]
        assert wrong == [j > reach for j in depth], name


def worst(name: str, cases: Sequence[Case], measure: str) -> float:
    each = zip(lists(name, cases), referees(cases), strict=True)
    return max(judge.backward(answer, measure) for answer, judge in each)  # type: ignore[arg-type]


def test_the_textbook_discriminant_is_sound_and_unstable_far_away() -> None:
    cases = rays_of("far", 56)
    assert worst("textbook", cases, "strict") > 1e6
    assert worst("textbook", cases, "squared") < 8
    assert worst("reference", cases, "strict") <= 2
    assert worst("seed", cases, "strict") <= 2


def test_the_determinant_breaks_near_parallel_and_the_shift_on_thin_solids() -> None:
    tilted, thin = rays_of("tilted", 48), rays_of("thin", 48)
    assert worst("determinant", tilted, "strict") > 1e4
    assert worst("seed", tilted, "strict") <= 2
    assert worst("shift", thin, "strict") > 1e4
    assert worst("local-frame", thin, "strict") <= 2


def test_the_q_root_breaks_where_a_ray_starts_at_a_tangent() -> None:
    cases = rays_of("tangent", 400, 2)[100:150]
    assert worst("q-root", cases, "strict") > 1e12
    assert worst("seed", cases, "strict") <= 2


def test_the_curves_solve_the_same_quadratic() -> None:
    y, v = (-3.0, 0.5, 0.0), (2.0, 0.25, 0.0)
    [(a, b)] = printed(DOUBLES, y, v, 1.0)
    for curve in (textbook, q_root, frame):
        [(c, d)] = curve(DOUBLES, y, v, 1.0)
        assert isclose(a, c, rel_tol=1e-14)
        assert isclose(b, d, rel_tol=1e-14)
    assert not any(c(DOUBLES, y, (0.0, 1.0, 0.0), 1.0) for c in (textbook, printed, q_root, frame))


def test_an_answer_is_joined_and_has_no_nan() -> None:
    assert answered([(-0.0, 1.0), (1.0, 2.0), (3.0, 4.0)]) == ((0.0, 2.0), (3.0, 4.0))
    assert str(answered([(-0.0, -0.0)])) == "((0.0, 0.0),)"
    assert answered([(0.0, nan)]) is None


@pytest.mark.parametrize("fault", [ZeroDivisionError, ValueError, OverflowError, TypeError])
def test_what_a_computation_raises_is_a_failure(fault: type[Exception]) -> None:
    def intersect(solid: Solid, ray: Ray) -> list[tuple[float, float]]:
        raise fault

    assert one_by_one(intersect)([Case(CAN, CROSSING)] * 2) == [None, None]


def test_boxes_decide_or_raise() -> None:
    iv = pytest.importorskip("mpmath").iv
    one, two, wide = Box(iv.mpf(1)), Box(iv.mpf(2)), Box(iv.mpf([0, 3]))
    assert one < two <= two
    assert two > one
    assert one == Box(iv.mpf(1))
    assert one != two
    assert (one + two) * two - one > wide / two
    for decide in (lambda: one < wide, lambda: wide == one, lambda: wide >= two):
        with pytest.raises(Undecided):
            decide()


def test_types_of_a_tree_are_those_of_all_its_parts() -> None:
    assert types(SOLIDS[-1]) == {"difference", "cylinder", "sphere", "slab"}
    prism = BY_NAME[f"trimesh-{SIDES[0]}"]
    assert prism.answers(CAN)
    assert not prism.answers(BALL)
    assert not prism.answers(Union((CAN, CAN)))


def test_the_catalog_is_well_formed() -> None:
    assert len(BY_NAME) == len(WAYS)
    for method in WAYS:
        assert method.precision in PRECISIONS
        assert method.solids <= ALL
        assert method.lanes >= 1
        assert " ".join(["a method that", method.does]).isascii()
    assert chosen(["oracle", "textbook", "oracle"]) == [BY_NAME["oracle"], BY_NAME["textbook"]]
    assert chosen([]) == list(WAYS)
    with pytest.raises(KeyError):
        chosen(["no such"])


def test_what_is_not_installed_is_left_out_and_named() -> None:
    absent = Way("x", "needs more", lambda cases: [], needs=("no_such_package",))
    kept, notes = here([absent, BY_NAME["oracle"]])
    assert kept == [BY_NAME["oracle"]]
    assert notes == ["no_such_package is not installed; left out: x"]


def test_naming_the_methods_loads_none_of_their_libraries() -> None:
    code = "import sys, raycert.oracle.measure.catalog; print(*sys.modules)"
    loaded = subprocess.check_output([sys.executable, "-c", code], text=True).split()
    assert not {"numpy", "mpmath", "sympy", "trimesh", "numba", "raycert.reference"} & set(loaded)


def test_a_client_is_a_method_over_its_pipe() -> None:
    cases = rays_of("random", 8)
    method = client("mine", target(("raycert.reference.tracer:intersect",)))
    assert method.solve(cases) == lists("reference", cases)
    assert 0 < method.call(cases)().seconds < 5
    assert not method.batch
    two = chosen(["oracle"], [("raycert.reference.tracer:intersect",)] * 2)
    assert [m.name for m in two[1:]] == [
        "raycert.reference.tracer:intersect",
        "raycert.reference.tracer:intersect #2",
    ]


def test_a_client_that_breaks_off_fails_and_is_still_timed(tmp_path: Path) -> None:
    program = tmp_path / "breaks.py"
    program.write_text(
        "import json, sys\n"
        "print(json.dumps({'hello': 1, 'name': 'x', 'solids': ['cylinder']}), flush=True)\n"
        "input(); input(); sys.exit(3)\n"
    )
    method = client("mine", target((sys.executable, str(program))))
    cases = rays_of("random", 4)
    assert method.solve(cases) == [None] * 4
    assert all(
        j.forward(a).failed for a, j in zip(method.solve(cases), referees(cases), strict=True)
    )
    assert method.call(cases)().seconds > 0
    assert not method.answers(BALL)


def test_a_client_without_lists_is_refused(tmp_path: Path) -> None:
    program = tmp_path / "first.py"
    program.write_text('print(\'{"hello": 1, "name": "x", "answers": "any"}\')\ninput()\n')
    with pytest.raises(Unusable, match="intervals"):
        client("mine", target((sys.executable, str(program))))


@pytest.mark.parametrize("scenario", ["random", "axis-aligned", "touching"])
def test_arb_is_right_or_undecided(scenario: str) -> None:
    pytest.importorskip("flint")
    cases = rays_of(scenario, 120, 5)
    answers = lists("arb", cases)
    decided = [i for i, answer in enumerate(answers) if answer is not None]
    assert all(answers[i] == exact(*cases[i]) for i in decided)
    assert len(decided) > 30
    assert (len(decided) < 120) == (scenario == "touching")


DRUM = Cylinder((0, 0, 0), (0, 0, 2), 1)


@pytest.mark.parametrize(
    ("ray", "pairs"),
    [
        (Ray((-3, 0, 1), (1, 0, 0)), ((2.0, 4.0),)),
        (Ray((0, 0, 1), (3, 0, 0)), ((0.0, 1 / 3),)),
        (Ray((-1, 1, 1), (1, 0, 0)), ((1.0, 1.0),)),
        (Ray((1, 0, -3), (0, 0, -1)), ()),
        (Ray((1, 0, -3), (0, 0, 1)), ((3.0, 5.0),)),
        (Ray((-3, 0, 2), (1, 0, 0)), ((2.0, 4.0),)),
        (Ray((-3, 0, 2.5), (1, 0, 0)), ()),
        (Ray((5, 5, 1), (1, 0, 0)), ()),
        (Ray((2, 0, 1), (0, 0, 1)), ()),
        (Ray((0, 0, 1), (0, 0, 0)), ((0.0, inf),)),
    ],
)
def test_enclosures_decide_what_is_exact_in_bits(
    ray: Ray, pairs: tuple[tuple[float, float], ...]
) -> None:
    pytest.importorskip("flint")
    for name in ("arb", "mpmath-intervals"):
        assert lists(name, [Case(DRUM, ray)]) == [pairs] == [exact(DRUM, ray)]


def test_no_number_of_bits_tells_of_a_touch_at_a_third() -> None:
    flint = pytest.importorskip("flint")
    rim = Ray((-2, 0, 1), (3, 0, -3))
    assert exact(DRUM, rim) == ((1 / 3, 1 / 3),)
    before = flint.ctx.prec
    assert lists("arb", [Case(DRUM, rim)]) == lists("mpmath-intervals", [Case(DRUM, rim)]) == [None]
    assert flint.ctx.prec == before
    assert issubclass(Undecided, FAILURES)
