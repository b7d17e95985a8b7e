"""Classes keep an order, curves are drawn once, and what is said of a map are its counts."""

from collections import Counter
from fractions import Fraction
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.model import Cylinder, InfiniteCylinder, Ray
from raycert.oracle.map.legend import (
    axis_label,
    classes,
    edges,
    lines,
    links,
    pairs_of,
    subtitle,
    summary,
    thin,
)
from raycert.oracle.map.raster import Inputs, Raster, Unit
from raycert.oracle.map.sampling import EXACT, Cell, Map, sample

ROD = Cylinder((0, 0, 0), (0, 0, 2), 1)
PLACES = st.tuples(st.integers(0, 5), st.integers(0, 5))


def made(ray: Ray, x: str, y: str, unit: Unit = "ulps", span: int = 4, rod: object = ROD) -> Map:
    inputs = Inputs(rod, ray)  # type: ignore[arg-type]
    axes = inputs.direction(x), inputs.direction(y)
    return sample(Raster.of(inputs, axes, unit, Fraction(span), 8), "exact")


TANGENT = made(Ray((-3, 1, 1), (1, 0, 0)), "ray.origin[1]", "solid.radius")
ACROSS = made(Ray((-3, 0.5, 1), (1, 0, 0)), "ray.origin[1]=2,ray.origin[0]=1", "ray.origin[2]")


def test_every_cell_is_in_one_class_and_no_pair_comes_first() -> None:
    counts = classes(TANGENT)
    assert sum(count for _, count in counts) == len(TANGENT.cells)
    assert [pairs_of(name) for name, _ in counts] == [0, 1, 1]


def test_failures_and_no_case_come_last() -> None:
    cells = {
        (0, 0): Cell(refused="solid.radius: is negative"),
        (1, 0): Cell(says="crash: exit 3"),
        (2, 0): Cell(says="crash: exit 4"),
        (3, 0): Cell(says=EXACT),
    }
    assert classes(Map(TANGENT.raster, "disagreement", None, cells)) == [
        (EXACT, 1),
        ("no answer: crash", 2),
        ("no valid case", 1),
    ]


def test_a_tangent_goes_through_the_cells_of_the_diagonal() -> None:
    assert thin(TANGENT) == {(i, i): "double root" for i in range(-4, 5)}
    assert edges(TANGENT) == {}


def test_a_curve_between_cells_has_the_edges_there() -> None:
    """Twice as steep on one axis: each second cell of the curve is passed by."""
    found = made(Ray((-3, 1, 1), (1, 0, 0)), "ray.origin[1]=2", "solid.radius")
    through, between = thin(found), edges(found)
    assert set(through) == {(i, 2 * i) for i in range(-2, 3)}
    assert set(between) == {"double root"}


def test_an_area_that_is_degenerate_is_no_line() -> None:
    """A ray in the wall stays in it, wherever it starts."""
    wall = InfiniteCylinder((0, 0, 0), (0, 0, 1), 1)
    ray = Ray((1, 0, 0), (0, 0, 1))
    found = made(ray, "ray.origin[2]", "ray.direction[2]", rod=wall)
    assert all(cell.topology and cell.topology.kinds for cell in found.cells.values())
    assert thin(found) == {}
    assert edges(found) == {}


@given(st.sets(PLACES))
def test_cells_that_touch_are_linked(places: set[tuple[int, int]]) -> None:
    found = {frozenset(link) for link in links(places)}
    assert len(found) == len(links(places))
    for i, j in places:
        for other in ((i + 1, j), (i, j + 1)):
            assert (frozenset({(i, j), other}) in found) == (other in places)
    assert all(at in places for link in found for at in link)


@given(st.sets(PLACES))
def test_lines_have_each_edge_once(places: set[tuple[int, int]]) -> None:
    given_edges = links(places)
    drawn = Counter(frozenset(pair) for line in lines(given_edges) for pair in pairwise(line))
    assert drawn == Counter(frozenset(edge) for edge in given_edges)


def test_a_straight_line_is_one() -> None:
    assert lines([((1, 0), (2, 0)), ((0, 0), (1, 0)), ((2, 0), (3, 0))]) == [
        [(0, 0), (1, 0), (2, 0), (3, 0)]
    ]


def test_a_summary_counts() -> None:
    said = "\n".join(summary(TANGENT))
    assert "81 of 81 cells" in said
    assert "36  no pair: miss AE no-1" in said
    assert "double root, through 9 cells, between 0 pairs of cells" in said
    part = Map(TANGENT.raster, "exact", None, {(0, 0): TANGENT.cells[0, 0]})
    assert next(iter(summary(part))) == "1 of 81 cells; interrupted"
    assert "interrupted, 1 cells" in subtitle(part)


def test_axes_say_what_they_move_from_where_in_what() -> None:
    assert axis_label(TANGENT, "y") == "solid.radius, ulps from 1.0"
    text = axis_label(ACROSS, "x")
    assert "ray.origin[1]=2,ray.origin[0]=1" in text
    assert "ulps from ray.origin[1] 0.5, ray.origin[0] -3" in text
