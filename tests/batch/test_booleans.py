"""Booleans of many lanes at once: the scalar oracle's lists, or the lane is left to it."""

from __future__ import annotations

import numpy as np
import pytest

from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.model import Difference, HalfSpace, Intersection, Solid, Sphere, Union
from raycert.oracle.batch.blocks import trace_batch
from raycert.oracle.batch.booleans import Lists, combine
from shared.batch_rays import aligned, free, lattice, wrong

TREES = (Union, Intersection, Difference)


def tree(dice: np.random.Generator, leaves: list, depth: int) -> Solid:
    """Return a random tree over some leaves."""
    if not depth or dice.random() < 0.2:
        return leaves[dice.integers(len(leaves))]
    parts = [tree(dice, leaves, depth - 1) for _ in range(dice.integers(1, 4))]
    return TREES[dice.integers(3)](tuple(parts))


@pytest.mark.parametrize("fmt", [BINARY64, BINARY32], ids=lambda fmt: fmt.name)
@pytest.mark.parametrize("family", [free, aligned, lattice], ids=lambda f: f.__name__)
def test_trees_are_the_scalar_oracle_s(family, fmt) -> None:
    dice = np.random.default_rng(31)
    for _ in range(12):
        leaves, u, v = family(dice, 40)
        some = [*leaves, *family(dice, 1)[0]]
        solid = tree(dice, some, 3)
        bad, found = wrong(solid, u, v, fmt)
        assert bad == [], solid
        assert sum(found.lanes.values()) == 40


def test_random_trees_are_not_left_to_the_integers() -> None:
    dice = np.random.default_rng(32)
    _, u, v = free(dice, 2000)
    one, two, three, four, five, six, seven, eight = (free(dice, 1)[0][1 + i % 4] for i in range(8))
    solid = Difference((Union((one, Intersection((two, three)), four, five)), six, seven, eight))
    found = trace_batch(solid, u, v, engine="numpy")
    assert found.lanes["integer"] == 0
    assert sum(found.leaves.values()) == 8 * 2000


def lists(*pairs: tuple[float, float]) -> Lists:
    enter, leave = np.array(pairs, float).reshape(-1, 2).T
    return Lists(np.zeros(len(pairs), np.intp), enter, leave, np.zeros(1, bool))


A = HalfSpace((0, 0, 0), (0, 0, 1))
INF = np.inf


@pytest.mark.parametrize(
    ("kind", "parts", "result"),
    [
        (Union, [[(0, 2)], [(1, 3)]], [(0, 3)]),
        (Union, [[(0, 1)], [(2, 3)]], [(0, 1), (2, 3)]),
        (Union, [[], []], []),
        (Union, [[(0, INF)], [(0, INF)]], [(0, INF)]),
        (Intersection, [[(0, 2)], [(1, 3)]], [(1, 2)]),
        (Intersection, [[(0, 2)], []], []),
        (Intersection, [[(0, 5), (7, INF)], [(1, 8)]], [(1, 5), (7, 8)]),
        (Difference, [[(0, 5)], [(2, 3)]], [(0, 2), (3, 5)]),
        (Difference, [[(0, 5)], [(0, 3)]], [(3, 5)]),
        (Difference, [[(0, INF)], [(1, INF)]], [(0, 1)]),
        (Difference, [[(0, INF)], [(0, INF)]], []),
        (Difference, [[(1, 9)], [(2, 3)], [(2.5, 4)]], [(1, 2), (4, 9)]),
    ],
)
def test_lists_whose_order_is_certain(kind, parts, result) -> None:
    found = combine(kind((A,) * len(parts)), [lists(*part) for part in parts])
    assert not found.open[0]
    assert list(zip(found.enter.tolist(), found.leave.tolist(), strict=True)) == result


@pytest.mark.parametrize(
    "parts",
    [
        [[(0, 2)], [(2, 3)]],
        [[(1, 2)], [(1, 3)]],
        [[(1, 1)], [(0, 3)]],
        [[(0, 0)], [(0, 3)]],
        [[(0, 0)], []],
    ],
)
@pytest.mark.parametrize("kind", TREES)
def test_what_touches_or_has_no_length_is_left_open(kind, parts) -> None:
    assert combine(kind((A, A)), [lists(*part) for part in parts]).open[0]


def test_shared_faces_are_decided_by_the_integers() -> None:
    shell = Difference((Sphere((0, 0, 0), 2), Sphere((1, 0, 0), 1)))
    u, v = np.array([[-3.0, 0, 0], [-3.0, 0.5, 0]]), np.array([[1.0, 0, 0]] * 2)
    bad, found = wrong(shell, u, v)
    assert bad == []
    assert (found.lanes["integer"], found.pairs(0)) == (1, ((1.0, 3.0),))
