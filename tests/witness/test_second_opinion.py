"""The lists that the enclosures give, rounded by other code than the oracle's: on golden rows.

The witness by enclosure compares exact ends only. What it leaves open is whether the ends are
rounded right and pairs that touch after rounding are merged: so its ends are rounded here, by no
more than a grid in fractions and the order of enclosures.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import islice
from math import floor, inf, nextafter
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import iv
from mpmath.libmp import to_rational

from raycert.cases.formats import BINARY64, FORMATS, Format
from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Leaf, Ray, Slab, Solid
from raycert.cases.row import GoldenRow
from raycert.oracle.judge.levels import Judge
from raycert.oracle.witness import enclosure
from raycert.oracle.witness.enclosure import Blurred, Enclosed, End, compare, precision, solve
from shared.corpus import golden
from shared.grid import leaves, rays

both = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)


def rational(value: Fraction) -> Enclosed:
    box = iv.mpf(value.numerator) / iv.mpf(value.denominator)
    return Enclosed(box, (Fraction(1), -value), 0)


def step(value: Fraction, fmt: Format) -> Fraction:
    """Return the distance of the numbers of a format just above a value."""
    e = value.numerator.bit_length() - value.denominator.bit_length()
    e -= value < Fraction(2) ** e
    return Fraction(2) ** max(e + 1 - fmt.precision, fmt.least)


def nearest(end: End, fmt: Format) -> float:
    """Return an end rounded to nearest even. Raises `Blurred` at too low a precision."""
    if end is None:
        return inf
    if compare(end, rational(Fraction(0))) == 0:
        return 0.0
    low, high = (Fraction(*to_rational(part)) for part in end.box._mpi_)
    if low <= 0:
        raise Blurred
    grid = step(low, fmt)
    count = floor(low / grid)
    if high - low > grid:
        raise Blurred
    count += compare(end, rational((count + 1) * grid)) >= 0
    half = compare(end, rational((count + Fraction(1, 2)) * grid))
    count += half > 0 or (half == 0 and count % 2)
    return inf if count * grid >= Fraction(2) ** fmt.overflow else float(count * grid)


def second_opinion(solid: Solid, ray: Ray, fmt: Format) -> tuple[tuple[float, float], ...]:
    """Return the expected list of a solid, at the first precision that tells it."""
    bits = enclosure.FIRST
    while True:
        with precision(bits):
            try:
                return merged((nearest(a, fmt), nearest(b, fmt)) for a, b in solve(solid, ray))
            except Blurred:
                bits *= 2


def merged(pairs: Iterable[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    joined: list[tuple[float, float]] = []
    for enter, leave in pairs:
        if joined and joined[-1][1] == enter:
            enter = joined.pop()[0]
        joined.append((enter, leave))
    return tuple(joined)


def disagreements(rows: tuple[GoldenRow, ...], fmt: Format) -> Iterator[str]:
    """Yield the id of each row whose `expected` is not the second opinion."""
    for row in rows:
        found = second_opinion(row.solid, row.ray, fmt)
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
    assert second_opinion(leaf, ray, fmt) == Judge(leaf, ray, fmt).expected


def test_a_divisor_is_told_from_zero_before_anything_is_rounded() -> None:
    """Nearly parallel by 2^-390: intervals of 512 bits still give every t."""
    leaf = InfiniteCylinder((0, 0, 0), (1, 1, 5.34452229675669e-118), 0)
    ray = Ray((0, 0, 1), (1, 1, 0))
    truth = Judge(leaf, ray, BINARY64).expected
    assert truth[0][0] > 1e117
    assert second_opinion(leaf, ray, BINARY64) == truth


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
        assert second_opinion(leaf, ray, BINARY64) == truth


def test_a_wrong_golden_row_is_noticed() -> None:
    """One ulp in one endpoint."""
    row = next(r for r in golden().rows if r.expected and 0 < r.expected[0][0] < inf)
    (enter, leave), *rest = row.expected
    wrong = ((nextafter(enter, 0), leave), *rest)
    altered = GoldenRow(**{n: getattr(row, n) for n in row.__slots__} | {"expected": wrong})
    assert list(disagreements((altered,), BINARY64)) != []
    assert list(disagreements((row,), BINARY64)) == []


EXACT = "raycert.oracle.exact."
SHARED = {
    "definition": {"grid", "intervals", "surd"},
    "enclosure": {"intervals", "surd"},
    "symbols": {"intervals", "surd"},
    "meshes": {"intervals", "surd"},
    "placement": set(),
    "bodies": set(),
    "manifold": {"intervals", "surd"},
    "sandwich": {"intervals", "surd"},
    "algebra": set(),
}
"""What each module of a witness shares with the oracle: the types of answers, and integer grids."""


@pytest.mark.parametrize("name", SHARED)
def test_a_witness_shares_no_formula_with_the_oracle(name: str) -> None:
    tree = ast.parse((Path(enclosure.__file__).parent / f"{name}.py").read_text())
    modules = {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) and n.module}
    assert {m.removeprefix(EXACT) for m in modules if m.startswith(EXACT)} == SHARED[name]
    assert "raycert.cases.vectors" not in modules
    assert "raycert.cases.table" not in modules


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
    assert second_opinion(solid, Ray(origin, direction), BINARY64) == tuple(truth)


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
        found = second_opinion(solid, ray, fmt)[0][0]
        assert found == above == Judge(solid, ray, fmt).expected[0][0]
        tie = Ray((ray.origin[0], 0, 0), (1, 0, 0))
        assert second_opinion(solid, tie, fmt)[0][0] == truth
