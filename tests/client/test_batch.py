"""Questions survive their way to a worker, to the bit."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.model import Cylinder, Ray, Union
from raycert.cases.strategies import rays, solids
from raycert.oracle.client.inprocess import read_batch, write_batch


@given(st.lists(st.tuples(solids(), rays()), max_size=3))
def test_a_batch_survives(questions: list[tuple[object, Ray]]) -> None:
    back = list(read_batch(write_batch(questions)))  # type: ignore[arg-type]
    assert repr(back) == repr(questions)
    assert back == questions
    assert [hash(pair) for pair in back] == [hash(pair) for pair in questions]


def test_a_deep_tree_survives() -> None:
    tree: object = Cylinder((0, 0, 0), (0, 0, -0.0 + 1), 1)
    for _ in range(200):
        tree = Union((tree,))  # type: ignore[arg-type]
    [(back, _)] = read_batch(write_batch([(tree, Ray((0, 0, 0), (0, 0, -0.0)))]))  # type: ignore[list-item]
    assert back == tree
