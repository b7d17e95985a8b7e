"""The witness by meshes: bounds in exact fractions, hand-made rows, planted errors, the caster."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import cos, inf, pi, sin, sqrt

import numpy as np
import pytest

from raycert.cases.dice import Dice
from raycert.cases.draw import fresh
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
    Tree,
    Union,
)
from raycert.oracle.exact.intervals import Intervals, intersect, subtract, union
from raycert.oracle.exact.surd import Surd, dyadic, enclose, fraction
from raycert.oracle.exact.trace import trace
from raycert.oracle.witness import meshes
from raycert.oracle.witness.bodies import (
    HUB,
    MARGIN,
    TURN,
    Body,
    Fineness,
    Side,
    Unsure,
    ball,
    chord,
    may_lose,
    prism,
)
from raycert.oracle.witness.manifold import COARSE, check
from raycert.oracle.witness.meshes import FIRST, SECOND, convergence, sandwich, witness
from raycert.oracle.witness.placement import AWAY, CastLine, Part, exact, line, place
from raycert.oracle.witness.sandwich import ALL, NONE, Sandwich, combine, judge, select
from shared.margins import Planes, casts, greatest, measure, on_grid, seeming_move

CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
TUBE = Difference((CAN, Cylinder((0, 0, -1), (0, 0, 3), 0.5)))
ACROSS = Ray((-3, 0.25, 1), (1, 0, 0))
PRISMS = [Fineness(n, 0, v) for n in (8, 40, 64, 192, 256, 4096) for v in (0, 1)]
BALLS = [Fineness(8, level, v) for level in (0, 2, 3, 4) for v in (0, 1)]


def lists(*pairs: tuple[float, float]) -> Intervals:
    return tuple((dyadic(a), dyadic(b)) for a, b in pairs)


def lists_of_ends(*pairs: tuple[int, int]) -> Intervals:
    return tuple((fraction(a, 1), fraction(b, 1)) for a, b in pairs)


def near(number: Surd, step: Fraction) -> Surd:
    """Return the double next to a number, moved by a step."""
    moved = Fraction(enclose(number, BINARY64).nearest) + step
    return fraction(moved.numerator, moved.denominator)


def cast(start: tuple[float, float, float], direction: tuple[float, float, float]) -> CastLine:
    return CastLine(start, direction, Fraction(0), Fraction(1))


def cast_through(point: np.ndarray, direction: np.ndarray) -> CastLine:
    d = direction / np.linalg.norm(direction)
    x, y, z = (float(c) for c in point - AWAY * d)
    return cast((x, y, z), (float(d[0]), float(d[1]), float(d[2])))


def generic(count: int, seed: int) -> list[tuple[Solid, Ray]]:
    """Return solids and rays with random coordinates, aimed so that most meet."""
    found: list[tuple[Solid, Ray]] = []
    for number in range(count):
        dice = Dice(f"meshes {seed} {number}")
        points = [dice.vector(BINARY64, -2, 2) for _ in range(6)]
        one = Cylinder(points[0], points[1], dice.real(BINARY64, 0.5, 1.5))
        two = Sphere(points[2], dice.real(BINARY64, 0.5, 1.5))
        three = InfiniteCylinder(points[3], points[0], dice.real(BINARY64, 0.3, 1))
        four, five = HalfSpace(points[4], points[1]), Slab(points[2], points[5])
        solids = (
            one,
            two,
            three,
            four,
            five,
            Union((one, two)),
            Intersection((one, Union((two, three)))),
            Difference((one, two)),
            Difference((Union((one, two)), four, three)),
        )
        target = dice.vector(BINARY64, -1, 1)
        origin = tuple(4 * c for c in dice.vector(BINARY64))
        direction = tuple(t - o for t, o in zip(target, origin, strict=True))
        found.append((solids[number % len(solids)], Ray(origin, direction)))  # type: ignore[arg-type]
    return found


def grid(body: Body) -> np.ndarray:
    return on_grid(body.vertices)


ONE = 1 << 110


def reach(side: Side) -> int:
    """Return 1 -+ MARGIN on the grid: what a body has to keep to, half of what it is built for."""
    return ONE + side.value * int(MARGIN * ONE)


# The bodies, in exact integers


@pytest.mark.parametrize("fineness", PRISMS, ids=str)
def test_an_inner_prism_has_its_vertices_deep_in_the_unit_cylinder(fineness: Fineness) -> None:
    vertices = grid(prism(fineness, Side.INNER))
    x, y, z = vertices.T
    assert max(x * x + y * y) < reach(Side.INNER) ** 2
    assert max(abs(z)) < reach(Side.INNER)


@pytest.mark.parametrize("fineness", PRISMS, ids=str)
def test_an_outer_prism_keeps_its_walls_and_caps_off_the_unit_cylinder(fineness: Fineness) -> None:
    n, vertices = fineness.n, grid(prism(fineness, Side.OUTER))
    for a, b in pairwise([*vertices[:n], vertices[0]]):
        edge = b - a
        area = int(a[0] * b[1] - a[1] * b[0])
        square = int(edge[0] ** 2 + edge[1] ** 2)
        assert area > 0
        assert area**2 > reach(Side.OUTER) ** 2 * square
    assert (vertices[:n, :2] == vertices[n : 2 * n, :2]).all()
    for cap, sign in ((range(n), -1), (range(n, 2 * n), 1)):
        assert all(sign * vertices[i, 2] > reach(Side.OUTER) for i in (*cap, 2 * n + (sign > 0)))


@pytest.mark.parametrize("fineness", BALLS, ids=str)
def test_an_inner_ball_has_its_vertices_deep_in_the_unit_ball(fineness: Fineness) -> None:
    vertices = grid(ball(fineness, Side.INNER))
    assert max((vertices * vertices).sum(axis=1)) < reach(Side.INNER) ** 2


@pytest.mark.parametrize("fineness", BALLS, ids=str)
def test_an_outer_ball_keeps_its_faces_off_the_unit_ball(fineness: Fineness) -> None:
    planes = Planes.of(ball(fineness, Side.OUTER))
    squares = (planes.normals * planes.normals).sum(axis=1)
    assert all(planes.offsets > 0)
    assert all(planes.offsets**2 > reach(Side.OUTER) ** 2 * squares)


@pytest.mark.parametrize("side", Side)
@pytest.mark.parametrize("kind", [prism, ball])
def test_a_body_is_a_closed_surface_that_winds_once_and_faces_out(kind: object, side: Side) -> None:
    body = kind(Fineness(64, 2), side)  # type: ignore[operator]
    edges = {(int(f[i - 1]), int(f[i])) for f in body.faces for i in range(3)}
    assert len(edges) == 3 * len(body.faces)
    assert {(b, a) for a, b in edges} == edges
    assert len(body.vertices) - len(edges) // 2 + len(body.faces) == 2
    assert all(Planes.of(body).offsets > 0)


@pytest.mark.parametrize("side", Side)
def test_a_prism_is_convex_and_stays_so_when_its_faces_move_by_the_margin(side: Side) -> None:
    """Moved planes meet within 1.1 MARGIN, and the bodies keep 2 MARGIN off."""
    body = prism(Fineness(8, 0), side)
    planes = Planes.of(body)
    heights = planes.normals @ grid(body).T - planes.offsets[:, np.newaxis]
    assert max((heights * planes.weights[:, np.newaxis]).ravel()) < 2 ** (6 * 110) * 2**-50
    assert 1 / cos(pi / 8) < 1.1


@pytest.mark.parametrize("kind", [prism, ball])
def test_the_two_variants_of_a_body_share_no_vertex(kind: object) -> None:
    one, two = (kind(Fineness(256, 2, v), Side.OUTER) for v in (0, 1))  # type: ignore[operator]
    shared = {tuple(v) for v in one.vertices.tolist()} & {tuple(v) for v in two.vertices.tolist()}
    assert {v[:2] for v in shared} <= {HUB}


def test_the_faces_of_a_prism_come_by_parts() -> None:
    body = prism(Fineness(8, 0), Side.INNER)
    for face, normal in enumerate(body.normals):
        expected = Part.WALL if abs(normal[2]) < 0.5 else Part.TOP if normal[2] > 0 else Part.BOTTOM
        assert body.part(face) is expected


# The frame


@pytest.mark.parametrize("shift", [0, -1000, 900])
def test_local_coordinates_are_distances_by_definition(shift: int) -> None:
    unit = 2.0**shift
    p, q, r = (unit, 2 * unit, -unit), (3 * unit, unit, 5 * unit), 1.5 * unit
    ray = Ray((-4 * unit, unit / 3, 2 * unit), (0.3 * unit, 0.7 * unit, -0.2 * unit))
    placed = place(Cylinder(p, q, r), ray)
    for t in (Fraction(0), Fraction(1, 3), Fraction(7)):
        x, y, z = (a + b * t for a, b in placed.forms)
        u, v, o, e = (exact(c).parts for c in (ray.origin, ray.direction, p, q))
        at = [a + t * b - c for a, b, c in zip(u, v, o, strict=True)]
        w = [a - b for a, b in zip(e, o, strict=True)]
        along = sum(a * b for a, b in zip(at, w, strict=True)) / sum(c * c for c in w)
        square = sum((a - along * b) ** 2 for a, b in zip(at, w, strict=True)) / Fraction(r) ** 2
        assert z == 2 * along - 1
        assert abs(x * x + y * y - square) <= square / 2**60


def test_a_cast_starts_outside_of_the_body_and_runs_at_a_moderate_pace() -> None:
    for question in fresh(400, 11):
        for leaf in [question.solid] if not isinstance(question.solid, Tree) else []:
            found = line(place(leaf, question.ray))
            if found is not None:
                assert 0.7 <= sqrt(sum(c * c for c in found.direction)) <= 2.001
                assert sum(c * c for c in found.start) > 5**2


# Lists


def test_the_own_algebra_gives_the_oracles_lists_but_for_points() -> None:
    dice = Dice("lists")
    for _ in range(200):
        one, two = (_random_list(dice) for _ in range(2))
        assert select((one, two), any) == union((one, two))
        common = tuple((a, b) for a, b in intersect(one, two) if a < b)
        assert select((one, two), all) == common
        parts = [Sandwich(one, one), Sandwich(two, two)]
        difference = combine(Difference((CAN, CAN)), parts)
        assert difference.inner == difference.outer == subtract(one, two)


def _random_list(dice: Dice) -> Intervals:
    cuts = sorted({dice.integer(0, 9) for _ in range(2 * dice.integer(0, 3))})
    return lists(*[(float(a), float(b)) for a, b in zip(cuts[::2], cuts[1::2], strict=False)])


def test_a_difference_takes_the_outer_list_of_what_it_takes_away() -> None:
    first = Sandwich(lists((1, 9)), lists((0, 10)))
    hole = Sandwich(lists((4, 5)), lists((3, 6)))
    found = combine(Difference((CAN, CAN)), [first, hole])
    assert found.inner == lists((1, 3), (6, 9))
    assert found.outer == lists((0, 4), (5, 10))


@pytest.mark.parametrize(
    ("answer", "outcome"),
    [
        (lists((1.75, 3.25)), "agreed"),
        (lists((1.5, 3.5)), "agreed"),
        (lists((2, 3)), "agreed"),
        (lists((1.25, 3.25)), "disagreed"),
        (lists((2.25, 3.5)), "disagreed"),
        (NONE, "disagreed"),
        (lists((1.75, 3.25), (5, 6)), "disagreed"),
        (lists((1.75, 2.5), (2.75, 3.25)), "disagreed"),
        (lists((1.5, 1.625), (1.75, 3.25)), "undecided"),
    ],
)
def test_an_answer_lies_between_inner_and_outer(answer: Intervals, outcome: str) -> None:
    assert judge(answer, Sandwich(lists((2, 3)), lists((1.5, 3.5))))[0] == outcome


def test_what_a_sandwich_does_not_settle_is_undecided() -> None:
    assert judge(lists((1, 1)), Sandwich(NONE, lists((0.9, 1.1))))[0] == "undecided"
    assert judge(NONE, Sandwich(NONE, lists((0.9, 1.1))))[0] == "undecided"
    assert judge(lists((0, 4)), Sandwich(lists((0, 2), (2.1, 4)), lists((0, 4))))[0] == "undecided"
    assert judge(lists((1, 3)), Sandwich(lists((1.9, 2.1)), lists((0, 4))))[0] == "undecided"
    assert judge(NONE, Sandwich(NONE, ALL, ("a doubt",)))[1].endswith("(a doubt)")
    assert judge(NONE, Sandwich(NONE, NONE))[0] == "agreed"


# The witness on cases


ROWS: list[tuple[Solid, Ray, Intervals]] = [
    (CAN, Ray((-3, 0, 1), (1, 0, 0)), lists((2, 4))),
    (CAN, Ray((0.5, 0, 5), (0, 0, -2)), lists((1.5, 2.5))),
    (CAN, Ray((0, 0, 1), (1, 0, 0)), lists((0, 1))),
    (CAN, Ray((-3, 0, 1), (-1, 0, 0)), NONE),
    (CAN, Ray((-3, 1.01, 1), (1, 0, 0)), NONE),
    (CAN, Ray((2, 0, -5), (0, 0, 1)), NONE),
    (CAN, Ray((0.6, 0.3, 1), (0, 0, 0)), ALL),
    (CAN, Ray((0.6, 0.9, 1), (0, 0, 0)), NONE),
    (CAN, Ray((-3, 0, 1), (2.0**900, 0, 0)), lists((2.0**-899, 2.0**-898))),
    (CAN, Ray((-(2.0**900), 0, 1), (1, 0, 0)), lists_of_ends((2**900 - 1, 2**900 + 1))),
    (Sphere((0, 0, 0), 5), Ray((-10, 3, 0), (1, 0, 0)), lists((6, 14))),
    (
        Sphere((0, 0, 0), 5 * 2.0**-600),
        Ray((-10 * 2.0**-600, 0, 0), (1, 0, 0)),
        lists((5 * 2.0**-600, 15 * 2.0**-600)),
    ),
    (InfiniteCylinder((0, 0, 0), (0, 0, 1), 5), Ray((-10, 3, 7), (1, 0, 2.0**-40)), lists((6, 14))),
    (InfiniteCylinder((0, 0, 0), (0, 0, 1), 5), Ray((3, 3, 7), (0, 0, 2.0**-40)), ALL),
    (InfiniteCylinder((0, 0, 0), (0, 0, 1), 0), Ray((3, 3, 7), (1, 0, 1)), NONE),
    (Slab((0, 0, 0), (0, 0, 2)), Ray((0, 0, -2), (9, 0, 1)), lists((2, 4))),
    (Slab((0, 0, 0), (0, 0, 2)), Ray((0, 0, 1), (9, 1, 0)), ALL),
    (Slab((0, 0, 0), (0, 0, 2)), Ray((0, 0, 3), (9, 1, 0)), NONE),
    (HalfSpace((0, 0, 2), (0, 0, 7)), Ray((0, 0, 5), (0, 1, -1)), lists((3, inf))),
    (HalfSpace((0, 0, 2), (0, 0, 7)), Ray((0, 0, -5), (0, 1, 1)), lists((0, 7))),
    (HalfSpace((0, 0, 2), (0, 0, 7)), Ray((0, 0, 1), (5, 1, 0)), ALL),
    (TUBE, Ray((-3, 0, 1), (1, 0, 0)), lists((2, 2.5), (3.5, 4))),
    (Union((CAN, Sphere((5, 0, 1), 1))), Ray((-3, 0, 1), (1, 0, 0)), lists((2, 4), (7, 9))),
]


@pytest.mark.parametrize(("solid", "ray", "truth"), ROWS)
def test_rows_known_by_hand_are_agreed(solid: Solid, ray: Ray, truth: Intervals) -> None:
    assert trace(solid, ray).intervals == truth
    assert witness(solid, ray, truth).outcome == "agreed"


@pytest.mark.parametrize(
    ("solid", "ray"),
    [
        (CAN, Ray((-3, 1, 1), (1, 0, 0))),
        (CAN, Ray((-3, 0, 2), (1, 0, 0))),
        (CAN, Ray((1, 0, 1), (1, 0, 0))),
        (CAN, Ray((1, 0, -5), (0, 0, 1))),
        (CAN, Ray((-3, 1 - 2.0**-50, 1), (1, 0, 0))),
        (CAN, Ray((1, 0, 1), (0, 0, 0))),
        (Sphere((0, 0, 0), 0), Ray((-1, 0, 0), (1, 0, 0))),
        (HalfSpace((0, 0, 0), (0, 0, 1)), Ray((0, 0, 0), (1, 0, 0))),
        (Difference((CAN, CAN)), ACROSS),
        (Union((CAN, Cylinder((0, 0, 2), (0, 0, 4), 1))), Ray((0.1, 0.2, -1), (0, 0, 1))),
    ],
)
def test_touches_and_shared_faces_are_undecided(solid: Solid, ray: Ray) -> None:
    assert witness(solid, ray, trace(solid, ray).intervals).outcome == "undecided"


def test_no_case_of_a_fresh_sample_is_disagreed_and_most_are_agreed() -> None:
    outcomes = [witness(c.solid, c.ray, trace(c.solid, c.ray).intervals) for c in fresh(120, 5)]
    assert not [v for v in outcomes if v.outcome == "disagreed"]
    assert sum(v.outcome == "agreed" for v in outcomes) > 0.7 * len(outcomes)


def test_cases_with_random_coordinates_are_agreed() -> None:
    outcomes = [witness(s, r, trace(s, r).intervals).outcome for s, r in generic(99, 1)]
    assert outcomes.count("disagreed") == 0
    assert outcomes.count("agreed") >= 97


# Planted errors


def test_an_end_moved_by_a_hundredth_of_its_interval_is_disagreed() -> None:
    caught = planted = 0
    for solid, ray in generic(60, 2):
        answer = trace(solid, ray).intervals
        for i, (a, b) in enumerate(answer):
            if not b.finite or enclose(b, BINARY64).nearest < 1e-9:
                continue
            length = enclose(b, BINARY64).nearest - enclose(a, BINARY64).nearest
            for sign in (1, -1):
                moved = near(b, sign * Fraction(length) / 100)
                wrong = (*answer[:i], (a, moved), *answer[i + 1 :])
                planted += 1
                caught += witness(solid, ray, wrong).outcome == "disagreed"
    assert planted > 60
    assert caught > 0.85 * planted, f"{caught} of {planted}"


@pytest.mark.parametrize("index", [0, 1])
@pytest.mark.parametrize("step", [Fraction(1, 100), Fraction(-1, 100)])
@pytest.mark.parametrize("solid", [CAN, Sphere((0, 0, 1), 1)])
def test_an_endpoint_moved_by_a_hundredth_of_the_radius_is_disagreed(
    solid: Solid, step: Fraction, index: int
) -> None:
    ((a, b),) = trace(solid, ACROSS).intervals
    ends = [a, b]
    ends[index] = near(ends[index], step)
    assert witness(solid, ACROSS, ((ends[0], ends[1]),)).outcome == "disagreed"


def test_a_wrong_row_is_disagreed() -> None:
    for solid, ray, answer in (
        (CAN, ACROSS, NONE),
        (CAN, ACROSS, ALL),
        (CAN, Ray((-3, 1.1, 1), (1, 0, 0)), lists((2, 4))),
        (CAN, Ray((0.5, 0, 1), (0, 0, 1)), ALL),
        (InfiniteCylinder((0, 0, 0), (0, 0, 1), 1), Ray((0.5, 0, 1), (0, 0, 1)), NONE),
        (Slab((0, 0, 0), (0, 0, 2)), Ray((0, 0, 1), (9, 1, 0)), NONE),
        (HalfSpace((0, 0, 2), (0, 0, 7)), Ray((0, 0, 5), (0, 1, -1)), lists((0, 3))),
    ):
        assert witness(solid, ray, answer).outcome == "disagreed"


def test_a_forgotten_cap_is_disagreed() -> None:
    ray = Ray((-3, 0.25, 1.5), (1, 0, 0.25))
    wall = trace(InfiniteCylinder(CAN.p, CAN.q, CAN.radius), ray).intervals
    assert wall != trace(CAN, ray).intervals
    assert witness(CAN, ray, wall).outcome == "disagreed"


def test_a_boolean_gone_wrong_is_disagreed_by_the_lists_and_by_the_combined_bodies() -> None:
    answer = trace(TUBE, ACROSS).intervals
    parts = [sandwich(part, ACROSS, FIRST) for part in TUBE.of]
    whole = trace(CAN, ACROSS).intervals
    assert len(answer) == 2
    assert check(TUBE, ACROSS, answer, parts)[0] == "agreed"
    for wrong in (answer[:1], answer[1:], whole, NONE):
        assert judge(wrong, sandwich(TUBE, ACROSS, FIRST))[0] == "disagreed"
        assert check(TUBE, ACROSS, wrong, parts)[0] == "disagreed"
        assert witness(TUBE, ACROSS, wrong).outcome == "disagreed"


def test_the_combined_bodies_see_what_the_lists_get_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    answer = trace(TUBE, ACROSS).intervals
    monkeypatch.setattr(meshes, "judge", lambda *_: ("agreed", "planted"))
    assert witness(TUBE, ACROSS, answer).outcome == "agreed"
    assert witness(TUBE, ACROSS, answer[:1]).outcome == "disagreed"


def test_what_one_set_of_bodies_sees_alone_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    answer, true_leaf = trace(CAN, ACROSS).intervals, meshes._leaf

    def blind_first(leaf: Solid, ray: Ray, fineness: Fineness) -> Sandwich:
        return Sandwich(NONE, NONE) if fineness == FIRST else true_leaf(leaf, ray, fineness)

    monkeypatch.setattr(meshes, "_leaf", blind_first)
    verdict = witness(CAN, ACROSS, answer)
    assert verdict.outcome == "undecided"
    assert "one set of bodies only" in verdict.why


def test_without_manifold_the_lists_alone_speak(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(meshes, "check", None)
    verdict = witness(TUBE, ACROSS, trace(TUBE, ACROSS).intervals)
    assert verdict.outcome == "agreed"
    assert "Manifold" not in verdict.why


def test_the_combined_bodies_confirm_most_trees_with_random_coordinates() -> None:
    trees = [(s, r) for s, r in generic(90, 3) if isinstance(s, Tree)]
    outcomes = [witness(s, r, trace(s, r).intervals).why for s, r in trees]
    assert sum("Manifold agreed" in why for why in outcomes) > 0.75 * len(trees)


# The caster


@pytest.mark.parametrize("fineness", [FIRST, SECOND, *COARSE, Fineness(8, 1)], ids=str)
@pytest.mark.parametrize("side", Side)
def test_a_cast_through_a_vertex_or_an_edge_is_one_chord_or_unsure(
    fineness: Fineness, side: Side
) -> None:
    body = prism(fineness, side)
    planes, told = Planes.of(body), 0
    for corner, other, direction in (
        (0, 0, (1.0, 0.3, 0.2)),
        (0, 1, (0.9, 0.3, 0.2)),
        (3, 3 + fineness.n, (0.4, 1.0, 0.1)),
        (fineness.n, 1, (0.4, 1.0, 0.1)),
        (2 * fineness.n, 2 * fineness.n + 1, (0.0, 0.0, 1.0)),
    ):
        point = (body.vertices[corner] + body.vertices[other]) / 2
        try:
            move = seeming_move(body, planes, cast_through(point, np.array(direction)))
        except Unsure:
            continue
        told += 1
        assert move < MARGIN / 100
    assert told


def test_an_edge_met_head_on_counts_once() -> None:
    angle = 2 * pi * TURN[0] / FIRST.n
    ray = Ray((3 * cos(angle), 3 * sin(angle), 1), (-cos(angle), -sin(angle), 0))
    assert witness(CAN, ray, trace(CAN, ray).intervals).outcome == "agreed"


@pytest.mark.parametrize("seed", [101])
@pytest.mark.parametrize(
    ("body", "count"),
    [
        (prism(Fineness(8, 0), Side.OUTER), 600),
        (prism(Fineness(256, 0), Side.INNER), 150),
        (prism(Fineness(192, 0, 1), Side.OUTER), 150),
        (ball(Fineness(8, 1), Side.OUTER), 600),
        (ball(FIRST, Side.INNER), 16),
    ],
    ids=["prism-8", "prism-256", "prism-192", "ball-1", "ball-4"],
)
def test_the_caster_moves_faces_by_a_hundredth_of_the_margin_at_most(
    body: Body, count: int, seed: int
) -> None:
    found = measure(body, count, seed)
    assert found.worst < MARGIN / 100
    assert found.unsure < count / 5


def test_the_measurement_sees_a_face_that_is_not_where_the_caster_finds_it() -> None:
    body, moved = prism(Fineness(8, 0), Side.OUTER), prism(Fineness(8, 0), Side.INNER)
    planes = Planes.of(moved)
    seen = seeming_move(body, planes, cast((-8.0, 0.1, 0.2), (1.0, 0.01, 0.02)))
    assert seen > MARGIN


def test_a_miss_along_faces_the_caster_skips_is_unsure() -> None:
    """Found by measuring: both ends of this chord, 1.8e-8 deep, are on faces near parallel."""
    body = prism(Fineness(4096, 0), Side.OUTER)
    grazing = cast(
        (-0.9991922201556898, -0.04515664684127471, -10.399979650531403),
        (0.00017714635763023038, -0.0026901151143719523, 1.2999972045738557),
    )
    lines = Planes.of(body).depths(grazing)
    assert greatest(lines, Fraction(0), Fraction(16)) > int(MARGIN * 2**660)
    assert may_lose(body, grazing)
    with pytest.raises(Unsure):
        chord(body, grazing)


def test_a_miss_along_the_axis_is_believed() -> None:
    body = prism(FIRST, Side.OUTER)
    assert chord(body, cast((1.5, 0.0, -8.0), (0.0, 0.0, 1.0))) is None


def test_casts_are_the_same_for_a_seed() -> None:
    body = prism(Fineness(8, 0), Side.OUTER)
    assert list(casts(body, 20, 1)) == list(casts(body, 20, 1)) != list(casts(body, 20, 2))


# The curve


def test_the_gap_shrinks_as_the_square_of_the_number_of_sides() -> None:
    rows = convergence((8, 32, 128, 512), rays=12)
    scaled = [row.scaled for row in rows]
    assert max(scaled) < 1.1 * min(scaled)
    assert all(pi**2 / 2 < s < 2 * pi**2 for s in scaled)
