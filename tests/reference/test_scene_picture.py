"""Pictures: a scale that keeps its order in grey, and strips that say what is drawn."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from raycert.oracle.plots.heatmap import (
    BACKGROUND,
    ENDLESS,
    LEAST_WIDTH,
    STEPS,
    STRIP,
    Scale,
    colours,
    directions,
    heat,
    png,
    shown,
)


def luminance(colour: tuple[int, int, int]) -> float:
    """Return the relative luminance of an sRGB colour (Rec. 709)."""
    linear = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_the_scale_is_brighter_at_each_step() -> None:
    found = [luminance(colour) for colour in colours()]
    assert len(found) == STEPS
    assert all(b > a for a, b in zip(found, found[4:], strict=False))
    assert found[0] < 0.05 < 0.7 < found[-1]


def test_steps_look_alike() -> None:
    """No step of sixteen colours changes the lightness by twice another: no false edges."""
    lightness = np.cbrt([luminance(colour) for colour in colours()[::16]])
    steps = np.diff(lightness)
    assert steps.max() < 2 * steps.min()


def test_pixels_have_the_colours_of_their_numbers() -> None:
    values = np.full((4, LEAST_WIDTH), 2.0)
    values[0], values[1], values[2] = 1.0, np.nan, np.inf
    picture = heat(values, Scale("depth", 1, 2, "units"))
    assert picture.size == (LEAST_WIDTH, 4 + STRIP)
    at = [picture.getpixel((7, y)) for y in range(4)]
    assert at == [colours()[0], BACKGROUND, ENDLESS, colours()[-1]]


def test_small_pictures_are_enlarged() -> None:
    picture = heat(np.eye(2), Scale("count", 0, 1, whole=True))
    assert picture.size == (LEAST_WIDTH, LEAST_WIDTH + STRIP)
    assert picture.getpixel((5, 5)) == colours()[-1]
    assert picture.getpixel((LEAST_WIDTH - 5, 5)) == colours()[0]


def test_a_logarithmic_scale() -> None:
    scale = Scale("k", 1 / 16, 64, logarithmic=True)
    assert scale.place(np.array([1 / 16, 2, 64, 1e9])).tolist() == [0, 0.5, 1, 1]
    assert [scale.at(place) for place in scale.places] == ["0.0625", "2", "64"]


def test_whole_numbers_are_marked_each() -> None:
    scale = Scale("count", 0, 3, whole=True)
    assert [scale.at(place) for place in scale.places] == ["0", "1", "2", "3"]
    assert Scale("depth", 2, 2).places == (0,)


def test_directions_are_red_green_blue() -> None:
    normals = np.zeros((1, LEAST_WIDTH, 3))
    normals[0, :, 0] = 1
    normals[0, 9] = np.nan
    picture = directions(normals, "normal")
    assert picture.getpixel((3, 0)) == (255, 128, 128)
    assert picture.getpixel((9, 0)) == BACKGROUND


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [(1.0, 2.0, "1"), (29999998.28012, 30000000.54, "29999998.2801"), (5.0, 5.0, "5")],
)
def test_numbers_are_told_apart(low: float, high: float, text: str) -> None:
    assert shown(low, low, high) == text


def test_a_file_is_a_png() -> None:
    with Image.open(BytesIO(png(heat(np.eye(3), Scale("depth", 0, 1))))) as image:
        assert image.format == "PNG"
