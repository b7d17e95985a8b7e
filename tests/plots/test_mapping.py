"""A picture has every cell in its colour, the curves, the case, and the same bytes each time."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import inf
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("matplotlib")
import numpy as np
from matplotlib.colors import to_rgb
from PIL import Image

from raycert.cases.model import Cylinder, Ray
from raycert.oracle.client.target import target
from raycert.oracle.map.legend import class_of
from raycert.oracle.map.raster import Inputs, Raster, Unit
from raycert.oracle.map.sampling import ORDER, Map, Show, sample
from raycert.oracle.plots.mapping import CURVES, DIFFERENCES, ENDLESS, FAILED, draw, palette, save
from raycert.oracle.plots.style import styled

CASE = Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 1, 1), (1, 0, 0))


def made(show: Show, unit: Unit = "ulps", span: int = 3) -> Map:
    inputs = Inputs(*CASE)
    axes = inputs.direction("ray.origin[1]"), inputs.direction("solid.radius")
    plan = Raster.of(inputs, axes, unit, Fraction(span), 6)
    return sample(plan, show, target(["raycert.reference.tracer:intersect"]))


def drawn(found: Map) -> Any:
    with styled():
        return draw(found, "Around a case")


def legend(found: Map) -> list[str]:
    return [text.get_text() for text in drawn(found).legends[0].get_texts()]


def pixels(found: Map) -> Any:
    return drawn(found).axes[0].images[0].get_array()


@pytest.mark.parametrize("show", ["exact", "answer", "k", "ulps", "disagreement"])
def test_both_files_are_written_and_come_again(show: Show, tmp_path: Path) -> None:
    found = made(show, "units")
    for name in ("a.png", "b.png", "a.svg", "b.svg"):
        (tmp_path / name).write_bytes(save(found, "Around a case", name[2:]))
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    assert b"dc:date" not in (tmp_path / "a.svg").read_bytes()
    with Image.open(tmp_path / "a.png") as image:
        assert np.asarray(image.convert("L")).std() > 5


def test_cells_have_the_colour_of_their_class_and_their_place() -> None:
    found = made("exact")
    colours = palette(sorted({class_of(cell) for cell in found.cells.values()}))
    assert len(set(colours.values())) == 3
    picture = pixels(found)
    same = {at: tuple(picture[at[1] + 3, at[0] + 3]) for at in found.cells}
    for at, cell in found.cells.items():
        for other, cell_there in found.cells.items():
            alike = class_of(cell) == class_of(cell_there)
            assert (same[at] == same[other]) == alike


def test_the_legend_names_classes_with_counts_curves_and_the_case() -> None:
    said = [" ".join(text.split()) for text in legend(made("exact"))]
    assert said[0] == "no pair: miss AE no-1 [21]"
    assert "double root" in said
    assert said[-1] == "the case"


def test_what_is_no_case_is_hatched_and_named() -> None:
    said = [" ".join(text.split()) for text in legend(made("exact", "units"))]
    assert any(text.startswith("no valid case [14]: solid.radius: is negative") for text in said)


def test_numbers_go_from_light_to_dark_and_the_endless_is_red() -> None:
    found = made("k")
    for at, value in (((-3, 0), 1.0), ((0, 0), 1e6), ((3, 0), inf)):
        found.cells[at] = replace(found.cells[at], value=value)
    found.cells[0, 3] = replace(found.cells[0, 3], value=None, says="crash: x")
    picture = pixels(found)
    assert picture[3, 0].sum() > picture[3, 3].sum()
    assert tuple(picture[3, 6]) == pytest.approx(to_rgb(ENDLESS))
    assert tuple(picture[6, 3]) == pytest.approx(to_rgb(FAILED))
    assert {"no k is enough  [1]", "no answer  [1]"} <= set(legend(found))


def test_a_part_of_a_map_is_drawn_and_the_rest_is_white() -> None:
    found = made("exact")
    part = Map(found.raster, "exact", None, {(0, 0): found.cells[0, 0]})
    assert (pixels(part) == 1).all(axis=2).sum() == 48


def test_many_classes_share_the_last_colour() -> None:
    found = made("exact")
    for i, at in enumerate(list(found.cells)[:20]):
        found.cells[at] = replace(found.cells[at], says=f"class {i}")
    assert any("more forms" in text for text in legend(found))


def test_classes_and_curves_are_told_apart() -> None:
    assert len(DIFFERENCES) == len(ORDER) == len(set(DIFFERENCES))
    assert len(set(CURVES.values())) == len(CURVES)
    colours = palette([f"{n} pairs: {i}" for n in range(3) for i in range(4)])
    assert len(set(colours.values())) == 12
