"""The errors of a picture: what the judge says of each pixel, by a shorter way."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nextafter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import BINARY64
from raycert.cases.model import Ray, Solid
from raycert.cases.scene import Scene, frame, load, pixel_ray, shipped
from raycert.cases.strategies import scenes
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import Step
from raycert.oracle.judge.pixels import LAST, cut, error, every_row
from raycert.reference.intervals import Pairs
from raycert.reference.tracer import intersect


def judged(solid: Solid, ray: Ray, answer: Pairs) -> float:
    return Judge(solid, ray, BINARY64).backward_error(answer, "strict")


def rays(name: str, size: tuple[int, int]) -> list[Ray]:
    seen = frame(load(name).camera)
    return [pixel_ray(seen, size, x, y) for y in range(size[1]) for x in range(size[0])]


@pytest.mark.parametrize("name", shipped())
def test_it_is_the_judges_error(name: str) -> None:
    solid = load(name).solid
    guess, found = 0, []
    for ray in rays(name, (5, 4)):
        answer = intersect(solid, ray)
        k, guess = error(solid, ray, answer, guess)
        assert k == judged(solid, ray, answer)
        found.append(k)
    assert min(found) == 1 / 16 < max(found) <= 2


def spoiled(answer: Pairs, way: int) -> Pairs:
    """Return a wrong list: near, far, empty, or none at all."""
    if not answer:
        return [(1.0, 2.0)] if way else []
    (a, b), *rest = answer
    ways: list[Pairs] = [
        [(nextafter(a, inf), b), *rest],
        [(a * (1 + 1e-9), b), *rest],
        [(a * 0.9, b * 1.1)],
        [],
        [(b + 1, b)],
    ]
    return ways[way]


@pytest.mark.parametrize("way", range(5))
@pytest.mark.parametrize("name", ["lens", "pipe", "far"])
def test_wrong_answers_get_the_judges_error(name: str, way: int) -> None:
    solid = load(name).solid
    for ray in rays(name, (4, 3)):
        answer = spoiled(intersect(solid, ray), way)
        assert error(solid, ray, answer)[0] == judged(solid, ray, answer)


@given(scenes(max_leaves=4), st.integers(0, 4), st.integers(0, LAST))
@settings(max_examples=40)
def test_drawn_scenes(scene: tuple[Solid, Ray], way: int, guess: int) -> None:
    solid, ray = scene
    for answer in (intersect(solid, ray), spoiled(intersect(solid, ray), way)):
        assert error(solid, ray, answer, guess)[0] == judged(solid, ray, answer)


@given(scenes(max_leaves=5))
def test_what_is_cut_has_no_part_in_the_lists(scene: tuple[Solid, Ray]) -> None:
    solid, ray = scene
    near = cut(solid, ray)
    whole = Judge(solid, ray, BINARY64)
    for step in (0, 20, LAST):
        for sigma in (1, -1):
            lists = Judge(near, ray, BINARY64).moved(step, "strict", sigma) if near else ()
            assert lists == whole.moved(step, "strict", sigma)
    assert float(Step.at(LAST)) == 2**20


def test_far_leaves_are_cut() -> None:
    solid = load("forest").solid
    sizes = [str(cut(solid, ray)).count("radius") for ray in rays("forest", (6, 5))]
    assert max(sizes) < 30 < str(solid).count("radius") == 83


def pictured(scene: Scene) -> list[Pairs]:
    seen, (width, height) = frame(scene.camera), scene.size
    return [
        intersect(scene.solid, pixel_ray(seen, scene.size, x, y))
        for y in range(height)
        for x in range(width)
    ]


def test_rows_come_in_order_from_one_process_or_two(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = replace(load("cylinder"), size=(8, 6))
    answers = pictured(scene)
    one = list(every_row(scene, answers))
    assert [len(row) for row in one] == [8] * 6
    monkeypatch.setattr("raycert.oracle.judge.pixels.FEW", 0)
    assert list(every_row(scene, answers)) == one
