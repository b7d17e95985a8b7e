"""The oracle agrees with a second computation that shares no code with it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from math import inf, nextafter
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import shared.second_opinion as other
from raycert.cases.formats import BINARY64, FORMATS, Format
from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Leaf, Ray, Slab, Solid, Tree
from raycert.cases.row import GoldenRow
from raycert.oracle.judge.levels import Judge
from shared.corpus import golden
from shared.grid import leaves, rays

both = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)


def disagreements(rows: tuple[GoldenRow, ...], fmt: Format) -> Iterator[str]:
    """Yield the id of each row of a leaf whose `expected` is not the second opinion."""
    for row in rows:
        if not isinstance(row.solid, Tree):
            found = tuple(other.second_opinion(row.solid, row.ray, fmt))
            if found != row.expected:
                yield f"{row.id}: {found} is not {row.expected}"


@both
def test_golden_rows_have_a_second_opinion(fmt: Format) -> None:
    """Every fifth; the two witnesses of `test_crosscheck` speak of every row."""
    rows = golden(fmt.name).rows[::5]
    assert len(rows) > 1000
    assert list(islice(disagreements(rows, fmt), 5)) == []


@settings(deadline=None)
@given(leaves, rays, st.sampled_from(list(FORMATS.values())))
def test_the_oracle_agrees_where_everything_touches(leaf: Leaf, ray: Ray, fmt: Format) -> None:
    assert tuple(other.second_opinion(leaf, ray, fmt)) == Judge(leaf, ray, fmt).expected


def test_a_divisor_is_told_from_zero_before_anything_is_rounded() -> None:
    """Nearly parallel by 2^-390: intervals of 512 bits still give every t."""
    leaf = InfiniteCylinder((0, 0, 0), (1, 1, 5.34452229675669e-118), 0)
    ray = Ray((0, 0, 1), (1, 1, 0))
    truth = Judge(leaf, ray, BINARY64).expected
    assert truth[0][0] > 1e117
    assert tuple(other.second_opinion(leaf, ray, BINARY64)) == truth


anything = st.floats(allow_nan=False, allow_infinity=False)
wild_points = st.tuples(anything, anything, anything)


@settings(max_examples=60, deadline=None)
@given(wild_points, wild_points, anything.map(abs), wild_points, wild_points)
def test_the_oracle_agrees_on_numbers_of_every_size(
    p: tuple[float, float, float],
    q: tuple[float, float, float],
    radius: float,
    origin: tuple[float, float, float],
    direction: tuple[float, float, float],
) -> None:
    if p == q:
        return
    ray = Ray(origin, direction)
    for leaf in (Cylinder(p, q, radius), InfiniteCylinder(p, q, radius), Slab(p, q)):
        truth = Judge(leaf, ray, BINARY64).expected
        assert tuple(other.second_opinion(leaf, ray, BINARY64)) == truth


def test_a_wrong_golden_row_is_noticed() -> None:
    """One ulp in one endpoint."""
    row = next(r for r in golden().rows if r.expected and 0 < r.expected[0][0] < inf)
    (enter, leave), *rest = row.expected
    wrong = ((nextafter(enter, 0), leave), *rest)
    altered = GoldenRow(**{n: getattr(row, n) for n in row.__slots__} | {"expected": wrong})
    assert list(disagreements((altered,), BINARY64)) != []
    assert list(disagreements((row,), BINARY64)) == []


def test_it_shares_no_code_with_the_oracle() -> None:
    tree = ast.parse(Path(other.__file__).read_text())
    modules = {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
    assert {m for m in modules if m and m.startswith("raycert")} == {
        "raycert.cases.formats",
        "raycert.cases.model",
    }


TUBE = InfiniteCylinder((0, 0, 0), (0, 0, 2), 1)


@pytest.mark.parametrize(
    ("solid", "origin", "direction", "truth"),
    [
        (TUBE, (-3, 1, 0), (1, 0, 0), [(3.0, 3.0)]),
        (TUBE, (-3, 1 + 2.0**-52, 0), (1, 0, 0), []),
        (TUBE, (0, 0, 0), (0, 0, 1), [(0.0, inf)]),
        (TUBE, (1, 0, 0), (1, 0, 0), [(0.0, 0.0)]),
        (Slab((0, 0, 0), (0, 0, 2)), (0, 0, 3), (0, 0, -1), [(1.0, 3.0)]),
        (HalfSpace((0, 0, 0), (0, 0, 2)), (0, 0, 3), (0, 0, -2), [(1.5, inf)]),
        (HalfSpace((0, 0, 5e-324), (0, 0, 1)), (0, 0, 0), (0, 0, 2), [(0.0, 0.0)]),
        (HalfSpace((0, 0, 1.5e-323), (0, 0, 1)), (0, 0, 0), (0, 0, 2), [(0.0, 1e-323)]),
        (HalfSpace((0, 0, 1e300), (0, 0, 1)), (0, 0, 0), (0, 0, 1e-300), [(0.0, inf)]),
    ],
)
def test_answers_by_hand(
    solid: Leaf,
    origin: tuple[float, float, float],
    direction: tuple[float, float, float],
    truth: list[tuple[float, float]],
) -> None:
    assert other.second_opinion(solid, Ray(origin, direction), BINARY64) == truth


@both
@pytest.mark.parametrize("j", [60, 120, 240, 500])
def test_a_tie_moved_by_2_to_the_minus_2j_is_rounded_right(fmt: Format, j: int) -> None:
    """A chord y = 2^-j beside the axis: t1 = X - sqrt(r^2 - y^2), just above the tie X - r."""
    if fmt.precision < 53 and j > 120:
        return
    last = Fraction(2) ** (1 - fmt.precision)
    solid: Solid = InfiniteCylinder((0, 0, 0), (0, 0, 1), float(last / 2))
    for odd, truth in ((1, 1.0), (3, 1 + 2 * float(last))):
        start = 1 + odd * last / 2 + last / 2  # X - r = 1 + odd/2 ulp
        ray = Ray((-float(start), 2.0**-j, 0), (1, 0, 0))
        assert Fraction(-ray.origin[0]) == start
        above = 1 + (odd + 1) * float(last) / 2
        found = other.second_opinion(solid, ray, fmt)[0][0]
        assert found == above == Judge(solid, ray, fmt).expected[0][0]
        tie = Ray((ray.origin[0], 0, 0), (1, 0, 0))
        assert other.second_opinion(solid, tie, fmt)[0][0] == truth
