"""|a| in many lanes: the bits of `math.hypot`."""

from __future__ import annotations

import random
from math import hypot, ldexp, nextafter, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.reference.arrays import vectors as norms
from raycert.reference.arrays.vectors import norm, rough

ANY = st.floats(allow_nan=False, allow_infinity=False)
PARTS = st.one_of(ANY, st.integers(-9, 9).map(float), st.floats(-1, 1))


def columns(rows: list[tuple[float, ...]]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:  # type: ignore[type-arg]
    x, y, z = (np.array(column) for column in zip(*rows, strict=True))
    return x, y, z


def same(rows: list[tuple[float, ...]]) -> bool:
    with np.errstate(all="ignore"):
        found = norm(columns(rows)).tolist()
    return found == [hypot(*row) for row in rows]


@given(st.lists(st.tuples(PARTS, PARTS, PARTS), min_size=1, max_size=20))
def test_any_numbers(rows: list[tuple[float, ...]]) -> None:
    assert same(rows)


def hard(n: int) -> list[tuple[float, ...]]:
    """Return vectors at all scales, among them nearly flat ones and Pythagorean ones."""
    dice = random.Random(5)
    rows: list[tuple[float, ...]] = []
    for _ in range(n):
        x, y, z = (dice.uniform(-1, 1) for _ in range(3))
        rows += [(x, y, z), (x, y * 1e-8, z * 1e-16), (x, ldexp(y, -26), 0.0)]
        e = dice.randrange(-1070, 1000)
        rows += [(ldexp(x, e), ldexp(y, e), ldexp(z, e)), (3 * x, 4 * x, 12 * x)]
        rows += [(3.0, 4.0, nextafter(12.0, y)), (0.0, 0.0, 0.0)]
    return rows


def test_hard_ones() -> None:
    assert same(hard(3000))


def test_what_is_uncertain_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few lanes ask, mostly exact ties; with a doubt that no lane stands, most do."""
    asked = []
    monkeypatch.setattr(norms, "hypot", lambda *a: asked.append(a) or hypot(*a))
    rows = [row for row in hard(200) if any(row) and 1e-100 < max(map(abs, row)) < 1e100]
    assert same(rows)
    few = len(asked)
    monkeypatch.setattr(norms, "DOUBT", 2.0**-50)
    assert same(rows)
    assert few < len(rows) / 20 < len(rows) / 2 < len(asked) - few


def test_a_plain_root_is_not_enough() -> None:
    rows = hard(500)
    assert any(sqrt(x * x + y * y + z * z) != hypot(x, y, z) for x, y, z in rows)


def test_a_component_that_is_left_out_is_zero() -> None:
    x, y, z = columns([(3.0, 4.0, 0.0), (-5.0, 12.0, 0.0)])
    assert norm((x, y, None)).tolist() == [5, 13]
    assert norm((None, y, None)).tolist() == [4, 12]
    assert norm((None, None, None)).tolist() == [0]
    assert abs(rough((x, y, z)) - [5, 13]).max() < 1e-14
